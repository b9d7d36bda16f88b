//! The source paper's study, run again: wheel curves (Fig. 7), traverses (Fig. 9), heading
//! offsets (Fig. 10, there *attitude*) and the comparison with the experiment (Table 4).

use super::comparison::MeasuredTraverse;
use super::heading::{HeadingCurve, HeadingOffset, HeadingStudy, NoHeading};
use super::wheel_test::{WheelTest, WheelTestRow};
use crate::contact::Model;
use crate::error::ParameterError;
use crate::simulation::{
    Motion, Numerics, PrescribedYaw, Run, RunError, Scenario, Start, Trajectory,
};
use crate::soil::{Shear, ShearModulus, Soil};
use crate::vehicle::{LoadSharing, OwnMoments};

/// The inputs of the study: the paper's rover, soil and drive, and its measurements.
///
/// How far off the contour do simulated traverses end on one slope: with the nose along the
/// contour, and with the heading offset that was measured at the start?
///
/// ```
/// use grouser::document::{self, Overrides, Source, experiment};
/// use grouser::studies::reproduction::Plan;
///
/// let as_in_the_paper = Overrides::parse(["scenario.load_transfer=quasi-static"])?;
/// let plan = Plan {
///     scenario: document::read_scenario(&Source::default_scenario(), &as_in_the_paper)?.value,
///     measured: vec![experiment::table_4()[1]],
///     wheel_load: 17.0,
///     longitudinal_moduli: vec![0.036],
///     slip_angles: vec![0.0],
///     loads: vec![17.0],
///     other_models: vec![],
/// };
/// let reproduction = plan.run(&mut |_| ())?;
/// let slope = &reproduction.slopes[0];
/// let end = |run: &grouser::simulation::Trajectory| {
///     format!("{:.0} mm", 1e3 * run.last().state.position.y)
/// };
/// assert_eq!(end(&slope.uncompensated), "-97 mm");
/// assert_eq!(end(&slope.from_measured_yaw), "10 mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Rover, soil, drive and duration of every traverse; slope and start are set for each. Its
    /// load transfer is that of headings and of traverses that say no other.
    pub scenario: Scenario,
    /// The measured traverses.
    pub measured: Vec<MeasuredTraverse>,
    /// Load on the wheel in the single-wheel test [N].
    pub wheel_load: f64,
    /// Values tried for K_x at slip angle 0 [m].
    pub longitudinal_moduli: Vec<f64>,
    /// Slip angles at which the soil's own K_x is tested [rad].
    pub slip_angles: Vec<f64>,
    /// Loads under which it is tested at slip angle 0 [N].
    pub loads: Vec<f64>,
    /// Wheel–soil models whose headings stand beside the scenario's.
    pub other_models: Vec<Model>,
}

/// The results of the study: wheel tests, heading offsets, traverses.
#[derive(Clone, Debug, PartialEq)]
pub struct Reproduction {
    /// The single-wheel test for each longitudinal modulus.
    pub wheel_curves: Vec<WheelCurve>,
    /// The single-wheel test at each slip angle, under the plan's wheel load.
    pub by_slip_angle: Vec<WheelTestRow>,
    /// The single-wheel test under each load, at slip angle 0.
    pub by_load: Vec<WheelTestRow>,
    /// The heading offset over the slope.
    pub headings: HeadingCurve,
    /// The same by the other models.
    pub other_headings: Vec<(Model, HeadingCurve)>,
    /// The traverses on each measured slope.
    pub slopes: Vec<SlopeRuns>,
    /// The first moments of a run from rest, on the slope of [`START_UP_ROW`], finely sampled.
    pub start_up: Trajectory,
}

/// A single-wheel test at slip angle 0.
#[derive(Clone, Debug, PartialEq)]
pub struct WheelCurve {
    /// K_x at slip angle 0 [m].
    pub longitudinal_modulus: f64,
    /// Settings and results, in the order of the slip ratio.
    pub rows: Vec<WheelTestRow>,
}

