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
/// A closure is one, too. How far does a rover drift that measures its yaw ten times a second, and
/// turns the wheels on its right faster while its nose is less than 5° uphill?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::{Observation, Run};
/// use grouser_core::units::deg;
///
/// let mut steer = |seen: &Observation<'_>, rim_speeds: &mut [f64]| {
///     let turn = 0.2 * (deg(5.0) - seen.rover().yaw);
///     for (rim_speed, mount) in rim_speeds.iter_mut().zip(seen.scenario().rover.mounts()) {
///         *rim_speed = 0.06 - turn * mount.position.y.signum();
///     }
/// };
/// let scenario = paper::traverse()?;
/// let mut run = Run::with_controller(&scenario, &mut steer)?;
/// run.advance(&mut steer, scenario.duration)?;
/// let end = run.now().state;
/// assert_eq!(format!("{:.1}° uphill", end.yaw.to_degrees()), "5.0° uphill");
/// assert_eq!(format!("{:.0} mm", 1e3 * end.position.y), "-17 mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Controller {
    /// Sets the commanded rim speed ω r_s of each wheel [m/s], in the mounts' order; they hold
    /// those that were commanded before.
    fn command(&mut self, seen: &Observation<'_>, rim_speeds: &mut [f64]);

    /// Sets the steering angle *δ* that each wheel is to have [rad], in the mounts' order; they
    /// hold those that the wheels have. Asked at each look after the start, before
    /// [`command`](Self::command), of a rover that has wheels that are steered. These turn towards
    /// their angles no faster than their [rate](crate::vehicle::SteeringAxis::rate) allows between
    /// two looks, and keep them to the next. Without this method nothing is steered.
    fn steer(&mut self, _seen: &Observation<'_>, _angles: &mut [f64]) {}

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
        let crab = seen.scenario.yaw_from_contour(seen.rover());
        self.rim_speeds(rover, crab, seen.slip_ratios(), rim_speeds);
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

    /// Rim speed that each wheel has so far, *ω r_s* [m/s]; zeros before the start. Where a
    /// scenario has wheels that turn [at another speed](Scenario::by_wheel) than commanded, it is
    /// not what was commanded.
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        self.rim_speeds
    }

    /// Slip ratio of each wheel, *s* [-]; zeros before the start.
    #[must_use]
    pub fn slip_ratios(&self) -> &[f64] {
        self.slip_ratios
    }

    /// Slip, load, sinkage and the soil's forces of each wheel as it turned so far. They are
    /// computed here: each call costs an evaluation of the motion.
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
