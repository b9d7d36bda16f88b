//! `grouser learn`: what the telemetry of a drive tells of the soil, and of the next slopes.

mod advice;
mod cards;
mod found;
mod live;
mod page;
mod position;
mod records;
mod samples;
mod state_file;
mod tables;

use std::collections::BTreeMap;
use std::time::Duration;

use grouser::document::columns::SLOPE;
use grouser::document::columns::learn as columns;
use grouser::document::learn::{LearntSoil, files_of_prior};
use grouser::document::table::Table;
use grouser::document::{LoadedScenario, SAMPLES_FILE, escape};
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::learn::{Drive, LearnSettings, Learner, LearntSample, TelemetryRecord};
use serde::Serialize;
use serde_json::{Value, json};

use self::advice::AdviceTables;
use self::cards::Cards;
use self::found::{Found, shares};
use self::live::Live;
use self::position::Position;
use self::records::{Event, Records};
use self::samples::{reaches_too_far, samples};
use self::state_file::StateFile;
use self::tables::Tables;
use super::{Answer, sampling};
use crate::args::LearnArgs;
use crate::failure::Failure;
use crate::inputs::{self, Following};
use crate::interrupt;
use crate::output::folder::OutputFolder;
use crate::output::rows::Rows;
use crate::output::{self, Format};
use crate::report::REPORT;

#[derive(Serialize)]
struct Results<'a> {
    predictions: &'a Table,
    warnings: &'a Table,
    learnt: Value,
    models: BTreeMap<&'static str, f64>,
    narrowed: BTreeMap<String, f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    soil: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    advice: Option<&'a AdviceTables>,
    notes: &'a [String],
}

pub(crate) fn run(args: &LearnArgs) -> Result<(), Failure> {
    if args.follow && args.output.format == Format::Csv {
        let why =
            "--follow prints text, or with --format json lines of JSON: there is no CSV of it";
        return Err(Failure::Usage(why.to_owned()));
    }
    let folder = state_file::open_folder(args)?;
    let scenario = inputs::learn(args)?;
    let found = learn(args, &scenario)?;
    let warnings = columns::warnings(found.drive.warnings());
    let soil = args.output.out.as_ref().map(|folder| escape::path(&folder.join(SOIL)));
    let results = Results {
        predictions: &found.predictions,
        warnings: &warnings,
        learnt: learnt(found.drive.learner()),
        models: shares(found.drive.learner()),
        narrowed: found.narrowed.clone(),
        soil,
        advice: found.advice.as_ref(),
        notes: &found.notes,
    };
    let answer = Answer::new("learn", settings(args, &scenario), results);
    if let Some(folder) = folder {
        write(folder, args, &scenario, (&found, &answer))?;
    }
    match args.output.format {
        Format::Table => output::show(page::text(&found)),
        Format::Csv => output::print(&Rows::of_table(&found.predictions).to_csv()?),
        Format::Json if args.follow => live::print_line("answer", &answer),
        Format::Json => output::print_json(&answer),
    }
}

