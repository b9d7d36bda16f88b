//! Runs and studies, each in a thread of its own so that Ctrl-C interrupts it.

use std::ops::RangeInclusive;

use grouser::answers::heading::HeadingQuestion;
use grouser::answers::{Answer, AnswerError, AnswerOptions, Member, Sampling};
use grouser::document::columns::flags::{self, FLAGS};
use grouser::document::columns::run::{
    ELECTRICAL, ELECTRICAL_RECORD, ENERGY_ERROR, RECORD, STANDING, STEERING_RECORD, WHEEL_RECORD,
    run_band, time_bands,
};
use grouser::document::columns::wheel::WHEEL;
use grouser::document::columns::{self, COURSE, LOAD, SINKAGE, SLIP_ANGLE, SLIP_RATIO, SLOPE};
use grouser::document::forecast as words;
use grouser::document::gradient::{GradientKeys, RunKeys};
use grouser::document::learn::contradiction;
use grouser::document::simulated_test::{NOISE, TRIALS};
use grouser::document::study::{self, COURSE_DEG, MAP_SPEED_M_S, SHARE};
use grouser::document::table::{BETWEEN_NAMES, Table};
use grouser::document::{self, Kind};
use grouser::error::ParameterError;
use grouser::simulation::{Run, RunError, Scenario, Trajectory, WheelRecord};
use grouser::soil::GravityScaling;
use grouser::studies::ensemble::NothingAccepted;
use grouser::studies::ensemble::models::{ModelSpread, Question};
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::forecast::{Choices, ForecastError, ForecastStudy, Ground};
use grouser::studies::heading::{HeadingStudy, Steering};
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::heading_map::HeadingMap;
use grouser::studies::measurement::PerQuantity;
use grouser::studies::simulated_test::SimulatedTest;
use grouser::studies::traverse_band::{TraverseBand, record_times};
use grouser::studies::validity::RoverOnSlope;
use grouser::studies::verdict::{Rule, Side, SlopeStudy};
use grouser::studies::wheel_speeds::{WheelSpeedStudy, WheelSpeeds};
use grouser::studies::wheel_test::WheelTest;
use numpy::{PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::errors;
use crate::gradients::{no_such_key, of_records};
use crate::interrupt::listening;
use crate::validation::record_to_python;
use crate::wheels::{check, column, model_and_gravity};

/// A run from its start to its end.
///
/// * `gradients`: keys of the numbers that its records are differentiated by
#[pyfunction]
#[pyo3(signature = (scenario, gradients=None))]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    scenario: &Document,
    gradients: Option<Vec<String>>,
) -> PyResult<Bound<'py, PyDict>> {
    let loaded = scenario.scenario()?;
    let names = wheel_names(&loaded.value);
    let keys = gradients.map(|names| RunKeys::of(loaded, &GradientKeys::of(&names)));
    let keys = keys.transpose().map_err(no_such_key)?;
    let (scenario, document, by) = (loaded.value.clone(), loaded.document.clone(), keys.clone());
    let (found, slopes, scenario) = listening(py, move |cancelled| {
        let found = run(&scenario);
        let slopes = by.zip(found.as_ref().ok()).and_then(|(keys, run)| {
            let (number, go_on) = (|key: &str| document.number(key), || !cancelled.is_set());
            keys.along(&scenario, &number, run, Run::to_end, &go_on)
        });
        (found, slopes, scenario)
    })?;
    let run = found.map_err(|error| errors::of_simulation(&error))?;
    let dict = trajectory_to_python(py, &run, &scenario, &names)?;
    if let (Some(keys), Some(slopes)) = (keys, slopes) {
        let of = |record: usize, key: usize, result: usize| slopes.at(record, result, key);
        let on_heights = !scenario.ground.is_plane();
        dict.set_item("gradient", of_records(py, &keys, on_heights, run.records.len(), of)?)?;
    }
    Ok(dict)
}

