//! Whether places are degrees of longitude and latitude, where no system says what they are.

use grouser_core::terrain::Extent;

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
