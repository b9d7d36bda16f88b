//! A manoeuvre under way: what is left of it, how far it came, and whether a limit is passed.

use super::limits::{Known, Limits};
use super::navigator::Navigator;
use super::odometer::mean_speed;
use super::pilot::{Line, Pilot};
use super::stop::{Limited, Stop, Stopped};
use super::yaw_watch::{FellShort, Planned, YawWatch};
use crate::simulation::{CONTROL_PERIOD, LEAST_STEP, Outcome, Run, RunError};
use crate::units::Vec2;
use crate::vehicle::RoverState;

/// A manoeuvre ends this near to its end [m], [rad], [s]. Source: ours; far below what a rover
/// measures.
const CLOSE: f64 = 1e-7;
/// Without a limit of time a manoeuvre may take so many times as long as without slip, and a minute
/// more. Source: ours; at a slip ratio of 0.95 a rover is twenty times as slow.
const SLOWEST: f64 = 20.0;
const MINUTE: f64 = 60.0;
/// A rover turns on the spot from this share of the rate that its sides would give on rigid ground
/// on [-]: below, it shifts. Source: ours; on sand the share is a quarter.
const TURNS: f64 = 0.05;
/// The longest time for which wheels are expected to keep their speeds [s]. Source: ours.
const LONGEST_STRETCH: f64 = 3600.0;

/// How a manoeuvre ended.
#[derive(Clone, Debug)]
pub(super) enum End {
    Reached,
    Short(FellShort),
    Stopped(Stopped),
    Ended(Outcome),
}

/// What ends a manoeuvre.
#[derive(Clone, Copy, Debug)]
pub(super) enum Goal {
    /// A way over the ground [m].
    Ground(f64),
    /// A way of the rims [m].
    Rims(f64),
    /// A yaw [rad], and the fastest that the rover may turn towards it [rad/s].
    Yaw { yaw: f64, fastest: f64 },
    /// A yaw at the end of an arc [rad], the turn that leads there [rad], and the way of the arc
    /// [m].
    Arc { yaw: f64, angle: f64, way: f64 },
    /// A place, how near is near enough [m], and the line that leads there.
    Place { place: Vec2, within: f64, line: Line },
    /// A time since the start of the mission [s].
    Time(f64),
}

/// A manoeuvre under way.
#[derive(Clone)]
pub(super) struct Driven {
    pilot: Pilot,
    limits: Limits,
    goal: Goal,
    /// Way over the ground as the rover knew it at the start [m].
    start_ground: f64,
    /// How far it really came [m].
    gone: f64,
    /// Way of the rims at the last fix of its place [m].
    rims_at_fix: f64,
    /// How fast it turned on the spot when it last did [rad/s].
    turn_rate: Option<f64>,
    /// Whether a turn or an arc gets on, and what it may lack at its end.
    yaw: Option<(YawWatch, Stop)>,
}

/// Yaw that a turn or an arc may lack, unless its leg says otherwise [rad]: 2°. Source: ours; what
/// rovers measure of their heading after some minutes without the Sun.
const MOST_SHORT: f64 = 2.0 * std::f64::consts::PI / 180.0;

impl Driven {
    /// A manoeuvre that begins here.
    ///
    /// * `nominal`: how long it would take without slip [s]
    pub(super) fn new(
        run: &Run,
        navigator: &Navigator,
        pilot: Pilot,
        (goal, nominal): (Goal, f64),
        stops: &[Stop],
    ) -> Self {
        let mut stops = stops.to_vec();
        let (longest, seen) = (SLOWEST * nominal + MINUTE, navigator.seen());
        let (start, from) = (run.state().time(), seen.yaw);
        let planned = |to, way| Planned { from, to, way, start, nominal, longest };
        let planned = match goal {
            Goal::Yaw { yaw, .. } => Some(planned(yaw, None)),
            Goal::Arc { yaw, way, .. } => Some(planned(yaw, Some(way))),
            Goal::Ground(_) | Goal::Rims(_) | Goal::Place { .. } | Goal::Time(_) => None,
        };
        let short = stops.iter().position(|stop| stop.limited == Limited::Shortfall);
        let short =
            short.map_or(Stop::above(Limited::Shortfall, MOST_SHORT), |at| stops.remove(at));
        // A turn that takes too long falls short.
        if planned.is_none() && stops.iter().all(|stop| stop.limited != Limited::Time) {
            stops.push(Stop::above(Limited::Time, longest));
        }
        Self {
            pilot,
            limits: Limits::begun(run, seen.position, stops),
            goal,
            start_ground: navigator.ground(),
            gone: 0.0,
            rims_at_fix: 0.0,
            turn_rate: None,
            yaw: planned.map(|planned| (YawWatch::new(&planned), short)),
        }
    }

    /// Real way over the ground so far [m].
    pub(super) fn gone(&self) -> f64 {
        self.gone
    }

    /// Way over the ground so far, as the rover knows it [m].
    pub(super) fn ground(&self) -> f64 {
        self.limits.odometer().ground()
    }

    /// Real slip ratio so far [-], of manoeuvres that lead somewhere.
    pub(super) fn slip_ratio(&self) -> Option<f64> {
        let rims = self.limits.odometer().rims();
        (self.is_drive() && rims > 0.0).then(|| 1.0 - self.gone / rims)
    }

