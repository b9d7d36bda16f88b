//! One evaluation of the motion: state in, rates out. It reads as a table of contents of the equations.

use std::cell::{Cell, RefCell};

use super::power;
use super::scenario::Scenario;
use super::work::Work;
use crate::contact::Slip;
use crate::site::Site;
use crate::terrain::Terrain;
use crate::units::Vec2;
use crate::vehicle::kinematics::{wheel_slips, wheel_velocity};
use crate::vehicle::reaction::forces_of;
use crate::vehicle::{
    Acceleration, OwnMoments, ReactionError, Rover, RoverState, Stance, WheelReaction, dynamics,
    reaction::Ground,
};

/// The equations of motion of a rover whose wheels turn at given speeds.
pub struct Equations<'a> {
    ground: Ground<'a>,
    rim_speeds: &'a [f64],
    wheel_speeds: Vec<f64>,
    /// The yaw rate that is held, if one is [rad/s].
    held_yaw_rate: Option<f64>,
    work: Cell<Work>,
    failure: RefCell<Option<ReactionError>>,
}

/// One evaluation of the motion: its rates, and the wheels that they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Rates of change.
    pub rates: Rates,
    /// Each wheel, settled, in the mounts' order.
    pub wheels: Vec<WheelReaction>,
}

/// Rates of change of a rover's motion, and the powers of its energy balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Velocity in the slope frame [m/s].
    pub velocity_slope: Vec2,
    /// Yaw rate [rad/s].
    pub yaw_rate: f64,
    /// Rates of the velocities.
    pub acceleration: Acceleration,
    /// Power of the motors [W].
    pub motor_power: f64,
    /// Power into the soil [W].
    pub soil_power: f64,
    /// Electrical power of the motors that are known [W].
    pub electrical_power: f64,
}

/// Time in which a yaw rate returns to the one that is held [s]. It never leaves it by more than
/// rounding: the time only tells a solver the way. Source: ours, as long as slip takes to settle.
const BACK_TO_HELD_RATE: f64 = 1e-2;

impl<'a> Equations<'a> {
    /// The equations of a scenario, for wheels that turn at these rim speeds, ω r_s [m/s].
    #[must_use]
    pub fn of(scenario: &'a Scenario, rim_speeds: &'a [f64]) -> Self {
        let ground = Ground {
            rover: &scenario.rover,
            site: &scenario.site,
            model: scenario.theory.model(),
            sharing: scenario.sharing,
            own_moments: scenario.own_moments,
            differences: scenario.differences(),
        };
        Self::new(ground, rim_speeds)
    }

    /// The equations for wheels that turn at these rim speeds, ω r_s [m/s].
    #[must_use]
    pub fn new(ground: Ground<'a>, rim_speeds: &'a [f64]) -> Self {
        let wheel_speeds = ground.rover.wheel_speeds(rim_speeds).collect();
        Self {
            ground,
            rim_speeds,
            wheel_speeds,
            held_yaw_rate: None,
            work: Cell::default(),
            failure: RefCell::new(None),
        }
    }

    /// The same for a rover whose yaw rate something holds, if it does [rad/s].
    pub(super) fn holding(self, yaw_rate: Option<f64>) -> Self {
        Self { held_yaw_rate: yaw_rate, ..self }
    }

    /// The soil's reaction on each wheel: kinematics, slip, loads, sinkage, forces.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn reactions(&self, state: &RoverState) -> Result<Vec<WheelReaction>, ReactionError> {
        self.reactions_at(state, &self.ground.stance(state))
    }

    fn reactions_at(
        &self,
        state: &RoverState,
        stance: &Stance,
    ) -> Result<Vec<WheelReaction>, ReactionError> {
        let slips: Vec<Slip> = self.slips(state).collect();
        self.count(|work| work.settled_wheels += slips.len() as u64);
        self.ground.reactions(stance, &slips)
    }

    /// The slip of every wheel, from the motion alone.
    pub fn slips<'s>(&'s self, state: &'s RoverState) -> impl Iterator<Item = Slip> + 's {
        wheel_slips(self.ground.rover, state, self.rim_speeds)
    }

    /// The rates at a state.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn rates(&self, state: &RoverState) -> Result<Rates, ReactionError> {
        self.evaluate(state).map(|evaluation| evaluation.rates)
    }

    /// The rates at a state, and the wheels there.
    ///
    /// # Errors
    /// As [`rates`](Self::rates).
    pub fn evaluate(&self, state: &RoverState) -> Result<Evaluation, ReactionError> {
        let Ground { rover, own_moments, .. } = self.ground;
        let stance = self.ground.stance(state);
        let wheels = self.reactions_at(state, &stance)?;
        let forces = forces_of(&wheels);
        let (acceleration, holding_moment) = match self.held_yaw_rate {
            None => (dynamics::acceleration(rover, stance.pull, state, forces, own_moments), 0.0),
            Some(rate) => {
                let back = (rate - state.yaw_rate) / BACK_TO_HELD_RATE;
                dynamics::held_acceleration(rover, stance.pull, state, forces, own_moments, back)
            }
        };
        let hubs = rover.mounts().iter().map(|mount| wheel_velocity(state, mount));
        let aligning_work_rate =
            if own_moments == OwnMoments::Included { state.yaw_rate } else { 0.0 };
        let (motor_power, soil_power) =
            power::powers(&wheels, &self.wheel_speeds, hubs, aligning_work_rate);
        let rates = Rates {
            velocity_slope: stance.slope_from_body * state.velocity,
            yaw_rate: state.yaw_rate,
            acceleration,
            motor_power: motor_power + holding_moment * state.yaw_rate,
            soil_power,
            electrical_power: power::electrical_power(rover, &wheels, &self.wheel_speeds),
        };
        Ok(Evaluation { rates, wheels })
    }

    /// The rover that moves.
    #[must_use]
    pub fn rover(&self) -> &Rover {
        self.ground.rover
    }

    /// Whether the soil differs from place to place.
    pub(super) fn is_uneven(&self) -> bool {
        self.ground.differences.by_place.is_some()
    }

    /// Where it moves.
    #[must_use]
    pub fn site(&self) -> &Site<dyn Terrain> {
        self.ground.site
    }

    /// The wheels' rim speeds, *ω r_s* [m/s].
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        self.rim_speeds
    }

    /// The wheels' angular speeds, *ω* [rad/s].
    #[must_use]
    pub fn wheel_speeds(&self) -> &[f64] {
        &self.wheel_speeds
    }

    /// As [`evaluate`](Self::evaluate), for a solver: it may try states that no rover can have, so
    /// the reason of a failure is kept for when the solver gives up.
    pub(super) fn attempt(&self, state: &RoverState) -> Option<Evaluation> {
        self.count(|work| work.evaluations += 1);
        self.evaluate(state).map_err(|failure| *self.failure.borrow_mut() = Some(failure)).ok()
    }

    /// Why the last failed attempt failed.
    pub(super) fn take_failure(&self) -> Option<ReactionError> {
        self.failure.borrow_mut().take()
    }

    /// What was computed so far.
    pub(super) fn work(&self) -> Work {
        self.work.get()
    }

    /// Counts work done.
    pub(super) fn count(&self, add: impl Fn(&mut Work)) {
        let mut work = self.work.get();
        add(&mut work);
        self.work.set(work);
    }
}
