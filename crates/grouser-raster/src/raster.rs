//! A grid of heights as a file has it.

use grouser_core::soil::Soil;
use grouser_core::terrain::{ElevationError, ElevationGrid, ElevationModel};

use crate::CoordinateSystem;

/// Heights at the points of a grid, with the coordinate system of their file.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// The points.
    pub grid: ElevationGrid,
    /// What the heights are above [m].
    pub base: f64,
    /// Heights above the base [m], in rows from south to north, each from west to east; NaN where they are
    /// missing.
    pub heights: Vec<f32>,
    /// The system of the coordinates, as the file has it.
    pub coordinates: CoordinateSystem,
}

impl Raster {
    /// The height at a point [m]; none where it is missing, or beyond the grid.
    #[must_use]
    pub fn height(&self, column: usize, row: usize) -> Option<f64> {
        let inside = column < self.grid.columns && row < self.grid.rows;
        let above = inside.then(|| self.heights.get(row * self.grid.columns + column)).flatten()?;
        above.is_finite().then(|| self.base + f64::from(*above))
    }

    /// The elevation model to drive on, with one soil.
    ///
    /// # Errors
    /// [`ElevationError`] if the grid is too small, no height is known, or there is no such soil.
    pub fn model(self, soil: Soil) -> Result<ElevationModel, ElevationError> {
        ElevationModel::above_base(self.grid, self.base, self.heights, soil)
    }
}
