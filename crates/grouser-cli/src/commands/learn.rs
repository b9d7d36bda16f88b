//! `grouser learn`: what the telemetry of a drive tells of the soil, and of the next slopes.

mod advice;
mod cards;
mod live;
mod position;
mod records;
mod slips;
mod state_file;
mod watch;

use grouser::answers::learn::{LearnQuestion, LearntDrive, SOIL_FILE};
use grouser::answers::{Answer, Sampling};
use grouser::document::columns::learn::gross_in_words;
use grouser::document::given_file::GivenFile;
use grouser::document::learn::LearntSoil;
use grouser::document::{LoadedScenario, SAMPLES_FILE};
use grouser::studies::ensemble::samples::{BandInputs, Sample};
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::learn::{Drive, LearnSettings, Learner, NotUsed, TelemetryRecord};
use grouser::studies::verdict::SlopeStudy;
use grouser_draw::title_of;
use grouser_logs::TelemetryLog;

use self::cards::Cards;
use self::live::Live;
use self::position::Position;
use self::records::{Event, Records};
use self::state_file::StateFile;
use self::watch::LogWatch;
use super::sampling;
use crate::args::LearnArgs;
use crate::failure::Failure;
use crate::inputs;
use crate::interrupt;
use crate::output;
use crate::output::Format;
use crate::output::answer::{give, write};
use crate::output::folder::OutputFolder;
use crate::output::slide::SlideFile;

pub(crate) fn run(args: &LearnArgs) -> Result<(), Failure> {
    if args.follow && args.output.format == Format::Csv {
        let why =
            "--follow prints text, or with --format json lines of JSON: there is no CSV of it";
        return Err(Failure::Usage(why.to_owned()));
    }
    let mut folder = state_file::open_folder(args)?;
    let slide = SlideFile::of(&args.slide, args.output.force)?;
    let question = inputs::learn(args)?;
    let (mut found, share_used) = learn(args, &question)?;
    let taught = check_taught(args, found.drive.learner());
    if folder.is_some() {
        found.slips = slips::of(&question, &found.drive)?;
    }
    let mut answer = question.answer("learn", &found);
    if let Some(folder) = folder.as_mut().filter(|_| taught.is_ok()) {
        add_soil(folder, args, (&question, &found.drive), &mut answer)?;
    }
    answer.next.push("grouser replay LOG --rover ROVER --soil SOIL --out REPLAYED".to_owned());
    if let Some(slide) = slide {
        slide.write_answer(&answer, &title_of(&question.scenario))?;
    }
    let repeat = repeat(args, &question);
    if args.follow && args.output.format == Format::Json {
        // The answer is the last line.
        write(&answer, &repeat, &[], folder)?;
        live::print_line("answer", &answer)?;
    } else {
        give(&answer, &repeat, folder, args.output.format)?;
    }
    taught?;
    let label = inputs::telemetry_label(&args.logs);
    inputs::check_share_used(&label, share_used, &args.telemetry.log)
}

/// Checks that the log taught something: predictions of a log that did not are those of before, and
/// no soil was learnt.
fn check_taught(args: &LearnArgs, learner: &Learner) -> Result<(), Failure> {
    let learnt = learner.learnt();
    if learnt.is_something() {
        return Ok(());
    }
    let label = inputs::telemetry_label(&args.logs);
    let notes = learner.notes();
    let gross = learner.gross_faults().first().map(gross_in_words);
    let why = gross.as_ref().or(notes.first());
    let why = why.map_or("no rows make up a stretch of the way", String::as_str);
    // Wheels of one side may be mounted the other way round.
    let mirrored = learnt.not_used.contains_key(&NotUsed::Manoeuvre);
    let hint = "\nhint: where one side's speeds have the other sign throughout, `sign = -1` in a \
                mapping turns them";
    let hint = if mirrored { hint } else { "" };
    Err(Failure::Run(format!("{label}: nothing was learnt: {why}; no soil is written{hint}")))
}

/// Adds the soil that was learnt to the folder; and, if they are asked for, the cards of before and
/// after to it and to the answer.
fn add_soil(
    folder: &mut OutputFolder,
    args: &LearnArgs,
    (question, drive): (&LearnQuestion, &Drive),
    answer: &mut Answer,
) -> Result<(), Failure> {
    let (scenario, log) = (&question.scenario, TelemetryLog::label_of(&args.logs));
    let learnt = LearntSoil::now(scenario, drive, (args.seed, args.samples), &log);
    let Some(learnt) = learnt? else { return Ok(()) };
    if args.cards && learnt.soil.get("contradictions").is_some() {
        output::notes(["no cards are made of a soil that contradicts itself"]);
    } else if args.cards {
        Cards::of(args, scenario, &learnt)?.add_to(folder, answer);
    }
    answer.next = vec![
        format!("grouser card --rover ROVER --soil {SOIL_FILE} --out CARD --stops STOPS.toml"),
        format!("grouser heading --rover ROVER --soil {SOIL_FILE} --slope-deg LIST --out HEADINGS"),
    ];
    folder.add(SOIL_FILE, learnt.soil.to_toml());
    folder.add(SAMPLES_FILE, learnt.samples);
    Ok(())
}

