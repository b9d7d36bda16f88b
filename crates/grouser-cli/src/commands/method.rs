//! Which of the two ways a run over ground with heights was computed in, and how to ask for the
//! other.

use grouser::simulation::{Scenario, Trajectory};

/// A line that says so; on a plane only where it is not dynamic.
pub(super) fn line(run: &Trajectory, scenario: &Scenario) -> String {
    let other = match run.method.name() {
        _ if scenario.ground.is_plane() => "",
        "quasi-steady" => "; --simulation dynamic integrates velocities too",
        "dynamic" => "; --simulation quasi-steady is many times faster",
        _ => "",
    };
    match (run.method.name(), run.method.reason()) {
        (_, Some(reason)) => format!("simulation: {reason}{other}\n"),
        ("dynamic", None) if other.is_empty() => String::new(),
        (word, None) => format!("simulation: {word}{other}\n"),
    }
}
