//! Step-by-step simulation of any number of rovers, on all cores; each has the same results as
//! alone.

use std::sync::{Mutex, MutexGuard, PoisonError};

use grouser::document::columns::run::RECORD;
use grouser::document::columns::{SLOPE, YAW};
use grouser::document::{Kind, LoadedScenario, RIM_SPEED_M_S, UncertainSoil, range, scenario_with};
use grouser::mission::PathTask as Task;
use grouser::simulation::{LEAST_STEP, Run, RunError, Scenario, WheelRecord};
use grouser::vehicle::Mount;
use numpy::{PyArray2, PyArray3, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::descriptions::Document;
use crate::errors;
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
    rover: Led,
    failure: Option<String>,
}

/// What one rover starts from besides its scenario.
#[derive(Clone, Copy)]
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
        Ok(Self { nominal, soils, task: task.cloned(), rover, failure: None })
    }

    fn reset(&mut self, fresh: Fresh) -> Result<(), RunError> {
        let mut scenario = self.nominal.clone();
        if let (Some(seed), Some(soils)) = (fresh.seed, &self.soils) {
            // Reading the document has checked that samples can be drawn.
            if let Ok(soil) = soils.under(&scenario.model).draw(seed, 0) {
                scenario.ground.soil = soil;
            }
        }
        let numbers = [(SLOPE.name, fresh.slope_deg), ("start.yaw_deg", fresh.yaw_deg)];
        let numbers = numbers.into_iter().filter_map(|(key, number)| Some((key, number?)));
        let run = Run::new(&scenario_with(&scenario, numbers)?)?;
        self.rover = Led::new(run, self.task.as_ref())?;
        self.failure = None;
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

/// Rovers with one number of wheels.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Simulators {
    rovers: Mutex<Vec<Stepped>>,
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
        scenarios: Vec<PyRef<'_, Document>>,
        path: Option<PyRef<'_, PathTask>>,
    ) -> PyResult<Self> {
        let task = path.as_ref().map(|path| &path.task);
        let loaded = scenarios.iter().map(|scenario| scenario.scenario());
        let loaded = loaded.collect::<PyResult<Vec<_>>>()?;
        let wheels = loaded.first().map_or(Vec::new(), |one| wheel_names(&one.value));
        if loaded.iter().any(|one| one.value.rover.wheel_count() != wheels.len()) {
            let message = "the rovers differ in their number of wheels".to_owned();
            return Err(errors::parameter(message, "scenarios", None, "rovers of as many wheels"));
        }
        let radii = loaded.iter().map(|one| one.value.rover.mounts().iter());
        let radii = radii.map(|each| each.map(Mount::shearing_radius).collect()).collect();
        let rovers = loaded.into_iter().map(|one| Stepped::new(one, task));
        let rovers = rovers.collect::<Result<_, _>>();
        let rovers = Mutex::new(rovers.map_err(|error| errors::of_simulation(&error))?);
        Ok(Self { rovers, wheels, radii })
    }

    /// How many rovers there are.
    fn __len__(&self) -> usize {
        self.radii.len()
    }

    /// Others that go on as these would, bit for bit.
    fn copy(&self, py: Python<'_>) -> Self {
        let rovers = py.detach(|| self.lock().clone());
        Self { rovers: Mutex::new(rovers), wheels: self.wheels.clone(), radii: self.radii.clone() }
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
        let (count, wheels) = (self.radii.len(), self.wheels.len());
        let (commands, active) = (commands.as_array(), active.as_array());
        if commands.dim() != (count, wheels) || active.len() != count {
            let expected = format!("shape ({count}, {wheels}), rovers and wheels");
            let message =
                format!("commands have shape {:?}, it must be {expected}", commands.dim());
            return Err(errors::parameter(message, "commands", None, expected));
        }
        check("dt_s", &[dt_s], &(LEAST_STEP..=LONGEST_STEP))?;
        let mut rims = Vec::with_capacity(count);
        for (row, radii) in commands.rows().into_iter().zip(&self.radii) {
            let mut rim_speeds = Vec::with_capacity(wheels);
            for (command, radius) in row.iter().zip(radii) {
                let factor = if are_rim_speeds { 1.0 } else { *radius };
                let limit = RIM_SPEED_M_S.end() / factor;
                check("commands", &[*command], &(-limit..=limit))?;
                rim_speeds.push(command * factor);
            }
            rims.push(rim_speeds);
        }
        let active: Vec<bool> = active.to_vec();
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
    ) -> Vec<(Option<&'static str>, Option<String>, &'static str)> {
        let status =
            |led: &Stepped| (led.outcome(), led.message(), led.rover.run().state().method().name());
        py.detach(|| self.lock().iter().map(status).collect())
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
    fn path_outcomes(&self, py: Python<'_>) -> Vec<PathOutcome> {
        py.detach(|| {
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
