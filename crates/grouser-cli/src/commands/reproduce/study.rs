//! The study: what is run, with which numbers.

use std::f64::consts::PI;

use grouser::contact::Model;
use grouser::document::{self, LoadedScenario, Overrides, Source, experiment};
use grouser::simulation::Scatter;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::HeadingStudy;
use grouser::studies::heading_band::{HeadingBand, SlopeBand};
use grouser::studies::lost_yaw::{LostYawPlan, SlopeLoss};
use grouser::studies::reproduction::{Plan, ReproductionError};
use grouser::terrain::SoilScatter;

use crate::commands::sampling;
use crate::failure::Failure;
use crate::output;
use crate::report::experiment::Study;

/// Load transfer of the paper's model, its Eqs 12-14: by the weight and the slope alone.
const PAPERS_LOADS: &str = "quasi-static";

/// Load in the paper's single-wheel test [N]: "about 20N", its section 4.1.
const WHEEL_LOAD: f64 = 20.0;
/// K_x at slip angle 0 [m]: Table 3; a value that would explain the paper's *attitude* on 20°; and
/// what its section 4.2 prints after tuning.
const LONGITUDINAL_MODULI: [f64; 3] = [0.036, 0.030, 0.3];

/// Slip angles of the wheel curves [°]; the rover's own are below 22°.
const SLIP_ANGLES_DEG: [f64; 3] = [0.0, 15.0, 30.0];
/// Models whose headings stand beside those of the paper's.
const OTHER_MODELS: [Model; 2] = [Model::Rft, Model::Bekker];
/// What scatters where the yaw that is lost is explained: 1° of friction, a tenth of stiffness,
/// half a per cent of speed. Source: assumed, for a raked bed and motors under speed control.
pub(super) const SCATTER: Scatter = Scatter {
    soil: SoilScatter {
        friction_angle: PI / 180.0,
        stiffness: 0.1,
        correlation_length: Scatter::USUAL_LENGTH,
    },
    speed: 0.005,
    seed: 0,
};
/// Other correlation lengths that are tried [m]: about a footprint's length, and that of the bed.
const OTHER_LENGTHS: [f64; 2] = [0.1, 1.0];
/// The sand as it is known for the band of headings.
const UNCERTAIN_SOIL: &str = "toyoura-uncertain";
/// Slopes of that band, 1° apart, to this one [°].
const LAST_SLOPE_DEG: u32 = 24;
/// Seed of all samples.
const SEED: u64 = 1;

/// Loads of the sinkage curves [N]: half of, about, and twice what the rover's wheels carry.
const LOADS: [f64; 3] = [10.0, 20.0, 40.0];

impl From<ReproductionError> for Failure {
    fn from(error: ReproductionError) -> Self {
        match error {
            ReproductionError::Parameter(error) => error.into(),
            ReproductionError::Simulation(error) => error.into(),
        }
    }
}

/// Runs all of it; the scenario is that of the paper.
///
/// * `samples`: of bands, and runs for each cause of lost yaw
pub(super) fn run(samples: u32) -> Result<(LoadedScenario, Study), Failure> {
    let mut as_in_the_paper = Overrides::none();
    as_in_the_paper.flag_text("--load-transfer", "scenario.load_transfer", PAPERS_LOADS)?;
    let scenario = document::read_scenario(&Source::default_scenario(), &as_in_the_paper)?;
    let plan = Plan {
        scenario: scenario.value.clone(),
        measured: experiment::table_4(),
        wheel_load: WHEEL_LOAD,
        longitudinal_moduli: LONGITUDINAL_MODULI.to_vec(),
        slip_angles: SLIP_ANGLES_DEG.map(f64::to_radians).to_vec(),
        loads: LOADS.to_vec(),
        other_models: OTHER_MODELS.to_vec(),
    };
    let study = Study {
        paper: with_bar(plan.step_count(), |progress| Ok(plan.run(progress)?))?,
        band: band(samples)?,
        lost: lost_yaw(&plan, samples)?,
        other_lengths: OTHER_LENGTHS.to_vec(),
    };
    Ok((scenario, study))
}

/// Computes with a bar that goes on with every step.
fn with_bar<T>(
    steps: usize,
    compute: impl FnOnce(&mut dyn FnMut(&str)) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let bar = output::progress_bar(steps as u64);
    let mut begun = 0;
    let found = compute(&mut |step| {
        bar.set_position(begun);
        bar.set_message(step.to_owned());
        begun += 1;
    });
    bar.finish_and_clear();
    found
}

/// Headings where soil and model are uncertain, with complete loads.
fn band(samples: u32) -> Result<Vec<SlopeBand>, Failure> {
    let mut uncertain = Overrides::none();
    uncertain.flag_text("--soil", "scenario.soil", UNCERTAIN_SOIL)?;
    let scenario = document::read_scenario(&Source::default_scenario(), &uncertain)?;
    let samples = sampling::draw(&BandInputs::of_scenario(&scenario), samples, SEED)?;
    let slopes: Vec<f64> =
        (1..=LAST_SLOPE_DEG).map(|slope| f64::from(slope).to_radians()).collect();
    let study = HeadingStudy::of(&scenario.value);
    let band = sampling::with_bar(samples.len(), |go_on| {
        HeadingBand::of(&study, &samples, &slopes, go_on)
    });
    Ok(sampling::whole(band?).slopes)
}

/// The yaw lost on the way, with complete loads.
fn lost_yaw(plan: &Plan, samples: u32) -> Result<Vec<SlopeLoss>, Failure> {
    let plan = LostYawPlan {
        scenario: document::read_scenario(&Source::default_scenario(), &Overrides::none())?.value,
        measured: plan.measured.clone(),
        scatter: SCATTER,
        other_lengths: OTHER_LENGTHS.to_vec(),
        samples,
        seed: SEED,
    };
    with_bar(plan.step_count(), |progress| Ok(plan.run(progress)?))
}
