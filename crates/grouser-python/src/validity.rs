//! Flags of validity, by their bits and names.

use grouser::contact::validity::{Finding, Flag};
use grouser::document::table::BETWEEN_NAMES;
use pyo3::prelude::*;

/// Flags as bits, in the order of the list: an array of them is an array of numbers.
pub(crate) fn bits(findings: &[Finding]) -> f64 {
    let all = findings.iter().fold(0_u32, |all, finding| all | 1 << finding.flag as u32);
    f64::from(all)
}

/// The names of flags that came as bits, joined.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn flag_names(bits: Vec<u32>) -> Vec<String> {
    let names = |bits: &u32| {
        let raised = Flag::ALL.into_iter().filter(|flag| bits & 1 << *flag as u32 != 0);
        raised.map(Flag::name).collect::<Vec<_>>().join(BETWEEN_NAMES)
    };
    bits.iter().map(names).collect()
}

/// Every flag of the closed list: its name, and what it means.
#[pyfunction]
pub(crate) fn flags() -> Vec<(&'static str, &'static str)> {
    Flag::ALL.iter().map(|flag| (flag.name(), flag.rule().meaning)).collect()
}
