//! Reads documents, overridden by flags: each flag stands for a key, and is checked as that key is.

pub(crate) mod mission;

use std::ops::RangeInclusive;

use grouser::contact::Theory;
use grouser::document::measurements::{MeasurementError, MeasurementProblem};
use grouser::document::{
    self, Document, DocumentError, Kind, LoadedScenario, Overrides, Source, UncertainSoil,
};
use grouser::soil::GravityScaling;
use grouser::studies::card::Rule;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::forecast::{Choices, ForecastStudy, Ground};

use crate::args::{
    BalanceArgs, CardArgs, DrawArgs, ForecastArgs, HeadingArgs, HeadingMapArgs, RunArgs,
    SettingArgs, SlopeArgs, StandArgs, TraverseArgs, WheelTestArgs,
};
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
        // The former key of both, each under its law.
        ("--speed-m-s", "scenario.drive.speed_m_s", &args.speed_m_s),
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
    Ok(document::read_scenario(&source, &overrides)?)
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

/// The scenario whose rover, soil and load transfer `heading` takes; its slope is not used.
///
/// * `setting`: those of the arguments, with one model
pub(crate) fn heading(
    args: &HeadingArgs,
    setting: &SettingArgs,
) -> Result<LoadedScenario, Failure> {
    check_slopes(&args.slope_deg)?;
    let scenario = args.scenario.as_deref();
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    balanced("heading", scenario, rover, soil, setting, &args.balance)
}

/// The scenarios of a heading map, one for each model that is asked for and soil: all soils of the first model,
/// then those of the next.
pub(crate) fn heading_map(args: &HeadingMapArgs) -> Result<Vec<LoadedScenario>, Failure> {
    use document::study;
    check_slopes(&args.slope_deg)?;
    check_numbers("--course-deg", &args.course_deg, &study::COURSE_DEG)?;
    let [_] = args.rim_speed_m_s.0[..] else {
        return Err(Failure::Usage("--rim-speed-m-s: expected a single value".into()));
    };
    check_numbers("--rim-speed-m-s", &args.rim_speed_m_s, &study::MAP_SPEED_M_S)?;
    let soils: Vec<Option<&String>> =
        if args.soil.is_empty() { vec![None] } else { args.soil.iter().map(Some).collect() };
    let settings = args.setting.each_model();
    let rows = settings.len() * soils.len() * args.slope_deg.0.len() * args.course_deg.0.len();
    let sampling = args.uncertainty.sampling;
    check_samples(if sampling.uncertainty { sampling.samples } else { 1 }, rows)?;
    let (scenario, rover) = (args.scenario.as_deref(), args.rover.as_ref());
    let of_setting = |setting: &SettingArgs| {
        let read = |soil: Option<&String>| {
            balanced("heading-map", scenario, rover, soil, setting, &args.balance)
        };
        soils.iter().copied().map(read).collect::<Result<Vec<_>, _>>()
    };
    let all = settings.iter().map(of_setting).collect::<Result<Vec<_>, _>>()?;
    Ok(all.into_iter().flatten().collect())
}

/// The scenario whose rover, soil and load transfer `validate` takes on slopes.
pub(crate) fn on_slopes(
    rover: &String,
    soil: &String,
    setting: &SettingArgs,
) -> Result<LoadedScenario, Failure> {
    let balance = BalanceArgs { load_transfer: None, wheel_moments: None };
    balanced("validate", None, Some(rover), Some(soil), setting, &balance)
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
    let mut overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel])?;
    overrides.refuse(
        Kind::Scenario,
        &["slope_deg", "duration_s", "sample_interval_s", "simulation", "drive", "start"],
        if command == "validate" {
            "slopes are those of the rows; a heading offset has no drive, start or duration"
        } else {
            "slopes are given by --slope-deg; a heading offset has no drive, start or duration"
        },
    )?;
    scenario_settings(&mut overrides, Kind::Scenario, setting, balance)?;
    for (flag, key, value) in
        [("--rover", "scenario.rover", rover), ("--soil", "scenario.soil", soil)]
    {
        if let Some(value) = value {
            overrides.flag_text(flag, key, value)?;
        }
    }
    Ok(document::read_scenario(&source, &overrides)?)
}

