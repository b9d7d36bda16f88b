//! Many runs at once: scenarios, soils and numbers that vary from run to run.

use grouser::contact::Theory;
use grouser::document::trajectory::SampleRecord;
use grouser::document::variation::{VariationError, Varied};
use grouser::simulation::Scenario;
use grouser::soil::Soil;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::studies::{SAMPLE_FIELDS, run};
use crate::wheels::{check, column};

/// Many runs, which share what is the same for them.
pub(crate) struct Runs {
    /// The scenarios, and whether each names its theory itself.
    bases: Vec<(Scenario, bool)>,
    base_of: Option<Vec<usize>>,
    soils: Vec<(Soil, Option<Theory>)>,
    soil_of: Option<Vec<usize>>,
    varied: Vec<(Varied, Vec<f64>)>,
    count: usize,
}

/// Which of some things each run has, if there are several.
type Index<'py> = Option<PyReadonlyArray1<'py, i64>>;

impl Runs {
    /// Checks that every run has a scenario, a soil where there are some, and numbers in their ranges.
    fn new(
        scenarios: &[PyRef<'_, Document>],
        scenario_index: &Index<'_>,
        soils: &[PyRef<'_, Document>],
        soil_index: &Index<'_>,
        varied: &Bound<'_, PyDict>,
        count: usize,
    ) -> PyResult<Self> {
        let bases = scenarios.iter().map(|it| {
            let loaded = it.scenario()?;
            Ok((loaded.value.clone(), loaded.document.theory().is_some()))
        });
        let soils = soils.iter().map(|it| {
            let loaded = it.soil()?;
            Ok((loaded.value, loaded.document.theory()))
        });
        let bases = bases.collect::<PyResult<Vec<_>>>()?;
        let soils = soils.collect::<PyResult<Vec<_>>>()?;
        if bases.is_empty() && count > 0 {
            let message = "there is no scenario".to_owned();
            return Err(errors::parameter(message, "scenarios", None, "at least one"));
        }
        Ok(Self {
            base_of: places(scenario_index, bases.len(), count)?,
            bases,
            soil_of: places(soil_index, soils.len(), count)?,
            soils,
            varied: varied_of(varied, count)?,
            count,
        })
    }

    /// The scenario of a run.
    fn scenario(&self, place: usize) -> Result<Scenario, VariationError> {
        let of = |index: &Option<Vec<usize>>| index.as_ref().map_or(0, |index| index[place]);
        let (base, names_its_theory) = &self.bases[of(&self.base_of)];
        let mut scenario = base.clone();
        if let Some((soil, theory)) = self.soils.get(of(&self.soil_of)) {
            scenario.site.terrain.soil = *soil;
            if !names_its_theory {
                scenario.theory = theory.unwrap_or_default();
            }
        }
        for (varied, values) in &self.varied {
            varied.put(&mut scenario, values[place])?;
        }
        Ok(scenario)
    }

    /// The first run that cannot be, with its place.
    fn first_misfit(&self) -> Option<(usize, VariationError)> {
        let places = (0..self.count).into_par_iter().with_min_len(256);
        places.find_map_first(|place| self.scenario(place).err().map(|error| (place, error)))
    }
}

/// Which of `known` things each run has.
fn places(index: &Index<'_>, known: usize, count: usize) -> PyResult<Option<Vec<usize>>> {
    let Some(index) = index else { return Ok(None) };
    let place = |it: &i64| usize::try_from(*it).ok().filter(|place| *place < known);
    let all: Option<Vec<usize>> = index.as_slice()?.iter().map(place).collect();
    let all = all.filter(|all| all.len() == count).ok_or_else(|| {
        let message = "an index does not fit the runs".to_owned();
        errors::parameter(message, "scenarios", None, "an index for each run")
    })?;
    Ok(Some(all))
}

fn varied_of(dict: &Bound<'_, PyDict>, count: usize) -> PyResult<Vec<(Varied, Vec<f64>)>> {
    let mut all = Vec::new();
    for varied in Varied::ALL {
        let Some(values) = dict.get_item(varied.name())? else { continue };
        let values: PyReadonlyArray1<'_, f64> = values.extract()?;
        let values = values.as_slice()?.to_vec();
        check(varied.name(), &values, &varied.range())?;
        if values.len() != count {
            let message = format!("{} has {} values for {count} runs", varied.name(), values.len());
            return Err(errors::parameter(message, varied.name(), None, "a value for each run"));
        }
        all.push((varied, values));
    }
    Ok(all)
}

/// The numbers of a sample.
type Row = [f64; SAMPLE_FIELDS.len()];

/// What is kept of a run.
struct End {
    outcome: &'static str,
    reason: Option<String>,
    last: Row,
    /// All samples, where they are wanted.
    samples: Vec<Row>,
}

impl End {
    fn of(scenario: &Scenario, keep: bool) -> Self {
        let row = |sample| {
            let record = SampleRecord::of_body(sample);
            SAMPLE_FIELDS.map(|(_, get)| get(&record))
        };
        match run(scenario) {
            Ok(run) => Self {
                outcome: run.outcome.name(),
                reason: run.outcome.reason(),
                last: row(run.last()),
                samples: if keep { run.records.iter().map(row).collect() } else { Vec::new() },
            },
            Err(error) => Self {
                outcome: "failed",
                reason: Some(error.to_string()),
                last: [f64::NAN; SAMPLE_FIELDS.len()],
                samples: Vec::new(),
            },
        }
    }
}

/// Many runs, on all cores; in their order, whatever the threads did.
///
/// * `soils`: in the place of the scenarios' own; none, to leave those
/// * `varied`: an array of `count` numbers for each key that varies
/// * `keep`: whether all samples are kept, beside the ends
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn rollout<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    scenario_index: Index<'py>,
    soils: Vec<PyRef<'py, Document>>,
    soil_index: Index<'py>,
    varied: &Bound<'py, PyDict>,
    count: usize,
    keep: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let runs = Runs::new(&scenarios, &scenario_index, &soils, &soil_index, varied, count)?;
    let ends = listening(py, move |cancelled| {
        if let Some(misfit) = runs.first_misfit() {
            return Err(misfit);
        }
        let end = |place: usize| {
            let scenario = runs.scenario(place).map_err(|error| (place, error));
            (!cancelled.is_set()).then(|| Ok(End::of(&scenario?, keep)))
        };
        let ends = (0..count).into_par_iter().map(end);
        ends.collect::<Option<Result<Vec<End>, _>>>().unwrap_or_else(|| Ok(Vec::new()))
    })?;
    let ends = ends.map_err(|(place, error)| {
        let VariationError { name, value, expected } = &error;
        let at = if count > 1 { format!(" (entry {place})") } else { String::new() };
        let message = format!("{name} is {value}{at}, it must be {expected}");
        errors::parameter(message, name, Some(*value), expected.clone())
    })?;
    to_python(py, &ends, keep)
}

fn to_python<'py>(py: Python<'py>, ends: &[End], keep: bool) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("outcome", PyList::new(py, ends.iter().map(|end| end.outcome))?)?;
    dict.set_item("reason", PyList::new(py, ends.iter().map(|end| end.reason.as_deref()))?)?;
    for (place, (name, _)) in SAMPLE_FIELDS.into_iter().enumerate() {
        dict.set_item(name, column(py, ends.iter().map(|end| end.last[place])))?;
    }
    if keep {
        let longest = ends.iter().map(|end| end.samples.len()).max().unwrap_or(0);
        let samples = PyDict::new(py);
        for (place, (name, _)) in SAMPLE_FIELDS.into_iter().enumerate() {
            let row = |end: &End| {
                let told = end.samples.iter().map(|row| row[place]);
                told.chain(std::iter::repeat(f64::NAN)).take(longest).collect::<Vec<f64>>()
            };
            let rows: Vec<Vec<f64>> = ends.iter().map(row).collect();
            samples.set_item(name, PyArray2::from_vec2(py, &rows)?)?;
        }
        dict.set_item("samples", samples)?;
    }
    Ok(dict)
}

/// How long the same runs take [s], on as many cores, with scenarios at hand and nothing told to
/// Python: what `rollout` is measured against.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn time_rollout<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    varied: &Bound<'py, PyDict>,
    count: usize,
) -> PyResult<f64> {
    let runs = Runs::new(&scenarios, &None, &[], &None, varied, count)?;
    let seconds = listening(py, move |_| {
        let scenarios: Vec<Scenario> =
            (0..count).filter_map(|place| runs.scenario(place).ok()).collect();
        let start = std::time::Instant::now();
        let end = |scenario: &Scenario| run(scenario).map(|run| (run.last().clone(), run.outcome));
        let ends: Vec<_> = scenarios.par_iter().map(end).collect();
        let seconds = start.elapsed().as_secs_f64();
        drop(ends);
        seconds
    })?;
    Ok(seconds)
}
