//! What can be wrong with zones of soil.

use super::number::MOST_SOILS;
use crate::error::ParameterError;
use crate::terrain::elevation::ElevationError;

/// Why there are no such zones.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ZonesError {
    /// A zone of a soil that is not there.
    #[error("a zone has soil number {zone}, counted from 0, and there are {soils}")]
    NoSoil {
        /// Its number.
        zone: usize,
        /// How many there are.
        soils: usize,
    },
    /// More soils than zones can name.
    #[error("zones have {soils} soils, and may have at most {MOST_SOILS}")]
    TooManySoils {
        /// How many.
        soils: usize,
    },
    /// Not one zone for each point.
    #[error("a grid of {columns} × {rows} points does not have {given} zones")]
    Count {
        /// Points in a row.
        columns: usize,
        /// Rows.
        rows: usize,
        /// Zones that were given.
        given: usize,
    },
    /// A corner without a place.
    #[error(
        "polygon {polygon}, counted from 1, has a corner at x = {x} m, y = {y} m, and all must be \
         finite"
    )]
    Corner {
        /// The polygon.
        polygon: usize,
        /// To the east [m].
        x: f64,
        /// To the north [m].
        y: f64,
    },
    /// A ring that encloses nothing.
    #[error(
        "polygon {polygon}, counted from 1, has a ring of {corners} corners, which encloses nothing"
    )]
    Ring {
        /// The polygon.
        polygon: usize,
        /// Corners of the ring.
        corners: usize,
    },
    /// No grid.
    #[error(transparent)]
    Grid(#[from] ElevationError),
    /// No such soil.
    #[error(transparent)]
    Soil(#[from] ParameterError),
}