pub(crate) fn run(scenario: &Scenario) -> Result<Trajectory, RunError> {
    Run::new(scenario)?.to_end()
}

pub(crate) fn wheel_names(scenario: &Scenario) -> Vec<String> {
    scenario.rover.mounts().iter().map(|mount| mount.name.clone()).collect()
}

/// A trajectory: outcome and messages, columns over time, and columns over time and wheel.
pub(crate) fn trajectory_to_python<'py>(
    py: Python<'py>,
    run: &Trajectory,
    scenario: &Scenario,
    names: &[String],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("outcome", run.outcome.name())?;
    dict.set_item("reason", run.outcome.reason())?;
    dict.set_item("simulation", run.method.name())?;
    dict.set_item("simulation_reason", run.method.reason())?;
    dict.set_item(ENERGY_ERROR.name, ENERGY_ERROR.unit.from_si(run.energy_error()))?;
    dict.set_item("wheels", names)?;
    let rover = PyDict::new(py);
    for one in &RECORD {
        rover.set_item(one.name, column(py, run.records.iter().map(|it| one.number(it))))?;
    }
    if !scenario.ground.is_plane() {
        for one in &STANDING {
            rover.set_item(one.name, column(py, run.records.iter().map(|it| one.number(it))))?;
        }
    }
    dict.set_item("rover", rover)?;
    let (electrical, wheels) = (PyDict::new(py), each_wheel(py, run, names.len())?);
    if scenario.rover.has_motors() {
        for one in &ELECTRICAL_RECORD {
            let values = column(py, run.records.iter().map(|it| one.number(it)));
            electrical.set_item(one.name, values)?;
        }
        for one in &ELECTRICAL {
            wheels.set_item(one.name, of_wheels(py, run, names.len(), |it| one.number(it))?)?;
        }
    }
    if scenario.rover.is_steerable() {
        for one in &STEERING_RECORD {
            wheels.set_item(one.name, of_wheels(py, run, names.len(), |it| one.number(it))?)?;
        }
    }
    dict.set_item("electrical", electrical)?;
    dict.set_item("each_wheel", wheels)?;
    let each = columns::run::each_findings(run, scenario);
    let each = each.iter().map(|findings| flags::names(findings).join(BETWEEN_NAMES));
    dict.set_item(FLAGS, each.collect::<Vec<_>>())?;
    let over = RoverOnSlope::of(scenario).over(run);
    let raised = over.iter().map(|it| (it.finding.flag.name(), it.time));
    dict.set_item("flags_raised", raised.collect::<Vec<_>>())?;
    Ok(dict)
}

/// Arrays of a row for each record and a column for each wheel; NaN where a rover has just tipped
/// over or sunk.
fn each_wheel<'py>(
    py: Python<'py>,
    run: &Trajectory,
    count: usize,
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (name, get) in wheel_sample_columns() {
        dict.set_item(name, of_wheels(py, run, count, get)?)?;
    }
    Ok(dict)
}

/// One of these arrays.
fn of_wheels<'py>(
    py: Python<'py>,
    run: &Trajectory,
    count: usize,
    number: impl Fn(&WheelRecord) -> f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rows = run.records.iter().map(|sample| {
        (0..count).map(|k| sample.wheels.get(k).map_or(f64::NAN, &number)).collect::<Vec<f64>>()
    });
    Ok(PyArray2::from_vec2(py, &rows.collect::<Vec<_>>())?)
}

/// A number of a wheel at one time.
type WheelNumber = Box<dyn Fn(&WheelRecord) -> f64>;

/// The columns of a wheel at one time: its own, then its results.
pub(crate) fn wheel_sample_columns() -> impl Iterator<Item = (&'static str, WheelNumber)> {
    let own = WHEEL_RECORD.iter().map(|it| {
        let number: WheelNumber = Box::new(|wheel| it.number(wheel));
        (it.name, number)
    });
    let results = WHEEL.iter().map(|it| {
        let number: WheelNumber = Box::new(|wheel| it.number(&wheel.reaction.settled));
        (it.name, number)
    });
    own.chain(results)
}

