//! A run: a scenario on its way, step by step or to its end.

use std::cell::Cell;
use std::sync::OnceLock;

use super::controller::{Controller, Observation};
use super::equations::Equations;
use super::error::RunError;
use super::leg::{Due, Leg};
use super::most_taken::MostTaken;
use super::outcome::Outcome;
use super::record::Record;
use super::scenario::{LONGEST_DURATION, Motion, ROLLING_SHARE, Scenario};
use super::state::State;
use super::steady_run::Carried;
use super::supply::{LIMIT_PERIOD, Supply};
use super::times::{is_same_time, multiple_after, multiples_between, snapped};
use super::trajectory::Trajectory;
use super::turning::Turning;
use super::watch::{LEAST_PROGRESS, WATCH_PERIOD};
use super::work::Work;
use crate::error::{ParameterError, positive};
use crate::units::Vec2;
use crate::vehicle::kinematics::rolling_velocity;
use crate::vehicle::{DriveLaw, Electrical, Rover, WheelReaction};

/// The shortest step [s]. Source: ours; slip settles within milliseconds, no rover's control is a
/// thousand times faster.
pub const LEAST_STEP: f64 = 1e-6;

/// A run of a scenario, as far as it has come.
///
/// The motion is the same by every way of leading it, by the same equations and the same
/// integrator: [`to_end`](Self::to_end) by the scenario's own drive, [`advance`](Self::advance) by
/// a [`Controller`], [`step`](Self::step) by one command after the other.
///
/// A clone goes on as the original would, bit for bit.
///
/// How far downhill is a rover after 20 s across a slope of 10°, and how long does it need for half
/// a metre if the wheels on its right turn faster?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::Run;
///
/// let scenario = paper::traverse()?;
/// let trajectory = Run::new(&scenario)?.to_end()?;
/// assert_eq!(format!("{:.0} mm", 1e3 * trajectory.last().state.position.y), "-97 mm");
///
/// // One command after the other, each for a tenth of a second:
/// let mut run = Run::new(&scenario)?;
/// while run.outcome().is_none() && run.now().state.position.x < 0.5 {
///     run.step(&[0.055, 0.055, 0.065, 0.065], 0.1)?;
/// }
/// assert_eq!(format!("{:.1} s", run.now().time), "8.9 s");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Run {
    scenario: Scenario,
    state: State,
    /// Those that stay.
    records: Vec<Record>,
    /// The one of the state, if it is another, and all with it: made when someone asks for them.
    now: OnceLock<Record>,
    all: OnceLock<Vec<Record>>,
}

impl Run {
    /// The run of a scenario, at its start, with the wheels turning as the scenario's drive says.
    ///
    /// # Errors
    /// [`RunError`] if the scenario is no run, or the wheels do not settle at its start for another
    /// reason than a physical one.
    pub fn new(scenario: &Scenario) -> Result<Self, RunError> {
        Self::with_controller(scenario, &mut scenario.drive.clone())
    }

    /// The same with wheels that turn as a controller says.
    ///
    /// # Errors
    /// The same as [`new`](Self::new).
    pub fn with_controller(
        scenario: &Scenario,
        controller: &mut dyn Controller,
    ) -> Result<Self, RunError> {
        scenario.check()?;
        let standing = vec![0.0; scenario.rover.wheel_count()];
        let mut state = State::new(scenario, standing.clone());
        let commanded = ask(controller, scenario, &mut state)?;
        let work = state.work;
        state = State { work, ..State::new(scenario, commanded) };
        state.settle_motors(scenario);
        let kept_until = if controller.period().is_some() { 0.0 } else { scenario.duration };
        let mut records = Vec::new();
        let leg = Leg {
            scenario,
            state: &mut state,
            records: &mut records,
            is_new_command: true,
            kept_until,
            due: Due::Samples,
        };
        leg.start()?;
        Ok(Self::at(scenario.clone(), state, records))
    }

    /// A run that goes on from a [`state`](Self::state) of the same scenario.
    #[must_use]
    pub fn resume(scenario: &Scenario, state: State) -> Self {
        let mut run = Self::at(scenario.clone(), state, Vec::new());
        if let Some(steered) = &run.state.steered {
            run.scenario.rover = Rover::clone(steered);
        }
        run.record();
        run
    }

