//! Runs as moving pictures.

use std::path::PathBuf;

use grouser_pictures::{Animation, Form, Shown, VideoError, title_of};
use pyo3::exceptions::{PyFileNotFoundError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::studies::run;

/// The runs of scenarios, drawn beside each other in the form that the ending of a name asks for.
///
/// * `names`: of the runs
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn animation<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    names: Vec<String>,
    path: PathBuf,
) -> PyResult<Bound<'py, PyBytes>> {
    let form = Form::of_path(&path).map_err(|error| {
        let message = format!("path is {}: {error}", path.display());
        errors::parameter(message, "path", None, "a name with a known ending")
    })?;
    let loaded = scenarios.iter().map(|scenario| scenario.scenario());
    let loaded = loaded.collect::<PyResult<Vec<_>>>()?;
    let title = loaded.first().map_or(String::new(), |first| title_of(first));
    let scenarios: Vec<_> = loaded.iter().map(|one| one.value.clone()).collect();
    let found = listening(py, move |_| {
        let runs = scenarios.iter().map(run).collect::<Result<Vec<_>, _>>()?;
        let shown = names.iter().zip(&runs).zip(&scenarios);
        let shown: Vec<Shown<'_>> =
            shown.map(|((name, run), scenario)| Shown { name, run, scenario }).collect();
        Ok(Animation::of(&title, &shown).to_bytes(form, &mut || ()))
    })?;
    let bytes =
        found.map_err(|error| errors::of_simulation(&error))?.map_err(|error| of_video(&error))?;
    Ok(PyBytes::new(py, &bytes))
}

fn of_video(error: &VideoError) -> PyErr {
    match error {
        VideoError::NoProgram => PyFileNotFoundError::new_err(error.to_string()),
        VideoError::Failed(_) | VideoError::System(_) => PyOSError::new_err(error.to_string()),
    }
}
