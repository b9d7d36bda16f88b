//! Telemetry: logs that the library reads, and messages that Python decodes.

use std::fs::File;
use std::io::BufWriter;
use std::iter;
use std::path::{Path, PathBuf};

use grouser::document::escape;
use grouser::document::given_file::GivenFile;
use grouser::document::measurements::telemetry::{Odometry, TelemetryRecord};
use grouser::vehicle::Rover;
use grouser_logs::{
    LogOptions, Mapping, MessageRows, TelemetryError, TelemetryLog, TelemetryWriter, Topic,
};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;

/// Names of topics by the types of their messages.
pub(crate) type Choices = Vec<(String, String)>;

/// How a log is read: what measured ways and rotations, and the most that is unpacked [MiB], each if
/// it is stated.
pub(crate) type HowRead = (Option<String>, Option<u64>);

/// Converts a log that the library reads: how many records there are, what was noticed, and what its
/// files gave.
///
/// * `logs`: files of one drive
/// * `out`: the file that is written, Parquet by its suffix, or else CSV
/// * `mapping`: a file, or the name of a built-in one
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn import_telemetry(
    py: Python<'_>,
    logs: Vec<PathBuf>,
    out: PathBuf,
    rover: &Document,
    mapping: Option<PathBuf>,
    choices: Choices,
    how: HowRead,
) -> PyResult<(u64, Vec<String>, String)> {
    let rover = rover.scenario()?.value.rover.clone();
    let (odometry, budget) = (odometry_named(how.0.as_deref())?, bytes(how.1));
    let convert = move || -> Result<(u64, Vec<String>, String), Failed> {
        let options =
            log_options(mapping.as_deref(), choices, odometry)?.with_most_unpacked(budget);
        let mut log = TelemetryLog::open_all(&logs, &rover, &options)?;
        let mut table = Table::create(out, &rover)?;
        while let Some(record) = log.next_record()? {
            table.write(&record)?;
        }
        Ok((table.finish()?, log.notes(), files(&log.given())))
    };
    listening(py, move |_| convert())?.map_err(Failed::raised)
}

/// The most that is unpacked of a packed log [bytes], if it is stated.
pub(crate) fn bytes(mebibytes: Option<u64>) -> Option<u64> {
    mebibytes.map(|it| it << 20)
}

/// What files gave, as JSON has it.
pub(crate) fn files(given: &[GivenFile]) -> String {
    // What has numbers and texts alone can be written.
    serde_json::to_string(given).unwrap_or_default()
}

/// What measured ways and rotations, by its name.
pub(crate) fn odometry_named(name: Option<&str>) -> PyResult<Option<Odometry>> {
    let Some(name) = name else { return Ok(None) };
    let found = Odometry::named(name).ok_or_else(|| {
        let expected = Odometry::ALL.map(|(name, ..)| name).join(", ");
        let name = escape::line(name);
        let message = format!("odometry is '{name}', it must be one of {expected}");
        errors::parameter(message, "odometry", None, expected)
    });
    found.map(Some)
}

/// How a log is read.
///
/// * `mapping`: a file, or the name of a built-in one
pub(crate) fn log_options(
    mapping: Option<&Path>,
    choices: Choices,
    odometry: Option<Odometry>,
) -> Result<LogOptions, TelemetryError> {
    let mapping = mapping.map(Mapping::find).transpose()?;
    let options = LogOptions::default().with_mapping(mapping).with_odometry(odometry);
    Ok(options.with_topics(choices.into_iter().collect()))
}

/// What converting failed at.
enum Failed {
    Log(TelemetryError),
    Out(PathBuf, std::io::Error),
}

impl From<TelemetryError> for Failed {
    fn from(error: TelemetryError) -> Self {
        Self::Log(error)
    }
}

impl Failed {
    fn raised(self) -> PyErr {
        match self {
            Self::Log(error) => errors::of_telemetry(&error),
            Self::Out(path, error) => {
                PyOSError::new_err(format!("cannot write {}: {error}", escape::path(&path)))
            }
        }
    }
}

