//! `grouser learn`: what the telemetry of a drive tells of the soil, and of the next slopes.

mod advice;
mod found;
mod page;

use std::collections::BTreeMap;

use grouser::document::columns::SLOPE;
use grouser::document::columns::learn as columns;
use grouser::document::learn::LearntSoil;
use grouser::document::measurements::telemetry::TelemetryReader;
use grouser::document::table::Table;
use grouser::document::{Kind, LoadedScenario, SAMPLES_FILE, escape};
use grouser::studies::heading_band::HeadingBand;
use grouser::studies::learn::{LearnSettings, Learner, LearntSample, Lesson, NotUsed};
use serde::Serialize;
use serde_json::{Value, json};

use self::advice::AdviceTables;
use self::found::{Found, shares};
use super::{Answer, sampling};
use crate::args::LearnArgs;
use crate::failure::Failure;
use crate::inputs;
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

/// Lessons that a report has at most: of a longer drive every n-th.
const MOST_LESSONS: usize = 5000;

pub(crate) fn run(args: &LearnArgs) -> Result<(), Failure> {
    let folder = OutputFolder::for_args(&args.output)?;
    let scenario = inputs::learn(args)?;
    let found = learn(args, &scenario)?;
    let warnings = columns::warnings(&found.warnings);
    let soil = args.output.out.as_ref().map(|folder| escape::path(&folder.join(SOIL)));
    let results = Results {
        predictions: &found.predictions,
        warnings: &warnings,
        learnt: learnt(&found.learner),
        models: shares(&found.learner),
        narrowed: found.narrowed.clone(),
        soil,
        advice: found.advice.as_ref(),
        notes: &found.notes,
    };
    let answer = Answer::new("learn", settings(args, &scenario), results);
    if let Some(mut folder) = folder {
        let lessons = columns::lessons(&found.lessons);
        folder.add("learn.json", answer.to_text());
        folder.add("predictions.csv", Rows::of_table(&found.predictions).to_csv()?);
        folder.add("lessons.csv", Rows::of_table(&lessons).to_csv()?);
        for (name, text) in
            found.advice.iter().map(AdviceTables::files).collect::<Result<Vec<_>, _>>()?.concat()
        {
            folder.add(name, text);
        }
        add_soil(&mut folder, args, &scenario, &found.learner)?;
        folder.add(REPORT, page::html(args, &scenario, &found, &lessons));
        folder.add_document("scenario.toml", &scenario);
        folder.finish()?;
    }
    match args.output.format {
        Format::Table => output::show(page::text(&found)),
        Format::Csv => output::print(&Rows::of_table(&found.predictions).to_csv()?),
        Format::Json => output::print_json(&answer),
    }
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
    let mut learner = learner?;
    let slopes: Vec<f64> =
        args.predict_slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let before = band(&learner, &samples(args, &learner)?, &slopes)?;
    let (mut lessons, mut warnings) = (Vec::new(), Vec::new());
    let notes = read(args, scenario, &mut learner, &mut |lesson: Lesson| {
        warnings.extend(lesson.warnings.iter().cloned());
        keep(&mut lessons, lesson);
    })?;
    let samples = samples(args, &learner)?;
    let after = band(&learner, &samples, &slopes)?;
    let advice = advice::of(args, scenario, &learner, (&samples, &after), &lessons)?;
    let predictions = columns::predictions(&before.slopes, &after.slopes);
    let narrowed = learner.narrowed(args.seed, args.samples);
    let narrowed = narrowed.map_err(|error| reaches_too_far(&error))?;
    Ok(Found { learner, lessons, warnings, notes, predictions, advice, narrowed })
}

/// Keeps a lesson; where there are too many, every second of them, so that memory does not grow with the drive.
fn keep(lessons: &mut Vec<Lesson>, lesson: Lesson) {
    if lessons.len() >= MOST_LESSONS {
        let mut place = 0;
        lessons.retain(|_| {
            place += 1;
            place % 2 == 0
        });
    }
    lessons.push(lesson);
}

