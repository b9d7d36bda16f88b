//! `grouser forecast`: a rover under another gravity than the one its soil was measured under, on
//! each ground that the site may have.

use grouser::answers::forecast::{ForecastQuestion, file_of_ground};
use grouser::document::columns::SLOPE;
use grouser::document::columns::forecast::{GROUND, SCALING};
use grouser::document::{Kind, preset};
use grouser::studies::forecast::{ForecastError, ForecastStudy, Ground};

use super::{sampling, strict};
use crate::args::ForecastArgs;
use crate::failure::Failure;
use crate::inputs::{self, ForecastInputs};
use crate::output::answer::give;
use crate::output::folder::OutputFolder;

impl From<ForecastError> for Failure {
    fn from(error: ForecastError) -> Self {
        match error {
            ForecastError::Parameter(error) => error.into(),
            ForecastError::NothingAccepted(error) => Self::Usage(format!(
                "the uncertainty of a soil reaches too far: {error}\nhint: smaller standard \
                 deviations keep the samples within the ranges of their keys"
            )),
            ForecastError::NotFound(_) => Self::Run(error.to_string()),
        }
    }
}

pub(crate) fn run(args: &ForecastArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let inputs = inputs::forecast(args)?;
    let ForecastInputs { study, band, slopes, .. } = &inputs;
    let found = sampling::with_bar(study.steps(band), |go_on| study.run(band, slopes, go_on));
    let forecast = sampling::whole(found?);
    let question = ForecastQuestion {
        scenario: &inputs.scenario,
        study,
        band,
        grounds: &inputs.grounds,
        site: &args.site,
        slopes_deg: &args.slope_deg.0,
        is_measured_under_stated: inputs.is_measured_under_stated,
    };
    let mut answer = question.answer("forecast", &forecast);
    answer.next = vec![
        "grouser card scenario.toml --gravity-m-s2 SITE --out CARD".to_owned(),
        "grouser map DEM scenario.toml --gravity-m-s2 SITE --course-deg best --out MAP".to_owned(),
        "grouser calibrate --data TESTS.csv --wheel WHEEL --soil SOIL --out FIT".to_owned(),
    ];
    let slopes = forecast.grounds.iter().flat_map(|ground| &ground.slopes);
    let flags = slopes.map(|slope| &*slope.findings);
    strict::check(&args.strict, flags, &answer.tables[0].1, &[GROUND, SCALING, SLOPE.name])?;
    give(&answer, &repeat(args, &inputs), folder, args.output.format)
}

/// The command that gives the answer again.
fn repeat(args: &ForecastArgs, inputs: &ForecastInputs) -> String {
    let study = &inputs.study;
    let samples =
        format!("{} --discrepancies {} --seed {}", args.samples, args.discrepancies, args.seed);
    let (site, slopes) = (&args.site, args.slope_deg.joined());
    let measured = args.measured_gravity.as_ref();
    let measured = measured.map_or(String::new(), |it| format!(" --measured-gravity-m-s2 {it}"));
    let (speed, scalings, masses) = (study.rim_speed, args.scaling.join(","), args.mass.join(","));
    let (grounds, limit) = (grounds(study).join(","), study.no_go_slip_ratio);
    let model = args.model.as_ref().map_or(String::new(), |model| format!(" --model {model}"));
    format!(
        "grouser forecast scenario.toml --site {site}{measured} \
         --slope-deg {slopes} --rim-speed-m-s {speed} --no-go-slip-ratio {limit} --ground {grounds} --scaling {scalings} \
         --mass {masses}{model} --samples {samples}"
    )
}

/// The grounds by their names, or the files of those that are no presets.
fn grounds(study: &ForecastStudy) -> Vec<String> {
    let with_documents =
        study.choices.grounds.iter().filter(|it| !matches!(it, Ground::AsMeasured));
    let places: Vec<&str> = with_documents.map(Ground::name).collect();
    let name = |ground: &Ground| match places.iter().position(|name| *name == ground.name()) {
        Some(place) if preset(Kind::Soil, ground.name()).is_none() => file_of_ground(place),
        _ => ground.name().to_owned(),
    };
    study.choices.grounds.iter().map(name).collect()
}
