//! What is learnt while a log grows: lines of text, or lines of JSON.

use std::collections::BTreeMap;
use std::panic::resume_unwind;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use grouser::answers::learn::{shares, slope_in_words, warning_in_words};
use grouser::document::LoadedScenario;
use grouser::document::columns::TIME;
use grouser::document::columns::learn as columns;
use grouser::document::json;
use grouser::document::learn::LearntSoil;
use grouser::document::table::Table;
use grouser::studies::heading_band::SlopeBand;
use grouser::studies::learn::{Drive, Lesson};
use serde::Serialize;
use serde_json::{Map, Value, json};

use crate::args::LearnArgs;
use crate::commands::sampling;
use crate::failure::Failure;
use crate::output::{self, Format};

/// Prints what a log that is followed tells on the way.
///
/// Predictions take longer than learning. They are computed in a thread of their own, from a copy
/// of what was learnt, so that no warning waits for them.
pub(super) struct Live<'a> {
    args: &'a LearnArgs,
    scenario: &'a LoadedScenario,
    before: &'a [SlopeBand],
    /// When predictions were asked for last.
    asked: Option<Instant>,
    /// Whether something was learnt since then.
    is_due: bool,
    running: Option<JoinHandle<Result<Predicted, Failure>>>,
}

/// Predictions, and where on the drive they were made.
struct Predicted {
    time: f64,
    way: f64,
    slopes: Vec<SlopeBand>,
    models: BTreeMap<&'static str, f64>,
}

impl<'a> Live<'a> {
    /// Nothing if the log is not followed.
    ///
    /// * `scenario`: with the soil as it is known before the drive
    /// * `before`: predictions before the drive
    pub(super) fn of(
        args: &'a LearnArgs,
        scenario: &'a LoadedScenario,
        before: &'a [SlopeBand],
    ) -> Option<Self> {
        let (asked, is_due, running) = (None, false, None);
        args.follow.then_some(Self { args, scenario, before, asked, is_due, running })
    }

    /// Prints a lesson and its warnings, at once.
    pub(super) fn lesson(&mut self, lesson: &Lesson) -> Result<(), Failure> {
        self.is_due = true;
        let is_json = self.args.output.format == Format::Json;
        if is_json {
            let table = columns::lessons(std::slice::from_ref(lesson));
            print_line("lesson", fields_of(&table, 0))?;
        }
        let table = columns::warnings(&lesson.warnings);
        for (place, it) in lesson.warnings.iter().enumerate() {
            if is_json {
                print_line(columns::WARNING, fields_of(&table, place))?;
            } else {
                output::show(warning_in_words(it) + "\n")?;
            }
        }
        Ok(())
    }

    /// Prints predictions that are ready, and asks for others if something was learnt and the last
    /// ones were asked for some time ago.
    ///
    /// * `slopes`: [rad]
    pub(super) fn predictions(&mut self, drive: &Drive, slopes: &[f64]) -> Result<(), Failure> {
        if self.running.as_ref().is_some_and(|it| !it.is_finished()) {
            return Ok(());
        }
        self.finish()?;
        let every = Duration::from_secs_f64(self.args.every_s);
        let is_early = self.asked.is_some_and(|asked| asked.elapsed() < every);
        if !self.is_due || is_early {
            return Ok(());
        }
        (self.asked, self.is_due) = (Some(Instant::now()), false);
        let time = drive.last_time().unwrap_or_default();
        let (learner, slopes) = (drive.learner().clone(), slopes.to_vec());
        let (scenario, sampling) = (self.scenario.clone(), (self.args.seed, self.args.samples));
        self.running = Some(thread::spawn(move || {
            let (_, samples) = LearntSoil::believed(&scenario, &learner, sampling)?;
            let band = sampling::whole(learner.predict(&samples, &slopes, &|| true)?);
            let (slopes, models) = (band.slopes, shares(&learner));
            Ok(Predicted { time, way: learner.learnt().way, slopes, models })
        }));
        Ok(())
    }

    /// Waits for predictions that were asked for, and prints them.
    pub(super) fn finish(&mut self) -> Result<(), Failure> {
        let Some(running) = self.running.take() else { return Ok(()) };
        let predicted = running.join().unwrap_or_else(|panic| resume_unwind(panic))?;
        self.print(&predicted)
    }

    fn print(&self, predicted: &Predicted) -> Result<(), Failure> {
        let table = columns::predictions(self.before, &predicted.slopes);
        let time = TIME.unit.from_si(predicted.time);
        let way = columns::WAY.unit.from_si(predicted.way);
        if self.args.output.format == Format::Json {
            let fields = json!({
                (TIME.name): time,
                (columns::WAY.name): way,
                "predictions": table,
                "models": predicted.models,
            });
            return print_line("predictions", fields);
        }
        let slopes = (0..table.rows()).filter_map(|row| slope_in_words(&table, row));
        let slopes: Vec<String> = slopes.collect();
        output::show(format!("{time:.1} s, {way:.2} m: {}\n", slopes.join("; ")))
    }
}

fn fields_of(table: &Table, row: usize) -> Value {
    serde_json::to_value(table.row(row)).unwrap_or_default()
}

/// Prints a line of JSON, which says of what kind it is.
pub(super) fn print_line(kind: &str, fields: impl Serialize) -> Result<(), Failure> {
    let mut line = Map::new();
    line.insert("kind".to_owned(), kind.into());
    if let Ok(Value::Object(fields)) = serde_json::to_value(fields) {
        line.extend(fields);
    }
    output::print(&(json::line(&line) + "\n"))
}
