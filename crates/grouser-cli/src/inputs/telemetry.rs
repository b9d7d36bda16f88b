//! Telemetry of a drive, from a file of any kind or from standard input.

use std::io;
use std::path::Path;

use grouser::vehicle::Rover;
use grouser_telemetry::{Mapping, TelemetryError, TelemetryLog};

use crate::args::TelemetryArgs;
use crate::failure::Failure;

/// The name of standard input among files.
const STANDARD_INPUT: &str = "-";

impl From<TelemetryError> for Failure {
    fn from(error: TelemetryError) -> Self {
        if error.is_environment() {
            Self::Run(error.to_string())
        } else {
            Self::Usage(error.to_string())
        }
    }
}

/// A log, opened: its records and notes come from the same value.
///
/// * `path`: a file, or `-` for CSV from standard input
/// * `rover`: the rover that was driven
pub(crate) fn telemetry(
    path: &Path,
    args: &TelemetryArgs,
    rover: &Rover,
) -> Result<TelemetryLog, Failure> {
    if path == Path::new(STANDARD_INPUT) {
        let source = Box::new(io::stdin().lock());
        return Ok(TelemetryLog::of_csv("standard input", source, rover)?);
    }
    let mapping = args.mapping.as_deref().map(Mapping::find).transpose()?;
    let choices = args.topics.iter().cloned().collect();
    Ok(TelemetryLog::open(path, rover, mapping.as_ref(), &choices)?)
}
