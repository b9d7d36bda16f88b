//! One leg of a run: over it the wheels keep their speeds.
//!
//! Pose and velocities are carried on by the one or the other way, a watch sees what becomes of the
//! rover, and records are kept. A [`Run`](super::Run) is made of legs.

use std::cell::RefCell;
use std::ops::ControlFlow;

use super::allowance;
use super::equations::Equations;
use super::error::RunError;
use super::integrate::{self, Stalled};
use super::method::Method;
use super::outcome::{Outcome, StuckBecause};
use super::point::Point;
use super::record::Record;
use super::scenario::{Approach, Integrator, Scenario};
use super::state::State;
use super::steady_run::{Carried, SteadyRun};
use super::steady_state::NotSteady;
use super::times::{is_multiple, is_same_time, is_sample_due, multiples_between};
use super::watch::{self, WATCH_PERIOD};
use crate::contact::{SettleError, Slip};
use crate::units::Vec2;
use crate::vehicle::{BellyPoint, ReactionError, WheelReaction};

/// A stretch of time over which the wheels keep their speeds.
pub(super) struct Leg<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) state: &'a mut State,
    pub(super) records: &'a mut Vec<Record>,
    /// Whether the wheels had other speeds before, or a held yaw another rate.
    pub(super) is_new_command: bool,
    /// Until when they are expected to keep them [s], which matters on uneven ground alone.
    pub(super) kept_until: f64,
    /// What is recorded.
    pub(super) due: Due,
}

/// Which times are recorded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Due {
    /// Those of the scenario's sample interval, its end, and that of an outcome.
    Samples,
    /// One [s], and that of an outcome.
    At(f64),
    /// None.
    Nothing,
}

