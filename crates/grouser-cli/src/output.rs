//! Output: results to the standard output, messages to the standard error, files to a folder.

pub(crate) mod file;
pub(crate) mod folder;
pub(crate) mod json;
pub(crate) mod rows;

use std::borrow::Cow;
use std::io::{BufWriter, ErrorKind, Write as _, stderr, stdout};
use std::path::Path;
use std::time::Duration;

use grouser::document::escape;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;

use crate::failure::Failure;
use crate::hints;

/// Writes text to the standard output. Names and cells may hold what steers a terminal: it is
/// written out here, whatever the text is made of.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = stdout().lock();
    stdout
        .write_all(escape::visible(text).as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(failed_to_print)
}

/// Writes JSON to the standard output, without keeping the text: that of a long run is large.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let mut stdout = BufWriter::new(stdout().lock());
    json::write(&mut stdout, value)
        .and_then(|()| writeln!(stdout))
        .and_then(|()| stdout.flush())
        .map_err(failed_to_print)
}

/// Prints the answer of the parser of the command line: help and version to the standard output, errors to
/// the standard error.
pub(crate) fn print_answer(answer: &clap::Error) -> Result<(), Failure> {
    // It quotes arguments as they are. One that steers a terminal costs the answer its colours.
    let plain = answer.render().to_string();
    let printed = match escape::visible(&plain) {
        Cow::Owned(shown) if answer.use_stderr() => stderr().write_all(shown.as_bytes()),
        _ => answer.print(),
    };
    let printed = printed.and_then(|()| stdout().flush());
    if answer.use_stderr() { Err(Failure::UsageReported) } else { printed.map_err(failed_to_print) }
}

/// Prints a message beside the results, to the standard error.
pub(crate) fn message(text: &str) {
    // Without a reader of messages there are still the results.
    let _ = writeln!(stderr(), "{}", escape::visible(text));
}

/// Prints the message of a failure to the standard error.
pub(crate) fn report(failure: &Failure) {
    if failure.needs_message() {
        let message = hints::with_flags(&failure.to_string());
        let _ = writeln!(stderr(), "{}: {}", failure.label(), escape::visible(&message));
    }
}

/// A bar with its rate and the time that is left, drawn only where the standard error is a terminal.
pub(crate) fn rate_bar(length: u64) -> ProgressBar {
    let template =
        "{bar:30} {human_pos}/{human_len} runs  {per_sec}  {msg}{elapsed} gone, {eta} left";
    let style =
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(length).with_style(style);
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// A bar on the standard error, drawn only where that is a terminal.
pub(crate) fn progress_bar(length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg} {elapsed}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(length).with_style(style);
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

fn failed_to_print(error: std::io::Error) -> Failure {
    if error.kind() == ErrorKind::BrokenPipe {
        Failure::ReaderGone
    } else {
        Failure::at("cannot write to the", Path::new("standard output"))(error)
    }
}

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// For reading: aligned columns, few digits.
    #[default]
    Table,
    /// For programs: every digit, with the inputs.
    Json,
    /// For spreadsheets: every digit, a header.
    Csv,
}
