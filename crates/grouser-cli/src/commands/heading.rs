//! `grouser heading`: the heading offset that holds the contour on a slope.

use grouser::answers::heading::HeadingQuestion;
use grouser::answers::{AnswerOptions, Displayed};
use grouser::studies::heading::Steering;
use grouser_draw::title_of;

use super::sampling;
use crate::args::{CardArgs, HeadingArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;
use crate::output::slide::SlideFile;

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let mut question = inputs::heading(args)?;
    let is_draft = question.sampling.is_some() && args.belief.samples.is_none();
    if let Some(sampling) = question.sampling.as_mut().filter(|_| is_draft && slide.is_some()) {
        // Nobody shows a draft to others.
        sampling.count = CardArgs::SAMPLES;
    }
    let what = sampling::what(question.gradients.as_ref(), "slopes");
    let mut answer = sampling::with_bar_of(what, question.samples(), |go_on| {
        let (has_page, is_strict) = (folder.is_some() || slide.is_some(), args.strict.strict);
        question.answer(command, &AnswerOptions { has_page, is_strict, go_on })
    })?;
    if question.sampling.is_some_and(sampling::are_few) {
        answer.screen.push(Displayed::Words(sampling::DRAFT_LINE.to_owned()));
    }
    let file = question.file(0);
    answer.next = vec![
        format!("grouser card {file} --out CARD --stops STOPS.toml"),
        format!("grouser map DEM {file} --course-deg best --out MAP"),
    ];
    if let Some(slide) = slide {
        slide.write_answer(&answer, &title_of(&question.scenarios[0]))?;
    }
    give(&answer, &repeat(command, args, &question), folder, args.output.format)
}

/// The commands that give the answer again, one for each scenario.
fn repeat(command: &str, args: &HeadingArgs, question: &HeadingQuestion) -> String {
    let slopes = args.slope_deg.joined();
    let rest = match question {
        HeadingQuestion { steering: Steering::Crab, .. } => {
            format!(" --steering {}", Steering::Crab.name())
        }
        HeadingQuestion { most_speed_ratio: Some(ratio), .. } => {
            format!(" --wheel-speeds --most-speed-ratio {ratio}")
        }
        HeadingQuestion { sampling: None, .. } => " --nominal".to_owned(),
        HeadingQuestion { sampling: Some(sampling), .. } => {
            sampling::numbers(*sampling) + &sampling::rule_flags(&question.rule)
        }
    };
    let rest = rest + &sampling::gradient_flag(question.gradients.as_ref());
    let line =
        |place| format!("grouser {command} {} --slope-deg {slopes}{rest}", question.file(place));
    (0..question.scenarios.len()).map(line).collect::<Vec<_>>().join("\n")
}
