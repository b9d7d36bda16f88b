//! The table of outcomes.

use grouser::simulation::OutcomeKind;
use pyo3::prelude::*;

/// Every outcome of runs and of legs: name, meaning, severity, what it counts as in a band, and
/// whether a run can end so.
#[pyfunction]
pub(crate) fn outcomes() -> Vec<(&'static str, &'static str, &'static str, &'static str, bool)> {
    let row = |kind: OutcomeKind| {
        let row = kind.row();
        (row.name, row.meaning, row.severity.name(), row.in_band.name(), row.ends_runs)
    };
    OutcomeKind::ALL.map(row).into()
}
