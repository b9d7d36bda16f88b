//! Studies of many entries: documents, soils and numbers that vary from entry to entry.

use std::collections::HashMap;

use grouser::document::columns::heading::{map_table, steepest, table};
use grouser::document::columns::{self, COURSE, OK, SLOPE, STATUS};
use grouser::document::study::{COURSE_DEG, MAP_SPEED_M_S};
use grouser::document::table::{Table, Values};
use grouser::document::{Plan, Problem};
use grouser::error::ParameterError;
use grouser::mission::MissionError;
use grouser::simulation::Scenario;
use grouser::studies::ensemble::outputs_while;
use grouser::studies::heading::{HeadingStudy, Steering};
use grouser::studies::heading_map::HeadingMap;
use grouser::studies::mission::DrivenMission;
use grouser::studies::wheel_speeds::{SpeedFreedom, WheelSpeedStudy, WheelSpeeds};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::errors;
use crate::interrupt::listening;
use crate::runs::{AskedRuns, RunBase, Runs};
use crate::studies::slopes;
use crate::wheels::check;

/// The table of a study, and one that stands beside it, such as what ends its slopes.
type StudyTables = [Table; 2];

/// Why an entry has no tables.
enum NoTables {
    /// Its numbers do not go together.
    Unfit(Box<Problem>),
    /// It cannot be computed.
    Failed(String),
}

impl<E: Into<Problem>> From<E> for NoTables {
    fn from(error: E) -> Self {
        Self::Unfit(Box::new(error.into()))
    }
}

/// The tables of some entries.
type Found = Result<Vec<StudyTables>, NoTables>;

/// Both tables, those of all entries one below the other: what an entry does not have is missing,
/// and its `status` says why.
type Swept<'py> = Vec<Bound<'py, PyDict>>;

/// A study of many entries, on all cores; in their order, whatever the threads did.
///
/// * `rows`: how many rows an entry has in each table
/// * `but_for`: the argument in which entries may differ that are computed together
/// * `study`: the tables of each of such entries
fn swept<'py, V: RunBase>(
    py: Python<'py>,
    asked: &AskedRuns<'py>,
    rows: [usize; 2],
    but_for: &str,
    study: impl Fn(&Runs<V>, &[usize]) -> Found + Send + Sync + 'static,
) -> PyResult<Swept<'py>> {
    let runs = Runs::<V>::new(asked)?;
    let (count, outside_is_nan) = (runs.count, runs.outside_is_nan);
    let mut entries: Vec<Result<StudyTables, String>> = Vec::with_capacity(count);
    let mut known: HashMap<Vec<u64>, usize> = HashMap::new();
    let mut alike: Vec<Vec<usize>> = Vec::new();
    for place in 0..count {
        let why = runs.why_none(place);
        if why.is_none() {
            let group = *known.entry(runs.bits_but_for(place, but_for)).or_insert(alike.len());
            if group == alike.len() {
                alike.push(Vec::new());
            }
            alike[group].push(place);
        }
        entries.push(Err(why.unwrap_or_default()));
    }
    let groups = alike.clone();
    let found = listening(py, move |cancelled| {
        if let Some(misfit) = runs.first_misfit().filter(|_| !outside_is_nan) {
            return Err(misfit);
        }
        let go_on = || !cancelled.is_set();
        let found = outputs_while(groups, &go_on, |places| study(&runs, &places));
        Ok(found.unwrap_or_default())
    })?;
    let found = found.map_err(|(place, problem)| errors::misfit_at(place, count, &problem))?;
    for (places, found) in alike.into_iter().zip(found) {
        let why = match found {
            Ok(tables) => {
                for (place, own) in places.into_iter().zip(tables) {
                    entries[place] = Ok(own);
                }
                continue;
            }
            Err(NoTables::Unfit(problem)) if !outside_is_nan => {
                return Err(errors::misfit_at(places[0], count, &problem));
            }
            Err(NoTables::Unfit(problem)) => problem.to_string(),
            Err(NoTables::Failed(why)) => why,
        };
        for place in places {
            entries[place] = Err(why.clone());
        }
    }
    let why = |entry: &Result<StudyTables, String>| entry.as_ref().err().cloned();
    let why: Vec<Option<String>> = entries.iter().map(why).collect();
    let (firsts, seconds): (Vec<Table>, Vec<Table>) =
        entries.into_iter().map(|it| it.unwrap_or_default().into()).unzip();
    let both = [firsts, seconds].into_iter().zip(rows);
    let tables = both.map(|(tables, rows)| with_status(Table::stacked(tables, rows), &why, rows));
    tables.map(|table| table_to_python(py, table)).collect()
}

/// With a `status` in every row: its own, or why the entry of the row is not there.
fn with_status(mut table: Table, why: &[Option<String>], rows: usize) -> Table {
    let own = table.columns.iter().position(|(name, _)| name == STATUS);
    let own = own.map(|place| table.columns.remove(place).1);
    let each = (0..why.len() * rows).map(|row| match (&why[row / rows], &own) {
        (Some(why), _) => Some(why.clone()),
        (None, Some(Values::Text(own))) => own[row].clone(),
        _ => Some(OK.to_owned()),
    });
    table.columns.push((STATUS.to_owned(), Values::Text(each.collect())));
    table
}

/// The slopes [rad] that an entry is asked for: its own where they vary, else those of all.
fn slopes_of(runs: &Runs<Scenario>, place: usize, slopes: &[f64]) -> Vec<f64> {
    let own = runs.has(SLOPE.name).then(|| runs.number(place, SLOPE.name)).flatten();
    own.map_or_else(|| slopes.to_vec(), |slope| SLOPE.in_si(&[slope]))
}

