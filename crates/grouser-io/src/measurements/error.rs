//! Errors of measurement files.

use std::fmt;
use std::io;

use super::super::escape;
use super::super::file::FileProblem;
use super::super::tree::number;
use super::limits::Excess;

/// Characters of a cell that a message quotes.
pub(crate) const QUOTED: usize = 60;

/// A measurement file that cannot be used: where, what, and how it may be mended.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasurementError {
    // Boxed, so that a result is not mostly room for an error.
    file: Box<str>,
    line: Option<u64>,
    problem: MeasurementProblem,
    hint: Option<Box<str>>,
    /// Where a document names the file.
    named_at: Option<Box<str>>,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeasurementProblem {
    /// A path that leads nowhere.
    #[error("there is no such file")]
    NoSuchFile,
    /// A word that is neither a data set of the program nor a file.
    #[error("there is no such data set and no such file")]
    NoSuchDataSetOrFile,
    /// A folder where a file should be.
    #[error("this is a folder, not a file")]
    Folder,
    /// A link without a file, a device, a pipe with a name.
    #[error("{0}")]
    NotAFile(FileProblem),
    /// The disk, or permission for it, failed.
    #[error("cannot be read: {0}")]
    Unreadable(String),
    /// What is packed in it is damaged.
    #[error("{0}")]
    Damaged(String),
    /// More than is read.
    #[error("{0}")]
    TooLarge(Excess),
    /// Not a table.
    #[error("not CSV: {0}")]
    NotCsv(String),
    /// Nothing at all.
    #[error("has no header: the first line names the columns")]
    NoHeader,
    /// Nothing but a header.
    #[error("has no rows below its header")]
    NoRows,
    /// Nothing that is wanted.
    #[error("has no row that meets the conditions: {conditions}")]
    NoRowMeets {
        /// The conditions, as they were written.
        conditions: String,
    },
    /// Nothing that was run well.
    #[error("has no row whose `status` is `ok`; the first says: {first}")]
    NoRowOk {
        /// The first row's status.
        first: String,
    },
    /// Rows of runs in time.
    #[error(
        "`{column}` says that rows are samples of runs in time, and here each row is a trial: \
         start-up would be in the means, and noise be taken for repeatability"
    )]
    TimeSeries {
        /// The column of the time.
        column: String,
    },
    /// Rows, but nothing that was read in them.
    #[error("has no reading: every cell of drawbar pull, side force, sinkage and torque is empty")]
    NoReadings,
    /// Rows of a rover on slopes, but nothing that was read in them.
    #[error("has no reading: every cell of slip ratio and yaw is empty")]
    NoSlopeReadings,
    /// A slip that the rover's wheels convert each in its own way.
    #[error("`{column}` cannot be converted: the rover's wheels differ in their grousers")]
    WheelsDiffer {
        /// The column.
        column: &'static str,
    },
    /// A unit below the name of a column that the column cannot have.
    #[error("`{column}` has {unit} below its name, which must be one of {}", known.join(", "))]
    UnknownUnit {
        /// The column.
        column: Box<str>,
        /// What stands below it.
        unit: Box<str>,
        /// The units that may.
        known: Box<[&'static str]>,
    },
    /// A wheel that the rover does not have.
    #[error("`{name}` is no wheel of the rover: its wheels are {}", wheels.join(", "))]
    UnknownWheel {
        /// What the file calls it.
        name: String,
        /// The names of the rover's wheels.
        wheels: Vec<String>,
    },
    /// A current of a wheel whose motor is not known.
    #[error("`{0}` has a current, but no motor in the rover's document")]
    WheelWithoutMotor(String),
    /// A wheel that has two rows for one time.
    #[error("`{wheel}` has two rows for one time")]
    RepeatedReading {
        /// Its name.
        wheel: String,
    },
    /// A log without a single reading of a motor.
    #[error("has no reading: no row has both a current and a wheel speed")]
    NoMotorReadings,
    /// Two columns of one name.
    #[error("the column `{0}` is there twice")]
    RepeatedColumn(String),
    /// Two columns with the same meaning.
    #[error("the columns `{0}` and `{1}` have the same meaning")]
    CompetingColumns(String, String),
    /// A column that must be there.
    #[error("{what} is missing: no column {expected}")]
    MissingColumn {
        /// What cannot be known without it.
        what: &'static str,
        /// The names it may have.
        expected: String,
    },
    /// A log of which nothing but the time is known.
    #[error(
        "has a time and no other column of telemetry: its columns are {}; telemetry has {}",
        there.join(", "), sought.join(", ")
    )]
    NoKnownColumn {
        /// The names of its columns.
        there: Vec<String>,
        /// The names of columns of telemetry; of a wheel's without the wheel's.
        sought: Vec<&'static str>,
    },
    /// A file for import of which nothing is known.
    #[error("none of its columns is called as ours, and no mapping names one")]
    NothingToImport,
    /// A condition on a column that is not there.
    #[error("there is no column `{0}`")]
    NoSuchColumn(String),
    /// The header in the middle of the rows.
    #[error("the header stands here again: two files pasted together?")]
    RepeatedHeader,
    /// A value that is no number.
    #[error("`{column}` is '{value}', it must be a number")]
    NotANumber {
        /// Its column.
        column: String,
        /// What stands there.
        value: String,
    },
    /// A time that is written as another clock has it.
    #[error("`{column}` is '{text}', a date or a time of day that is not written in ISO 8601")]
    OtherDate {
        /// The column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// A value that must be there.
    #[error("`{column}` has no value: {why}")]
    MissingValue {
        /// Its column.
        column: String,
        /// Why it is needed.
        why: &'static str,
    },
    /// A number outside its range.
    #[error("`{column}` is {}, it must be from {} to \
             {}", number(*.value), number(*.least), number(*.most))]
    OutOfRange {
        /// Its column.
        column: String,
        /// The number.
        value: f64,
        /// The least it may be.
        least: f64,
        /// The most it may be.
        most: f64,
    },
    /// A slip that the speeds contradict.
    #[error("`{column}` is {}, the speeds make it {:.4}", number(*.value), .of_speeds)]
    SlipAgainstSpeeds {
        /// The slip's column.
        column: String,
        /// The slip that is written.
        value: f64,
        /// The slip of the speeds.
        of_speeds: f64,
    },
    /// Two loads in one row.
    #[error("`{column}` is {}, `{other}` is {}", number(*.value), number(*.other_value))]
    LoadsDiffer {
        /// The first column.
        column: &'static str,
        /// Its value.
        value: f64,
        /// The second column.
        other: &'static str,
        /// Its value.
        other_value: f64,
    },
    /// Rows of several wheels, without a choice.
    #[error("has rows of several wheels: {}", labels.join(", "))]
    SeveralWheels {
        /// Their names in the file.
        labels: Vec<String>,
    },
}

