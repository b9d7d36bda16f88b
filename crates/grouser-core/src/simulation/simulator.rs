//! A rover that is led step by step: rim speeds in, the rover after a while out.

use super::progress::{Keep, Progress, Rims};
use super::run::SimulationError;
use super::scenario::{LONGEST_DURATION, Scenario};
use super::times::snapped;
use super::trajectory::{Method, Outcome, Sample, Work};
use super::watch::WATCH_PERIOD;
use crate::error::ParameterError;
use crate::vehicle::drive::DriveInput;
use crate::vehicle::{Drive, DriveLaw};

/// The shortest step [s]. Source: ours; slip settles within milliseconds, no rover's control is a thousand times faster.
pub const LEAST_STEP: f64 = 1e-6;

/// A rover on its scenario's plane, led by whoever asks for the next step.
///
/// It is the motion of a [`Simulation`](super::Simulation), by the same equations and the same
/// integrator, cut into steps. Over a step every wheel keeps its rim speed (a zero-order hold), and
/// at its beginning takes it at once. The scenario's drive turns the wheels until the first step;
/// its duration and sample interval do not matter.
///
/// A clone goes on as the original would, bit for bit.
#[derive(Clone)]
pub struct Simulator {
    scenario: Scenario,
    rim_speeds: Vec<f64>,
    progress: Progress,
}

impl Simulator {
    /// A rover at the start of its scenario.
    ///
    /// # Errors
    /// [`SimulationError`] if the scenario is no run, or the wheels do not settle at its start
    /// for another reason than a physical one.
    pub fn new(scenario: Scenario) -> Result<Self, SimulationError> {
        scenario.check()?;
        let rover = &scenario.rover;
        let slip_ratios = vec![0.0; rover.wheel_count()];
        let mut rim_speeds = slip_ratios.clone();
        let input = DriveInput { rover, yaw: scenario.start.yaw, slip_ratios: &slip_ratios };
        scenario.drive.clone().rim_speeds(&input, &mut rim_speeds);
        let mut progress = Progress::new(&scenario, &rim_speeds);
        progress.keep = Keep::At(0.0);
        let rims = Rims { speeds: &rim_speeds, changed: false, kept_until: 0.0 };
        progress.advance_through(&scenario, rims, &[])?;
        Ok(Self { scenario, rim_speeds, progress })
    }

    /// Turns the wheels at the given speeds for a while. A rover whose [`outcome`](Self::outcome) is
    /// known stays as it is: its run has ended.
    ///
    /// * `rim_speeds`: ω r_s of each wheel [m/s], in the mounts' order
    /// * `span`: how long [s], from [`LEAST_STEP`] to a day
    ///
    /// # Errors
    /// [`SimulationError`] for speeds and times that nothing can have, which change nothing; and
    /// where the motion cannot be computed, at which the rover stays where it last was looked at.
    pub fn step(&mut self, rim_speeds: &[f64], span: f64) -> Result<(), SimulationError> {
        DriveLaw::ConstantEach(rim_speeds.to_vec()).check(&self.scenario.rover)?;
        if !(LEAST_STEP..=LONGEST_DURATION).contains(&span) {
            let expected = "from 1e-6 to 86400";
            return Err(ParameterError::new("step [s]", span, expected).into());
        }
        if self.progress.outcome.is_some() {
            return Ok(());
        }
        let changed = self.rim_speeds != rim_speeds;
        if changed {
            self.progress.turn(&self.scenario, &self.rim_speeds, rim_speeds);
            self.rim_speeds.copy_from_slice(rim_speeds);
        }
        let until = snapped(self.progress.time + span, WATCH_PERIOD);
        self.progress.samples.clear();
        self.progress.keep = Keep::At(until);
        let rims = Rims { speeds: &self.rim_speeds, changed, kept_until: until };
        let done = self.progress.advance(&self.scenario, rims, until);
        if self.progress.samples.is_empty() {
            self.progress.keep_here(&self.scenario, &self.rim_speeds);
        }
        done
    }

    /// The rover now: at its start, after the last step, or when its outcome was found.
    ///
    /// # Panics
    /// Never: there always is a sample.
    #[must_use]
    pub fn now(&self) -> &Sample {
        self.progress.samples.last().expect("a simulator has a sample")
    }

    /// The wheels' rim speeds, *ω r_s* [m/s].
    #[must_use]
    pub fn rim_speeds(&self) -> &[f64] {
        &self.rim_speeds
    }

    /// What became of the rover, if its run has ended.
    #[must_use]
    pub fn outcome(&self) -> Option<&Outcome> {
        self.progress.outcome.as_ref()
    }

    /// How it was computed so far.
    #[must_use]
    pub fn method(&self) -> &Method {
        &self.progress.method
    }

    /// Work of the solver so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.progress.work
    }

    /// What is simulated.
    #[must_use]
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }
}
