//! Measured rows: files, tables of Python as texts, and other laboratories' files.

use std::path::PathBuf;

use grouser::document::escape;
use grouser::document::measurements::bevameter_sets::rows_of;
use grouser::document::measurements::{
    self, Choice, Imported, Layout, Limits, Mapping, MeasurementError, SlipDefinition, Source,
    import,
};
use pyo3::prelude::*;

use crate::errors;
use crate::interrupt::listening;

/// Measured rows as they come from Python.
#[derive(FromPyObject)]
pub(crate) enum Data {
    /// What messages call them, and a CSV text.
    Text((String, String)),
    /// A data set that comes with Grouser, or a file.
    Named(PathBuf),
}

impl Data {
    /// What errors call the file.
    pub(crate) fn label(&self) -> String {
        match self {
            Self::Text((label, _)) => label.clone(),
            Self::Named(path) => path.display().to_string(),
        }
    }

    /// The file's name without its folders.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Text((label, _)) => label.clone(),
            Self::Named(path) => {
                path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into())
            }
        }
    }

    /// Where the rows are read from.
    ///
    /// # Errors
    /// [`MeasurementError`] if a name is neither a data set nor a file.
    pub(crate) fn source(self) -> Result<Source, MeasurementError> {
        match self {
            Self::Text((label, rows)) => Ok(Source::Text { label, rows }),
            Self::Named(path) => Source::find(&path),
        }
    }

    /// The rows of a bevameter: of a table, of a set of Grouser by its name, or of a file.
    ///
    /// # Errors
    /// [`MeasurementError`] for a file that cannot be read.
    pub(crate) fn bevameter_rows(self, limits: Limits) -> Result<Vec<u8>, MeasurementError> {
        match self {
            Self::Text((_, rows)) => Ok(rows.into()),
            Self::Named(path) => Ok(rows_of(&path, limits)?.into_owned()),
        }
    }
}

/// Another laboratory's file as one of ours: its CSV, the columns that were not taken, and what was
/// noticed.
///
/// * `columns`: `ours=theirs:unit` each
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn import_wheel_tests(
    py: Python<'_>,
    file: PathBuf,
    columns: Vec<String>,
    delimiter: char,
    decimal_comma: bool,
    skip_lines: usize,
    slip_definition: &str,
) -> PyResult<(String, Vec<String>, Vec<String>)> {
    let delimiter = u8::try_from(delimiter).ok().filter(u8::is_ascii).ok_or_else(|| {
        let message = format!("delimiter is {delimiter:?}, it must be one ASCII character");
        errors::parameter(message, "delimiter", None, "one ASCII character")
    })?;
    let slip = match slip_definition {
        "larger" => SlipDefinition::Larger,
        "rim" => SlipDefinition::Rim,
        "hub" => SlipDefinition::Hub,
        other => {
            let message = format!("slip_definition is {other:?}, it must be larger, rim or hub");
            return Err(errors::parameter(message, "slip_definition", None, "larger, rim or hub"));
        }
    };
    let mapping = |text: &String| {
        Mapping::parse(text).map_err(|why| {
            errors::parameter(format!("columns: {why}"), "columns", None, "columns of measurements")
        })
    };
    let columns = columns.iter().map(mapping).collect::<PyResult<Vec<_>>>()?;
    let limits = Limits::default();
    let layout = Layout { delimiter, decimal_comma, skipped_lines: skip_lines, slip, limits };
    let label = escape::path(&file);
    let path = file.display().to_string();
    let read = move || {
        let bytes = measurements::read_bytes(&file, limits)?;
        let Imported { text, left_out } = import(&label, bytes.as_slice(), &columns, &layout)?;
        let label = format!("{label} as imported");
        // Numbers that are converted may have more digits, and so more bytes.
        let limits = Limits { rows: limits.rows.saturating_mul(4) };
        let choice = Choice { limits, ..Choice::default() };
        // Rows of several wheels are no fault here.
        let notes = match measurements::read_from(&label, text.as_bytes(), &choice) {
            Ok(measured) => measured.notes,
            Err(error) if error.is_of_several_wheels() => Vec::new(),
            Err(error) => return Err(error),
        };
        Ok((text, left_out, notes))
    };
    let found = listening(py, move |_| read())?;
    found.map_err(|error| errors::of_measurements(&error, &path))
}
