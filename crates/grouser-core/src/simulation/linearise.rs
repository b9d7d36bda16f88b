//! A control step, linearised: how the state after it changes with the state before it, and with
//! the commanded speeds of the wheels.

use super::error::RunError;
use super::outcome::Outcome;
use super::run::Run;
use super::scenario::Integrator;
use super::state::State;
use super::steady_run::Carried;
use super::turning::Turning;
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::soil::Span;
use crate::units::Vec2;
use crate::vehicle::{Mount, Rover, RoverState};

/// Numbers of a rover's pose and velocities in a [`LinearStep`]: x, y [m], yaw [rad], speeds in the
/// body frame [m/s], yaw rate [rad/s].
pub const POSE_AND_VELOCITIES: usize = 6;

/// The steps of its differences. Source: ours; of a drive on sand, slopes by steps from 1e-5 to 1e-3
/// agree to 5e-5, and by ten times as long ones they differ by 2e-4.
pub const STEP_LENGTHS: StepLengths = StepLengths { long: 1e-3, short: 1e-4, tolerance: 1e-4 };

/// The tolerance with which a dynamic motion is integrated for it [-]: its error, over the shorter
/// step, has to be small.
const TOLERANCE: f64 = 1e-10;
/// Speeds change the motion by as much as they are; for a rover that stands they are at least this
/// [m/s]. Source: ours; a slow rover's speed.
const LEAST_SPEED: f64 = 0.01;

/// A control step and its slopes, *x' = f(x, u)*: *A = ∂f/∂x* and *B = ∂f/∂u*.
///
/// The state *x* has [pose and velocities](POSE_AND_VELOCITIES); then, where speeds of wheels depend
/// on their load, each wheel's rim speed [m/s] and what the integral of its controller adds to the
/// voltage [V]. Batteries and windings stay outside. *u* is the commanded rim speed of each wheel
/// [m/s].
#[derive(Clone, Debug, PartialEq)]
pub struct LinearStep {
    /// The state before the step.
    pub before: Vec<f64>,
    /// The state after it.
    pub after: Vec<f64>,
    /// A list for each number of the state before and then for each command, with the slope of each
    /// number of the state after.
    pub slopes: Vec<Vec<Derivative>>,
}

/// Why a step has no slopes.
#[derive(Debug, thiserror::Error)]
pub enum NoLinearStep {
    /// The step is none, or cannot be computed.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The run has ended, or ends within the step or one beside it.
    #[error("the run ends within the step, or would with a state or command beside it: {reason}")]
    Ends {
        /// What becomes of the rover.
        reason: String,
    },
    /// A quasi-steady run is computed dynamically within the step or one beside it.
    #[error(
        "the quasi-steady motion falls back to the dynamic one within the step, or would with a \
         state or command beside it"
    )]
    FallsBack,
    /// The scenario turns the rover as it prescribes, whatever its state.
    #[error("the scenario prescribes the yaw, which no state or command changes")]
    PrescribedYaw,
}

impl Run {
    /// The slopes of a [step](Self::step) from here, by central differences of whole steps: see
    /// [`STEP_LENGTHS`]. The run stays where it is.
    ///
    /// A dynamic motion is integrated ten thousand times as precisely as in a run, because the
    /// differences of a run's own steps have its error over the step length. A velocity, and
    /// everything else that a step forgets, has slopes near zero.
    ///
    /// * `rim_speeds`, `span`: as in [`step`](Self::step)
    ///
    /// # Errors
    /// [`NoLinearStep`] where the step, or one of those beside it, ends the run, falls back, or
    /// cannot be computed.
    pub fn linear_step(&self, rim_speeds: &[f64], span: f64) -> Result<LinearStep, NoLinearStep> {
        self.linear_step_from(&self.numbers(), rim_speeds, span)
    }

