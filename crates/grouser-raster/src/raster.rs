//! A grid of heights as a file has it.

use grouser_core::terrain::lunar::LunarModel;
use grouser_core::terrain::{ElevationError, ElevationGrid, ElevationModel, Extent};
use grouser_core::units::Vec2;

use crate::{CoordinateSystem, Remark};

/// Heights at the points of a grid, with the coordinate system of their file.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// The points.
    pub grid: ElevationGrid,
    /// What the heights are above [m].
    pub base: f64,
    /// Heights above the base [m], in rows from south to north, each from west to east; NaN where
    /// they are missing.
    pub heights: Vec<f32>,
    /// The system of the coordinates, as the file has it.
    pub coordinates: CoordinateSystem,
    /// What is odd about them.
    pub remarks: Vec<Remark>,
}

impl Raster {
    /// What it spans, and how far apart its points are, in words.
    #[must_use]
    pub fn spans(&self) -> String {
        // Less is the rounding of places.
        let shown = |length: f64| (1e3 * length).round() / 1e3;
        let Extent { south_west: low, north_east: high } = self.grid.extent();
        let [west, east, south, north] = [low.x, high.x, low.y, high.y].map(shown);
        let [x, y] = [self.grid.spacing.x, self.grid.spacing.y].map(shown);
        let apart = if x == y { format!("{x} m") } else { format!("{x} m (x) and {y} m (y)") };
        format!(
            "x from {west} to {east} m, y from {south} to {north} m, {} x {} points {apart} apart",
            self.grid.columns, self.grid.rows
        )
    }

    /// A piece of made lunar ground, as a file has it: in a projection of the Moon's, about a place
    /// of no meaning.
    #[must_use]
    pub fn of_moon(model: &LunarModel) -> Self {
        #[expect(clippy::cast_possible_truncation, reason = "the precision of elevation models")]
        let heights = model.heights.iter().map(|height| *height as f32).collect();
        let coordinates =
            CoordinateSystem::of_the_moon([0.0, 0.0], "made lunar ground (no place of the Moon)");
        Self { grid: model.grid, base: 0.0, heights, coordinates, remarks: Vec::new() }
    }

    /// The height at a point [m]; none where it is missing, or beyond the grid.
    #[must_use]
    pub fn height(&self, column: usize, row: usize) -> Option<f64> {
        self.above(column, row).map(|above| self.base + above)
    }

    /// Column and row of the point whose cell has a place [m]; none beyond the map.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is not negative, and below the number of columns or rows"
    )]
    pub fn cell_of(&self, place: Vec2) -> Option<[usize; 2]> {
        let grid = &self.grid;
        let way = (place - grid.south_west).component_div(&grid.spacing);
        let [column, row] = [way.x, way.y].map(|steps| (steps + 0.5).floor());
        let is_inside = |step: f64, count: usize| step >= 0.0 && step < count as f64;
        let is_there = is_inside(column, grid.columns) && is_inside(row, grid.rows);
        is_there.then_some([column as usize, row as usize])
    }

    /// How steeply the ground rises at a point to the east and to the north [m/m], between its
    /// neighbours on both sides; from the point itself where one of them is missing. None where the
    /// point's own height is missing, or both neighbours' in one direction.
    ///
    /// * `reach`: how far the neighbours are to the east and to the north, in points, 1 or more
    #[must_use]
    pub fn gradient(&self, column: usize, row: usize, reach: [usize; 2]) -> Option<Vec2> {
        let here = self.above(column, row)?;
        let rise = |before: Option<f64>, after: Option<f64>, distance: f64| match (before, after) {
            (Some(before), Some(after)) => Some((after - before) / (2.0 * distance)),
            (Some(before), None) => Some((here - before) / distance),
            (None, Some(after)) => Some((after - here) / distance),
            (None, None) => None,
        };
        let [east, north] = reach;
        let west_of = column.checked_sub(east).and_then(|column| self.above(column, row));
        let south_of = row.checked_sub(north).and_then(|row| self.above(column, row));
        let spacing = self.grid.spacing;
        let x = rise(west_of, self.above(column + east, row), east as f64 * spacing.x)?;
        let y = rise(south_of, self.above(column, row + north), north as f64 * spacing.y)?;
        Some(Vec2::new(x, y))
    }

    /// The height above the base.
    fn above(&self, column: usize, row: usize) -> Option<f64> {
        if column >= self.grid.columns || row >= self.grid.rows {
            return None;
        }
        let above = self.heights.get(row * self.grid.columns + column)?;
        above.is_finite().then(|| f64::from(*above))
    }

    /// The elevation model to drive on.
    ///
    /// # Errors
    /// [`ElevationError`] if the grid is too small, or no height is known.
    pub fn model(self) -> Result<ElevationModel, ElevationError> {
        ElevationModel::above_base(self.grid, self.base, self.heights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of a parabola along x and a line along y, one of them missing.
    fn raster() -> Raster {
        let grid = ElevationGrid {
            columns: 5,
            rows: 4,
            south_west: Vec2::new(100.0, 200.0),
            spacing: Vec2::new(2.0, 0.5),
        };
        let height = |at: Vec2| (at.x - 100.0) * (at.x - 100.0) + 3.0 * (at.y - 200.0);
        #[expect(clippy::cast_possible_truncation, reason = "small whole numbers")]
        let mut heights: Vec<f32> = grid.points().map(|at| height(at) as f32).collect();
        heights[2 * 5 + 2] = f32::NAN;
        let coordinates = CoordinateSystem::default();
        Raster { grid, base: 7.0, heights, coordinates, remarks: Vec::new() }
    }

    #[test]
    fn a_gradient_is_that_between_the_neighbours() {
        let raster = raster();
        assert_eq!(raster.gradient(1, 1, [1, 1]), Some(Vec2::new(4.0, 3.0)));
        assert_eq!(raster.gradient(2, 0, [2, 1]), Some(Vec2::new(8.0, 3.0)));
        assert_eq!(raster.height(1, 1), Some(7.0 + 4.0 + 1.5));
    }

    #[test]
    fn beside_the_edge_and_beside_a_gap_it_is_one_sided() {
        let raster = raster();
        assert_eq!(raster.gradient(0, 1, [1, 1]), Some(Vec2::new(2.0, 3.0)));
        assert_eq!(raster.gradient(4, 3, [1, 1]), Some(Vec2::new(14.0, 3.0)));
        assert_eq!(raster.gradient(1, 2, [1, 1]), Some(Vec2::new(2.0, 3.0)));
        assert_eq!(raster.gradient(2, 2, [1, 1]), None);
        assert_eq!(raster.gradient(2, 1, [9, 1]), None);
    }
}
