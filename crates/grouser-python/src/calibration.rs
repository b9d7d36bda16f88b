//! Calibration: soil parameters, with confidence intervals, from wheel or plate tests.

use std::ops::ControlFlow;
use std::sync::Mutex;

use grouser::document::calibration::{
    AimError, AimWords, BevameterProblem, BevameterTests, STEPS, Solved, WheelProblem, fit_notes,
    samples_csv, sampling,
};
use grouser::document::measurements::{Choice, Limits, MeasurementError};
use grouser::document::{self, Companion, FitKey, SAMPLES_FILE, SoilFamily, plates, shear_tests};
use grouser::studies::calibration::diagnostics::correlations_of;
use grouser::studies::calibration::{CalibrationError, Fit, Observer, PosteriorState, Sampling};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::columns::columns;
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::{Cancelled, listening};
use crate::measurements::Data;
use crate::validation::{conditions_of, record_to_python, validation_to_python};
use crate::wheels::model_and_gravity;

/// A key to fit: its path in the soil's document, and bounds.
type Key = (String, Option<(f64, f64)>);

/// Stops the search on a signal, and keeps the notes on the fits.
struct Listener {
    cancelled: Cancelled,
    notes: Mutex<Vec<String>>,
}

impl Listener {
    fn new(cancelled: &Cancelled) -> Self {
        Self { cancelled: cancelled.clone(), notes: Mutex::default() }
    }

    fn go_on(&self) -> ControlFlow<()> {
        if self.cancelled.is_set() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn notes(self) -> Vec<String> {
        self.notes.into_inner().unwrap_or_default()
    }
}

impl Observer for Listener {
    fn searched(&self) -> ControlFlow<()> {
        self.go_on()
    }

    fn fitted(&self, fit: &Fit) {
        if let Ok(mut notes) = self.notes.lock() {
            notes.extend(fit_notes(fit));
        }
    }

