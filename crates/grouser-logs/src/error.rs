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
}

/// What a caller may do about a [`Problem`]; [`words`](Self::words) has it in a sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy<'e> {
    /// A mapping that says which topics and fields are which columns.
    Mapping,
    /// A mapping of a table, whose columns are topics with fields.
    MappingOfTable,
    /// The built-in mapping that reads them, by what messages call it.
    BuiltInMapping(&'e str),
    /// A mapping whose `time` names the column.
    TimeOfMapping,
    /// A choice of what the mapping calls so, such as this topic.
    Topic(&'e str, &'e str),
    /// A statement of what measured the way, by an option or a mapping.
    Odometry,
    /// The package for Python decodes such a log.
    Python,
    /// This line of Python makes Parquet of a table `LOG`.
    Parquet(&'static str),
    /// More of the log may be unpacked.
    Budget,
}

/// What a program calls what its user may ask for, each as the subject of a sentence.
pub struct OptionNames {
    /// A mapping in a file.
    pub mapping: &'static str,
    /// A choice of a topic: of what the mapping calls it, and the topic.
    pub topic: fn(&str, &str) -> String,
    /// A statement of what measured the way, as `KIND`.
    pub odometry: &'static str,
    /// The most that is unpacked.
    pub budget: &'static str,
    /// How the package for Python converts a log.
    pub python: &'static str,
}

/// Characters of a problem or a remedy: a log may have a thousand topics.
const LONGEST: usize = 2000;

impl Remedy<'_> {
    /// A sentence without its full stop.
    #[must_use]
    pub fn words(self, names: &OptionNames) -> String {
        let OptionNames { mapping, odometry, budget, python, .. } = names;
        let words = match self {
            Self::Mapping => format!("{mapping} says which topics and fields are which columns"),
            Self::MappingOfTable => format!(
                "a reading with `topic = \"/odom\"` and `field = \"pose.x\"` reads the column \
                 /odom/pose/x, one with `topic = \"/\"` and `field = \"x\"` the column x; {mapping} \
                 has such readings"
            ),
            Self::BuiltInMapping(name) => format!("the built-in {name} reads them"),
            Self::TimeOfMapping => {
                "`time = \"t\"` in the mapping says that it is the column t".to_owned()
            }
            Self::Topic(what, topic) => {
                format!("say which is meant, such as by {}", (names.topic)(what, topic))
            }
            Self::Odometry => {
                let kinds = Odometry::ALL.map(|(name, ..)| name).join(", ");
                format!(
                    "{odometry}, or `odometry = \"KIND\"` in a mapping, says it; KIND is one of {kinds}"
                )
            }
            Self::Python => format!("Python converts it: {python}"),
            Self::Parquet(line) => {
                format!("Parquet is read, and Python makes it: python -c \"{line}\"")
            }
            Self::Budget => format!(
                "{budget} reads more, if it is meant so; or unpack it first, such as by `mcap \
                 decompress LOG -o UNPACKED`"
            ),
        };
        escape::short_line(&words, LONGEST)
    }
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
        /// A built-in mapping that reads them, as messages call it.
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
    /// A file of Parquet or Arrow that is damaged, or written in a way that is not read.
    #[error("{0}")]
    Damaged(String),
    /// A log that unpacks to more than a log of its size may.
    #[error("{0}")]
    OverBudget(OverBudget),
    /// A folder without a log.
    #[error("this is a folder in which no file's name ends with .mcap")]
    NoLogInFolder,
    /// One of several that is a pipe, say.
    #[error("is no file, but a pipe, say: several files are looked into before they are read")]
    NotAmongSeveral,
    /// One of several files, of which no row can be used.
    #[error("has no rows of telemetry")]
    NoRows,
    /// A file of a drive that goes on when the next has begun.
    #[error(
        "goes on to {ends} s, and {next} begins at {begins} s: files of one drive follow one \
         another, by one clock"
    )]
    Overlap {
        /// The next file.
        next: String,
        /// A time of this file [s] that is not before the start of the next.
        ends: f64,
        /// The first time of the next [s].
        begins: f64,
    },
    /// A log, or a table, of another kind.
    #[error("this is {}, which is not read here", .0.name)]
    OtherKind(OtherKind),
}

impl TelemetryError {
    pub(crate) fn new(label: &str, problem: Problem) -> Self {
        Self { label: label.to_owned(), problem: Box::new(problem) }
    }

    /// Why reading failed: the disk, a budget that was over, or what the file has.
    pub(crate) fn of_reading(label: &str, error: io::Error) -> Self {
        let over = error.get_ref().and_then(|it| it.downcast_ref::<OverBudget>()).copied();
        let problem = match (over, error.kind()) {
            (Some(over), _) => Problem::OverBudget(over),
            (None, io::ErrorKind::InvalidData) => Problem::Damaged(error.to_string()),
            (None, _) => Problem::Unreadable(error),
        };
        Self::new(label, problem)
    }

    /// What the caller may do about it, if anything.
    #[must_use]
    pub fn remedy(&self) -> Option<Remedy<'_>> {
        Some(match &*self.problem {
            Problem::NothingMapped { .. } => Remedy::Mapping,
            Problem::NoColumnMapped { other: Some(other), .. } => Remedy::BuiltInMapping(other),
            Problem::NoColumnMapped { .. } => Remedy::MappingOfTable,
            Problem::NoTime(_) => Remedy::TimeOfMapping,
            Problem::Ambiguous { what, topics } => Remedy::Topic(what, topics.first()?),
            Problem::OdometryNotStated { .. } => Remedy::Odometry,
            Problem::OtherKind(kind) => kind.to_parquet.map_or(Remedy::Python, Remedy::Parquet),
            Problem::Encoding { .. } => Remedy::Python,
            Problem::OverBudget(_) => Remedy::Budget,
            _ => return None,
        })
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
        // Errors of tables and documents have their lines and their own hints.
        match &*self.problem {
            Problem::Table(error) => return error.fmt(f),
            Problem::Document(error) => return error.fmt(f),
            _ => {}
        }
        let problem = escape::short_line(&self.problem.to_string(), LONGEST);
        write!(f, "{}: {problem}", escape::line(&self.label))
    }
}

impl std::error::Error for TelemetryError {}