    /// Another run from here, with a changed state or scenario and without records.
    pub(super) fn changed(&self, change: impl FnOnce(&mut State, &mut Scenario)) -> Self {
        let (mut scenario, mut state) = (self.scenario.clone(), self.state.clone());
        change(&mut state, &mut scenario);
        Self::at(scenario, state, Vec::new())
    }

    fn at(scenario: Scenario, state: State, records: Vec<Record>) -> Self {
        Self { scenario, state, records, now: OnceLock::new(), all: OnceLock::new() }
    }

    /// Leads the run by the scenario's own drive to the end of the scenario, or to the outcome that
    /// ends it before.
    ///
    /// # Errors
    /// [`RunError`] if the run cannot be computed.
    pub fn to_end(self) -> Result<Trajectory, RunError> {
        self.into_trajectory(Due::Samples)
    }

    /// Leads the run to its end and keeps it: where it cannot be computed to its end, the
    /// [records](Self::records) until there are known.
    ///
    /// # Errors
    /// The same as [`to_end`](Self::to_end).
    pub fn run_to_end(&mut self) -> Result<(), RunError> {
        self.play(self.scenario.duration)
    }

    /// Leads the run by the scenario's own drive for a while [s], at most to the end of the
    /// scenario: steps of a tenth of a second lead where one call to the end does, bit for bit.
    ///
    /// # Errors
    /// The same as [`to_end`](Self::to_end).
    pub fn play(&mut self, span: f64) -> Result<(), RunError> {
        let (mut drive, duration) = (self.scenario.drive.clone(), self.scenario.duration);
        // At the start the wheels turn as it says already.
        let is_asked = self.state.time > 0.0;
        let until = snapped(self.state.time + span, WATCH_PERIOD).min(duration);
        self.lead(&mut drive, [until, duration], is_asked, Due::Samples)
    }

    /// Does what [`to_end`](Self::to_end) does, with records of start and end alone: what a run
    /// costs beside them is its motion.
    ///
    /// # Errors
    /// The same as [`to_end`](Self::to_end).
    pub fn to_outcome(self) -> Result<Trajectory, RunError> {
        let end = Due::At(self.scenario.duration);
        self.into_trajectory(end)
    }

    fn into_trajectory(mut self, due: Due) -> Result<Trajectory, RunError> {
        let (mut drive, duration) = (self.scenario.drive.clone(), self.scenario.duration);
        // At the start the wheels turn as it says already.
        let is_asked = self.state.time > 0.0;
        self.lead(&mut drive, [duration, duration], is_asked, due)?;
        Ok(self.finish())
    }

    /// Leads the run by a controller to a time [s], or to the outcome that ends it before. The
    /// controller is asked now and after each of its periods.
    ///
    /// # Errors
    /// [`RunError`] for commands that no wheel can follow, and where the motion cannot be computed,
    /// at which the rover stays where it last was looked at.
    pub fn advance(&mut self, controller: &mut dyn Controller, until: f64) -> Result<(), RunError> {
        self.lead(controller, [until, until], true, Due::Samples)
    }

    /// Leads the run by a controller for a while [s], as [`advance`](Self::advance) does to a time:
    /// steps of a tenth of a second lead through the times that one call to the end looks at.
    ///
    /// # Errors
    /// The same as [`advance`](Self::advance).
    pub fn advance_by(
        &mut self,
        controller: &mut dyn Controller,
        span: f64,
    ) -> Result<(), RunError> {
        let until = snapped(self.state.time + span, WATCH_PERIOD);
        self.advance(controller, until)
    }

    /// Does what [`advance`](Self::advance) does, without a record of where that leads.
    ///
    /// * `kept_until`: until when a controller that is asked once expects to keep its speeds [s]
    pub(crate) fn advance_unrecorded(
        &mut self,
        controller: &mut dyn Controller,
        until: f64,
        kept_until: f64,
    ) -> Result<(), RunError> {
        self.lead(controller, [until, kept_until], true, Due::Samples)
    }

    /// Seeks steady motions again where none was found before.
    pub(crate) fn try_steady_again(&mut self) {
        self.state.approach = self.scenario.numerics.approach;
    }

