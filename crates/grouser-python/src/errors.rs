//! The library's errors as Python's, by the names of `grouser/_errors.py`.

use std::any::Any;
use std::ffi::CString;
use std::fmt::Display;
use std::io::ErrorKind;
use std::ops::RangeInclusive;
use std::panic::{AssertUnwindSafe, catch_unwind};

use grouser::document::file::FileProblem;
use grouser::document::measurements::{MeasurementError, MeasurementProblem};
use grouser::document::ranking::RankingError;
use grouser::document::urdf::UrdfError;
use grouser::document::{DocumentError, Problem, escape};
use grouser::error::ParameterError;
use grouser::mission::MissionError;
use grouser::simulation::RunError;
use grouser::studies::calibration::CalibrationError;
use grouser_logs::{
    DriveFolderError, OptionNames, Problem as TelemetryProblem, Remedy, TelemetryError,
};
use grouser_raster::{Fault, RasterError};
use grouser_store::StoreError;
use pyo3::exceptions::{PyTypeError, PyUserWarning};
use pyo3::prelude::*;

/// The classes, where Python finds them.
mod classes {
    use pyo3::import_exception;

    import_exception!(grouser._errors, ParameterError);
    import_exception!(grouser._errors, DocumentError);
    import_exception!(grouser._errors, DocumentNotFoundError);
    import_exception!(grouser._errors, DocumentUnreadableError);
    import_exception!(grouser._errors, SimulationError);
    import_exception!(grouser._errors, CalibrationError);
    import_exception!(grouser._errors, CampaignError);
    import_exception!(grouser._errors, CampaignLockedError);
    import_exception!(grouser._errors, CampaignNotFoundError);
    import_exception!(grouser._errors, CampaignDiskError);
    import_exception!(grouser._errors, InternalError);
}

/// Computes, with a panic as an `InternalError`: the panics that PyO3 passes on are no `Exception`,
/// so that `except Exception` would not see them.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|why| of_panic(why.as_ref()))
}

pub(crate) fn of_panic(why: &(dyn Any + Send)) -> PyErr {
    let text = why.downcast_ref::<&str>().copied();
    let text = text.or_else(|| why.downcast_ref::<String>().map(String::as_str));
    classes::InternalError::new_err(format!(
        "a fault of grouser, please report it with what was called: {}",
        text.unwrap_or("a panic without a message")
    ))
}

/// The value in a document's problem.
struct Facts {
    key: Option<String>,
    value: Option<f64>,
    expected: Option<String>,
}

/// A document that cannot be used.
///
/// * `arguments`: the names of the caller's own arguments in messages; an error in those is a
///   `ParameterError`
pub(crate) fn of_document(error: &DocumentError, arguments: &[String]) -> PyErr {
    let place = error.place();
    let message = error.to_string();
    let Facts { key, value, expected } = facts(error.problem());
    match error.problem() {
        Problem::NoSuchPresetOrFile { .. } | Problem::NoSuchFile | Problem::NoSamples { .. } => {
            let hint = error.hint().map(str::to_owned);
            classes::DocumentNotFoundError::new_err((message, place.document.clone(), hint))
        }
        Problem::Folder | Problem::NotAFile(_) | Problem::Unreadable { .. } => {
            classes::DocumentUnreadableError::new_err((message, place.document.clone()))
        }
        _ if arguments.contains(&place.document) => {
            classes::ParameterError::new_err((message, key, value, expected))
        }
        _ => {
            let spot = place.spot.as_ref();
            let (line, column) = (spot.map(|spot| spot.line), spot.map(|spot| spot.column));
            let hint = error.hint().map(str::to_owned);
            let file = place.document.clone();
            classes::DocumentError::new_err((
                message, file, line, column, key, value, expected, hint,
            ))
        }
    }
}

