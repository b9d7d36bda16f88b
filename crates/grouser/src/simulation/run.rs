//! A run: drive, motion, samples, and a watch over what becomes of the rover.

use std::ops::ControlFlow;

use super::equations::Equations;
use super::integrate::{self, Point, Stalled};
use super::power::{self, EnergyBalance};
use super::scenario::{Integrator, Scenario};
use super::trajectory::{Outcome, Sample, StuckBecause, Trajectory, WheelSample, Work};
use crate::contact::SettleError;
use crate::error::ParameterError;
use crate::vehicle::drive::DriveInput;
use crate::vehicle::kinematics::hub_velocity;
use crate::vehicle::reaction::Ground;
use crate::vehicle::{Drive, ReactionError, WheelReaction};

/// Time between two looks of a drive that varies [s]. Source: ours, a usual rate of rover control.
pub const CONTROL_PERIOD: f64 = 0.1;

/// Time between two looks at what becomes of the rover [s]: however rarely samples are recorded, a
/// finding is found. Source: ours, a tenth of [`CERTAIN_AFTER`].
pub const WATCH_PERIOD: f64 = 0.1;
/// A finding about the motion must hold for this long [s], so that a jolt is none. Source: ours.
pub const CERTAIN_AFTER: f64 = 1.0;
/// Mean slip above which the wheels only dig [-]. Source: ours; Opportunity was given up for
/// stuck at 0.9955 on 32°.
pub const SPINNING_SLIP: f64 = 0.99;
/// Progress of the hubs over the rims' below which a rover is stuck [-]. Source: ours, as above.
pub const LEAST_PROGRESS: f64 = 0.01;
/// Sliding of a rover whose wheels stand still starts here [m/s]. Source: ours; a parked rover
/// creeps a thousand times slower.
pub const SLIDING_SPEED: f64 = 1e-3;

/// Why a run could not be computed. (What a rover does is an [`Outcome`], not an error.)
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scenario is no run.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The soil's reaction could not be found.
    #[error("at {time:.3} s: {source}")]
    Reaction {
        /// When [s].
        time: f64,
        /// What is wrong.
        source: ReactionError,
    },
    /// The integrator could not go on.
    #[error(
        "the run cannot be computed beyond {time:.3} s: no time step is short enough for the motion \
         there ({reason}); a locked or suddenly braked wheel is the usual reason, another --speed-m-s \
         or a rolling start may avoid it"
    )]
    Stalled {
        /// When [s].
        time: f64,
        /// What the integrator said.
        reason: String,
    },
}

/// A run in progress.
pub struct Simulation<'a> {
    scenario: &'a Scenario,
    drive: Box<dyn Drive + 'a>,
    rim_speeds: Vec<f64>,
    time: f64,
    point: Point,
    samples: Vec<Sample>,
    slip_ratios: Vec<f64>,
    watch: Watch,
    outcome: Option<Outcome>,
    work: Work,
}

impl<'a> Simulation<'a> {
    /// The run of a scenario, at its start.
    ///
    /// # Errors
    /// [`SimulationError`] if the scenario is no run, or the wheels do not settle at its start
    /// for another reason than a physical one.
    pub fn new(scenario: &'a Scenario) -> Result<Self, SimulationError> {
        Self::with_drive(scenario, Box::new(scenario.drive.clone()))
    }