/// The heading that holds the contour on each slope: a table as the program has it, the steepest
/// slope as a row, and with samples what is believed of the soil.
type Headings<'py> = (Bound<'py, PyDict>, Bound<'py, PyAny>, Bound<'py, PyAny>);

/// The heading that holds the contour on each slope.
///
/// * `sampling`: number of samples, and their seed; without it the soil as written and one model
/// * `rule`: the limits of the verdicts, in the order of [`Rule`]'s fields
/// * `gradients`: keys of the numbers that results are differentiated by
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn heading<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
    steering: &str,
    sampling: Option<(u32, u64)>,
    rule: [f64; 5],
    gradients: Option<Vec<String>>,
) -> PyResult<Headings<'py>> {
    slopes(&slope_deg)?;
    if let Some((samples, _)) = sampling {
        check("samples", &[f64::from(samples)], &SAMPLES)?;
    }
    let scenario = scenario.scenario_on_planes(py)?;
    let is_believed = sampling.is_some() && scenario.soils_of_bands().is_some();
    if gradients.is_some() && is_believed {
        let message = "gradients are of the soil as its document has it, with one model, and this \
                       soil is uncertain: ask for that answer by nominal=True";
        return Err(errors::parameter(message.to_owned(), "gradients", None, "nominal=True"));
    }
    let sampling = sampling.filter(|_| gradients.is_none());
    let steering = Steering::ALL.into_iter().find(|it| it.name() == steering).unwrap_or_default();
    let question = HeadingQuestion {
        scenarios: vec![scenario.clone()],
        slopes_deg: slope_deg.as_slice()?.to_vec(),
        steering,
        most_speed_ratio: None,
        sampling: sampling.map(|(count, seed)| Sampling { count, seed }),
        rule: rule_of(rule)?,
        gradients: gradients.map(|keys| GradientKeys::of(&keys)),
    };
    let found = listening(py, move |cancelled| {
        let go_on = || !cancelled.is_set();
        question.answer("heading", &AnswerOptions { go_on: &go_on, ..AnswerOptions::ROWS })
    })?;
    let answer = match found {
        // Who stopped it gets the signal, and no answer.
        Err(AnswerError::Stopped) => Answer::default(),
        found => found.map_err(|error| of_answer(&error))?,
    };
    let rows = answer.tables.first().map(|(_, rows)| Table::clone(rows)).unwrap_or_default();
    let limit = answer.results.iter().find_map(|it| match it {
        Member::Row(None, limit) => Some(limit),
        _ => None,
    });
    let limit = record_to_python(py, &limit.map(|it| it.row(0)))?;
    Ok((table_to_python(py, rows)?, limit, record_to_python(py, &answer.belief)?))
}

/// The limits of the verdicts.
fn rule_of(rule: [f64; 5]) -> PyResult<Rule> {
    let [go_slip_ratio, go_probability, go_drift_m_per_m, no_go_slip_ratio, no_go_probability] =
        rule;
    let rule = Rule {
        go_slip_ratio,
        go_probability,
        go_drift_m_per_m,
        no_go_slip_ratio,
        no_go_probability,
    };
    rule.check().map_err(|error| errors::of_parameter(&error))?;
    Ok(rule)
}

fn of_answer(error: &AnswerError) -> PyErr {
    match error {
        AnswerError::Parameter(error) => errors::of_parameter(error),
        AnswerError::Samples(error) => Problem::Sampling(*error).raised(),
        AnswerError::Key(error) => {
            errors::parameter(error.to_string(), "gradients", None, "the key of a number")
        }
        other => errors::parameter(other.to_string(), "steering", None, "one of them"),
    }
}

