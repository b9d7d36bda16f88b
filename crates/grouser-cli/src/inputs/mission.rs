//! The inputs of a mission.

use grouser::document::{self, Kind, LoadedMission, Overrides};

use super::{flag_source, run_settings, scenario_settings};
use crate::args::{BalanceArgs, MissionArgs};
use crate::failure::Failure;

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
    Ok(document::read_mission(&source, &overrides)?)
}
