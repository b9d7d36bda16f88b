//! Carries the motion through time.
//!
//! `dormand_prince` takes an explicit step, `rosenbrock` an implicit one, with the coefficients of
//! `rodas5p`, and `exponential` one that follows what new speeds of the wheels disturb; `adaptive`
//! chooses among them, and how long a `step` is. `runge_kutta` is the independent check on them.

mod adaptive;
mod dormand_prince;
mod exponential;
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
use super::point::Point;
use super::turning::{MOST_WHEELS, Turning};
use crate::units::Vec2;
use crate::vehicle::{Acceleration, RoverState};

/// How many numbers move: pose, velocities, and the three energies.
const SIZE: usize = 9;
/// And with motors whose speed depends on their load: for each wheel its speed and its controller's
/// integral.
const WITH_MOTORS: usize = SIZE + 2 * MOST_WHEELS;

impl Point {
    /// * `more`: how many numbers motors have
    fn from_array<const N: usize>(y: &[f64; N], more: usize) -> Self {
        let (of_motors, energies) = y[STATE..].split_at(more);
        Self {
            state: RoverState {
                position: Vec2::new(y[0], y[1]),
                yaw: y[2],
                velocity: Vec2::new(y[3], y[4]),
                yaw_rate: y[5],
            },
            motors: energies[0],
            soil: energies[1],
            electrical: energies[2],
            turning: (more > 0).then(|| Turning::of(of_motors)),
        }
    }

    fn to_array<const N: usize>(self) -> [f64; N] {
        let RoverState { position, yaw, velocity, yaw_rate } = self.state;
        let moving = [position.x, position.y, yaw, velocity.x, velocity.y, yaw_rate];
        let of_motors = self.turning.as_ref();
        laid_out(moving, of_motors, [self.motors, self.soil, self.electrical])
    }
}

impl Rates {
    fn to_array<const N: usize>(self, of_motors: Option<&Turning>) -> [f64; N] {
        let Acceleration { velocity_rate, yaw_acceleration } = self.acceleration;
        let moving = [
            self.velocity_slope.x,
            self.velocity_slope.y,
            self.yaw_rate,
            velocity_rate.x,
            velocity_rate.y,
            yaw_acceleration,
        ];
        laid_out(moving, of_motors, [self.motor_power, self.soil_power, self.electrical_power])
    }
}

/// How many numbers pose and velocities have.
const STATE: usize = 6;

/// All numbers in their order: pose and velocities, what motors have, energies.
fn laid_out<const N: usize>(
    moving: [f64; STATE],
    of_motors: Option<&Turning>,
    energies: [f64; 3],
) -> [f64; N] {
    let mut all = [0.0; N];
    all[..STATE].copy_from_slice(&moving);
    let mut next = STATE;
    for numbers in of_motors.iter().flat_map(|motors| motors.numbers()) {
        all[next..next + numbers.len()].copy_from_slice(numbers);
        next += numbers.len();
    }
    all[next..next + energies.len()].copy_from_slice(&energies);
    all
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

/// The rates at a point; none where the rover tips over or a wheel does not settle. An integrator
/// may try points that no rover can reach, and steps back from there.
fn rates_at<const N: usize>(equations: &Equations<'_>, y: &[f64; N]) -> Option<[f64; N]> {
    let point = Point::from_array(y, equations.moving_motors());
    let rates: [f64; N] = match point.turning {
        None => equations.attempt(&point.state)?.rates.to_array(None),
        Some(turning) => {
            let (rates, of_motors) = equations.attempt_turning(&point.state, &turning)?;
            rates.to_array(Some(&of_motors))
        }
    };
    rates.iter().all(|rate| rate.is_finite()).then_some(rates)
}
