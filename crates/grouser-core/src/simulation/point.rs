//! A point of a run: all that is integrated.

use nalgebra::Vector3;

use super::power;
use super::turning::Turning;
use crate::vehicle::{Rover, RoverState};

/// What is integrated: the rover's state, the motors' work, the work on the soil, and the
/// electrical energy [J].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) state: RoverState,
    pub(super) motors: f64,
    pub(super) soil: f64,
    pub(super) electrical: f64,
    /// How the wheels turn, where that is not as they are set to.
    pub(super) turning: Option<Turning>,
}

impl Point {
    /// The start of a run.
    pub(super) fn start(rover: &Rover, state: RoverState, turning: Option<Turning>) -> Self {
        let mut point = Self { state, motors: 0.0, soil: 0.0, electrical: 0.0, turning };
        point.start_work(rover);
        point
    }

    /// Sets the work of the motors so far to zero. For wheels whose speed depends on their load, a
    /// record adds the spin, which is therefore taken off here.
    pub(super) fn start_work(&mut self, rover: &Rover) {
        self.motors = self.turning.map_or(0.0, |turning| {
            let wheel_speeds: Vec<f64> = rover.wheel_speeds(turning.rim_speeds()).collect();
            -power::spin_energy(rover, &wheel_speeds)
        });
    }

    /// *(u, v, γ')* [m/s, m/s, rad/s], in the body frame.
    pub(super) fn velocities(&self) -> Vector3<f64> {
        let RoverState { velocity, yaw_rate, .. } = self.state;
        Vector3::new(velocity.x, velocity.y, yaw_rate)
    }

    /// Changes pose and velocities at once. What that changes in kinetic energy counts as work of
    /// the motors.
    pub(super) fn jump(&mut self, rover: &Rover, change: impl FnOnce(&mut RoverState)) {
        let before = power::kinetic_energy(rover, &self.state);
        change(&mut self.state);
        self.motors += power::kinetic_energy(rover, &self.state) - before;
    }
}