/// The traverses on one slope.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeRuns {
    /// What was measured there.
    pub measured: MeasuredTraverse,
    /// Our heading offset.
    pub heading: Result<HeadingOffset, NoHeading>,
    /// Nose along the contour: the drift.
    pub uncompensated: Trajectory,
    /// Started at our heading offset, where a heading holds the contour.
    pub compensated: Option<Trajectory>,
    /// Started at the measured yaw, with quasi-static load transfer.
    pub from_measured_yaw: Trajectory,
    /// The same, with the wheels' torque in the pitch balance.
    pub from_measured_yaw_with_torque: Trajectory,
    /// The same with the complete load transfer.
    pub from_measured_yaw_complete: Trajectory,
    /// Held at the measured yaw, which is taken to go straight from its start to its end: the
    /// balance of forces alone decides how the rover drifts.
    pub at_measured_yaw: Trajectory,
}

/// Which measured slope the run from rest is on.
pub const START_UP_ROW: usize = 1;
/// Length of the run from rest [s], and its sample interval [s].
const START_UP: (f64, f64) = (0.3, 0.002);

/// The study cannot be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReproductionError {
    /// The plan is wrong.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A traverse could not be computed.
    #[error(transparent)]
    Simulation(#[from] RunError),
}

impl Plan {
    /// How many steps [`run`](Self::run) reports.
    #[must_use]
    pub fn step_count(&self) -> usize {
        self.longitudinal_moduli.len() + 2 + RUNS_PER_SLOPE * self.measured.len() + 1
    }

    /// Runs the study; `progress` gets the name of each step as it begins.
    ///
    /// # Errors
    /// [`ReproductionError`] if the plan is wrong or a run cannot be computed.
    pub fn run(&self, progress: &mut dyn FnMut(&str)) -> Result<Reproduction, ReproductionError> {
        self.scenario.check()?;
        let wheel_curves =
            self.longitudinal_moduli.iter().map(|&modulus| self.wheel_curve(modulus, progress));
        let wheel_curves = wheel_curves.collect();
        progress("wheel test");
        let by_slip_angle = self.wheel_test(&[self.wheel_load], &self.slip_angles).run();
        let by_load = self.wheel_test(&self.loads, &[0.0]).run();
        progress("heading offsets");
        let study = HeadingStudy::of(&self.scenario);
        let headings = study.curve()?;
        let by_model = |model: &Model| {
            Ok((model.clone(), HeadingStudy { model: model.clone(), ..study.clone() }.curve()?))
        };
        let other_headings =
            self.other_models.iter().map(by_model).collect::<Result<_, ParameterError>>()?;
        let slopes = self
            .measured
            .iter()
            .map(|measured| self.slope_runs(measured, &headings, progress))
            .collect::<Result<Vec<_>, _>>()?;
        progress("start from rest");
        let start_up = self.start_up(&slopes)?;
        Ok(Reproduction {
            wheel_curves,
            by_slip_angle,
            by_load,
            headings,
            other_headings,
            slopes,
            start_up,
        })
    }

    fn wheel_curve(&self, modulus: f64, progress: &mut dyn FnMut(&str)) -> WheelCurve {
        progress("wheel test");
        let test = self.wheel_test(&[self.wheel_load], &[0.0]);
        let soil = with_longitudinal_modulus(&test.soil, modulus);
        WheelCurve { longitudinal_modulus: modulus, rows: WheelTest { soil, ..test }.run() }
    }

    /// The rover's first wheel on the scenario's soil, over slip ratios from 0 to 1.
    fn wheel_test(&self, loads: &[f64], slip_angles: &[f64]) -> WheelTest {
        /// Steps from slip ratio 0 to 1.
        const STEPS: u32 = 50;
        let Scenario { rover, ground, gravity, model, .. } = &self.scenario;
        WheelTest {
            wheel: rover.mounts()[0].unit.wheel,
            soil: ground.soil,
            gravity: *gravity,
            model: model.clone(),
            loads: loads.to_vec(),
            slip_angles: slip_angles.to_vec(),
            slip_ratios: (0..=STEPS).map(|step| f64::from(step) / f64::from(STEPS)).collect(),
        }
    }

