//! Progress on the standard error, where that is a terminal: bars of work that is counted, and a
//! line with the time for work that takes more than a second without one.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressState, ProgressStyle};

use super::terminal;

/// Between two frames of a bar.
const TICK: Duration = Duration::from_millis(100);
/// Work that takes longer than this without a bar has a line of its own.
const PATIENCE: Duration = Duration::from_secs(1);

struct Activity {
    /// What is at work.
    name: String,
    /// The last bar.
    bar: Option<ProgressBar>,
    /// The line of work without a bar, while it is shown.
    line: Option<ProgressBar>,
    /// Since when there was neither a bar nor a message.
    silent_since: Instant,
}

static ACTIVITY: Mutex<Option<Activity>> = Mutex::new(None);

fn activity() -> MutexGuard<'static, Option<Activity>> {
    ACTIVITY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, work that is silent for a second has a line with its time.
///
/// * `name`: of the command
pub(crate) fn start(name: &str) {
    if !terminal::has_progress() {
        return;
    }
    let name = name.to_owned();
    *activity() = Some(Activity { name, bar: None, line: None, silent_since: Instant::now() });
    let watch = || {
        loop {
            thread::sleep(TICK);
            match &mut *activity() {
                Some(activity) => activity.look(),
                None => return,
            }
        }
    };
    // Without a thread there is no line, and all else is the same.
    drop(thread::Builder::new().name("progress".to_owned()).spawn(watch));
}

/// Ends the line of work: results come, or a question.
pub(crate) fn end() {
    if let Some(mut activity) = activity().take() {
        activity.clear();
    }
}

/// Takes the line of work away for something else on the terminal.
pub(super) fn make_room() {
    if let Some(activity) = &mut *activity() {
        activity.clear();
    }
}

impl Activity {
    fn look(&mut self) {
        if self.bar.as_ref().is_some_and(|bar| !bar.is_finished()) {
            self.silent_since = Instant::now();
        } else if self.line.is_none() && self.silent_since.elapsed() > PATIENCE {
            let line = ProgressBar::new_spinner()
                .with_style(style("{spinner} {msg}  {elapsed}"))
                .with_message(self.name.clone())
                .with_elapsed(self.silent_since.elapsed());
            line.enable_steady_tick(TICK);
            self.line = Some(line);
        }
    }

    fn clear(&mut self) {
        if let Some(line) = self.line.take() {
            line.finish_and_clear();
        }
        self.silent_since = Instant::now();
    }
}

/// A bar with its rate and the time that is left, drawn only where the standard error is a
/// terminal.
pub(crate) fn rate_bar(length: u64) -> ProgressBar {
    let rate = |state: &ProgressState, text: &mut dyn std::fmt::Write| {
        // A reader of messages that is gone misses no rate.
        let _ = write!(text, "{}/s", in_two_digits(state.per_sec()));
    };
    let template = "{bar:30} {human_pos}/{human_len} runs  {rate}  {msg}{elapsed} gone, {eta} left";
    shown(ProgressBar::new(length), style(template).with_key("rate", rate))
}

/// A bar on the standard error, drawn only where that is a terminal.
pub(crate) fn progress_bar(length: u64) -> ProgressBar {
    let template = "{bar:30} {pos}/{len} {msg}  {elapsed} gone, {eta} left";
    shown(ProgressBar::new(length), style(template))
}

/// A line with its time for work that nobody can count, likewise.
///
/// * `what`: is done
pub(crate) fn waiting_line(what: impl Into<String>) -> ProgressBar {
    shown(ProgressBar::new_spinner(), style("{spinner} {msg}  {elapsed}")).with_message(what.into())
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn shown(bar: ProgressBar, style: ProgressStyle) -> ProgressBar {
    if terminal::is_quiet() {
        return ProgressBar::hidden();
    }
    let bar = bar.with_style(style);
    if let Some(activity) = &mut *activity() {
        activity.clear();
        activity.bar = Some(bar.clone());
    }
    bar.enable_steady_tick(TICK);
    bar
}

/// A rate that can be read while it changes: 0.83, 7.1, 42, 130, 12000.
fn in_two_digits(rate: f64) -> String {
    if !rate.is_finite() || rate <= 0.0 {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{rate:.1e}").parse().unwrap_or(rate);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_have_two_digits() {
        for (rate, text) in [
            (0.834, "0.83"),
            (7.149, "7.1"),
            (42.4, "42"),
            (128.7, "130"),
            (12_345.6, "12000"),
            (0.0, "0"),
            (f64::NAN, "0"),
        ] {
            assert_eq!(in_two_digits(rate), text);
        }
    }
}
