//! A drive that was measured beside the one that is predicted, of a file of telemetry or of its
//! text.

use std::io::Cursor;
use std::path::PathBuf;

use grouser::document::columns::replay as columns;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::replay::{NothingToReplay, Replay, Replayer};
use grouser_logs::{LogOptions, TelemetryError, TelemetryLog};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::studies::Problem;
use crate::telemetry::odometry_named;
use crate::{errors, threads};

/// Why there is no replay.
enum NoReplay {
    Telemetry(TelemetryError),
    Nothing(NothingToReplay),
}

/// Tables over time, of channels and of findings; what the differences point to, notes, and the
/// names of the wheels.
type Replayed<'py> = (
    (Bound<'py, PyDict>, Bound<'py, PyDict>, Bound<'py, PyDict>),
    Vec<String>,
    Vec<String>,
    Vec<String>,
);

/// * `path`: of the telemetry, or what messages call its text
/// * `text`: CSV, in place of the file's
/// * `slope_is_known`: whether the scenario's slope is that of the drive
/// * `samples`: of soil and model; 0 to take both as known
/// * `odometry`: what measured ways and rotations, if that is stated
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
#[allow(clippy::too_many_arguments, reason = "arguments, as they come from Python")]
#[pyo3(signature = (scenario, path, text, slope_is_known, samples, seed, odometry=None))]
pub(crate) fn replay<'py>(
    py: Python<'py>,
    scenario: &Document,
    path: PathBuf,
    text: Option<String>,
    slope_is_known: bool,
    samples: u32,
    seed: u64,
    odometry: Option<&str>,
) -> PyResult<Replayed<'py>> {
    let loaded = scenario.scenario()?;
    let inputs = BandInputs::of_scenario(loaded);
    let samples = threads::detached(py, || inputs.samples(seed, samples))?;
    let samples = samples.map_err(|error| Problem::Sampling(error).raised())?;
    let slope = loaded.value.ground.plane_slope().filter(|_| slope_is_known);
    let options = LogOptions::default().with_odometry(odometry_named(odometry)?);
    let label = path.display().to_string();
    let found = threads::detached(py, || -> Result<(Replay, Vec<String>), NoReplay> {
        let mut replayer = Replayer::new(&loaded.value, slope);
        let rover = &loaded.value.rover;
        let log = match text {
            Some(text) => {
                TelemetryLog::of_csv(&label, Box::new(Cursor::new(text)), rover, &options)
            }
            None => TelemetryLog::open(&path, rover, &options),
        };
        let mut log = log.map_err(NoReplay::Telemetry)?;
        while let Some(record) = log.next_record().map_err(NoReplay::Telemetry)? {
            replayer.update(record);
        }
        let replay = replayer.finish(&samples, &|| true).map_err(NoReplay::Nothing)?;
        let Some(replay) = replay else { unreachable!("it was not stopped") };
        Ok((replay, log.notes()))
    })?;
    let (replay, mut notes) = found.map_err(|error| match error {
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
    Ok((tables, columns::sentences(&replay), notes, wheels))
}
