//! Python's values as those of documents, and back.

use grouser::document::Beside;
use pyo3::exceptions::PyRecursionError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};
use serde_json::Value as Json;
use toml::{Table, Value};

use crate::descriptions::Document;
use crate::errors;
use crate::terrain::Terrain;

/// Tables and lists may be nested this deep. Source: ours, as the reader of documents has it.
const DEEPEST: usize = 16;

/// A change of one key.
pub(crate) struct Change {
    /// Its path, joined by dots.
    pub(crate) key: String,
    /// The value as TOML.
    pub(crate) value: String,
    /// Files and maps that the value names.
    pub(crate) beside: Beside,
}

/// A value for a document.
///
/// * `beside`: files and maps that descriptions in it name, and maps in it, are added
pub(crate) fn to_toml(key: &str, value: &Bound<'_, PyAny>, beside: &mut Beside) -> PyResult<Value> {
    convert(key, value, beside, 0)
}

fn convert(
    key: &str,
    value: &Bound<'_, PyAny>,
    beside: &mut Beside,
    depth: usize,
) -> PyResult<Value> {
    if depth > DEEPEST {
        let message = format!("{key} is nested more than {DEEPEST} levels deep");
        return Err(PyRecursionError::new_err(message));
    }
    if let Some(document) = described(value)? {
        let document = document.get();
        beside.files.extend_from_slice(document.companions());
        beside.maps.extend(document.map());
        return Ok(Value::Table(document.table()));
    }
    if let Some(terrain) = terrain(value)? {
        beside.maps.push(terrain.get().map.clone());
        return Ok(Value::Table(terrain.get().table()));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(Value::String(value.extract()?));
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        // A number beyond 64 bits is beyond every range: as a float it gets that message.
        let integer = value.extract::<i64>().map(Value::Integer);
        return integer.or_else(|_| Ok(Value::Float(value.extract().unwrap_or(f64::INFINITY))));
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        let mut table = Table::new();
        for item in mapping.items()?.iter() {
            let (name, child): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let name: String = name.extract().map_err(|_| errors::wrong_type(key, &name))?;
            let is_map = name == FILE && terrain(&child)?.is_some();
            let child = convert(&format!("{key}.{name}"), &child, beside, depth + 1)?;
            match child {
                // Beside the start the table has what the map says of itself.
                Value::Table(of_map) if is_map => table.extend(of_map),
                _ => drop(table.insert(name, child)),
            }
        }
        return Ok(Value::Table(table));
    }
    other(key, value, beside, depth)
}

/// Paths, scalars and arrays of NumPy, and sequences.
fn other(
    key: &str,
    value: &Bound<'_, PyAny>,
    beside: &mut Beside,
    depth: usize,
) -> PyResult<Value> {
    if value.hasattr("__fspath__")? {
        let path: String = value.call_method0("__fspath__")?.extract()?;
        return Ok(Value::String(path));
    }
    if value.hasattr("tolist")? {
        let plain = value.call_method0("tolist")?;
        // A value whose `tolist` returns another such value would recurse for ever.
        return if plain.hasattr("tolist")? {
            Err(errors::wrong_type(key, value))
        } else {
            convert(key, &plain, beside, depth + 1)
        };
    }
    let is_sequence = value.hasattr("__len__")? && value.hasattr("__getitem__")?;
    if !is_sequence || value.hasattr("decode")? {
        return Err(errors::wrong_type(key, value));
    }
    let items = value.try_iter()?.enumerate();
    let list =
        items.map(|(place, item)| convert(&format!("{key}.{place}"), &item?, beside, depth + 1));
    Ok(Value::Array(list.collect::<PyResult<_>>()?))
}

/// The document of a description such as `Soil`.
fn described<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, Document>>> {
    match value.getattr_opt("_document")? {
        Some(document) => Ok(document.cast_into::<Document>().ok()),
        None => Ok(None),
    }
}

/// The key of a map's file, in the table of a terrain.
const FILE: &str = "file";

/// The map of a `Terrain`.
fn terrain<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, Terrain>>> {
    match value.getattr_opt("_native")? {
        Some(native) => Ok(native.cast_into::<Terrain>().ok()),
        None => Ok(None),
    }
}

/// Whether a mapping is a terrain on a map in memory, which is taken as a whole.
fn has_map(mapping: &Bound<'_, PyMapping>) -> PyResult<bool> {
    let file = if mapping.contains(FILE)? { Some(mapping.get_item(FILE)?) } else { None };
    file.map_or(Ok(false), |file| Ok(terrain(&file)?.is_some()))
}

/// The changes in a mapping: a table changes single keys of the table; laws come first, so that
/// keys of a new law find it there.
pub(crate) fn changes(prefix: &str, mapping: &Bound<'_, PyDict>) -> PyResult<Vec<Change>> {
    let mut all = Vec::new();
    for (name, value) in mapping {
        let name: String = name.extract().map_err(|_| errors::wrong_type(prefix, &name))?;
        collect(&format!("{prefix}.{name}"), &value, &mut all, 0)?;
    }
    all.sort_by_key(|change| change.key.rsplit('.').next() != Some("law"));
    Ok(all)
}

fn collect(
    prefix: &str,
    value: &Bound<'_, PyAny>,
    all: &mut Vec<Change>,
    depth: usize,
) -> PyResult<()> {
    let mapping = value.cast::<PyMapping>();
    let is_table = depth <= DEEPEST && described(value)?.is_none();
    match mapping {
        Ok(mapping) if is_table && !mapping.is_empty()? && !has_map(mapping)? => {
            for item in mapping.items()?.iter() {
                let (name, child): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
                let name: String = name.extract().map_err(|_| errors::wrong_type(prefix, &name))?;
                collect(&format!("{prefix}.{name}"), &child, all, depth + 1)?;
            }
            Ok(())
        }
        _ => {
            let mut beside = Beside::default();
            let value = to_toml(prefix, value, &mut beside)?.to_string();
            all.push(Change { key: prefix.to_owned(), value, beside });
            Ok(())
        }
    }
}

/// A document's value for Python.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Json) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Json::Null => py.None().into_bound(py),
        Json::String(text) => PyString::new(py, text).into_any(),
        Json::Number(number) => match number.as_i64() {
            Some(integer) => integer.into_pyobject(py)?.into_any(),
            None => PyFloat::new(py, number.as_f64().unwrap_or(f64::NAN)).into_any(),
        },
        Json::Bool(truth) => truth.into_pyobject(py)?.to_owned().into_any(),
        Json::Array(items) => {
            let list = PyList::empty(py);
            for item in items {
                list.append(to_python(py, item)?)?;
            }
            list.into_any()
        }
        Json::Object(table) => {
            let dict = PyDict::new(py);
            for (key, value) in table {
                dict.set_item(key, to_python(py, value)?)?;
            }
            dict.into_any()
        }
    })
}
