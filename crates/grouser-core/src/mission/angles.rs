//! Yaws on the way to a line.

/// The most yaw by which a rover is turned towards its line [rad]: 45°. Source: ours.
pub const MOST_CROSS_YAW: f64 = std::f64::consts::FRAC_PI_4;

/// A yaw from which a rover is led to a line: its own, or where that is farther from the line than
/// what leads back to it can turn the nose, the nearest that is not [rad].
///
/// * `along`: yaw of a nose along the line [rad]
pub(super) fn near_enough(yaw: f64, along: f64) -> f64 {
    let off = turned(yaw - along);
    if off.abs() <= MOST_CROSS_YAW {
        yaw
    } else {
        yaw - off + off.clamp(-MOST_CROSS_YAW, MOST_CROSS_YAW)
    }
}

/// An angle less its whole turns, from -π to π [rad].
pub(super) fn turned(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    angle - TAU * ((angle + PI) / TAU).floor()
}
