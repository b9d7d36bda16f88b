//! Routes: the cheapest way over a map of heights, or what a given one takes.

use std::path::PathBuf;
use std::sync::Arc;

use grouser::answers::Sampling;
use grouser::document::columns::YAW;
use grouser::document::route::RouteRecord;
use grouser::document::study::{MAP_SPEED_M_S, MOST_SLOPE_DEG, SHARE, START_YAW_DEG};
use grouser::document::unit::less_whole_turns;
use grouser::mission::MissionError;
use grouser::simulation::Scenario;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mobility::Ground;
use grouser::studies::route::{
    Answer, DrivenRoute, Ends, Limits, Line, LineError, Objective, Route, RouteError, RouteStudy,
};
use grouser::studies::verdict::SlopeStudy;
use grouser::units::Vec2;
use grouser_raster::{MapFrame, Raster};
use pyo3::prelude::*;

use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::maps::raster_of;
use crate::studies::{Problem, SAMPLES};
use crate::terrain::Terrain;
use crate::validation::record_to_python;
use crate::wheels::check;

/// Where ways lead.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Task {
    /// Ends of the way, which are there if no line is.
    from_m: Option<[f64; 2]>,
    to_m: Option<[f64; 2]>,
    /// The places of a given line, or the file that has it.
    along: Option<Vec<[f64; 2]>>,
    along_file: Option<PathBuf>,
    /// What the ways have least of, by name.
    minimise: Vec<String>,
    yaw_deg: Option<f64>,
    keep_out: Option<PathBuf>,
    most_slope_deg: Option<f64>,
    most_slip_ratio: Option<f64>,
    most_no_go: Option<f64>,
    /// Whether the ways are driven by simulation, too.
    drive: bool,
    rim_speed_m_s: Option<f64>,
    samples: u32,
    seed: u64,
}

/// A way that has least of each of several things, as the program writes it.
#[pyfunction]
#[pyo3(signature = (scenario, terrain, task))]
pub(crate) fn routes<'py>(
    py: Python<'py>,
    scenario: &Document,
    terrain: &Terrain,
    task: Task,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    check("samples", &[f64::from(task.samples)], &SAMPLES)?;
    let loaded = scenario.scenario()?;
    let raster = raster_of(terrain);
    let frame = MapFrame { system: terrain.map.system.as_ref(), extent: raster.grid.extent() };
    let study = study(py, &task, SlopeStudy::of(loaded), &frame)?;
    let line = line(py, &task, &frame)?;
    let objectives =
        task.minimise.iter().map(|it| objective(it)).collect::<PyResult<Vec<Objective>>>()?;
    let (inputs, scenario) = (BandInputs::of_scenario(loaded), loaded.value.clone());
    let records = listening(py, move |cancelled| {
        let sought = Sought {
            task: &task,
            line: line.as_ref(),
            study: &study,
            raster: &raster,
            scenario: &scenario,
        };
        sought.records(&objectives, &inputs, &|| !cancelled.is_set())
    })?;
    let records = records.map_err(|failure| failure.raised())?;
    records.iter().map(|record| record_to_python(py, record)).collect()
}

/// What is sought, and where.
struct Sought<'a> {
    task: &'a Task,
    line: Option<&'a Line>,
    study: &'a RouteStudy,
    raster: &'a Raster,
    scenario: &'a Scenario,
}

impl Sought<'_> {
    /// A record for each objective.
    fn records(
        &self,
        objectives: &[Objective],
        inputs: &BandInputs,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<RouteRecord>, Failure> {
        let Task { samples, seed, .. } = *self.task;
        let ground = Ground::under(&self.study.mobility.heading.rover, self.raster);
        let ends = Ends {
            from: self.task.from_m.unwrap_or_default().into(),
            to: self.task.to_m.unwrap_or_default().into(),
            yaw: self.task.yaw(),
        };
        match self.line {
            Some(line) => line.check(ground)?,
            None => ends.check(ground)?,
        }
        let sampling = Sampling { count: samples, seed };
        let samples = sampling.draw_if_uncertain(inputs).map_err(Problem::Sampling)?;
        let mobility = &self.study.mobility;
        let advice = |route: &Route| {
            let legs = route.advice(mobility, &samples, go_on).map_err(Problem::Parameter)?;
            Ok::<_, Failure>(legs.unwrap_or_default())
        };
        let with_risk = objectives.contains(&Objective::Risk);
        let tables = self.study.tables(&samples, with_risk, go_on).map_err(Problem::Parameter)?;
        // Who stopped it gets the signal, and no records.
        let Some(tables) = tables else { return Ok(Vec::new()) };
        if let Some(line) = self.line {
            let found = self.study.along(&tables, ground, line)?;
            let driven = self.driven(found.route.as_ref())?;
            let limits = &self.study.limits;
            let legs = advice(&found.seen)?;
            return Ok(vec![RouteRecord::of_line(line, &found, limits, driven.as_ref(), &legs)]);
        }
        let record = |objective: &Objective| {
            let asked = (ground, &ends);
            let found = self.study.judged_route(&tables, asked, *objective, &samples, go_on)?;
            // Who stopped it gets the signal.
            let Some((answer, legs)) = found else { return Ok(RouteRecord::default()) };
            let route = match &answer {
                Answer::Route(route) => Some(route),
                Answer::NoSafeRoute(_) => None,
            };
            Ok(RouteRecord::of(*objective, &answer, self.driven(route)?.as_ref(), &legs))
        };
        objectives.iter().map(record).collect()
    }

    /// What simulation makes of a way, if there is one and that is asked for.
    fn driven(&self, route: Option<&Route>) -> Result<Option<DrivenRoute>, Failure> {
        let Some(route) = route.filter(|_| self.task.drive) else { return Ok(None) };
        let model = self.raster.clone().model();
        let model = Arc::new(model.map_err(|error| Failure::Ground(error.to_string()))?);
        let speed = self.study.mobility.rim_speed;
        route.drive(self.scenario, &model, speed).map(Some).map_err(Failure::Drive)
    }
}

