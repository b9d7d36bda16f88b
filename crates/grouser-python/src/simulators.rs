//! Step-by-step simulation of any number of rovers, on all cores; each has the same results as
//! alone.

use std::sync::{Mutex, MutexGuard, PoisonError};

use grouser::difference::Derivative;
use grouser::document::columns::run::RECORD;
use grouser::document::columns::{SLOPE, WHEEL_SPEED, YAW};
use grouser::document::{
    Kind, LoadedScenario, RIM_SPEED_M_S, UncertainSoil, fnv_1a, range, scenario_with,
};
use grouser::mission::PathTask as Task;
use grouser::simulation::{
    BadState, LEAST_STEP, LinearStep, NoLinearStep, POSE_AND_VELOCITIES, Run, RunError, Scenario,
    WheelRecord,
};
use grouser::studies::ensemble::outputs_while;
use grouser::vehicle::Mount;
use numpy::{PyArray1, PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::paths::{BESIDE, Led, PathOutcome, PathTask, beside, outcome_of};
use crate::studies::{wheel_names, wheel_sample_columns};
use crate::threads;
use crate::wheels::check;

/// Rovers between two checks for signals: they take a small part of a second.
const BATCH: usize = 64;

/// The longest step [s]: that of the longest run.
const LONGEST_STEP: f64 = grouser::simulation::scenario::LONGEST_DURATION;

/// One rover: its scenario, and its run so far.
#[derive(Clone)]
struct Stepped {
    nominal: Scenario,
    soils: Option<UncertainSoil>,
    task: Option<Task>,
    fresh: Fresh,
    rover: Led,
    failure: Option<String>,
}

/// What one rover starts from besides its scenario.
#[derive(Clone, Copy, Default)]
struct Fresh {
    seed: Option<u64>,
    slope_deg: Option<f64>,
    yaw_deg: Option<f64>,
}

impl Stepped {
    fn new(loaded: &LoadedScenario, task: Option<&Task>) -> Result<Self, RunError> {
        let nominal = loaded.value.clone();
        let soils = loaded.stated_uncertainty().cloned();
        let rover = Led::new(Run::new(&nominal)?, task)?;
        let (task, fresh) = (task.cloned(), Fresh::default());
        Ok(Self { nominal, soils, task, fresh, rover, failure: None })
    }

    fn reset(&mut self, fresh: Fresh) -> Result<(), RunError> {
        let run = Run::new(&self.scenario(fresh)?)?;
        self.rover = Led::new(run, self.task.as_ref())?;
        (self.fresh, self.failure) = (fresh, None);
        Ok(())
    }

    /// The scenario of a rover that starts so.
    fn scenario(&self, fresh: Fresh) -> Result<Scenario, RunError> {
        let mut scenario = self.nominal.clone();
        if let (Some(seed), Some(soils)) = (fresh.seed, &self.soils) {
            // Reading the document has checked that samples can be drawn.
            if let Ok(soil) = soils.under(&scenario.model).draw(seed, 0) {
                scenario.ground.soil = soil;
            }
        }
        let numbers = [(SLOPE.name, fresh.slope_deg), ("start.yaw_deg", fresh.yaw_deg)];
        let numbers = numbers.into_iter().filter_map(|(key, number)| Some((key, number?)));
        Ok(scenario_with(&scenario, numbers)?)
    }

    /// All that changes, as bytes.
    ///
    /// * `mark`: of its scenario
    fn to_bytes(&self, mark: u64) -> Vec<u8> {
        let Fresh { seed, slope_deg, yaw_deg } = self.fresh;
        let [slope, yaw] = [slope_deg, yaw_deg].map(|it| it.map(f64::to_bits));
        let start = Start { mark, seed, slope, yaw, failure: self.failure.clone() };
        let mut bytes = serde_json::to_vec(&start).unwrap_or_default();
        bytes.push(b'\n');
        bytes.extend(self.rover.to_bytes());
        let sum = fnv_1a(bytes.iter().copied());
        bytes.extend(sum.to_le_bytes());
        bytes
    }

    /// Sets all that changes.
    fn restore(&mut self, mark: u64, bytes: &[u8]) -> Result<(), NotRestored> {
        let (bytes, sum) = bytes.split_last_chunk().ok_or(BadState::Unreadable)?;
        if fnv_1a(bytes.iter().copied()).to_le_bytes() != *sum {
            return Err(BadState::Unreadable.into());
        }
        let end = bytes.iter().position(|byte| *byte == b'\n');
        let (start, run) = bytes.split_at(end.ok_or(BadState::Unreadable)?);
        let start: Start = serde_json::from_slice(start).map_err(|_| BadState::Unreadable)?;
        if start.mark != mark {
            return Err(NotRestored::OtherScenario);
        }
        let [slope_deg, yaw_deg] = [start.slope, start.yaw].map(|it| it.map(f64::from_bits));
        let fresh = Fresh { seed: start.seed, slope_deg, yaw_deg };
        let scenario = self.scenario(fresh).map_err(|_| BadState::Unreadable)?;
        self.rover = Led::from_bytes(&run[1..], &scenario, self.task.as_ref())?;
        (self.fresh, self.failure) = (fresh, start.failure);
        Ok(())
    }

    /// Goes on for a while, unless its run has ended or failed.
    fn step(&mut self, rim_speeds: &[f64], span: f64) -> Result<(), RunError> {
        if self.failure.is_some() {
            return Ok(());
        }
        let done = self.rover.step(rim_speeds, span);
        if let Err(error) = &done {
            self.failure = Some(error.to_string());
        }
        done
    }

    /// `None` while it is under way.
    fn outcome(&self) -> Option<&'static str> {
        let found = self.rover.run().outcome().map(grouser::simulation::Outcome::name);
        if self.failure.is_some() { Some("failed") } else { found }
    }

    fn message(&self) -> Option<String> {
        self.failure.clone().or_else(|| self.rover.run().outcome()?.reason())
    }
}