impl Leg<'_> {
    /// Looks at the rover at the start of its run.
    pub(super) fn start(mut self) -> Result<(), RunError> {
        self.go_through(&[])
    }

    /// Goes on to a time [s] with records and looks on the way, unless an outcome ends the run.
    pub(super) fn go_to(mut self, until: f64) -> Result<(), RunError> {
        let now = self.state.time;
        let mut times = match self.due {
            Due::Samples => multiples_between(now, until, self.scenario.numerics.sample_interval),
            Due::At(_) | Due::Nothing => Vec::new(),
        };
        times.extend(multiples_between(now, until, WATCH_PERIOD));
        times.push(until);
        times.sort_by(f64::total_cmp);
        times.dedup_by(|later, earlier| is_same_time(*later, *earlier));
        self.go_through(&times)
    }

    /// Goes on through the given times and looks at the rover at each; with none, at the start.
    fn go_through(&mut self, times: &[f64]) -> Result<(), RunError> {
        let rim_speeds = std::mem::take(&mut self.state.set_speeds);
        let yaw_rate = self.scenario.yaw.as_ref().map(|yaw| yaw.rate_from(self.state.time));
        let limits = self.state.supply.as_ref().map_or(Vec::new(), |it| it.limits().to_vec());
        let near = std::mem::take(&mut self.state.near);
        let equations = Equations::of(self.scenario, &rim_speeds);
        let equations = equations.holding(yaw_rate).limited(&limits).near(near);
        equations.renew_allowance();
        let mut times = times;
        let mut done = Ok(());
        if self.state.approach == Approach::QuasiSteady {
            // Unless it goes on steadily, its velocities alone are known.
            let carried = std::mem::replace(&mut self.state.carried, Carried::Velocities);
            match self.go_steadily(&equations, carried, times) {
                Ok(carried) => self.state.carried = carried,
                Err(Ended::Failed(error)) => done = Err(error),
                // More time would not find it: nothing is known of the motion.
                Err(Ended::NotSteady(_)) if equations.is_spent() => {
                    done = Err(self.endless(&equations));
                }
                Err(Ended::NotSteady(because)) => {
                    equations.renew_allowance();
                    // What a search without an end left says nothing of this motion.
                    drop((equations.take_near(), equations.take_failure()));
                    let time = self.state.time;
                    self.state.approach = Approach::Dynamic;
                    if self.state.method == Method::QuasiSteady {
                        self.state.method = Method::FallbackToDynamic { time, because };
                    }
                    times = &times[times.partition_point(|other| *other <= time)..];
                }
            }
        }
        if self.state.approach == Approach::Dynamic && done.is_ok() {
            self.state.carried = Carried::Velocities;
            done = self.go_dynamically(&equations, times);
        }
        self.state.work += equations.work();
        self.state.near = equations.take_near();
        self.state.set_speeds = rim_speeds;
        done
    }

    /// Steady velocities, the pose integrated.
    fn go_steadily(
        &mut self,
        equations: &Equations<'_>,
        carried: Carried,
        times: &[f64],
    ) -> Result<Carried, Ended> {
        self.state.recorded.clear();
        let mut point = self.state.point;
        let (time, is_new) = (self.state.time, self.is_new_command);
        let started = SteadyRun::from(equations, carried, &mut point, time, is_new);
        let mut motion = started.map_err(Ended::NotSteady)?;
        if times.is_empty() {
            // A run starts steady: what its start would cost the motors is not in the energy
            // balance.
            point.start_work(&self.scenario.rover);
            let wheels = |_| Ok(motion.wheels(&point));
            let slips = motion.slips(equations, &point);
            let _ = self.look(equations, 0.0, &point, &slips, &wheels).map_err(Ended::Failed)?;
        }
        for &time in times {
            let times = [self.state.time, time];
            let advanced = motion.advance(&mut point, times, self.kept_until);
            advanced.map_err(Ended::NotSteady)?;
            let wheels = |_| Ok(motion.wheels(&point));
            let slips = motion.slips(equations, &point);
            let looked = self.look(equations, time, &point, &slips, &wheels);
            if looked.map_err(Ended::Failed)?.is_break() {
                break;
            }
        }
        Ok(motion.carry())
    }

    /// Pose and velocities integrated.
    fn go_dynamically(&mut self, equations: &Equations<'_>, times: &[f64]) -> Result<(), RunError> {
        let (start, start_time) = (self.state.point, self.state.time);
        let integrator = self.scenario.numerics.integrator;
        let mut history = std::mem::take(&mut self.state.history);
        let recorded = RefCell::new(std::mem::take(&mut self.state.recorded));
        let mut failed = None;
        let mut on_sample = |now: f64, reached: &Point| {
            let wheels = |is_on_the_way| {
                if is_on_the_way {
                    recorded.borrow_mut().next(equations, now, reached)
                } else {
                    equations.reactions_of(reached)
                }
            };
            self.look(equations, now, reached, &equations.slips(reached), &wheels).unwrap_or_else(
                |error| {
                    failed = Some(error);
                    ControlFlow::Break(())
                },
            )
        };
        let integrated = if times.is_empty() {
            let _ = on_sample(start_time, &start);
            Ok(())
        } else {
            match integrator {
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
        self.state.history = history;
        self.state.recorded = recorded.into_inner();
        if let Some(error) = failed {
            return Err(error);
        }
        if integrated.is_err() && equations.is_spent() {
            return Err(self.endless(equations));
        }
        if let Err(Stalled { time, reason }) = integrated {
            // The integrator stalls where the equations end: then their reason is the reason.
            match equations.take_failure() {
                Some(error) => self.state.outcome = Some(outcome_of(time, error)?),
                None => return Err(RunError::Stalled { time, reason }),
            }
        }
        Ok(())
    }

    /// The error of a run of which no more may be computed.
    fn endless(&self, equations: &Equations<'_>) -> RunError {
        let State { time, point, .. } = &*self.state;
        let place = equations.origin().unwrap_or_else(Vec2::zeros) + point.state.position;
        let reason = allowance::reason();
        RunError::Endless { time: *time, place, reason }
    }

    /// Looks at the rover: what became of it, and a record where one is due.
    fn look(
        &mut self,
        equations: &Equations<'_>,
        now: f64,
        reached: &Point,
        slips: &[Slip],
        wheels: Wheels<'_>,
    ) -> Result<ControlFlow<()>, RunError> {
        let rover = &reached.state;
        let state = &mut *self.state;
        (state.time, state.point) = (now, *reached);
        state.slip_ratios.clear();
        state.slip_ratios.extend(slips.iter().map(|slip| slip.ratio));
        if reached.turning.is_some() {
            state.rim_speeds.copy_from_slice(equations.turning(reached));
        }
        let is_power_known = state.supply.is_some() || state.most_taken.is_some();
        let is_watched = is_multiple(now, WATCH_PERIOD);
        if is_watched {
            equations.renew_allowance();
        }
        let has_belly = is_watched && equations.has_belly();
        let seen = (is_power_known || has_belly).then(|| wheels(false));
        let (without_power, high_centred) = match &seen {
            Some(Ok(wheels)) => {
                let belly = has_belly.then(|| equations.belly(rover, wheels)).flatten();
                (state.look_at_power(equations, wheels), touching(now, belly)?)
            }
            _ => (None, None),
        };
        if is_watched {
            let turning = watch::Wheels {
                slip_ratios: &state.slip_ratios,
                rim_speeds: &state.rim_speeds,
                set: equations.rim_speeds(),
            };
            state.outcome = if equations.is_overhanging(rover) {
                Some(Outcome::TippedOver { time: now })
            } else {
                state.watch.look(self.scenario, now, rover, turning)
            };
        }
        state.outcome = state.outcome.take().or(without_power).or(high_centred);
        let is_end = state.outcome.is_some();
        // What a run ends with does not depend on what it was recorded at before.
        let is_on_the_way =
            self.due == Due::Samples && !is_end && !is_same_time(now, self.scenario.duration);
        let is_due = match self.due {
            Due::Samples => {
                let interval = self.scenario.numerics.sample_interval;
                is_end || is_sample_due(now, interval, self.scenario.duration)
            }
            Due::At(time) => is_end || is_same_time(now, time),
            Due::Nothing => false,
        };
        if is_due {
            match seen.unwrap_or_else(|| wheels(is_on_the_way)) {
                Ok(wheels) => {
                    let supply = state.supply.as_ref();
                    self.records.push(Record::new(equations, now, reached, &wheels, supply));
                }
                Err(error) => {
                    let supply = state.supply.as_ref();
                    self.records.push(Record::new(equations, now, reached, &[], supply));
                    state.outcome = Some(outcome_of(now, error)?);
                }
            }
        }
        Ok(match state.outcome {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        })
    }
}

/// Why a quasi-steady motion went no further.
enum Ended {
    /// It is not valid from here on.
    NotSteady(NotSteady),
    /// It cannot be computed.
    Failed(RunError),
}

/// Wheels at the point that is looked at, if they are asked for: of a record on the way, or of any
/// other look.
type Wheels<'a> = &'a dyn Fn(bool) -> Result<Vec<WheelReaction>, ReactionError>;

/// What an underside on the ground means.
fn touching(time: f64, belly: Option<BellyPoint>) -> Result<Option<Outcome>, RunError> {
    match belly.filter(|belly| belly.clearance <= 0.0) {
        // A rover that starts there is misplaced.
        Some(BellyPoint { clearance, place }) if time == 0.0 => {
            Err(RunError::HighCentred { place, depth: -clearance })
        }
        touching => {
            Ok(touching.map(|BellyPoint { place, .. }| Outcome::HighCentred { time, place }))
        }
    }
}

/// The outcome that a missing reaction means, if it means one.
fn outcome_of(time: f64, error: ReactionError) -> Result<Outcome, RunError> {
    match error {
        ReactionError::Tipping(_) => Ok(Outcome::TippedOver { time }),
        ReactionError::Wheel { wheel, source: SettleError::SunkToAxle { load, capacity } } => {
            let because = StuckBecause::SunkToAxle { wheel, load, capacity };
            Ok(Outcome::Immobilised { time, because })
        }
        // A rover that starts there is misplaced.
        ReactionError::OffTheMap { wheel, place } if time > 0.0 => {
            Ok(Outcome::OffTheMap { time, wheel, place })
        }
        ReactionError::LoadsDoNotSettle { wheel, .. } | ReactionError::Unsettled { wheel, .. }
            if time == 0.0 =>
        {
            Err(RunError::UnbalancedStart { wheel })
        }
        source => Err(RunError::Reaction { time, source }),
    }
}