    /// The numbers of the state now, in the order of a [`LinearStep`].
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        numbers_of(self.state())
    }

    /// The state after a step from another one than now, integrated as precisely as for its
    /// [slopes](Self::linear_step_from).
    ///
    /// * `before`: in the order of [`numbers`](Self::numbers)
    ///
    /// # Errors
    /// [`NoLinearStep`] where the step ends the run, falls back, or cannot be computed.
    pub fn precise_step_from(
        &self,
        before: &[f64],
        rim_speeds: &[f64],
        span: f64,
    ) -> Result<Vec<f64>, NoLinearStep> {
        let here = [before, rim_speeds].concat();
        self.precise()?.stepped_from(&here, before.len(), span)
    }

    /// The slopes of a [step](Self::linear_step) from another state than now.
    ///
    /// * `before`: in the order of [`numbers`](Self::numbers)
    ///
    /// # Errors
    /// [`NoLinearStep`], for the reasons that [`linear_step`](Self::linear_step) names.
    pub fn linear_step_from(
        &self,
        before: &[f64],
        rim_speeds: &[f64],
        span: f64,
    ) -> Result<LinearStep, NoLinearStep> {
        let precise = self.precise()?;
        let before = before.to_vec();
        let here = [&*before, rim_speeds].concat();
        let stepped = |point: &[f64]| precise.stepped_from(point, before.len(), span);
        let after = stepped(&here)?;
        let scales = Scales::of(self, rim_speeds);
        let lengths = scales.of_states(before.len()).chain(rim_speeds.iter().map(|_| scales.speed));
        let variables: Vec<Variable> = here
            .iter()
            .zip(lengths)
            .map(|(value, scale)| Variable { value: *value, scale, range: Span::ANY })
            .collect();
        let sizes: Vec<f64> = scales.sizes(before.len(), span);
        let mut refused = None;
        let mut evaluate = |points: &[Vec<f64>]| {
            let each = points.iter().map(|point| {
                // After a refusal nothing else is worth its time.
                let found = if refused.is_none() { stepped(point) } else { return None };
                found.map_err(|why| refused = Some(why)).ok()
            });
            each.collect()
        };
        let found = derivatives(&variables, &after, &sizes, STEP_LENGTHS, &mut evaluate);
        if let Some(why) = refused {
            return Err(why);
        }
        // Where no point was refused, each variable was moved to both sides.
        let slopes = found.by_variable.into_iter().flatten().collect();
        Ok(LinearStep { before, after, slopes })
    }

    /// The run, integrated precisely enough for differences of its steps.
    fn precise(&self) -> Result<Self, NoLinearStep> {
        if self.scenario().yaw.is_some() {
            return Err(NoLinearStep::PrescribedYaw);
        }
        if let Some(outcome) = self.outcome() {
            return Err(ended(outcome));
        }
        Ok(self.changed(|state, scenario| {
            if let Integrator::Adaptive { tolerance } = &mut scenario.numerics.integrator {
                *tolerance = tolerance.min(TOLERANCE);
            }
            // What was not steady before may be now, and is asked beside it, too.
            state.approach = scenario.numerics.approach;
        }))
    }

    /// The numbers of the state after a step from others.
    ///
    /// * `point`: numbers of the state, then commands
    /// * `states`: how many belong to the state
    fn stepped_from(
        &self,
        point: &[f64],
        states: usize,
        span: f64,
    ) -> Result<Vec<f64>, NoLinearStep> {
        let (state, rim_speeds) = point.split_at(states);
        let mut run = self.changed(|it, scenario| place(it, &scenario.rover, state));
        run.step(rim_speeds, span)?;
        if let Some(outcome) = run.outcome() {
            return Err(ended(outcome));
        }
        if run.state().approach != self.state().approach {
            return Err(NoLinearStep::FallsBack);
        }
        Ok(numbers_of(run.state()))
    }
}

fn ended(outcome: &Outcome) -> NoLinearStep {
    let reason = outcome.reason().unwrap_or_else(|| outcome.name().to_owned());
    NoLinearStep::Ends { reason }
}

/// Puts a rover into another state; what the solver knew of the motion before is forgotten.
fn place(state: &mut State, rover: &Rover, numbers: &[f64]) {
    let (body, wheels) = numbers.split_at(POSE_AND_VELOCITIES);
    state.jump(rover, |it| {
        *it = RoverState {
            position: Vec2::new(body[0], body[1]),
            yaw: body[2],
            velocity: Vec2::new(body[3], body[4]),
            yaw_rate: body[5],
        };
    });
    state.carried = Carried::default();
    if let Some(turning) = &mut state.point.turning {
        *turning = Turning::of(wheels);
    }
}

/// The numbers of a state.
fn numbers_of(state: &State) -> Vec<f64> {
    let RoverState { position, yaw, velocity, yaw_rate } = state.rover();
    let mut numbers = vec![position.x, position.y, *yaw, velocity.x, velocity.y, *yaw_rate];
    numbers.extend(state.point.turning.iter().flat_map(|turning| turning.numbers().concat()));
    numbers
}

/// What steps of differences are shares of.
struct Scales {
    /// A shearing radius [m], over which ground changes.
    length: f64,
    /// The fastest rim [m/s].
    speed: f64,
    /// Half of the distance between the outermost wheels [m].
    arm: f64,
}

impl Scales {
    fn of(run: &Run, rim_speeds: &[f64]) -> Self {
        let mounts = run.scenario().rover.mounts();
        let arms = mounts.iter().map(|mount| mount.position.xy().norm());
        let radii = mounts.iter().map(Mount::shearing_radius);
        let speeds = rim_speeds.iter().chain(run.state().rim_speeds()).map(|it| it.abs());
        Self {
            length: radii.fold(f64::INFINITY, f64::min),
            speed: speeds.fold(LEAST_SPEED, f64::max),
            arm: arms.fold(0.0, f64::max),
        }
    }

    /// Those of the numbers of a state.
    fn of_states(&self, count: usize) -> impl Iterator<Item = f64> {
        let Self { length, speed, arm } = *self;
        let wheels = (count - POSE_AND_VELOCITIES) / 2;
        let volt = 1.0;
        let rover = [length, length, 1.0, speed, speed, speed / arm];
        rover
            .into_iter()
            .chain(std::iter::repeat_n(speed, wheels))
            .chain(std::iter::repeat_n(volt, wheels))
    }

    /// What changes of the state after a step are small against.
    fn sizes(&self, count: usize, span: f64) -> Vec<f64> {
        let way = (self.speed * span).max(self.length);
        let mut sizes: Vec<f64> = self.of_states(count).collect();
        sizes[..3].copy_from_slice(&[way, way, way / self.arm]);
        sizes
    }
}