impl From<FileProblem> for MeasurementProblem {
    fn from(problem: FileProblem) -> Self {
        match problem {
            FileProblem::NoSuchFile => Self::NoSuchFile,
            FileProblem::Folder => Self::Folder,
            FileProblem::TooLarge { limit } => Self::TooLarge(Excess::Bytes { most: limit }),
            FileProblem::Unreadable { message, .. } => Self::Unreadable(message),
            FileProblem::BrokenLink { .. }
            | FileProblem::NotAFile { .. }
            | FileProblem::Outside => Self::NotAFile(problem),
        }
    }
}

impl MeasurementError {
    /// An error that concerns a file as a whole.
    pub fn whole(file: &str, problem: MeasurementProblem) -> Self {
        let hint: Option<String> = match &problem {
            MeasurementProblem::SeveralWheels { labels } => labels.first().map(|label| {
                format!("choose by the condition wheel={label}, or a wheel whose name ends so")
            }),
            _ => None,
        };
        let hint = hint.map(String::into_boxed_str);
        Self { file: file.into(), line: None, problem, hint, named_at: None }
    }

    /// An error in a line of a file.
    #[must_use]
    pub fn at(file: &str, line: u64, problem: MeasurementProblem) -> Self {
        Self { line: Some(line), ..Self::whole(file, problem) }
    }

