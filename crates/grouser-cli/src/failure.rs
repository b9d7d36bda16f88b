//! How the program fails: a message for the person, an exit code for the script.

use std::path::{Path, PathBuf};

/// Why a command did not do what it was asked to.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// The command line or a document is wrong: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// A computation failed: exit code 1.
    #[error("{0}")]
    Run(String),
    /// The disk, its permissions or the terminal failed: exit code 1.
    #[error("{path}: {source}", path = .path.display())]
    Environment {
        /// The file or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
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
            Self::Usage(_) => 2,
        }
    }

    /// A failed operation on a file or folder.
    pub(crate) fn at(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |source| Self::Environment { path: path.to_owned(), source }
    }
}

/// Messages on one line each, under one `error:`.
impl From<grouser::simulation::SimulationError> for Failure {
    fn from(error: grouser::simulation::SimulationError) -> Self {
        use grouser::simulation::SimulationError;
        match error {
            SimulationError::Parameter(parameter) => Self::Usage(parameter.to_string()),
            error => Self::Run(error.to_string()),
        }
    }
}

impl From<grouser::error::ParameterError> for Failure {
    fn from(error: grouser::error::ParameterError) -> Self {
        Self::Usage(error.to_string())
    }
}
