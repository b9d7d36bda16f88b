//! What can be wrong with an elevation model.

/// Why heights and a grid make no elevation model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ElevationError {
    /// Nothing lies between the points.
    #[error(
        "{columns} × {rows} points are too few: an elevation model has two or more along each axis"
    )]
    TooFewPoints {
        /// Points in a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// More points than this machine can count.
    #[error("{columns} × {rows} points are more than this machine can address")]
    TooManyPoints {
        /// Points in a row.
        columns: usize,
        /// Rows.
        rows: usize,
    },
    /// Not one height for each point.
    #[error("a grid of {columns} × {rows} points does not have {given} heights")]
    Count {
        /// Points in a row.
        columns: usize,
        /// Rows.
        rows: usize,
        /// Heights that were given, or one more than there are points.
        given: usize,
    },
    /// A cell without a size.
    #[error(
        "the points are {x} m apart to the east and {y} m to the north; both must be above zero"
    )]
    Spacing {
        /// To the east [m].
        x: f64,
        /// To the north [m].
        y: f64,
    },
    /// No place on a map.
    #[error(
        "the first point is at x = {x} m, y = {y} m, and all points must have finite coordinates"
    )]
    Place {
        /// To the east [m].
        x: f64,
        /// To the north [m].
        y: f64,
    },
    /// Heights above nothing.
    #[error("heights are above {base} m, which must be finite")]
    Base {
        /// What they are above [m].
        base: f64,
    },
    /// All heights are missing.
    #[error("none of the {points} heights is known")]
    NothingKnown {
        /// Points of the grid.
        points: usize,
    },
}
