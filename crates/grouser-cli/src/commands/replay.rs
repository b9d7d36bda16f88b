//! `grouser replay`: a drive that was measured beside the one that is predicted.

use grouser::answers::replay::{ROVER, ReplayQuestion};
use grouser::answers::{Answer, Displayed};
use grouser::document::escape;
use grouser::studies::replay::{Replay, Replayer};
use grouser_draw::title_of;
use grouser_logs::TelemetryLog;

use super::{log, sampling};
use crate::args::ReplayArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::output::answer::give;
use crate::output::folder::OutputFolder;
use crate::output::slide::SlideFile;

pub(crate) fn run(args: &ReplayArgs) -> Result<(), Failure> {
    let mut folder = OutputFolder::for_args(&args.output)?;
    let (has_folder, may_replace) = (folder.is_some(), args.output.force);
    let target = args.mcap.as_deref().map(|it| log::Target::of(it, has_folder, may_replace));
    let target = target.transpose()?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let question = inputs::replay(args)?;
    let (replay, log) = replay(args, &question)?;
    if let Some(target) = target {
        target.write_replay(&question.scenario, &replay, folder.as_mut())?;
    }
    let mut answer = question.answer("replay", &replay, log.given(), log.notes());
    let slope = args.slope_deg.as_ref().map_or(String::new(), |it| format!(" --slope-deg={it}"));
    let ends = question.part.ends().into_iter().zip(["from-s", "to-s"]);
    let part: String = ends.filter_map(|(end, name)| Some(format!(" --{name}={}", end?))).collect();
    let samples = sampling::flags(question.sampling);
    let odometry = args.telemetry.odometry_option();
    let repeat =
        format!("grouser replay log.csv --scenario scenario.toml{slope}{part}{samples}{odometry}");
    answer.next = next(&answer);
    if has_rover(&answer) {
        let line = match &args.output.out {
            Some(out) => {
                let file = escape::path(&out.join(ROVER));
                format!("{file}: the rover with wheels of the radius that the drive points to\n")
            }
            None => {
                format!("hint: --out DIR writes {ROVER}, the rover with wheels of that radius\n")
            }
        };
        answer.screen.push(Displayed::Words(line));
    }
    if let Some(slide) = slide {
        slide.write_answer(&answer, &title_of(&question.scenario))?;
    }
    give(&answer, &repeat, folder, args.output.format)?;
    check_predicted(log.label(), &replay)?;
    inputs::check_share_used(log.label(), log.share_used(), &args.telemetry.log)
}

/// Checks that a stretch could be predicted: without one nothing of the drive was compared.
fn check_predicted(label: &str, replay: &Replay) -> Result<(), Failure> {
    match replay.nothing_predicted() {
        None => Ok(()),
        Some(why) => Err(Failure::Run(format!(
            "{label}: no stretch could be predicted, and nothing is compared: {why}"
        ))),
    }
}

/// Whether the drive points to a changed rover.
fn has_rover(answer: &Answer) -> bool {
    answer.documents.iter().any(|it| it.file == ROVER)
}

/// The commands to go on with.
fn next(answer: &Answer) -> Vec<String> {
    let has_rover = has_rover(answer);
    let with_rover = [
        format!("grouser check {ROVER}"),
        format!("grouser replay log.csv --scenario scenario.toml --rover {ROVER} --out OTHER"),
    ];
    let learn = "grouser learn log.csv --scenario scenario.toml --prior SOIL --out LEARNT";
    with_rover.into_iter().filter(|_| has_rover).chain([learn.to_owned()]).collect()
}

/// The log, replayed, and as it was read to its end.
fn replay(args: &ReplayArgs, question: &ReplayQuestion) -> Result<(Replay, TelemetryLog), Failure> {
    let scenario = &question.scenario.value;
    let samples = match question.sampling {
        Some(it) => sampling::draw_of(&question.scenario, it)?,
        None => Vec::new(),
    };
    let slope = scenario.ground.plane_slope().filter(|_| question.has_slope);
    let mut replayer = Replayer::new(scenario, slope).within(question.part);
    let mut log = inputs::telemetry(&args.logs, &args.telemetry, &scenario.rover, None)?;
    while let Some(record) = log.next_record()? {
        replayer.update(record);
    }
    let replay = sampling::with_bar(samples.len(), |go_on| replayer.finish(&samples, go_on));
    let replay = replay.map_err(|error| Failure::Usage(format!("{}: {error}", log.label())))?;
    Ok((sampling::whole(replay), log))
}