    /// The same with a hint.
    #[must_use]
    pub fn with_hint(mut self, hint: impl Into<Option<String>>) -> Self {
        self.hint = hint.into().map(String::into_boxed_str);
        self
    }

    /// The same, of a file that a document names.
    ///
    /// * `place`: where it does
    #[must_use]
    pub fn named_at(mut self, place: String) -> Self {
        self.named_at = Some(place.into_boxed_str());
        self
    }

    /// A failure while reading.
    ///
    /// * `line`: where it was, for limits of a single row
    pub(crate) fn io(file: &str, error: &io::Error, line: u64) -> Self {
        match error.get_ref().and_then(|error| error.downcast_ref::<Excess>()) {
            Some(excess @ Excess::Bytes { .. }) => {
                Self::whole(file, MeasurementProblem::TooLarge(*excess))
            }
            Some(excess) => Self::at(file, line, MeasurementProblem::TooLarge(*excess)),
            None if error.kind() == io::ErrorKind::InvalidData => {
                Self::whole(file, MeasurementProblem::Damaged(error.to_string()))
            }
            None => Self::whole(file, MeasurementProblem::Unreadable(error.to_string())),
        }
    }

    /// A failure while reading a table.
    ///
    /// * `at`: the line that was being read
    pub fn csv(file: &str, error: &csv::Error, at: u64) -> Self {
        let line = error.position().map(csv::Position::line);
        let problem = match error.kind() {
            csv::ErrorKind::Io(error) => return Self::io(file, error, at),
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => MeasurementProblem::NotCsv(
                format!("the fields of this line are {len}, those of the header {expected_len}"),
            ),
            csv::ErrorKind::Utf8 { .. } => {
                MeasurementProblem::NotCsv("this line is not UTF-8 text".to_owned())
            }
            _ => MeasurementProblem::NotCsv(error.to_string()),
        };
        let hint = match error.kind() {
            csv::ErrorKind::Utf8 { .. } => {
                Some("a spreadsheet can save its table as CSV in UTF-8".to_owned())
            }
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } if len < expected_len => {
                Some("is a quotation mark left open, or a field missing?".to_owned())
            }
            _ => None,
        };
        Self { line, ..Self::whole(file, problem) }.with_hint(hint)
    }

    /// What messages call the file.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The line where the trouble is, if it is in one.
    #[must_use]
    pub fn line(&self) -> Option<u64> {
        self.line
    }

    /// What it is.
    #[must_use]
    pub fn problem(&self) -> &MeasurementProblem {
        &self.problem
    }

    /// Whether the file is fine, but has rows of several wheels.
    #[must_use]
    pub fn is_of_several_wheels(&self) -> bool {
        matches!(self.problem, MeasurementProblem::SeveralWheels { .. })
    }

    /// Whether the disk or its permissions failed, rather than the file.
    #[must_use]
    pub fn is_environment(&self) -> bool {
        matches!(self.problem, MeasurementProblem::Unreadable(_))
    }
}

/// Characters of a problem or a hint: a header may have a thousand columns.
const LONGEST_MESSAGE: usize = 2000;

impl fmt::Display for MeasurementError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&escape::line(&self.file))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        write!(f, ": {}", escape::short_line(&self.problem.to_string(), LONGEST_MESSAGE))?;
        if let Some(place) = &self.named_at {
            write!(f, "\nthe file is named by {}", escape::line(place))?;
        }
        match &self.hint {
            Some(hint) => write!(f, "\nhint: {}", escape::short_line(hint, LONGEST_MESSAGE)),
            None => Ok(()),
        }
    }
}

impl std::error::Error for MeasurementError {}
