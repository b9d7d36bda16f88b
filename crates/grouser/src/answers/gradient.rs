//! What answers say of derivatives.

use std::sync::Arc;

use serde_json::json;

use super::{Answer, Member};
use crate::document::columns::gradient::{ONE_SIDED, by_key, name};
use crate::document::columns::{OK, STATUS};
use crate::document::reading::sentence;
use crate::document::table::Table;

/// Derivatives by more keys than this are too many columns for reading.
const MOST_KEYS: usize = 3;

/// The columns for reading of derivatives.
///
/// * `results`: the results that are of most interest
#[must_use]
pub fn brief(results: &[&str], keys: &[&str]) -> Vec<String> {
    if keys.len() > MOST_KEYS {
        return Vec::new();
    }
    let of_key = |key: &&str| results.iter().map(|result| name(result, key)).collect::<Vec<_>>();
    keys.iter().flat_map(of_key).collect()
}

/// What is said below the rows: how many derivatives there are, by which keys there are none and
/// why, and how many are one-sided.
///
/// * `lacking`: the keys that the documents give no value
#[must_use]
pub fn lines(rows: &Table, keys: &[&str], lacking: &[&str]) -> String {
    let count = rows.names().iter().filter(|name| name.starts_with("d_")).count();
    let elsewhere = (keys.len() > MOST_KEYS).then(|| {
        format!("{count} derivatives of each row, by {} keys, are in JSON and CSV\n", keys.len())
    });
    let missing = keys.iter().filter_map(|key| missing_line(rows, key, lacking.contains(key)));
    let one_sided: usize = rows.words(ONE_SIDED).iter().map(Vec::len).sum();
    let is = if one_sided == 1 { "derivative is" } else { "derivatives are" };
    let one_sided = (one_sided > 0).then(|| {
        format!(
            "{one_sided} {is} one-sided (column {ONE_SIDED}): the result has a kink there, and the \
             value is the mean of both sides\n"
        )
    });
    elsewhere.into_iter().chain(missing).chain(one_sided).collect()
}

/// The same lines in JSON, as `notes`; nothing where nothing is said.
pub(super) fn notes(lines: &str) -> Option<Member> {
    let notes: Vec<&str> = lines.lines().collect();
    (!notes.is_empty()).then(|| Member::Value("notes", json!(notes)))
}

/// A page's table of what each number is worth in each row.
///
/// * `settings`: columns that say which row it is
/// * `lines`: what is said below it
pub(super) fn page(
    answer: &mut Answer,
    rows: &Table,
    [settings, results, keys]: [&[&str]; 3],
    lines: &str,
) {
    if keys.is_empty() {
        return;
    }
    let places: Vec<usize> = (0..rows.rows()).collect();
    let table = Arc::new(by_key(rows, &places, settings, results, keys));
    let names = table.columns.iter().map(|(name, _)| name.clone()).collect();
    answer.folded("What a number is worth", |answer| {
        answer.rows("Change of each result for one unit of each number", &table, names);
        answer.list(lines.lines().map(sentence));
    });
}

/// Why rows that have results have no derivatives by a key.
fn missing_line(rows: &Table, key: &str, is_lacking: bool) -> Option<String> {
    if is_lacking {
        return Some(format!("no derivative by {key}: the document gives it no value\n"));
    }
    let end = format!("_d_{key}");
    let is_of_key = |name: &&String| name.starts_with("d_") && name.ends_with(&end);
    let names = rows.names();
    let columns: Vec<&[Option<f64>]> =
        names.iter().filter(is_of_key).map(|name| rows.numbers(name)).collect();
    let is_missing = |row: usize| columns.iter().any(|column| column[row].is_none());
    let statuses = rows.texts(STATUS);
    let has_result = |row: &usize| statuses.get(*row).is_none_or(|it| it.as_deref() == Some(OK));
    let count = (0..rows.rows()).filter(has_result).filter(|row| is_missing(*row)).count();
    let of = if count == rows.rows() { String::new() } else { format!(" in {count} rows") };
    (count > 0).then(|| {
        format!(
            "no derivative by {key}{of}: there the key cannot be changed alone, or the result has no \
             slope (no load, the steepest slope itself, a curve that ends where a wheel sinks or the \
             rover tips over, a run that ends otherwise)\n"
        )
    })
}
