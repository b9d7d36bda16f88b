//! The inputs of learning from a drive.

use grouser::answers::Sampling;
use grouser::answers::learn::{LearnQuestion, SOIL_FILE};
use grouser::document::{self, escape};

use super::telemetry::log_name;
use super::{advice, balanced_overrides, check_numbers, refuse_sampled_keys, scenario_source};
use crate::args::LearnArgs;
use crate::failure::Failure;

/// The scenario that is learnt in, whose slope is that of the flag, and what is asked of the drive.
pub(crate) fn learn(args: &LearnArgs) -> Result<LearnQuestion, Failure> {
    let (setting, balance) = (&args.setting, &args.balance);
    let (rover, soil) = (args.rover.as_ref(), args.prior.as_ref());
    let mut overrides = balanced_overrides("learn", rover, soil, setting, balance)?;
    if let Some(slope) = &args.slope_deg {
        overrides.flag("--slope-deg", "scenario.slope_deg", slope)?;
    }
    let range = document::range(document::Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check_numbers("--predict-slope-deg", &args.predict_slope_deg, &range)?;
    let source = scenario_source("--scenario", args.scenario.as_deref())?;
    let scenario = document::read_scenario(&source, &overrides)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let advice = advice(&args.advice, &scenario)?;
    Ok(LearnQuestion {
        log: log_name(&args.logs),
        scenario,
        has_slope: args.slope_deg.is_some(),
        slopes_deg: args.predict_slope_deg.0.clone(),
        sampling: Sampling { count: args.samples, seed: args.seed },
        advice,
        soil_file: args.output.out.as_ref().map(|folder| escape::path(&folder.join(SOIL_FILE))),
    })
}