/// Wheels at speeds of their own: a row for each slope and for which wheels have a speed in common,
/// the steepest slopes, and the wheels' names.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn wheel_speeds<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
    most_speed_ratio: f64,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>, Vec<String>)> {
    let slopes = slopes(&slope_deg)?;
    let scenario = scenario.scenario_on_planes(py)?.value.clone();
    let names = wheel_names(&scenario);
    let found = listening(py, move |cancelled| {
        let heading = HeadingStudy::of(&scenario);
        let curve = heading.curve()?;
        let study = WheelSpeedStudy { heading, most_ratio: most_speed_ratio };
        let found = WheelSpeeds::from(study, curve)
            .map_err(|error| ParameterError { name: "most_speed_ratio".to_owned(), ..error })?;
        let mut table = columns::wheel_speeds::table(&found, &[]);
        for (place, slope) in slopes.iter().enumerate() {
            if cancelled.is_set() {
                break;
            }
            let rows = columns::wheel_speeds::table(&found, std::slice::from_ref(slope));
            if place == 0 { table = rows } else { table.append(rows) }
        }
        Ok((table, columns::wheel_speeds::limits(&found)))
    })?;
    let (table, limits) = found.map_err(|error: ParameterError| errors::of_parameter(&error))?;
    Ok((table_to_python(py, table)?, table_to_python(py, limits)?, names))
}

/// The heading offset over slope, course and soil: a row for each, slopes fastest, then courses.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn heading_map<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    course_deg: PyReadonlyArray1<'py, f64>,
    rim_speed_m_s: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let slopes = slopes(&slope_deg)?;
    check(COURSE.name, course_deg.as_slice()?, &COURSE_DEG)?;
    let courses = COURSE.in_si(course_deg.as_slice()?);
    check("rim_speed_m_s", &[rim_speed_m_s], &MAP_SPEED_M_S)?;
    let all = scenarios.iter().map(|scenario| scenario.scenario_on_planes(py));
    let all = all.collect::<PyResult<Vec<_>>>()?;
    let soil_name = |scenario: &&document::LoadedScenario| {
        scenario.document.text("soil.name").unwrap_or("unnamed").to_owned()
    };
    let names: Vec<String> = all.iter().map(soil_name).collect();
    let Some(rover) = all.first().map(|scenario| scenario.value.rover.clone()) else {
        let message = "there is no soil".to_owned();
        return Err(errors::parameter(message, "soil", None, "at least one soil"));
    };
    let studies: Vec<_> = all.iter().map(|scenario| HeadingStudy::of(&scenario.value)).collect();
    let table = listening(py, move |cancelled| {
        let nothing = HeadingMap { slopes: Vec::new(), rows: Vec::new() };
        let mut table = columns::heading::map_table(&nothing, &[], &rover, rim_speed_m_s);
        for (study, name) in studies.iter().zip(&names) {
            for courses in courses.chunks(COURSES) {
                if cancelled.is_set() {
                    return Ok(table);
                }
                let map = HeadingMap::of(std::slice::from_ref(study), courses, &slopes)?;
                let name = std::slice::from_ref(name);
                table.append(columns::heading::map_table(&map, name, &rover, rim_speed_m_s));
            }
        }
        Ok(table)
    })?;
    table_to_python(py, table.map_err(|error: ParameterError| errors::of_parameter(&error))?)
}

