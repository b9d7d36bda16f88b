//! Paths that rovers follow under limits, for environments: read, and what a rover on one observes.

use grouser::document::columns::mission::{stopped_by, why_short, why_stopped};
use grouser::document::unit::DEG;
use grouser::document::{Beside, Source, limited_quantity, read_limits, to_toml};
use grouser::mission::{Cause, LegOutcome, PathRun, PathTask as Task, Route, Stop, Then};
use grouser::simulation::{BadState, Run, RunError, Scenario, State};
use grouser::units::Vec2;
use numpy::{PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use toml::Table;

use crate::{errors, values};

/// A path, how near to its end is near enough, and limits on the way.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct PathTask {
    pub(crate) task: Task,
}

#[pymethods]
impl PathTask {
    /// Straight from waypoint to waypoint, each a row of x and y [m].
    #[staticmethod]
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn through(
        places: PyReadonlyArray2<'_, f64>,
        within_m: f64,
        stop: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let rows = places.as_array();
        if rows.ncols() != 2 {
            let message = format!("path has shape {:?}, it must be (waypoints, 2)", rows.dim());
            return Err(errors::parameter(message, "path", None, "shape (waypoints, 2)"));
        }
        let places: Vec<Vec2> =
            rows.rows().into_iter().map(|row| Vec2::new(row[0], row[1])).collect();
        let route = Route::through(&places).map_err(|error| errors::of_parameter(&error))?;
        Self::of(route, within_m, stop)
    }

    /// An arc that begins where the rover starts.
    #[staticmethod]
    fn arc(
        radius_m: f64,
        heading_deg: f64,
        angle_deg: f64,
        within_m: f64,
        stop: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let [heading, angle] = [heading_deg, angle_deg].map(|angle| DEG.to_si(angle));
        let route = Route::arc(radius_m, heading, angle);
        Self::of(route.map_err(|error| errors::of_parameter(&error))?, within_m, stop)
    }

    /// The one that was made [bytes](Self::content).
    #[staticmethod]
    fn of_content(bytes: &[u8]) -> PyResult<Self> {
        let task = Task::from_bytes(bytes).ok_or_else(|| {
            let message = "the bytes are no path of this version of Grouser".to_owned();
            errors::parameter(message, "path", None, "bytes of a path")
        })?;
        Ok(Self { task })
    }

    /// The path and its limits as bytes, for other processes.
    #[getter]
    fn content<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.task.to_bytes())
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyBytes>,))> {
        Ok((slf.getattr("of_content")?, (slf.get().content(slf.py()),)))
    }

    /// Its length [m].
    #[getter]
    fn length_m(&self) -> f64 {
        self.task.route.length()
    }

    /// Places on it after ways along it [m], a row for each: x, y [m] and heading [°].
    #[allow(clippy::needless_pass_by_value, reason = "how an array comes from Python")]
    fn at<'py>(
        &self,
        py: Python<'py>,
        along_m: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let row = |along: &f64| {
            let (place, heading) = self.task.route.at(*along);
            vec![place.x, place.y, DEG.from_si(heading)]
        };
        let rows: Vec<Vec<f64>> = along_m.as_array().iter().map(row).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// The limits by their keys, in the keys' units.
    #[getter]
    fn limits(&self) -> Vec<(&'static str, f64)> {
        self.task.stops.iter().map(|stop| in_its_unit(stop, stop.above)).collect()
    }
}

impl PathTask {
    fn of(route: Route, within: f64, stop: &Bound<'_, PyDict>) -> PyResult<Self> {
        let stops = limits(stop)?;
        if !(within > 0.0 && within.is_finite()) {
            let message = format!("within_m is {within}, it must be above 0");
            return Err(errors::parameter(message, "within_m", Some(within), "above 0"));
        }
        Ok(Self { task: Task { route, within, stops } })
    }
}

