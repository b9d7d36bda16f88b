//! Whether places are degrees of longitude and latitude, where no system says what they are.

use grouser_core::terrain::{ElevationGrid, Extent};

use crate::error::Fault;

/// Whether places could be degrees of longitude and latitude.
pub(crate) fn may_be_degrees(places: &Extent) -> bool {
    places.south_west.x >= -360.0
        && places.north_east.x <= 360.0
        && places.south_west.y >= -90.0
        && places.north_east.y <= 90.0
}

/// Whether places are degrees of longitude and latitude rather than metres from a start: less than
/// a metre across and a hundred times as far away, or all within a millimetre, as those near 0°, 0°
/// are. Source: ours.
pub(crate) fn are_degrees(places: &Extent) -> bool {
    let size = places.north_east - places.south_west;
    let across = size.x.max(size.y);
    let middle = places.south_west + 0.5 * size;
    let is_small = across > 0.0 && across < 1.0;
    let is_far = middle.norm() > 100.0 * across;
    may_be_degrees(places) && is_small && (is_far || across < 1e-3)
}

/// Checks that the points of a grid without a system are not in degrees of longitude and latitude:
/// points of a tile of a degree, read as metres, are less than a centimetre apart and far from 0.
/// Source: ours.
///
/// # Errors
/// [`Fault::PointsInDegrees`] if they are.
pub fn check_grid(grid: &ElevationGrid) -> Result<(), Fault> {
    /// Cells of elevation models in degrees are smaller [°].
    const CELL: f64 = 0.01;
    /// A tile is larger [°].
    const TILE: f64 = 0.9;
    /// How far its middle is from 0, at least, over the size [-].
    const FAR: f64 = 5.0;
    let extent = grid.extent();
    let size = extent.north_east - extent.south_west;
    let middle = extent.south_west + 0.5 * size;
    let is_tile = may_be_degrees(&extent)
        && grid.spacing.x.max(grid.spacing.y) < CELL
        && size.x.max(size.y) > TILE
        && middle.norm() > FAR * size.x.max(size.y);
    if is_tile || are_degrees(&extent) { Err(Fault::PointsInDegrees) } else { Ok(()) }
}
