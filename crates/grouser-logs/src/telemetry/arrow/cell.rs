//! Cells of CSV, and what is said where there are none.

use std::io;

/// What is wrong with a file.
pub(super) fn damage(what: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("no Arrow that can be read: {what}"))
}

/// A text as a cell of CSV.
pub(super) fn quoted(text: &str) -> String {
    let is_plain = |it: char| !matches!(it, ',' | ';' | '"' | '#' | '|') && !it.is_control();
    if text.chars().all(is_plain) {
        text.to_owned()
    } else {
        format!("\"{}\"", text.replace('"', "\"\""))
    }
}
