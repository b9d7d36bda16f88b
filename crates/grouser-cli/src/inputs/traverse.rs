//! The inputs of a traverse.

use grouser::document::{self, Kind, LoadedScenario, Overrides};

use super::{print_notes, run_settings, scenario_settings, scenario_source};
use crate::args::{SettingArgs, TraverseArgs};
use crate::failure::Failure;
use crate::list::{self, Numbers};

/// The scenario of a traverse.
///
/// * `setting`: those of the arguments, with one model
/// * `yaw`: as `--yaw-deg` has it
pub(crate) fn traverse(
    args: &TraverseArgs,
    setting: &SettingArgs,
    yaw: Option<&str>,
) -> Result<LoadedScenario, Failure> {
    let yaw = yaw.map(str::to_owned);
    let source = scenario_source("traverse", args.scenario.as_deref())?;
    let mut overrides = Overrides::parse_flags("--set", &setting.settings)?;
    scenario_settings(&mut overrides, Kind::Scenario, setting, &args.balance)?;
    run_settings(&mut overrides, Kind::Scenario, &args.slope, &args.run)?;
    let texts = [
        ("--drive", "scenario.drive.law", &args.drive),
        ("--start", "scenario.start.motion", &args.start),
    ];
    for (flag, key, value) in texts {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    let numbers = [
        ("--yaw-deg", yaw_key(yaw.as_deref()), &yaw),
        ("--duration-s", "scenario.duration_s", &args.duration_s),
        (
            "--reference-slip-ratio",
            "scenario.drive.reference_slip_ratio",
            &args.reference_slip_ratio,
        ),
    ];
    for (flag, key, value) in numbers {
        if let Some(value) = value {
            overrides.flag(flag, key, value)?;
        }
    }
    let speeds = [
        ("--rim-speed-m-s", "scenario.drive.rim_speed_m_s", &args.rim_speed_m_s),
        ("--ground-speed-m-s", "scenario.drive.ground_speed_m_s", &args.ground_speed_m_s),
    ];
    for (flag, key, value) in speeds {
        if let Some(value) = value {
            let Numbers(numbers) = list::parse(value)
                .map_err(|problem| Failure::Usage(format!("{flag} {value}: {problem}")))?;
            overrides.flag_numbers(flag, key, value, &numbers)?;
        }
    }
    if yaw.is_some() {
        // One yaw stands in place of the other.
        let other = if is_course(yaw.as_deref()) { START_YAW } else { COURSE_YAW };
        overrides.leave_out(Kind::Scenario, other);
    }
    overrides.check_kinds(&[Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    let scenario = document::read_scenario(&source, &overrides)?;
    print_notes(Kind::Scenario, &scenario.notes, &args.slope.terrain);
    Ok(scenario)
}

/// The key of the yaw at the start, in its table.
const START_YAW: &[&str] = &["start", "yaw_deg"];

/// The key of the yaw over time, in its table.
const COURSE_YAW: &[&str] = &["drive", "yaw_deg"];

/// What `--yaw-deg` sets: the yaw at the start, or as a list of pairs the yaw over time.
fn yaw_key(value: Option<&str>) -> &'static str {
    if is_course(value) { "scenario.drive.yaw_deg" } else { "scenario.start.yaw_deg" }
}

fn is_course(value: Option<&str>) -> bool {
    value.is_some_and(|value| value.trim_start().starts_with('['))
}