    fn slope_runs(
        &self,
        measured: &MeasuredTraverse,
        headings: &HeadingCurve,
        progress: &mut dyn FnMut(&str),
    ) -> Result<SlopeRuns, ReproductionError> {
        let mut run = |scenario: Scenario| {
            progress("traverse");
            Run::new(&scenario)?.to_end()
        };
        let traverse = |yaw: f64| self.traverse(measured.slope, yaw);
        let from_measured_yaw = |sharing: LoadSharing| {
            let own_moments = match sharing {
                LoadSharing::Complete => OwnMoments::Included,
                _ => OwnMoments::Neglected,
            };
            Scenario { sharing, own_moments, ..traverse(measured.initial_yaw) }
        };
        let heading = headings.at(measured.slope);
        Ok(SlopeRuns {
            measured: *measured,
            uncompensated: run(traverse(0.0))?,
            compensated: heading
                .as_ref()
                .ok()
                .map(|heading| run(traverse(heading.yaw)))
                .transpose()?,
            from_measured_yaw: run(from_measured_yaw(LoadSharing::QuasiStatic))?,
            from_measured_yaw_with_torque: run(from_measured_yaw(LoadSharing::QuasiStaticTorque))?,
            from_measured_yaw_complete: run(from_measured_yaw(LoadSharing::Complete))?,
            at_measured_yaw: run(self.at_measured_yaw(measured))?,
            heading,
        })
    }

    fn at_measured_yaw(&self, measured: &MeasuredTraverse) -> Scenario {
        let end = (self.scenario.duration, measured.final_yaw);
        let points = vec![(0.0, measured.initial_yaw), end];
        let yaw = Some(PrescribedYaw { points });
        Scenario { yaw, ..self.traverse(measured.slope, measured.initial_yaw) }
    }

    fn start_up(&self, slopes: &[SlopeRuns]) -> Result<Trajectory, RunError> {
        let row = slopes.get(START_UP_ROW).or(slopes.first());
        let own = self.scenario.ground.plane_slope().unwrap_or(0.0);
        let (slope, yaw) = row.map_or((own, 0.0), |row| {
            (row.measured.slope, row.heading.as_ref().map_or(0.0, |heading| heading.yaw))
        });
        let (duration, sample_interval) = START_UP;
        let scenario = Scenario {
            start: Start { yaw, motion: Motion::Rest },
            duration,
            numerics: Numerics { sample_interval, ..self.scenario.numerics },
            ..self.traverse(slope, yaw)
        };
        Run::new(&scenario)?.to_end()
    }

    fn traverse(&self, slope: f64, yaw: f64) -> Scenario {
        let base = self.scenario.clone();
        Scenario {
            ground: base.ground.with_slope(slope),
            start: Start { yaw, ..base.start },
            ..base
        }
    }
}

/// Runs in [`SlopeRuns`].
const RUNS_PER_SLOPE: usize = 6;

/// The soil with another K_x at slip angle 0; isotropic soils and quadratic moduli alike.
fn with_longitudinal_modulus(soil: &Soil, modulus: f64) -> Soil {
    let at_zero = modulus;
    let changed = |old: ShearModulus| match old {
        ShearModulus::Linear { per_radian, .. } => ShearModulus::Linear { at_zero, per_radian },
        ShearModulus::Quadratic { per_radian, per_radian_squared, angle_limit, .. } => {
            ShearModulus::Quadratic { at_zero, per_radian, per_radian_squared, angle_limit }
        }
    };
    let shear = match soil.shear {
        Shear::Anisotropic { longitudinal, lateral } => {
            Shear::Anisotropic { longitudinal: changed(longitudinal), lateral }
        }
        Shear::Isotropic { modulus } => Shear::Isotropic { modulus: changed(modulus) },
    };
    Soil { shear, ..*soil }
}
