//! The inputs of headings: on slopes of one scenario, and over slope, course and soil.

use grouser::answers::heading::HeadingQuestion;
use grouser::answers::heading_map::HeadingMapQuestion;
use grouser::document::{self, LoadedScenario};
use grouser::studies::heading::Steering;

use super::card::rule;
use super::{balanced, check_numbers, check_samples, check_slopes, refuse_sampled_keys, single};
use crate::args::{GradientArgs, HeadingArgs, HeadingMapArgs, SettingArgs};
use crate::failure::Failure;

/// The question of `heading`: for each model that is asked for the scenario whose rover, soil and
/// load transfer count; its slope is not used.
pub(crate) fn heading(args: &HeadingArgs) -> Result<HeadingQuestion, Failure> {
    check_slopes(&args.slope_deg)?;
    let name = args.scenario.as_deref();
    // What is no heading of the body has no samples, unless they are asked for by name: then it
    // is refused.
    let has_headings = args.steering == Steering::None && !args.wheel_speeds;
    let is_sampled = has_headings || args.belief.is_asked_for();
    let is_sampled = is_sampled && (args.gradients.keys().is_none() || args.belief.is_asked_for());
    let sampling = args.belief.sampling().filter(|_| is_sampled);
    if let Some(sampling) = sampling {
        check_samples(sampling.count, args.slope_deg.0.len())?;
    }
    let (rover, soil) = (args.parts.rover.as_ref(), args.parts.soil.as_ref());
    let read = |setting: &SettingArgs| {
        let scenario = balanced("heading", name, rover, soil, setting, &args.balance)?;
        if sampling.is_some() {
            refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
        }
        if !args.belief.nominal {
            refuse_belief(&args.gradients, &scenario)?;
        }
        Ok(scenario)
    };
    let settings = args.setting.each_model();
    let scenarios = settings.iter().map(read).collect::<Result<Vec<_>, Failure>>()?;
    Ok(HeadingQuestion {
        scenarios,
        slopes_deg: args.slope_deg.0.clone(),
        steering: args.steering,
        most_speed_ratio: args.wheel_speeds.then_some(args.most_speed_ratio),
        sampling,
        rule: rule(&args.rule)?,
        gradients: args.gradients.keys(),
    })
}

/// Refuses derivatives on a soil that is believed to be one of many: they are of the soil as its
/// document has it, which nobody has asked for.
fn refuse_belief(gradients: &GradientArgs, scenario: &LoadedScenario) -> Result<(), Failure> {
    if gradients.keys().is_none() || scenario.soils_of_bands().is_none() {
        return Ok(());
    }
    Err(Failure::Usage(
        "--gradients: derivatives are of the soil as its document has it, with one model, and this \
         soil is uncertain\nhint: --nominal asks for that answer"
            .to_owned(),
    ))
}

/// The question of a heading map. Its scenarios are one for each model that is asked for and soil:
/// all soils of the first model, then those of the next.
pub(crate) fn heading_map(args: &HeadingMapArgs) -> Result<HeadingMapQuestion, Failure> {
    use document::study;
    check_slopes(&args.slope_deg)?;
    check_numbers("--course-deg", &args.course_deg, &study::COURSE_DEG)?;
    let rim_speed = single("--rim-speed-m-s", &args.rim_speed_m_s, &study::MAP_SPEED_M_S)?;
    let soils: Vec<Option<&String>> =
        if args.soil.is_empty() { vec![None] } else { args.soil.iter().map(Some).collect() };
    let settings = args.setting.each_model();
    let rows = settings.len() * soils.len() * args.slope_deg.0.len() * args.course_deg.0.len();
    let sampling = args.uncertainty.sampling();
    check_samples(sampling.map_or(1, |it| it.count), rows)?;
    let (name, rover) = (args.scenario.as_deref(), args.rover.as_ref());
    let read = |setting: &SettingArgs, soil: Option<&String>| {
        let scenario = balanced("heading-map", name, rover, soil, setting, &args.balance)?;
        if sampling.is_some() {
            refuse_sampled_keys(setting, scenario.uncertain.as_ref())?;
        }
        Ok(scenario)
    };
    let pairs = settings.iter().flat_map(|setting| soils.iter().map(move |soil| (setting, *soil)));
    let scenarios =
        pairs.map(|(setting, soil)| read(setting, soil)).collect::<Result<Vec<_>, Failure>>()?;
    Ok(HeadingMapQuestion {
        scenarios,
        has_every_model: args.setting.has_every_model(),
        slopes_deg: args.slope_deg.0.clone(),
        courses_deg: args.course_deg.0.clone(),
        rim_speed,
        sampling,
        gradients: args.gradients.keys(),
    })
}
