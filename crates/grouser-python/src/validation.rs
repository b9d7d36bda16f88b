//! Errors of a wheel–soil model against measured wheel tests.

use std::path::PathBuf;

use grouser::answers::Member;
use grouser::answers::validation::DriveValidationQuestion;
use grouser::document::columns::{fit, slope};
use grouser::document::measurements::{Choice, Condition, Limits, Measurements};
use grouser::document::ranking::{RankingError, rank_all};
use grouser::document::table::Table;
use grouser::document::validation::{GroupRecord, ReferenceRecord, SlopeErrorsRecord};
use grouser::studies::heading::HeadingStudy;
use grouser::studies::slope_validation::SlopeValidationStudy;
use grouser::studies::validation::{Validation, ValidationStudy};
use grouser_logs::DriveFolder;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::interrupt::listening;
use crate::measurements::Data;
use crate::telemetry::{Choices, HowRead, bytes, files, log_options, odometry_named};
use crate::wheels::{check_under, model_and_gravity};
use crate::{errors, values};

/// Predicts every trial of a file and compares the means of its cells with the measured ones.
///
/// * `wheel_label`: which rows of a file with several wheels; the program takes the wheel's name
#[pyfunction]
#[pyo3(signature = (data, soil, wheel, setting, wheel_label, conditions))]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn validate<'py>(
    py: Python<'py>,
    data: Data,
    soil: &Document,
    wheel: &Document,
    setting: &Document,
    wheel_label: Option<String>,
    conditions: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let conditions = conditions_of(&conditions)?;
    let choice = Choice { conditions, wheel: wheel_label, ..Choice::default() };
    let (model, gravity) = model_and_gravity(soil, setting)?;
    let (soil, wheel) = (soil.soil()?.value, wheel.wheel()?.value);
    check_under(&soil, &wheel, gravity)?;
    let file = data.label();
    let found = listening(py, move |_| {
        let measured = data.source()?.read(&choice)?;
        let study = ValidationStudy { tests: &measured.tests, wheel, soil, model, gravity };
        let validation = study.run();
        Ok((measured, validation))
    })?;
    let (measured, validation) = found.map_err(|error| errors::of_measurements(&error, &file))?;
    validation_to_python(py, &measured, &validation)
}

/// Which rows of a file count.
pub(crate) fn conditions_of(texts: &[String]) -> PyResult<Vec<Condition>> {
    let condition = |text: &String| {
        Condition::parse(text)
            .map_err(|why| errors::parameter(why, "where", None, "column=value or column!=value"))
    };
    texts.iter().map(condition).collect()
}

/// Errors by groups, cells and trials.
pub(crate) fn validation_to_python<'py>(
    py: Python<'py>,
    measured: &Measurements,
    validation: &Validation,
) -> PyResult<Bound<'py, PyDict>> {
    let group = |group: &_| record_to_python(py, &GroupRecord::from(group));
    let groups = validation.groups.iter().map(group);
    let dict = PyDict::new(py);
    dict.set_item("groups", PyList::new(py, groups.collect::<PyResult<Vec<_>>>()?)?)?;
    dict.set_item("overall", group(&validation.overall)?)?;
    dict.set_item("driven", validation.driven.as_ref().map(group).transpose()?)?;
    dict.set_item("skid", validation.skid.as_ref().map(group).transpose()?)?;
    let yardsticks: Vec<_> = validation.references.iter().map(ReferenceRecord::from).collect();
    dict.set_item("yardsticks", record_to_python(py, &yardsticks)?)?;
    dict.set_item("cells", table_to_python(py, fit::cells(&validation.cells))?)?;
    dict.set_item("trials", table_to_python(py, fit::trials(measured, validation))?)?;
    dict.set_item("notes", &measured.notes)?;
    Ok(dict)
}