/// What the bytes of a rover begin with: what it started from besides its scenario, and why it
/// failed.
#[derive(serde::Serialize, serde::Deserialize)]
struct Start {
    /// The scenario that the rover is of, by its number.
    mark: u64,
    seed: Option<u64>,
    /// Slope and yaw [°] by their bits, which decimals would have to be read back to.
    slope: Option<u64>,
    yaw: Option<u64>,
    failure: Option<String>,
}

/// Why a rover is not set to a state.
#[derive(Debug, thiserror::Error)]
enum NotRestored {
    #[error("the state is of another scenario than the run's")]
    OtherScenario,
    #[error(transparent)]
    Bad(#[from] BadState),
}

/// Slopes of a step: numbers of the state before and after it; slopes, a row for each number of the
/// state before and each command; where they differ from side to side; and the names of states.
type Slopes<'py> = (
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<bool>>,
    Vec<String>,
);

/// Rovers with one number of wheels.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Simulators {
    rovers: Mutex<Vec<Stepped>>,
    /// What they were made of, for the marks of their states.
    documents: Vec<Py<Document>>,
    wheels: Vec<String>,
    /// ω = v/r_s of each wheel of each rover: r_s [m].
    radii: Vec<Vec<f64>>,
}

#[pymethods]
impl Simulators {
    /// * `path`: that all of them follow
    #[new]
    #[pyo3(signature = (scenarios, path=None))]
    #[allow(clippy::needless_pass_by_value, reason = "how a list comes from Python")]
    fn new(
        py: Python<'_>,
        scenarios: Vec<Py<Document>>,
        path: Option<Py<PathTask>>,
    ) -> PyResult<Self> {
        let task = path.as_ref().map(|path| &path.get().task);
        let loaded = scenarios.iter().map(|scenario| scenario.get().scenario());
        let loaded = loaded.collect::<PyResult<Vec<_>>>()?;
        let wheels = loaded.first().map_or(Vec::new(), |one| wheel_names(&one.value));
        if loaded.iter().any(|one| one.value.rover.wheel_count() != wheels.len()) {
            let message = "the rovers differ in their number of wheels".to_owned();
            return Err(errors::parameter(message, "scenarios", None, "rovers of as many wheels"));
        }
        let radii = loaded.iter().map(|one| one.value.rover.mounts().iter());
        let radii = radii.map(|each| each.map(Mount::shearing_radius).collect()).collect();
        let rovers = threads::released(py, || {
            loaded.into_iter().map(|one| Stepped::new(one, task)).collect::<Result<_, _>>()
        })?;
        let rovers = Mutex::new(rovers.map_err(|error| errors::of_simulation(&error))?);
        Ok(Self { rovers, documents: scenarios, wheels, radii })
    }

    /// How many rovers there are.
    fn __len__(&self) -> usize {
        self.radii.len()
    }

