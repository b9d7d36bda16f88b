//! Telemetry of a drive, from a file of any kind or from standard input.

use std::io;
use std::path::{Path, PathBuf};

use grouser::document::measurements::telemetry::Odometry;
use grouser::document::{self, Kind, Overrides, Source};
use grouser::vehicle::Rover;
use grouser_logs::{LogOptions, Mapping, OptionNames, TelemetryError, TelemetryLog};

use super::flag_source;
use super::follow::Following;
use crate::args::{LogArgs, TelemetryArgs};
use crate::failure::Failure;

/// The name of standard input among files.
const STANDARD_INPUT: &str = "-";

/// The options by which the program is asked.
const OPTIONS: OptionNames = OptionNames {
    mapping: "--mapping FILE.toml",
    topic: |what, topic| format!("--topic {what}={topic}"),
    odometry: "--odometry KIND",
    budget: "--max-unpacked-mib N",
    python: "python -m grouser import-telemetry LOG --out drive.csv",
};

impl From<TelemetryError> for Failure {
    fn from(error: TelemetryError) -> Self {
        let hint = error.remedy().map(|it| format!("\nhint: {}", it.words(&OPTIONS)));
        let message = error.to_string() + &hint.unwrap_or_default();
        if error.is_environment() { Self::Run(message) } else { Self::Usage(message) }
    }
}

/// A log, opened: its records and notes come from the same value.
///
/// * `paths`: files of one drive, or `-` alone for CSV from standard input
/// * `rover`: the rover that was driven
/// * `following`: whether rows that are added to a file of CSV are read, too
pub(crate) fn telemetry(
    paths: &[PathBuf],
    args: &TelemetryArgs,
    rover: &Rover,
    following: Option<Following>,
) -> Result<TelemetryLog, Failure> {
    let options = log_options(&args.log)?.with_odometry(args.odometry());
    read(paths, &options, rover, following)
}

/// A log whose ways nobody looks at, whatever measured them.
pub(crate) fn telemetry_without_way(
    path: &Path,
    args: &LogArgs,
    rover: &Rover,
) -> Result<TelemetryLog, Failure> {
    let options = log_options(args)?.with_odometry(Some(Odometry::Visual));
    read(&[path.to_owned()], &options, rover, None)
}

fn read(
    paths: &[PathBuf],
    options: &LogOptions,
    rover: &Rover,
    following: Option<Following>,
) -> Result<TelemetryLog, Failure> {
    check_several(paths, following.is_some())?;
    let label = telemetry_label(paths);
    if is_standard_input(paths) {
        return Ok(TelemetryLog::of_table(&label, Box::new(io::stdin().lock()), rover, options)?);
    }
    if let (Some(following), [path]) = (following, paths) {
        let source = Box::new(following.open(path)?);
        return Ok(TelemetryLog::of_table(&label, source, rover, options)?);
    }
    Ok(TelemetryLog::open_all(paths, rover, options)?)
}

/// Checks that what is one log alone is not among several.
fn check_several(paths: &[PathBuf], is_followed: bool) -> Result<(), Failure> {
    if paths.len() < 2 {
        return Ok(());
    }
    let label = telemetry_label(paths);
    if is_followed {
        return Err(Failure::Usage(format!(
            "--follow: {label}: one log is followed, the one that grows\nhint: learn from the others \
             first, or leave --follow out"
        )));
    }
    if paths.iter().any(|it| it == Path::new(STANDARD_INPUT)) {
        return Err(Failure::Usage(format!(
            "{label}: standard input (-) is a log alone, and no one of several files"
        )));
    }
    Ok(())
}

/// Checks that enough of a log could be used; all else is done then.
///
/// * `share`: of its rows or readings [-]
pub(crate) fn check_share_used(label: &str, share: f64, args: &LogArgs) -> Result<(), Failure> {
    match TelemetryLog::little_used(share).filter(|_| !args.accept_loss) {
        None => Ok(()),
        Some(words) => Err(Failure::Partly(format!(
            "{label}: {words}, and the notes say why\nhint: --accept-loss takes it as it is"
        ))),
    }
}

/// What messages call a log.
pub(crate) fn telemetry_label(paths: &[PathBuf]) -> String {
    let is_stream = is_standard_input(paths);
    if is_stream { "standard input".to_owned() } else { TelemetryLog::label_of(paths) }
}

/// What an answer calls a log: all of its files.
pub(crate) fn log_name(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|it| it.display().to_string()).collect();
    names.join(", ")
}

/// Whether a log comes from standard input.
pub(crate) fn is_standard_input(paths: &[PathBuf]) -> bool {
    matches!(paths, [path] if path == Path::new(STANDARD_INPUT))
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