impl Task {
    fn yaw(&self) -> Option<f64> {
        self.yaw_deg.map(|yaw| YAW.unit.to_si(less_whole_turns(yaw)))
    }
}

/// The line to drive along, if one is given.
fn line(py: Python<'_>, task: &Task, map: &MapFrame<'_>) -> PyResult<Option<Line>> {
    let places = match (&task.along, &task.along_file) {
        (Some(places), _) => places.iter().map(|place| Vec2::from(*place)).collect(),
        (None, Some(file)) => {
            let read = grouser_raster::read_line_string(file, map);
            let (places, remark) = read.map_err(|error| errors::of_raster(&error))?;
            errors::warn(py, remark)?;
            places
        }
        (None, None) => return Ok(None),
    };
    Line::through(places, task.yaw()).map(Some).map_err(|error| of_line(&error))
}

fn of_line(error: &LineError) -> PyErr {
    errors::parameter(error.to_string(), "along", None, "a line on the map")
}

/// The study with its limits.
fn study(
    py: Python<'_>,
    task: &Task,
    mut mobility: SlopeStudy,
    map: &MapFrame<'_>,
) -> PyResult<RouteStudy> {
    let checked = |name: &str, value: Option<f64>, range| match value {
        Some(value) => check(name, &[value], range).map(|()| Some(value)),
        None => Ok(None),
    };
    if let Some(speed) = checked("rim_speed_m_s", task.rim_speed_m_s, &MAP_SPEED_M_S)? {
        mobility.rim_speed = speed;
    }
    checked("yaw_deg", task.yaw_deg, &START_YAW_DEG)?;
    let mut limits = Limits::of(&mobility);
    if let Some(slope) = checked("most_slope_deg", task.most_slope_deg, &MOST_SLOPE_DEG)? {
        limits.most_slope = YAW.unit.to_si(slope);
    }
    if let Some(slip) = checked("most_slip_ratio", task.most_slip_ratio, &SHARE)? {
        limits.most_slip_ratio = slip;
    }
    if let Some(share) = checked("most_no_go", task.most_no_go, &SHARE)? {
        limits.most_no_go = share;
    }
    let study = RouteStudy { mobility, limits, keep_out: None };
    let Some(file) = &task.keep_out else { return Ok(study) };
    let found = study.keeping_out_of(file, map);
    let (study, _, remark) = found.map_err(|error| errors::of_raster(&error))?;
    errors::warn(py, remark)?;
    Ok(study)
}

fn objective(name: &str) -> PyResult<Objective> {
    let found = Objective::ALL.into_iter().find(|objective| objective.name() == name);
    found.ok_or_else(|| {
        let expected = "'time', 'energy' or 'risk'";
        let message = format!("minimise is {name:?}, it must be {expected}");
        errors::parameter(message, "minimise", None, expected)
    })
}

/// Why there are no records.
enum Failure {
    Study(Problem),
    Route(RouteError),
    Ground(String),
    Drive(MissionError),
}

impl Failure {
    fn raised(&self) -> PyErr {
        match self {
            Self::Study(problem) => problem.raised(),
            Self::Route(RouteError::Parameter(error)) => errors::of_parameter(error),
            Self::Route(error @ RouteError::OffTheMap { end, .. }) => {
                let name = if *end == "start" { "from_m" } else { "to_m" };
                errors::parameter(error.to_string(), name, None, "a place on the map")
            }
            Self::Route(RouteError::Line(error)) => of_line(error),
            Self::Route(error @ RouteError::TooLarge { .. }) => {
                errors::parameter(error.to_string(), "terrain", None, "a smaller map")
            }
            Self::Ground(message) => {
                errors::parameter(message.clone(), "terrain", None, "a map of heights")
            }
            Self::Drive(error) => errors::of_mission(error),
        }
    }
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self::Study(problem)
    }
}

impl From<RouteError> for Failure {
    fn from(error: RouteError) -> Self {
        Self::Route(error)
    }
}
