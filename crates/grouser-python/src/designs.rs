//! Designs: which numbers of a rover are the best.

use grouser::answers::design::DesignQuestion;
use grouser::answers::{AnswerError, AnswerOptions};
use grouser::document::design::Measure;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::validation::results_to_python;

/// What was found, without tables; the tables by their names; and the rover as TOML.
type FoundDesign<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>, String);

/// The design that has the least of its aim.
///
/// * `trade`: two measures that are traded for one another
#[pyfunction]
pub(crate) fn design<'py>(
    py: Python<'py>,
    design: &Document,
    is_nominal: bool,
    seed: u64,
    trade: Option<(String, String)>,
) -> PyResult<FoundDesign<'py>> {
    if trade.as_ref().is_some_and(|(one, other)| one == other) {
        let message = "trade takes two measures".to_owned();
        return Err(errors::parameter(message, "trade", None, "two different names"));
    }
    let trade = trade.map(|(one, other)| Ok::<_, PyErr>([measure(&one)?, measure(&other)?]));
    let question = DesignQuestion {
        task: design.design()?.clone(),
        is_nominal,
        seed,
        trade: trade.transpose()?,
        by_models: Vec::new(),
    };
    let found = listening(py, move |cancelled| {
        let go_on = || !cancelled.is_set();
        question.answer("design", &AnswerOptions { go_on: &go_on, ..AnswerOptions::ROWS })
    })?;
    let answer = found.map_err(|error| match error {
        AnswerError::Parameter(error) => errors::of_parameter(&error),
        other => errors::parameter(other.to_string(), "design", None, "a design within its limits"),
    })?;
    let (record, tables) = results_to_python(py, answer.results)?;
    let rover = answer.documents.iter().find(|it| it.file == "rover.toml");
    let rover = rover.map(|it| it.toml.clone()).unwrap_or_default();
    Ok((record, tables, rover))
}

fn measure(name: &str) -> PyResult<Measure> {
    Measure::named(name).ok_or_else(|| {
        let names = Measure::ALL.map(Measure::name).join(", ");
        errors::parameter(format!("there is no measure {name}"), "trade", None, &names)
    })
}
