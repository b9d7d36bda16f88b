//! What many runs are asked of at once: documents, soils and numbers that vary from run to run.

use std::collections::HashMap;

use grouser::contact::Model;
use grouser::document;
use grouser::document::gradient::{GradientKeys, RunKeys};
use grouser::document::varied::{Numbers as _, Varied};
use grouser::document::{
    Described, Kind, Loaded, LoadedScenario, LoadedSoil, Plan, Problem, range,
};
use grouser::simulation::Scenario;
use grouser::soil::Soil;
use grouser::vehicle::DriveLaw;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::gradients::no_such_key;
use crate::varied::{self, Index, KEYS, RIM_SPEED, VariedKeys};
use crate::wheels::{check_or_nan, inside};

/// What a run is made of: a scenario, or a mission.
pub(crate) trait RunBase: Described + Send + Sync {
    fn loaded(document: &Document) -> PyResult<&Loaded<Self>>;

    fn scenario(&mut self) -> &mut Scenario;

    /// What turns the wheels, where one law does all along.
    fn drive(&self) -> Option<&DriveLaw>;
}

impl RunBase for Scenario {
    fn loaded(document: &Document) -> PyResult<&Loaded<Self>> {
        document.scenario()
    }

    fn scenario(&mut self) -> &mut Scenario {
        self
    }

    fn drive(&self) -> Option<&DriveLaw> {
        Some(&self.drive)
    }
}

impl RunBase for Plan {
    fn loaded(document: &Document) -> PyResult<&Loaded<Self>> {
        document.mission()
    }

    fn scenario(&mut self) -> &mut Scenario {
        &mut self.scenario
    }

    fn drive(&self) -> Option<&DriveLaw> {
        None
    }
}

/// What is asked, as Python has it.
#[derive(FromPyObject)]
pub(crate) struct AskedRuns<'py>(
    /// Scenarios or missions, and which of them each run has.
    pub(crate) Vec<PyRef<'py, Document>>,
    pub(crate) Index<'py>,
    /// Soils in the place of their own, and which each run has; none, to leave those.
    pub(crate) Vec<PyRef<'py, Document>>,
    pub(crate) Index<'py>,
    /// A number for each run under each argument and key that varies; emptied.
    pub(crate) Bound<'py, PyDict>,
    /// How many runs there are.
    pub(crate) usize,
    /// Whether a run with a number out of its range has no results, and is no error.
    pub(crate) bool,
    /// Runs without a document, and why.
    pub(crate) Vec<(usize, String)>,
);

/// Many runs, which share what is the same for them.
pub(crate) struct Runs<V> {
    /// The scenarios or missions, and whether each names its wheel–soil model itself.
    bases: Vec<(V, bool)>,
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
    pub(crate) count: usize,
    pub(crate) outside_is_nan: bool,
}

impl<V: RunBase> Runs<V> {
    /// Checks that every run has a scenario, a soil where there are some, and numbers in their
    /// ranges.
    pub(crate) fn new(asked: &AskedRuns<'_>) -> PyResult<Self> {
        let AskedRuns(scenarios, scenario_index, soils, soil_index, varied, ..) = asked;
        let AskedRuns(.., count, outside_is_nan, without_document) = asked;
        let (count, outside_is_nan) = (*count, *outside_is_nan);
        let bases = scenarios.iter().map(|it| V::loaded(it)).collect::<PyResult<Vec<_>>>()?;
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
        let named = |it: &&Loaded<V>| (it.value.clone(), it.document.model().is_some());
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
            outside: without_document.iter().cloned().chain(outside).collect(),
            count,
            outside_is_nan,
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

    /// Whether one of the scenarios or missions is so.
    pub(crate) fn is_any(&self, so: impl Fn(&V) -> bool) -> bool {
        self.bases.iter().any(|(base, _)| so(base))
    }

    fn base_at(&self, place: usize) -> usize {
        self.base_of.as_ref().map_or(0, |index| index[place])
    }

    fn soil_at(&self, place: usize) -> usize {
        self.soil_of.as_ref().map_or(0, |index| index[place])
    }

    /// The scenario or mission of a run.
    pub(crate) fn value(&self, place: usize) -> Result<V, Box<Problem>> {
        let (base, names_its_model) = &self.bases[self.base_at(place)];
        let mut value = base.clone();
        if let Some((soil, model)) = self.soils.get(self.soil_at(place)) {
            let numbers = self.of_soils.at(self.soil_at(place), place);
            let scenario = value.scenario();
            scenario.ground.soil = soil.with(numbers).map_err(|misfit| misfit.problem)?;
            if !names_its_model {
                scenario.model = model.clone();
            }
        }
        let of_base = self.of_bases.at(self.base_at(place), place);
        value.with(of_base.chain(self.arguments(place))).map_err(|misfit| misfit.problem)
    }

    /// The keys that arguments set, and their numbers in a run.
    fn arguments(&self, place: usize) -> impl Iterator<Item = (&str, f64)> {
        let (base, _) = &self.bases[self.base_at(place)];
        let drives_over_ground =
            matches!(base.drive(), Some(DriveLaw::Eq18(_) | DriveLaw::Eq18AsPrinted(_)));
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

    /// The first number of a run that is NaN.
    fn missing(&self, place: usize) -> Option<&str> {
        let argument = self.varied.iter().find(|(_, values)| values[place].is_nan());
        let argument = argument.map(|([name, _], _)| *name);
        argument.or_else(|| self.of_bases.missing(place)).or_else(|| self.of_soils.missing(place))
    }

    /// Whether an argument or key varies.
    pub(crate) fn has(&self, argument: &str) -> bool {
        self.varied.iter().any(|([name, _], _)| *name == argument)
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
    pub(crate) fn first_misfit(&self) -> Option<(usize, Box<Problem>)> {
        let places = (0..self.count).into_par_iter().with_min_len(256);
        let misfit = |place: usize| {
            let error = self.value(place).err().filter(|_| self.missing(place).is_none())?;
            Some((place, error))
        };
        places.find_map_first(misfit)
    }
}

impl Runs<Scenario> {
    /// The numbers that results are differentiated by: `all` are those of the first scenario, and
    /// of the first soil in the place of its own.
    pub(crate) fn gradient_keys(
        &self,
        base: &LoadedScenario,
        asked_for: &[String],
    ) -> PyResult<RunKeys> {
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