    /// Sets the rover rolling where its rims roll another way than before, and it does not follow
    /// them, as at a [rolling](Motion::Rolling) start; nothing where a run starts from rest.
    ///
    /// The models know no shear that builds up with the way: a wheel that stands, or moves against
    /// its rim, has a slip ratio of 1 or more at once, and near the limit of its thrust digs there
    /// for ever, where a real one passes through the slip at which it pulls most. Missions call this
    /// after each look of their controller; a program that leads a run by [`step`](Self::step) may,
    /// too.
    ///
    /// * `before`: speeds of the rims before [m/s]
    pub fn start_rolling(&mut self, before: &[f64]) {
        let mounts = self.scenario.rover.mounts();
        let State { set_speeds, point, .. } = &self.state;
        let [old, new] = [before, set_speeds].map(|rims| rolling_velocity(mounts, rims));
        let follows = point.state.velocity.dot(&new) > LEAST_PROGRESS * new.norm_squared();
        let is_new = old.dot(&new) <= 0.0 && new != Vec2::zeros();
        if !is_new || follows || self.scenario.start.motion == Motion::Rest {
            return;
        }
        self.forget_now();
        self.state.jump(&self.scenario.rover, |state| {
            state.velocity = ROLLING_SHARE * new;
            state.yaw_rate = 0.0;
        });
        self.state.carried = Carried::default();
        let State { set_speeds, point, .. } = &mut self.state;
        point.turning = point.turning.map(|_| Turning::at(set_speeds));
    }

    /// Sees from now on what motors take at most, of a rover whose motors are known.
    pub(crate) fn begin_most_taken(&mut self) {
        let State { most_taken, supply, .. } = &mut self.state;
        let temperature = supply.as_ref().and_then(Supply::warmest);
        *most_taken = (self.scenario.rover.has_motors())
            .then(|| MostTaken { temperature, ..MostTaken::default() });
    }

    /// What motors took at most since that was [begun](Self::begin_most_taken).
    pub(crate) fn most_taken(&self) -> Option<MostTaken> {
        self.state.most_taken
    }

    /// Records where the run has come to.
    pub(crate) fn record(&mut self) {
        self.forget_now();
        if !self.is_recorded() {
            self.records.push(self.record_now());
        }
    }

    /// The records that stay.
    pub(crate) fn kept(&self) -> &[Record] {
        &self.records
    }

    /// Takes the records that stay so far, so that a long run needs no memory for them; those of
    /// later times follow.
    #[must_use = "the records are gone otherwise; `drop` says that that is meant"]
    pub fn take_records(&mut self) -> Vec<Record> {
        self.forget_now();
        std::mem::take(&mut self.records)
    }

    /// The wheels now, and what their motors take; none where they do not settle.
    pub(crate) fn wheels(&self) -> Vec<(WheelReaction, Option<Electrical>)> {
        let equations = Equations::of(&self.scenario, &self.state.set_speeds);
        let wheels = equations.reactions_of(&self.state.point).unwrap_or_default();
        let taken = equations.taken(&self.state.point, &wheels);
        wheels.into_iter().zip(taken).collect()
    }

    /// Turns the wheels at the given speeds for a while. At its beginning they take them at once,
    /// and keep them to its end. A rover whose [`outcome`](Self::outcome) is known stays as it is:
    /// its run has ended.
    ///
    /// Steps are not recorded, except where the last one led: [`now`](Self::now).
    ///
    /// * `rim_speeds`: ω r_s of each wheel [m/s], in the mounts' order, before what differs
    ///   [by wheel](Scenario::by_wheel)
    /// * `span`: how long [s], from [`LEAST_STEP`] to a day
    ///
    /// # Errors
    /// [`RunError`] for speeds and times that nothing can have, which change nothing; and where the
    /// motion cannot be computed, at which the rover stays where it last was looked at.
    pub fn step(&mut self, rim_speeds: &[f64], span: f64) -> Result<(), RunError> {
        self.step_watched(rim_speeds, span, f64::INFINITY, &mut |_| false)
    }

