//! Results as columns: an array for each column of the library's.

use grouser::contact::Settled;
use grouser::document::columns::Column;
use grouser::document::columns::heading::{BAND, BAND_LIMIT, held};
use grouser::document::columns::mission::{LEG, MISSION};
use grouser::document::columns::route::PROFILE;
use grouser::document::columns::run::{
    RECORD, RUN_BAND, STANDING, STANDING_BAND, TIME_BAND, WHEEL_RECORD,
};
use grouser::document::columns::stand::TRIALS;
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{wheel_speeds, wheel_test};
use grouser::document::table::{BETWEEN_NAMES, ColumnKind, Table, Values};
use grouser::document::{self, Unit};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::{Map, Value};

/// Names of a wheel's results.
pub(crate) fn wheel_names() -> impl Iterator<Item = &'static str> {
    WHEEL.iter().map(|column| column.name)
}

/// A wheel's results in the order of [`WHEEL`].
pub(crate) fn wheel_row(settled: &Settled) -> [f64; WHEEL.len()] {
    WHEEL.each_ref().map(|column| column.number(settled))
}

/// The same for a wheel without results: NaN.
pub(crate) const NO_WHEEL: [f64; WHEEL.len()] = [f64::NAN; WHEEL.len()];

/// The unit that a name ends with, by the library's table; `None` for a ratio, a count or a text.
#[pyfunction]
pub(crate) fn unit_of(name: &str) -> Option<&'static str> {
    document::unit_of(name).map(|unit| unit.symbol)
}

/// Name, unit and what it is.
type Declared = (String, Option<&'static str>, &'static str);

/// The library's columns of numbers by what they are of: a name, its unit if it has one, and what
/// it is.
#[pyfunction]
pub(crate) fn result_columns(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("wheel", declared(&WHEEL))?;
    dict.set_item("wheel_sample", declared(&WHEEL_RECORD))?;
    dict.set_item("sample", declared(&RECORD))?;
    dict.set_item("standing", declared(&STANDING))?;
    dict.set_item("heading", declared(&held()))?;
    dict.set_item("heading_band", declared(&BAND))?;
    dict.set_item("heading_band_limit", declared(&BAND_LIMIT))?;
    dict.set_item("wheel_speeds", declared(&wheel_speeds::results()))?;
    dict.set_item("wheel_speeds_of_wheel", declared(&wheel_speeds::SPEED_RATIO))?;
    dict.set_item("wheel_test_band", declared(&wheel_test::BAND))?;
    dict.set_item("traverse_band", declared(&RUN_BAND))?;
    dict.set_item("traverse_band_over_time", declared(&TIME_BAND))?;
    dict.set_item("traverse_band_standing", declared(&STANDING_BAND))?;
    dict.set_item("mission", declared(&MISSION))?;
    dict.set_item("leg", declared(&LEG))?;
    dict.set_item("profile", declared(&PROFILE))?;
    dict.set_item("stand", declared(&TRIALS))?;
    Ok(dict)
}

fn declared<R>(columns: &[Column<R>]) -> Vec<Declared> {
    let unit = |name: &str| document::unit_of(name).map(|unit: Unit| unit.symbol);
    let numbers = columns
        .iter()
        .filter(|column| !matches!(column.kind(), ColumnKind::Text | ColumnKind::Words));
    let each = |column: &Column<R>| {
        let doc = column.doc;
        column.names().into_iter().map(move |name| (name.clone(), unit(&name), doc))
    };
    numbers.flat_map(each).collect()
}

/// A table as a dictionary of columns: numbers and counts as arrays, with NaN where there is none;
/// texts as lists, with `None`; lists of names as texts, joined by `;`.
pub(crate) fn table_to_python(py: Python<'_>, table: Table) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    for (name, values) in table.columns {
        match values {
            Values::Float(values) => {
                let values = values.into_iter().map(|value| value.unwrap_or(f64::NAN));
                dict.set_item(name, PyArray1::from_iter(py, values))?;
            }
            Values::Whole(values) => {
                let float = |count: Option<u64>| count.map_or(f64::NAN, |count| count as f64);
                dict.set_item(name, PyArray1::from_iter(py, values.into_iter().map(float)))?;
            }
            Values::Text(values) => dict.set_item(name, PyList::new(py, values)?)?,
            Values::Words(values) => {
                let texts = values.iter().map(|names| names.join(BETWEEN_NAMES));
                dict.set_item(name, PyList::new(py, texts.collect::<Vec<_>>())?)?;
            }
        }
    }
    Ok(dict)
}

/// A dictionary of columns: numbers as arrays, with NaN where there is none; texts as lists, with
/// `None`.
pub(crate) fn columns<'py, T: Serialize>(
    py: Python<'py>,
    records: &[T],
) -> PyResult<Bound<'py, PyDict>> {
    let rows: Vec<Map<String, Value>> = records.iter().map(object).collect();
    let dict = PyDict::new(py);
    let Some(first) = rows.first() else { return Ok(dict) };
    for key in first.keys() {
        let cells: Vec<&Value> =
            rows.iter().map(|row| row.get(key).unwrap_or(&Value::Null)).collect();
        let is_text = cells.iter().any(|cell| cell.is_string());
        if is_text {
            let texts: Vec<Option<&str>> = cells.iter().map(|cell| cell.as_str()).collect();
            dict.set_item(key, PyList::new(py, texts)?)?;
        } else {
            let numbers = cells.iter().map(|cell| cell.as_f64().unwrap_or(f64::NAN));
            dict.set_item(key, PyArray1::from_iter(py, numbers))?;
        }
    }
    Ok(dict)
}

/// A record's keys and values.
fn object(record: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(record) {
        Ok(Value::Object(map)) => map,
        _ => Map::new(),
    }
}
