//! Learning from telemetry: a learner that takes arrays of readings, and logs.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use grouser::document::LoadedScenario;
use grouser::document::columns::Quantity;
use grouser::document::columns::learn as columns;
use grouser::document::given_file::GivenFile;
use grouser::document::learn::{KeptDrive, LearntSoil, NotBelieved, StateError, state_text};
use grouser::document::measurements::telemetry::{Cell, Odometry, TelemetryRows};
use grouser::studies::learn::{Drive, LearnSettings, Learner as Learning, LearntSample, Lesson};
use grouser_logs::{LogOptions, TelemetryError, TelemetryLog};
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::interrupt::listening;
use crate::studies::{Problem, SAMPLES, slopes, wheel_names};
use crate::telemetry::{bytes, files, odometry_named};
use crate::wheels::check;
use crate::{errors, threads};

/// A drive that is learnt from, and the scenario that it began with.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Learner {
    scenario: LoadedScenario,
    slope_is_known: bool,
    drive: Mutex<Drive>,
    source: Mutex<OfSource>,
}

/// What there is to say of telemetry that was taken.
#[derive(Clone, Default)]
struct OfSource {
    /// Of the last, besides what was left out of its rows.
    notes: Vec<String>,
    /// What logs and their mappings gave.
    given: Vec<GivenFile>,
}

/// Tables of what was learnt: stretches, and warnings.
type Taught<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>);

#[pymethods]
impl Learner {
    /// * `slope_is_known`: whether the scenario's slope is that of the drive
    #[new]
    fn new(scenario: &Document, slope_is_known: bool) -> PyResult<Self> {
        let scenario = scenario.scenario()?.clone();
        let drive = Drive::new(learning(&scenario, slope_is_known)?);
        Ok(Self::of(scenario, slope_is_known, drive))
    }

    /// A learner that goes on from the text of a state.
    ///
    /// * `scenario`: that it has to belong to; without it the state's own
    #[staticmethod]
    #[pyo3(signature = (text, scenario=None, slope_is_known=None))]
    fn from_state(
        text: &str,
        scenario: Option<&Document>,
        slope_is_known: Option<bool>,
    ) -> PyResult<Self> {
        let refused = |error: StateError| {
            let message = format!("the state cannot be gone on from: {error}");
            errors::parameter(message, "state", None, "a state that save_state wrote")
        };
        let kept = KeptDrive::read(text).map_err(refused)?;
        let scenario = match scenario {
            Some(scenario) => scenario.scenario()?.clone(),
            None => kept.scenario().map_err(refused)?,
        };
        let slope_is_known = slope_is_known.unwrap_or(kept.slope_is_known());
        let drive = errors::caught(|| kept.drive(&scenario, slope_is_known))?.map_err(refused)?;
        Ok(Self::of(scenario, slope_is_known, drive))
    }

    /// The text of its state.
    fn state(&self) -> String {
        state_text(&self.drive(), &self.scenario, self.slope_is_known)
    }

    /// The scenario that it began with, as TOML and files.
    fn scenario(&self) -> Document {
        Document::of_scenario(self.scenario.clone())
    }

    /// The names of the wheels.
    #[getter]
    fn wheel_names(&self) -> Vec<String> {
        wheel_names(&self.scenario.value)
    }