/// The command that gives the answer again.
fn repeat(args: &LearnArgs, question: &LearnQuestion) -> String {
    let slope = args.slope_deg.as_ref().map_or(String::new(), |it| format!(" --slope-deg={it}"));
    let (slopes, advice) = (args.predict_slope_deg.joined(), question.advice.as_ref());
    format!(
        "grouser learn log.csv --scenario scenario.toml{slope} --predict-slope-deg {slopes} \
         --samples {} --seed {}{}{}",
        args.samples,
        args.seed,
        advice::flags(advice),
        args.telemetry.odometry_option()
    )
}

/// Learns from the log, and says what share of it was used; slips from currents are left out.
fn learn(args: &LearnArgs, question: &LearnQuestion) -> Result<(LearntDrive, f64), Failure> {
    let scenario = &question.scenario;
    let learner = Learner::new(scenario, question.has_slope, LearnSettings::USUAL);
    let learner = learner.map_err(|error| {
        Failure::Usage(format!(
            "{error}\nhint: --prior toyoura-uncertain, or a soil with an [uncertainty] table"
        ))
    })?;
    let mut state = StateFile::of(args, scenario);
    let kept = state.read(args.output.force)?;
    let slopes = question.slopes();
    let samples = Sampling::draw(question.sampling, &BandInputs::of_scenario(scenario))?;
    let before = band(&learner, &samples, &slopes)?;
    let mut drive = kept.unwrap_or_else(|| Drive::new(learner));
    let live = Live::of(args, scenario, &before.slopes);
    let ending = drive_on(args, scenario, &mut drive, (&mut state, live), &slopes)?;
    state.keep(&drive)?;
    let drive = ending.last.map_or_else(
        || drive.finished(),
        |last| {
            let mut whole = drive.clone();
            whole.update(last);
            whole.finished()
        },
    );
    let learner = drive.learner();
    let Sampling { seed, count } = question.sampling;
    let (now, samples) = LearntSoil::believed(scenario, learner, (seed, count))?;
    let after = band(learner, &samples, &slopes)?;
    let study = SlopeStudy::of(&now);
    let verdicts = after.slopes.iter().map(|slope| slope.advice(&study, &samples)).collect();
    let advice = advice::of(question, &drive, (&samples, &after))?;
    let narrowed = learner.narrowed(args.seed, args.samples)?;
    let lost = drive.lost().sentences();
    let notes = lost.into_iter().chain(ending.notes).chain(learner.notes()).collect();
    let (given, slips) = (ending.given, None);
    let found =
        LearntDrive { drive, before, after, verdicts, advice, narrowed, slips, given, notes };
    Ok((found, ending.share_used))
}

/// How a log ended.
struct Ended {
    /// What there is to say of it besides what was left out of its rows.
    notes: Vec<String>,
    /// The record of a last row that may not be whole: it counts, but what is kept ends before it.
    last: Option<TelemetryRecord>,
    /// What it and its mapping gave; nothing where nobody knows.
    given: Vec<GivenFile>,
    /// The share of the log that was used [-].
    share_used: f64,
}

/// Learns from all records of the log that are new, and keeps and prints what was learnt on the
/// way.
fn drive_on(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    drive: &mut Drive,
    (state, mut live): (&mut StateFile<'_>, Option<Live<'_>>),
    slopes: &[f64],
) -> Result<Ended, Failure> {
    let mut watch = LogWatch::of(args);
    let following = watch.following();
    if args.follow {
        interrupt::handle_ctrl_c();
    }
    let label = inputs::telemetry_label(&args.logs);
    let is_stream = inputs::is_standard_input(&args.logs);
    let mut position = Position::after(drive, &label, is_stream);
    let (logs, how, rover) =
        (args.logs.clone(), args.telemetry.clone(), scenario.value.rover.clone());
    let open = move || inputs::telemetry(&logs, &how, &rover, following);
    let records = Records::of(open, args.follow);
    let mut last = None;
    loop {
        match records.next() {
            Event::Record { record, is_whole, lost } => {
                watch.record(record.time);
                if !position.is_new(&record, &lost)? {
                    continue;
                }
                drive.note_lost(position.lost(lost));
                if !is_whole {
                    // A row that is still being written is left alone while the log is followed.
                    last = (!args.follow).then_some(record);
                    continue;
                }
                let lesson = drive.update(record);
                if let Some((live, lesson)) = live.as_mut().zip(lesson) {
                    live.lesson(lesson)?;
                }
                state.keep_now_and_then(drive)?;
            }
            Event::Nothing => watch.look(),
            Event::End(ending) => {
                position.check_end()?;
                if ending.rows == 0 && drive.records() == 0 && !interrupt::is_asked_to_stop() {
                    return Err(Failure::Usage(format!("{label}: has no rows of telemetry")));
                }
                if ending.rows > 0 {
                    drive.note_lost(position.lost(ending.lost.clone()));
                }
                if let Some(live) = &mut live {
                    live.finish()?;
                }
                let records::Ending { notes, given, share_used, .. } = ending;
                return Ok(Ended { notes, last, given, share_used });
            }
            Event::Failed(failure) => return Err(failure),
        }
        if let Some(live) = &mut live {
            live.predictions(drive, slopes)?;
        }
    }
}

fn band(learner: &Learner, samples: &[Sample], slopes: &[f64]) -> Result<HeadingBand, Failure> {
    let band = sampling::with_bar(samples.len(), |go_on| learner.predict(samples, slopes, go_on));
    Ok(sampling::whole(band?))
}