    /// Drives for some metres over the ground; how the manoeuvre ended, if it did.
    pub(super) fn drive_for(
        &mut self,
        run: &mut Run,
        navigator: &mut Navigator,
        way: f64,
    ) -> Result<Option<End>, RunError> {
        let until = self.ground() + way;
        while self.ground() < until {
            if let Some(end) = self.step(run, navigator)? {
                return Ok(Some(end));
            }
        }
        Ok(None)
    }

    /// Drives to the next look; how the manoeuvre ended, if it did.
    pub(super) fn step(
        &mut self,
        run: &mut Run,
        navigator: &mut Navigator,
    ) -> Result<Option<End>, RunError> {
        let (left, rate) = self.left(run, navigator.seen());
        if left <= CLOSE {
            return Ok(Some(self.arrived(navigator.seen())));
        }
        self.go_on(run, navigator, left, rate)?;
        let ended = run.outcome().map(|outcome| End::Ended(outcome.clone()));
        let stopped = ended.or_else(|| self.passed(run, navigator.seen()).map(End::Stopped));
        Ok(stopped.or_else(|| self.given_up(run, navigator.seen())))
    }

    /// Drives to the next look, or to the end of the manoeuvre where that comes before.
    ///
    /// * `left`, `rate`: how much of it is left, and how fast that becomes less
    fn go_on(
        &mut self,
        run: &mut Run,
        navigator: &mut Navigator,
        left: f64,
        rate: f64,
    ) -> Result<(), RunError> {
        self.pilot.seen = *navigator.seen();
        let now = run.state().time();
        let next = ((now / CONTROL_PERIOD).round() + 1.0) * CONTROL_PERIOD;
        let eta = if rate > 0.0 { left / rate } else { f64::INFINITY };
        let until = if now + eta < next { now + eta.max(LEAST_STEP) } else { next };
        let kept_until =
            if self.pilot.is_steady() { now + eta.min(LONGEST_STRETCH) } else { until };
        let rims = run.state().rim_speeds().to_vec();
        run.advance_unrecorded(&mut self.pilot, until, kept_until.max(until))?;
        run.start_rolling(&rims);
        let state = run.state();
        self.gone +=
            navigator.look(state.time(), state.rover(), run.scenario(), state.rim_speeds());
        let (place, ground) = (navigator.seen().position, navigator.ground() - self.start_ground);
        self.limits.record_from(run, place, ground);
        if navigator.is_fixed() {
            self.limits.lay_anew(self.rims_at_fix);
            self.rims_at_fix = self.limits.odometer().rims();
        }
        self.pilot.gone = ground;
        if let Goal::Yaw { fastest, .. } = self.goal {
            let rate = run.state().rover().yaw_rate.abs();
            self.turn_rate = Some(rate).filter(|rate| *rate > TURNS * fastest).or(self.turn_rate);
        }
        Ok(())
    }

    /// Whether it leads somewhere: slip, drift and distance from the path are looked at.
    fn is_drive(&self) -> bool {
        match self.goal {
            Goal::Ground(_) | Goal::Rims(_) | Goal::Place { .. } | Goal::Arc { .. } => true,
            Goal::Yaw { .. } | Goal::Time(_) => false,
        }
    }

    /// What is left of the manoeuvre, and how fast that becomes less.
    fn left(&self, run: &Run, state: &RoverState) -> (f64, f64) {
        match self.goal {
            Goal::Ground(way) => (way - self.limits.odometer().ground(), state.velocity.norm()),
            Goal::Rims(way) => {
                (way - self.limits.odometer().rims(), mean_speed(run.state().rim_speeds()))
            }
            Goal::Yaw { yaw, fastest } => {
                let error = yaw - state.yaw;
                // Whatever it does now, it may turn towards it next, and must not turn past it.
                (error.abs(), self.turn_rate.unwrap_or(fastest))
            }
            Goal::Arc { yaw, angle, .. } => {
                let side = angle.signum();
                (side * (yaw - state.yaw), side * state.yaw_rate)
            }
            Goal::Place { place, within, line } => {
                let away = (place - state.position).norm() - within;
                let along = line.along(place) - line.along(state.position);
                (away.min(along.max(0.0)), state.velocity.norm())
            }
            Goal::Time(time) => (time - run.state().time(), 1.0),
        }
    }

    /// How it ended where nothing of it is left: a place may have been missed.
    fn arrived(&self, seen: &RoverState) -> End {
        let Goal::Place { place, within, .. } = self.goal else { return End::Reached };
        let off = (place - seen.position).norm();
        if off <= within + CLOSE {
            return End::Reached;
        }
        End::Stopped(self.limits.stopped(Stop::above(Limited::OffPath, within), off))
    }

    /// How a turn or an arc ends of which no more is to be expected: what it lacks may be little
    /// enough.
    fn given_up(&mut self, run: &Run, seen: &RoverState) -> Option<End> {
        let ground = self.ground();
        let (watch, short) = self.yaw.as_mut()?;
        let because = watch.look(run.state().time(), seen.yaw, ground)?;
        let left = watch.left(seen.yaw);
        if left <= short.above {
            return Some(End::Reached);
        }
        let (asked, turned) = (watch.to - watch.from, seen.yaw - watch.from);
        let stopped = self.limits.stopped(*short, left);
        Some(End::Short(FellShort { asked, turned, because, stopped }))
    }

    /// The first limit that is passed now.
    fn passed(&self, run: &Run, seen: &RoverState) -> Option<Stopped> {
        let (off_path, is_drive) = (self.pilot.path().off(run.scenario(), seen), self.is_drive());
        self.limits.passed_as(run, Known { seen, off_path, is_drive })
    }
}
