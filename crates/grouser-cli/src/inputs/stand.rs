//! The inputs of test stands: wheel, soil, gravity and model.

use grouser::answers::wheel_test::{SimulatedStand, WheelTestQuestion};
use grouser::contact::Model;
use grouser::document::{self, Kind, Overrides, Source};
use grouser::simulation::Scenario;
use grouser::studies::ensemble::samples::BandInputs;

use super::{
    check_count, check_numbers, check_samples, flag_source, refuse_sampled_keys, scenario_settings,
};
use crate::args::{BalanceArgs, SettingArgs, StandArgs, WheelTestArgs};
use crate::failure::Failure;
use crate::list::Numbers;

/// Wheel, soil, gravity and model of a test stand.
pub(crate) struct StandInputs {
    pub(crate) soil: document::LoadedSoil,
    pub(crate) wheel: document::LoadedWheel,
    pub(crate) gravity: f64,
    pub(crate) model: Model,
    /// What its bands are drawn from.
    pub(crate) band: BandInputs,
}

/// The question of a wheel test.
pub(crate) fn wheel_test(args: &WheelTestArgs) -> Result<WheelTestQuestion, Failure> {
    use document::study;
    check_numbers("--load-n", &args.load_n, &study::LOAD_N)?;
    check_numbers("--slip-ratio", &args.slip_ratio, &study::SLIP_RATIO)?;
    check_numbers("--slip-angle-deg", &args.slip_angle_deg, &study::SLIP_ANGLE_DEG)?;
    let lists = [&args.load_n, &args.slip_ratio, &args.slip_angle_deg];
    check_count(&lists)?;
    if let Some(trials) = args.stand.trials {
        check_stand(&args.stand, trials)?;
    }
    let settings = args.setting.each_model();
    let sampling = args.sampling.with_seed(args.stand.seed);
    if let Some(sampling) = sampling {
        let rows: usize = lists.iter().map(|list| list.0.len()).product();
        check_samples(sampling.count, settings.len() * rows)?;
    }
    let read = |setting: &SettingArgs| {
        let stand = stand(&args.soil, &args.wheel, setting)?;
        if sampling.is_some() {
            refuse_sampled_keys(setting, stand.soil.uncertain.as_ref())?;
        }
        Ok(stand)
    };
    let stands = settings.iter().map(read).collect::<Result<Vec<_>, Failure>>()?;
    let models = stands.iter().map(|stand| (stand.model.clone(), stand.band.clone())).collect();
    // Stands differ by their models alone.
    let first = stands.into_iter().next();
    let StandInputs { soil, wheel, gravity, .. } =
        first.unwrap_or_else(|| unreachable!("some model is asked for"));
    let StandArgs { noise_n, noise_mm, noise_nm, seed, .. } = args.stand;
    let simulated = |trials| SimulatedStand { trials, noise_n, noise_mm, noise_nm, seed };
    Ok(WheelTestQuestion {
        soil,
        wheel,
        gravity,
        models,
        is_model_named: args.setting.model.is_some(),
        loads: args.load_n.0.clone(),
        slip_angles_deg: args.slip_angle_deg.0.clone(),
        slip_ratios: args.slip_ratio.0.clone(),
        stand: args.stand.trials.map(simulated),
        sampling,
        gradients: args.gradients.keys(),
    })
}

/// A soil and gravity [m/s²].
pub(crate) fn soil(
    name: &str,
    setting: &SettingArgs,
) -> Result<(document::LoadedSoil, f64), Failure> {
    let overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Soil])?;
    let soil = document::read_soil(&flag_source("--soil", Kind::Soil, name)?, &overrides)?;
    let run = default_run(setting)?;
    Ok((soil, run.gravity))
}

/// The default scenario with the gravity and the model of a setting: they are keys of scenarios,
/// and are checked as such.
fn default_run(setting: &SettingArgs) -> Result<Scenario, Failure> {
    let mut overrides = Overrides::none();
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    scenario_settings(&mut overrides, Kind::Scenario, setting, &balance)?;
    Ok(document::read_scenario(&Source::default_scenario(), &overrides)?.value)
}

/// Checks that the trials and the noise of a simulated stand are possible.
fn check_stand(args: &StandArgs, trials: usize) -> Result<(), Failure> {
    use document::simulated_test::{NOISE, TRIALS};
    let one = |number: f64| Numbers(vec![number]);
    check_numbers("--trials", &one(trials as f64), &TRIALS)?;
    check_numbers("--noise-n", &one(args.noise_n), &NOISE)?;
    check_numbers("--noise-mm", &one(args.noise_mm), &NOISE)?;
    check_numbers("--noise-nm", &one(args.noise_nm), &NOISE)
}

/// A wheel on a test stand, from the names of its soil and wheel.
pub(crate) fn stand(
    soil: &str,
    wheel: &str,
    setting: &SettingArgs,
) -> Result<StandInputs, Failure> {
    let overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Soil, Kind::Wheel])?;
    let soil = document::read_soil(&flag_source("--soil", Kind::Soil, soil)?, &overrides)?;
    let wheel = document::read_wheel(&flag_source("--wheel", Kind::Wheel, wheel)?, &overrides)?;
    let run = default_run(setting)?;
    soil.value.check_under(&wheel.value, run.gravity)?;
    let chosen = setting.model.as_ref().map(|_| run.model);
    let model = chosen.clone().unwrap_or_else(|| soil.document.usual_model(""));
    let band = BandInputs::of_soil(&soil, chosen);
    Ok(StandInputs { soil, wheel, gravity: run.gravity, model, band })
}