fn facts(problem: &Problem) -> Facts {
    let (key, value, expected) = match problem {
        Problem::UnknownKey { key }
        | Problem::MissingKey { key }
        | Problem::RepeatedName { key, .. }
        | Problem::NotANumber { key, .. }
        | Problem::GoesWith { key, .. }
        | Problem::TooShort { key, .. }
        | Problem::NotUncertain { key } => (Some(key.clone()), None, None),
        Problem::WrongType { key, expected, .. } => {
            (Some(key.clone()), None, Some(expected.clone()))
        }
        Problem::NotFinite { key, value, range } => {
            (Some(key.clone()), Some(*value), Some(format!("finite{range}")))
        }
        Problem::OutOfRange { key, value, range } => {
            (Some(key.clone()), Some(*value), Some(range.clone()))
        }
        Problem::NotAllowed { key, allowed, .. } | Problem::WrongLength { key, allowed, .. } => {
            (Some(key.clone()), None, Some(allowed.clone()))
        }
        Problem::Unfit(error) => {
            (Some(error.name.clone()), Some(error.value), Some(error.expected.to_owned()))
        }
        _ => (None, None, None),
    };
    Facts { key, value, expected }
}

/// URDF that is no rover.
pub(crate) fn of_urdf(error: &UrdfError, file: &str) -> PyErr {
    let message = format!("{file}: {error}");
    let hint = message.split_once("\nhint: ").map(|(_, hint)| hint.to_owned());
    let none = None::<String>;
    let file = file.to_owned();
    classes::DocumentError::new_err((
        message,
        file,
        None::<usize>,
        None::<usize>,
        none.clone(),
        None::<f64>,
        none,
        hint,
    ))
}

/// A file that is not there, or cannot be read.
pub(crate) fn unread(error: &FileProblem, file: &str) -> PyErr {
    of_file(error, format!("{file}: {error}"), file.to_owned())
}

/// A file that is not there, or cannot be read, in the words of a message.
fn of_file(error: &FileProblem, message: String, file: String) -> PyErr {
    match error {
        FileProblem::NoSuchFile | FileProblem::BrokenLink { .. } => {
            classes::DocumentNotFoundError::new_err((message, file, None::<String>))
        }
        _ => classes::DocumentUnreadableError::new_err((message, file)),
    }
}

/// A file of heights or areas that cannot be used.
pub(crate) fn of_raster(error: &RasterError) -> PyErr {
    let (message, file) = (error.to_string(), error.file.display().to_string());
    match &error.fault {
        Fault::Disk(disk) if disk.kind() == ErrorKind::NotFound => {
            classes::DocumentNotFoundError::new_err((message, file, None::<String>))
        }
        Fault::Disk(_) => classes::DocumentUnreadableError::new_err((message, file)),
        _ => classes::DocumentError::new_err((message, file)),
    }
}

/// Raises a `UserWarning` at the line that called the package.
pub(crate) fn warn(py: Python<'_>, about: impl IntoIterator<Item = impl Display>) -> PyResult<()> {
    /// The frames of the package that such a call goes through.
    const FRAMES: i32 = 2;
    for text in about {
        // Texts of ours have no zero bytes, and names in them are shown without.
        let text = CString::new(text.to_string()).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, FRAMES)?;
    }
    Ok(())
}

/// A file of measurements that cannot be used.
pub(crate) fn of_measurements(error: &MeasurementError, file: &str) -> PyErr {
    let (message, file) = (error.to_string(), file.to_owned());
    match error.problem() {
        MeasurementProblem::NoSuchFile | MeasurementProblem::NoSuchDataSetOrFile => {
            classes::DocumentNotFoundError::new_err((message, file, None::<String>))
        }
        MeasurementProblem::Folder
        | MeasurementProblem::NotAFile(_)
        | MeasurementProblem::Unreadable(_) => {
            classes::DocumentUnreadableError::new_err((message, file))
        }
        problem => {
            let (key, value, expected) = match problem {
                MeasurementProblem::OutOfRange { column, value, least, most } => {
                    (Some(column.clone()), Some(*value), Some(format!("from {least} to {most}")))
                }
                MeasurementProblem::NotANumber { column, .. }
                | MeasurementProblem::MissingValue { column, .. } => {
                    (Some(column.clone()), None, Some("a number".to_owned()))
                }
                _ => (None, None, None),
            };
            let (line, column) = (error.line(), None::<u64>);
            classes::DocumentError::new_err((message, file, line, column, key, value, expected))
        }
    }
}

