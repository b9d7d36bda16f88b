//! Runs and studies: each in a thread of its own, so that Ctrl-C is heard.

use grouser::document::study::{
    AttitudeLimit, AttitudeMapRecord, AttitudeRecord, COURSE_DEG, MAP_SPEED_M_S,
};
use grouser::document::trajectory::{SampleRecord, TrajectoryRecord, WheelSampleRecord};
use grouser::document::{self, Kind};
use grouser::error::ParameterError;
use grouser::simulation::{Scenario, Simulation, SimulationError, Trajectory};
use grouser::studies::attitude::AttitudeStudy;
use grouser::studies::attitude_map::AttitudeMap;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;

use crate::columns::{WHEEL_COLUMNS, columns, wheel_row};
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::wheels::{check, column};

/// A field of a record, by name.
pub(crate) type Field<R> = (&'static str, fn(&R) -> f64);

macro_rules! fields {
    ($record:ty: $($name:ident),+ $(,)?) => {
        [$((stringify!($name), |record: &$record| record.$name)),+]
    };
}

pub(crate) const SAMPLE_FIELDS: [Field<SampleRecord>; 12] = fields!(SampleRecord:
    time_s, x_m, y_m, yaw_deg, forward_speed_m_s, lateral_speed_m_s, yaw_rate_deg_s, power_w,
    energy_j, soil_energy_j, kinetic_energy_j, potential_energy_j);

pub(crate) const WHEEL_FIELDS: [Field<WheelSampleRecord>; 5] = fields!(WheelSampleRecord:
    wheel_speed_rad_s, slip_ratio, slip_angle_deg, load_n, power_w);

/// A run from its start to its end.
#[pyfunction]
pub(crate) fn simulate<'py>(py: Python<'py>, scenario: &Document) -> PyResult<Bound<'py, PyDict>> {
    let scenario = scenario.scenario()?.value.clone();
    let names = wheel_names(&scenario);
    let record = listening(py, move |_| {
        run(&scenario).map(|run| TrajectoryRecord::new(&run, &scenario.rover))
    })?;
    to_python(py, &record.map_err(|error| errors::of_simulation(&error))?, &names)
}

fn run(scenario: &Scenario) -> Result<Trajectory, SimulationError> {
    Simulation::new(scenario)?.run()
}

pub(crate) fn wheel_names(scenario: &Scenario) -> Vec<String> {
    scenario.rover.mounts().iter().map(|mount| mount.name.clone()).collect()
}

/// A trajectory: words, columns over time, and columns over time and wheel.
fn to_python<'py>(
    py: Python<'py>,
    record: &TrajectoryRecord,
    names: &[String],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("outcome", record.outcome)?;
    dict.set_item("reason", &record.reason)?;
    dict.set_item("simulation", record.simulation)?;
    dict.set_item("simulation_reason", &record.simulation_reason)?;
    dict.set_item("energy_error_j", record.energy_error_j)?;
    dict.set_item("wheels", names)?;
    let rover = PyDict::new(py);
    for (name, get) in SAMPLE_FIELDS {
        rover.set_item(name, column(py, record.samples.iter().map(get)))?;
    }
    dict.set_item("rover", rover)?;
    dict.set_item("each_wheel", each_wheel(py, &record.samples, names.len())?)?;
    Ok(dict)
}

/// Arrays of a row for each sample and a column for each wheel; NaN where a rover has just tipped
/// over or sunk.
fn each_wheel<'py>(
    py: Python<'py>,
    samples: &[SampleRecord],
    count: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let array = |get: &dyn Fn(&WheelSampleRecord) -> f64| {
        let row = |sample: &SampleRecord| {
            (0..count).map(|k| sample.wheels.get(k).map_or(f64::NAN, get)).collect::<Vec<f64>>()
        };
        let rows: Vec<Vec<f64>> = samples.iter().map(row).collect();
        PyArray2::from_vec2(py, &rows)
    };
    let dict = PyDict::new(py);
    for (name, get) in WHEEL_FIELDS {
        dict.set_item(name, array(&get)?)?;
    }
    for (place, name) in WHEEL_COLUMNS.into_iter().enumerate() {
        dict.set_item(name, array(&|wheel| wheel_row(&wheel.forces)[place])?)?;
    }
    Ok(dict)
}