/// Writes the folder of the answer.
fn write(
    mut folder: OutputFolder,
    args: &LearnArgs,
    scenario: &LoadedScenario,
    (found, answer): (&Found, &Answer<Results<'_>>),
) -> Result<(), Failure> {
    let tables = Tables::of(args, scenario, found)?;
    folder.add("learn.json", answer.to_text());
    folder.add("predictions.csv", Rows::of_table(&found.predictions).to_csv()?);
    folder.add("lessons.csv", Rows::of_table(&tables.lessons).to_csv()?);
    let advice = found.advice.iter().map(AdviceTables::files).collect::<Result<Vec<_>, _>>()?;
    for (name, text) in advice.concat() {
        folder.add(name, text);
    }
    folder.add("warnings.csv", Rows::of_table(&tables.warnings).to_csv()?);
    if let Some(slips) = &tables.slips {
        folder.add("slip-from-current.csv", Rows::of_table(&slips.rows).to_csv()?);
    }
    let learnt = learnt_soil(args, scenario, found.drive.learner())?;
    let of_cards = learnt.as_ref().filter(|_| args.cards);
    let cards = of_cards.map(|learnt| Cards::of(args, scenario, learnt)).transpose()?;
    if let Some(learnt) = &learnt {
        folder.add(SOIL, learnt.soil.to_toml());
        folder.add(SAMPLES_FILE, &*learnt.samples);
    }
    if let Some(cards) = &cards {
        cards.add_to(&mut folder)?;
    }
    folder.add(REPORT, page::html(args, scenario, found, (&tables, cards.as_ref())));
    let (before, companions) = files_of_prior(scenario);
    folder.add("scenario.toml", before.to_toml());
    for companion in companions {
        folder.add(companion.name, companion.content);
    }
    folder.finish()
}

/// The soil's document in the folder.
const SOIL: &str = "soil.toml";

fn learn(args: &LearnArgs, scenario: &LoadedScenario) -> Result<Found, Failure> {
    let slope_is_known = args.slope_deg.is_some();
    let learner = Learner::new(scenario, slope_is_known, LearnSettings::USUAL).map_err(|error| {
        Failure::Usage(format!(
            "{error}\nhint: --prior toyoura-uncertain, or a soil with an [uncertainty] table"
        ))
    });
    let learner = learner?;
    let mut state = StateFile::of(args, scenario);
    let kept = state.read(args.output.force)?;
    let slopes: Vec<f64> =
        args.predict_slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let before = band(&learner, &samples(args, &learner)?, &slopes)?;
    let mut drive = kept.unwrap_or_else(|| Drive::new(learner));
    let live = Live::of(args, &before.slopes);
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
    let samples = samples(args, drive.learner())?;
    let after = band(drive.learner(), &samples, &slopes)?;
    let advice = advice::of(args, scenario, &drive, (&samples, &after))?;
    let predictions = columns::predictions(&before.slopes, &after.slopes);
    let narrowed = drive.learner().narrowed(args.seed, args.samples);
    let narrowed = narrowed.map_err(|error| reaches_too_far(&error))?;
    let lost = drive.lost().sentences();
    let notes = lost.into_iter().chain(ending.notes).chain(drive.learner().notes()).collect();
    Ok(Found { drive, notes, predictions, advice, narrowed })
}

/// How a log ended.
struct Ended {
    /// What there is to say of it besides what was left out of its rows.
    notes: Vec<String>,
    /// The record of a last row that may not be whole: it counts, but what is kept ends before it.
    last: Option<TelemetryRecord>,
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
    let quiet = args.follow_s.map(Duration::from_secs_f64);
    let following = args.follow.then_some(Following { quiet });
    if args.follow {
        interrupt::handle_ctrl_c();
    }
    let label = inputs::telemetry_label(&args.log);
    let is_stream = inputs::is_standard_input(&args.log);
    let mut position = Position::after(drive, &label, is_stream);
    let (log, how, rover) =
        (args.log.clone(), args.telemetry.clone(), scenario.value.rover.clone());
    let open = move || inputs::telemetry(&log, &how, &rover, following);
    let records = Records::of(open, args.follow);
    let mut last = None;
    loop {
        match records.next() {
            Event::Record { record, is_whole, lost } => {
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
            Event::Nothing => {}
            Event::End(ending) => {
                position.check_end()?;
                if ending.rows == 0 && drive.records() == 0 && !interrupt::is_asked_to_stop() {
                    return Err(Failure::Usage(format!("{label}: has no rows of telemetry")));
                }
                if ending.rows > 0 {
                    drive.note_lost(position.lost(ending.lost));
                }
                if let Some(live) = &mut live {
                    live.finish()?;
                }
                return Ok(Ended { notes: ending.notes, last });
            }
            Event::Failed(failure) => return Err(failure),
        }
        if let Some(live) = &mut live {
            live.predictions(drive, slopes)?;
        }
    }
}

fn band(
    learner: &Learner,
    samples: &[LearntSample],
    slopes: &[f64],
) -> Result<HeadingBand, Failure> {
    let band = sampling::with_bar(samples.len(), |go_on| learner.predict(samples, slopes, go_on));
    Ok(sampling::whole(band?))
}

/// The soil that was learnt.
fn learnt_soil(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    learner: &Learner,
) -> Result<Option<LearntSoil>, Failure> {
    let log = escape::path(&args.log);
    let found = LearntSoil::now(scenario, learner, (args.seed, args.samples), &log);
    found.map_err(|error| reaches_too_far(&error))
}

fn learnt(learner: &Learner) -> Value {
    let learnt = learner.learnt();
    json!({
        "records": learnt.records,
        "stretches": learnt.stretches,
        (columns::WAY.name): learnt.way,
        "outliers": learnt.outliers,
        "stretches_not_used": learnt.not_used.values().sum::<u64>(),
    })
}

/// The inputs of the answer.
fn settings(args: &LearnArgs, scenario: &LoadedScenario) -> Value {
    let document = &scenario.document;
    json!({
        "log": args.log.display().to_string(),
        "rover": document.get("rover"),
        "soil": document.get("soil"),
        "slope_deg": args.slope_deg.as_ref().and_then(|_| document.get("slope_deg")),
        "gravity_m_s2": document.get("gravity_m_s2"),
        "load_transfer": document.get("load_transfer"),
        "wheel_moments": document.get("wheel_moments"),
        "model": document.model().map(|model| model.name()),
        "predict_slope_deg": args.predict_slope_deg.0,
        "samples": args.samples,
        "seed": args.seed,
        "advice": advice::settings(&args.advice).map(|it| it.into_iter().collect::<BTreeMap<_, _>>()),
    })
}
