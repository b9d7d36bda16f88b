//! Many runs at once: scenarios, soils and numbers that vary from run to run.

use std::collections::HashMap;

use grouser::contact::Model;
use grouser::difference::Derivative;
use grouser::document;
use grouser::document::columns::Column;
use grouser::document::columns::run::{RECORD, STANDING};
use grouser::document::gradient::{GradientKeys, RunKeys};
use grouser::document::varied::{Numbers as _, Varied};
use grouser::document::{
    Described as _, Kind, LoadedScenario, LoadedSoil, Misfit, range, scenario_with,
};
use grouser::error::ParameterError;
use grouser::simulation::{Record, Run, RunError, Scenario, Trajectory};
use grouser::soil::Soil;
use grouser::studies::ensemble::outputs_while;
use grouser::vehicle::DriveLaw;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::gradients::{no_such_key, of_records};
use crate::interrupt::listening;
use crate::varied::{self, KEYS, RIM_SPEED, VariedKeys};
use crate::wheels::{check_or_nan, column, inside};

/// Many runs, which share what is the same for them.
pub(crate) struct Runs {
    /// The scenarios, and whether each names its wheel–soil model itself.
    bases: Vec<(Scenario, bool)>,
    documents: Vec<document::Document>,
    base_of: Option<Vec<usize>>,
    soils: Vec<(Soil, Model)>,
    soil_documents: Vec<document::Document>,
    soil_of: Option<Vec<usize>>,
    /// Arguments, and the keys of scenarios that they set, with a value for each run.
    varied: Vec<([&'static str; 2], Vec<f64>)>,
    /// Other keys, of the scenarios.
    of_bases: VariedKeys,
    /// Those of the soils, where there are some in the place of the scenarios' own.
    of_soils: VariedKeys,
    /// Why a run has a number out of its range, where those are left out; in no order.
    outside: HashMap<usize, String>,
    count: usize,
}

/// Which of some things each run has, if there are several.
pub(crate) type Index<'py> = Option<PyReadonlyArray1<'py, i64>>;

impl Runs {
    /// Checks that every run has a scenario, a soil where there are some, and numbers in their
    /// ranges.
    pub(crate) fn new(
        scenarios: &[PyRef<'_, Document>],
        scenario_index: &Index<'_>,
        soils: &[PyRef<'_, Document>],
        soil_index: &Index<'_>,
        varied: &Bound<'_, PyDict>,
        count: usize,
        outside_is_nan: bool,
    ) -> PyResult<Self> {
        let bases = scenarios.iter().map(|it| it.scenario()).collect::<PyResult<Vec<_>>>()?;
        let soils = soils.iter().map(|it| it.soil()).collect::<PyResult<Vec<_>>>()?;
        if bases.is_empty() && count > 0 {
            let message = "there is no scenario".to_owned();
            return Err(errors::parameter(message, "scenarios", None, "at least one"));
        }
        let base_of = places(scenario_index, bases.len(), count)?;
        let soil_of = places(soil_index, soils.len(), count)?;
        let mut outside = Vec::new();
        let left_out = outside_is_nan.then_some(&mut outside);
        let arguments = arguments_of(varied, count, left_out)?;
        let documents: Vec<_> = soils.iter().map(|soil| varied::parts(soil)).collect();
        let prefix = if soils.is_empty() { NO_KEY } else { SOIL };
        let of_soils = VariedKeys::taken(varied, prefix, &documents, count)?;
        let documents: Vec<_> = bases.iter().map(|base| varied::parts(base)).collect();
        let of_bases = VariedKeys::taken(varied, "", &documents, count)?;
        let named = |it: &&LoadedScenario| (it.value.clone(), it.document.model().is_some());
        let usual = |it: &&LoadedSoil| (it.value, it.document.usual_model(""));
        let mut runs = Self {
            bases: bases.iter().map(named).collect(),
            documents: bases.iter().map(|it| it.document.clone()).collect(),
            base_of,
            soils: soils.iter().map(usual).collect(),
            soil_documents: soils.iter().map(|it| it.document.clone()).collect(),
            soil_of,
            varied: arguments,
            of_bases,
            of_soils,
            outside: outside.into_iter().collect(),
            count,
        };
        if outside_is_nan {
            let (base_of, soil_of) = (runs.base_of.clone(), runs.soil_of.clone());
            let at = |index: &Option<Vec<usize>>, place: usize| {
                index.as_ref().map_or(0, |index| index[place])
            };
            runs.outside.extend(runs.of_bases.leave_out(|place| at(&base_of, place)));
            runs.outside.extend(runs.of_soils.leave_out(|place| at(&soil_of, place)));
        }
        runs.of_bases.check(|place| runs.base_at(place))?;
        runs.of_soils.check(|place| runs.soil_at(place))?;
        Ok(runs)
    }

    fn base_at(&self, place: usize) -> usize {
        self.base_of.as_ref().map_or(0, |index| index[place])
    }

    fn soil_at(&self, place: usize) -> usize {
        self.soil_of.as_ref().map_or(0, |index| index[place])
    }

    /// The scenario of a run.
    pub(crate) fn scenario(&self, place: usize) -> Result<Scenario, ParameterError> {
        let (base, names_its_model) = &self.bases[self.base_at(place)];
        let mut scenario = base.clone();
        if let Some((soil, model)) = self.soils.get(self.soil_at(place)) {
            let numbers = self.of_soils.at(self.soil_at(place), place);
            scenario.ground.soil = soil.with(numbers).map_err(Misfit::of_numbers)?;
            if !names_its_model {
                scenario.model = model.clone();
            }
        }
        let of_base = self.of_bases.at(self.base_at(place), place);
        scenario_with(&scenario, of_base.chain(self.arguments(place)))
    }

    /// The keys that arguments set, and their numbers in a run.
    fn arguments(&self, place: usize) -> impl Iterator<Item = (&str, f64)> {
        let (base, _) = &self.bases[self.base_at(place)];
        let drives_over_ground =
            matches!(base.drive, DriveLaw::Eq18(_) | DriveLaw::Eq18AsPrinted(_));
        self.varied.iter().map(move |([_, key], values)| {
            let is_ground_speed = drives_over_ground && *key == RIM_SPEED;
            (if is_ground_speed { "drive.ground_speed_m_s" } else { *key }, values[place])
        })
    }

    /// The number of a run under a key of its scenario.
    pub(crate) fn number(&self, place: usize, path: &str) -> Option<f64> {
        let own = self.arguments(place).find(|(key, _)| *key == path);
        let varied = || self.of_bases.at(self.base_at(place), place).find(|(key, _)| *key == path);
        if let Some((_, number)) = own.or_else(varied) {
            return Some(number);
        }
        let of_soil = path.strip_prefix(SOIL).zip(self.soil_documents.get(self.soil_at(place)));
        let Some((key, soil)) = of_soil else {
            return self.documents[self.base_at(place)].number(path);
        };
        let varied = self.of_soils.at(self.soil_at(place), place).find(|(own, _)| *own == key);
        varied.map(|(_, number)| number).or_else(|| soil.number(key))
    }

    /// The numbers that results are differentiated by: `all` are those of the first scenario, and
    /// of the first soil in the place of its own.
    fn gradient_keys(&self, base: &LoadedScenario, asked_for: &[String]) -> PyResult<RunKeys> {
        let mut keys = RunKeys::of(base, &GradientKeys::of(asked_for));
        if let (GradientKeys::All, Some(soil)) =
            (GradientKeys::of(asked_for), self.soil_documents.first())
        {
            let of_base = keys.iter().flat_map(RunKeys::names).filter(|it| !it.starts_with(SOIL));
            let of_base: Vec<String> = of_base.map(str::to_owned).collect();
            let soil = Varied::of(self.soils[0].0, soil.clone());
            let of_soil = soil.document.number_keys().into_iter();
            let of_soil = of_soil.filter(|key| soil.key(key).is_ok());
            let of_soil = of_soil.map(|key| format!("{SOIL}{key}"));
            let names = of_base.into_iter().chain(of_soil).collect();
            keys = RunKeys::of(base, &GradientKeys::These(names));
        }
        keys.map_err(no_such_key)
    }

    /// The first number of a run that is NaN.
    fn missing(&self, place: usize) -> Option<&str> {
        let argument = self.varied.iter().find(|(_, values)| values[place].is_nan());
        let argument = argument.map(|([name, _], _)| *name);
        argument.or_else(|| self.of_bases.missing(place)).or_else(|| self.of_soils.missing(place))
    }

    /// Why a run cannot be computed: a number that is out of its range, or NaN.
    pub(crate) fn why_none(&self, place: usize) -> Option<String> {
        let outside = self.outside.get(&place).cloned();
        outside.or_else(|| self.missing(place).map(|name| format!("{name} is NaN")))
    }

    /// What tells the scenario of a run from others: the bits of all that varies.
    ///
    /// * `argument`: one that is left out
    pub(crate) fn bits_but_for(&self, place: usize, argument: &str) -> Vec<u64> {
        let (base, soil) = (self.base_at(place), self.soil_at(place));
        let arguments = self.varied.iter().filter(|([name, _], _)| *name != argument);
        let arguments = arguments.map(|(_, values)| values[place].to_bits());
        let keys = self.of_bases.at(base, place).chain(self.of_soils.at(soil, place));
        let keys = keys.map(|(_, number)| number.to_bits());
        [base as u64, soil as u64].into_iter().chain(arguments).chain(keys).collect()
    }

    /// The first run whose numbers are invalid, with its place.
    pub(crate) fn first_misfit(&self) -> Option<(usize, ParameterError)> {
        let places = (0..self.count).into_par_iter().with_min_len(256);
        let misfit = |place: usize| {
            let error = self.scenario(place).err().filter(|_| self.missing(place).is_none())?;
            Some((place, error))
        };
        places.find_map_first(misfit)
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

/// What no key starts with.
const NO_KEY: &str = "\0";
/// What the keys of a soil start with, in a scenario.
const SOIL: &str = "soil.";

/// The arguments among what varies, taken from it.
///
/// * `left_out`: takes which runs have a number out of its range, where that is no error
fn arguments_of(
    varied: &Bound<'_, PyDict>,
    count: usize,
    mut left_out: Option<&mut Vec<(usize, String)>>,
) -> PyResult<Vec<([&'static str; 2], Vec<f64>)>> {
    let mut all = Vec::new();
    for [name, key] in KEYS {
        if !varied.contains(name)? {
            continue;
        }
        let mut values = varied::numbers(varied, name, count)?;
        varied.del_item(name)?;
        let allowed = range(Kind::Scenario, key).unwrap_or(f64::MIN..=f64::MAX);
        if let Some(left_out) = &mut left_out {
            let outside = values.iter().enumerate().filter(|(_, value)| !value.is_nan());
            let outside = outside.filter(|(_, value)| !allowed.contains(value));
            left_out
                .extend(outside.map(|(place, it)| (place, errors::outside(name, *it, &allowed))));
            values = inside(&values, &allowed, true).into_owned();
        }
        check_or_nan(name, &values, &allowed)?;
        all.push(([name, key], values));
    }
    Ok(all)
}

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
/// * `soils`: in the place of the scenarios' own; none, to leave those
/// * `varied`: an array of `count` numbers for each argument and key that varies; emptied
/// * `keep`: whether all records are kept, beside the ends
/// * `gradients`: keys of the numbers that ends are differentiated by
/// * `outside_is_nan`: whether a run with a number out of its range has failed, and is no error
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
    gradients: Option<Vec<String>>,
    outside_is_nan: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let runs =
        Runs::new(&scenarios, &scenario_index, &soils, &soil_index, varied, count, outside_is_nan)?;
    let on_heights = runs.bases.iter().any(|(base, _)| !base.ground.is_plane());
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
            let scenario = match runs.scenario(place) {
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
