//! Missions: legs that a rover drives one after the other.

use grouser::answers::Sampling;
use grouser::document::columns::completion::RISK;
use grouser::document::columns::mission::MissionObject;
use grouser::document::columns::verdict::{ADVICE, ADVICE_OBJECT};
use grouser::document::table::Table;
use grouser::mission::MissionError;
use grouser::studies::completion::Completion;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::mission::DrivenMission;
use grouser::studies::verdict::{Advice, SlopeStudy};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::studies::{Problem, SAMPLES, trajectory_to_python, wheel_names};
use crate::validation::record_to_python;
use crate::wheels::check;

/// A mission, or each of its alternatives: `row`, the `whole` as the program has it, `legs` and
/// `trajectory`; with samples also the `risk`, and the `advice` for each leg that was begun.
///
/// * `sampling`: number of samples, and their seed
#[pyfunction]
pub(crate) fn drive_mission<'py>(
    py: Python<'py>,
    mission: &Document,
    sampling: Option<(u32, u64)>,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    if let Some((samples, _)) = sampling {
        check("samples", &[f64::from(samples)], &SAMPLES)?;
    }
    let loaded = mission.mission()?;
    let plan = loaded.value.clone();
    let scenario = loaded.with_value(plan.scenario.clone());
    let names = wheel_names(&plan.scenario);
    let missions = plan.missions();
    let found = listening(py, move |cancelled| {
        let ways = DrivenMission::all(&missions).map_err(NoMission::Drive)?;
        let Some((count, seed)) = sampling else {
            return Ok(ways.into_iter().map(|way| (way, None)).collect::<Vec<_>>());
        };
        let go_on = || !cancelled.is_set();
        let sampling = Sampling { count, seed };
        let samples = sampling.draw_if_uncertain(&BandInputs::of_scenario(&scenario));
        let samples = samples.map_err(|error| NoMission::Study(Problem::Sampling(error)))?;
        let study = SlopeStudy::of(&scenario);
        let pairs = missions.iter().zip(ways);
        let believed = pairs.map(|((_, mission), way)| {
            let risk = Completion::of_mission(mission, &samples, &go_on);
            let study = SlopeStudy { rim_speed: mission.rim_speed(), ..study.clone() };
            let advice = way.advice(&study, &mission.scenario, &samples, &go_on);
            let advice = advice.map_err(|error| NoMission::Study(Problem::Parameter(error)))?;
            Ok((way, risk.zip(advice)))
        });
        believed.collect::<Result<Vec<_>, NoMission>>()
    })?;
    let ways = found.map_err(|failure| failure.raised())?;
    let to_python = |(way, believed): &(DrivenMission, Believed)| {
        let dict = PyDict::new(py);
        let row = DrivenMission::alternatives(std::slice::from_ref(way));
        dict.set_item("row", record_to_python(py, &row.row(0))?)?;
        let object = believed.as_ref().map(|(risk, advice)| (risk, &**advice));
        let whole = MissionObject { mission: way, believed: object };
        dict.set_item("whole", record_to_python(py, &whole)?)?;
        if let Some((risk, advice)) = believed {
            let risk = Table::of(&RISK, std::slice::from_ref(risk));
            dict.set_item("risk", record_to_python(py, &risk.row(0))?)?;
            let advice: Vec<_> = advice.iter().map(Option::as_ref).collect();
            let advice = Table::default().and(&ADVICE, &advice);
            dict.set_item(ADVICE_OBJECT, table_to_python(py, advice)?)?;
        }
        dict.set_item("legs", table_to_python(py, way.table())?)?;
        let run = &way.report.trajectory;
        dict.set_item("trajectory", trajectory_to_python(py, run, &plan.scenario, &names)?)?;
        Ok(dict)
    };
    ways.iter().map(to_python).collect()
}

/// What a mission risks, and the advice for each of its legs.
type Believed = Option<(Completion, Vec<Option<Advice>>)>;

/// Why there is no mission.
enum NoMission {
    Drive(MissionError),
    Study(Problem),
}

impl NoMission {
    fn raised(&self) -> PyErr {
        match self {
            Self::Drive(error) => errors::of_mission(error),
            Self::Study(problem) => problem.raised(),
        }
    }
}

/// One way to drive a mission, from its start to its end.
///
/// * `alternative`: its name; empty for a mission without alternatives
pub(crate) fn drive(mission: &Document, alternative: &str) -> PyResult<Drive> {
    let missions = mission.mission()?.value.missions();
    let way = missions.into_iter().find(|(name, _)| name == alternative);
    let (name, mission) = way.ok_or_else(|| {
        let message = format!("there is no alternative {alternative:?}");
        errors::parameter(message, "alternative", None, "the name of an alternative")
    })?;
    Ok(Box::new(move || Ok(DrivenMission::drive(&name, &mission)?.report.trajectory)))
}

/// What drives a mission.
pub(crate) type Drive =
    Box<dyn FnOnce() -> Result<grouser::simulation::Trajectory, MissionError> + Send>;
