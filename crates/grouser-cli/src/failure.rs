//! Failures of the program: a message for people, an exit code for scripts.

use std::path::Path;

use grouser::document::escape;

use crate::interrupt;

/// A command failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The command line or a document is wrong: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// The same, reported already by the parser of the command line.
    #[error("the command line is wrong")]
    UsageReported,
    /// A computation failed: exit code 1.
    #[error("{0}")]
    Run(String),
    /// The disk, its permissions or the terminal failed: exit code 1.
    #[error("{what}: {source}")]
    Environment {
        /// The failed operation, with the file or folder.
        what: String,
        /// The system's error.
        source: std::io::Error,
    },
    /// Some of many runs failed; all else is done: exit code 3.
    #[error("{0}")]
    Partly(String),
    /// Ctrl-C, and all is in its place: exit code 130.
    #[error("{0}")]
    Interrupted(String),
    /// A child process did the work, reported its failure, and ended with this exit code.
    #[error("the program that did the work failed")]
    ReportedByChild(u8),
    /// The reader of our output has gone: no message, exit code 0.
    #[error("the reader of the output has gone")]
    ReaderGone,
}

impl Failure {
    /// The exit code.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Self::ReaderGone => 0,
            Self::Run(_) | Self::Environment { .. } => 1,
            Self::Usage(_) | Self::UsageReported => 2,
            Self::Partly(_) => 3,
            Self::Interrupted(_) => interrupt::INTERRUPTED,
            Self::ReportedByChild(code) => *code,
        }
    }

    /// How its message begins.
    pub(crate) fn label(&self) -> &'static str {
        match self {
            Self::Interrupted(_) => "interrupted",
            Self::Partly(_) => "note",
            _ => "error",
        }
    }

    /// Whether a message must still be printed.
    pub(crate) fn needs_message(&self) -> bool {
        !matches!(self, Self::ReaderGone | Self::UsageReported | Self::ReportedByChild(_))
    }

    /// A failed operation on a file or folder, such as `cannot write`.
    pub(crate) fn at<'a>(
        operation: &'a str,
        path: &'a Path,
    ) -> impl FnOnce(std::io::Error) -> Self + 'a {
        move |error| Self::Environment {
            what: format!("{operation} {}", escape::path(path)),
            source: without_path(error),
        }
    }
}

/// The system's own words: `tempfile` adds a random path to them.
fn without_path(error: std::io::Error) -> std::io::Error {
    match error.to_string().split_once(" at path ") {
        Some((words, _)) => std::io::Error::new(error.kind(), words),
        None => error,
    }
}

/// Messages on one line each, under one `error:`.
impl From<grouser::simulation::RunError> for Failure {
    fn from(error: grouser::simulation::RunError) -> Self {
        use grouser::simulation::RunError;
        match error {
            RunError::Parameter(parameter) => parameter.into(),
            error => Self::Run(escape::line(&error.to_string()).into_owned()),
        }
    }
}

/// An invalid plan is found when it is read: the failures that are left are those of the motion.
impl From<grouser::mission::MissionError> for Failure {
    fn from(error: grouser::mission::MissionError) -> Self {
        use grouser::mission::MissionError;
        match error {
            MissionError::Plan(error) => Self::Usage(error.to_string()),
            MissionError::Run(error) => error.into(),
        }
    }
}

impl From<grouser::document::validity::OutsideDomain> for Failure {
    fn from(error: grouser::document::validity::OutsideDomain) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<grouser::error::ParameterError> for Failure {
    fn from(error: grouser::error::ParameterError) -> Self {
        Self::Usage(escape::line(&error.to_string()).into_owned())
    }
}
