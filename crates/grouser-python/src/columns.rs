//! Records as columns: a list of records becomes an array for each key.

use grouser::document::campaign;
use grouser::document::study::WheelRecord;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use serde::Serialize;
use serde_json::{Map, Value};

macro_rules! wheel_columns {
    ($($name:ident),+ $(,)?) => {
        /// Names of a wheel's results.
        pub(crate) const WHEEL_COLUMNS: [&str; [$(stringify!($name)),+].len()] =
            [$(stringify!($name)),+];

        /// A wheel's results in the order of [`WHEEL_COLUMNS`]; NaN, Python's word for none, where
        /// there are none.
        pub(crate) fn wheel_row(record: &WheelRecord) -> [f64; WHEEL_COLUMNS.len()] {
            [$(record.$name.unwrap_or(f64::NAN)),+]
        }
    };
}

wheel_columns!(
    sinkage_mm,
    entry_angle_deg,
    exit_angle_deg,
    max_stress_angle_deg,
    drawbar_pull_n,
    side_force_n,
    side_force_from_shear_n,
    bulldozing_load_n,
    normal_force_n,
    torque_nm,
    overturning_moment_nm,
    aligning_moment_nm,
    thrust_n,
    motion_resistance_n,
    max_normal_stress_kpa,
);

/// The unit that a name ends with, by the library's table; `None` for a ratio, a count or a text.
#[pyfunction]
pub(crate) fn unit_of(name: &str) -> Option<&'static str> {
    campaign::unit(name)
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
