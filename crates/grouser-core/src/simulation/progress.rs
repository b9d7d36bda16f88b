//! How far a run has come: pose and velocities carried on by the one or the other way, a watch over
//! what becomes of the rover, and the samples that are kept. A [`Simulation`](super::Simulation)
//! leads it to the end of a scenario, a [`Simulator`](super::Simulator) step by step.

use std::ops::ControlFlow;

use super::balance::Unsteady;
use super::equations::Equations;
use super::integrate::{self, History, Point, Stalled};
use super::power::{self, EnergyBalance};
use super::quasi_steady::{Carried, QuasiSteady};
use super::run::SimulationError;
use super::scenario::{Approach, Integrator, Scenario};
use super::times::{is_multiple, is_same_time, is_sample_due, multiples_between};
use super::trajectory::{Method, Outcome, Sample, StuckBecause, WheelSample, Work};
use super::watch::{WATCH_PERIOD, Watch};
use crate::contact::SettleError;
use crate::vehicle::reaction::Ground;
use crate::vehicle::{ReactionError, WheelReaction};

/// What is known of a run so far.
#[derive(Clone)]
pub(super) struct Progress {
    pub(super) time: f64,
    pub(super) point: Point,
    pub(super) samples: Vec<Sample>,
    pub(super) keep: Keep,
    /// Of each wheel, when the rover was last looked at.
    pub(super) slip_ratios: Vec<f64>,
    pub(super) outcome: Option<Outcome>,
    pub(super) method: Method,
    pub(super) work: Work,
    watch: Watch,
    /// Of the dynamic motion while the wheels keep their speeds.
    history: History,
    /// Of the quasi-steady motion so far.
    carried: Carried,
}

/// Which samples are kept, besides the one at which an outcome is found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Keep {
    /// Those of the scenario's sample interval, and of its end.
    AtIntervals,
    /// That of one time [s].
    At(f64),
}

/// What turns the wheels over a stretch of time.
#[derive(Clone, Copy)]
pub(super) struct Rims<'a> {
    /// Rim speed of each wheel, *ω r_s* [m/s].
    pub(super) speeds: &'a [f64],
    /// Whether they had others before.
    pub(super) changed: bool,
    /// Until when they are expected to keep them [s].
    pub(super) kept_until: f64,
}

impl Progress {
    /// At the start of a scenario, before the rover was looked at.
    ///
    /// * `rim_speeds`: of each wheel at the start [m/s]
    pub(super) fn new(scenario: &Scenario, rim_speeds: &[f64]) -> Self {
        let state = scenario.start_state(rim_speeds);
        Self {
            time: 0.0,
            point: Point { state, motors: 0.0, soil: 0.0 },
            samples: Vec::new(),
            keep: Keep::AtIntervals,
            slip_ratios: vec![0.0; rim_speeds.len()],
            outcome: None,
            method: match scenario.numerics.approach {
                Approach::Dynamic => Method::Dynamic,
                Approach::QuasiSteady => Method::QuasiSteady,
            },
            work: Work::default(),
            watch: Watch::default(),
            history: History::default(),
            carried: Carried::default(),
        }
    }

    /// That the motors turn the wheels at other speeds from now on.
    ///
    /// * `old`, `new`: rim speeds of each wheel [m/s]
    pub(super) fn turn(&mut self, scenario: &Scenario, old: &[f64], new: &[f64]) {
        let rover = &scenario.rover;
        let radius = rover.wheel().shearing_radius();
        let spin_energy = |rims: &[f64]| {
            let wheel_speeds: Vec<f64> = rims.iter().map(|speed| speed / radius).collect();
            power::spin_energy(rover, &wheel_speeds)
        };
        // The motors change the spin at once; the books must not lose that work.
        self.point.motors += spin_energy(new) - spin_energy(old);
        if new != old {
            self.history.clear();
        }
    }

    /// Goes on to a time [s] with samples and looks on the way, unless an outcome ends the run.
    pub(super) fn advance(
        &mut self,
        scenario: &Scenario,
        rims: Rims<'_>,
        until: f64,
    ) -> Result<(), SimulationError> {
        let mut times = match self.keep {
            Keep::AtIntervals => {
                multiples_between(self.time, until, scenario.numerics.sample_interval)
            }
            Keep::At(_) => Vec::new(),
        };
        times.extend(multiples_between(self.time, until, WATCH_PERIOD));
        times.push(until);
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| is_same_time(*later, *earlier));
        self.advance_through(scenario, rims, &times)
    }

    /// Goes on through the given times and looks at the rover at each; with none, at the start.
    pub(super) fn advance_through(
        &mut self,
        scenario: &Scenario,
        rims: Rims<'_>,
        times: &[f64],
    ) -> Result<(), SimulationError> {
        let equations = Equations::new(ground(scenario), rims.speeds);
        let mut times = times;
        let mut done = Ok(());
        if self.method == Method::QuasiSteady {
            let carried = std::mem::take(&mut self.carried);
            match self.advance_steadily(scenario, &equations, carried, times, rims) {
                Ok(carried) => self.carried = carried,
                Err(Ended::Failed(error)) => done = Err(error),
                Err(Ended::Unsteady(because)) => {
                    self.method = Method::FellBack { time: self.time, because };
                    times = &times[times.partition_point(|time| *time <= self.time)..];
                }
            }
        }
        if self.method != Method::QuasiSteady && done.is_ok() {
            done = self.advance_dynamically(scenario, &equations, times);
        }
        self.work += equations.work();
        done
    }

    /// Velocities in balance, the pose integrated.
    fn advance_steadily(
        &mut self,
        scenario: &Scenario,
        equations: &Equations<'_>,
        carried: Carried,
        times: &[f64],
        rims: Rims<'_>,
    ) -> Result<Carried, Ended> {
        let horizon_end = rims.kept_until;
        let mut point = self.point;
        let horizon = horizon_end - self.time;
        let at_start = times.is_empty();
        let started = QuasiSteady::from(equations, carried, &mut point, horizon, rims.changed);
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
                Integrator::Adaptive { tolerance } => integrate::adaptive(
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
        if self.outcome.is_some() || self.is_due(scenario, now) {
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

    /// Keeps a sample of where the run has come to; without wheels where those do not settle.
    pub(super) fn keep_here(&mut self, scenario: &Scenario, rim_speeds: &[f64]) {
        let equations = Equations::new(ground(scenario), rim_speeds);
        let wheels = equations.reactions(&self.point.state).unwrap_or_default();
        self.samples.push(sample_of(scenario, &equations, self.time, &self.point, &wheels));
    }

    fn is_due(&self, scenario: &Scenario, now: f64) -> bool {
        match self.keep {
            Keep::AtIntervals => is_sample_due(scenario, now),
            Keep::At(time) => is_same_time(now, time),
        }
    }
}

/// What decides the soil's reaction in a scenario.
fn ground(scenario: &Scenario) -> Ground<'_> {
    Ground {
        rover: &scenario.rover,
        site: &scenario.site,
        model: scenario.theory.model(),
        sharing: scenario.sharing,
        own_moments: scenario.own_moments,
    }
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