/// The tables of scenarios of which the first stands for all, but for their slopes [rad].
fn over_slopes<T>(
    runs: &Runs<Scenario>,
    places: &[usize],
    slopes: &[f64],
    study: impl FnOnce(Scenario) -> Result<T, NoTables>,
    tables: impl Fn(&T, &[f64]) -> Result<StudyTables, NoTables>,
) -> Found {
    let found = study(runs.value(places[0]).map_err(NoTables::Unfit)?)?;
    places.iter().map(|place| tables(&found, &slopes_of(runs, *place, slopes))).collect()
}

/// How many slopes an entry is asked for.
fn rows_of(asked: &AskedRuns<'_>, slopes: usize) -> PyResult<usize> {
    Ok(if asked.4.contains(SLOPE.name)? { 1 } else { slopes })
}

/// Warns of terrain that an answer about planes does not use.
fn on_planes(py: Python<'_>, asked: &AskedRuns<'_>) -> PyResult<()> {
    asked.0.iter().try_for_each(|scenario| scenario.scenario_on_planes(py).map(drop))
}

/// Headings: a row for each slope, and the steepest slope. Entries that differ in their slopes
/// alone share a curve.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn heading_sweep<'py>(
    py: Python<'py>,
    asked: AskedRuns<'py>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    steering: &str,
) -> PyResult<Swept<'py>> {
    let slopes = slopes(&slope_deg)?;
    let rows = [rows_of(&asked, slopes.len())?, 1];
    on_planes(py, &asked)?;
    let steering = Steering::ALL.into_iter().find(|it| it.name() == steering).unwrap_or_default();
    swept(py, &asked, rows, SLOPE.name, move |runs, places| {
        let curve = |scenario: Scenario| {
            let study = HeadingStudy { steering, ..HeadingStudy::of(&scenario) };
            Ok((study.curve()?, study.rover))
        };
        over_slopes(runs, places, &slopes, curve, |(curve, rover), slopes| {
            Ok([table(curve, rover, slopes), steepest(curve)])
        })
    })
}

/// Headings over course and slope: a row for each, slopes fastest.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn heading_map_sweep<'py>(
    py: Python<'py>,
    asked: AskedRuns<'py>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    course_deg: PyReadonlyArray1<'py, f64>,
    rim_speed_m_s: f64,
) -> PyResult<Swept<'py>> {
    let slopes = slopes(&slope_deg)?;
    check(COURSE.name, course_deg.as_slice()?, &COURSE_DEG)?;
    check("rim_speed_m_s", &[rim_speed_m_s], &MAP_SPEED_M_S)?;
    let courses = COURSE.in_si(course_deg.as_slice()?);
    let rows = [courses.len() * rows_of(&asked, slopes.len())?, 0];
    on_planes(py, &asked)?;
    swept(py, &asked, rows, SLOPE.name, move |runs, places| {
        let study = |scenario: Scenario| Ok(HeadingStudy::of(&scenario));
        over_slopes(runs, places, &slopes, study, |study, slopes| {
            let map = HeadingMap::of(std::slice::from_ref(study), &courses, slopes)?;
            let rows = map_table(&map, &[String::new()], &study.rover, rim_speed_m_s);
            Ok([rows, Table::default()])
        })
    })
}

/// Wheels at speeds of their own: a row for each slope and for which wheels have a speed in common;
/// and the steepest slopes.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how arrays come from Python")]
pub(crate) fn wheel_speeds_sweep<'py>(
    py: Python<'py>,
    asked: AskedRuns<'py>,
    slope_deg: PyReadonlyArray1<'py, f64>,
    most_speed_ratio: f64,
) -> PyResult<Swept<'py>> {
    let slopes = slopes(&slope_deg)?;
    let freedoms = SpeedFreedom::ALL.len();
    let rows = [freedoms * rows_of(&asked, slopes.len())?, freedoms + 1];
    on_planes(py, &asked)?;
    swept(py, &asked, rows, SLOPE.name, move |runs, places| {
        let speeds = |scenario: Scenario| {
            let heading = HeadingStudy::of(&scenario);
            let curve = heading.curve()?;
            let study = WheelSpeedStudy { heading, most_ratio: most_speed_ratio };
            let named = |error| ParameterError { name: "most_speed_ratio".to_owned(), ..error };
            Ok(WheelSpeeds::from(study, curve).map_err(named)?)
        };
        over_slopes(runs, places, &slopes, speeds, |found, slopes| {
            use columns::wheel_speeds::{limits, table};
            Ok([table(found, slopes), limits(found)])
        })
    })
}

/// Missions: a row for each alternative, and one for each leg of each, those that were not begun
/// with nothing. Only the ends are kept.
///
/// * `ways`, `legs`: how many alternatives there are, and legs of each at most
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how lists come from Python")]
pub(crate) fn mission_sweep<'py>(
    py: Python<'py>,
    asked: AskedRuns<'py>,
    ways: usize,
    legs: usize,
) -> PyResult<Swept<'py>> {
    swept(py, &asked, [ways, ways * legs], "", move |runs: &Runs<Plan>, places| {
        let plan = runs.value(places[0]).map_err(NoTables::Unfit)?;
        let ways = DrivenMission::all_ends(&plan.missions()).map_err(|error| match error {
            MissionError::Plan(error) => NoTables::from(error.source),
            MissionError::Run(error) => NoTables::Failed(error.to_string()),
        })?;
        let of_legs = Table::stacked(ways.iter().map(DrivenMission::table), legs);
        let tables = [DrivenMission::alternatives(&ways), of_legs];
        Ok(vec![tables; places.len()])
    })
}
