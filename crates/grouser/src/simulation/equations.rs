//! One evaluation of the motion: state in, rates out. It reads as the theory's table of contents.

use std::cell::{Cell, RefCell};

use super::power;
use crate::contact::Slip;
use crate::units::Vec2;
use crate::vehicle::kinematics::{hub_velocity, wheel_slips};
use crate::vehicle::reaction::forces_of;
use crate::vehicle::{
    Acceleration, OwnMoments, ReactionError, RoverState, WheelReaction, dynamics, reaction::Ground,
};

/// The equations of motion of a rover whose wheels turn at given speeds.
pub struct Equations<'a> {
    ground: Ground<'a>,
    rim_speeds: &'a [f64],
    wheel_speeds: Vec<f64>,
    evaluations: Cell<u64>,
    failure: RefCell<Option<ReactionError>>,
}

/// Rates of change of a rover's motion, and the powers of its energy books.
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
}

impl<'a> Equations<'a> {
    /// The equations for wheels that turn at these rim speeds, ω r_s [m/s].
    #[must_use]
    pub fn new(ground: Ground<'a>, rim_speeds: &'a [f64]) -> Self {
        let radius = ground.rover.wheel().shearing_radius();
        Self {
            ground,
            rim_speeds,
            wheel_speeds: rim_speeds.iter().map(|speed| speed / radius).collect(),
            evaluations: Cell::new(0),
            failure: RefCell::new(None),
        }
    }

    /// The soil's reaction on each wheel: kinematics, slip, loads, sinkage, forces.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn reactions(&self, state: &RoverState) -> Result<Vec<WheelReaction>, ReactionError> {
        let slips: Vec<Slip> = wheel_slips(self.ground.rover, state, self.rim_speeds).collect();
        self.ground.reactions(state.yaw, &slips)
    }

    /// The rates at a state.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn rates(&self, state: &RoverState) -> Result<Rates, ReactionError> {
        let Ground { rover, site, own_moments, .. } = self.ground;
        let wheels = self.reactions(state)?;
        let acceleration =
            dynamics::acceleration(rover, site, state, &forces_of(&wheels), own_moments);
        let hubs = rover.mounts().iter().map(|mount| hub_velocity(state, mount.position.xy()));
        let aligning_work_rate =
            if own_moments == OwnMoments::Included { state.yaw_rate } else { 0.0 };
        let (motor_power, soil_power) =
            power::powers(&wheels, &self.wheel_speeds, hubs, aligning_work_rate);
        Ok(Rates {
            velocity_slope: state.velocity_slope(),
            yaw_rate: state.yaw_rate,
            acceleration,
            motor_power,
            soil_power,
        })
    }

    /// The wheels' angular speeds, *ω* [rad/s].
    #[must_use]
    pub fn wheel_speeds(&self) -> &[f64] {
        &self.wheel_speeds
    }

    /// As [`rates`](Self::rates), for an integrator: it may try states that no rover can have, so
    /// the reason of a failure is kept for when the integrator gives up.
    pub(super) fn try_rates(&self, state: &RoverState) -> Option<Rates> {
        self.evaluations.set(self.evaluations.get() + 1);
        self.rates(state).map_err(|failure| *self.failure.borrow_mut() = Some(failure)).ok()
    }

    /// Why the last failed trial failed.
    pub(super) fn take_failure(&self) -> Option<ReactionError> {
        self.failure.borrow_mut().take()
    }

    /// How often the equations were evaluated.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }
}