/// Statistics over samples of soil and model for each soil, course and slope of a map, in the order
/// of its rows, and the weights of the models for each soil.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn heading_map_band<'py>(
    py: Python<'py>,
    scenarios: Vec<PyRef<'py, Document>>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    course_deg: PyReadonlyArray1<'py, f64>,
    seed: u64,
    samples: u32,
) -> PyResult<(Bound<'py, PyDict>, Vec<Bound<'py, PyDict>>)> {
    let slopes = slopes(&slope_deg)?;
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    check(COURSE.name, course_deg.as_slice()?, &COURSE_DEG)?;
    let courses = COURSE.in_si(course_deg.as_slice()?);
    let question = Question::of_all(courses.iter().map(|course| Question::on_course(*course)));
    let all = scenarios.iter().map(|scenario| {
        let scenario = scenario.scenario()?;
        let inputs = BandInputs::of_scenario(scenario).asked(question);
        Ok((HeadingStudy::of(&scenario.value), inputs))
    });
    let all = all.collect::<PyResult<Vec<_>>>()?;
    let weights: Vec<_> = all.iter().map(|(_, inputs)| inputs.models().clone()).collect();
    let found = listening(py, move |cancelled| {
        let go_on = || !cancelled.is_set();
        let mut bands = Vec::new();
        for (study, inputs) in &all {
            let samples = inputs.samples(seed, samples).map_err(Problem::Sampling)?;
            for course in &courses {
                let band = HeadingBand::on_course(study, *course, &samples, &slopes, &go_on);
                bands.extend(band.map_err(Problem::Parameter)?);
            }
        }
        Ok(columns::heading::map_with_bands(Table::default(), &bands))
    })?;
    let table = table_to_python(py, found.map_err(|problem: Problem| problem.raised())?)?;
    let weights = weights.iter().map(|it| weights_to_python(py, it));
    Ok((table, weights.collect::<PyResult<_>>()?))
}

/// Statistics over samples of soil and model for each setting of a test stand: slip ratios fastest,
/// then slip angles, loads.
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arrays, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn wheel_test_band<'py>(
    py: Python<'py>,
    soil: &Document,
    wheel: &Document,
    setting: &Document,
    load_n: PyReadonlyArray1<'py, f64>,
    slip_angle_deg: PyReadonlyArray1<'py, f64>,
    slip_ratio: PyReadonlyArray1<'py, f64>,
    seed: u64,
    samples: u32,
) -> PyResult<Bound<'py, PyDict>> {
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    let test = plan(soil, wheel, setting, &load_n, &slip_angle_deg, &slip_ratio)?;
    let named = setting.scenario()?.document.model();
    let angles = test.slip_angles.iter().map(|angle| Question::at_slip_angle(*angle));
    let inputs = BandInputs::of_soil(soil.soil()?, named).asked(Question::of_all(angles));
    let weights = inputs.models().clone();
    let found = listening(py, move |cancelled| {
        let samples = inputs.samples(seed, samples).map_err(Problem::Sampling)?;
        let bands = test.bands(&samples, &|| !cancelled.is_set()).unwrap_or_default();
        Ok(columns::wheel_test::with_bands(Table::default(), &bands))
    })?;
    let table = found.map_err(|problem: Problem| problem.raised())?;
    with_weights(table_to_python(py, table)?, &weights)
}

/// Statistics over samples of soil and model: of a run over time, and of its end and means.
#[pyfunction]
pub(crate) fn simulate_band<'py>(
    py: Python<'py>,
    scenario: &Document,
    seed: u64,
    samples: u32,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    let scenario = scenario.scenario()?;
    let inputs = BandInputs::of_scenario(scenario);
    let weights = inputs.models().clone();
    let scenario = scenario.value.clone();
    let ran = scenario.clone();
    let found = listening(py, move |cancelled| {
        let scenario = ran;
        let samples = inputs.samples(seed, samples).map_err(Problem::Sampling)?;
        let times = record_times(&run(&scenario).map_err(Problem::Run)?, &scenario);
        let go_on = || !cancelled.is_set();
        TraverseBand::of(&scenario, &samples, &times, &go_on).map_err(Problem::Run)
    })?;
    let band = found.map_err(|problem| problem.raised())?;
    let times = time_bands(band.as_ref().map_or(&[], |band| &band.times), &scenario);
    let run = band.map(|band| run_band(&band.run, &scenario));
    let times = with_weights(table_to_python(py, times)?, &weights)?;
    Ok((times, record_to_python(py, &run.as_ref().map(|it| it.row(0)))?))
}

/// A table with the weights of the models whose samples it is of.
fn with_weights<'py>(
    table: Bound<'py, PyDict>,
    weights: &ModelSpread,
) -> PyResult<Bound<'py, PyDict>> {
    table.set_item("model_weights", weights_to_python(table.py(), weights)?)?;
    Ok(table)
}

