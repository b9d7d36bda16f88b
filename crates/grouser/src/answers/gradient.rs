//! What answers say of derivatives.

use crate::document::columns::gradient::{ONE_SIDED, name};
use crate::document::table::Table;

/// Derivatives by more keys than this are too many columns for reading.
const MOST_KEYS: usize = 3;

/// The columns for reading of derivatives.
///
/// * `results`: the results that are of most interest
pub(super) fn brief(results: &[&str], keys: &[&str]) -> Vec<String> {
    if keys.len() > MOST_KEYS {
        return Vec::new();
    }
    let of_key = |key: &&str| results.iter().map(|result| name(result, key)).collect::<Vec<_>>();
    keys.iter().flat_map(of_key).collect()
}

/// What is said below the rows: how many derivatives there are, by which keys there are none, and
/// how many are one-sided.
///
/// * `lacking`: the keys that the documents give no value
pub(super) fn lines(rows: &Table, keys: &[&str], lacking: &[&str]) -> String {
    let count = rows.names().iter().filter(|name| name.starts_with("d_")).count();
    let elsewhere = (keys.len() > MOST_KEYS).then(|| {
        format!("{count} derivatives of each row, by {} keys, are in JSON and CSV\n", keys.len())
    });
    let lacking = lacking
        .iter()
        .map(|key| format!("no derivative by {key}: the document gives it no value\n"));
    let one_sided: usize = rows.words(ONE_SIDED).iter().map(Vec::len).sum();
    let is = if one_sided == 1 { "derivative is" } else { "derivatives are" };
    let one_sided = (one_sided > 0).then(|| {
        format!(
            "{one_sided} {is} one-sided (column {ONE_SIDED}): the result has a kink there, and the \
             value is the mean of both sides\n"
        )
    });
    elsewhere.into_iter().chain(lacking).chain(one_sided).collect()
}
