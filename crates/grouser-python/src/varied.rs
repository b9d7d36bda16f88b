//! Numbers of documents that differ from entry to entry: keys, with an array each.

use std::ops::RangeInclusive;

use grouser::document::varied::{Key, NoNumber, Numbers as _, Varied};
use grouser::document::{Described, Document, Loaded, study};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{descriptions as read, errors};

/// Which of some things each run has, if there are several.
pub(crate) type Index<'py> = Option<PyReadonlyArray1<'py, i64>>;

/// Keys of documents with a number for each entry.
pub(crate) struct VariedKeys {
    keys: Vec<VariedKey>,
}

/// One of them.
struct VariedKey {
    /// Name of the key, as the caller gives it: `soil.cohesion_kpa`.
    name: String,
    /// In each of the documents.
    keys: Vec<Key>,
    values: Vec<f64>,
}

impl VariedKeys {
    /// The keys that start with a prefix, taken from `all`.
    ///
    /// * `documents`: those that have the keys; each entry belongs to one of them
    /// * `count`: number of entries
    ///
    /// # Errors
    /// `ParameterError` for a key that leads to no number in one of the documents.
    pub(crate) fn taken<V: Described>(
        all: &Bound<'_, PyDict>,
        prefix: &str,
        documents: &[(&V, &Document)],
        count: usize,
    ) -> PyResult<Self> {
        let mut keys = Vec::new();
        for name in all.keys() {
            let name: String = name.extract()?;
            let Some(path) = name.strip_prefix(prefix) else { continue };
            let key = |(value, document): &(&V, &Document)| {
                let (value, document) = ((*value).clone(), (*document).clone());
                let one = Varied::of(value, document);
                one.key(path).map_err(|error| unknown(&name, &error))
            };
            let found = documents.iter().map(key).collect::<PyResult<Vec<_>>>()?;
            let values = numbers(all, &name, count)?;
            all.del_item(&name)?;
            keys.push(VariedKey { name, keys: found, values });
        }
        Ok(Self { keys })
    }

    /// Whether nothing differs.
    pub(crate) fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// Checks that all numbers are in their ranges, or NaN.
    ///
    /// * `document_of`: the document that an entry belongs to
    ///
    /// # Errors
    /// `ParameterError` for the first that is not.
    pub(crate) fn check(&self, document_of: impl Fn(usize) -> usize) -> PyResult<()> {
        for VariedKey { name, keys, values } in &self.keys {
            let is_fit = |(place, value): &(usize, &f64)| {
                value.is_nan() || keys[document_of(*place)].range.contains(value)
            };
            if let Some((place, value)) = values.iter().enumerate().find(|it| !is_fit(it)) {
                let range = &keys[document_of(place)].range;
                return Err(errors::out_of_range(name, *value, place, values.len(), range));
            }
        }
        Ok(())
    }

    /// Sets numbers that are out of their ranges to NaN, and returns which those were: the place of
    /// each entry, and a sentence.
    ///
    /// * `document_of`: as of [`check`](Self::check)
    pub(crate) fn leave_out(
        &mut self,
        document_of: impl Fn(usize) -> usize,
    ) -> Vec<(usize, String)> {
        let mut left_out = Vec::new();
        for VariedKey { name, keys, values } in &mut self.keys {
            for (place, value) in values.iter_mut().enumerate() {
                let range = &keys[document_of(place)].range;
                if !value.is_nan() && !range.contains(value) {
                    left_out.push((place, errors::outside(name, *value, range)));
                    *value = f64::NAN;
                }
            }
        }
        left_out
    }

    /// The keys and numbers of an entry.
    pub(crate) fn at(&self, document: usize, place: usize) -> impl Iterator<Item = (&str, f64)> {
        self.keys.iter().map(move |key| (&*key.keys[document].path, key.values[place]))
    }

    /// The first key whose number is NaN.
    pub(crate) fn missing(&self, place: usize) -> Option<&str> {
        self.keys.iter().find(|key| key.values[place].is_nan()).map(|key| &*key.name)
    }
}

/// Arguments of many runs, each with the scenario's key that it sets.
pub(crate) const KEYS: [[&str; 2]; 5] = [
    ["slope_deg", "slope_deg"],
    ["yaw_deg", "start.yaw_deg"],
    ["rim_speed_m_s", RIM_SPEED],
    ["gravity_m_s2", "gravity_m_s2"],
    ["duration_s", "duration_s"],
];

/// The key of the rims' speed. Where a drive follows Eq. 18, that number is its speed over the
/// ground.
pub(crate) const RIM_SPEED: &str = "drive.rim_speed_m_s";

/// Arguments of studies that are no keys of documents, with their ranges.
const ARGUMENTS: [(&str, RangeInclusive<f64>); 4] = [
    ("load_n", study::LOAD_N),
    ("slip_ratio", study::SLIP_RATIO),
    ("slip_angle_deg", study::SLIP_ANGLE_DEG),
    ("course_deg", study::COURSE_DEG),
];

/// The scenario's key that an argument sets; another name is a key itself.
fn key_of_argument(name: &str) -> &str {
    KEYS.iter().find(|[argument, _]| *argument == name).map_or(name, |[_, key]| key)
}

/// What a number may be: the least and the most.
///
/// * `key`: a number of the document; of a scenario also an argument of a study
#[pyfunction]
pub(crate) fn range_of(document: &read::Document, key: &str) -> PyResult<(f64, f64)> {
    let is_of_studies = document.scenario().is_ok();
    let argument = ARGUMENTS.iter().find(|(name, _)| is_of_studies && *name == key);
    let range = if let Some((_, range)) = argument {
        range.clone()
    } else {
        let key = if is_of_studies { key_of_argument(key) } else { key };
        document.number(key)?.map_err(|error| unknown(key, &error))?.range
    };
    Ok((*range.start(), *range.end()))
}

/// What documents mean, and what they say.
pub(crate) fn parts<V>(loaded: &Loaded<V>) -> (&V, &Document) {
    (&loaded.value, &loaded.document)
}

/// The array under a name.
pub(crate) fn numbers(all: &Bound<'_, PyDict>, name: &str, count: usize) -> PyResult<Vec<f64>> {
    let values: Option<PyReadonlyArray1<'_, f64>> =
        all.get_item(name)?.map(|it| it.extract()).transpose()?;
    let values = values.map(|it| it.as_array().to_vec()).unwrap_or_default();
    if values.len() != count {
        let message = format!("{name} has {} values for {count} entries", values.len());
        return Err(errors::parameter(message, name, None, "a value for each entry"));
    }
    Ok(values)
}

/// Checks that every key was taken.
///
/// * `known`: what keys may start with
///
/// # Errors
/// `ParameterError` for the first that was not.
pub(crate) fn check_taken(all: &Bound<'_, PyDict>, known: &str) -> PyResult<()> {
    let Some(name) = all.keys().iter().next() else { return Ok(()) };
    let name: String = name.extract()?;
    let message = format!("vary has the key {name:?}, it must be {known}");
    Err(errors::parameter(message, &name, None, known))
}

fn unknown(name: &str, error: &NoNumber) -> PyErr {
    let hint = error.hint.as_ref().map_or_else(String::new, |hint| format!(": {hint}"));
    let message = format!("{}{hint}", error.problem);
    errors::parameter(message, name, None, "the key of a number")
}