/// The models of samples, each with its share [-].
fn weights_to_python<'py>(py: Python<'py>, weights: &ModelSpread) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    for (model, share) in weights.shares() {
        dict.set_item(model.name(), share)?;
    }
    Ok(dict)
}

/// The operator's card over samples of soil and model: its rows, the other courses, and the
/// steepest slope.
///
/// * `rule`: the limits of the verdicts, in the order of [`Rule`]'s fields
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn card<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
    seed_and_samples: (u64, u32),
    rim_speed_m_s: Option<f64>,
    is_uphill_right_holds_heading_accepts_contradiction: (bool, bool, bool),
    rule: [f64; 5],
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>, Bound<'py, PyAny>)> {
    let slopes = slopes(&slope_deg)?;
    let (seed, samples) = seed_and_samples;
    let (is_uphill_right, holds_heading, accepts_contradiction) =
        is_uphill_right_holds_heading_accepts_contradiction;
    check("samples", &[f64::from(samples)], &SAMPLES)?;
    let scenario = scenario.scenario_on_planes(py)?;
    if let Some(why) = contradiction(&scenario.document).filter(|_| !accepts_contradiction) {
        let message = format!("{why}; accept_contradiction=True takes it as it is");
        return Err(errors::parameter(message, "soil", None, "a soil without contradictions"));
    }
    let rim_speed = rim_speed_m_s.unwrap_or_else(|| scenario.value.drive.nominal_rim_speed());
    check("rim_speed_m_s", &[rim_speed], &MAP_SPEED_M_S)?;
    let uphill = if is_uphill_right { Side::Right } else { Side::Left };
    let rule = rule_of(rule)?;
    let study = SlopeStudy::of(scenario).with_uphill(uphill);
    let study = SlopeStudy { rim_speed, rule, holds_heading, ..study };
    let inputs = BandInputs::of_scenario(scenario);
    let loaded = scenario.clone();
    let found = listening(py, move |cancelled| {
        let go_on = || !cancelled.is_set();
        let sampling = Sampling { count: samples, seed };
        let samples = sampling.draw_if_uncertain(&inputs).map_err(Problem::Sampling)?;
        let card = study.card(&samples, &slopes, &go_on).map_err(Problem::Parameter)?;
        let Some(card) = card else { return Ok(None) };
        let courses = study.courses(&card.rows, &samples, &go_on).map_err(Problem::Parameter)?;
        let steepest = columns::card::steepest(&card, &loaded, &study, uphill);
        Ok(courses.map(|courses| (card, courses, steepest)))
    })?;
    let Some((card, courses, steepest)) = found.map_err(|problem: Problem| problem.raised())?
    else {
        return Ok((PyDict::new(py), PyDict::new(py), py.None().into_bound(py)));
    };
    Ok((
        table_to_python(py, columns::card::table(&card))?,
        table_to_python(py, columns::card_courses::table(&courses))?,
        record_to_python(py, &Some(steepest.row(0)))?,
    ))
}

/// The limits of [`Rule::DEFAULT`] by their names.
#[pyfunction]
pub(crate) fn card_rule(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    record_to_python(py, &Rule::DEFAULT)
}

/// A gravity [m/s²] by its name, or as a number in a text.
#[pyfunction]
pub(crate) fn gravity_of(text: &str) -> Option<f64> {
    words::gravity_of(text)
}