/// Predicts every slope of a file for the rover, soil and model of a scenario.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn validate_slopes<'py>(
    py: Python<'py>,
    data: Data,
    scenario: &Document,
    conditions: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let conditions = conditions_of(&conditions)?;
    let choice = Choice { conditions, ..Choice::default() };
    let scenario = scenario.scenario()?.value.clone();
    let file = data.label();
    let found = listening(py, move |_| {
        let source = data.source().map_err(RankingError::from)?;
        let tests = source.read_slopes(&choice, &scenario.rover).map_err(RankingError::from)?;
        let heading = HeadingStudy::of(&scenario);
        let validation = SlopeValidationStudy { tests: &tests, heading: &heading }.run()?;
        Ok((tests.notes, validation))
    })?;
    let (notes, validation) = found.map_err(|error| match &error {
        RankingError::Measurements(error) => errors::of_measurements(error, &file),
        error => errors::of_ranking(error),
    })?;
    let yardsticks: Vec<_> = validation.references.iter().map(ReferenceRecord::from).collect();
    let dict = PyDict::new(py);
    dict.set_item("overall", record_to_python(py, &SlopeErrorsRecord::from(&validation))?)?;
    dict.set_item("yardsticks", record_to_python(py, &yardsticks)?)?;
    dict.set_item("slopes", table_to_python(py, slope::slopes(&validation.points))?)?;
    dict.set_item("notes", notes)?;
    Ok(dict)
}

/// Every wheel–soil model on every data set of a folder, or of the program: its `rows`, best first,
/// the `yardsticks`, and the `models` over all parts.
#[pyfunction]
#[pyo3(signature = (folder))]
pub(crate) fn validate_all(py: Python<'_>, folder: Option<PathBuf>) -> PyResult<Bound<'_, PyAny>> {
    let ranked = listening(py, move |_| rank_all(folder.as_deref(), Limits::default()))?;
    let ranked = ranked.map_err(|error| errors::of_ranking(&error))?;
    record_to_python(py, &ranked)
}

/// Every model on the drives of a folder: values, tables by their names, and what files gave.
///
/// * `scenario`: its rover, soil, gravity and load transfer are used, and its model, if it names one
/// * `mapping`: a file, or the name of a built-in one
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn validate_drives<'py>(
    py: Python<'py>,
    folder: PathBuf,
    scenario: &Document,
    mapping: Option<PathBuf>,
    choices: Choices,
    how: HowRead,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>, String)> {
    let scenario = scenario.scenario()?.clone();
    let odometry = odometry_named(how.0.as_deref())?;
    let options = log_options(mapping.as_deref(), choices, odometry);
    let options = options.map_err(|error| errors::of_telemetry(&error))?;
    let options = options.with_most_unpacked(bytes(how.1));
    let found = listening(py, move |_| {
        let read = DriveFolder::read(&folder, &scenario.value, &options);
        read.map(|DriveFolder { drives, given, notes, .. }| {
            let folder = folder.display().to_string();
            let given_files = files(&given);
            let question = DriveValidationQuestion { folder, scenario, drives, given, notes };
            (question.answer("validate"), given_files)
        })
    })?;
    let (answer, given) = found.map_err(errors::of_drives)?;
    let answer = answer.map_err(|error| {
        errors::parameter(error.to_string(), "folder", None, "drives with stretches to compare")
    })?;
    let (record, tables) = results_to_python(py, answer.results)?;
    Ok((record, tables, given))
}

/// Values and tables of an answer, each by its name.
pub(crate) fn results_to_python(
    py: Python<'_>,
    results: Vec<Member>,
) -> PyResult<(Bound<'_, PyAny>, Bound<'_, PyDict>)> {
    let (mut record, tables) = (Map::new(), PyDict::new(py));
    for member in results {
        match member {
            Member::Value(name, value) => drop(record.insert(name.to_owned(), value)),
            Member::Rows(name, rows) => {
                tables.set_item(name, table_to_python(py, Table::clone(&rows))?)?;
            }
            Member::Row(..) | Member::With(..) | Member::Entries(_) => {}
        }
    }
    Ok((record_to_python(py, &Value::Object(record))?, tables))
}

/// A record as a dictionary.
pub(crate) fn record_to_python<'py>(
    py: Python<'py>,
    record: &impl Serialize,
) -> PyResult<Bound<'py, PyAny>> {
    values::to_python(py, &serde_json::to_value(record).unwrap_or_default())
}
