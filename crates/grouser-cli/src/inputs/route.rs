//! What a route is made of.

use std::path::Path;

use grouser::answers::Sampling;
pub(crate) use grouser::answers::route::Asked;
use grouser::answers::route::RouteQuestion;
use grouser::document::given_file::{FileContent, GivenFile};
use grouser::document::unit::less_whole_turns;
use grouser::document::{LoadedScenario, escape, study};
use grouser::studies::mobility::Ground;
use grouser::studies::route::{Ends, Limits, Line, LineError, RouteStudy};
use grouser::studies::verdict::SlopeStudy;
use grouser::units::Vec2;
use grouser_raster::Raster;
use grouser_raster::zones::ZoneCounts;

use super::card::{rim_speed, rule};
use super::map::{dem, note};
use super::{balanced, refuse_sampled_keys, single};
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::list::Numbers;

/// What a route is made of.
pub(crate) struct RouteInputs {
    pub(crate) scenario: LoadedScenario,
    pub(crate) study: RouteStudy,
    pub(crate) asked: Asked,
    pub(crate) raster: Raster,
    /// What the files gave of a line and of areas to keep out of.
    pub(crate) given: Vec<GivenFile>,
}

impl RouteInputs {
    /// The ground, as the rover stands on it.
    pub(crate) fn ground(&self) -> Ground<'_> {
        Ground::under(&self.study.mobility.heading.rover, &self.raster)
    }

    /// The question that they make.
    pub(crate) fn question<'q>(&'q self, args: &'q RouteArgs) -> RouteQuestion<'q> {
        RouteQuestion {
            dem: &args.dem,
            raster: &self.raster,
            scenario: &self.scenario,
            study: &self.study,
            asked: &self.asked,
            along: args.along.as_deref(),
            keep_out: args.keep_out.as_deref(),
            given: &self.given,
            sampling: Sampling { count: args.samples, seed: args.seed },
        }
    }
}

pub(crate) fn route(args: &RouteArgs) -> Result<RouteInputs, Failure> {
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("route", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let mobility = SlopeStudy {
        rim_speed: rim_speed(args.rim_speed_m_s.as_ref(), &scenario)?,
        rule: rule(&args.rule)?,
        ..SlopeStudy::of(&scenario)
    };
    let limits = limits(args, &mobility)?;
    let raster = dem(&args.dem, args.max_cells, args.missing_m)?;
    let mut study = RouteStudy { mobility, limits, keep_out: None };
    let asked = asked(args, &raster)?;
    let mut given = Vec::new();
    let name = |file: &Path| file.display().to_string();
    if let Some(file) = &args.keep_out {
        let (with_areas, ZoneCounts { there, used }, remark) =
            study.keeping_out_of(file, &raster.frame())?;
        note(file, remark.as_ref());
        study = with_areas;
        given.push(GivenFile::new(name(file), FileContent::KeepOut, there, used));
    }
    if let (Some(file), Asked::Along(line)) = (&args.along, &asked) {
        let places = line.places().len() as u64;
        given.push(GivenFile::new(name(file), FileContent::Way, places, places));
    }
    Ok(RouteInputs { scenario, study, asked, raster, given })
}

fn asked(args: &RouteArgs, raster: &Raster) -> Result<Asked, Failure> {
    let yaw = match &args.yaw_deg {
        Some(yaw) => {
            let yaw = single("--yaw-deg", yaw, &study::START_YAW_DEG)?;
            Some(less_whole_turns(yaw).to_radians())
        }
        None => None,
    };
    if let Some(file) = &args.along {
        let (places, remark) = grouser_raster::read_line_string(file, &raster.frame())?;
        note(file, remark.as_ref());
        let line = Line::through(places, yaw);
        let named = |error: LineError| Failure::Usage(format!("{}: {error}", escape::path(file)));
        return line.map(Asked::Along).map_err(named);
    }
    let from = place("--from", args.from.as_ref())?;
    Ok(Asked::Between(Ends { from, to: place("--to", args.to.as_ref())?, yaw }))
}

fn place(flag: &str, numbers: Option<&Numbers>) -> Result<Vec2, Failure> {
    match numbers.map_or(&[][..], |numbers| &numbers.0) {
        &[x, y] if x.is_finite() && y.is_finite() => Ok(Vec2::new(x, y)),
        _ => Err(Failure::Usage(format!(
            "{flag}: expected two numbers, x and y in metres, such as 120.5,-40"
        ))),
    }
}

fn limits(args: &RouteArgs, mobility: &SlopeStudy) -> Result<Limits, Failure> {
    let mut limits = Limits::of(mobility);
    if let Some(slope) = &args.most_slope_deg {
        limits.most_slope = single("--most-slope-deg", slope, &study::MOST_SLOPE_DEG)?.to_radians();
    }
    if let Some(slip) = &args.most_slip_ratio {
        limits.most_slip_ratio = single("--most-slip-ratio", slip, &study::SHARE)?;
    }
    if let Some(share) = &args.most_no_go {
        limits.most_no_go = single("--most-no-go", share, &study::SHARE)?;
    }
    Ok(limits)
}
