//! Runs and studies: each in a thread of its own, so that Ctrl-C is heard.

use std::ops::{ControlFlow, RangeInclusive};

use grouser::document::simulated_test::{NOISE, SimulatedTrialRecord, TRIALS};
use grouser::document::study::{
    self, AttitudeBandLimit, AttitudeBandRecord, AttitudeLimit, AttitudeMapRecord, AttitudeRecord,
    COURSE_DEG, MAP_SPEED_M_S,
};
use grouser::document::trajectory::{SampleRecord, TrajectoryRecord, WheelSampleRecord};
use grouser::document::{self, Kind};
use grouser::error::ParameterError;
use grouser::simulation::{Run, RunError, Scenario, Trajectory};
use grouser::soil::Soil;
use grouser::studies::attitude::AttitudeStudy;
use grouser::studies::attitude_band::AttitudeBand;
use grouser::studies::attitude_map::AttitudeMap;
use grouser::studies::measurement::PerQuantity;
use grouser::studies::simulated_test::SimulatedTest;
use grouser::studies::wheel_test::WheelTest;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::{WHEEL_COLUMNS, columns, wheel_row};
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::validation::in_words;
use crate::wheels::{check, column, theory_and_gravity};

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

pub(crate) fn run(scenario: &Scenario) -> Result<Trajectory, RunError> {
    Run::new(scenario)?.to_end()
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
        scenario.document.text("soil.name").unwrap_or("unnamed").to_owned()
    };
    let names: Vec<String> = all.iter().map(soil_name).collect();
    let Some(rover) = all.first().map(|scenario| scenario.value.rover.clone()) else {
        let message = "there is no soil".to_owned();
        return Err(errors::parameter(message, "soil", None, "at least one soil"));
    };
    let studies: Vec<_> = all.iter().map(|scenario| AttitudeStudy::of(&scenario.value)).collect();
    let records = listening(py, move |cancelled| {
        let radians = |list: &[f64]| list.iter().map(|it| it.to_radians()).collect::<Vec<f64>>();
        let (courses, slopes) = (radians(&courses), radians(&slopes));
        let mut records = Vec::new();
        for (study, name) in studies.iter().zip(&names) {
            for courses in courses.chunks(COURSES) {
                if cancelled.is_set() {
                    return Ok(Vec::new());
                }
                let map = AttitudeMap::of(std::slice::from_ref(study), courses, &slopes)?;
                let name = std::slice::from_ref(name);
                records.extend(AttitudeMapRecord::of(&map, name, &rover, speed_m_s));
            }
        }
        Ok(records)
    })?;
    let records = records.map_err(|error: ParameterError| errors::of_parameter(&error))?;
    columns(py, &records)
}

/// What the draws of the soil's uncertainty say on each slope, and of the steepest slope.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn attitude_band<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
    seed: u64,
    samples: u32,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let slopes = slopes(&slope_deg)?;
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    let scenario = scenario.scenario()?;
    let Some(uncertain) = scenario.uncertain.clone() else {
        let message = "the soil does not say how well its values are known".to_owned();
        let expected = "a soil with an `uncertainty`, such as toyoura-uncertain";
        return Err(errors::parameter(message, "uncertainty", None, expected));
    };
    let study = AttitudeStudy::of(&scenario.value);
    let found = listening(py, move |cancelled| {
        let draw = |index| uncertain.draw(seed, u64::from(index));
        let soils: Vec<Soil> =
            (0..samples).map(draw).collect::<Result<_, _>>().map_err(|error| {
                let message = format!("the soil's uncertainty reaches too far: {error}");
                Problem::Draws(message)
            })?;
        let slopes: Vec<f64> = slopes.iter().map(|slope| slope.to_radians()).collect();
        let go_on = || {
            if cancelled.is_set() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        AttitudeBand::of(&study, &soils, &slopes, &go_on).map_err(Problem::Parameter)
    })?;
    let band = found.map_err(|problem| match problem {
        Problem::Draws(message) => {
            errors::parameter(message, "uncertainty", None, "smaller standard deviations")
        }
        Problem::Parameter(error) => errors::of_parameter(&error),
    })?;
    let records = band.iter().flat_map(|band| &band.slopes).map(AttitudeBandRecord::from);
    let limit = band.as_ref().map(AttitudeBandLimit::from);
    Ok((columns(py, &records.collect::<Vec<_>>())?, in_words(py, &limit)?))
}

/// Draws that may be asked for.
const SAMPLES: RangeInclusive<f64> = 2.0..=1e5;

/// Why there is no band.
enum Problem {
    Draws(String),
    Parameter(ParameterError),
}

/// A wheel test on a simulated stand: a row for each run of each setting, runs fastest, then slip
/// ratios, slip angles, loads.
///
/// * `noise`: standard deviations of forces [N], sinkage [mm] and torque [N·m]
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn simulated_wheel_test<'py>(
    py: Python<'py>,
    soil: &Document,
    wheel: &Document,
    setting: &Document,
    load_n: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    trials: usize,
    noise: [f64; 3],
    seed: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let (theory, gravity) = theory_and_gravity(soil, setting)?;
    check("load_n", load_n.as_slice()?, &study::LOAD_N)?;
    check("slip_angle_deg", slip_angle_deg.as_slice()?, &study::SLIP_ANGLE_DEG)?;
    check("slip_ratio", slip_ratio.as_slice()?, &study::SLIP_RATIO)?;
    check("trials", &[trials as f64], &TRIALS)?;
    for (name, deviation) in ["noise_n", "noise_mm", "noise_nm"].into_iter().zip(noise) {
        check(name, &[deviation], &NOISE)?;
    }
    let [forces, sinkage, torque] = noise;
    let test = SimulatedTest {
        plan: WheelTest {
            wheel: wheel.wheel()?.value,
            soil: soil.soil()?.value,
            gravity,
            theory,
            loads: load_n.as_slice()?.to_vec(),
            slip_angles: slip_angle_deg.as_slice()?.iter().map(|it| it.to_radians()).collect(),
            slip_ratios: slip_ratio.as_slice()?.to_vec(),
        },
        trials,
        noise: PerQuantity {
            drawbar_pull: forces,
            side_force: forces,
            sinkage: sinkage * 1e-3,
            torque,
        },
        seed,
    };
    let records: Vec<SimulatedTrialRecord> =
        listening(py, move |_| test.run().iter().map(SimulatedTrialRecord::from).collect())?;
    columns(py, &records)
}

/// Courses of a map between two looks for signals: a part of a second.
const COURSES: usize = 64;

/// Slopes in their range.
fn slopes(slope_deg: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    let slopes = slope_deg.as_slice()?.to_vec();
    let range = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check("slope_deg", &slopes, &range)?;
    Ok(slopes)
}