    /// Others that go on as these would, bit for bit.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let rovers = threads::released(py, || self.lock().clone())?;
        let documents = self.documents.iter().map(|it| it.clone_ref(py)).collect();
        let (wheels, radii) = (self.wheels.clone(), self.radii.clone());
        Ok(Self { rovers: Mutex::new(rovers), documents, wheels, radii })
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.copy(py)
    }

    /// All that changes in each rover, as bytes.
    fn states<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyBytes>>> {
        let documents: Vec<&Document> = self.documents.iter().map(Py::get).collect();
        let states: Vec<Vec<u8>> = threads::released(py, || {
            let rovers = self.lock();
            let each = rovers.iter().zip(&documents);
            each.map(|(rover, document)| rover.to_bytes(document.mark())).collect()
        })?;
        Ok(states.iter().map(|state| PyBytes::new(py, state)).collect())
    }

    /// Sets some rovers to states; all stay as they are where one of those is refused.
    #[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
    fn restore(&self, py: Python<'_>, places: Vec<usize>, states: Vec<Vec<u8>>) -> PyResult<()> {
        if places.len() != states.len() || places.iter().any(|it| *it >= self.radii.len()) {
            let message = "there is not one state for every rover".to_owned();
            return Err(errors::parameter(message, "state", None, "one state for each rover"));
        }
        let documents: Vec<&Document> = self.documents.iter().map(Py::get).collect();
        let done = threads::released(py, || {
            let mut rovers = self.lock();
            let each = places.iter().zip(&states).map(|(place, state)| {
                let mut restored = rovers[*place].clone();
                restored.restore(documents[*place].mark(), state)?;
                Ok(restored)
            });
            let restored = each.collect::<Result<Vec<Stepped>, NotRestored>>()?;
            places.iter().zip(restored).for_each(|(place, it)| rovers[*place] = it);
            Ok(())
        })?;
        done.map_err(|error: NotRestored| {
            errors::parameter(error.to_string(), "state", None, "a state of the same scenario")
        })
    }

    /// The slopes of a step of the first rover.
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn linear_step<'py>(
        &self,
        py: Python<'py>,
        commands: PyReadonlyArray2<'py, f64>,
        are_rim_speeds: bool,
        dt_s: f64,
    ) -> PyResult<Slopes<'py>> {
        let rims = self.rim_speeds(&commands, are_rim_speeds, dt_s)?;
        let Some(rims) = rims.into_iter().next() else {
            let message = "there is no rover".to_owned();
            return Err(errors::parameter(message, "scenarios", None, "a rover"));
        };
        let run = threads::released(py, || {
            let rovers = self.lock();
            rovers[0].failure.is_none().then(|| rovers[0].rover.run().clone())
        })?;
        let failed = "the run has failed: it has no next step";
        let run = run.ok_or_else(|| errors::not_found(failed))?;
        let found = listening(py, move |_| run.linear_step(&rims, dt_s))?;
        let LinearStep { before, after, slopes } = found.map_err(|why| match why {
            NoLinearStep::Run(error) => errors::of_simulation(&error),
            why => errors::not_found(&why.to_string()),
        })?;
        let (names, units) = self.numbers(before.len());
        let commands = self.commands(are_rim_speeds);
        let rows = slopes.iter().zip(units.iter().copied().chain(commands));
        let rows = rows.map(|(row, unit)| {
            let each = row.iter().zip(&units);
            each.map(|(slope, after)| slope.times(after / unit)).collect()
        });
        let rows: Vec<Vec<Derivative>> = rows.collect();
        let matrix = |rows: Vec<Vec<f64>>| PyArray2::from_vec2(py, &rows);
        let values = rows.iter().map(|row| row.iter().map(|it| it.value).collect()).collect();
        let one_sided: Vec<Vec<bool>> =
            rows.iter().map(|row| row.iter().map(|it| it.is_one_sided()).collect()).collect();
        let numbers = |state: Vec<f64>| {
            PyArray1::from_iter(py, state.iter().zip(&units).map(|(number, unit)| number * unit))
        };
        let one_sided = PyArray2::from_vec2(py, &one_sided)?;
        Ok((numbers(before), numbers(after), matrix(values)?, one_sided, names))
    }

    /// The numbers of the first rover's state as steps are linearised by them, and their names.
    fn state_numbers<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Vec<String>)> {
        let numbers = threads::released(py, || self.lock()[0].rover.run().numbers())?;
        let (names, units) = self.numbers(numbers.len());
        let numbers = numbers.iter().zip(&units).map(|(number, unit)| number * unit);
        Ok((PyArray1::from_iter(py, numbers), names))
    }

    /// States of the first rover after steps from others, integrated as precisely as for slopes: a
    /// row for each step, with the numbers of the state after it, then its slopes where they are
    /// wanted, each number's by the state and the commands. NaN where the run ends or falls back
    /// within a step, or within one beside it.
    ///
    /// * `points`: a row for each step, with the numbers of the state before it, then the commands
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn precise_steps<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'py, f64>,
        are_rim_speeds: bool,
        dt_s: f64,
        has_slopes: bool,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        check("dt_s", &[dt_s], &(LEAST_STEP..=LONGEST_STEP))?;
        let run = threads::released(py, || self.lock()[0].rover.run().clone())?;
        let states = run.numbers().len();
        let (_, mut units) = self.numbers(states);
        units.extend(self.commands(are_rim_speeds));
        let rows = points.as_array();
        let rows: Vec<Vec<f64>> = rows.rows().into_iter().map(|row| row.to_vec()).collect();
        for row in &rows {
            if row.len() != units.len() {
                let message = format!("there are {} numbers for {}", row.len(), units.len());
                return Err(errors::parameter(message, "state", None, "states and commands"));
            }
            rims_of(&row[states..], &self.radii[0], are_rim_speeds)?;
        }
        let width = if has_slopes { states * units.len() } else { states };
        let row = move |numbers: &Vec<f64>| {
            let found = precise_step(&run, numbers, (states, &units), dt_s, has_slopes);
            found.map(|it| it.unwrap_or_else(|| vec![f64::NAN; width]))
        };
        let found = listening(py, move |cancelled| {
            let found = outputs_while(&rows, &|| !cancelled.is_set(), row);
            found.unwrap_or_default().into_iter().collect::<Result<Vec<_>, _>>()
        })?;
        let found: Vec<Vec<f64>> = found.map_err(|why| errors::not_found(&why.to_string()))?;
        Ok(PyArray2::from_vec2(py, &found)?)
    }

    /// The names of the wheels, in the order of their mounts.
    #[getter]
    fn wheel_names(&self) -> Vec<String> {
        self.wheels.clone()
    }

    /// Starts some of the rovers anew.
    ///
    /// * `seeds`: of the sampled soils; without one, the nominal soil
    #[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
    fn reset(
        &self,
        py: Python<'_>,
        places: Vec<usize>,
        seeds: Vec<Option<u64>>,
        slope_deg: Vec<Option<f64>>,
        yaw_deg: Vec<Option<f64>>,
    ) -> PyResult<()> {
        let count = places.len();
        if [seeds.len(), slope_deg.len(), yaw_deg.len()] != [count; 3]
            || places.iter().any(|place| *place >= self.radii.len())
        {
            let message = "there is not one value for every rover".to_owned();
            return Err(errors::parameter(message, "reset", None, "one value for each rover"));
        }
        let slopes = range(Kind::Scenario, SLOPE.name).unwrap_or(0.0..=60.0);
        let yaws = range(Kind::Scenario, "start.yaw_deg").unwrap_or(-180.0..=180.0);
        check(SLOPE.name, &slope_deg.iter().flatten().copied().collect::<Vec<_>>(), &slopes)?;
        check(YAW.name, &yaw_deg.iter().flatten().copied().collect::<Vec<_>>(), &yaws)?;
        let mut fresh = vec![None; self.radii.len()];
        for (k, place) in places.into_iter().enumerate() {
            let (slope_deg, yaw_deg) = (slope_deg[k], yaw_deg[k]);
            fresh[place] = Some(Fresh { seed: seeds[k], slope_deg, yaw_deg });
        }
        self.each(py, |rover, place| fresh[place].map_or(Ok(()), |fresh| rover.reset(fresh)))
    }

    /// Turns wheels for some time. A motion that cannot be computed is a failure of that rover
    /// alone.
    ///
    /// * `commands`: of each rover and wheel; wheel speeds [rad/s], or rim speeds [m/s]
    /// * `active`: which rovers go on
    #[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
    fn step(
        &self,
        py: Python<'_>,
        commands: PyReadonlyArray2<'_, f64>,
        are_rim_speeds: bool,
        dt_s: f64,
        active: PyReadonlyArray1<'_, bool>,
    ) -> PyResult<()> {
        let rims = self.rim_speeds(&commands, are_rim_speeds, dt_s)?;
        let active: Vec<bool> = active.as_array().to_vec();
        if active.len() != rims.len() {
            let message = "mask is not as long as there are rovers".to_owned();
            return Err(errors::parameter(message, "mask", None, "one value for each rover"));
        }
        self.each(py, |rover, place| {
            // A failure is kept with its rover, and the others go on.
            let _ = active[place].then(|| rover.step(&rims[place], dt_s));
            // Its wheels settle here, on all cores, and not where it is read.
            let _ = rover.rover.run().now();
            Ok(())
        })
    }

    /// A row for each rover with the columns of a trajectory.
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = threads::released(py, || {
            let row =
                |led: &Stepped| RECORD.iter().map(|it| it.number(led.rover.run().now())).collect();
            self.lock().iter().map(row).collect()
        })?;
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// A matrix of rovers and wheels for each column of a wheel; NaN where a rover has just tipped
    /// over or sunk.
    fn wheel_samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let wheels = 0..self.wheels.len();
        let matrix = |get: &dyn Fn(&WheelRecord) -> f64, rovers: &[Stepped]| {
            let row = |led: &Stepped| {
                let now = &led.rover.run().now().wheels;
                wheels.clone().map(|k| now.get(k).map_or(f64::NAN, get)).collect()
            };
            rovers.iter().map(row).collect::<Vec<Vec<f64>>>()
        };
        let all: Vec<Vec<Vec<f64>>> = threads::released(py, || {
            let rovers = self.lock();
            wheel_sample_columns().map(|(_, get)| matrix(&*get, &rovers)).collect()
        })?;
        Ok(PyArray3::from_vec3(py, &all)?)
    }

    /// Outcome and message of each rover, `None` while it is under way; and how it was computed.
    #[allow(clippy::type_complexity, reason = "three texts of each rover")]
    fn statuses(
        &self,
        py: Python<'_>,
    ) -> PyResult<Vec<(Option<&'static str>, Option<String>, &'static str)>> {
        let status =
            |led: &Stepped| (led.outcome(), led.message(), led.rover.run().state().method().name());
        threads::released(py, || self.lock().iter().map(status).collect())
    }

    /// A row for each rover with where it is beside its path, in the order of [`path_columns`];
    /// then x and y of the places on the path that are some ways ahead [m], in its body frame.
    #[allow(clippy::needless_pass_by_value, reason = "how a list comes from Python")]
    fn path_samples<'py>(
        &self,
        py: Python<'py>,
        ways: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = threads::released(py, || {
            let rovers = self.lock();
            let paths = rovers.iter().filter_map(|led| led.rover.path());
            paths.map(|path| beside(path, &ways)).collect()
        })?;
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// What became of each rover on its path.
    fn path_outcomes(&self, py: Python<'_>) -> PyResult<Vec<PathOutcome>> {
        threads::released(py, || {
            let rovers = self.lock();
            rovers.iter().filter_map(|led| led.rover.path()).map(outcome_of).collect()
        })
    }
}

