//! The motion of each hub ([FourWheel], Eqs 2-3) and the slip of each wheel (Eqs 15-17).

use super::parts::Mount;
use super::rover::Rover;
use super::state::RoverState;
use crate::contact::Slip;
use crate::elementary::wide::{asin, atan2};
use crate::units::Vec2;

/// Velocity of a hub, in the body frame [m/s]: v_x = u − γ' d_y, v_y = v + γ' d_x, with the yaw
/// rate γ'.
///
/// * `arm`: the hub seen from the body's centre of mass, in the body frame, *d* [m]
#[must_use]
pub fn hub_velocity(state: &RoverState, arm: Vec2) -> Vec2 {
    state.velocity + state.yaw_rate * Vec2::new(-arm.y, arm.x)
}

/// Velocity of a wheel's hub, in the wheel's own frame [m/s].
#[must_use]
pub fn wheel_velocity(state: &RoverState, mount: &Mount) -> Vec2 {
    mount.wheel_from_body(hub_velocity(state, mount.position.xy()))
}

/// Steering angle at which a wheel rolls without sideslip, *δ* [rad], from −π/2 to π/2: its axle
/// points to the centre about which the rover turns (Ackermann).
///
/// ```text
/// |u| sin(φ − δ) = γ' k_x        u = (|u| cos φ, |u| sin φ)
/// ```
///
/// with *u* the velocity of the kingpin, which does not move with δ, and *k* the kingpin offset:
/// the hub's velocity then is along the wheel. A wheel that goes backward has its tail in that
/// direction.
///
/// * `state`: of which the velocities count
#[must_use]
pub fn rolling_angle(state: &RoverState, mount: &Mount) -> f64 {
    let (offset, shift) = mount.steering_axis.map_or((Vec2::zeros(), Vec2::zeros()), |axis| {
        (axis.kingpin_offset, axis.hub_shift(mount.steering))
    });
    let kingpin = mount.position.xy() - shift + offset;
    let velocity = hub_velocity(state, kingpin);
    let sense = if velocity.x < 0.0 { -1.0 } else { 1.0 };
    let speed = velocity.norm();
    if speed == 0.0 {
        return 0.0;
    }
    let direction = atan2(sense * velocity.y, sense * velocity.x);
    let side = (sense * state.yaw_rate * offset.x / speed).clamp(-1.0, 1.0);
    direction - asin(side)
}

/// Mean velocity of wheels that roll without slip, in the body frame [m/s].
///
/// * `rim_speeds`: ω r_s of each wheel [m/s]
#[must_use]
pub fn rolling_velocity(mounts: &[Mount], rim_speeds: &[f64]) -> Vec2 {
    let each = mounts.iter().zip(rim_speeds);
    let along = |(mount, rim): (&Mount, &f64)| mount.body_from_wheel(Vec2::new(*rim, 0.0));
    each.map(along).sum::<Vec2>() / mounts.len() as f64
}

/// Velocity of the body's centre of mass [m/s] and yaw rate [rad/s] of a rover that follows its rims
/// as well as a rigid body can, in the body frame.
///
/// Where wheels are steered it is the rigid motion whose velocities at the hubs come nearest to
/// those of wheels that roll without slip, to which side forces hold them as well; where none is,
/// the rims alone count.
///
/// * `rim_speeds`: ω r_s of each wheel [m/s]
#[must_use]
pub fn rolling_motion(mounts: &[Mount], rim_speeds: &[f64]) -> (Vec2, f64) {
    let count = rim_speeds.len() as f64;
    let mean = mounts.iter().map(|mount| mount.position.xy()).sum::<Vec2>() / count;
    if mounts.iter().any(|mount| mount.steering != 0.0) {
        return rolling_steered(mounts, rim_speeds, mean);
    }
    let mean_rim = rim_speeds.iter().sum::<f64>() / count;
    let (mut across, mut spread) = (0.0, 0.0);
    for (mount, rim) in mounts.iter().zip(rim_speeds) {
        let arm = mount.position.y - mean.y;
        across -= arm * (rim - mean_rim);
        spread += arm * arm;
    }
    let rate = if spread > 0.0 { across / spread } else { 0.0 };
    (Vec2::new(mean_rim + rate * mean.y, -rate * mean.x), rate)
}

/// * `mean`: of the hubs [m]
fn rolling_steered(mounts: &[Mount], rim_speeds: &[f64], mean: Vec2) -> (Vec2, f64) {
    let rolled = |mount: &Mount, rim: f64| mount.body_from_wheel(Vec2::new(rim, 0.0));
    let velocities = mounts.iter().zip(rim_speeds).map(|(mount, rim)| rolled(mount, *rim));
    let mean_velocity = rolling_velocity(mounts, rim_speeds);
    let (mut turning, mut spread) = (0.0, 0.0);
    for (mount, velocity) in mounts.iter().zip(velocities) {
        let arm = mount.position.xy() - mean;
        turning += arm.perp(&velocity);
        spread += arm.norm_squared();
    }
    let rate = turning / spread;
    (mean_velocity - rate * Vec2::new(-mean.y, mean.x), rate)
}

/// The slip of every wheel.
///
/// * `rim_speeds`: ω r_s of each wheel [m/s]
pub fn wheel_slips<'a>(
    rover: &'a Rover,
    state: &'a RoverState,
    rim_speeds: &'a [f64],
) -> impl Iterator<Item = Slip> + 'a {
    rover
        .mounts()
        .iter()
        .zip(rim_speeds)
        .map(|(mount, &rim_speed)| Slip::of_motion(rim_speed, wheel_velocity(state, mount)))
}
