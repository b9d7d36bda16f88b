//! What a mobility map is made of.

use std::path::Path;

use grouser::answers::Sampling;
use grouser::answers::map::MapQuestion;
use grouser::document::{self, LoadedScenario, escape};
use grouser::studies::mobility::{CourseChoice, Ground};
use grouser::studies::verdict::SlopeStudy;
use grouser_raster::{Fault, Raster, RasterError, ReadOptions, Remark};

use super::card::{rim_speed, rule};
use super::{balanced, check_numbers, refuse_sampled_keys};
use crate::args::MapArgs;
use crate::failure::Failure;
use crate::list::{self, Numbers};
use crate::output;

/// What a mobility map is made of.
pub(crate) struct MapInputs {
    pub(crate) scenario: LoadedScenario,
    pub(crate) study: SlopeStudy,
    pub(crate) course: CourseChoice,
    pub(crate) raster: Raster,
}

impl MapInputs {
    /// The question that they make.
    pub(crate) fn question<'q>(&'q self, args: &'q MapArgs) -> MapQuestion<'q> {
        MapQuestion {
            dem: &args.dem,
            ground: Ground::under(&self.study.heading.rover, &self.raster),
            scenario: &self.scenario,
            study: &self.study,
            course: self.course,
            given_course: &args.course_deg,
            sampling: Sampling { count: args.samples, seed: args.seed },
        }
    }
}

pub(crate) fn map(args: &MapArgs) -> Result<MapInputs, Failure> {
    let course = course(&args.course_deg)?;
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("map", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let study = SlopeStudy {
        rim_speed: rim_speed(args.rim_speed_m_s.as_ref(), &scenario)?,
        rule: rule(&args.rule)?,
        ..SlopeStudy::of(&scenario)
    };
    let raster = dem(&args.dem, args.max_cells, args.missing_m)?;
    Ok(MapInputs { scenario, study, course, raster })
}

/// Reads a map of heights, and says what is odd about it.
///
/// * `cells`: the most that are read
/// * `missing`: a height that stands for a missing one [m]
pub(super) fn dem(
    path: &Path,
    cells: Option<u64>,
    missing: Option<f64>,
) -> Result<Raster, Failure> {
    let options = ReadOptions { cells, missing, ..ReadOptions::default() };
    let raster = grouser_raster::read(path, &options).map_err(|error| match error.fault {
        Fault::TooLarge { .. } => Failure::Usage(format!("{error}; or --max-cells N reads more")),
        _ => error.into(),
    })?;
    output::notes(raster.remarks.iter().map(|remark| {
        let text = remark.in_words(|height| format!("`--missing-m {height}`"));
        format!("{}: {}", escape::path(path), escape::line(&text))
    }));
    Ok(raster)
}

/// Says what is to be remarked about a file of places.
pub(super) fn note(file: &Path, remark: Option<&Remark>) {
    output::notes(
        remark.map(|it| format!("{}: {}", escape::path(file), escape::line(&it.to_string()))),
    );
}

impl From<RasterError> for Failure {
    fn from(error: RasterError) -> Self {
        match error.fault {
            Fault::Disk(_) => Self::Run(error.to_string()),
            _ => Self::Usage(error.to_string()),
        }
    }
}

/// A course that is asked for by a number or a word.
fn course(asked: &str) -> Result<CourseChoice, Failure> {
    match asked {
        "best" => return Ok(CourseChoice::Best),
        "worst" => return Ok(CourseChoice::Worst),
        _ => (),
    }
    let expected = || {
        Failure::Usage(format!(
            "--course-deg {asked}: expected an angle of -90 to 90, best or worst"
        ))
    };
    let numbers: Numbers = list::parse(asked).map_err(|_| expected())?;
    let [degrees] = numbers.0[..] else { return Err(expected()) };
    check_numbers("--course-deg", &numbers, &document::study::COURSE_DEG)?;
    Ok(CourseChoice::Fixed(degrees.to_radians()))
}