    /// The same with someone who looks at the run after each multiple of a period and at the end of
    /// the step, and may end the step there.
    ///
    /// * `period`: between two looks [s]
    /// * `ends`: whether the step ends here
    pub(crate) fn step_watched(
        &mut self,
        rim_speeds: &[f64],
        span: f64,
        period: f64,
        ends: &mut dyn FnMut(&Self) -> bool,
    ) -> Result<(), RunError> {
        DriveLaw::check_each(rim_speeds, &self.scenario.rover)?;
        if !(LEAST_STEP..=LONGEST_DURATION).contains(&span) {
            let expected = "from 1e-6 to 86400";
            return Err(ParameterError::new("step [s]", span, expected).into());
        }
        if self.state.outcome.is_some() {
            return Ok(());
        }
        let set_speeds = self.state.set_speeds.iter().copied();
        let mut is_new_command = !self.scenario.each_rim_speed(rim_speeds).eq(set_speeds);
        if is_new_command {
            self.state.turn(&self.scenario, rim_speeds);
        }
        let until = snapped(self.state.time + span, WATCH_PERIOD);
        self.forget_now();
        let mut done = Ok(());
        let mut is_over = false;
        while !is_over {
            let next = multiple_after(self.state.time, period);
            is_over = next > until || is_same_time(next, until);
            let next = if is_over { until } else { next };
            done = self.go_to(is_new_command, [next, until], Due::Nothing);
            is_new_command = false;
            is_over |= done.is_err() || self.state.outcome.is_some();
            is_over |= done.is_ok() && ends(self);
        }
        done
    }

    /// The trajectory so far.
    #[must_use]
    pub fn finish(mut self) -> Trajectory {
        if !self.is_recorded() {
            let now = self.now.take().unwrap_or_else(|| self.record_now());
            self.records.push(now);
        }
        let State { outcome, method, work, .. } = self.state;
        let outcome = outcome.unwrap_or(Outcome::Completed);
        Trajectory { records: self.records, outcome, method, work }
    }

    /// What is simulated; of the rover, with its wheels as they are steered now.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// All that changes.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The rover now: at its start, where it was led to, or when its outcome was found. Its wheels
    /// are settled when this is asked for the first time; the [`state`](Self::state) is known
    /// without them.
    #[must_use]
    pub fn now(&self) -> &Record {
        match self.records.last().filter(|_| self.is_recorded()) {
            Some(last) => last,
            None => self.now.get_or_init(|| self.record_now()),
        }
    }

    /// The records so far: at the start, at every sample interval that a controller led the rover
    /// through, and now.
    #[must_use]
    pub fn records(&self) -> &[Record] {
        if self.is_recorded() {
            return &self.records;
        }
        self.all.get_or_init(|| self.records.iter().chain([self.now()]).cloned().collect())
    }

