//! Reads documents, overridden by flags: each flag stands for a key, and is checked as that key is.

mod advice;
mod card;
mod follow;
mod forecast;
mod heading;
mod learn;
mod map;
pub(crate) mod mission;
mod replay;
mod route;
mod slip_from_current;
mod stand;
mod telemetry;
mod traverse;
mod validate;

use std::ops::RangeInclusive;

use grouser::document::LoadedDesign;
use grouser::document::measurements::{MeasurementError, MeasurementProblem};
use grouser::document::{
    self, DocumentError, Kind, LoadedScenario, Overrides, Source, UncertainSoil, escape,
};

pub(crate) use self::advice::advice;
pub(crate) use self::card::{CardInputs, card, check_agreement, rule};
pub(crate) use self::follow::Following;
pub(crate) use self::forecast::{ForecastInputs, forecast};
pub(crate) use self::heading::{heading, heading_map};
pub(crate) use self::learn::learn;
pub(crate) use self::map::{MapInputs, map};
pub(crate) use self::replay::replay;
pub(crate) use self::route::{Asked, RouteInputs, route};
pub(crate) use self::slip_from_current::{SlipInputs, slip_from_current};
pub(crate) use self::stand::{StandInputs, soil, stand, wheel_test};
pub(crate) use self::telemetry::{
    check_share_used, driven_rover, is_standard_input, log_options, telemetry, telemetry_label,
    telemetry_without_way,
};
pub(crate) use self::traverse::traverse;
pub(crate) use self::validate::{drive_validation, ranked_data_set, slope_validation, validation};
use crate::args::{
    BalanceArgs, DesignArgs, DrawArgs, RunArgs, SettingArgs, SlopeArgs, TerrainArgs,
};
use crate::failure::Failure;
use crate::list::{self, Numbers};
use crate::{hints, output};

impl From<DocumentError> for Failure {
    fn from(error: DocumentError) -> Self {
        if error.is_environment() {
            Self::Run(error.to_string())
        } else {
            Self::Usage(error.to_string())
        }
    }
}

impl From<MeasurementError> for Failure {
    fn from(error: MeasurementError) -> Self {
        if let MeasurementProblem::TooLarge(excess) = error.problem()
            && excess.can_be_raised()
        {
            Self::Usage(format!("{error}\nhint: --max-rows N raises the limit"))
        } else if error.is_environment() {
            Self::Run(error.to_string())
        } else {
            Self::Usage(error.to_string())
        }
    }
}

fn check_slopes(slopes: &Numbers) -> Result<(), Failure> {
    let range = document::range(Kind::Scenario, "slope_deg").unwrap_or(0.0..=60.0);
    check_numbers("--slope-deg", slopes, &range)
}

/// The scenario whose rover and soil are drawn.
pub(crate) fn draw(args: &DrawArgs) -> Result<LoadedScenario, Failure> {
    /// Lighter wheels leave no trace to draw [N].
    const LIGHTEST: f64 = 1e-3;
    /// At more skid the soil is sheared without bound.
    const DRAWN_SLIP: RangeInclusive<f64> = -0.9..=1.0;
    check_slopes(&Numbers(vec![args.slope_deg]))?;
    let load = Numbers(args.load_n.into_iter().collect());
    check_numbers("--load-n", &load, &(LIGHTEST..=*document::study::LOAD_N.end()))?;
    check_numbers("--slip-ratio", &Numbers(vec![args.slip_ratio]), &DRAWN_SLIP)?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    balanced("draw", args.scenario.as_deref(), rover, soil, &args.setting, &args.balance)
}

/// A scenario for its rover, soil and load transfer alone.
fn balanced(
    command: &str,
    scenario: Option<&str>,
    rover: Option<&String>,
    soil: Option<&String>,
    setting: &SettingArgs,
    balance: &BalanceArgs,
) -> Result<LoadedScenario, Failure> {
    let source = scenario_source(command, scenario)?;
    let overrides = balanced_overrides(command, rover, soil, setting, balance)?;
    Ok(document::read_scenario(&source, &overrides)?)
}

