//! The inputs of learning from a drive.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use grouser::document::{self, LoadedScenario, escape};

use super::follow::Following;
use super::{balanced_overrides, check_numbers, refuse_sampled_keys, scenario_source};
use crate::args::LearnArgs;
use crate::failure::Failure;

/// The name of standard input among files.
const STANDARD_INPUT: &str = "-";

/// The scenario that is learnt in; its slope is that of the flag.
pub(crate) fn learn(args: &LearnArgs) -> Result<LoadedScenario, Failure> {
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
    Ok(scenario)
}

/// A log to read, and what messages call it.
///
/// * `following`: whether rows that are added to it are read, too
pub(crate) fn telemetry(
    path: &Path,
    following: Option<Following>,
) -> Result<(String, Box<dyn Read + Send>), Failure> {
    if is_standard_input(path) {
        return Ok(("standard input".to_owned(), Box::new(io::stdin())));
    }
    let label = escape::path(path);
    let failed = |why: &str| {
        Failure::Usage(format!(
            "{label}: {why}\nhint: name a CSV file of telemetry, or - to read standard input"
        ))
    };
    if path.is_dir() {
        return Err(failed("this is a folder, not a file"));
    }
    match File::open(path) {
        Ok(file) => Ok((
            label,
            match following {
                Some(following) => Box::new(following.of(file)),
                None => Box::new(file),
            },
        )),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(failed("there is no such file"))
        }
        Err(error) => Err(Failure::Run(format!("{label}: cannot be read: {error}"))),
    }
}

/// Whether a log comes from standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}
