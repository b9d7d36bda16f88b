//! Flags of validity, by their bits and names.

use grouser::contact::validity::{Finding, Flag};
use grouser::document::table::BETWEEN_NAMES;
use numpy::ndarray::Array1;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Flags as bits, in the order of the list: an array of them is an array of numbers.
pub(crate) fn bits(findings: &[Finding]) -> f64 {
    let all = findings.iter().fold(0_u32, |all, finding| all | 1 << finding.flag as u32);
    f64::from(all)
}

/// The names of flags that came as bits, joined: a text for each wheel, one object for equal ones.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn flag_names<'py>(
    py: Python<'py>,
    bits: PyReadonlyArray1<'py, f64>,
) -> Bound<'py, PyArray1<Py<PyAny>>> {
    let mut known: Vec<(f64, Py<PyAny>)> = Vec::new();
    let mut last = 0;
    let mut texts = Vec::with_capacity(bits.len().unwrap_or(0));
    for bits in bits.as_array() {
        // Neighbours mostly carry the same flags, and few combinations occur.
        if known.get(last).is_none_or(|it| it.0 != *bits) {
            last = known.iter().position(|it| it.0 == *bits).unwrap_or_else(|| {
                known.push((*bits, PyString::new(py, &joined(*bits)).into_any().unbind()));
                known.len() - 1
            });
        }
        texts.push(known[last].1.clone_ref(py));
    }
    PyArray1::from_owned_object_array(py, Array1::from_vec(texts))
}

/// The names of flags, joined.
fn joined(bits: f64) -> String {
    let is_raised = |flag: &Flag| (bits / f64::from(1_u32 << *flag as u32)).rem_euclid(2.0) >= 1.0;
    let raised = Flag::ALL.into_iter().filter(is_raised);
    raised.map(Flag::name).collect::<Vec<_>>().join(BETWEEN_NAMES)
}

/// Every flag of the closed list: its name, and what it means.
#[pyfunction]
pub(crate) fn flags() -> Vec<(&'static str, &'static str)> {
    Flag::ALL.iter().map(|flag| (flag.name(), flag.rule().meaning)).collect()
}
