//! A watch over a log that is followed: what happens to it is printed at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use grouser::document::reading::four_digits;
use serde_json::json;

use super::live::print_line;
use crate::args::LearnArgs;
use crate::inputs::Following;
use crate::output::{self, Format};

/// So many lines after another without a record to learn from are an accident. Source: ours.
const UNUSED: u64 = 20;

pub(super) struct LogWatch {
    following: Option<Following>,
    lines: Arc<AtomicU64>,
    /// Lines that were read up to the last record.
    used: u64,
    /// The last record's time [s].
    last: Option<f64>,
    is_told: bool,
}

impl LogWatch {
    pub(super) fn of(args: &LearnArgs) -> Self {
        let lines = Arc::new(AtomicU64::new(0));
        let is_json = args.output.format == Format::Json;
        let tell = move |text: &str| {
            let printed = if is_json {
                print_line("log_warning", json!({ "message": text }))
            } else {
                output::show(format!("warning: {text}\n"))
            };
            // The next line of results finds out that nobody reads.
            drop(printed);
        };
        let following = args.follow.then(|| Following {
            quiet: args.follow_s.map(Duration::from_secs_f64),
            tell: Arc::new(tell),
            lines: lines.clone(),
        });
        Self { following, lines, used: 0, last: None, is_told: false }
    }

    /// How the log is followed, if it is.
    pub(super) fn following(&self) -> Option<Following> {
        self.following.clone()
    }

    /// Sees a record.
    pub(super) fn record(&mut self, time: f64) {
        (self.used, self.last) = (self.lines.load(Ordering::Relaxed), Some(time));
        self.is_told = false;
    }

    /// Looks whether lines come that give no records.
    pub(super) fn look(&mut self) {
        let unused = self.lines.load(Ordering::Relaxed) - self.used;
        let Some(following) = self.following.as_ref().filter(|_| !self.is_told) else { return };
        if unused < UNUSED {
            return;
        }
        self.is_told = true;
        let since = self.last.map_or(String::new(), |last| {
            format!(" since {} s: was the clock set back?", four_digits(last))
        });
        (following.tell)(&format!("{unused} rows cannot be used{since}"));
    }
}
