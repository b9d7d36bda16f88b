//! All that changes in a run.

use std::sync::Arc;

use super::equations::{Equations, LastWheels};
use super::integrate::History;
use super::method::Method;
use super::most_taken::MostTaken;
use super::outcome::Outcome;
use super::point::Point;
use super::power;
use super::recorded::RecordedWheels;
use super::scenario::{Approach, Motion, Scenario};
use super::steady_run::Carried;
use super::supply::{Charge, LIMIT_PERIOD, Supply};
use super::times::is_multiple;
use super::turning::Turning;
use super::watch::{WATCH_PERIOD, Watch};
use super::work::Work;
use crate::stored::{self, Stored};
use crate::vehicle::{Rover, RoverState, WheelReaction};

/// All that changes in a run: where the rover is, how it and its wheels move, its energies, and
/// what the solver knows of the motion so far.
///
/// A scenario and a state determine all that follows: a clone goes on as the original would, bit
/// for bit ([`Run::resume`](super::Run::resume)).
#[derive(Clone)]
pub struct State {
    pub(super) time: f64,
    pub(super) point: Point,
    /// The rim speed that is commanded of each wheel [m/s].
    pub(super) commanded: Vec<f64>,
    /// The one that its motor is set to, *ω_0 r_s* [m/s].
    pub(super) set_speeds: Vec<f64>,
    /// The one that it has, *ω r_s* [m/s], when the rover was last looked at.
    pub(super) rim_speeds: Vec<f64>,
    /// The rover with its wheels as they are steered now; none while they are as its document has
    /// them.
    pub(super) steered: Option<Arc<Rover>>,
    /// Until when wheels were steered, or could have been [s].
    pub(super) steered_until: f64,
    /// Slip ratio of each wheel, when the rover was last looked at.
    pub(super) slip_ratios: Vec<f64>,
    pub(super) outcome: Option<Outcome>,
    /// How the motion is computed now.
    pub(super) approach: Approach,
    pub(super) method: Method,
    pub(super) work: Work,
    pub(super) watch: Watch,
    /// Battery and windings, where they are known.
    pub(super) supply: Option<Supply>,
    /// What motors took at most, where someone asked for that.
    pub(super) most_taken: Option<MostTaken>,
    /// History of the dynamic motion while the wheels keep their speeds.
    pub(super) history: History,
    /// What the solver keeps of the quasi-steady motion so far.
    pub(super) carried: Carried,
    /// The wheels where the motion was last evaluated.
    pub(super) near: LastWheels,
    /// Those of the last records.
    pub(super) recorded: RecordedWheels,
}

/// Why bytes are no state of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BadState {
    /// They are damaged, or no state of this version.
    #[error("the bytes are damaged, or no state of a run of this version of Grouser")]
    Unreadable,
    /// The rover of the state has another number of wheels than the scenario's.
    #[error("the state is of a rover with {found} wheels, the scenario's has {expected}")]
    OtherWheels {
        /// Wheels of the state.
        found: usize,
        /// Wheels of the scenario's rover.
        expected: usize,
    },
    /// The state is of a rover on a path, and that is another one.
    #[error("the state is of a rover on another path, or under other limits")]
    OtherPath,
}

impl State {
    /// At the start of a scenario, before the rover was looked at.
    ///
    /// * `commanded`: the rim speed that is commanded of each wheel [m/s]
    pub(super) fn new(scenario: &Scenario, commanded: Vec<f64>) -> Self {
        let rim_speeds = scenario.rim_speeds(&commanded);
        let state = scenario.start_state(&rim_speeds);
        let rover = &scenario.rover;
        let turning = rover.has_droop().then(|| match scenario.start.motion {
            Motion::Rolling => Turning::at(&rim_speeds),
            Motion::Rest => Turning::at(&vec![0.0; rim_speeds.len()]),
        });
        Self {
            time: 0.0,
            point: Point::start(rover, state, turning),
            slip_ratios: vec![0.0; rim_speeds.len()],
            commanded,
            rim_speeds: turning.map_or_else(|| rim_speeds.clone(), |it| it.rim_speeds().to_vec()),
            set_speeds: rim_speeds,
            steered: None,
            steered_until: 0.0,
            outcome: None,
            approach: scenario.numerics.approach,
            method: match scenario.numerics.approach {
                Approach::Dynamic => Method::Dynamic,
                Approach::QuasiSteady => Method::QuasiSteady,
            },
            work: Work::default(),
            watch: Watch::default(),
            supply: Supply::of(rover),
            most_taken: None,
            history: History::default(),
            carried: Carried::default(),
            near: LastWheels::default(),
            recorded: RecordedWheels::default(),
        }
    }

