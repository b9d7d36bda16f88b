//! Permitted settings of wheel tests, heading maps and routes.

use std::ops::RangeInclusive;

use super::unit::DIRECTION_DEG;

/// Loads that a wheel test may ask for [N].
pub const LOAD_N: RangeInclusive<f64> = 0.0..=1e5;
/// Slip ratios that a wheel test may ask for [-].
pub const SLIP_RATIO: RangeInclusive<f64> = -2.0..=2.0;
/// Slip angles that a wheel test may ask for [°].
pub const SLIP_ANGLE_DEG: RangeInclusive<f64> = -90.0..=90.0;

/// Courses that a heading map may ask for [°].
pub const COURSE_DEG: RangeInclusive<f64> = -90.0..=90.0;
/// Rim speeds that a heading map may ask for [m/s].
pub const MAP_SPEED_M_S: RangeInclusive<f64> = 1e-6..=10.0;

/// Slopes that a route may be limited to [°].
pub const MOST_SLOPE_DEG: RangeInclusive<f64> = 0.0..=60.0;
/// Slip ratios, and shares of samples, that a route may be limited to [-].
pub const SHARE: RangeInclusive<f64> = 0.0..=1.0;
/// Yaws at the start of a route [°], of which whole turns do not count.
pub const START_YAW_DEG: RangeInclusive<f64> = DIRECTION_DEG;
