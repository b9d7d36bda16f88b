//! Lines of a small CSV file and their cells, each with its place in the text. Keys and numbers
//! have no commas and no quotes in them.

use super::error::{DocumentError, Problem};
use super::tree::Origin;

/// What some programs begin a text with.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// The lines that are not blank, without the blanks at their ends, each with its place in bytes.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    let lines = text.split_inclusive('\n').map(move |line| {
        let from = start;
        start += line.len();
        (from, line.trim_end())
    });
    lines.filter(|(_, line)| !line.trim().trim_start_matches(BYTE_ORDER_MARK).is_empty())
}

/// The cells of a line without the blanks and quotes around them, each with its place in bytes.
pub(crate) fn cells(line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut start = 0;
    line.split(',').map(move |field| {
        let around = |c: char| c.is_whitespace() || c == '"' || c == BYTE_ORDER_MARK;
        let cell = field.trim_matches(around);
        let offset = start + field.find(cell).unwrap_or(0);
        start += field.len() + 1;
        (offset, cell)
    })
}

/// Checks that a line has a cell for each name of the first line.
///
/// * `names`: how many that has, and what they are called
/// * `at`: where the line is
/// * `problem`: makes one of what is wrong
pub(crate) fn check_count(
    line: &str,
    names: (usize, &str),
    at: &Origin,
    problem: fn(String) -> Problem,
) -> Result<(), DocumentError> {
    let (count, (expected, called)) = (cells(line).count(), names);
    if count == expected {
        return Ok(());
    }
    let what = format!("this row has {count} values, the first line names {expected} {called}");
    let hint = line.contains(';').then(|| "values are separated by commas".to_owned());
    Err(DocumentError::at(at, problem(what)).with_hint(hint))
}
