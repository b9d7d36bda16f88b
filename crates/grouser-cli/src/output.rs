//! What the program says: rows to the standard output, files to a folder.

pub(crate) mod folder;
pub(crate) mod rows;

use std::io::Write as _;
use std::path::Path;

use crate::failure::Failure;

/// Writes text to the standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()).map_err(|error| {
        if error.kind() == std::io::ErrorKind::BrokenPipe {
            Failure::ReaderGone
        } else {
            Failure::at(Path::new("standard output"))(error)
        }
    })
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