/// The choices of a forecast: whose ground it is, each by its name, with a soil where it is not the
/// one that was measured; and names of scalings and of masses, with factors as `NAME=FACTOR`.
type ChoiceNames<'py> =
    (Option<Vec<(String, Option<PyRef<'py, Document>>)>>, Vec<String>, Vec<String>);

/// A forecast under the scenario's gravity: its rows, steepest slope, budget, choices, tests and
/// notes.
///
/// * `counts`: samples of the soil, and of what a model gets wrong
#[pyfunction]
#[allow(clippy::too_many_arguments, reason = "arguments, as they come from Python")]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn forecast<'py>(
    py: Python<'py>,
    scenario: &Document,
    slope_deg: PyReadonlyArray1<'py, f64>,
    measured_gravity_m_s2: Option<f64>,
    choices: ChoiceNames<'py>,
    rim_speed_m_s: Option<f64>,
    no_go_slip_ratio: f64,
    counts: [u32; 2],
    seed: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let slopes = slopes(&slope_deg)?;
    let scenario = scenario.scenario_on_planes(py)?;
    if let Some(gravity) = measured_gravity_m_s2 {
        check("measured_gravity_m_s2", &[gravity], &words::GRAVITY)?;
    }
    for (name, count, most) in
        [("samples", counts[0], words::SAMPLES), ("discrepancies", counts[1], words::DISCREPANCIES)]
    {
        let range = f64::from(*most.start())..=f64::from(*most.end());
        check(name, &[f64::from(count)], &range)?;
    }
    let usual = words::study_of(scenario, measured_gravity_m_s2);
    let (grounds, scalings, masses) = choices;
    let grounds = match grounds {
        Some(grounds) => grounds.iter().map(ground_of).collect::<PyResult<Vec<_>>>()?,
        None => usual_grounds(&usual)?,
    };
    let scalings = scalings.iter().map(|name| scaling_of(name)).collect::<PyResult<Vec<_>>>()?;
    let ratio = usual.heading.gravity / usual.measured_under;
    let mass = |text: &String| {
        words::mass_of(text, ratio).map_err(|why| {
            errors::parameter(format!("mass: {why}"), "mass", None, words::MASSES.join(", "))
        })
    };
    let masses = masses.iter().map(mass).collect::<PyResult<Vec<_>>>()?;
    let rim_speed = rim_speed_m_s.unwrap_or(usual.rim_speed);
    check("rim_speed_m_s", &[rim_speed], &MAP_SPEED_M_S)?;
    check("no_go_slip_ratio", &[no_go_slip_ratio], &SHARE)?;
    let choices = Choices { scalings, grounds, masses };
    let samples = counts;
    let study = ForecastStudy { rim_speed, no_go_slip_ratio, choices, samples, seed, ..usual };
    let band = BandInputs::of_scenario(scenario);
    let notes = words::notes(&study, scenario, measured_gravity_m_s2.is_some());
    let found = listening(py, move |cancelled| {
        study.run(&band, &slopes, &|| !cancelled.is_set()).map_err(|error| match error {
            ForecastError::Parameter(error) => Problem::Parameter(error),
            ForecastError::NothingAccepted(error) => Problem::Sampling(error),
            ForecastError::NotFound(_) => Problem::NotFound(error.to_string()),
        })
    })?;
    let dict = PyDict::new(py);
    let Some(found) = found.map_err(|problem| problem.raised())? else { return Ok(dict) };
    use columns::forecast as tables;
    dict.set_item("rows", table_to_python(py, tables::table(&found))?)?;
    dict.set_item("steepest", table_to_python(py, tables::steepest(&found))?)?;
    dict.set_item("budget", table_to_python(py, tables::budget(&found))?)?;
    dict.set_item("choices", table_to_python(py, tables::choices(&found))?)?;
    dict.set_item("tests", table_to_python(py, tables::tests(&found))?)?;
    dict.set_item("notes", notes)?;
    Ok(dict)
}

fn ground_of((name, soil): &(String, Option<PyRef<'_, Document>>)) -> PyResult<Ground> {
    match soil {
        Some(soil) => Ok(Ground::of_soil(name, soil.soil()?)),
        None => Ok(Ground::AsMeasured),
    }
}

fn usual_grounds(study: &ForecastStudy) -> PyResult<Vec<Ground>> {
    let ground = |name: &&str| {
        if *name == words::AS_MEASURED {
            return Ok(Ground::AsMeasured);
        }
        let soil = document::Source::find(Kind::Soil, name)
            .and_then(|source| document::read_soil(&source, &document::Overrides::none()));
        soil.map(|soil| Ground::of_soil(name, &soil))
            .map_err(|error| errors::of_document(&error, &[]))
    };
    words::usual_grounds(study).iter().map(ground).collect()
}

fn scaling_of(name: &str) -> PyResult<GravityScaling> {
    words::scaling_of(name).ok_or_else(|| {
        let known = GravityScaling::ALL.map(GravityScaling::name).join(", ");
        let message = format!("scaling has {name:?}, it must be of {known}");
        errors::parameter(message, "scaling", None, known)
    })
}

/// How many samples may be asked for.
pub(crate) const SAMPLES: RangeInclusive<f64> = 2.0..=1e5;

/// Why there is no band.
pub(crate) enum Problem {
    Sampling(NothingAccepted),
    Parameter(ParameterError),
    Run(RunError),
    /// A search gave up: a failure of the computation, with its reason.
    NotFound(String),
}

impl Problem {
    pub(crate) fn raised(&self) -> PyErr {
        match self {
            Self::Sampling(error) => {
                let message = format!("the soil's uncertainty reaches too far: {error}");
                errors::parameter(message, "uncertainty", None, "smaller standard deviations")
            }
            Self::Parameter(error) => errors::of_parameter(error),
            Self::Run(error) => errors::of_simulation(error),
            Self::NotFound(reason) => errors::not_found(reason),
        }
    }
}

/// The plan of a test stand.
fn plan(
    soil: &Document,
    wheel: &Document,
    setting: &Document,
    load_n: &PyReadonlyArray1<'_, f64>,
    slip_angle_deg: &PyReadonlyArray1<'_, f64>,
    slip_ratio: &PyReadonlyArray1<'_, f64>,
) -> PyResult<WheelTest> {
    let (model, gravity) = model_and_gravity(soil, setting)?;
    check(LOAD.name, load_n.as_slice()?, &study::LOAD_N)?;
    check(SLIP_ANGLE.name, slip_angle_deg.as_slice()?, &study::SLIP_ANGLE_DEG)?;
    check(SLIP_RATIO.name, slip_ratio.as_slice()?, &study::SLIP_RATIO)?;
    let test = WheelTest {
        wheel: wheel.wheel()?.value,
        soil: soil.soil()?.value,
        gravity,
        model,
        loads: load_n.as_slice()?.to_vec(),
        slip_angles: SLIP_ANGLE.in_si(slip_angle_deg.as_slice()?),
        slip_ratios: slip_ratio.as_slice()?.to_vec(),
    };
    test.check().map_err(|error| errors::of_parameter(&error))?;
    Ok(test)
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
    let plan = plan(soil, wheel, setting, &load_n, &slip_angle_deg, &slip_ratio)?;
    check("trials", &[trials as f64], &TRIALS)?;
    for (name, deviation) in ["noise_n", "noise_mm", "noise_nm"].into_iter().zip(noise) {
        check(name, &[deviation], &NOISE)?;
    }
    let [forces, sinkage, torque] = noise;
    let test = SimulatedTest {
        plan,
        trials,
        noise: PerQuantity {
            drawbar_pull: forces,
            side_force: forces,
            sinkage: SINKAGE.unit.to_si(sinkage),
            torque,
        },
        seed,
    };
    table_to_python(py, listening(py, move |_| columns::stand::table(&test.run()))?)
}

/// Courses of a map between two checks for signals: they take a part of a second.
const COURSES: usize = 64;

/// Slopes in their range [rad].
pub(crate) fn slopes(slope_deg: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    let range = document::range(Kind::Scenario, SLOPE.name).unwrap_or(0.0..=60.0);
    check(SLOPE.name, slope_deg.as_slice()?, &range)?;
    Ok(SLOPE.in_si(slope_deg.as_slice()?))
}
