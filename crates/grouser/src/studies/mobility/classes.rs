//! Classes of slopes, and the places for which advice is given.

use super::super::heading::STRAIGHT_UP;
use crate::elementary::wide::atan2;
use crate::units::STEEPEST_SLOPE;
use grouser_io::unit::DEG;

/// The steepest slope of each class [rad]: whole degrees.
pub(super) fn classes() -> impl Iterator<Item = f64> {
    (0_u32..).map(|degree| DEG.to_si(f64::from(degree))).take_while(|it| *it <= STEEPEST_SLOPE)
}

/// The class of a slope [rad]: the whole degree above it, and the steepest for all beyond.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a slope is not negative, and the steepest is small"
)]
pub fn class_of(slope: f64) -> usize {
    /// So much above a whole degree is the rounding of heights [°].
    const ROUNDING: f64 = 0.01;
    let steepest = DEG.from_si(STEEPEST_SLOPE);
    (DEG.from_si(slope) - ROUNDING).ceil().clamp(0.0, steepest) as usize
}

/// Slope and course [rad] of a way over ground that rises along it, and across it [m/m].
#[must_use]
pub fn slope_and_course(along: f64, across: f64) -> (f64, f64) {
    let rise = (along * along + across * across).sqrt();
    if rise == 0.0 {
        return (0.0, 0.0);
    }
    // On the slope itself the way up is longer than on the map.
    let steepness = (1.0 + rise * rise).sqrt();
    (atan2(rise, 1.0), atan2(along * steepness, across.abs()))
}

/// Slope and course [rad] for which advice is given to a way on a map: the slope is that of its
/// class, the course is to a degree.
#[must_use]
pub fn advised_place((slope, course): (f64, f64)) -> (f64, f64) {
    let degrees = DEG.from_si(course).round();
    (DEG.to_si(class_of(slope) as f64), DEG.to_si(degrees).clamp(-STRAIGHT_UP, STRAIGHT_UP))
}
