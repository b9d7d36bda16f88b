//! The source of measured rows: a data set that comes with the program, or a file.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use grouser_core::vehicle::Rover;

use super::super::check::nearest;
use super::super::escape;
use super::super::kind::Kind;
use super::super::presets::{preset, presets};
use super::error::{MeasurementError, MeasurementProblem as Problem};
use super::limits::Limits;
use super::slope_tests::{SlopeTests, read_slopes};
use super::{Choice, Measurements, read_bytes, read_from};

/// The source of the rows of measured wheel tests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A data set that comes with the program.
    Preset {
        /// The name that it is called by.
        name: &'static str,
        /// Its rows, as CSV.
        rows: &'static str,
    },
    /// A CSV file.
    File(PathBuf),
    /// A CSV text that is in no file.
    Text {
        /// What messages call it.
        label: String,
        /// The text.
        rows: String,
    },
}

impl Source {
    /// The data set of that name that comes with the program, or else the file at that path.
    ///
    /// A name with a slash or an extension is a path.
    ///
    /// # Errors
    /// [`MeasurementError`] if it is neither; a path that leads nowhere is noticed by
    /// [`read`](Self::read).
    pub fn find(name: &Path) -> Result<Self, MeasurementError> {
        let text = name.to_str();
        if let Some(source) = text.and_then(Self::preset) {
            return Ok(source);
        }
        match text {
            Some(word) if is_plain_word(word) && name.symlink_metadata().is_err() => {
                Err(no_such(word))
            }
            _ => Ok(Self::File(name.to_owned())),
        }
    }

    /// The data set of that name that comes with the program.
    #[must_use]
    pub fn preset(name: &str) -> Option<Self> {
        let preset = preset(Kind::DataSet, name)?;
        Some(Self::Preset { name: preset.name, rows: preset.rows? })
    }

    /// What messages call it.
    #[must_use]
    pub fn label(&self) -> String {
        match self {
            Self::Preset { name, .. } => format!("preset {name}"),
            Self::File(path) => escape::path(path),
            Self::Text { label, .. } => label.clone(),
        }
    }

    /// Reads the rows.
    ///
    /// # Errors
    /// [`MeasurementError`] with file and line for whatever is not as [`columns`](super::columns)
    /// says, and if no row is left.
    pub fn read(&self, choice: &Choice) -> Result<Measurements, MeasurementError> {
        read_from(&self.label(), &*self.bytes(choice.limits)?, choice)
    }

    /// Reads the rows of a rover on slopes.
    ///
    /// # Errors
    /// [`MeasurementError`] with file and line for whatever is not as
    /// [`slope_tests`](super::slope_tests) says, and if no row is left.
    pub fn read_slopes(
        &self,
        choice: &Choice,
        rover: &Rover,
    ) -> Result<SlopeTests, MeasurementError> {
        read_slopes(&self.label(), &self.bytes(choice.limits)?, choice, rover)
    }

    /// The bytes of the CSV, as [`read_bytes`] reads them from a file.
    ///
    /// # Errors
    /// [`MeasurementError`] for a file that cannot be read, or is too large.
    pub fn bytes(&self, limits: Limits) -> Result<Cow<'_, [u8]>, MeasurementError> {
        match self {
            Self::Preset { rows, .. } => Ok(Cow::Borrowed(rows.as_bytes())),
            Self::File(path) => read_bytes(path, limits).map(Cow::Owned),
            Self::Text { rows, .. } => Ok(Cow::Borrowed(rows.as_bytes())),
        }
    }
}

/// Whether a text looks like a name rather than a path.
fn is_plain_word(text: &str) -> bool {
    !text.is_empty() && !text.contains(['/', '\\', '.'])
}

fn no_such(word: &str) -> MeasurementError {
    let names: Vec<&str> = presets(Kind::DataSet).map(|preset| preset.name).collect();
    let hint = nearest(word, names.iter().copied()).map_or_else(
        || format!("the data sets that come with Grouser: {}", names.join(", ")),
        |meant| format!("did you mean `{meant}`?"),
    );
    MeasurementError::whole(&word.escape_debug().to_string(), Problem::NoSuchDataSetOrFile)
        .with_hint(hint)
}
