//! Steering angles that a motion of the rover needs.

use crate::units::Vec2;
use crate::vehicle::kinematics::rolling_angle;
use crate::vehicle::{Mount, Rover, RoverState};

/// The velocities of a rover that goes forward and turns about a centre beside it [m/s], [rad/s]:
/// beside the middle of the wheels that are not steered, so that these roll, or beside its own
/// where all are.
///
/// * `forward`, `rate`: speed along the body [m/s], and yaw rate [rad/s]
pub(super) fn ackermann_motion(rover: &Rover, [forward, rate]: [f64; 2]) -> RoverState {
    let fixed = rover.mounts().iter().filter(|mount| mount.steering_axis.is_none());
    let (sum, count) =
        fixed.fold((0.0, 0), |(sum, count), mount| (sum + mount.position.x, count + 1));
    let beside = if count == 0 { 0.0 } else { sum / f64::from(count) };
    let velocity = Vec2::new(forward, -rate * beside);
    RoverState { velocity, yaw_rate: rate, ..RoverState::default() }
}

/// Steering angles at which the axles of all wheels that are steered point to the centre of a turn
/// [rad].
///
/// * `forward`, `rate`: as for [`ackermann_motion`]
pub(super) fn ackermann_angles(rover: &Rover, motion: [f64; 2]) -> Vec<f64> {
    let motion = ackermann_motion(rover, motion);
    each_steered(rover, |mount| rolling_angle(&motion, mount))
}

/// One angle for all wheels that are steered [rad].
pub(super) fn crab_angles(rover: &Rover, angle: f64) -> Vec<f64> {
    each_steered(rover, |_| angle)
}

/// The angle of each wheel: that of a function where it is steered, else its own [rad].
fn each_steered(rover: &Rover, angle: impl Fn(&Mount) -> f64) -> Vec<f64> {
    let of = |mount: &Mount| mount.steering_axis.map_or(mount.steering, |_| angle(mount));
    rover.mounts().iter().map(of).collect()
}

/// Angles as near to these as the wheels' limits allow [rad].
pub(super) fn within_limits(rover: &Rover, angles: &mut [f64]) {
    for (angle, mount) in angles.iter_mut().zip(rover.mounts()) {
        if let Some(axis) = mount.steering_axis {
            *angle = angle.clamp(-axis.limit, axis.limit);
        }
    }
}