/// The arguments by which the package is asked.
const ARGUMENTS: OptionNames = OptionNames {
    mapping: "mapping=\"FILE.toml\" of import_telemetry",
    topic: |what, topic| format!("topics={{\"{what}\": \"{topic}\"}} of import_telemetry"),
    odometry: "odometry=KIND",
    budget: "a larger `max_unpacked_mib`",
    python: "import_telemetry(LOG, \"drive.csv\"), with the package rosbags",
};

/// Telemetry that cannot be read.
pub(crate) fn of_telemetry(error: &TelemetryError) -> PyErr {
    let hint = error.remedy().map(|it| format!("\nhint: {}", it.words(&ARGUMENTS)));
    let message = error.to_string() + &hint.unwrap_or_default();
    let file = error.label().to_owned();
    match error.problem() {
        TelemetryProblem::Table(error) => of_measurements(error, &file),
        TelemetryProblem::Document(error) => of_document(error, &[]),
        TelemetryProblem::File(error) => of_file(error, message, file),
        TelemetryProblem::Unreadable(_) => {
            classes::DocumentUnreadableError::new_err((message, file))
        }
        _ => {
            // Python's own half decodes these.
            let is_encoded = error.remedy() == Some(Remedy::Python);
            let key = is_encoded.then(|| "encoding".to_owned());
            let (place, value) = (None::<u64>, None::<f64>);
            let expected = None::<String>;
            classes::DocumentError::new_err((message, file, place, place, key, value, expected))
        }
    }
}

/// A folder of drives that cannot be read.
pub(crate) fn of_drives(error: DriveFolderError) -> PyErr {
    let message = error.to_string();
    match error {
        DriveFolderError::Log(error) => of_telemetry(&error),
        DriveFolderError::NoFolder(folder) => classes::DocumentNotFoundError::new_err((
            message,
            escape::path(&folder),
            None::<String>,
        )),
        DriveFolderError::Unreadable { folder, .. } => {
            classes::DocumentUnreadableError::new_err((message, escape::path(&folder)))
        }
        _ => parameter(message, "folder", None, "a folder with a log of each drive"),
    }
}

/// An invalid parameter.
pub(crate) fn of_parameter(error: &ParameterError) -> PyErr {
    parameter(error.to_string(), &error.name, Some(error.value), error.expected)
}

/// An invalid argument.
pub(crate) fn parameter(
    message: String,
    name: &str,
    value: Option<f64>,
    expected: impl Into<String>,
) -> PyErr {
    classes::ParameterError::new_err((message, name.to_owned(), value, expected.into()))
}

/// A number that is not in its range.
///
/// * `place`, `count`: which of how many it is
pub(crate) fn out_of_range(
    name: &str,
    value: f64,
    place: usize,
    count: usize,
    range: &RangeInclusive<f64>,
) -> PyErr {
    let expected = format!("from {} to {}", range.start(), range.end());
    let at = if count > 1 { format!(" (entry {place})") } else { String::new() };
    let message = format!("{name} is {value}{at}, it must be {expected}");
    parameter(message, name, Some(value), expected)
}

/// A sentence on a number that is not in its range.
pub(crate) fn outside(name: &str, value: f64, range: &RangeInclusive<f64>) -> String {
    format!("{name} is {value}, it must be from {} to {}", range.start(), range.end())
}

/// Numbers of an entry that do not go together.
pub(crate) fn misfit_at(place: usize, count: usize, problem: &Problem) -> PyErr {
    let at = if count > 1 { format!(" (entry {place})") } else { String::new() };
    match problem {
        Problem::Unfit(ParameterError { name, value, expected }) => {
            let message = format!("{name} is {value}{at}, it must be {expected}");
            parameter(message, name, Some(*value), *expected)
        }
        other => parameter(format!("{other}{at}"), "vary", None, "numbers that go together"),
    }
}

/// A run that cannot be computed.
pub(crate) fn of_simulation(error: &RunError) -> PyErr {
    match error {
        RunError::Parameter(error) => of_parameter(error),
        RunError::Reaction { time, .. }
        | RunError::Endless { time, .. }
        | RunError::Stalled { time, .. } => {
            classes::SimulationError::new_err((error.to_string(), *time))
        }
        RunError::HighCentred { .. } | RunError::UnbalancedStart { .. } => {
            classes::SimulationError::new_err((error.to_string(), 0.0))
        }
    }
}

