//! What is learnt while a log grows: lines of text, or lines of JSON.

use std::time::{Duration, Instant};

use grouser::document::columns::learn as columns;
use grouser::document::columns::{Quantity, TIME};
use grouser::document::table::Table;
use grouser::studies::heading_band::SlopeBand;
use grouser::studies::learn::{Drive, Lesson};
use serde::Serialize;
use serde_json::{Map, Value, json};

use super::found::{of_row, shares, warning};
use crate::args::LearnArgs;
use crate::failure::Failure;
use crate::output::{self, Format, json};

/// Prints what a log that is followed tells on the way.
pub(super) struct Live<'a> {
    format: Format,
    every: Duration,
    before: &'a [SlopeBand],
    /// When predictions were printed last.
    printed: Option<Instant>,
    /// Whether something was learnt since then.
    is_due: bool,
}

impl<'a> Live<'a> {
    /// Nothing if the log is not followed.
    ///
    /// * `before`: predictions before the drive
    pub(super) fn of(args: &LearnArgs, before: &'a [SlopeBand]) -> Option<Self> {
        let every = Duration::from_secs_f64(args.every_s);
        let format = args.output.format;
        args.follow.then_some(Self { format, every, before, printed: None, is_due: false })
    }

    /// Prints a lesson and its warnings, at once.
    pub(super) fn lesson(&mut self, lesson: &Lesson) -> Result<(), Failure> {
        self.is_due = true;
        let is_json = self.format == Format::Json;
        if is_json {
            let table = columns::lessons(std::slice::from_ref(lesson));
            print_line("lesson", fields_of(&table, 0))?;
        }
        let table = columns::warnings(&lesson.warnings);
        for (place, it) in lesson.warnings.iter().enumerate() {
            if is_json {
                print_line(columns::WARNING, fields_of(&table, place))?;
            } else {
                output::show(warning(it) + "\n")?;
            }
        }
        Ok(())
    }

    /// Prints predictions, if something was learnt and the last ones were printed some time ago.
    ///
    /// * `predict`: computes them
    pub(super) fn predictions(
        &mut self,
        drive: &Drive,
        predict: impl FnOnce() -> Result<Vec<SlopeBand>, Failure>,
    ) -> Result<(), Failure> {
        let is_early = self.printed.is_some_and(|printed| printed.elapsed() < self.every);
        if !self.is_due || is_early {
            return Ok(());
        }
        (self.printed, self.is_due) = (Some(Instant::now()), false);
        let table = columns::predictions(self.before, &predict()?);
        let of = |quantity: Quantity, value: f64| quantity.unit.from_si(value);
        let time = of(TIME, drive.last_time().unwrap_or_default());
        let way = of(columns::WAY, drive.learner().learnt().way);
        if self.format == Format::Json {
            let fields = json!({
                (TIME.name): time,
                (columns::WAY.name): way,
                "predictions": table,
                "models": shares(drive.learner()),
            });
            return print_line("predictions", fields);
        }
        let rows: Vec<String> = (0..table.rows()).filter_map(|row| of_row(&table, row)).collect();
        output::show(format!("{time:.1} s, {way:.2} m: {}\n", rows.join("; ")))
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