    /// Settles the controllers of motors under the load with which a rolling start begins: a
    /// scenario says nothing else of a rover that is on its way.
    pub(super) fn settle_motors(&mut self, scenario: &Scenario) {
        let rolling = scenario.start.motion == Motion::Rolling;
        let Some(mut turning) = self.point.turning.filter(|_| rolling) else { return };
        let limits = self.supply.as_ref().map_or(&[][..], |supply| supply.limits());
        let equations = Equations::of(scenario, &self.set_speeds).limited(limits);
        let Ok(wheels) = equations.reactions_of(&self.point) else { return };
        for (wheel, (reaction, set)) in wheels.iter().zip(&self.set_speeds).enumerate() {
            // Wheels that are to stall stall on the way.
            let rim_speed =
                equations.rim_speed_under(wheel, reaction).clamp(set.min(0.0), set.max(0.0));
            turning.set(wheel, rim_speed, equations.settled_integral(wheel, rim_speed, reaction));
        }
        self.point.turning = Some(turning);
        self.point.start_work(&scenario.rover);
        self.rim_speeds.copy_from_slice(turning.rim_speeds());
    }

    /// The state as bytes, for files and other processes: [`from_bytes`](Self::from_bytes) reads
    /// them. They have a form of their own in each version of the library.
    ///
    /// ```
    /// use grouser_core::paper;
    /// use grouser_core::simulation::{Run, State};
    ///
    /// let scenario = paper::traverse()?;
    /// let mut run = Run::new(&scenario)?;
    /// run.step(&[0.06; 4], 1.0)?;
    /// let bytes = run.state().to_bytes();
    /// let mut other = Run::resume(&scenario, State::from_bytes(&bytes, &scenario)?);
    /// run.step(&[0.05; 4], 1.0)?;
    /// other.step(&[0.05; 4], 1.0)?;
    /// assert_eq!(run.now(), other.now());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let Self {
            time,
            point,
            commanded,
            set_speeds,
            rim_speeds,
            steered,
            steered_until,
            slip_ratios,
            outcome,
            method,
            work,
            watch,
            supply,
            most_taken,
            history,
            carried,
            near,
            recorded,
            approach,
        } = self;
        stored::sealed(|bytes| {
            (*time, *point).store(bytes);
            for each in [commanded, set_speeds, rim_speeds, slip_ratios] {
                each.store(bytes);
            }
            (steered.as_ref().map(|rover| rover.steering_angles()), *steered_until).store(bytes);
            outcome.store(bytes);
            method.store(bytes);
            work.store(bytes);
            watch.store(bytes);
            supply.store(bytes);
            most_taken.store(bytes);
            history.store(bytes);
            carried.store(bytes);
            near.store(bytes);
            recorded.store(bytes);
            approach.store(bytes);
        })
    }

    /// The state that was made [bytes](Self::to_bytes). A scenario and this state determine all
    /// that follows, bit for bit.
    ///
    /// * `scenario`: the one of its run, with its wheels as its document has them
    ///
    /// # Errors
    /// [`BadState`] for bytes that are damaged, by another version of the library, or of a rover
    /// with another number of wheels. Of another scenario with as many wheels the state is taken
    /// as it is.
    pub fn from_bytes(bytes: &[u8], scenario: &Scenario) -> Result<Self, BadState> {
        let mut content = stored::opened(bytes).ok_or(BadState::Unreadable)?;
        let state = Self::restored(&mut content, &scenario.rover).ok_or(BadState::Unreadable)?;
        if !content.is_empty() {
            return Err(BadState::Unreadable);
        }
        let (found, expected) = (state.commanded.len(), scenario.rover.wheel_count());
        if found != expected {
            return Err(BadState::OtherWheels { found, expected });
        }
        Ok(state)
    }

    fn restored(bytes: &mut &[u8], rover: &Rover) -> Option<Self> {
        /// No run gets so far [s]: thirty years.
        const LATEST: f64 = 1e9;
        let (time, point) = Stored::restore(bytes)?;
        if !(0.0..=LATEST).contains(&time) {
            return None;
        }
        let [commanded, set_speeds, rim_speeds, slip_ratios] =
            <[Vec<f64>; 4] as Stored>::restore(bytes)?;
        let count = commanded.len();
        if [&set_speeds, &rim_speeds, &slip_ratios].iter().any(|each| each.len() != count) {
            return None;
        }
        let (angles, steered_until) = <(Option<Vec<f64>>, f64) as Stored>::restore(bytes)?;
        let steered = match angles.filter(|angles| angles.len() == rover.wheel_count()) {
            Some(angles) => Some(Arc::new(rover.steered(&angles).ok()?)),
            None => None,
        };
        let state = Self {
            time,
            point,
            commanded,
            set_speeds,
            rim_speeds,
            steered,
            steered_until,
            slip_ratios,
            outcome: Stored::restore(bytes)?,
            method: Stored::restore(bytes)?,
            work: Stored::restore(bytes)?,
            watch: Stored::restore(bytes)?,
            supply: Stored::restore(bytes)?,
            most_taken: Stored::restore(bytes)?,
            history: Stored::restore(bytes)?,
            carried: Stored::restore(bytes)?,
            near: Stored::restore(bytes)?,
            recorded: Stored::restore(bytes)?,
            approach: Stored::restore(bytes)?,
        };
        let is_of = state.carried.is_of(count) && state.near.is_of(count);
        (is_of && state.recorded.is_of(count)).then_some(state)
    }

    /// Time since the start [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Pose and velocities.
    #[must_use]
    pub fn rover(&self) -> &RoverState {
        &self.point.state
    }

    /// The wheels' rim speeds, *ω r_s* [m/s].
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        &self.rim_speeds
    }

    /// Work of the motors so far [J].
    #[must_use]
    pub fn motor_work(&self) -> f64 {
        self.point.motors
    }

    /// Electrical energy that motors, and with a battery the electronics, took so far [J]; 0 where
    /// no motor is known.
    #[must_use]
    pub fn electrical_work(&self) -> f64 {
        self.point.electrical + self.supply.as_ref().map_or(0.0, Supply::beside)
    }

    /// The battery, where it is known.
    #[must_use]
    pub fn battery(&self) -> Option<Charge> {
        self.supply.as_ref()?.battery()
    }

    /// Temperature of the warmest winding of a motor, where some are known [°C].
    #[must_use]
    pub fn warmest(&self) -> Option<f64> {
        self.supply.as_ref()?.warmest()
    }

    /// What became of the rover, if that is known already.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// How the motion was computed so far: where no steady motion was found, it is sought again when
    /// the wheels turn otherwise, and this says why it was not found first.
    #[must_use]
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// Work of the solver so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.work
    }

    /// Turns the rover from now on as the scenario prescribes, if it prescribes a turn here;
    /// returns whether it does. What a jump of the yaw rate takes, its holder gives.
    pub(super) fn follow_yaw(&mut self, scenario: &Scenario) -> bool {
        let Some(yaw) = scenario.yaw.as_ref().filter(|yaw| yaw.turns_at(self.time)) else {
            return false;
        };
        let (angle, rate) = (yaw.at(self.time), yaw.rate_from(self.time));
        self.jump(&scenario.rover, |state| (state.yaw, state.yaw_rate) = (angle, rate));
        true
    }

    /// Looks at what the motors take: the battery and the windings go on by what is seen each
    /// [`WATCH_PERIOD`], whenever else the rover is looked at. What becomes of one without power.
    pub(super) fn look_at_power(
        &mut self,
        equations: &Equations<'_>,
        wheels: &[WheelReaction],
    ) -> Option<Outcome> {
        let taken = equations.taken(&self.point, wheels);
        let is_due = is_multiple(self.time, WATCH_PERIOD);
        let supply = self.supply.as_mut().filter(|_| is_due);
        let without_power = supply.and_then(|it| it.look(equations.rover(), self.time, &taken));
        let warmest = self.warmest();
        if let Some(most) = &mut self.most_taken {
            most.look(&taken, warmest);
        }
        without_power
    }

    /// Sets the motors' limits to what battery and windings allow, at each [`LIMIT_PERIOD`];
    /// returns whether that changes what some motor does.
    pub(super) fn renew_limits(&mut self, rover: &Rover) -> bool {
        let is_due = is_multiple(self.time, LIMIT_PERIOD);
        let Some(supply) = self.supply.as_mut().filter(|_| is_due) else { return false };
        let matters = supply.renew_limits(rover);
        if matters {
            self.forget_motion();
        }
        matters
    }

    /// Forgets the motion before, which says nothing of the one after.
    fn forget_motion(&mut self) {
        self.history.clear();
        self.recorded.clear();
    }

    /// Changes pose and velocities at once, as [`Point::jump`]: the motion before says nothing of
    /// the one after.
    pub(super) fn jump(&mut self, rover: &Rover, change: impl FnOnce(&mut RoverState)) {
        self.point.jump(rover, change);
        self.forget_motion();
    }

    /// Steers the wheels from now on. What a hub beside its kingpin changes of the rover's energies
    /// is work of the motors that steer.
    ///
    /// * `scenario`: gets the rover with its wheels as they are steered
    pub(super) fn steer(&mut self, scenario: &mut Scenario, rover: Rover) {
        let state = &self.point.state;
        let energy = |rover: &Rover| {
            let potential =
                power::potential_energy(rover, &scenario.ground, scenario.gravity, state);
            power::kinetic_energy(rover, state) + potential
        };
        self.point.motors += energy(&rover) - energy(&scenario.rover);
        self.forget_motion();
        self.steered = Some(Arc::new(rover.clone()));
        self.approach = scenario.numerics.approach;
        scenario.rover = rover;
    }

    /// Commands other speeds of the wheels from now on.
    ///
    /// * `commanded`: of each rim [m/s]
    pub(super) fn turn(&mut self, scenario: &Scenario, commanded: &[f64]) {
        let (rover, set_speeds) = (&scenario.rover, scenario.rim_speeds(commanded));
        if let Some(turning) = &mut self.point.turning {
            // Motors with a controller follow in their time, others at once.
            for (wheel, mount) in rover.mounts().iter().enumerate() {
                if mount.unit.motor.is_none_or(|motor| motor.control.is_none()) {
                    turning.set(wheel, set_speeds[wheel], 0.0);
                }
            }
        } else {
            let spin_energy = |rims: &[f64]| {
                let wheel_speeds: Vec<f64> = rover.wheel_speeds(rims).collect();
                power::spin_energy(rover, &wheel_speeds)
            };
            // The motors change the spin at once; the energy balance must not lose that work.
            self.point.motors += spin_energy(&set_speeds) - spin_energy(&self.set_speeds);
            self.rim_speeds.clone_from(&set_speeds);
        }
        self.commanded.copy_from_slice(commanded);
        if set_speeds != self.set_speeds {
            self.forget_motion();
            self.set_speeds = set_speeds;
            // A steady motion may be found again.
            self.approach = scenario.numerics.approach;
        }
    }
}
