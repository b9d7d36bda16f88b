//! The energy balance of a run: what the motors put in, and where it went.

use crate::contact::WheelForces;
use crate::terrain::Ground;
use crate::units::Vec2;
use crate::vehicle::load;
use crate::vehicle::on_ground::forces_of;
use crate::vehicle::posture::StandingMotion;
use crate::vehicle::{Electrical, Mount, OwnMoments, Rover, RoverState, WheelReaction};

/// Energy since the start of a run [J].
///
/// ```text
/// motors = soil + (kinetic − kinetic at the start) + (potential − potential at the start)
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyBalance {
    /// Work of the motors, Σ∫ T ω dt, and what it takes to change the wheels' spin.
    pub motors: f64,
    /// Work done on the soil, Σ∫ (T ω − F·v) dt.
    pub soil: f64,
    /// Kinetic energy of body and wheels, the wheels' spin included.
    pub kinetic: f64,
    /// Potential energy on the slope, zero at the origin's height.
    pub potential: f64,
    /// Electrical energy that the motors took, of the wheels whose motors are known. It is no part
    /// of the balance: what is more than the motors' work is lost in them.
    pub electrical: f64,
}

/// Power of the motors and into the soil [W].
///
/// * `wheel_speeds`: ω of each wheel [rad/s]
/// * `hub_velocities`: of each hub, in the wheel's frame [m/s]
/// * `aligning_work_rate`: yaw rate where aligning moments act on a rover on a plane, else 0
///   [rad/s]
#[must_use]
pub fn powers(
    wheels: &[WheelReaction],
    wheel_speeds: &[f64],
    hub_velocities: impl Iterator<Item = Vec2>,
    aligning_work_rate: f64,
) -> (f64, f64) {
    let (mut motors, mut soil) = (0.0, 0.0);
    for ((wheel, wheel_speed), velocity) in wheels.iter().zip(wheel_speeds).zip(hub_velocities) {
        let forces = &wheel.settled.forces;
        let motor = forces.torque * wheel_speed;
        let pull = forces.drawbar_pull * velocity.x + forces.side_force * velocity.y;
        motors += motor;
        soil += motor - pull - forces.aligning_moment * aligning_work_rate;
    }
    (motors, soil)
}

/// Power that the soil gives a rover on uneven ground beside its forces along it [W]: by the normal
/// forces on hubs that rise or sink, as those of a rigid rover on warped ground do, and by moments
/// that act on the rover.
pub(super) fn beside_the_ground(
    wheels: &[WheelReaction],
    motion: &StandingMotion,
    own_moments: OwnMoments,
) -> f64 {
    let each = forces_of(wheels).zip(&motion.rises).zip(&motion.leans);
    let of_one = |((forces, rise), lean): ((&WheelForces, &f64), &Vec2)| {
        let of_moments = match own_moments {
            OwnMoments::Neglected => 0.0,
            OwnMoments::Included => {
                forces.overturning_moment * lean.x + forces.aligning_moment * lean.y
            }
        };
        forces.normal_force * rise + of_moments
    };
    each.map(of_one).sum()
}

/// Electrical power of the motors that are known [W].
#[must_use]
pub fn electrical_power(rover: &Rover, wheels: &[WheelReaction], wheel_speeds: &[f64]) -> f64 {
    let each = rover.mounts().iter().zip(wheels).zip(wheel_speeds);
    each.filter_map(|((mount, wheel), speed)| {
        Some(electrical(mount, wheel.settled.forces.torque, *speed)?.power)
    })
    .sum()
}

/// What a wheel's motor takes, where that is known, at a torque [N·m] and a speed of the wheel
/// [rad/s].
#[must_use]
pub fn electrical(mount: &Mount, torque: f64, wheel_speed: f64) -> Option<Electrical> {
    Some(mount.unit.motor?.at(torque, wheel_speed))
}

/// Kinetic energy of the rover as one rigid body [J], without the wheels' spin.
#[must_use]
pub fn kinetic_energy(rover: &Rover, state: &RoverState) -> f64 {
    let (v, rate) = (state.velocity, state.yaw_rate);
    0.5 * rover.mass() * v.norm_squared()
        + rate * rover.first_moment().perp(&v)
        + 0.5 * rover.yaw_inertia() * rate * rate
}

/// Energy in the wheels' spin [J].
///
/// * `wheel_speeds`: ω of each wheel [rad/s]
#[must_use]
pub fn spin_energy(rover: &Rover, wheel_speeds: &[f64]) -> f64 {
    let each = rover.mounts().iter().map(|mount| mount.unit.inertia.yy).zip(wheel_speeds);
    each.map(|(inertia, speed)| 0.5 * inertia * speed * speed).sum()
}

/// Potential energy on a plane [J]; what the rover sinks does not count.
///
/// * `gravity`: *g* [m/s²]
#[must_use]
pub fn potential_energy(rover: &Rover, ground: &Ground, gravity: f64, state: &RoverState) -> f64 {
    let slope_from_body = state.slope_from_body();
    let centre = state.position + slope_from_body * rover.centre_of_mass();
    load::weight(rover, ground, gravity, state, &slope_from_body).uphill.dot(&centre)
}
