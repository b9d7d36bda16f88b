//! Why telemetry could not be read.

use std::fmt;
use std::io;

use grouser_io::file::FileProblem;
use grouser_io::measurements::MeasurementError;
use grouser_io::measurements::telemetry::Odometry;
use grouser_io::{DocumentError, escape};

pub use crate::mcap::read::OverBudget;
pub use crate::telemetry::other_kind::OtherKind;

/// Why telemetry could not be read: the file, and what is wrong with it.
#[derive(Debug)]
pub struct TelemetryError {
    /// What messages call the file.
    label: String,
    problem: Box<Problem>,
    hint: Option<String>,
}

/// What is wrong.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// What is no file, is not there, or may not be read.
    #[error("{0}")]
    File(FileProblem),
    /// The disk, or permission for it, failed.
    #[error("cannot be read: {0}")]
    Unreadable(io::Error),
    /// Its table cannot be understood.
    #[error("{}", .0.problem())]
    Table(MeasurementError),
    /// A document, such as a mapping, that cannot be used.
    #[error("{}", .0.problem())]
    Document(DocumentError),
    /// A mapping that does not fit the log.
    #[error("{0}")]
    Mapping(String),
    /// A mapping that reads none of a log's topics.
    #[error("the mapping '{mapping}' reads none of its topics, which are {}", listed(topics))]
    NothingMapped {
        /// The mapping's name.
        mapping: String,
        /// The topics, each with the type of its messages.
        topics: Vec<String>,
    },
    /// Several topics that a mapping could mean.
    #[error("several topics have what the mapping calls `{what}`: {}", topics.join(", "))]
    Ambiguous {
        /// The type of messages or the pattern of topics in the mapping.
        what: String,
        /// The topics that fit.
        topics: Vec<String>,
    },
    /// Ways of which nothing says how they were measured.
    #[error(
        "{topic} has the way of the rover, and neither {mapping} nor an option says what measured \
         it: odometry of wheels shows no slip, and would be taken for a soil on which there is none"
    )]
    OdometryNotStated {
        /// The topic.
        topic: String,
        /// What messages call the mapping.
        mapping: String,
    },
    /// Messages that are not decoded here.
    #[error(
        "messages of {topic} are encoded as {encoding}; JSON, Protocol Buffers, and those of ROS \
         with a schema in ros1msg or ros2msg are read here"
    )]
    Encoding {
        /// The topic.
        topic: String,
        /// Their encoding, as the log calls it.
        encoding: String,
    },
    /// A mapping that reads none of a table's columns.
    #[error(
        "the mapping '{mapping}' reads none of its columns, which are {}; it looks for {}",
        listed(columns),
        listed(sought)
    )]
    NoColumnMapped {
        /// The mapping's name.
        mapping: String,
        /// Fields that it looks for, each with its topic or type of messages.
        sought: Vec<String>,
        /// The columns.
        columns: Vec<String>,
        /// A built-in mapping that reads them, as .
        other: Option<String>,
    },
    /// A table that is read by a mapping, of whose columns none has the time.
    #[error("none of its columns is known as the time, and the mapping names none: {}", listed(.0))]
    NoTime(Vec<String>),
    /// A choice of topics without a mapping.
    #[error(
        "this is a table, which is read by the names of its columns; with a mapping, topics can be \
         chosen"
    )]
    NoMessages,
    /// A file of Parquet that is damaged, or written in a way that is not read.
    #[error("{0}")]
    Parquet(String),
    /// A log that unpacks to more than a log of its size may.
    #[error("{0}")]
    OverBudget(OverBudget),
    /// A log, or a table, of another kind.
    #[error("this is {}, which is not read here", .0.name())]
    OtherKind(OtherKind),
}

impl TelemetryError {
    pub(crate) fn new(label: &str, problem: Problem) -> Self {
        let hint = match &problem {
            Problem::NothingMapped { .. } => Some(
                "--mapping FILE.toml says which topics and fields are which columns".to_owned(),
            ),
            Problem::NoColumnMapped { other: Some(other), .. } => {
                Some(format!("the built-in {other} reads them"))
            }
            Problem::NoColumnMapped { .. } => Some(
                "a reading with `topic = \"/odom\"` and `field = \"pose.x\"` reads the column \
                 /odom/pose/x, one with `topic = \"/\"` and `field = \"x\"` the column x; --mapping \
                 FILE.toml has such readings"
                    .to_owned(),
            ),
            Problem::NoTime(_) => {
                Some("`time = \"t\"` in the mapping says that it is the column t".to_owned())
            }
            Problem::Ambiguous { what, topics } => topics
                .first()
                .map(|topic| format!("say which is meant, such as by --topic {what}={topic}")),
            Problem::OdometryNotStated { .. } => {
                let names = Odometry::ALL.map(|(name, ..)| name).join(", ");
                Some(format!(
                    "--odometry KIND, `odometry = \"KIND\"` in a mapping, or odometry=KIND in \
                     Python says it; KIND is one of {names}"
                ))
            }
            Problem::OtherKind(kind) if let Some(line) = kind.to_parquet() => {
                Some(format!("Parquet is read, and Python makes it: python -c \"{line}\""))
            }
            Problem::Encoding { .. } | Problem::OtherKind(_) => Some(
                "Python converts it: python -m grouser import-telemetry LOG --out drive.csv"
                    .to_owned(),
            ),
            Problem::OverBudget(_) => Some(
                "a larger `max_unpacked_mib` reads more, if it is meant so; or unpack it first, such as \
                 by `mcap decompress LOG -o UNPACKED`"
                    .to_owned(),
            ),
            _ => None,
        };
        Self { label: label.to_owned(), problem: Box::new(problem), hint }
    }

    /// What messages call the file.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }

    /// What is wrong.
    #[must_use]
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// Whether the disk or its permissions failed, rather than the file.
    #[must_use]
    pub fn is_environment(&self) -> bool {
        match &*self.problem {
            Problem::Unreadable(_) | Problem::File(FileProblem::Unreadable { .. }) => true,
            Problem::Table(error) => error.is_environment(),
            Problem::Document(error) => error.is_environment(),
            _ => false,
        }
    }
}

/// Topics as a sentence bears them.
fn listed(topics: &[String]) -> String {
    if topics.is_empty() { "none".to_owned() } else { topics.join(", ") }
}

impl From<FileProblem> for Problem {
    fn from(problem: FileProblem) -> Self {
        Self::File(problem)
    }
}

impl From<MeasurementError> for TelemetryError {
    fn from(error: MeasurementError) -> Self {
        Self::new(error.file(), Problem::Table(error.clone()))
    }
}

impl From<DocumentError> for TelemetryError {
    fn from(error: DocumentError) -> Self {
        Self::new(&error.place().document.clone(), Problem::Document(error))
    }
}

impl fmt::Display for TelemetryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// Characters of a problem or a hint: a log may have a thousand topics.
        const LONGEST: usize = 2000;
        // Errors of tables and documents have their lines and their own hints.
        match &*self.problem {
            Problem::Table(error) => return error.fmt(f),
            Problem::Document(error) => return error.fmt(f),
            _ => {}
        }
        let problem = escape::short_line(&self.problem.to_string(), LONGEST);
        write!(f, "{}: {problem}", escape::line(&self.label))?;
        match &self.hint {
            Some(hint) => write!(f, "\nhint: {}", escape::short_line(hint, LONGEST)),
            None => Ok(()),
        }
    }
}

impl std::error::Error for TelemetryError {}