    /// What became of the rover, if that is known already.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.state.outcome()
    }

    /// Goes on under a controller, without a record of where that ends, unless one is due there.
    ///
    /// * `until`, `kept_until`: where that ends, and until when one that is asked once keeps its
    ///   speeds [s]
    fn lead(
        &mut self,
        controller: &mut dyn Controller,
        [until, kept_until]: [f64; 2],
        is_asked: bool,
        due: Due,
    ) -> Result<(), RunError> {
        let mut is_asked = is_asked;
        if let Some(period) = controller.period() {
            positive("control period [s]", period)?;
        }
        self.forget_now();
        let mut led = Ok(());
        while led.is_ok() && self.state.outcome.is_none() && self.state.time < until {
            let mut is_new_command = controller.period().is_some();
            if is_asked {
                is_new_command |= self.steer(controller)?;
                let commanded = ask(controller, &self.scenario, &mut self.state)?;
                is_new_command |= commanded != self.state.commanded;
                self.state.turn(&self.scenario, &commanded);
            }
            is_asked = true;
            let [next, kept] = controller.period().map_or([until, kept_until], |period| {
                let periods = (self.state.time / period).round() + 1.0;
                [(periods * period).min(until); 2]
            });
            led = self.go_to(is_new_command, [next, kept], due);
        }
        led
    }

    /// Steers the wheels as a controller says, as far as they come since they were last steered;
    /// whether any turns.
    fn steer(&mut self, controller: &mut dyn Controller) -> Result<bool, RunError> {
        let Self { scenario, state, .. } = self;
        let span = state.time - state.steered_until;
        state.steered_until = state.time;
        if !scenario.rover.is_steerable() {
            return Ok(false);
        }
        let before = scenario.rover.steering_angles();
        let mut wanted = before.clone();
        let seen = observation(scenario, state);
        controller.steer(&seen, &mut wanted);
        let work = seen.work.get();
        state.work += work;
        if wanted == before {
            return Ok(false);
        }
        scenario.rover.check_steering(&wanted)?;
        let each = scenario.rover.mounts().iter().zip(&wanted);
        let angles: Vec<f64> = each
            .map(|(mount, wanted)| {
                let most = mount.steering_axis.map_or(0.0, |axis| span * axis.rate);
                let way = wanted - mount.steering;
                if way.abs() <= most { *wanted } else { mount.steering + way.clamp(-most, most) }
            })
            .collect();
        if angles == before {
            return Ok(false);
        }
        let rover = scenario.rover.steered(&angles)?;
        state.steer(scenario, rover);
        Ok(true)
    }

    /// Goes on to a time in legs, each of which ends where a prescribed yaw begins to turn
    /// otherwise.
    fn go_to(
        &mut self,
        is_new_command: bool,
        [until, kept_until]: [f64; 2],
        due: Due,
    ) -> Result<(), RunError> {
        let time = self.state.time;
        let is_limited = self.state.supply.is_some() && self.scenario.rover.has_droop();
        if self.scenario.yaw.is_none() && !is_limited {
            // The usual case needs no list.
            return self.leg(is_new_command, kept_until, due).go_to(until);
        }
        let turns = self.scenario.yaw.iter().flat_map(|yaw| yaw.turns_between(time, until));
        let mut ends: Vec<f64> = turns.chain([until]).collect();
        if is_limited {
            ends.extend(multiples_between(time, until, LIMIT_PERIOD));
            ends.sort_by(f64::total_cmp);
            ends.dedup_by(|later, earlier| is_same_time(*later, *earlier));
        }
        let mut is_new_command = is_new_command;
        for end in ends {
            is_new_command |= self.state.follow_yaw(&self.scenario);
            is_new_command |= is_limited && self.state.renew_limits(&self.scenario.rover);
            // A prescribed yaw may turn otherwise where this stretch ends.
            let kept_until = if end < until { end } else { kept_until };
            self.leg(is_new_command, kept_until, due).go_to(end)?;
            if self.state.outcome.is_some() {
                break;
            }
            is_new_command = false;
        }
        Ok(())
    }

    fn leg(&mut self, is_new_command: bool, kept_until: f64, due: Due) -> Leg<'_> {
        Leg {
            scenario: &self.scenario,
            state: &mut self.state,
            records: &mut self.records,
            is_new_command,
            kept_until,
            due,
        }
    }

    /// Whether the last record is of where the run has come to.
    fn is_recorded(&self) -> bool {
        self.records.last().is_some_and(|last| is_same_time(last.time, self.state.time))
    }

    /// Forgets the record of where the run was: it goes on from there.
    fn forget_now(&mut self) {
        self.now.take();
        self.all.take();
    }

    /// A record of where the run has come to; without wheels where those do not settle.
    fn record_now(&self) -> Record {
        let State { time, point, set_speeds, carried, .. } = &self.state;
        let supply = self.state.supply.as_ref();
        let equations = Equations::of(&self.scenario, set_speeds)
            .limited(supply.map_or(&[], |supply| supply.limits()));
        let recorded = || self.state.recorded.wheels_at(*time).map(<[_]>::to_vec);
        let known = carried.wheels(&equations, point).or_else(recorded);
        let wheels = known.unwrap_or_else(|| equations.reactions_of(point).unwrap_or_default());
        Record::new(&equations, *time, point, &wheels, supply)
    }
}

/// What a controller sees of a rover.
fn observation<'a>(scenario: &'a Scenario, state: &'a State) -> Observation<'a> {
    Observation {
        scenario,
        time: state.time,
        rover: &state.point.state,
        rim_speeds: &state.rim_speeds,
        slip_ratios: &state.slip_ratios,
        work: Cell::new(Work::default()),
    }
}

/// What a controller makes of a rover: the speed that is commanded of each rim [m/s].
fn ask(
    controller: &mut dyn Controller,
    scenario: &Scenario,
    state: &mut State,
) -> Result<Vec<f64>, RunError> {
    let seen = observation(scenario, state);
    let mut commanded = state.commanded.clone();
    controller.command(&seen, &mut commanded);
    let work = seen.work.get();
    state.work += work;
    DriveLaw::check_each(&commanded, &scenario.rover)?;
    Ok(commanded)
}