    /// Takes records; what they taught.
    ///
    /// * `names`, `values`: the columns of telemetry, as many numbers in each; NaN is a gap
    /// * `odometry`: what measured ways and rotations, if that is stated
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn update<'py>(
        &self,
        py: Python<'py>,
        names: Vec<String>,
        values: Vec<PyReadonlyArray1<'py, f64>>,
        odometry: Option<&str>,
    ) -> PyResult<Taught<'py>> {
        let odometry = odometry_named(odometry)?.unwrap_or(Odometry::Visual);
        let last_time = self.drive().last_time();
        let rover = &self.scenario.value.rover;
        let rows = TelemetryRows::new("the telemetry", &names, rover).map_err(|error| {
            errors::parameter(error.to_string(), "telemetry", None, "columns of telemetry")
        })?;
        let mut rows = rows.after(last_time).measured_by(odometry);
        let arrays: Vec<_> = values.iter().map(|it| it.as_array()).collect();
        let count = values.first().map_or(0, |it| it.as_array().len());
        let mut records = Vec::with_capacity(count);
        for row in 0..count {
            records.extend(rows.record(arrays.iter().map(|it| Cell::of_number(it[row]))));
        }
        let lessons = threads::detached(py, || {
            let mut drive = self.drive();
            let taught = records.into_iter().filter_map(|it| drive.update(it).cloned());
            let lessons: Vec<Lesson> = taught.collect();
            let lost = drive.lost().and(rows.lost());
            drive.note_lost(lost);
            lessons
        })?;
        let sentences = [rows.sentence_of_odometry(), rows.sentence_of_unused()];
        self.note(sentences.into_iter().flatten().collect());
        taught(py, &lessons)
    }

    /// Takes all records of a log that come after those that were taken; what they taught.
    ///
    /// * `logs`: files of one drive
    #[allow(clippy::needless_pass_by_value, reason = "how paths come from Python")]
    fn update_log<'py>(
        &self,
        py: Python<'py>,
        logs: Vec<PathBuf>,
        odometry: Option<&str>,
        max_unpacked_mib: Option<u64>,
    ) -> PyResult<Taught<'py>> {
        let options = LogOptions::default()
            .with_odometry(odometry_named(odometry)?)
            .with_most_unpacked(bytes(max_unpacked_mib));
        let lessons = threads::detached(py, || {
            let rover = &self.scenario.value.rover;
            let mut source = TelemetryLog::open_all(&logs, rover, &options)?;
            let mut drive = self.drive();
            let (last_time, before) = (drive.last_time(), drive.lost().clone());
            let mut lessons = Vec::new();
            while let Some(record) = source.next_record()? {
                if last_time.is_none_or(|last| record.time > last) {
                    lessons.extend(drive.update(record).cloned());
                }
            }
            drive.note_lost(before.and(&source.lost()));
            self.note(source.notes_of_source());
            self.source().given.extend(source.given());
            Ok::<_, TelemetryError>(lessons)
        })?;
        taught(py, &lessons.map_err(|error| errors::of_telemetry(&error))?)
    }

    /// A copy in which the drive is over: the records that are too few for a stretch of their own
    /// count, too.
    fn finished(&self) -> PyResult<Self> {
        let drive = errors::caught(|| self.drive().finished())?;
        let source = Mutex::new(self.source().clone());
        Ok(Self { source, ..Self::of(self.scenario.clone(), self.slope_is_known, drive) })
    }

    /// What logs and the files of documents gave.
    fn files(&self) -> String {
        files(&[&self.source().given[..], &self.scenario.given].concat())
    }

    /// All that was learnt on the way: stretches, and warnings.
    fn taught<'py>(&self, py: Python<'py>) -> PyResult<Taught<'py>> {
        let drive = self.drive();
        let lessons = table_to_python(py, columns::lessons(drive.lessons()))?;
        Ok((lessons, table_to_python(py, columns::warnings(drive.warnings()))?))
    }

    /// Heading and slip on slopes [°], before the drive and now.
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn predict<'py>(
        &self,
        py: Python<'py>,
        slope_deg: PyReadonlyArray1<'py, f64>,
        samples: u32,
        seed: u64,
    ) -> PyResult<Bound<'py, PyDict>> {
        check("samples", &[f64::from(samples)], &SAMPLES)?;
        let slopes = slopes(&slope_deg)?;
        let now = self.drive().learner().clone();
        let before = learning(&self.scenario, self.slope_is_known)?;
        let scenario = self.scenario.clone();
        let found = listening(py, move |cancelled| {
            let go_on = || !cancelled.is_set();
            let predict = |learner: &Learning| {
                let believed = LearntSoil::believed(&scenario, learner, (seed, samples));
                let (_, samples) = believed.map_err(|error| match error {
                    NotBelieved::Soil(error) => Problem::Sampling(error),
                    NotBelieved::Document(error) => Problem::NotFound(error.to_string()),
                })?;
                let band = learner.predict(&samples, &slopes, &go_on);
                band.map_err(Problem::Parameter)
            };
            Ok(predict(&before)?.zip(predict(&now)?))
        })?;
        // Who stopped it gets the signal, and no predictions.
        let found = found.map_err(|problem: Problem| problem.raised())?;
        let Some((before, now)) = found else { return Ok(PyDict::new(py)) };
        table_to_python(py, columns::predictions(&before.slopes, &now.slopes))
    }

    /// Samples of the soil's uncertain keys, a row for each, before the drive or now, under the
    /// model with the greatest share.
    fn samples<'py>(
        &self,
        py: Python<'py>,
        samples: u32,
        seed: u64,
        is_before: bool,
    ) -> PyResult<(Vec<String>, Bound<'py, PyArray2<f64>>)> {
        let learner = if is_before {
            learning(&self.scenario, self.slope_is_known)?
        } else {
            self.drive().learner().clone()
        };
        let found = threads::detached(py, || learner.samples_of_best(seed, samples))?;
        let (_, found) = found.map_err(|error| Problem::Sampling(error).raised())?;
        let rows: Vec<Vec<f64>> =
            found.into_iter().map(|LearntSample { values, .. }| values).collect();
        let keys = learner.keys().map(str::to_owned).collect();
        Ok((keys, PyArray2::from_vec2(py, &rows)?))
    }

    /// What is left of the uncertainty of each key [-].
    fn narrowed(&self, samples: u32, seed: u64) -> PyResult<BTreeMap<String, f64>> {
        let narrowed = errors::caught(|| self.drive().learner().narrowed(seed, samples))?;
        narrowed.map_err(|error| Problem::Sampling(error).raised())
    }

    /// The wheel–soil models with their shares [-].
    fn models(&self) -> BTreeMap<&'static str, f64> {
        let models = self.drive().learner().models();
        models.shares().iter().map(|(model, share)| (model.name(), *share)).collect()
    }

    /// How much was learnt from.
    fn learnt<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let drive = self.drive();
        let learnt = drive.learner().learnt();
        let dict = PyDict::new(py);
        dict.set_item("records", learnt.records)?;
        dict.set_item("stretches", learnt.stretches)?;
        let Quantity { name, unit } = columns::WAY;
        dict.set_item(name, unit.from_si(learnt.way))?;
        dict.set_item("outliers", learnt.outliers)?;
        dict.set_item("stretches_not_used", learnt.not_used.values().sum::<u64>())?;
        Ok(dict)
    }

    /// What was left out of the telemetry, and why stretches taught nothing, a sentence each.
    fn notes(&self) -> Vec<String> {
        let drive = self.drive();
        let of_source = self.source().notes.clone();
        let lost = drive.lost().sentences();
        lost.into_iter().chain(of_source).chain(drive.learner().notes()).collect()
    }

    /// The soil as it is known now, with samples.
    ///
    /// * `log`: what the drive is called
    fn soil(&self, log: &str, samples: u32, seed: u64) -> PyResult<Document> {
        let learnt = self.learnt_soil(log, samples, seed)?;
        Document::of_soil(learnt.soil.to_toml(), vec![learnt.companion()])
    }

    /// The scenario with that soil in place of its own.
    fn scenario_now(&self, log: &str, samples: u32, seed: u64) -> PyResult<Document> {
        let learnt = self.learnt_soil(log, samples, seed)?;
        let scenario = learnt.in_scenario(&self.scenario);
        scenario.map(Document::of_scenario).map_err(|error| errors::of_document(&error, &[]))
    }
}

