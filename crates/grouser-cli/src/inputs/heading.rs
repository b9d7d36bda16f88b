//! The inputs of headings: on slopes of one scenario, and over slope, course and soil.

use grouser::document::{self, LoadedScenario};

use super::{balanced, check_numbers, check_samples, check_slopes};
use crate::args::{HeadingArgs, HeadingMapArgs, SettingArgs};
use crate::failure::Failure;

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

/// The scenarios of a heading map, one for each model that is asked for and soil: all soils of the
/// first model, then those of the next.
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