/// A steady motion that was not found, at no time of a run.
pub(crate) fn not_found(reason: &str) -> PyErr {
    classes::SimulationError::new_err((reason.to_owned(), 0.0))
}

/// A mission that cannot be driven.
pub(crate) fn of_mission(error: &MissionError) -> PyErr {
    match error {
        MissionError::Plan(error) => {
            let ParameterError { name, value, expected } = &error.source;
            parameter(error.to_string(), name, Some(*value), *expected)
        }
        MissionError::Run(error) => of_simulation(error),
    }
}

/// A calibration that failed; keys that the measurements cannot determine are a `ParameterError`.
pub(crate) fn of_calibration(error: &CalibrationError) -> PyErr {
    let (message, expected) = (error.to_string(), "keys that the measurements can tell");
    match error {
        CalibrationError::Parameter(error) => of_parameter(error),
        CalibrationError::NoParameters | CalibrationError::TooFewObservations { .. } => {
            parameter(format!("fit: {message}"), "fit", None, expected)
        }
        CalibrationError::TooManyObservations { most, .. } => {
            parameter(message, "data", None, format!("at most {most} observations"))
        }
        CalibrationError::OneSlipAngle | CalibrationError::LeavingOut { .. } => {
            let message = format!("cross_validate: {message}");
            parameter(message, "cross_validate", None, "trials at several slip angles")
        }
        CalibrationError::OwnModel
        | CalibrationError::BadObservation { .. }
        | CalibrationError::NoStart { .. }
        | CalibrationError::Interrupted
        | CalibrationError::ForeignState { .. } => classes::CalibrationError::new_err(message),
    }
}

/// Wheel–soil models that cannot be ranked.
pub(crate) fn of_ranking(error: &RankingError) -> PyErr {
    let (message, none) = (error.to_string(), None::<String>);
    match error {
        RankingError::Document(error) => of_document(error, &[]),
        RankingError::Measurements(error) => of_measurements(error, error.file()),
        RankingError::Rover(error) => of_parameter(error),
        RankingError::NoSuchFolder(path) => {
            let file = path.display().to_string();
            classes::DocumentNotFoundError::new_err((message, file, none))
        }
        RankingError::Unreadable { folder, .. } => {
            classes::DocumentUnreadableError::new_err((message, folder.display().to_string()))
        }
        RankingError::NoSuchFile { file, .. } => {
            let file = file.display().to_string();
            classes::DocumentNotFoundError::new_err((message, file, none))
        }
        RankingError::NoDataSet { folder, .. } => {
            let hint = "docs/guide/data.md tells how a document describes a data set".to_owned();
            let file = folder.display().to_string();
            classes::DocumentNotFoundError::new_err((message, file, Some(hint)))
        }
    }
}

/// A campaign's folder that cannot be used, or a shard of it.
pub(crate) fn of_store(error: &StoreError) -> PyErr {
    let message = error.to_string();
    match error {
        StoreError::Disk { path, source, .. } => {
            let file = path.to_string_lossy().into_owned();
            classes::CampaignDiskError::new_err((message, source.raw_os_error(), file))
        }
        StoreError::Locked(path) => {
            classes::CampaignLockedError::new_err((message, path.to_string_lossy().into_owned()))
        }
        StoreError::NoCampaign(path) => {
            classes::CampaignNotFoundError::new_err((message, path.to_string_lossy().into_owned()))
        }
        StoreError::NoRun { run, runs } => {
            parameter(message, "run", Some(*run as f64), format!("below {runs}"))
        }
        StoreError::NoColumn(_) => parameter(message, "columns", None, "a column of the campaign"),
        _ => classes::CampaignError::new_err(message),
    }
}

/// A value of a type that documents do not have.
pub(crate) fn wrong_type(key: &str, found: &Bound<'_, PyAny>) -> PyErr {
    let kind = found.get_type().name().map_or_else(|_| "?".to_owned(), |name| name.to_string());
    PyTypeError::new_err(format!(
        "{key} is of type {kind}; documents hold numbers, texts, truth values, sequences, \
         mappings, paths and descriptions such as Soil"
    ))
}
