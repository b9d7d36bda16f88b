//! The motion of each hub ([FourWheel], Eqs 2-3) and the slip of each wheel (Eqs 15-17).

use super::rover::Rover;
use super::state::RoverState;
use crate::contact::Slip;
use crate::units::Vec2;

/// Velocity of a hub, in the body frame [m/s]: v_x = u − γ̇ d_y, v_y = v + γ̇ d_x.
///
/// * `arm`: the hub seen from the body's centre of mass, in the body frame, *d* [m]
#[must_use]
pub fn hub_velocity(state: &RoverState, arm: Vec2) -> Vec2 {
    state.velocity + state.yaw_rate * Vec2::new(-arm.y, arm.x)
}

/// The slip of every wheel; wheel frames are parallel to the body's, for no wheel is steered.
///
/// * `rim_speeds`: ω r_s of each wheel [m/s]
pub fn wheel_slips<'a>(
    rover: &'a Rover,
    state: &'a RoverState,
    rim_speeds: &'a [f64],
) -> impl Iterator<Item = Slip> + 'a {
    rover.mounts().iter().zip(rim_speeds).map(|(mount, &rim_speed)| {
        Slip::of_motion(rim_speed, hub_velocity(state, mount.position.xy()))
    })
}
