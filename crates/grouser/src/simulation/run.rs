//! A run: drive, motion, samples, and a watch over what becomes of the rover.

use std::ops::ControlFlow;

use super::balance::Unsteady;
use super::equations::Equations;
use super::integrate::{self, History, Point, Stalled};
use super::power::{self, EnergyBalance};
use super::quasi_steady::{Carried, QuasiSteady};
use super::scenario::{Approach, Integrator, Scenario};
use super::times::{is_multiple, is_same_time, is_sample_due, multiples_between};
use super::trajectory::{Method, Outcome, Sample, StuckBecause, Trajectory, WheelSample, Work};
use super::watch::{WATCH_PERIOD, Watch};
use crate::contact::SettleError;
use crate::error::ParameterError;
use crate::vehicle::drive::DriveInput;
use crate::vehicle::reaction::Ground;
use crate::vehicle::{Drive, ReactionError, WheelReaction};

/// Time between two looks of a drive that varies [s]. Source: ours, a usual rate of rover control.
pub const CONTROL_PERIOD: f64 = 0.1;

/// Rim speeds that change by more than this, over the fastest, begin a motion of its own [-]:
/// below it the integrator goes on with its history. Source: ours.
const ABRUPT: f64 = 0.1;

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
    record: Record,
    method: Method,
    /// Of the quasi-steady motion so far.
    carried: Carried,
    work: Work,
}

/// What is known of a run so far.
struct Record {
    time: f64,
    point: Point,
    samples: Vec<Sample>,
    slip_ratios: Vec<f64>,
    watch: Watch,
    outcome: Option<Outcome>,
    /// Of the dynamic motion so far.
    history: History,
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
        let record = Record {
            time: 0.0,
            point: Point { state, motors: 0.0, soil: 0.0 },
            samples: Vec::new(),
            slip_ratios,
            watch: Watch::default(),
            outcome: None,
            history: History::default(),
        };
        let method = match scenario.numerics.approach {
            Approach::Dynamic => Method::Dynamic,
            Approach::QuasiSteady => Method::QuasiSteady,
        };
        let (carried, work) = (Carried::default(), Work::default());
        let mut simulation = Self { scenario, drive, rim_speeds, record, method, carried, work };
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
            while self.record.outcome.is_none() && self.record.time < duration {
                let periods = (self.record.time / CONTROL_PERIOD).round() + 1.0;
                self.advance((periods * CONTROL_PERIOD).min(duration))?;
            }
        } else {
            self.advance(duration)?;
        }
        let Record { samples, outcome, .. } = self.record;
        let outcome = outcome.unwrap_or(Outcome::Completed);
        Ok(Trajectory { samples, outcome, method: self.method, work: self.work })
    }

    /// Asks the drive, then lets the motion go on to a time [s], unless an outcome ends it.
    ///
    /// # Errors
    /// [`SimulationError`] if the motion cannot be computed.
    pub fn advance(&mut self, until: f64) -> Result<(), SimulationError> {
        let now = self.record.time;
        if self.record.outcome.is_some() || until <= now {
            return Ok(());
        }
        self.ask_drive();
        let interval = self.scenario.numerics.sample_interval;
        let mut times = multiples_between(now, until, interval);
        times.extend(multiples_between(now, until, WATCH_PERIOD));
        times.push(until);
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| is_same_time(*later, *earlier));
        self.advance_through(&times)
    }

    /// What became of the rover, if that is known already.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.record.outcome.as_ref()
    }

    /// The samples so far.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.record.samples
    }

    fn ask_drive(&mut self) {
        if self.record.time == 0.0 || !self.drive.varies() {
            return;
        }
        let rover = &self.scenario.rover;
        let radius = rover.wheel().shearing_radius();
        let old = self.rim_speeds.clone();
        let wheel_speeds =
            |rims: &[f64]| rims.iter().map(|speed| speed / radius).collect::<Vec<f64>>();
        let before = power::spin_energy(rover, &wheel_speeds(&self.rim_speeds));
        let yaw = self.record.point.state.yaw;
        let input = DriveInput { rover, yaw, slip_ratios: &self.record.slip_ratios };
        self.drive.rim_speeds(&input, &mut self.rim_speeds);
        // The motors change the spin at once; the books must not lose that work.
        let after = power::spin_energy(rover, &wheel_speeds(&self.rim_speeds));
        self.record.point.motors += after - before;
        let fastest = old.iter().fold(0.0, |most: f64, rim| most.max(rim.abs()));
        let changed = |(rim, old): (&f64, &f64)| (rim - old).abs() > ABRUPT * fastest;
        if self.rim_speeds.iter().zip(&old).any(changed) {
            self.record.history.clear();
        }
    }

    /// Goes on through the given times and looks at the rover at each; with none, at the start.
    fn advance_through(&mut self, times: &[f64]) -> Result<(), SimulationError> {
        let scenario = self.scenario;
        let ground = Ground {
            rover: &scenario.rover,
            site: &scenario.site,
            model: scenario.theory.model(),
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
        };
        let equations = Equations::new(ground, &self.rim_speeds);
        let record = &mut self.record;
        let mut times = times;
        let mut done = Ok(());
        if self.method == Method::QuasiSteady {
            let end = times.last().copied().unwrap_or(record.time);
            let varies = self.drive.varies();
            let plan = Plan {
                horizon_end: if varies { end } else { scenario.duration.max(end) },
                rims_changed: varies,
            };
            let carried = std::mem::take(&mut self.carried);
            match record.advance_steadily(scenario, &equations, carried, times, plan) {
                Ok(carried) => self.carried = carried,
                Err(Ended::Failed(error)) => done = Err(error),
                Err(Ended::Unsteady(because)) => {
                    self.method = Method::FellBack { time: record.time, because };
                    times = &times[times.partition_point(|time| *time <= record.time)..];
                }
            }
        }
        if self.method != Method::QuasiSteady && done.is_ok() {
            done = record.advance_dynamically(scenario, &equations, times);
        }
        self.work += equations.work();
        done
    }
}