/// A table on its way into a file.
struct Table {
    path: PathBuf,
    writer: TelemetryWriter<BufWriter<File>>,
    records: u64,
}

impl Table {
    fn create(path: PathBuf, rover: &Rover) -> Result<Self, Failed> {
        let begun = File::create(&path)
            .and_then(|file| TelemetryWriter::begin(&path, BufWriter::new(file), rover));
        match begun {
            Ok(writer) => Ok(Self { path, writer, records: 0 }),
            Err(error) => Err(Failed::Out(path, error)),
        }
    }

    fn write(&mut self, record: &TelemetryRecord) -> Result<(), Failed> {
        self.records += 1;
        self.writer.write(record).map_err(|error| Failed::Out(self.path.clone(), error))
    }

    fn finish(self) -> Result<u64, Failed> {
        let Self { path, writer, records } = self;
        writer.finish().map(|_| records).map_err(|error| Failed::Out(path, error))
    }
}

/// Messages that Python decodes, on their way into a table.
#[pyclass(module = "grouser._core")]
pub(crate) struct TelemetryMessages {
    label: String,
    rows: MessageRows,
    table: Option<Table>,
}

#[pymethods]
impl TelemetryMessages {
    /// * `label`: what messages call the log
    /// * `topics`: names and types of messages of all topics
    #[new]
    #[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
    fn new(
        label: &str,
        out: PathBuf,
        rover: &Document,
        mapping: Option<PathBuf>,
        topics: Vec<(String, String)>,
        choices: Choices,
        odometry: Option<&str>,
    ) -> PyResult<Self> {
        let odometry = odometry_named(odometry)?;
        let rover = &rover.scenario()?.value.rover;
        let begin = || -> Result<Self, Failed> {
            let options = log_options(mapping.as_deref(), choices, odometry)?;
            let topic = |(name, message)| Topic { name, message, encoding: None };
            let topics: Vec<Topic> = topics.into_iter().map(topic).collect();
            let rows = MessageRows::new(label, &topics, rover, &options)?;
            let label = label.to_owned();
            Ok(Self { label, rows, table: Some(Table::create(out, rover)?) })
        };
        begin().map_err(Failed::raised)
    }

    /// Whether messages of a topic are read.
    fn wants(&self, topic: &str) -> bool {
        self.rows.wants(topic)
    }

    /// Adds a message.
    ///
    /// * `time_ns`: when it was recorded
    /// * `message`: its fields as JSON, where NaN is null
    fn add(&mut self, topic: &str, time_ns: i64, message: &str) -> PyResult<()> {
        let tree = serde_json::from_str(message)
            .map_err(|error| PyValueError::new_err(format!("no JSON: {error}")))?;
        errors::caught(|| self.rows.add(topic, time_ns, &tree))?;
        self.drain()
    }

    /// Counts a message that could not be decoded.
    fn damaged(&mut self) {
        self.rows.damaged_message();
    }

    /// Writes the rest: how many records there are, what was noticed, and what log and mapping gave.
    fn finish(&mut self) -> PyResult<(u64, Vec<String>, String)> {
        errors::caught(|| self.rows.end())?;
        self.drain()?;
        let records = match self.table.take() {
            Some(table) => table.finish().map_err(Failed::raised)?,
            None => 0,
        };
        let lost = self.rows.rows().lost().sentences();
        let odometry = self.rows.rows().sentence_of_odometry();
        let times = self.rows.rows().sentence_of_times();
        let notes =
            self.rows.notes().into_iter().chain(odometry).chain(lost).chain(times).collect();
        let log = self.rows.rows().given(&self.label);
        let given: Vec<GivenFile> =
            iter::once(log).chain(self.rows.given_mapping().cloned()).collect();
        Ok((records, notes, files(&given)))
    }
}

impl TelemetryMessages {
    fn drain(&mut self) -> PyResult<()> {
        let Some(table) = &mut self.table else { return Ok(()) };
        while let Some(record) = self.rows.next_record() {
            table.write(&record).map_err(Failed::raised)?;
        }
        Ok(())
    }
}
