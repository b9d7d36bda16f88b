//! Gravities that documents and flags call by name.

use grouser_core::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY};

/// Gravities by name, with their values [m/s²].
pub const GRAVITIES: [(&str, f64); 3] =
    [("earth", EARTH_GRAVITY), ("moon", MOON_GRAVITY), ("mars", MARS_GRAVITY)];

/// A gravity [m/s²] by its name: `earth`, `moon` or `mars`.
#[must_use]
pub fn gravity(name: &str) -> Option<f64> {
    GRAVITIES.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}