    /// The same, with a drive of your own instead of the scenario's.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_drive(
        scenario: &'a Scenario,
        mut drive: Box<dyn Drive + 'a>,
    ) -> Result<Self, SimulationError> {
        scenario.check()?;
        let rover = &scenario.rover;
        let mut rim_speeds = vec![0.0; rover.wheel_count()];
        let slip_ratios = vec![0.0; rover.wheel_count()];
        let input = DriveInput { rover, yaw: scenario.start.yaw, slip_ratios: &slip_ratios };
        drive.rim_speeds(&input, &mut rim_speeds);
        let state = scenario.start_state(&rim_speeds);
        let mut simulation = Self {
            scenario,
            drive,
            rim_speeds,
            time: 0.0,
            point: Point { state, motors: 0.0, soil: 0.0 },
            samples: Vec::new(),
            slip_ratios,
            watch: Watch::default(),
            outcome: None,
            work: Work::default(),
        };
        simulation.advance_through(&[])?;
        Ok(simulation)
    }

    /// Runs to the end of the scenario, or to the outcome that ends it before.
    ///
    /// # Errors
    /// [`SimulationError`] if the run cannot be computed.
    pub fn run(mut self) -> Result<Trajectory, SimulationError> {
        let duration = self.scenario.duration;
        if self.drive.varies() {
            while self.outcome.is_none() && self.time < duration {
                let periods = (self.time / CONTROL_PERIOD).round() + 1.0;
                self.advance((periods * CONTROL_PERIOD).min(duration))?;
            }
        } else {
            self.advance(duration)?;
        }
        let outcome = self.outcome.unwrap_or(Outcome::Completed);
        Ok(Trajectory { samples: self.samples, outcome, work: self.work })
    }

    /// Asks the drive, then lets the motion go on to a time [s], unless an outcome ends it.
    ///
    /// # Errors
    /// [`SimulationError`] if the motion cannot be computed.
    pub fn advance(&mut self, until: f64) -> Result<(), SimulationError> {
        if self.outcome.is_some() || until <= self.time {
            return Ok(());
        }
        self.ask_drive();
        let interval = self.scenario.numerics.sample_interval;
        let mut times = multiples_between(self.time, until, interval);
        times.extend(multiples_between(self.time, until, WATCH_PERIOD));
        times.push(until);
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| is_same_time(*later, *earlier));
        self.advance_through(&times)
    }

    /// What became of the rover, if that is known already.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// The samples so far.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    fn ask_drive(&mut self) {
        if self.time == 0.0 || !self.drive.varies() {
            return;
        }
        let rover = &self.scenario.rover;
        let radius = rover.wheel().shearing_radius();
        let wheel_speeds =
            |rims: &[f64]| rims.iter().map(|speed| speed / radius).collect::<Vec<f64>>();
        let before = power::spin_energy(rover, &wheel_speeds(&self.rim_speeds));
        let input = DriveInput { rover, yaw: self.point.state.yaw, slip_ratios: &self.slip_ratios };
        self.drive.rim_speeds(&input, &mut self.rim_speeds);
        // The motors change the spin at once; the books must not lose that work.
        self.point.motors += power::spin_energy(rover, &wheel_speeds(&self.rim_speeds)) - before;
    }

    /// Integrates through the given times and looks at the rover at each; with none, at the start.
    /// Keeps a sample where one is due, and at the end.
    fn advance_through(&mut self, times: &[f64]) -> Result<(), SimulationError> {
        let Self {
            scenario,
            rim_speeds,
            time,
            point,
            samples,
            slip_ratios,
            watch,
            outcome,
            work,
            ..
        } = self;
        let ground = Ground {
            rover: &scenario.rover,
            site: &scenario.site,
            model: scenario.theory.model(),
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
        };
        let equations = Equations::new(ground, rim_speeds);
        let mut failure = None;
        let (start, start_time) = (*point, *time);
        let mut take_sample = |now: f64, reached: &Point| {
            (*time, *point) = (now, *reached);
            match equations.reactions(&reached.state) {
                Ok(wheels) => {
                    let sample = sample_of(scenario, &equations, now, reached, &wheels);
                    if is_multiple(now, WATCH_PERIOD) {
                        *outcome = watch.look(scenario, &sample, rim_speeds);
                    }
                    slip_ratios.clear();
                    slip_ratios.extend(wheels.iter().map(|wheel| wheel.slip.ratio));
                    if outcome.is_some() || is_sample_due(scenario, now) {
                        samples.push(sample);
                    }
                }
                Err(error) => {
                    samples.push(sample_of(scenario, &equations, now, reached, &[]));
                    failure = Some((now, error));
                }
            }
            if failure.is_some() || outcome.is_some() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let integrated = if times.is_empty() {
            let _ = take_sample(start_time, &start);
            Ok(())
        } else {
            match scenario.numerics.integrator {
                Integrator::Bdf { tolerance } => integrate::bdf(
                    &equations,
                    &start,
                    start_time,
                    times,
                    tolerance,
                    &mut take_sample,
                ),
                Integrator::Rk4 { step } => {
                    integrate::rk4(&equations, &start, start_time, times, step, &mut take_sample)
                }
            }
        };
        work.evaluations += equations.evaluations();
        if let Err(Stalled { time, reason }) = integrated {
            // The integrator stalls where the equations end: then their reason is the reason.
            match equations.take_failure() {
                Some(error) => failure = Some((time, error)),
                None => return Err(SimulationError::Stalled { time, reason }),
            }
        }
        if let Some((time, error)) = failure {
            *outcome = Some(outcome_of(time, error)?);
        }
        Ok(())
    }
}