    fn walked(&self, _: &PosteriorState) -> ControlFlow<()> {
        self.go_on()
    }
}

/// Why there is no answer.
enum Failure {
    Measurements(MeasurementError),
    Calibration(CalibrationError),
    Fit(String),
    Aim(AimError),
}

impl From<MeasurementError> for Failure {
    fn from(error: MeasurementError) -> Self {
        Self::Measurements(error)
    }
}

impl From<CalibrationError> for Failure {
    fn from(error: CalibrationError) -> Self {
        Self::Calibration(error)
    }
}

impl Failure {
    /// * `file`: of the measurements
    fn to_python(&self, file: &str) -> PyErr {
        match self {
            Self::Measurements(error) => errors::of_measurements(error, file),
            Self::Calibration(error) => errors::of_calibration(error),
            Self::Fit(what) => {
                errors::parameter(format!("fit: {what}"), "fit", None, "numbers of the soil")
            }
            Self::Aim(AimError::Target { what }) => {
                let expected = "such as drawbar_pull_n:load_n=17,slip_ratio=0.2";
                errors::parameter(format!("target: {what}"), "target", None, expected)
            }
            Self::Aim(AimError::Candidate { key, value, least, most }) => {
                let name = format!("candidate_{key}");
                let message = format!("{name} is {value}, it must be from {least} to {most}");
                errors::parameter(message, &name, Some(*value), format!("from {least} to {most}"))
            }
            Self::Aim(error @ AimError::TooManyCandidates { .. }) => {
                let message = format!("the arguments candidate_… make {error}");
                errors::parameter(message, "candidate_load_n", None, "fewer settings")
            }
        }
    }
}

/// How the posterior is sampled; `None` for least squares alone.
fn sampling_of(seed: u64, steps: Option<u64>) -> PyResult<Option<Sampling>> {
    match steps {
        Some(steps) if !STEPS.contains(&steps) => {
            let expected = format!("from {} to {}", STEPS.start, STEPS.end - 1);
            let message = format!("steps is {steps}, it must be {expected}");
            Err(errors::parameter(message, "steps", Some(steps as f64), expected))
        }
        steps => Ok(steps.map(|steps| sampling(seed, steps, None))),
    }
}

fn keys_of(keys: Vec<Key>) -> Result<Vec<FitKey>, Failure> {
    let key = |(path, bounds): Key| match bounds {
        Some(_) => Ok(FitKey { path, bounds }),
        None => FitKey::parse(&format!("soil.{path}")).map_err(Failure::Fit),
    };
    keys.into_iter().map(key).collect()
}

/// Fits keys of a soil to wheel tests.
///
/// * `aim`: target, how many runs to propose, loads [N], slip ratios, slip angles [°]
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arguments, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how paths and lists come from Python")]
pub(crate) fn calibrate_wheel_tests<'py>(
    py: Python<'py>,
    data: Data,
    soil: &Document,
    wheel: &Document,
    setting: &Document,
    wheel_label: Option<String>,
    conditions: Vec<String>,
    keys: Vec<Key>,
    aim: (String, usize, Option<Vec<f64>>, Vec<f64>, Vec<f64>),
    seed: u64,
    steps: Option<u64>,
    cross_validate: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let conditions = conditions_of(&conditions)?;
    let choice = Choice { conditions, wheel: wheel_label, ..Choice::default() };
    let (model, gravity) = model_and_gravity(soil, setting)?;
    let (soil, wheel) = (soil.soil()?.document.clone(), wheel.wheel()?.value);
    let sampling = sampling_of(seed, steps)?;
    let (target, propose, load_n, slip_ratio, slip_angle_deg) = aim;
    let words = AimWords { target: target.clone(), propose, load_n, slip_ratio, slip_angle_deg };
    let (label, file) = (data.label(), data.name());
    let found = listening(py, move |cancelled| {
        let measured = data.source()?.read(&choice)?;
        let family = SoilFamily::new(&soil, &keys_of(keys)?).map_err(Failure::Fit)?;
        let aim = words.aim(&measured.tests.trials).map_err(Failure::Aim)?;
        let listener = Listener::new(cancelled);
        let problem = WheelProblem {
            family: &family,
            measured: &measured,
            file: &file,
            wheel,
            model,
            gravity,
            sampling,
            aim,
            cross_validate,
        };
        let found = problem.solve(&listener)?;
        let notes = [listener.notes(), found.notes()].concat();
        Ok((found, notes, measured, family))
    })?;
    let (found, notes, measured, family) =
        found.map_err(|failure: Failure| failure.to_python(&label))?;
    let notes = [measured.notes.clone(), notes].concat();
    let dict = solved_to_python(py, &found.solved, &found.soil, &family, notes)?;
    dict.set_item("validation", validation_to_python(py, &measured, &found.validation)?)?;
    let groups = found.left_out.iter().map(|group| record_to_python(py, group));
    dict.set_item("cross_validation", PyList::new(py, groups.collect::<PyResult<Vec<_>>>()?)?)?;
    let overall = found.left_out_overall.as_ref().map(|it| record_to_python(py, it)).transpose()?;
    dict.set_item("cross_validation_overall", overall)?;
    dict.set_item("target", target)?;
    dict.set_item("proposals", columns(py, &found.proposals)?)?;
    Ok(dict)
}