impl Simulators {
    /// The rovers, for one thread at a time. Call it without Python's lock: the thread that holds
    /// the rovers may wait for that.
    fn lock(&self) -> MutexGuard<'_, Vec<Stepped>> {
        self.rovers.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The rim speeds of commands [m/s], a list for each rover.
    fn rim_speeds(
        &self,
        commands: &PyReadonlyArray2<'_, f64>,
        are_rim_speeds: bool,
        dt_s: f64,
    ) -> PyResult<Vec<Vec<f64>>> {
        let (count, wheels) = (self.radii.len(), self.wheels.len());
        let commands = commands.as_array();
        if commands.dim() != (count, wheels) {
            let expected = format!("shape ({count}, {wheels}), rovers and wheels");
            let message =
                format!("commands have shape {:?}, it must be {expected}", commands.dim());
            return Err(errors::parameter(message, "commands", None, expected));
        }
        check("dt_s", &[dt_s], &(LEAST_STEP..=LONGEST_STEP))?;
        let mut rims = Vec::with_capacity(count);
        for (row, radii) in commands.rows().into_iter().zip(&self.radii) {
            rims.push(rims_of(&row.to_vec(), radii, are_rim_speeds)?);
        }
        Ok(rims)
    }

    /// Names of the numbers of a linearised state, and each one's size in SI's unit.
    ///
    /// * `states`: how many there are
    fn numbers(&self, states: usize) -> (Vec<String>, Vec<f64>) {
        // The columns of pose and velocities follow the time.
        let body = RECORD[1..=POSE_AND_VELOCITIES].iter();
        let body = body.map(|column| (column.name.to_owned(), column.unit.from_si(1.0)));
        let of_wheels = |quantity: &'static str| {
            self.wheels.iter().map(move |wheel| format!("{wheel}.{quantity}"))
        };
        let radii = self.radii.iter().take(1).flatten();
        let turning = of_wheels(WHEEL_SPEED.name).zip(radii.map(|radius| 1.0 / radius));
        let integrals = of_wheels("control_voltage_v").map(|name| (name, 1.0));
        body.chain(turning).chain(integrals).take(states).unzip()
    }

    /// The commands of the first rover's wheels for a metre per second of their rims.
    fn commands(&self, are_rim_speeds: bool) -> impl Iterator<Item = f64> {
        let radii = self.radii.iter().take(1).flatten();
        radii.map(move |radius| if are_rim_speeds { 1.0 } else { 1.0 / radius })
    }

    /// Applies `act` to every rover, on all cores. On Ctrl-C the remaining rovers stay as they are.
    /// Returns the first error in the order of the rovers.
    fn each(
        &self,
        py: Python<'_>,
        act: impl Fn(&mut Stepped, usize) -> Result<(), RunError> + Sync,
    ) -> PyResult<()> {
        let mut result = Ok(());
        let mut start = 0;
        while start < self.radii.len() {
            let pool = threads::pool(py)?;
            let done: Vec<_> = threads::released(py, || {
                // Locked before the pool runs: a thread of the pool that waits for others starts
                // other work, which must not ask for the same lock.
                let mut rovers = self.lock();
                let batch = rovers.iter_mut().enumerate().skip(start).take(BATCH);
                let batch: Vec<(usize, &mut Stepped)> = batch.collect();
                let act = |(place, led): (usize, &mut Stepped)| act(led, place);
                pool.install(|| batch.into_par_iter().map(act).collect())
            })?;
            result = result.and(done.into_iter().collect::<Result<(), RunError>>());
            py.check_signals()?;
            start += BATCH;
        }
        result.map_err(|error| errors::of_simulation(&error))
    }
}