/// What flags change of a scenario whose rover, soil and load transfer alone count.
fn balanced_overrides(
    command: &str,
    rover: Option<&String>,
    soil: Option<&String>,
    setting: &SettingArgs,
    balance: &BalanceArgs,
) -> Result<Overrides, Failure> {
    let mut overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    overrides.refuse(
        Kind::Scenario,
        &["slope_deg", "duration_s", "sample_interval_s", "simulation", "drive", "start"],
        match command {
            "validate" => {
                "slopes are those of the rows; a heading offset has no drive, start or duration"
            }
            "learn" | "replay" => "slopes, speeds and times are those of the log",
            "slip-from-current" => {
                "slopes are those of the log or of --slope-deg; the log has the drive"
            }
            "map" | "route" => {
                "slopes are those of the ground; a steady motion has no drive, start or duration"
            }
            _ => {
                "slopes are given by --slope-deg; a heading offset has no drive, start or duration"
            }
        },
    )?;
    if command == "validate" {
        let why = "slopes are those of the rows, or of the attitudes in a log, and its soil is one";
        overrides.refuse(Kind::Scenario, &["terrain"], why)?;
    }
    scenario_settings(&mut overrides, Kind::Scenario, setting, balance)?;
    for (flag, key, value) in
        [("--rover", "scenario.rover", rover), ("--soil", "scenario.soil", soil)]
    {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    Ok(overrides)
}

/// Checks that samples of so many rows are not more rows than anyone can have meant.
pub(crate) fn check_samples(samples: u32, rows: usize) -> Result<(), Failure> {
    check_rows(f64::from(samples) * rows as f64)
}

/// Refuses settings of keys that the samples of a soil give a value.
pub(crate) fn refuse_sampled_keys(
    setting: &SettingArgs,
    uncertain: Option<&UncertainSoil>,
) -> Result<(), Failure> {
    let keys: Vec<&str> = uncertain.into_iter().flat_map(UncertainSoil::sampled_keys).collect();
    if !keys.is_empty() {
        let hint = "every sample gives this key its own value";
        Overrides::parse_flags("--set", &setting.settings)?.refuse(Kind::Soil, &keys, hint)?;
    }
    Ok(())
}

/// The one number of a flag.
fn single(flag: &str, numbers: &Numbers, range: &RangeInclusive<f64>) -> Result<f64, Failure> {
    let [number] = numbers.0[..] else {
        return Err(Failure::Usage(format!("{flag}: expected a single value")));
    };
    check_numbers(flag, numbers, range)?;
    Ok(number)
}

/// A design's task with a command's settings.
///
/// * `setting`: the command's own, or those of one model among several
pub(crate) fn design(args: &DesignArgs, setting: &SettingArgs) -> Result<LoadedDesign, Failure> {
    let mut overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Design, Kind::Rover, Kind::Soil, Kind::Wheel, Kind::Motor])?;
    scenario_settings(&mut overrides, Kind::Design, setting, &args.balance)?;
    Ok(document::read_design(&Source::find(Kind::Design, &args.design)?, &overrides)?)
}

/// The settings that every run takes.
///
/// * `kind`: of the document whose keys they are: a scenario, or one with the same keys
pub(crate) fn scenario_settings(
    overrides: &mut Overrides,
    kind: Kind,
    setting: &SettingArgs,
    balance: &BalanceArgs,
) -> Result<(), Failure> {
    let words = [
        ("--model", "model", &setting.model),
        ("--load-transfer", "load_transfer", &balance.load_transfer),
        ("--wheel-moments", "wheel_moments", &balance.wheel_moments),
    ];
    for (flag, key, value) in words {
        if let Some(value) = value {
            overrides.flag_text(flag, &format!("{kind}.{key}"), value)?;
        }
    }
    if let Some(gravity) = &setting.gravity {
        let value = gravity_value("--gravity-m-s2", gravity)?;
        let key = format!("{kind}.gravity_m_s2");
        overrides.flag_numbers("--gravity-m-s2", &key, gravity, &[value])?;
    }
    Ok(())
}

