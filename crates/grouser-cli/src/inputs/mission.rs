//! The inputs of a mission.

use std::path::Path;

use grouser::document::{self, Kind, LoadedMission, Overrides, Overruled, escape};

use super::{flag_source, print_notes, run_settings, scenario_settings};
use crate::args::{BalanceArgs, MissionArgs};
use crate::failure::Failure;
use crate::output;

pub(crate) fn read(args: &MissionArgs) -> Result<LoadedMission, Failure> {
    let source = flag_source("mission", Kind::Mission, &args.mission)?;
    let mut overrides = Overrides::parse_flags("--set", &args.setting.settings)?;
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    scenario_settings(&mut overrides, Kind::Mission, &args.setting, &balance)?;
    run_settings(&mut overrides, Kind::Mission, &args.slope, &args.run)?;
    let files = [
        ("--legs-from", "mission.legs_from", &args.legs_from),
        ("--stop-from", "mission.stop_from", &args.stop_from),
    ];
    for (flag, key, file) in files {
        let Some(file) = file else { continue };
        // What a flag names is looked for from here, not from the document's folder.
        let file = std::path::absolute(file).map_or(file.clone(), |it| it.display().to_string());
        overrides.flag_text(flag, key, &file)?;
    }
    overrides.check_kinds(&[Kind::Mission, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    let mission = document::read_mission(&source, &overrides)?;
    print_notes(Kind::Mission, &mission.notes, &args.slope.terrain);
    if let Some(file) = &args.stop_from {
        note_overruled(Path::new(file), &mission, &args.setting.settings);
    }
    Ok(mission)
}

/// Says which limits of a file do not count, because the mission has its own, and not by `--set`.
fn note_overruled(file: &Path, mission: &LoadedMission, settings: &[String]) {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    let own = mission.document.get("stop").cloned().unwrap_or_default();
    let is_set = |name: &str| settings.iter().any(|it| it.contains(&format!("stop.{name}")));
    let overruled = document::overruled(&text, &own).into_iter().filter(|it| !is_set(&it.name));
    for Overruled { name, file: limit, mission } in overruled {
        let file = escape::path(file);
        output::notes([format!(
            "the mission's own limit {name} {mission} stands, not {limit} of {file}: --set \
             mission.stop.{name}={limit} takes that"
        )]);
    }
}
