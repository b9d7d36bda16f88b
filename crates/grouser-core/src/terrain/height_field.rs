//! Heights over a grid.

use crate::units::Vec2;

/// Heights at the points of a grid, bilinear between them; beyond its edges it goes on as high as
/// there.
///
/// How high is the ground half-way between the points of a grid of 2 m by 1 m, whose heights are in
/// centimetres?
///
/// ```
/// use grouser_core::terrain::HeightField;
/// use grouser_core::units::Vec2;
///
/// let heights = [
///     0.0, 1.0, 0.0, // at y = −0.5 m
///     0.0, 2.0, 4.0, // at y = 0.5 m
/// ];
/// let field = HeightField::new(&heights, 3, Vec2::new(1.0, 0.5), 0.01).expect("two rows of three");
/// let height = field.height(Vec2::new(0.5, 0.0));
/// assert_eq!(format!("{:.1} mm", 1e3 * height), "17.5 mm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightField<'a> {
    /// Heights, in units of [`unit`](Self::unit): rows along x, one after the other along y.
    heights: &'a [f32],
    columns: usize,
    rows: usize,
    /// Half of its size along x and y [m].
    half_size: Vec2,
    /// What a height of 1 means [m].
    unit: f64,
}

impl<'a> HeightField<'a> {
    /// The field of a grid about the origin; none if that has fewer than two points along an axis,
    /// or not as many heights as points.
    ///
    /// * `heights`: of points in rows along x, one after the other along y
    /// * `columns`: points in a row
    /// * `half_size`: half of its size along x and y [m]
    /// * `unit`: what a height of 1 means [m]
    #[must_use]
    pub fn new(heights: &'a [f32], columns: usize, half_size: Vec2, unit: f64) -> Option<Self> {
        let rows = heights.len().checked_div(columns)?;
        let is_grid = columns >= 2 && rows >= 2 && rows * columns == heights.len();
        is_grid.then_some(Self { heights, columns, rows, half_size, unit })
    }

    /// Height at a place [m].
    #[must_use]
    pub fn height(&self, at: Vec2) -> f64 {
        let place = |x: f64, half: f64, count: usize| (x / half + 1.0) * (0.5 * (count - 1) as f64);
        let (u, column) = cell(place(at.x, self.half_size.x, self.columns), self.columns);
        let (v, row) = cell(place(at.y, self.half_size.y, self.rows), self.rows);
        let along = |row: usize| {
            let start = row * self.columns + column;
            let [near, far] = [start, start + 1].map(|point| f64::from(self.heights[point]));
            near * (1.0 - u) + far * u
        };
        self.unit * (along(row) * (1.0 - v) + along(row + 1) * v)
    }
}

/// How far [-] into which cell a place is, counted in cells.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a place between zero and the number of cells"
)]
fn cell(place: f64, count: usize) -> (f64, usize) {
    let inside = place.clamp(0.0, (count - 1) as f64);
    let cell = (inside as usize).min(count - 2);
    (inside - cell as f64, cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_are_bilinear_and_go_on_beyond_the_edges() {
        let heights = [0.0, 1.0, 0.0, 0.0, 2.0, 4.0];
        let field = HeightField::new(&heights, 3, Vec2::new(1.0, 0.5), 0.1).expect("a grid");
        let height = |x: f64, y: f64| field.height(Vec2::new(x, y));
        for (x, y, expected) in [
            (-1.0, -0.5, 0.0),
            (0.0, -0.5, 0.1),
            (1.0, 0.5, 0.4),
            (-0.5, -0.5, 0.05),
            (0.5, 0.0, 0.175),
            (7.0, 9.0, 0.4),
            (-7.0, -9.0, 0.0),
        ] {
            assert!((height(x, y) - expected).abs() < 1e-15, "{} at {x}, {y}", height(x, y));
        }
    }

    #[test]
    fn what_is_no_grid_is_no_field() {
        for (count, columns) in [(6, 4), (3, 3), (6, 0), (2, 1), (0, 2)] {
            let heights = vec![0.0; count];
            assert!(HeightField::new(&heights, columns, Vec2::new(1.0, 1.0), 1.0).is_none());
        }
    }
}