/// The flags that traverses and missions share.
///
/// * `kind`: as in [`scenario_settings`]
fn run_settings(
    overrides: &mut Overrides,
    kind: Kind,
    slope: &SlopeArgs,
    run: &RunArgs,
) -> Result<(), Failure> {
    let words = [
        ("--rover", "rover", &slope.parts.rover),
        ("--soil", "soil", &slope.parts.soil),
        ("--simulation", "simulation", &run.simulation),
    ];
    for (flag, key, value) in words {
        if let Some(value) = value {
            overrides.flag_text(flag, &format!("{kind}.{key}"), value)?;
        }
    }
    if let Some(slope) = &slope.slope_deg {
        overrides.flag("--slope-deg", &format!("{kind}.slope_deg"), slope)?;
    }
    terrain_settings(overrides, kind, &slope.terrain)
}

/// Prints the notes on a document, with flags where one set its terrain.
fn print_notes(kind: Kind, notes: &[String], terrain: &TerrainArgs) {
    let note = |note: &String| match terrain.terrain {
        Some(_) => hints::of_terrain(&escape::line(note), kind),
        None => escape::line(note).into_owned(),
    };
    output::notes(notes.iter().map(note));
}

/// The flags of ground with heights, which stands in place of a document's ground.
fn terrain_settings(
    overrides: &mut Overrides,
    kind: Kind,
    args: &TerrainArgs,
) -> Result<(), Failure> {
    if let Some(file) = &args.terrain {
        overrides.leave_out(kind, &["terrain"]);
        overrides.leave_out(kind, &["slope_deg"]);
        // What a flag names is looked for from here, not from the document's folder.
        overrides.flag_text("--terrain", &format!("{kind}.terrain.file"), file)?;
    }
    if let (Some(x), Some(y)) = (args.start_x_m, args.start_y_m) {
        let written = format!("{x} --start-y-m {y}");
        let key = format!("{kind}.terrain.start_m");
        overrides.flag_numbers("--start-x-m", &key, &written, &[x, y])?;
    }
    Ok(())
}

/// A number, or what a name stands for [m/s²].
fn gravity_value(flag: &str, text: &str) -> Result<f64, Failure> {
    let number = text.trim().parse().ok();
    document::gravity(text.trim()).or(number).ok_or_else(|| {
        let names = document::GRAVITIES.map(|(name, _)| name);
        let hint = match document::nearest(text, names) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!("in m/s², such as 9.80665, or one of {}", names.join(", ")),
        };
        Failure::Usage(format!(
            "{flag} {text}: this is neither a number nor the name of a gravity\nhint: {hint}"
        ))
    })
}

fn scenario_source(command: &str, name: Option<&str>) -> Result<Source, Failure> {
    match name {
        Some(name) => flag_source(command, Kind::Scenario, name),
        None => Ok(Source::default_scenario()),
    }
}

/// The document that an argument names; if it does not exist, the message shows the argument.
fn flag_source(flag: &str, kind: Kind, name: &str) -> Result<Source, Failure> {
    let source = Source::find(kind, name);
    Ok(source.map_err(|error| error.in_argument(format!("{flag} {}", name.escape_debug())))?)
}

/// Checks that lists together do not ask for more rows than anyone can have meant.
fn check_count(lists: &[&Numbers]) -> Result<(), Failure> {
    check_rows(lists.iter().map(|list| list.0.len() as f64).product())
}

fn check_rows(count: f64) -> Result<(), Failure> {
    if count <= list::MOST as f64 {
        return Ok(());
    }
    let most = list::MOST;
    Err(Failure::Usage(format!(
        "the lists together ask for {count} rows, it must be at most {most}"
    )))
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