/// Fits a soil to plate tests, shear tests, or both.
///
/// * `plates`, `shear`: rows of each; at least one of them
/// * `law`: `bekker` or `reece`; without it the soil's own
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arguments, as they come from Python")]
pub(crate) fn calibrate_bevameter<'py>(
    py: Python<'py>,
    plates: Option<Data>,
    shear: Option<Data>,
    soil: &Document,
    setting: &Document,
    law: Option<String>,
    seed: u64,
    steps: Option<u64>,
) -> PyResult<Bound<'py, PyDict>> {
    if let Some(law) = law.as_deref().filter(|law| !["bekker", "reece"].contains(law)) {
        let message = format!("plate_law is {law:?}, it must be \"bekker\" or \"reece\"");
        return Err(errors::parameter(message, "plate_law", None, "bekker or reece"));
    }
    let gravity = setting.scenario()?.value.gravity;
    let soil = soil.soil()?.document.clone();
    let sampling = sampling_of(seed, steps)?;
    let each = || plates.iter().chain(&shear);
    let label = each().map(Data::label).collect::<Vec<_>>().join(" and ");
    let file = each().map(Data::name).collect::<Vec<_>>().join(" and ");
    let found = listening(py, move |cancelled| {
        let (tests, notes) = bevameter_tests(plates, shear)?;
        let problem =
            BevameterProblem::new(&soil, law.as_deref(), gravity, &tests).map_err(Failure::Fit)?;
        let listener = Listener::new(cancelled);
        let found = problem.solve(&file, sampling, &listener)?;
        let notes =
            [notes, problem.notes().to_vec(), listener.notes(), found.solved.notes()].concat();
        Ok((found, notes, problem))
    })?;
    let (found, notes, problem) = found.map_err(|failure: Failure| failure.to_python(&label))?;
    let dict = solved_to_python(py, &found.solved, &found.soil, problem.family(), notes)?;
    let (plates, shear) = (problem.plate_records(&found), problem.shear_records(&found));
    if !plates.is_empty() {
        dict.set_item("curves", columns(py, &plates)?)?;
    }
    if !shear.is_empty() {
        dict.set_item("shear_curves", columns(py, &shear)?)?;
    }
    Ok(dict)
}

/// The curves of a bevameter, and what was noticed in them.
fn bevameter_tests(
    plates: Option<Data>,
    shear: Option<Data>,
) -> Result<(BevameterTests, Vec<String>), MeasurementError> {
    let limits = Limits::default();
    let (mut tests, mut notes) = (BevameterTests::default(), Vec::new());
    if let Some(data) = plates {
        let (label, rows) = (data.label(), data.bevameter_rows(limits)?);
        let read = plates::read_from(&label, &*rows, limits)?;
        tests.plates = read.curves;
        notes.extend(read.notes);
    }
    if let Some(data) = shear {
        let (label, rows) = (data.label(), data.bevameter_rows(limits)?);
        let read = shear_tests::read_from(&label, &*rows, limits)?;
        tests.shear = read.curves;
        notes.extend(read.notes);
    }
    Ok((tests, notes))
}

/// The results that every calibration has.
fn solved_to_python<'py>(
    py: Python<'py>,
    solved: &Solved,
    soil: &document::Document,
    family: &SoilFamily,
    notes: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let solution = &solved.solution;
    let dict = PyDict::new(py);
    dict.set_item("parameters", columns(py, &solved.records)?)?;
    dict.set_item("discrepancies", columns(py, &solved.discrepancies)?)?;
    dict.set_item("correlation_lengths", columns(py, &solved.correlation_lengths)?)?;
    dict.set_item("unidentifiable", &solved.unidentifiable)?;
    dict.set_item(
        "sampler",
        solved.sampler.as_ref().map(|it| record_to_python(py, it)).transpose()?,
    )?;
    dict.set_item("outcome", solved.outcome())?;
    dict.set_item("notes", notes)?;
    let searches = &solution.fit.searches;
    dict.set_item("searches", searches.len())?;
    let agreeing = searches.iter().filter(|search| search.agrees).count();
    dict.set_item("searches_that_agree", agreeing)?;
    let mut companions = Vec::new();
    let (samples, correlations) = match &solution.posterior {
        Some(posterior) => {
            let content = samples_csv(family, solved);
            let name = SAMPLES_FILE.to_owned();
            companions.extend(content.map(|content| Companion { name, content }));
            let rows: Vec<Vec<f64>> =
                posterior.samples.rows().map(|row| row[..solved.records.len()].to_vec()).collect();
            (Some(PyArray2::from_vec2(py, &rows)?), posterior.samples.correlations())
        }
        None => (None, correlations_of(&solution.fit.covariance)),
    };
    dict.set_item("samples", samples)?;
    let count = solved.records.len();
    let row = |i: usize| (0..count).map(|j| correlations[(i, j)]).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = (0..count).map(row).collect();
    dict.set_item("correlations", PyArray2::from_vec2(py, &rows)?)?;
    dict.set_item("soil", Document::of_soil(soil.to_toml(), companions)?)?;
    Ok(dict)
}
