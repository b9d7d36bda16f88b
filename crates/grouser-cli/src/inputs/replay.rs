//! The inputs of replaying a drive.

use grouser::answers::replay::ReplayQuestion;
use grouser::document;
use grouser::studies::replay::Part;

use super::telemetry::log_name;
use super::{balanced_overrides, refuse_sampled_keys, scenario_source};
use crate::args::ReplayArgs;
use crate::failure::Failure;

/// The scenario that is predicted with, whose slope is that of the flag, and how many samples of
/// soil and model.
pub(crate) fn replay(args: &ReplayArgs) -> Result<ReplayQuestion, Failure> {
    let (parts, setting) = (&args.parts, &args.setting);
    let (rover, soil) = (parts.rover.as_ref(), parts.soil.as_ref());
    let mut overrides = balanced_overrides("replay", rover, soil, setting, &args.balance)?;
    if let Some(slope) = &args.slope_deg {
        overrides.flag("--slope-deg", "scenario.slope_deg", slope)?;
    }
    let source = scenario_source("--scenario", args.scenario.as_deref())?;
    let scenario = document::read_scenario(&source, &overrides)?;
    let sampling = args.uncertainty.sampling();
    if sampling.is_some() {
        refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    }
    let (log, has_slope) = (log_name(&args.logs), args.slope_deg.is_some());
    let part = Part::new(args.from_s, args.to_s);
    let part = part.map_err(|error| Failure::Usage(format!("--to-s: {error}")))?;
    Ok(ReplayQuestion { log, scenario, has_slope, part, sampling })
}
