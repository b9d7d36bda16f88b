//! Many runs at once: scenarios, soils and numbers that vary from run to run.

use grouser::difference::Derivative;
use grouser::document::columns::Column;
use grouser::document::columns::run::{RECORD, STANDING};
use grouser::simulation::{Record, Run, RunError, Scenario, Trajectory};
use grouser::studies::ensemble::outputs_while;
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::errors;
use crate::gradients::of_records;
use crate::interrupt::listening;
use crate::runs::{AskedRuns, Runs};
use crate::wheels::column;

/// The numbers of a record, those on ground with heights last.
type Row = [f64; RECORD.len() + STANDING.len()];

/// The columns of a record.
fn of_record() -> impl Iterator<Item = (usize, &'static Column<Record>)> {
    RECORD.iter().chain(&STANDING).enumerate()
}

/// How a run is led to its end: with its records, or without.
type Lead = fn(Run) -> Result<Trajectory, RunError>;

/// What is kept of a run.
struct End {
    outcome: &'static str,
    reason: Option<String>,
    last: Row,
    /// All records, where they are wanted.
    samples: Vec<Row>,
    /// Derivatives of the last record, where they are wanted: of all results by the first key, then
    /// by the next.
    gradient: Vec<Option<Derivative>>,
}

impl End {
    fn failed(reason: String) -> Self {
        Self {
            outcome: "failed",
            reason: Some(reason),
            last: [f64::NAN; RECORD.len() + STANDING.len()],
            samples: Vec::new(),
            gradient: Vec::new(),
        }
    }

    /// * `gradient`: of a run, which was led as others are to be
    fn of(
        scenario: &Scenario,
        keep: bool,
        gradient: impl FnOnce(&Trajectory, Lead) -> Vec<Option<Derivative>>,
    ) -> Self {
        let row = |sample: &Record| {
            let mut row = [f64::NAN; RECORD.len() + STANDING.len()];
            of_record().for_each(|(place, column)| row[place] = column.number(sample));
            row
        };
        let lead: Lead = if keep { Run::to_end } else { Run::to_outcome };
        match Run::new(scenario).and_then(lead) {
            Ok(run) => Self {
                outcome: run.outcome.name(),
                reason: run.outcome.reason(),
                last: row(run.last()),
                samples: if keep { run.records.iter().map(row).collect() } else { Vec::new() },
                gradient: gradient(&run, lead),
            },
            Err(error) => Self::failed(error.to_string()),
        }
    }
}

/// Many runs, on all cores; in their order, whatever the threads did.
///
/// * `keep`: whether all records are kept, beside the ends
/// * `gradients`: keys of the numbers that ends are differentiated by
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn rollout<'py>(
    py: Python<'py>,
    asked: AskedRuns<'py>,
    keep: bool,
    gradients: Option<Vec<String>>,
) -> PyResult<Bound<'py, PyDict>> {
    let runs = Runs::<Scenario>::new(&asked)?;
    let AskedRuns(scenarios, .., count, outside_is_nan, _) = asked;
    let on_heights = runs.is_any(|base| !base.ground.is_plane());
    let keys = match (&gradients, scenarios.first()) {
        (Some(names), Some(base)) => Some(runs.gradient_keys(base.scenario()?, names)?),
        _ => None,
    };
    let by = keys.clone();
    let ends = listening(py, move |cancelled| {
        if let Some(misfit) = runs.first_misfit().filter(|_| !outside_is_nan) {
            return Err(misfit);
        }
        let end = |place: usize| {
            if let Some(why) = runs.why_none(place) {
                return Ok(End::failed(why));
            }
            let scenario = match runs.value(place) {
                Ok(scenario) => scenario,
                Err(error) if outside_is_nan => return Ok(End::failed(error.to_string())),
                Err(error) => return Err((place, error)),
            };
            Ok(End::of(&scenario, keep, |run, lead| {
                let Some(keys) = &by else { return Vec::new() };
                let number = |path: &str| runs.number(place, path);
                let go_on = || !cancelled.is_set();
                let found = keys.along(&scenario, &number, run, lead, &go_on);
                let last = run.records.len() - 1;
                found.map_or(Vec::new(), |it| it.of_record(last).collect())
            }))
        };
        let ends = outputs_while(0..count, &|| !cancelled.is_set(), end);
        ends.unwrap_or_default().into_iter().collect::<Result<Vec<End>, _>>()
    })?;
    let ends = ends.map_err(|(place, error)| errors::misfit_at(place, count, &error))?;
    let dict = to_python(py, &ends, keep, on_heights)?;
    if let Some(keys) = &keys {
        // A run on a plane has none of how it stands.
        let of = |end: usize, key: usize, result: usize| {
            let gradient = &ends[end].gradient;
            let own = gradient.len() / keys.names().count();
            *gradient.get(key * own + result).filter(|_| result < own)?
        };
        dict.set_item("gradient", of_records(py, keys, on_heights, ends.len(), of)?)?;
    }
    Ok(dict)
}

/// * `on_heights`: whether there is ground with heights
fn to_python<'py>(
    py: Python<'py>,
    ends: &[End],
    keep: bool,
    on_heights: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let count = if on_heights { usize::MAX } else { RECORD.len() };
    let columns = || of_record().take(count);
    let dict = PyDict::new(py);
    dict.set_item("outcome", PyList::new(py, ends.iter().map(|end| end.outcome))?)?;
    dict.set_item("reason", PyList::new(py, ends.iter().map(|end| end.reason.as_deref()))?)?;
    for (place, Column { name, .. }) in columns() {
        dict.set_item(name, column(py, ends.iter().map(|end| end.last[place])))?;
    }
    if keep {
        let longest = ends.iter().map(|end| end.samples.len()).max().unwrap_or(0);
        let samples = PyDict::new(py);
        for (place, Column { name, .. }) in columns() {
            let row = |end: &End| {
                let column = end.samples.iter().map(|row| row[place]);
                column.chain(std::iter::repeat(f64::NAN)).take(longest).collect::<Vec<f64>>()
            };
            let rows: Vec<Vec<f64>> = ends.iter().map(row).collect();
            samples.set_item(name, PyArray2::from_vec2(py, &rows)?)?;
        }
        dict.set_item("samples", samples)?;
    }
    Ok(dict)
}
