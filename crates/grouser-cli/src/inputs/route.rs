//! What a route is made of.

use grouser::document::LoadedScenario;
use grouser::studies::mobility::MobilityStudy;
use grouser::studies::route::{Ends, Limits, RouteStudy};
use grouser::terrain::{Extent, SoilZones};
use grouser::units::Vec2;
use grouser_raster::zones::ZoneKey;
use grouser_raster::{Raster, ReadOptions, read_areas};

use super::card::{rim_speed, rule};
use super::{balanced, refuse_sampled_keys, single};
use crate::args::RouteArgs;
use crate::failure::Failure;
use crate::list::Numbers;

/// What a route is made of.
pub(crate) struct RouteInputs {
    pub(crate) scenario: LoadedScenario,
    pub(crate) study: RouteStudy,
    pub(crate) ends: Ends,
    pub(crate) raster: Raster,
}

pub(crate) fn route(args: &RouteArgs) -> Result<RouteInputs, Failure> {
    let ends = Ends {
        from: place("--from", &args.from)?,
        to: place("--to", &args.to)?,
        yaw: args.yaw_deg.map(f64::to_radians),
    };
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let (setting, balance) = (&args.setting, &args.balance);
    let scenario = balanced("route", args.scenario.as_deref(), rover, soil, setting, balance)?;
    refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
    let mobility = MobilityStudy {
        rim_speed: rim_speed(args.rim_speed_m_s.as_ref(), &scenario)?,
        rule: rule(&args.rule)?,
        ..MobilityStudy::of(&scenario)
    };
    let limits = limits(args, &mobility)?;
    let raster = grouser_raster::read(&args.dem, &ReadOptions::default())?;
    let keep_out = match &args.keep_out {
        Some(file) => Some(areas(file, &raster.grid.extent(), &mobility)?),
        None => None,
    };
    let study = RouteStudy { mobility, limits, keep_out };
    Ok(RouteInputs { scenario, study, ends, raster })
}

fn place(flag: &str, numbers: &Numbers) -> Result<Vec2, Failure> {
    match numbers.0[..] {
        [x, y] if x.is_finite() && y.is_finite() => Ok(Vec2::new(x, y)),
        _ => Err(Failure::Usage(format!(
            "{flag}: expected two numbers, x and y in metres, such as 120.5,-40"
        ))),
    }
}

fn limits(args: &RouteArgs, mobility: &MobilityStudy) -> Result<Limits, Failure> {
    let mut limits = Limits::of(mobility);
    if let Some(slope) = &args.most_slope_deg {
        limits.most_slope = single("--most-slope-deg", slope, &(0.0..=60.0))?.to_radians();
    }
    if let Some(slip) = &args.most_slip_ratio {
        limits.most_slip_ratio = single("--most-slip-ratio", slip, &(0.0..=1.0))?;
    }
    if let Some(share) = &args.most_no_go {
        limits.most_no_go = single("--most-no-go", share, &(0.0..=1.0))?;
    }
    Ok(limits)
}

/// The areas of a file.
fn areas(
    file: &std::path::Path,
    ground: &Extent,
    mobility: &MobilityStudy,
) -> Result<SoilZones, Failure> {
    let map = read_areas(file, ground)?;
    // That there is a zone is all that counts.
    let legend = [(ZoneKey::Class(0), Some(0))];
    map.with_legend(&legend, vec![mobility.heading.soil])
        .map_err(|fault| Failure::Usage(format!("{}: {fault}", file.display())))
}