/// What a campaign keeps of a run.
struct End {
    outcome: &'static str,
    reason: Option<String>,
    sample: Option<SampleRecord>,
}

impl End {
    fn of(scenario: &Scenario) -> Self {
        match run(scenario) {
            Ok(run) => Self {
                outcome: run.outcome.name(),
                reason: run.outcome.reason(),
                sample: Some(SampleRecord::new(run.last(), &scenario.rover)),
            },
            Err(error) => Self { outcome: "failed", reason: Some(error.to_string()), sample: None },
        }
    }
}

/// The ends of many runs, on all cores; in the order of the scenarios, whatever the threads did.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a list comes from Python")]
pub(crate) fn rollout<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
) -> PyResult<Bound<'py, PyDict>> {
    let runs = scenarios.iter().map(|scenario| Ok(scenario.scenario()?.value.clone()));
    let runs: Vec<Scenario> = runs.collect::<PyResult<_>>()?;
    let ends = listening(py, move |cancelled| {
        let end = |scenario: &Scenario| (!cancelled.is_set()).then(|| End::of(scenario));
        runs.par_iter().map(end).collect::<Option<Vec<End>>>()
    })?;
    let ends = ends.unwrap_or_default();
    let dict = PyDict::new(py);
    dict.set_item("outcome", PyList::new(py, ends.iter().map(|end| end.outcome))?)?;
    dict.set_item("reason", PyList::new(py, ends.iter().map(|end| end.reason.as_deref()))?)?;
    for (name, get) in SAMPLE_FIELDS {
        let value = |end: &End| end.sample.as_ref().map_or(f64::NAN, get);
        dict.set_item(name, column(py, ends.iter().map(value)))?;
    }
    Ok(dict)
}

/// The level attitude on each slope, the steepest slope, and what ends the curve there.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn attitude<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
) -> PyResult<(Bound<'py, PyDict>, Option<f64>, String)> {
    let slopes = slopes(&slope_deg)?;
    let scenario = scenario.scenario()?.value.clone();
    let found = listening(py, move |_| {
        let curve = AttitudeStudy::of(&scenario).curve()?;
        let record = |slope: &f64| AttitudeRecord::of(&curve, &scenario.rover, slope.to_radians());
        let records: Vec<AttitudeRecord> = slopes.iter().map(record).collect();
        Ok((records, AttitudeLimit::from(&curve)))
    })?;
    let (records, limit) = found.map_err(|error: ParameterError| errors::of_parameter(&error))?;
    Ok((columns(py, &records)?, limit.limit_slope_deg, limit.limit_reason))
}

/// The attitude over slope, course and soil: a row for each, slopes fastest, then courses.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn attitude_map<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    course_deg: PyReadonlyArray1<'py, f64>,
    speed_m_s: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let slopes = slopes(&slope_deg)?;
    let courses = course_deg.as_slice()?.to_vec();
    check("course_deg", &courses, &COURSE_DEG)?;
    check("speed_m_s", &[speed_m_s], &MAP_SPEED_M_S)?;
    let all = scenarios.iter().map(|scenario| scenario.scenario());
    let all = all.collect::<PyResult<Vec<_>>>()?;
    let soil_name = |scenario: &&document::LoadedScenario| {
        scenario.document.soil.inline().map_or("unnamed".to_owned(), |soil| soil.name.clone())
    };
    let names: Vec<String> = all.iter().map(soil_name).collect();
    let Some(rover) = all.first().map(|scenario| scenario.value.rover.clone()) else {
        let message = "there is no soil".to_owned();
        return Err(errors::parameter(message, "soil", None, "at least one soil"));
    };
    let studies: Vec<_> = all.iter().map(|scenario| AttitudeStudy::of(&scenario.value)).collect();
    let records = listening(py, move |_| {
        let radians = |list: &[f64]| list.iter().map(|it| it.to_radians()).collect::<Vec<f64>>();
        let map = AttitudeMap::of(&studies, &radians(&courses), &radians(&slopes))?;
        Ok(AttitudeMapRecord::of(&map, &names, &rover, speed_m_s))
    })?;
    let records = records.map_err(|error: ParameterError| errors::of_parameter(&error))?;
    columns(py, &records)
}

/// Slopes in their range.
fn slopes(slope_deg: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    let slopes = slope_deg.as_slice()?.to_vec();
    let range = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check("slope_deg", &slopes, &range)?;
    Ok(slopes)
}
