//! What turns the wheels in a run: a law of the scenario, or anything that looks at the rover.

use std::cell::Cell;

use super::equations::Equations;
use super::scenario::Scenario;
use super::work::Work;
use crate::vehicle::{DriveLaw, ReactionError, RoverState, WheelReaction};

/// Time between two looks of a controller [s]. Source: ours, a usual rate of rover control.
pub const CONTROL_PERIOD: f64 = 0.1;

/// Looks at a rover once in a while and sets the speeds of its wheels, which keep them until the
/// next look (a zero-order hold).
///
/// A closure is one, too:
///
/// ```
/// # use grouser_core::simulation::{Controller, Observation};
/// # fn takes(_: &mut impl Controller) {}
/// // Turns the wheels on the right faster while the nose points uphill.
/// let mut straight = |seen: &Observation<'_>, rim_speeds: &mut [f64]| {
///     for (rim_speed, mount) in rim_speeds.iter_mut().zip(seen.scenario().rover.mounts()) {
///         *rim_speed = 0.06 + 0.02 * seen.rover().yaw * mount.position.y.signum();
///     }
/// };
/// # takes(&mut straight);
/// ```
pub trait Controller {
    /// Sets the rim speed ω r_s of each wheel [m/s], in the mounts' order; they hold those of now.
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]);

    /// Time between two looks [s]; none if one look at the start says all.
    fn period(&self) -> Option<f64> {
        Some(CONTROL_PERIOD)
    }
}

impl<F: FnMut(&Observation<'_>, &mut [f64])> Controller for F {
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]) {
        self(seen, rim_speeds);
    }
}

impl Controller for DriveLaw {
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]) {
        let rover = &seen.scenario.rover;
        self.rim_speeds(rover, seen.rover().yaw, seen.slip_ratios(), rim_speeds);
    }

    fn period(&self) -> Option<f64> {
        self.varies().then_some(CONTROL_PERIOD)
    }
}

/// What a controller sees of a rover.
pub struct Observation<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) time: f64,
    pub(super) rover: &'a RoverState,
    pub(super) rim_speeds: &'a [f64],
    pub(super) slip_ratios: &'a [f64],
    pub(super) work: Cell<Work>,
}

impl Observation<'_> {
    /// What is simulated.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        self.scenario
    }

    /// Time since the start [s].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Pose and velocities.
    #[must_use]
    pub fn rover(&self) -> &RoverState {
        self.rover
    }

    /// Rim speed of each wheel so far, *ω r_s* [m/s]; zeros before the start.
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        self.rim_speeds
    }

    /// Slip ratio of each wheel, *s* [-]; zeros before the start.
    #[must_use]
    pub fn slip_ratios(&self) -> &[f64] {
        self.slip_ratios
    }

    /// Slip, load, sinkage and the soil's forces of each wheel as it turned so far. They are computed
    /// here: each call costs an evaluation of the motion.
    ///
    /// # Errors
    /// [`ReactionError`] if the rover tips over or a wheel does not settle.
    pub fn wheels(&self) -> Result<Vec<WheelReaction>, ReactionError> {
        let equations = Equations::of(self.scenario, self.rim_speeds);
        let wheels = equations.reactions(self.rover);
        let mut work = self.work.get();
        work += equations.work();
        self.work.set(work);
        wheels
    }
}
