//! A manoeuvre under way: what is left of it, how far it came, and whether a limit is passed.

use super::navigator::Navigator;
use super::odometer::{Odometer, mean_speed};
use super::pilot::{Line, Path, Pilot};
use super::plan::Leg;
use super::stop::{Cause, Limited, Stop, Stopped};
use crate::simulation::{CONTROL_PERIOD, LEAST_STEP, Outcome, Run, RunError};
use crate::units::Vec2;
use crate::vehicle::{Mount, RoverState, roll_and_pitch};

/// A manoeuvre ends this near to its end [m], [rad], [s]. Source: ours; far below what a rover measures.
const CLOSE: f64 = 1e-7;
/// Without a limit of time a manoeuvre may take so many times as long as without slip, and a minute more. Source: ours; at
/// a slip ratio of 0.95 a rover is twenty times as slow.
const SLOWEST: f64 = 20.0;
const MINUTE: f64 = 60.0;
/// A rover turns on the spot from this share of the rate that its sides would give on rigid ground on [-]: below, it shifts.
/// Source: ours; on sand the share is a quarter.
const TURNS: f64 = 0.05;
/// The longest time for which wheels are expected to keep their speeds [s]. Source: ours.
const LONGEST_STRETCH: f64 = 3600.0;

/// How a manoeuvre ended.
#[derive(Clone, Debug)]
pub(super) enum End {
    Reached,
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
    /// A place, how near is near enough [m], and the line that leads there.
    Place { place: Vec2, within: f64, line: Line },
    /// A time since the start of the mission [s].
    Time(f64),
}

/// A manoeuvre under way.
#[derive(Clone)]
pub(super) struct Driven {
    pilot: Pilot,
    odometer: Odometer,
    goal: Goal,
    stops: Vec<Stop>,
    path: Path,
    start_time: f64,
    start_work: f64,
    /// Way over the ground as the rover knew it at the start [m].
    start_ground: f64,
    /// How far it really came [m].
    gone: f64,
    /// Way of the rims at the last fix of its place [m].
    rims_at_fix: f64,
    /// How fast it turned on the spot when it last did [rad/s].
    turn_rate: Option<f64>,
}

impl Driven {
    /// A manoeuvre that begins here.
    ///
    /// * `leg`: whose path it is meant to stay on
    /// * `nominal`: how long it would take without slip [s]
    pub(super) fn new(
        run: &Run,
        navigator: &Navigator,
        pilot: Pilot,
        (goal, nominal): (Goal, f64),
        leg: &Leg,
        stops: &[Stop],
    ) -> Self {
        let mut stops = stops.to_vec();
        if stops.iter().all(|stop| stop.limited != Limited::Time) {
            stops.push(Stop::above(Limited::Time, SLOWEST * nominal + MINUTE));
        }
        let ways = stops.iter().filter(|stop| stop.limited.is_of_a_way()).map(|stop| stop.over);
        let remembered = ways.fold(0.0, f64::max);
        let (state, seen) = (run.state(), navigator.seen());
        Self {
            pilot,
            odometer: Odometer::new(state.time(), seen.position, remembered),
            goal,
            stops,
            path: Path::of_leg(leg, seen),
            start_time: state.time(),
            start_work: state.motor_work(),
            start_ground: navigator.ground(),
            gone: 0.0,
            rims_at_fix: 0.0,
            turn_rate: None,
        }
    }

    /// Real way over the ground so far [m].
    pub(super) fn gone(&self) -> f64 {
        self.gone
    }

    /// Way over the ground so far, as the rover knows it [m].
    pub(super) fn ground(&self) -> f64 {
        self.odometer.ground()
    }

    /// Real slip ratio so far [-], of manoeuvres that lead somewhere.
    pub(super) fn slip_ratio(&self) -> Option<f64> {
        let rims = self.odometer.rims();
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
        Ok(ended.or_else(|| self.passed(run, navigator.seen()).map(End::Stopped)))
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
        run.go_on(&mut self.pilot, until, kept_until.max(until))?;
        run.set_off(&rims);
        let (state, mounts) = (run.state(), run.scenario().rover.mounts());
        self.gone += navigator.look(state.time(), state.rover(), mounts, state.rim_speeds());
        let (place, ground) = (navigator.seen().position, navigator.ground() - self.start_ground);
        self.odometer.look(state.time(), place, ground, state.rim_speeds());
        if navigator.is_fixed() {
            self.odometer.lay_anew(self.rims_at_fix);
            self.rims_at_fix = self.odometer.rims();
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
        matches!(self.goal, Goal::Ground(_) | Goal::Rims(_) | Goal::Place { .. })
    }

    /// What is left of the manoeuvre, and how fast that becomes less.
    fn left(&self, run: &Run, state: &RoverState) -> (f64, f64) {
        match self.goal {
            Goal::Ground(way) => (way - self.odometer.ground(), state.velocity.norm()),
            Goal::Rims(way) => (way - self.odometer.rims(), mean_speed(run.state().rim_speeds())),
            Goal::Yaw { yaw, fastest } => {
                let error = yaw - state.yaw;
                // Whatever it does now, it may turn towards it next, and must not turn past it.
                (error.abs(), self.turn_rate.unwrap_or(fastest))
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
        End::Stopped(self.stopped(Stop::above(Limited::OffPath, within), off))
    }

    fn stopped(&self, stop: Stop, value: f64) -> Stopped {
        let (cause, kind) = (Cause::Limit { stop, value }, stop.limited.kind());
        Stopped { cause, kind, after: self.odometer.ground() }
    }

    /// The first limit that is passed now.
    fn passed(&self, run: &Run, seen: &RoverState) -> Option<Stopped> {
        let [sinkage, torque] = self.of_wheels(run);
        let state = run.state();
        let [roll, pitch] = roll_and_pitch(run.scenario().site.terrain.slope, seen.yaw);
        let value = |stop: &Stop| match stop.limited {
            Limited::SlipRatio => Some(self.odometer.over(stop.over)?.slip_ratio),
            Limited::Drift => Some(self.odometer.over(stop.over)?.drift),
            Limited::OffPath => Some(self.path.off(seen.position)),
            Limited::Sinkage => Some(sinkage),
            Limited::Roll => Some(roll.abs()),
            Limited::Pitch => Some(pitch.abs()),
            Limited::Torque => Some(torque),
            Limited::Time => Some(state.time() - self.start_time),
            Limited::Energy => Some(state.motor_work() - self.start_work),
        };
        let is_looked_at = |stop: &&Stop| self.is_drive() || !stop.limited.is_of_a_drive();
        self.stops.iter().filter(is_looked_at).find_map(|stop| {
            let value = value(stop)?;
            (value > stop.above).then(|| self.stopped(*stop, value))
        })
    }

    /// Largest sinkage over the shearing radius [-] and largest torque [N·m] of a wheel, if some limit needs them.
    fn of_wheels(&self, run: &Run) -> [f64; 2] {
        if !self.stops.iter().any(|stop| stop.limited.needs_wheels()) {
            return [0.0; 2];
        }
        let radii = run.scenario().rover.mounts().iter().map(Mount::shearing_radius);
        let each = run.wheels().into_iter().zip(radii).map(|(wheel, radius)| {
            [wheel.settled.sinkage / radius, wheel.settled.forces.torque.abs()]
        });
        each.fold([0.0, 0.0], |most, one| [most[0].max(one[0]), most[1].max(one[1])])
    }
}
