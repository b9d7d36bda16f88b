//! The points of an elevation model.

use super::ElevationError;
use crate::units::Vec2;

/// The points of a regular grid on a map: x east, y north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElevationGrid {
    /// Points in a row, from west to east.
    pub columns: usize,
    /// Rows, from south to north.
    pub rows: usize,
    /// The first point: the one farthest to the south and west [m].
    pub south_west: Vec2,
    /// Distance between neighbours to the east and to the north [m].
    pub spacing: Vec2,
}

/// A rectangle on a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Its corner in the south-west [m].
    pub south_west: Vec2,
    /// Its corner in the north-east [m].
    pub north_east: Vec2,
}

impl Extent {
    /// The smallest rectangle that has all places [m]; none where there is no place.
    #[must_use]
    pub fn around<'p>(places: impl IntoIterator<Item = &'p Vec2>) -> Option<Self> {
        places.into_iter().fold(None, |extent: Option<Self>, place| {
            let Self { south_west, north_east } =
                extent.unwrap_or(Self { south_west: *place, north_east: *place });
            Some(Self { south_west: south_west.inf(place), north_east: north_east.sup(place) })
        })
    }

    /// Whether nothing of it is inside the other, or on its edge.
    #[must_use]
    pub fn is_apart_from(&self, other: &Self) -> bool {
        self.south_west.x > other.north_east.x
            || self.south_west.y > other.north_east.y
            || self.north_east.x < other.south_west.x
            || self.north_east.y < other.south_west.y
    }

    /// Whether a place is inside, or on its edge.
    #[must_use]
    pub fn contains(&self, at: Vec2) -> bool {
        let (low, high) = (self.south_west, self.north_east);
        (low.x..=high.x).contains(&at.x) && (low.y..=high.y).contains(&at.y)
    }
}

impl ElevationGrid {
    /// All points [m], in rows from south to north, each from west to east.
    pub fn points(&self) -> impl Iterator<Item = Vec2> + use<> {
        let grid = *self;
        (0..grid.rows)
            .flat_map(move |row| (0..grid.columns).map(move |column| grid.point(column, row)))
    }

    /// A point [m].
    #[must_use]
    pub fn point(&self, column: usize, row: usize) -> Vec2 {
        let steps = Vec2::new(column as f64, row as f64);
        self.south_west + steps.component_mul(&self.spacing)
    }

    /// What the points span.
    #[must_use]
    pub fn extent(&self) -> Extent {
        let north_east = self.point(self.columns.saturating_sub(1), self.rows.saturating_sub(1));
        Extent { south_west: self.south_west, north_east }
    }

    /// The number of points of a grid that can have a model.
    pub(in crate::terrain) fn checked_points(&self) -> Result<usize, ElevationError> {
        let Self { columns, rows, south_west, spacing } = *self;
        if columns < 2 || rows < 2 {
            return Err(ElevationError::TooFewPoints { columns, rows });
        }
        let is_length = |value: f64| value.is_finite() && value > 0.0;
        if !is_length(spacing.x) || !is_length(spacing.y) {
            return Err(ElevationError::Spacing { x: spacing.x, y: spacing.y });
        }
        let far = self.extent().north_east;
        if ![south_west.x, south_west.y, far.x, far.y].into_iter().all(f64::is_finite) {
            return Err(ElevationError::Place { x: south_west.x, y: south_west.y });
        }
        columns.checked_mul(rows).ok_or(ElevationError::TooManyPoints { columns, rows })
    }

    /// A place in cells from the first point: to the east and to the north.
    pub(super) fn place(&self, at: Vec2) -> [f64; 2] {
        self.cells(at - self.south_west)
    }

    /// A way [m] in cells, to the east and to the north.
    pub(in crate::terrain) fn cells(&self, way: Vec2) -> [f64; 2] {
        [way.x / self.spacing.x, way.y / self.spacing.y]
    }

    /// Column and row of the cell's point in the south-west; none for a place outside of the grid.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place between zero and the number of cells"
    )]
    pub(super) fn cell(&self, at: Vec2) -> Option<(usize, usize)> {
        // What the rounding of coordinates may take from a place on the edge [-].
        const EDGE: f64 = 1e-6;
        let cell = |place: f64, count: usize| {
            let last = (count - 1) as f64;
            (-EDGE..=last + EDGE).contains(&place).then(|| (place.max(0.0) as usize).min(count - 2))
        };
        let [column, row] = self.place(at);
        Some((cell(column, self.columns)?, cell(row, self.rows)?))
    }
}
