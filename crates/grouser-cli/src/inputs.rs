//! From flags to documents: each flag stands for a key, and is checked as that key is.

use std::ops::RangeInclusive;

use grouser::contact::Theory;
use grouser::document::{self, DocumentError, Kind, LoadedScenario, Overrides, Source};

use crate::args::{AttitudeArgs, BalanceArgs, SettingArgs, TraverseArgs, WheelTestArgs};
use crate::failure::Failure;
use crate::list::{self, Numbers};

impl From<DocumentError> for Failure {
    fn from(error: DocumentError) -> Self {
        if error.is_environment() {
            Self::Run(error.to_string())
        } else {
            Self::Usage(error.to_string())
        }
    }
}

/// The scenario of a traverse.
pub(crate) fn traverse(args: &TraverseArgs) -> Result<LoadedScenario, Failure> {
    let source = match &args.scenario {
        Some(name) => Source::find(Kind::Scenario, name)?,
        None => Source::default_scenario(),
    };
    let mut overrides = Overrides::parse(&args.setting.settings)?;
    scenario_settings(&mut overrides, &args.setting, &args.balance)?;
    let texts = [
        ("--rover", "scenario.rover", &args.rover),
        ("--soil", "scenario.soil", &args.soil),
        ("--drive", "scenario.drive.law", &args.drive),
        ("--start", "scenario.start.motion", &args.start),
    ];
    for (flag, key, value) in texts {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    let numbers = [
        ("--slope-deg", "scenario.slope_deg", &args.slope_deg),
        ("--yaw-deg", "scenario.start.yaw_deg", &args.yaw_deg),
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
    if let Some(speeds) = &args.speed_m_s {
        overrides.flag("--speed-m-s", "scenario.drive.speed_m_s", &speed_value(speeds)?)?;
    }
    overrides.check_kinds(&[Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    Ok(document::read_scenario(&source, &overrides)?)
}

/// The scenario whose rover, soil and balance an attitude study takes; its slope is not used.
pub(crate) fn attitude(args: &AttitudeArgs) -> Result<LoadedScenario, Failure> {
    let mut overrides = Overrides::parse(&args.setting.settings)?;
    scenario_settings(&mut overrides, &args.setting, &args.balance)?;
    overrides.flag_text("--rover", "scenario.rover", &args.rover)?;
    overrides.flag_text("--soil", "scenario.soil", &args.soil)?;
    let slopes = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check_numbers("--slope-deg", &args.slope_deg, &slopes)?;
    Ok(document::read_scenario(&Source::default_scenario(), &overrides)?)
}

/// Wheel, soil, gravity and theory of a wheel test.
pub(crate) struct WheelTestInputs {
    pub(crate) soil: document::LoadedSoil,
    pub(crate) wheel: document::LoadedWheel,
    pub(crate) gravity: f64,
    pub(crate) theory: Theory,
}

pub(crate) fn wheel_test(args: &WheelTestArgs) -> Result<WheelTestInputs, Failure> {
    use document::study;
    let overrides = Overrides::parse(&args.setting.settings)?;
    overrides.check_kinds(&[Kind::Soil, Kind::Wheel])?;
    check_numbers("--load-n", &args.load_n, &study::LOAD_N)?;
    check_numbers("--slip-ratio", &args.slip_ratio, &study::SLIP_RATIO)?;
    check_numbers("--slip-angle-deg", &args.slip_angle_deg, &study::SLIP_ANGLE_DEG)?;
    let soil = document::read_soil(&Source::find(Kind::Soil, &args.soil)?, &overrides)?;
    let wheel = document::read_wheel(&Source::find(Kind::Wheel, &args.wheel)?, &overrides)?;
    // Gravity and theory are keys of scenarios: read them as such, to check them as such.
    let mut scenario = Overrides::none();
    scenario_settings(&mut scenario, &args.setting, &BalanceArgs { loads: None, moments: None })?;
    let run = document::read_scenario(&Source::default_scenario(), &scenario)?.value;
    let theory = match &args.setting.model {
        Some(_) => run.theory,
        None => soil.document.theory().unwrap_or_default(),
    };
    Ok(WheelTestInputs { soil, wheel, gravity: run.site.gravity, theory })
}

fn scenario_settings(
    overrides: &mut Overrides,
    setting: &SettingArgs,
    balance: &BalanceArgs,
) -> Result<(), Failure> {
    let words = [
        ("--model", "scenario.model", &setting.model),
        ("--loads", "scenario.loads", &balance.loads),
        ("--moments", "scenario.moments", &balance.moments),
    ];
    for (flag, key, value) in words {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    if let Some(gravity) = &setting.gravity {
        let value = document::gravity(gravity).map_or_else(|| gravity.clone(), |g| g.to_string());
        overrides.flag("--gravity-m-s2", "scenario.gravity_m_s2", &value)?;
    }
    Ok(())
}

/// One speed, or a TOML list of several.
fn speed_value(text: &str) -> Result<String, Failure> {
    let Numbers(speeds) = list::parse(text)
        .map_err(|problem| Failure::Usage(format!("--speed-m-s {text}: {problem}")))?;
    Ok(match speeds[..] {
        [speed] => format!("{speed:?}"),
        _ => format!("{speeds:?}"),
    })
}

fn check_numbers(
    flag: &str,
    numbers: &Numbers,
    range: &RangeInclusive<f64>,
) -> Result<(), Failure> {
    match numbers.0.iter().find(|number| !range.contains(number)) {
        None => Ok(()),
        Some(number) => {
            let (from, to) = (range.start(), range.end());
            Err(Failure::Usage(format!("{flag} {number}: it must be from {from} to {to}")))
        }
    }
}
