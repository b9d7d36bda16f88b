//! Runs as moving pictures.

use std::path::PathBuf;

use grouser::mission::MissionError;
use grouser::simulation::Scenario;
use grouser_draw::{Animation, Form, Shown, VideoError, title_of};
use pyo3::exceptions::{PyFileNotFoundError, PyOSError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::missions::{self, Drive};
use crate::studies::run;

/// The runs of scenarios and missions, drawn beside each other in the form that the ending of a
/// name asks for.
///
/// * `sources`: a scenario, or a mission with the name of an alternative, empty where it has none
/// * `names`: of the runs
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn animation<'py>(
    py: Python<'py>,
    sources: Vec<(PyRef<'py, Document>, String)>,
    names: Vec<String>,
    path: PathBuf,
) -> PyResult<Bound<'py, PyBytes>> {
    let form = Form::of_path(&path).map_err(|error| {
        let message = format!("path is {}: {error}", path.display());
        errors::parameter(message, "path", None, "a name with a known ending")
    })?;
    let films = sources.iter().map(|(source, alternative)| film_of(source, alternative));
    let films = films.collect::<PyResult<Vec<_>>>()?;
    let is_on_plane = |(_, scenario, _): &(String, Scenario, Drive)| scenario.ground.is_plane();
    if films.iter().any(is_on_plane) && !films.iter().all(is_on_plane) {
        let message =
            "an animation shows runs on planes, or runs over ground with heights, not both";
        let expected = "runs on planes alone, or over ground with heights alone";
        return Err(errors::parameter(message.to_owned(), "beside", None, expected));
    }
    let title = films.first().map_or(String::new(), |(title, ..)| title.clone());
    let found = listening(py, move |_| {
        let runs = films.into_iter().map(|(_, scenario, drive)| Ok((drive()?, scenario)));
        let runs = runs.collect::<Result<Vec<_>, MissionError>>()?;
        let shown = names.iter().zip(&runs);
        let shown: Vec<Shown<'_>> =
            shown.map(|(name, (run, scenario))| Shown { name, run, scenario }).collect();
        Ok(Animation::of(&title, &shown).to_bytes(form, &mut || ()))
    })?;
    let bytes =
        found.map_err(|error| errors::of_mission(&error))?.map_err(|error| of_video(&error))?;
    Ok(PyBytes::new(py, &bytes))
}

/// The title of a scenario or a mission, its ground, and what drives it.
fn film_of(source: &Document, alternative: &str) -> PyResult<(String, Scenario, Drive)> {
    if let Ok(mission) = source.mission() {
        let drive = missions::drive(source, alternative)?;
        return Ok((title_of(mission), mission.value.scenario.clone(), drive));
    }
    let loaded = source.scenario()?;
    let scenario = loaded.value.clone();
    let drive: Drive = Box::new(move || Ok(run(&scenario)?));
    Ok((title_of(loaded), loaded.value.clone(), drive))
}

fn of_video(error: &VideoError) -> PyErr {
    match error {
        VideoError::NoProgram => PyFileNotFoundError::new_err(error.to_string()),
        VideoError::Failed(_) | VideoError::System(_) => PyOSError::new_err(error.to_string()),
    }
}