/// That samples of so many rows are not more than anyone can have meant.
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

/// The inputs of a card.
pub(crate) struct CardInputs {
    pub(crate) scenario: LoadedScenario,
    /// Rim speed [m/s].
    pub(crate) rim_speed: f64,
    pub(crate) rule: Rule,
}

pub(crate) fn card(args: &CardArgs) -> Result<CardInputs, Failure> {
    use document::card::{RuleRecord, SHARE};
    let flags = &args.rule;
    let record = RuleRecord {
        go_slip_ratio: single("--go-slip-ratio", &flags.go_slip_ratio, &SHARE)?,
        go_probability: single("--go-probability", &flags.go_probability, &SHARE)?,
        no_go_slip_ratio: single("--no-go-slip-ratio", &flags.no_go_slip_ratio, &SHARE)?,
        no_go_probability: single("--no-go-probability", &flags.no_go_probability, &SHARE)?,
    };
    let rule = Rule::from(&record);
    rule.check()?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("card", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let rim_speed = match &args.rim_speed_m_s {
        Some(speed) => single("--rim-speed-m-s", speed, &document::study::MAP_SPEED_M_S)?,
        None => scenario.value.drive.nominal_rim_speed(),
    };
    Ok(CardInputs { scenario, rim_speed, rule })
}

/// The inputs of a forecast.
pub(crate) struct ForecastInputs {
    pub(crate) scenario: LoadedScenario,
    pub(crate) study: ForecastStudy,
    pub(crate) band: BandInputs,
    /// On which it is asked for [rad].
    pub(crate) slopes: Vec<f64>,
    /// The documents of the grounds that are not the soil's own.
    pub(crate) grounds: Vec<document::LoadedSoil>,
    /// Whether the caller says under which gravity the soil was measured.
    pub(crate) is_measured_under_stated: bool,
}

pub(crate) fn forecast(args: &ForecastArgs) -> Result<ForecastInputs, Failure> {
    use document::forecast as words;
    check_slopes(&args.slope_deg)?;
    let gravity = gravity_in("--site", &args.site)?;
    let setting = SettingArgs {
        settings: args.settings.clone(),
        model: args.model.clone(),
        gravity: Some(gravity.to_string()),
    };
    let settings = Overrides::parse_flags("--set", &args.settings)?;
    settings.refuse(Kind::Scenario, &["gravity_m_s2"], "the gravity is that of --site")?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let name = args.scenario.as_deref();
    let scenario = balanced("forecast", name, rover, soil, &setting, &args.balance)?;
    refuse_sampled_keys(&setting, scenario.uncertain.as_ref())?;
    let stated = args.measured_gravity.as_ref();
    let stated = stated.map(|text| gravity_in("--measured-gravity-m-s2", text)).transpose()?;
    let usual = words::study_of(&scenario, stated);
    let measured_under = usual.measured_under;
    let names = ground_names(args, &usual);
    let (grounds, documents) = grounds(&names)?;
    let masses = once("--mass", &args.mass)?.iter();
    let masses = masses.map(|text| words::mass_of(text, gravity / measured_under));
    let masses = masses.collect::<Result<Vec<_>, _>>();
    let masses = masses.map_err(|problem| Failure::Usage(format!("--mass {problem}")))?;
    once("--mass", &masses.iter().map(|mass| mass.name.clone()).collect::<Vec<_>>())?;
    let scalings = once("--scaling", &args.scaling)?.iter().map(|text| scaling_of(text));
    let choices = Choices { scalings: scalings.collect::<Result<_, _>>()?, grounds, masses };
    let rim_speed = match &args.rim_speed_m_s {
        Some(speed) => single("--rim-speed-m-s", speed, &document::study::MAP_SPEED_M_S)?,
        None => usual.rim_speed,
    };
    let samples = [args.samples, args.discrepancies];
    let study = ForecastStudy { rim_speed, choices, samples, seed: args.seed, ..usual };
    let band = BandInputs::of_scenario(&scenario);
    let cases: usize = study.factors(&band).iter().map(|factor| factor.levels.len()).product();
    check_rows(cases as f64 * args.slope_deg.0.len() as f64)?;
    Ok(ForecastInputs {
        study,
        band,
        slopes: args.slope_deg.0.iter().map(|slope| slope.to_radians()).collect(),
        grounds: documents,
        is_measured_under_stated: stated.is_some(),
        scenario,
    })
}

/// What the ground may be: as asked for, or else as it usually is.
fn ground_names(args: &ForecastArgs, study: &ForecastStudy) -> Vec<String> {
    if !args.ground.is_empty() {
        return args.ground.clone();
    }
    document::forecast::usual_grounds(study).into_iter().map(str::to_owned).collect()
}

/// The grounds by their names, and the documents of those that have one.
fn grounds(names: &[String]) -> Result<(Vec<Ground>, Vec<document::LoadedSoil>), Failure> {
    let (mut grounds, mut documents) = (Vec::new(), Vec::new());
    for name in once("--ground", names)? {
        if name == document::forecast::AS_MEASURED {
            grounds.push(Ground::AsMeasured);
            continue;
        }
        let source = flag_source("--ground", Kind::Soil, name)?;
        let soil = document::read_soil(&source, &Overrides::none())?;
        grounds.push(Ground::of_soil(name, &soil));
        documents.push(soil);
    }
    Ok((grounds, documents))
}

fn scaling_of(text: &str) -> Result<GravityScaling, Failure> {
    document::forecast::scaling_of(text).ok_or_else(|| {
        let names = GravityScaling::ALL.map(GravityScaling::name);
        let hint = match document::nearest(text, names) {
            Some(name) => format!("did you mean `{name}`?"),
            None => format!("one of {}", names.join(", ")),
        };
        Failure::Usage(format!("--scaling {text}: no such way to scale moduli\nhint: {hint}"))
    })
}

/// A list in which nothing stands twice: it would count twice.
fn once<'a>(flag: &str, all: &'a [String]) -> Result<&'a [String], Failure> {
    let mut places = all.iter().enumerate();
    match places.find(|(place, name)| all[..*place].contains(name)) {
        None => Ok(all),
        Some((_, name)) => Err(Failure::Usage(format!("{flag}: {name} is named twice"))),
    }
}

