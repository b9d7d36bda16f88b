//! The inputs of a forecast.

use grouser::document::{self, Kind, LoadedScenario, Overrides};
use grouser::soil::GravityScaling;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::forecast::{Choices, ForecastStudy, Ground};

use super::{
    balanced, check_numbers, check_rows, check_slopes, flag_source, gravity_value,
    refuse_sampled_keys, single,
};
use crate::args::{ForecastArgs, SettingArgs};
use crate::failure::Failure;
use crate::list::Numbers;

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
    let limit = single("--no-go-slip-ratio", &args.no_go_slip_ratio, &document::study::SHARE)?;
    let study = ForecastStudy {
        rim_speed,
        no_go_slip_ratio: limit,
        choices,
        samples,
        seed: args.seed,
        ..usual
    };
    let band = BandInputs::of_scenario(&scenario);
    check_rows(study.cases(&band) as f64 * args.slope_deg.0.len() as f64)?;
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
