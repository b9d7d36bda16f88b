//! `grouser slip-from-current`: the slip of each wheel from a log of its motor's current and speed.

use grouser::answers::slip_from_current::SlipQuestion;
use grouser::document::escape;
use grouser::studies::slip_from_current::{SlipEstimate, SlipStatus};

use super::sampling;
use crate::args::SlipFromCurrentArgs;
use crate::failure::Failure;
use crate::inputs::{self, SlipInputs};
use crate::list::Numbers;
use crate::output;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;

pub(crate) fn run(args: &SlipFromCurrentArgs) -> Result<(), Failure> {
    let mut folder = OutputFolder::for_args(&args.output)?;
    let SlipInputs { question, estimator, log, notes, bytes } = inputs::slip_from_current(args)?;
    let found =
        sampling::with_bar(estimator.log_steps(&log), |go_on| estimator.of_log(&log, go_on));
    let found = sampling::whole(found);
    let answer = question.answer("slip-from-current", &log, &found);
    output::notes(notes.iter().map(|note| escape::line(note)));
    if let Some(folder) = &mut folder {
        folder.add("log.csv", bytes);
    }
    give(&answer, &repeat(args, &question), folder, args.output.format)?;
    check_some(&found)
}

/// Checks that some readings tell a slip, or that wheels stand.
fn check_some(found: &[Vec<Option<SlipEstimate>>]) -> Result<(), Failure> {
    let all = || found.iter().flatten().flatten().map(|it| it.status);
    let tells = [SlipStatus::Ok, SlipStatus::IllPosed, SlipStatus::Standing];
    let count = |status: SlipStatus| all().filter(|it| *it == status).count();
    let commonest = SlipStatus::ALL.into_iter().max_by_key(|status| count(*status));
    match commonest.filter(|_| !all().any(|it| tells.contains(&it))) {
        Some(why) if count(why) > 0 => Err(Failure::Run(format!(
            "no reading tells a slip: {} of {} are `{}`: {}\nhint: currents are in A, speeds in \
             rad/s at the wheel",
            count(why),
            all().count(),
            why.name(),
            why.meaning()
        ))),
        _ => Ok(()),
    }
}

/// The command that gives the answer again.
fn repeat(args: &SlipFromCurrentArgs, question: &SlipQuestion) -> String {
    let flags = [
        ("--yaw-deg", args.yaw_deg.as_ref()),
        ("--course-deg", args.course_deg.as_ref()),
        ("--relative-noise", Some(&args.relative_noise)),
        ("--noise-nm", Some(&args.noise_nm)),
        ("--slip-ratio", Some(&args.slip_ratio)),
    ];
    let flags = flags.into_iter().filter_map(|(flag, numbers)| Some((flag, numbers?)));
    let flags = flags.map(|(flag, numbers)| format!(" {flag}={}", Numbers::joined(numbers)));
    let ignored = match question.ignored.join(",") {
        names if names.is_empty() => names,
        names => format!(" --ignore {names}"),
    };
    let samples = sampling::flags(question.sampling);
    let flags: String = flags.collect();
    format!("grouser slip-from-current log.csv --scenario scenario.toml{flags}{ignored}{samples}")
}
