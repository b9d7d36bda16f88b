//! Progress of a campaign: a bar for people, lines of JSON for programs.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use grouser_store::Folder;
use indicatif::ProgressBar;
use serde_json::json;

use crate::args::TableOrJson;
use crate::failure::Failure;
use crate::output;

/// The least time between two lines for machines.
const BETWEEN: Duration = Duration::from_secs(1);

/// Counts runs as they start, from any thread.
pub(super) struct Progress {
    format: TableOrJson,
    bar: ProgressBar,
    /// Runs that were there before, and all.
    before: u64,
    all: u64,
    started: AtomicU64,
    since: Instant,
}

impl Progress {
    pub(super) fn new(format: TableOrJson, folder: &Folder) -> Self {
        let (before, all) = (folder.runs_done(), folder.runs());
        let bar = match format {
            TableOrJson::Table => output::rate_bar(all - before),
            TableOrJson::Json => ProgressBar::hidden(),
        };
        Self { format, bar, before, all, started: AtomicU64::new(0), since: Instant::now() }
    }

    /// A run starts.
    pub(super) fn start(&self) {
        /// The bar moves once in so many runs: moving it costs more than a quick run does.
        const STEP: u64 = 64;
        let started = self.started.fetch_add(1, Ordering::Relaxed) + 1;
        if started.is_multiple_of(STEP) {
            self.bar.set_position(started);
        }
    }

    /// Prints a line of progress for programs, at most one in each interval.
    ///
    /// * `reported`: when the last line was printed
    pub(super) fn report(
        &self,
        folder: &Folder,
        reported: &mut Option<Instant>,
    ) -> Result<(), Failure> {
        if self.format == TableOrJson::Table
            || reported.is_some_and(|reported| reported.elapsed() < BETWEEN)
        {
            return Ok(());
        }
        *reported = Some(Instant::now());
        let done = folder.runs_done();
        let seconds = self.since.elapsed().as_secs_f64();
        let rate = (done - self.before) as f64 / seconds;
        let left = (rate > 0.0).then(|| (self.all - done) as f64 / rate);
        let line = json!({
            "schema": "grouser.campaign.progress.v1",
            "runs_done": done,
            "runs": self.all,
            "elapsed_s": seconds,
            "runs_per_s": (rate > 0.0).then_some(rate),
            "left_s": left,
        });
        output::print(&format!("{line}\n"))
    }

    /// Runs that this program computed each second [1/s]; none if it computed none.
    pub(super) fn rate(&self, folder: &Folder) -> Option<f64> {
        let computed = folder.runs_done() - self.before;
        (computed > 0).then(|| computed as f64 / self.since.elapsed().as_secs_f64())
    }

    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
    }
}
