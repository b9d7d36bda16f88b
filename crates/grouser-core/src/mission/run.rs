//! A mission on its way.

use super::angles::turned;
use super::driven::{Driven, End, Goal};
use super::look_ahead::Ahead;
use super::navigator::Navigator;
use super::pilot::{Pilot, line_of, reach};
use super::plan::{Heading, Leg, Manoeuvre, Measure, Mission, PlanError};
use super::report::{BackOut, LegOutcome, LegReport, MissionReport, Taken};
use super::stop::Then;
use crate::simulation::{Method, Record, Run, RunError, Scenario, Start, State};
use crate::vehicle::RoverState;

/// A mission, as far as it has come.
///
/// A clone goes on as the original would, bit for bit.
#[derive(Clone)]
pub struct MissionRun {
    mission: Mission,
    run: Run,
    navigator: Navigator,
    reports: Vec<LegReport>,
    is_over: bool,
}

/// A turn on the spot to the yaw of a leg is left out below this [rad]: 0.1°. Source: ours.
const SAME_YAW: f64 = 1.75e-3;
/// A rover turns on the spot towards a place that is further off its nose than this [rad]: 15°.
/// Source: ours.
const OFF_NOSE: f64 = 0.262;

/// So many records are looked at together. Source: ours; some megabytes.
const BATCH: usize = 1024;

/// Who looks at records, and whether they took them.
type Watch<'w> = &'w mut dyn FnMut(&[Record]) -> bool;