/// What a quasi-steady motion is told of the rims.
#[derive(Clone, Copy)]
struct Plan {
    /// Until when they keep their speeds [s].
    horizon_end: f64,
    /// Whether they had others before.
    rims_changed: bool,
}

/// Why a quasi-steady motion went no further.
enum Ended {
    /// It is not valid from here on.
    Unsteady(Unsteady),
    /// It cannot be computed.
    Failed(SimulationError),
}

/// Wheels at the point that is looked at, if they are asked for.
type Wheels<'a> = &'a dyn Fn() -> Result<Vec<WheelReaction>, ReactionError>;

impl Record {
    /// Velocities in balance, the pose integrated.
    fn advance_steadily(
        &mut self,
        scenario: &Scenario,
        equations: &Equations<'_>,
        carried: Carried,
        times: &[f64],
        plan: Plan,
    ) -> Result<Carried, Ended> {
        let Plan { horizon_end, rims_changed } = plan;
        let mut point = self.point;
        let horizon = horizon_end - self.time;
        let at_start = times.is_empty();
        let started = QuasiSteady::from(equations, carried, &mut point, horizon, rims_changed);
        let mut motion = started.map_err(Ended::Unsteady)?;
        if at_start {
            // A run starts in balance: what its start would cost the motors is not in the books.
            point.motors = 0.0;
            let wheels = || Ok(motion.wheels(&point));
            let _ = self.look(scenario, equations, 0.0, &point, &wheels).map_err(Ended::Failed)?;
        }
        for &time in times {
            let span = time - self.time;
            let advanced = motion.advance(&mut point, span, horizon_end - self.time);
            advanced.map_err(Ended::Unsteady)?;
            let wheels = || Ok(motion.wheels(&point));
            let looked = self.look(scenario, equations, time, &point, &wheels);
            if looked.map_err(Ended::Failed)?.is_break() {
                break;
            }
        }
        Ok(motion.carry())
    }

    /// Pose and velocities integrated.
    fn advance_dynamically(
        &mut self,
        scenario: &Scenario,
        equations: &Equations<'_>,
        times: &[f64],
    ) -> Result<(), SimulationError> {
        let (start, start_time) = (self.point, self.time);
        let mut history = std::mem::take(&mut self.history);
        let mut failed = None;
        let mut on_sample = |now: f64, reached: &Point| {
            let wheels = || equations.reactions(&reached.state);
            self.look(scenario, equations, now, reached, &wheels).unwrap_or_else(|error| {
                failed = Some(error);
                ControlFlow::Break(())
            })
        };
        let integrated = if times.is_empty() {
            let _ = on_sample(start_time, &start);
            Ok(())
        } else {
            match scenario.numerics.integrator {
                Integrator::Bdf { tolerance } => integrate::bdf(
                    equations,
                    &start,
                    start_time,
                    times,
                    tolerance,
                    &mut history,
                    &mut on_sample,
                ),
                Integrator::Rk4 { step } => {
                    integrate::rk4(equations, &start, start_time, times, step, &mut on_sample)
                }
            }
        };
        self.history = history;
        if let Some(error) = failed {
            return Err(error);
        }
        if let Err(Stalled { time, reason }) = integrated {
            // The integrator stalls where the equations end: then their reason is the reason.
            match equations.take_failure() {
                Some(error) => self.outcome = Some(outcome_of(time, error)?),
                None => return Err(SimulationError::Stalled { time, reason }),
            }
        }
        Ok(())
    }

    /// Looks at the rover: what became of it, and a sample where one is due.
    fn look(
        &mut self,
        scenario: &Scenario,
        equations: &Equations<'_>,
        now: f64,
        reached: &Point,
        wheels: Wheels<'_>,
    ) -> Result<ControlFlow<()>, SimulationError> {
        (self.time, self.point) = (now, *reached);
        let state = &reached.state;
        if is_multiple(now, WATCH_PERIOD) {
            let slips = equations.slips(state);
            self.outcome = self.watch.look(scenario, now, state, slips, equations.rim_speeds());
        }
        self.slip_ratios.clear();
        self.slip_ratios.extend(equations.slips(state).map(|slip| slip.ratio));
        if self.outcome.is_some() || is_sample_due(scenario, now) {
            match wheels() {
                Ok(wheels) => {
                    self.samples.push(sample_of(scenario, equations, now, reached, &wheels));
                }
                Err(error) => {
                    self.samples.push(sample_of(scenario, equations, now, reached, &[]));
                    self.outcome = Some(outcome_of(now, error)?);
                }
            }
        }
        Ok(match self.outcome {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        })
    }
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
