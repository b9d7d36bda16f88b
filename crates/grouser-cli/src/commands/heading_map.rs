//! `grouser heading-map`: the heading offset over slope, course and soil.

use grouser::answers::AnswerOptions;
use grouser::answers::heading_map::HeadingMapQuestion;

use super::sampling;
use crate::args::HeadingMapArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::list::Numbers;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;

/// * `command`: the name by which it was asked for, which its results and files have
pub(crate) fn run(command: &str, args: &HeadingMapArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let question = inputs::heading_map(args)?;
    let what = sampling::what(question.gradients.as_ref(), "courses");
    let answer = sampling::with_bar_of(what, question.samples(), |go_on| {
        let (has_page, is_strict) = (folder.is_some(), args.strict.strict);
        question.answer(command, &AnswerOptions { has_page, is_strict, go_on })
    })?;
    give(&answer, &repeat(command, args, &question), folder, args.output.format)
}

/// The commands that give the answer again, one for each scenario.
fn repeat(command: &str, args: &HeadingMapArgs, question: &HeadingMapQuestion) -> String {
    let [slopes, courses] = [&args.slope_deg, &args.course_deg].map(Numbers::joined);
    let (speed, samples) = (question.rim_speed, sampling::flags(question.sampling));
    let gradients = sampling::gradient_flag(question.gradients.as_ref());
    let line = |place| {
        let file = question.file(place);
        format!(
            "grouser {command} {file} --slope-deg {slopes} --course-deg {courses} \
             --rim-speed-m-s {speed}{samples}{gradients}"
        )
    };
    (0..question.scenarios.len()).map(line).collect::<Vec<_>>().join("\n")
}