/// Multiples of an interval after one time and before another.
fn multiples_between(after: f64, until: f64, interval: f64) -> Vec<f64> {
    let mut times = Vec::new();
    let mut count = (after / interval).floor();
    while count * interval < until {
        let time = count * interval;
        if time > after && !is_same_time(time, after) && !is_same_time(time, until) {
            times.push(time);
        }
        count += 1.0;
    }
    times
}

/// Whether two times are one, but for rounding.
fn is_same_time(one: f64, other: f64) -> bool {
    /// Far below any step, far above the rounding of a day in seconds [s].
    const APART: f64 = 1e-9;
    (one - other).abs() < APART
}

/// Whether a sample belongs at a time: at the start, the end and the intervals between.
fn is_sample_due(scenario: &Scenario, time: f64) -> bool {
    is_multiple(time, scenario.numerics.sample_interval) || is_same_time(time, scenario.duration)
}

fn is_multiple(time: f64, interval: f64) -> bool {
    is_same_time(time, (time / interval).round() * interval)
}

/// The outcome that a missing reaction means, if it means one.
fn outcome_of(time: f64, error: ReactionError) -> Result<Outcome, SimulationError> {
    match error {
        ReactionError::Tipping(_) => Ok(Outcome::TippedOver { time }),
        ReactionError::Wheel { wheel, source: SettleError::SunkToAxle { load, capacity } } => {
            let because = StuckBecause::SunkToAxle { wheel, load, capacity };
            Ok(Outcome::Immobilised { time, because })
        }
        source => Err(SimulationError::Reaction { time, source }),
    }
}

fn sample_of(
    scenario: &Scenario,
    equations: &Equations<'_>,
    time: f64,
    point: &Point,
    wheels: &[WheelReaction],
) -> Sample {
    let (rover, site, state) = (&scenario.rover, &scenario.site, point.state);
    let wheel_speeds = equations.wheel_speeds();
    let energy = EnergyBalance {
        motors: point.motors,
        soil: point.soil,
        kinetic: power::kinetic_energy(rover, &state) + power::spin_energy(rover, wheel_speeds),
        potential: power::potential_energy(rover, site, &state),
    };
    let wheels = wheels
        .iter()
        .zip(wheel_speeds)
        .map(|(&reaction, &wheel_speed)| WheelSample { wheel_speed, reaction })
        .collect();
    Sample { time, state, wheels, energy }
}

/// Since when each condition has held [s].
#[derive(Clone, Copy, Debug, Default)]
struct Watch {
    spinning: Option<f64>,
    without_progress: Option<f64>,
    sliding: Option<f64>,
}

impl Watch {
    fn look(
        &mut self,
        scenario: &Scenario,
        sample: &Sample,
        rim_speeds: &[f64],
    ) -> Option<Outcome> {
        let time = sample.time;
        let rim_sum: f64 = rim_speeds.iter().map(|speed| speed.abs()).sum();
        let fastest_rim = rim_speeds.iter().fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let downhill = -sample.state.velocity_slope().y;
        let sliding = downhill > fastest_rim.max(SLIDING_SPEED);

        let turning = || rim_speeds.iter().zip(&sample.wheels).filter(|(rim, _)| **rim != 0.0);
        let mean_slip =
            turning().map(|(rim, wheel)| rim.signum() * wheel.reaction.slip.ratio).sum::<f64>()
                / turning().count().max(1) as f64;
        let along_rims: f64 = rim_speeds
            .iter()
            .zip(scenario.rover.mounts())
            .filter(|(rim, _)| **rim != 0.0)
            .map(|(rim, mount)| rim.signum() * hub_velocity(&sample.state, mount.position.xy()).x)
            .sum();
        let turns = rim_sum > 0.0;

        let certain = |since: &mut Option<f64>, holds: bool| {
            *since = if holds { since.or(Some(time)) } else { None };
            since.is_some_and(|since| time - since >= CERTAIN_AFTER)
        };
        let slides = certain(&mut self.sliding, sliding);
        let spins = certain(&mut self.spinning, turns && mean_slip > SPINNING_SLIP);
        let stands =
            certain(&mut self.without_progress, turns && along_rims < LEAST_PROGRESS * rim_sum);
        if slides {
            Some(Outcome::Sliding { time })
        } else if spins {
            Some(Outcome::Immobilised { time, because: StuckBecause::WheelsSpin })
        } else if stands {
            Some(Outcome::Immobilised { time, because: StuckBecause::NoProgress })
        } else {
            None
        }
    }
}
