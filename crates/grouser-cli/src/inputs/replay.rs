//! The inputs of replaying a drive.

use grouser::document::{self, LoadedScenario};
use grouser::studies::ensemble::samples::{BandInputs, Sample};

use super::{balanced_overrides, refuse_sampled_keys, scenario_source};
use crate::args::ReplayArgs;
use crate::commands::sampling;
use crate::failure::Failure;

/// The scenario that is predicted with, whose slope is that of the flag, and samples of soil and
/// model, where they are asked for.
pub(crate) fn replay(args: &ReplayArgs) -> Result<(LoadedScenario, Vec<Sample>), Failure> {
    let (parts, setting) = (&args.parts, &args.setting);
    let (rover, soil) = (parts.rover.as_ref(), parts.soil.as_ref());
    let mut overrides = balanced_overrides("replay", rover, soil, setting, &args.balance)?;
    if let Some(slope) = &args.slope_deg {
        overrides.flag("--slope-deg", "scenario.slope_deg", slope)?;
    }
    let source = scenario_source("--scenario", args.scenario.as_deref())?;
    let scenario = document::read_scenario(&source, &overrides)?;
    if !args.uncertainty.sampling.uncertainty {
        return Ok((scenario, Vec::new()));
    }
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let inputs = BandInputs::of_scenario(&scenario);
    let samples =
        sampling::draw(&inputs, args.uncertainty.sampling.samples, args.uncertainty.seed)?;
    Ok((scenario, samples))
}
