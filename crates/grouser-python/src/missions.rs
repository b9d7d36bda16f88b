//! Missions: legs that a rover drives one after the other.

use grouser::document::columns::mission::MissionObject;
use grouser::mission::MissionError;
use grouser::studies::mission::DrivenMission;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::columns::table_to_python;
use crate::descriptions::Document;
use crate::errors;
use crate::interrupt::listening;
use crate::studies::{trajectory_to_python, wheel_names};
use crate::validation::record_to_python;

/// A mission, or each of its alternatives: `row`, the `whole` as the program has it, `legs` and
/// `trajectory`.
#[pyfunction]
pub(crate) fn drive_mission<'py>(
    py: Python<'py>,
    mission: &Document,
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let plan = mission.mission()?.value.clone();
    let names = wheel_names(&plan.scenario);
    let missions = plan.missions();
    let found = listening(py, move |_| DrivenMission::all(&missions))?;
    let ways = found.map_err(|error| errors::of_mission(&error))?;
    let to_python = |way: &DrivenMission| {
        let dict = PyDict::new(py);
        let row = DrivenMission::alternatives(std::slice::from_ref(way));
        dict.set_item("row", record_to_python(py, &row.row(0))?)?;
        dict.set_item("whole", record_to_python(py, &MissionObject { mission: way })?)?;
        dict.set_item("legs", table_to_python(py, way.table())?)?;
        let run = &way.report.trajectory;
        dict.set_item("trajectory", trajectory_to_python(py, run, &plan.scenario, &names)?)?;
        Ok(dict)
    };
    ways.iter().map(to_python).collect()
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
