//! Doors into SI for tests, presets and examples: write what the source prints.
//!
//! Inside Grouser every quantity is in SI units and every angle in radians. These functions say,
//! at the place where a number enters, in which unit it was printed.

/// The joint name of plane vectors: x and y components, SI units, frame named by the owner.
pub type Vec2 = nalgebra::Vector2<f64>;
/// The joint name of spatial vectors: x, y and z components, SI units, frame named by the owner.
pub type Vec3 = nalgebra::Vector3<f64>;

/// An angle printed in degrees, in radians.
#[must_use]
pub fn deg(degrees: f64) -> f64 {
    degrees.to_radians()
}

/// A length printed in millimetres, in metres.
#[must_use]
pub fn mm(millimetres: f64) -> f64 {
    millimetres * 1e-3
}

/// A pressure printed in kilopascals, in pascals.
#[must_use]
pub fn kpa(kilopascals: f64) -> f64 {
    kilopascals * 1e3
}

/// The steepest slope that is looked at [rad]: 60°. Source: ours; no loose soil stands as steep for
/// long.
pub const STEEPEST_SLOPE: f64 = std::f64::consts::FRAC_PI_3;

/// Standard gravity, [m/s²]. Source: 3rd General Conference on Weights and Measures, 1901.
pub const EARTH_GRAVITY: f64 = 9.80665;
/// Mean surface gravity of the Moon, [m/s²]. Source: NASA planetary fact sheet, rounded.
pub const MOON_GRAVITY: f64 = 1.62;
/// Mean surface gravity of Mars, [m/s²]. Source: NASA planetary fact sheet, rounded.
pub const MARS_GRAVITY: f64 = 3.71;
