//! Telemetry of a drive, from a file of any kind or from standard input.

use std::io;
use std::path::Path;

use grouser::document::measurements::telemetry::Odometry;
use grouser::document::{self, Kind, Overrides, Source, escape};
use grouser::vehicle::Rover;
use grouser_logs::{LogOptions, Mapping, TelemetryError, TelemetryLog};

use super::flag_source;
use super::follow::Following;
use crate::args::{LogArgs, TelemetryArgs};
use crate::failure::Failure;

/// The name of standard input among files.
const STANDARD_INPUT: &str = "-";

impl From<TelemetryError> for Failure {
    fn from(error: TelemetryError) -> Self {
        let budget = ("a larger `max_unpacked_mib` reads", "--max-unpacked-mib N reads");
        let message = error.to_string().replacen(budget.0, budget.1, 1);
        if error.is_environment() { Self::Run(message) } else { Self::Usage(message) }
    }
}

/// A log, opened: its records and notes come from the same value.
///
/// * `path`: a file, or `-` for CSV from standard input
/// * `rover`: the rover that was driven
/// * `following`: whether rows that are added to a file of CSV are read, too
pub(crate) fn telemetry(
    path: &Path,
    args: &TelemetryArgs,
    rover: &Rover,
    following: Option<Following>,
) -> Result<TelemetryLog, Failure> {
    let label = telemetry_label(path);
    let options = log_options(&args.log)?.with_odometry(args.odometry());
    read(path, &label, &options, rover, following)
}

/// A log whose ways nobody looks at, whatever measured them.
pub(crate) fn telemetry_without_way(
    path: &Path,
    args: &LogArgs,
    rover: &Rover,
) -> Result<TelemetryLog, Failure> {
    let options = log_options(args)?.with_odometry(Some(Odometry::Visual));
    read(path, &telemetry_label(path), &options, rover, None)
}

fn read(
    path: &Path,
    label: &str,
    options: &LogOptions,
    rover: &Rover,
    following: Option<Following>,
) -> Result<TelemetryLog, Failure> {
    if is_standard_input(path) {
        return Ok(TelemetryLog::of_table(label, Box::new(io::stdin().lock()), rover, options)?);
    }
    if let Some(following) = following {
        let source = Box::new(following.open(path)?);
        return Ok(TelemetryLog::of_table(label, source, rover, options)?);
    }
    Ok(TelemetryLog::open(path, rover, options)?)
}

/// Less of a log than this is too little to rely on without a word [-]. Source: ours.
const LEAST_USED: f64 = 0.5;

/// Checks that enough of a log could be used; all else is done then.
///
/// * `share`: of its rows or readings [-]
pub(crate) fn check_share_used(label: &str, share: f64, args: &LogArgs) -> Result<(), Failure> {
    if share >= LEAST_USED || args.accept_loss {
        return Ok(());
    }
    let percent = (100.0 * share).floor();
    Err(Failure::Partly(format!(
        "{label}: only {percent} % of the log could be used, and the notes say why\nhint: \
         --accept-loss takes it as it is"
    )))
}

/// What messages call a log.
pub(crate) fn telemetry_label(path: &Path) -> String {
    if is_standard_input(path) { "standard input".to_owned() } else { escape::path(path) }
}

/// Whether a log comes from standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// How a log is read.
pub(crate) fn log_options(args: &LogArgs) -> Result<LogOptions, Failure> {
    let mapping = args.mapping.as_deref().map(Mapping::find).transpose()?;
    let topics = args.topics.iter().cloned().collect();
    let options = LogOptions::default().with_mapping(mapping).with_topics(topics);
    Ok(options.with_most_unpacked(args.max_unpacked_mib.map(|mebibytes| mebibytes << 20)))
}

/// The rover that was driven.
///
/// * `name`: a preset or a file; without it that of the default scenario
pub(crate) fn driven_rover(name: Option<&str>) -> Result<Rover, Failure> {
    let Some(name) = name else {
        let scenario = document::read_scenario(&Source::default_scenario(), &Overrides::none())?;
        return Ok(scenario.value.rover);
    };
    let source = flag_source("--rover", Kind::Rover, name)?;
    Ok(document::read_rover(&source, &Overrides::none())?.value)
}
