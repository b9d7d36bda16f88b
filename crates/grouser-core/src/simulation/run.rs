//! A run: drive, motion, samples, and a watch over what becomes of the rover.

use super::progress::{Progress, Rims};
use super::scenario::Scenario;
use super::trajectory::{Outcome, Sample, Trajectory};
use crate::error::ParameterError;
use crate::vehicle::drive::DriveInput;
use crate::vehicle::{Drive, ReactionError};

/// Time between two looks of a drive that varies [s]. Source: ours, a usual rate of rover control.
pub const CONTROL_PERIOD: f64 = 0.1;

/// Why a run could not be computed. (What a rover does is an [`Outcome`], not an error.)
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// The scenario is no run.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The soil's reaction could not be found.
    #[error("at {time:.3} s: {source}")]
    Reaction {
        /// When [s].
        time: f64,
        /// What is wrong.
        source: ReactionError,
    },
    /// The integrator could not go on.
    #[error(
        "the run cannot be computed beyond {time:.3} s: no time step is short enough for the motion \
         there ({reason}); a locked or suddenly braked wheel is the usual reason, another speed \
         or a rolling start may avoid it"
    )]
    Stalled {
        /// When [s].
        time: f64,
        /// What the integrator said.
        reason: String,
    },
}

/// A run in progress.
pub struct Simulation<'a> {
    scenario: &'a Scenario,
    drive: Box<dyn Drive + 'a>,
    rim_speeds: Vec<f64>,
    progress: Progress,
}

impl<'a> Simulation<'a> {
    /// The run of a scenario, at its start.
    ///
    /// # Errors
    /// [`SimulationError`] if the scenario is no run, or the wheels do not settle at its start
    /// for another reason than a physical one.
    pub fn new(scenario: &'a Scenario) -> Result<Self, SimulationError> {
        Self::with_drive(scenario, Box::new(scenario.drive.clone()))
    }

    /// The same, with a drive of your own instead of the scenario's.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_drive(
        scenario: &'a Scenario,
        mut drive: Box<dyn Drive + 'a>,
    ) -> Result<Self, SimulationError> {
        scenario.check()?;
        let rover = &scenario.rover;
        let mut rim_speeds = vec![0.0; rover.wheel_count()];
        let slip_ratios = vec![0.0; rover.wheel_count()];
        let input = DriveInput { rover, yaw: scenario.start.yaw, slip_ratios: &slip_ratios };
        drive.rim_speeds(&input, &mut rim_speeds);
        let mut progress = Progress::new(scenario, &rim_speeds);
        progress.advance_through(scenario, rims(scenario, &*drive, &rim_speeds, 0.0), &[])?;
        Ok(Self { scenario, drive, rim_speeds, progress })
    }

    /// Runs to the end of the scenario, or to the outcome that ends it before.
    ///
    /// # Errors
    /// [`SimulationError`] if the run cannot be computed.
    pub fn run(mut self) -> Result<Trajectory, SimulationError> {
        let duration = self.scenario.duration;
        if self.drive.varies() {
            while self.progress.outcome.is_none() && self.progress.time < duration {
                let periods = (self.progress.time / CONTROL_PERIOD).round() + 1.0;
                self.advance((periods * CONTROL_PERIOD).min(duration))?;
            }
        } else {
            self.advance(duration)?;
        }
        let Progress { samples, outcome, method, work, .. } = self.progress;
        Ok(Trajectory { samples, outcome: outcome.unwrap_or(Outcome::Completed), method, work })
    }

    /// Asks the drive, then lets the motion go on to a time [s], unless an outcome ends it.
    ///
    /// # Errors
    /// [`SimulationError`] if the motion cannot be computed.
    pub fn advance(&mut self, until: f64) -> Result<(), SimulationError> {
        if self.progress.outcome.is_some() || until <= self.progress.time {
            return Ok(());
        }
        self.ask_drive();
        let rims = rims(self.scenario, &*self.drive, &self.rim_speeds, until);
        self.progress.advance(self.scenario, rims, until)
    }

    /// What became of the rover, if that is known already.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.progress.outcome.as_ref()
    }

    /// The samples so far.
    #[must_use]
    pub fn samples(&self) -> &[Sample] {
        &self.progress.samples
    }

    fn ask_drive(&mut self) {
        if self.progress.time == 0.0 || !self.drive.varies() {
            return;
        }
        let old = self.rim_speeds.clone();
        let yaw = self.progress.point.state.yaw;
        let slip_ratios = &self.progress.slip_ratios;
        let input = DriveInput { rover: &self.scenario.rover, yaw, slip_ratios };
        self.drive.rim_speeds(&input, &mut self.rim_speeds);
        self.progress.turn(self.scenario, &old, &self.rim_speeds);
    }
}

/// What a drive makes of the time until its next look, or until the end.
fn rims<'r>(scenario: &Scenario, drive: &dyn Drive, speeds: &'r [f64], until: f64) -> Rims<'r> {
    let changed = drive.varies();
    let kept_until = if changed { until } else { scenario.duration.max(until) };
    Rims { speeds, changed, kept_until }
}