/// What Python's argument `stop` says, with the keys that a mission's table has.
fn limits(stop: &Bound<'_, PyDict>) -> PyResult<Vec<Stop>> {
    const STOP: &str = "stop";
    let table = values::to_toml(STOP, stop.as_any(), &mut Beside::default())?;
    let content = Table::from_iter([(STOP.to_owned(), table)]);
    let source = Source::text(STOP, to_toml(&content));
    let stops =
        read_limits(&source).map_err(|error| errors::of_document(&error, &[STOP.to_owned()]))?;
    for stop in &stops {
        if stop.then != Then::End {
            let key = format!("{STOP}.{}.then", limited_quantity(stop.limited).name);
            let expected = "left out: an episode ends where a limit is passed";
            let message = format!("{key} must be {expected}");
            return Err(errors::parameter(message, &key, None, expected));
        }
    }
    Ok(stops)
}

/// A limited number by its key, in the key's unit.
fn in_its_unit(stop: &Stop, value: f64) -> (&'static str, f64) {
    let quantity = limited_quantity(stop.limited);
    (quantity.name, quantity.unit.from_si(value))
}

/// What leads a rover.
#[derive(Clone)]
pub(crate) enum Led {
    /// Nothing but its commands.
    Free(Box<Run>),
    /// Its commands, along a path.
    OnPath(Box<PathRun>),
}

impl Led {
    pub(crate) fn new(run: Run, task: Option<&Task>) -> Result<Self, RunError> {
        Ok(match task {
            None => Self::Free(Box::new(run)),
            Some(task) => Self::OnPath(Box::new(PathRun::new(run, task.clone())?)),
        })
    }

    /// The one that was made [bytes](Self::to_bytes).
    pub(crate) fn from_bytes(
        bytes: &[u8],
        scenario: &Scenario,
        task: Option<&Task>,
    ) -> Result<Self, BadState> {
        Ok(match task {
            None => {
                let state = State::from_bytes(bytes, scenario)?;
                Self::Free(Box::new(Run::resume(scenario, state)))
            }
            Some(task) => Self::OnPath(Box::new(PathRun::from_bytes(bytes, scenario, task)?)),
        })
    }

    /// All that changes, as bytes.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Free(run) => run.state().to_bytes(),
            Self::OnPath(path) => path.to_bytes(),
        }
    }

    pub(crate) fn run(&self) -> &Run {
        match self {
            Self::Free(run) => run,
            Self::OnPath(path) => path.run(),
        }
    }

    pub(crate) fn step(&mut self, rim_speeds: &[f64], span: f64) -> Result<(), RunError> {
        match self {
            Self::Free(run) => run.step(rim_speeds, span),
            Self::OnPath(path) => path.step(rim_speeds, span),
        }
    }

    pub(crate) fn path(&self) -> Option<&PathRun> {
        match self {
            Self::Free(_) => None,
            Self::OnPath(path) => Some(path),
        }
    }
}

/// The names of what [`beside`] has.
pub(crate) const BESIDE: [&str; 3] = ["along_track_m", "cross_track_m", "heading_error_deg"];

/// Where a rover is beside its path, in the order of [`BESIDE`]; and the places on the path ahead
/// of it in its body frame [m], x and y for each of some ways.
pub(crate) fn beside(path: &PathRun, ways: &[f64]) -> Vec<f64> {
    let beside = path.beside();
    let heading_error = DEG.from_si(path.heading_error());
    let ahead = ways.iter().map(|way| path.ahead(*way)).flat_map(|place| [place.x, place.y]);
    [beside.along, beside.cross_track, heading_error].into_iter().chain(ahead).collect()
}

/// What became of a rover on its path: the outcome by its name, the limit that stopped it by its
/// key, its value in the key's unit, and a sentence.
pub(crate) type PathOutcome =
    (Option<&'static str>, Option<&'static str>, Option<f64>, Option<String>);

pub(crate) fn outcome_of(path: &PathRun) -> PathOutcome {
    let Some(outcome) = path.outcome() else { return (None, None, None, None) };
    let name = Some(outcome.name());
    match outcome {
        LegOutcome::Completed => (name, None, None, None),
        LegOutcome::Ended(outcome) => (name, None, None, outcome.reason()),
        // A path has no turns of its own.
        LegOutcome::FellShort(short) => (name, None, None, Some(why_short(short))),
        LegOutcome::Stopped(stopped) => {
            let value = match &stopped.cause {
                Cause::Limit { stop, value } => Some(in_its_unit(stop, *value).1),
                Cause::Outcome(_) => None,
            };
            (name, Some(stopped_by(stopped)), value, Some(why_stopped(stopped)))
        }
    }
}