/// The rim speeds of one rover's commands [m/s].
fn rims_of(commands: &[f64], radii: &[f64], are_rim_speeds: bool) -> PyResult<Vec<f64>> {
    let rim_speed = |(command, radius): (&f64, &f64)| {
        let factor = if are_rim_speeds { 1.0 } else { *radius };
        let limit = RIM_SPEED_M_S.end() / factor;
        check("commands", &[*command], &(-limit..=limit))?;
        Ok(command * factor)
    };
    commands.iter().zip(radii).map(rim_speed).collect()
}

/// The state after a step, or its slopes; none where the run ends within it.
///
/// * `numbers`: the state before, then the commands
/// * `states`, `units`: how many numbers belong to the state, and the size of each in SI's unit
///
/// # Errors
/// [`NoLinearStep`] where no step of the run has any.
fn precise_step(
    run: &Run,
    numbers: &[f64],
    (states, units): (usize, &[f64]),
    span: f64,
    has_slopes: bool,
) -> Result<Option<Vec<f64>>, NoLinearStep> {
    if !numbers.iter().all(|it| it.is_finite()) {
        return Ok(None);
    }
    let before: Vec<f64> = numbers.iter().zip(units).map(|(it, unit)| it / unit).collect();
    let (state, rims) = before.split_at(states);
    let found = if has_slopes {
        run.linear_step_from(state, rims, span).map(|step| {
            let of = |(after, unit): (usize, &f64)| {
                let by = step.slopes.iter().zip(units);
                by.map(|(by, own)| by[after].value * unit / own).collect::<Vec<_>>()
            };
            units[..states].iter().enumerate().flat_map(of).collect()
        })
    } else {
        let after = run.precise_step_from(state, rims, span);
        after.map(|it| it.iter().zip(units).map(|(it, unit)| it * unit).collect())
    };
    match found {
        Err(why @ NoLinearStep::PrescribedYaw) => Err(why),
        found => Ok(found.ok()),
    }
}

/// The names of the columns of [`Simulators::samples`] and [`Simulators::wheel_samples`].
#[pyfunction]
pub(crate) fn simulator_columns() -> (Vec<&'static str>, Vec<&'static str>) {
    let wheel = wheel_sample_columns().map(|(name, _)| name);
    (RECORD.iter().map(|it| it.name).collect(), wheel.collect())
}

/// The names of the first columns of [`Simulators::path_samples`].
#[pyfunction]
pub(crate) fn path_columns() -> [&'static str; 3] {
    BESIDE
}