/// Why a mission could not be computed. (What a rover does is an outcome, not an error.)
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MissionError {
    /// A leg is invalid, or the mission is.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The motion could not be computed.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl MissionRun {
    /// A mission at its start.
    ///
    /// # Errors
    /// [`MissionError`] if there can be no such mission, or its start cannot be computed.
    pub fn new(mission: &Mission) -> Result<Self, MissionError> {
        mission.check()?;
        let first = &mission.legs[0];
        let start = &mission.scenario.start;
        let start = Start { yaw: first.yaw.unwrap_or(start.yaw), ..*start };
        let scenario = Scenario { start, ..mission.scenario.clone() };
        let state = RoverState { yaw: start.yaw, ..RoverState::default() };
        let straight = scenario.rover.steering_angles();
        let mut pilot = match first.turn_before(&scenario, &state, true) {
            Some(yaw) => Pilot::to_yaw(yaw, &state, first.speed(), &straight),
            None => Pilot::of_leg(first, &scenario, &state, &straight),
        };
        let run = Run::with_controller(&scenario, &mut pilot)?;
        let mission = mission.clone();
        let navigator = Navigator::new(mission.sensors, run.state().rover());
        Ok(Self { mission, run, navigator, reports: Vec::new(), is_over: false })
    }

    /// Drives the mission to its end.
    ///
    /// # Errors
    /// [`RunError`] where the motion cannot be computed.
    pub fn to_end(mut self) -> Result<MissionReport, RunError> {
        while self.next_leg()?.is_some() {}
        Ok(self.finish())
    }

    /// Drives the next leg; none if the mission is over.
    ///
    /// # Errors
    /// The same as [`to_end`](Self::to_end).
    pub fn next_leg(&mut self) -> Result<Option<&LegReport>, RunError> {
        self.next_leg_watched(&mut |_| false)
    }

    /// The same, with someone who looks at the records as they come: if they say that they have
    /// taken them, they are not kept, so that a mission of weeks needs no more memory than one of
    /// minutes.
    ///
    /// * `watch`: gets the records since it last took them, some at a time
    ///
    /// # Errors
    /// The same as [`to_end`](Self::to_end).
    pub fn next_leg_watched(&mut self, watch: Watch<'_>) -> Result<Option<&LegReport>, RunError> {
        if self.is_over {
            return Ok(None);
        }
        let place = self.reports.len();
        let leg = self.mission.legs[place].clone();
        let report = self.drive(&leg, watch)?;
        let goes_on = report.outcome.then() == Then::NextLeg;
        self.reports.push(report);
        self.is_over = !goes_on || self.reports.len() == self.mission.legs.len();
        Ok(self.reports.last())
    }

    /// What became of it so far.
    #[must_use]
    pub fn finish(mut self) -> MissionReport {
        self.run.record();
        let trajectory = self.run.finish();
        MissionReport { legs: self.reports, trajectory, fixes: self.navigator.into_fixes() }
    }

    /// All that changes in its run.
    #[must_use]
    pub fn state(&self) -> &State {
        self.run.state()
    }

    /// The rover now.
    #[must_use]
    pub fn rover(&self) -> &RoverState {
        self.run.state().rover()
    }

    /// Time since the start [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.run.state().time()
    }

    /// How the motion was computed so far: where no steady motion was found, it is sought again when
    /// the wheels are to turn otherwise and with the next manoeuvre, and this says why it was not
    /// found first.
    #[must_use]
    pub fn method(&self) -> &Method {
        self.run.state().method()
    }

    fn drive(&mut self, leg: &Leg, watch: Watch<'_>) -> Result<LegReport, RunError> {
        let (time, energy, electrical) = (self.time(), self.energy(), self.begin_taken());
        let is_first = self.reports.is_empty();
        let stops = self.mission.stops_of(leg);
        let straight = self.mission.scenario.rover.steering_angles();
        let mut turned_to = End::Reached;
        if let Some(yaw) = leg.turn_before(self.run.scenario(), self.navigator.seen(), is_first) {
            let seen = self.navigator.seen();
            let pilot = Pilot::to_yaw(yaw, seen, leg.speed(), &straight);
            let goal = self.turn_to(yaw, leg);
            let mut turn = Driven::new(&self.run, &self.navigator, pilot, goal, &stops);
            turned_to = self.drive_on(&mut turn, None, watch)?;
        }
        let (mut distance, mut slip_ratio) = (0.0, None);
        let before = self.rover().yaw;
        let is_begun = matches!(turned_to, End::Reached);
        let end = match turned_to {
            End::Reached => {
                let pilot =
                    Pilot::of_leg(leg, self.run.scenario(), self.navigator.seen(), &straight);
                let goal = self.goal(leg);
                let mut driven = Driven::new(&self.run, &self.navigator, pilot, goal, &stops);
                let end = self.drive_on(&mut driven, leg.look_ahead, watch)?;
                (distance, slip_ratio) = (driven.gone(), driven.slip_ratio());
                end
            }
            other => other,
        };
        let (time, energy) = (self.time() - time, self.energy() - energy);
        let taken = self.taken_since(electrical);
        let outcome = LegOutcome::from(end);
        let end = *self.rover();
        let turned = Some(end.yaw - before).filter(|_| is_begun && leg.manoeuvre.turns());
        let back_out = match outcome.then() {
            Then::BackOut(way) => Some(self.back_out(leg, way, watch)?),
            Then::End | Then::NextLeg => None,
        };
        Ok(LegReport { outcome, distance, time, energy, taken, slip_ratio, turned, end, back_out })
    }

    /// Drives against the way of a leg.
    fn back_out(&mut self, leg: &Leg, way: f64, watch: Watch<'_>) -> Result<BackOut, RunError> {
        let (time, energy, electrical) = (self.time(), self.energy(), self.begin_taken());
        let direction = match leg.manoeuvre.direction() {
            0.0 => -1.0,
            direction => -direction,
        };
        let straight = self.mission.scenario.rover.steering_angles();
        let pilot = Pilot::ahead(leg.speed(), direction, self.navigator.seen(), &straight);
        let goal = (Goal::Ground(way), way / leg.speed());
        let mut back = Driven::new(&self.run, &self.navigator, pilot, goal, &[]);
        let outcome = self.drive_on(&mut back, None, watch)?.into();
        let distance = back.gone();
        let (time, energy) = (self.time() - time, self.energy() - energy);
        let taken = self.taken_since(electrical);
        Ok(BackOut { outcome, distance, time, energy, taken })
    }

    /// The end of a leg's manoeuvre from here, and how long that would take without slip [s].
    fn goal(&self, leg: &Leg) -> (Goal, f64) {
        let state = self.navigator.seen();
        match leg.manoeuvre {
            Manoeuvre::Drive { distance, by } => {
                let way = distance.abs();
                let goal = if by == Measure::Ground { Goal::Ground(way) } else { Goal::Rims(way) };
                (goal, way / leg.speed())
            }
            Manoeuvre::Turn { angle } => self.turn_to(state.yaw + angle, leg),
            Manoeuvre::Arc { radius, angle, .. } => {
                let way = radius * angle.abs();
                (Goal::Arc { yaw: state.yaw + angle, angle, way }, way / leg.speed())
            }
            Manoeuvre::Goto { place, within, .. } => {
                let nominal = (place - state.position).norm() / leg.speed();
                (
                    Goal::Place { place, within, line: line_of(leg, self.run.scenario(), state) },
                    nominal,
                )
            }
            Manoeuvre::Wait { time } => (Goal::Time(self.time() + time), time),
        }
    }

    /// Drives a manoeuvre on to its end, or to the limit or the outcome that ends it before.
    ///
    /// * `look_ahead`: way that is simulated before it is driven [m]
    fn drive_on(
        &mut self,
        driven: &mut Driven,
        look_ahead: Option<f64>,
        watch: Watch<'_>,
    ) -> Result<End, RunError> {
        self.run.try_steady_again();
        let mut ahead = look_ahead.map(Ahead::new);
        loop {
            if let Some(ahead) = &mut ahead
                && let Some(stopped) = ahead.look(&self.run, &self.navigator, driven)?
            {
                return Ok(End::Stopped(stopped));
            }
            let end = driven.step(&mut self.run, &mut self.navigator)?;
            let records = self.run.kept();
            if (records.len() >= BATCH || end.is_some()) && watch(records) {
                drop(self.run.take_records());
            }
            if let Some(end) = end {
                return Ok(end);
            }
        }
    }

    fn energy(&self) -> f64 {
        self.run.state().motor_work()
    }

    /// Sees from now on what motors and battery take; the electrical energy so far [J].
    fn begin_taken(&mut self) -> f64 {
        self.run.begin_most_taken();
        self.run.state().electrical_work()
    }

    /// What motors and battery took since that was begun, where motors are known.
    ///
    /// * `electrical`: electrical energy until then [J]
    fn taken_since(&self, electrical: f64) -> Option<Taken> {
        let (most, state) = (self.run.most_taken()?, self.run.state());
        Some(Taken {
            energy: state.electrical_work() - electrical,
            current: most.current,
            temperature: most.temperature,
            charge: state.battery().map(|battery| battery.charge),
        })
    }

    /// A turn on the spot to a yaw [rad], and how long it would take without slip [s].
    fn turn_to(&self, yaw: f64, leg: &Leg) -> (Goal, f64) {
        let fastest = leg.speed() / reach(self.run.scenario().rover.mounts());
        (Goal::Yaw { yaw, fastest }, (yaw - self.navigator.seen().yaw).abs() / fastest)
    }
}

impl Leg {
    /// The yaw to which a rover turns on the spot before the leg [rad], if it does.
    ///
    /// * `state`: of the rover where it begins
    /// * `is_first`: whether it is the first leg, which begins with its yaw
    #[must_use]
    pub fn turn_before(
        &self,
        scenario: &Scenario,
        state: &RoverState,
        is_first: bool,
    ) -> Option<f64> {
        let yaw = match (self.yaw, self.manoeuvre) {
            (Some(_), _) if is_first => return None,
            (Some(yaw), _) => yaw,
            // Its wheels turn in place of its nose.
            (None, Manoeuvre::Goto { .. }) if matches!(self.heading, Heading::Crab { .. }) => {
                return None;
            }
            // Where it already is, no direction leads there.
            (None, Manoeuvre::Goto { place, within, .. })
                if (place - state.position).norm() <= within =>
            {
                return None;
            }
            (None, Manoeuvre::Goto { .. }) => {
                let nose = line_of(self, scenario, state).yaw();
                if (nose - state.yaw).abs() < OFF_NOSE {
                    return None;
                }
                nose
            }
            (None, _) => return None,
        };
        let angle = turned(yaw - state.yaw);
        (angle.abs() > SAME_YAW).then_some(state.yaw + angle)
    }
}
