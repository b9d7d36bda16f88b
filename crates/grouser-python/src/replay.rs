//! A drive that was measured beside the one that is predicted, of a file of telemetry or of its
//! text.

use std::io::Cursor;
use std::path::PathBuf;

use grouser::document::columns::replay as columns;
use grouser::document::given_file::GivenFile;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::replay::{NothingToReplay, Part, Replay, Replayer};
use grouser_logs::{LogOptions, TelemetryError, TelemetryLog};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::studies::Problem;
use crate::telemetry::{HowRead, bytes, files, odometry_named};
use crate::{errors, threads};

/// What messages call telemetry that is no file.
const LABEL: &str = "log";

/// Why there is no replay.
enum NoReplay {
    Telemetry(TelemetryError),
    Nothing(NothingToReplay),
}

/// Tables over time, of channels and of findings; what the differences point to, notes, the names of
/// the wheels, and what files gave.
type Replayed<'py> = (
    (Bound<'py, PyDict>, Bound<'py, PyDict>, Bound<'py, PyDict>),
    Vec<String>,
    Vec<String>,
    Vec<String>,
    String,
);

/// * `paths`: files of the telemetry; none for a text
/// * `text`: CSV, in place of the file's
/// * `drive`: whether the scenario's slope is that of the drive, and where the part of it begins and
///   ends that is replayed [s]
/// * `sampling`: how many samples of soil and model, 0 to take both as known, and their seed
/// * `how`: how the log is read
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths come from Python")]
#[pyo3(signature = (scenario, paths, text, drive, sampling, how=(None, None)))]
pub(crate) fn replay<'py>(
    py: Python<'py>,
    scenario: &Document,
    paths: Vec<PathBuf>,
    text: Option<String>,
    drive: (bool, Option<f64>, Option<f64>),
    sampling: (u32, u64),
    how: HowRead,
) -> PyResult<Replayed<'py>> {
    let (loaded, (count, seed)) = (scenario.scenario()?, sampling);
    let (slope_is_known, from, to) = drive;
    let inputs = BandInputs::of_scenario(loaded);
    let samples = threads::detached(py, || inputs.samples(seed, count))?;
    let samples = samples.map_err(|error| Problem::Sampling(error).raised())?;
    let slope = loaded.value.ground.plane_slope().filter(|_| slope_is_known);
    let options = LogOptions::default().with_odometry(odometry_named(how.0.as_deref())?);
    let options = options.with_most_unpacked(bytes(how.1));
    let is_file = text.is_none();
    let part = Part::new(from, to)
        .map_err(|error| errors::parameter(error.to_string(), "to_s", to, "a time after from_s"))?;
    let found =
        threads::detached(py, || -> Result<(Replay, Vec<String>, Vec<GivenFile>), NoReplay> {
            let mut replayer = Replayer::new(&loaded.value, slope).within(part);
            let rover = &loaded.value.rover;
            let log = match text {
                Some(text) => {
                    TelemetryLog::of_table(LABEL, Box::new(Cursor::new(text)), rover, &options)
                }
                None => TelemetryLog::open_all(&paths, rover, &options),
            };
            let mut log = log.map_err(NoReplay::Telemetry)?;
            while let Some(record) = log.next_record().map_err(NoReplay::Telemetry)? {
                replayer.update(record);
            }
            let replay = replayer.finish(&samples, &|| true).map_err(NoReplay::Nothing)?;
            let Some(replay) = replay else { unreachable!("it was not stopped") };
            let given = if is_file { log.given() } else { Vec::new() };
            Ok((replay, log.notes(), given))
        })?;
    let (replay, mut notes, mut given) = found.map_err(|error| match error {
        NoReplay::Telemetry(error) => errors::of_telemetry(&error),
        NoReplay::Nothing(error) => {
            errors::parameter(error.to_string(), "log", None, "telemetry with wheel speeds")
        }
    })?;
    notes.extend(columns::notes(&replay));
    let rover = &loaded.value.rover;
    let tables = (
        table_to_python(py, columns::over_time(&replay, rover))?,
        table_to_python(py, columns::channels(&replay, rover))?,
        table_to_python(py, columns::findings(&replay))?,
    );
    let wheels = rover.mounts().iter().map(|mount| mount.name.clone()).collect();
    given.extend(loaded.given.iter().cloned());
    Ok((tables, columns::sentences(&replay), notes, wheels, files(&given)))
}
