//! Output: results to the standard output, messages to the standard error, files to a folder.

pub(crate) mod activity;
pub(crate) mod answer;
mod crossed;
pub(crate) mod file;
pub(crate) mod folder;
pub(crate) mod remedy;
pub(crate) mod rows;
mod screen;
pub(crate) mod slide;
pub(crate) mod terminal;
pub(crate) mod text;
pub(crate) mod zip;

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{BufWriter, ErrorKind, Write, stderr, stdout};
use std::path::Path;

use anstream::AutoStream;
use grouser::document::{escape, json};
use serde::Serialize;

use crate::failure::Failure;
use crate::hints;

pub(crate) use activity::{progress_bar, rate_bar, waiting_line};
use text::Text;

/// Writes text to the standard output. Names and cells may hold what steers a terminal: it is
/// written out here, whatever the text is made of.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    activity::end();
    let mut stdout = stdout().lock();
    stdout
        .write_all(escape::visible(text).as_bytes())
        .and_then(|()| stdout.flush())
        .map_err(failed_to_print)
}

/// Writes a long text to the standard output piece by piece, as [`print`] does.
///
/// * `content`: writes it, in pieces that end where characters do
pub(crate) fn print_by(
    content: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
) -> Result<(), Failure> {
    /// Writes out what would steer a terminal.
    struct Visible<W>(W);

    impl<W: Write> Write for Visible<W> {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            let text = String::from_utf8_lossy(bytes);
            self.0.write_all(escape::visible(&text).as_bytes()).map(|()| bytes.len())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            self.0.flush()
        }
    }

    activity::end();
    let mut stdout = Visible(BufWriter::new(stdout().lock()));
    content(&mut stdout)?;
    stdout.flush().map_err(failed_to_print)
}

/// Writes text for reading to the standard output: as it is to a file or a pipe, and to a terminal
/// in its width and colours.
pub(crate) fn show(text: impl Into<Text>) -> Result<(), Failure> {
    activity::end();
    let shown = terminal::stdout_screen().show(&text.into());
    let mut stdout = AutoStream::auto(stdout().lock());
    stdout.write_all(shown.as_bytes()).and_then(|()| stdout.flush()).map_err(failed_to_print)
}

/// Writes JSON to the standard output, without keeping the text: that of a long run is large.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    activity::end();
    let mut stdout = BufWriter::new(stdout().lock());
    json::write(&mut stdout, value)
        .and_then(|()| writeln!(stdout))
        .and_then(|()| stdout.flush())
        .map_err(failed_to_print)
}

/// Prints the answer of the parser of the command line: help and version to the standard output,
/// errors to the standard error.
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

/// Prints a message beside the results, to the standard error; nothing where the caller wants no
/// notes.
pub(crate) fn message(text: &str) {
    if !terminal::is_quiet() {
        activity::make_room();
        write_message(&format!("{text}\n"));
    }
}

/// Prints what to know of the results, a line each.
pub(crate) fn notes(notes: impl IntoIterator<Item = impl Display>) {
    notes.into_iter().for_each(|note| message(&format!("note: {note}")));
}

/// A message with its labels in colours where the standard error has them.
pub(crate) fn in_colours(text: &str) -> String {
    terminal::stderr_screen().words(text)
}

/// Prints the message of a failure to the standard error.
pub(crate) fn report(failure: &Failure) {
    activity::end();
    if failure.needs_message() {
        let message = hints::with_flags(&failure.to_string());
        write_message(&format!("{}: {message}\n", failure.label()));
    }
}

fn write_message(text: &str) {
    let shown = terminal::stderr_screen().words(text);
    // Without a reader of messages there are still the results.
    let _ = AutoStream::auto(stderr().lock()).write_all(shown.as_bytes());
}

pub(crate) fn failed_to_print(error: std::io::Error) -> Failure {
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