/// A gravity of a flag, in the range of sites.
fn gravity_in(flag: &str, text: &str) -> Result<f64, Failure> {
    let gravity = gravity_value(flag, text)?;
    check_numbers(flag, &Numbers(vec![gravity]), &document::forecast::GRAVITY)?;
    Ok(gravity)
}

/// The one number of a flag.
fn single(flag: &str, numbers: &Numbers, range: &RangeInclusive<f64>) -> Result<f64, Failure> {
    let [number] = numbers.0[..] else {
        return Err(Failure::Usage(format!("{flag}: expected a single value")));
    };
    check_numbers(flag, numbers, range)?;
    Ok(number)
}

/// Wheel, soil, gravity and model of a test stand.
pub(crate) struct StandInputs {
    pub(crate) soil: document::LoadedSoil,
    pub(crate) wheel: document::LoadedWheel,
    pub(crate) gravity: f64,
    pub(crate) theory: Theory,
    /// What its bands are drawn from.
    pub(crate) band: BandInputs,
}

/// The stand with each model that is asked for.
pub(crate) fn wheel_test(args: &WheelTestArgs) -> Result<Vec<StandInputs>, Failure> {
    use document::study;
    check_numbers("--load-n", &args.load_n, &study::LOAD_N)?;
    check_numbers("--slip-ratio", &args.slip_ratio, &study::SLIP_RATIO)?;
    check_numbers("--slip-angle-deg", &args.slip_angle_deg, &study::SLIP_ANGLE_DEG)?;
    check_count(&[&args.load_n, &args.slip_ratio, &args.slip_angle_deg])?;
    if let Some(trials) = args.stand.trials {
        check_stand(&args.stand, trials)?;
    }
    let settings = args.setting.each_model();
    if args.sampling.uncertainty {
        let lists = [&args.load_n, &args.slip_ratio, &args.slip_angle_deg];
        let rows: usize = lists.iter().map(|list| list.0.len()).product();
        check_samples(args.sampling.samples, settings.len() * rows)?;
    }
    let each = |setting: &SettingArgs| {
        let stand = stand(&args.soil, &args.wheel, setting)?;
        if args.sampling.uncertainty {
            refuse_sampled_keys(setting, stand.soil.uncertain.as_ref())?;
        }
        Ok(stand)
    };
    settings.iter().map(each).collect()
}

