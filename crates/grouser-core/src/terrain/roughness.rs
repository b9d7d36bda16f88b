//! How rough heights of a grid are, by the distance between their points.

use super::ElevationGrid;
use crate::elementary::wide;
use crate::units::Vec2;

/// Differences of height between points of one distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The distance, along rows and columns [m].
    pub baseline: f64,
    /// Root mean square of the differences (Allan deviation) [m].
    pub rms_deviation: f64,
    /// Median of the slopes of the ground, each by the differences to the east and to the north
    /// [rad].
    pub median_slope: f64,
}

impl Deviation {
    /// The inclination whose tangent is the root mean square of the slopes along rows and columns
    /// [rad].
    #[must_use]
    pub fn rms_slope(&self) -> f64 {
        wide::atan2(self.rms_deviation, self.baseline)
    }
}

/// The deviations of heights at distances of 1, 2, 4, … cells, as far as a quarter of the grid.
///
/// * `heights`: at the points of a grid of square cells [m], in their order
#[must_use]
pub fn deviations(grid: &ElevationGrid, heights: &[f64]) -> Vec<Deviation> {
    let most = grid.columns.min(grid.rows) / 4;
    std::iter::successors(Some(1), |cells| Some(2 * cells))
        .take_while(|cells| *cells <= most)
        .map(|cells| deviation(grid, heights, cells))
        .collect()
}

fn deviation(grid: &ElevationGrid, heights: &[f64], cells: usize) -> Deviation {
    let baseline = cells as f64 * grid.spacing.x;
    let at = |column: usize, row: usize| heights[row * grid.columns + column];
    let (mut squares, mut slopes) = (0.0, Vec::new());
    for row in 0..grid.rows - cells {
        for column in 0..grid.columns - cells {
            let here = at(column, row);
            let rise = Vec2::new(at(column + cells, row) - here, at(column, row + cells) - here);
            squares += rise.norm_squared();
            slopes.push(rise.norm() / baseline);
        }
    }
    let middle = slopes.len() / 2;
    let (_, median, _) = slopes.select_nth_unstable_by(middle, f64::total_cmp);
    let median_slope = wide::atan2(*median, 1.0);
    let rms_deviation = (0.5 * squares / slopes.len() as f64).sqrt();
    Deviation { baseline, rms_deviation, median_slope }
}
