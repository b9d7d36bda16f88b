//! The inputs of a mission.

use grouser::document::{self, Kind, LoadedMission, Overrides};

use super::{flag_source, scenario_settings};
use crate::args::{BalanceArgs, MissionArgs};
use crate::failure::Failure;

pub(crate) fn read(args: &MissionArgs) -> Result<LoadedMission, Failure> {
    let source = flag_source("mission", Kind::Mission, &args.mission)?;
    let mut overrides = Overrides::parse_flags("--set", &args.setting.settings)?;
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    scenario_settings(&mut overrides, Kind::Mission, &args.setting, &balance)?;
    let texts = [
        ("--rover", "mission.rover", &args.parts.rover),
        ("--soil", "mission.soil", &args.parts.soil),
        ("--simulation", "mission.simulation", &args.simulation),
    ];
    for (flag, key, value) in texts {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    if let Some(file) = &args.legs_from {
        // What a flag names is looked for from here, not from the document's folder.
        let file = std::path::absolute(file).map_or(file.clone(), |it| it.display().to_string());
        overrides.flag_text("--legs-from", "mission.legs_from", &file)?;
    }
    if let Some(slope) = &args.slope_deg {
        overrides.flag("--slope-deg", "mission.slope_deg", slope)?;
    }
    overrides.check_kinds(&[Kind::Mission, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    Ok(document::read_mission(&source, &overrides)?)
}
