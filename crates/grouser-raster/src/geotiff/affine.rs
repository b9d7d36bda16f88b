//! From the raster to the map.

use grouser_core::units::Vec2;

/// Place on the map of a place in the raster, whose columns and rows are counted from the corner in
/// front:
///
/// ```text
/// x = x_0 + a column + b row        y = y_0 + c column + d row
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Affine {
    pub(super) x0: f64,
    pub(super) y0: f64,
    pub(super) a: f64,
    pub(super) b: f64,
    pub(super) c: f64,
    pub(super) d: f64,
}

impl Affine {
    /// Whether it leads to places, each from one place of the raster.
    pub(super) fn is_regular(&self) -> bool {
        let Self { x0, y0, a, b, c, d } = *self;
        [x0, y0, a, b, c, d].into_iter().all(f64::is_finite) && a * d - b * c != 0.0
    }

    /// The place on the map of the middle of a cell.
    pub(super) fn middle(&self, column: f64, row: f64) -> Vec2 {
        let (column, row) = (column + 0.5, row + 0.5);
        let x = self.x0 + self.a * column + self.b * row;
        Vec2::new(x, self.y0 + self.c * column + self.d * row)
    }
}
