//! Carries the motion through time.
//!
//! `dormand_prince` takes an explicit step and `rosenbrock` an implicit one, with the coefficients of
//! `rodas5p`; `adaptive` chooses between them, and how long a `step` is. `runge_kutta` is the
//! independent check on them.

mod adaptive;
mod dormand_prince;
#[cfg(test)]
mod order_conditions;
mod rodas5p;
mod rosenbrock;
mod runge_kutta;
mod step;

use std::ops::ControlFlow;

pub(super) use adaptive::{History, adaptive};
pub(super) use runge_kutta::rk4;

use super::equations::{Equations, Rates};
use super::power;
use crate::units::Vec2;
use crate::vehicle::{Acceleration, Rover, RoverState};

/// How many numbers move: pose, velocities, and the three energies.
const SIZE: usize = 9;

/// What is integrated: the rover's state, the motors' work, the work on the soil, and the electrical energy [J].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    pub(super) state: RoverState,
    pub(super) motors: f64,
    pub(super) soil: f64,
    pub(super) electrical: f64,
}

impl Point {
    /// Changes pose and velocities at once. What that changes in kinetic energy counts as work of the motors.
    pub(super) fn jump(&mut self, rover: &Rover, change: impl FnOnce(&mut RoverState)) {
        let before = power::kinetic_energy(rover, &self.state);
        change(&mut self.state);
        self.motors += power::kinetic_energy(rover, &self.state) - before;
    }

    fn from_array(y: &[f64; SIZE]) -> Self {
        Self {
            state: RoverState {
                position: Vec2::new(y[0], y[1]),
                yaw: y[2],
                velocity: Vec2::new(y[3], y[4]),
                yaw_rate: y[5],
            },
            motors: y[6],
            soil: y[7],
            electrical: y[8],
        }
    }

    fn to_array(self) -> [f64; SIZE] {
        let RoverState { position, yaw, velocity, yaw_rate } = self.state;
        [
            position.x,
            position.y,
            yaw,
            velocity.x,
            velocity.y,
            yaw_rate,
            self.motors,
            self.soil,
            self.electrical,
        ]
    }
}

impl Rates {
    fn to_array(self) -> [f64; SIZE] {
        let Acceleration { velocity_rate, yaw_acceleration } = self.acceleration;
        [
            self.velocity_slope.x,
            self.velocity_slope.y,
            self.yaw_rate,
            velocity_rate.x,
            velocity_rate.y,
            yaw_acceleration,
            self.motor_power,
            self.soil_power,
            self.electrical_power,
        ]
    }
}

/// Why time did not go on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stalled {
    /// The last time that was reached [s].
    pub(super) time: f64,
    /// Message of the solver.
    pub(super) reason: String,
}

/// Receives the point at each time asked for, and says whether to go on.
pub(super) type OnSample<'a> = dyn FnMut(f64, &Point) -> ControlFlow<()> + 'a;

/// The rates at a point; none where the rover tips over or a wheel does not settle. An integrator may
/// try points that no rover can reach, and steps back from there.
fn rates_at(equations: &Equations<'_>, y: &[f64; SIZE]) -> Option<[f64; SIZE]> {
    let rates = equations.attempt(&Point::from_array(y).state)?.rates.to_array();
    rates.iter().all(|rate| rate.is_finite()).then_some(rates)
}