impl Learner {
    fn of(scenario: LoadedScenario, slope_is_known: bool, drive: Drive) -> Self {
        Self { scenario, slope_is_known, drive: Mutex::new(drive), source: Mutex::default() }
    }

    fn drive(&self) -> MutexGuard<'_, Drive> {
        self.drive.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn source(&self) -> MutexGuard<'_, OfSource> {
        self.source.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, notes: Vec<String>) {
        self.source().notes = notes;
    }

    fn learnt_soil(&self, log: &str, samples: u32, seed: u64) -> PyResult<LearntSoil> {
        let drive = self.drive();
        let found =
            errors::caught(|| LearntSoil::now(&self.scenario, &drive, (seed, samples), log))?;
        let found = found.map_err(|error| Problem::Sampling(error).raised())?;
        found.ok_or_else(|| nothing_to_learn("the scenario has no uncertain soil".to_owned()))
    }
}

fn learning(scenario: &LoadedScenario, slope_is_known: bool) -> PyResult<Learning> {
    errors::caught(|| Learning::new(scenario, slope_is_known, LearnSettings::USUAL))?
        .map_err(|error| nothing_to_learn(error.to_string()))
}

fn nothing_to_learn(message: String) -> PyErr {
    errors::parameter(message, "prior", None, "a soil that says how uncertain it is")
}

fn taught<'py>(py: Python<'py>, lessons: &[Lesson]) -> PyResult<Taught<'py>> {
    let warnings: Vec<_> = lessons.iter().flat_map(|it| it.warnings.iter().cloned()).collect();
    let lessons = table_to_python(py, columns::lessons(lessons))?;
    Ok((lessons, table_to_python(py, columns::warnings(&warnings))?))
}