/// Teaches the learner all records of the log; notes on what was left out.
fn read(
    args: &LearnArgs,
    scenario: &LoadedScenario,
    learner: &mut Learner,
    lesson: &mut dyn FnMut(Lesson),
) -> Result<Vec<String>, Failure> {
    let (label, source) = inputs::telemetry(&args.log)?;
    let mut reader = TelemetryReader::new(&label, source, &scenario.value.rover)?;
    while let Some(record) = reader.next_record()? {
        if let Some(learnt) = learner.update(record) {
            lesson(learnt);
        }
    }
    if let Some(learnt) = learner.finish() {
        lesson(learnt);
    }
    if reader.rows() == 0 {
        return Err(Failure::Usage(format!("{label}: has no rows below its header")));
    }
    let unused = not_known(reader.unused());
    Ok(reader.lost().sentences().into_iter().chain(unused).chain(not_used(learner)).collect())
}

/// The columns that are not known, as many as a sentence bears.
fn not_known(names: &[String]) -> Option<String> {
    const MOST: usize = 6;
    let more = names.len().saturating_sub(MOST);
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    let first = names.get(..MOST).unwrap_or(names).join(", ");
    (!names.is_empty()).then(|| format!("columns not used: {first}{more}"))
}

/// Why stretches of the drive taught nothing, a sentence each.
fn not_used(learner: &Learner) -> Vec<String> {
    let learnt = learner.learnt();
    let sentence = |why: NotUsed| {
        let count = learnt.not_used.get(&why)?;
        Some(format!("{count} stretches taught nothing: {}", why.meaning()))
    };
    let outliers = (learnt.outliers > 0)
        .then(|| format!("{} readings far from those around them are left out", learnt.outliers));
    NotUsed::ALL.into_iter().filter_map(sentence).chain(outliers).collect()
}

fn band(
    learner: &Learner,
    samples: &[LearntSample],
    slopes: &[f64],
) -> Result<HeadingBand, Failure> {
    let band = sampling::with_bar(samples.len(), |go_on| learner.predict(samples, slopes, go_on));
    Ok(sampling::whole(band?))
}

fn samples(args: &LearnArgs, learner: &Learner) -> Result<Vec<LearntSample>, Failure> {
    learner.samples(args.seed, args.samples).map_err(|error| reaches_too_far(&error))
}

fn reaches_too_far(error: &dyn std::error::Error) -> Failure {
    Failure::Usage(format!("the soil's uncertainty reaches too far: {error}"))
}

fn add_soil(
    folder: &mut OutputFolder,
    args: &LearnArgs,
    scenario: &LoadedScenario,
    learner: &Learner,
) -> Result<(), Failure> {
    let prior = scenario.document.part(Kind::Soil, "soil").zip(scenario.uncertain.as_ref());
    let Some((document, uncertain)) = prior else { return Ok(()) };
    let found = learner.samples_of_best(args.seed, args.samples);
    let (theory, samples) = found.map_err(|error| reaches_too_far(&error))?;
    let source = format!(
        "learnt by Grouser {} from {:.1} m of the drive {}",
        env!("CARGO_PKG_VERSION"),
        learner.learnt().way,
        escape::path(&args.log),
    );
    let learnt = LearntSoil::of((&document, uncertain), theory, &samples, &source);
    folder.add(SOIL, learnt.soil.to_toml());
    folder.add(SAMPLES_FILE, learnt.samples);
    Ok(())
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
        "model": document.theory().map(grouser::contact::Theory::name),
        "predict_slope_deg": args.predict_slope_deg.0,
        "samples": args.samples,
        "seed": args.seed,
        "advice": advice::settings(&args.advice).map(|it| it.into_iter().collect::<BTreeMap<_, _>>()),
    })
}