/// A soil and gravity [m/s²].
pub(crate) fn soil(
    name: &str,
    setting: &SettingArgs,
) -> Result<(document::LoadedSoil, f64), Failure> {
    let overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Soil])?;
    let soil = document::read_soil(&flag_source("--soil", Kind::Soil, name)?, &overrides)?;
    let mut scenario = Overrides::none();
    scenario_settings(
        &mut scenario,
        Kind::Scenario,
        setting,
        &BalanceArgs { load_transfer: None, wheel_moments: None },
    )?;
    let run = document::read_scenario(&Source::default_scenario(), &scenario)?.value;
    Ok((soil, run.site.gravity))
}

/// That a simulated stand does what a stand can do.
fn check_stand(args: &StandArgs, trials: usize) -> Result<(), Failure> {
    use document::simulated_test::{NOISE, TRIALS};
    let one = |number: f64| Numbers(vec![number]);
    check_numbers("--trials", &one(trials as f64), &TRIALS)?;
    check_numbers("--noise-n", &one(args.noise_n), &NOISE)?;
    check_numbers("--noise-mm", &one(args.noise_mm), &NOISE)?;
    check_numbers("--noise-nm", &one(args.noise_nm), &NOISE)
}

/// A wheel on a test stand, from the names of its soil and wheel.
pub(crate) fn stand(
    soil: &str,
    wheel: &str,
    setting: &SettingArgs,
) -> Result<StandInputs, Failure> {
    let overrides = Overrides::parse_flags("--set", &setting.settings)?;
    overrides.check_kinds(&[Kind::Soil, Kind::Wheel])?;
    let soil = document::read_soil(&flag_source("--soil", Kind::Soil, soil)?, &overrides)?;
    let wheel = document::read_wheel(&flag_source("--wheel", Kind::Wheel, wheel)?, &overrides)?;
    // Gravity and model are keys of scenarios: read them as such, to check them as such.
    let mut scenario = Overrides::none();
    scenario_settings(
        &mut scenario,
        Kind::Scenario,
        setting,
        &BalanceArgs { load_transfer: None, wheel_moments: None },
    )?;
    let run = document::read_scenario(&Source::default_scenario(), &scenario)?.value;
    let chosen = setting.model.as_ref().map(|_| run.theory);
    let theory = chosen.unwrap_or_else(|| soil.document.usual_theory(""));
    let band = BandInputs::of_soil(&soil, chosen);
    Ok(StandInputs { soil, wheel, gravity: run.site.gravity, theory, band })
}

/// The line below a table that says which model a single answer has, where nobody names one and it is not the usual
/// one; nothing elsewhere.
///
/// * `document`: of a soil, or of a scenario with its soil
/// * `soil`: the key of the soil, or nothing if the document is one
pub(crate) fn model_line(document: &Document, soil: &str) -> String {
    let of_soil = if soil.is_empty() { None } else { document.theory_of_soil() };
    let is_named = document.theory().or(of_soil).is_some();
    if is_named || !document.leaves_sinkage_ratio_to_priors(soil) {
        return String::new();
    }
    let model = document.usual_theory(soil).name();
    format!("model: {model}, as the soil leaves its wheel sinkage ratio to priors\n")
}

/// * `kind`: of the document whose keys they are: a scenario, or one with the same keys
fn scenario_settings(
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

/// The document that an argument names; if there is none, the message shows the argument.
fn flag_source(flag: &str, kind: Kind, name: &str) -> Result<Source, Failure> {
    let source = Source::find(kind, name);
    Ok(source.map_err(|error| error.in_argument(format!("{flag} {}", name.escape_debug())))?)
}

/// That lists together do not ask for more than anyone can have meant.
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
