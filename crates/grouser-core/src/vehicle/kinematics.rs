//! The motion of each hub ([FourWheel], Eqs 2-3) and the slip of each wheel (Eqs 15-17).

use super::rover::{Mount, Rover};
use super::state::RoverState;
use crate::contact::Slip;
use crate::units::Vec2;

/// Velocity of a hub, in the body frame [m/s]: v_x = u − γ' d_y, v_y = v + γ' d_x, with the yaw rate γ'.
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

/// Mean velocity of wheels that roll without slip, in the body frame [m/s].
///
/// * `rim_speeds`: ω r_s of each wheel [m/s]
#[must_use]
pub fn rolling_velocity(mounts: &[Mount], rim_speeds: &[f64]) -> Vec2 {
    let each = mounts.iter().zip(rim_speeds);
    let along = |(mount, rim): (&Mount, &f64)| mount.body_from_wheel(Vec2::new(*rim, 0.0));
    each.map(along).sum::<Vec2>() / mounts.len() as f64
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
