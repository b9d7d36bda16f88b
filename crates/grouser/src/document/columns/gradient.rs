//! Derivatives of results by numbers of documents: `d_<result>_d_<key>`, in the result's unit for
//! one unit of the key.

use std::borrow::Cow;

use super::super::table::{Table, Values};
use super::LIMIT_SLOPE;
use super::wheel::WHEEL;
use crate::contact::gradient::WheelDerivative;
use crate::difference::Derivative;
use crate::document::gradient::{HeadingKeys, RunDerivatives, RunKeys};

/// The names of a row's derivatives that differ from side to side, or are of one side.
pub const ONE_SIDED: &str = "one_sided";

/// The name of a result's derivative by a key.
#[must_use]
pub fn name(result: &str, key: &str) -> String {
    format!("d_{result}_d_{key}")
}

/// The column of keys, where each has a row.
pub const KEY: &str = "key";

/// The derivatives of some rows with a row for each of them and key, and a column for each result,
/// called `d_<result>`.
///
/// * `settings`: columns that say which row it is
#[must_use]
pub fn by_key(
    table: &Table,
    rows: &[usize],
    settings: &[&str],
    results: &[&str],
    keys: &[&str],
) -> Table {
    let number = |name: &str, row: usize| table.numbers(name).get(row).copied().flatten();
    let each = || keys.iter().flat_map(|key| rows.iter().map(move |row| (*key, *row)));
    let names = each().map(|(key, _)| Some(key.to_owned())).collect();
    let setting = |it: &&str| {
        ((*it).to_owned(), Values::Float(each().map(|(_, row)| number(it, row)).collect()))
    };
    let of = |result: &&str| {
        let numbers = each().map(|(key, row)| number(&name(result, key), row));
        (format!("d_{result}"), Values::Float(numbers.collect()))
    };
    let columns = std::iter::once((KEY.to_owned(), Values::Text(names)));
    let columns = columns.chain(settings.iter().map(setting));
    Table { columns: columns.chain(results.iter().map(of)).collect() }
}

/// A derivative in a table: its value, and whether it is one-sided; nothing where there is none.
pub type Entry = Option<(f64, bool)>;

/// A table with a column for each result and key, and one of those that are one-sided.
///
/// * `entry`: that of a row, a result and a key, by their places
#[must_use]
pub fn with_derivatives(
    mut table: Table,
    results: &[&str],
    keys: &[&str],
    entry: impl Fn(usize, usize, usize) -> Entry,
) -> Table {
    table.columns.extend(derivatives(table.rows(), results, keys, entry).columns);
    table
}

/// A column for each result and key, and one of those that are one-sided.
///
/// * `rows`: how many there are
/// * `entry`: that of a row, a result and a key, by their places
fn derivatives(
    rows: usize,
    results: &[&str],
    keys: &[&str],
    entry: impl Fn(usize, usize, usize) -> Entry,
) -> Table {
    let mut table = Table::default();
    let mut one_sided: Vec<Vec<Cow<'static, str>>> = vec![Vec::new(); rows];
    for (key_place, key) in keys.iter().enumerate() {
        for (place, result) in results.iter().enumerate() {
            let name = name(result, key);
            let entries = (0..rows).map(|row| entry(row, place, key_place));
            let values = entries.zip(&mut one_sided).map(|(entry, one_sided)| {
                let (value, is_one_sided) = entry?;
                one_sided.extend(is_one_sided.then(|| Cow::Owned(name.clone())));
                Some(value)
            });
            let values = values.collect();
            table.columns.push((name, Values::Float(values)));
        }
    }
    table.columns.push((ONE_SIDED.to_owned(), Values::Words(one_sided)));
    table
}

/// The rows of headings with the derivatives of what they have.
///
/// * `rows`: of each row those of each result by each key
#[must_use]
pub fn of_headings(
    table: Table,
    keys: &HeadingKeys,
    rows: &[Vec<Option<Vec<Derivative>>>],
) -> Table {
    let names: Vec<&str> = keys.names().collect();
    with_derivatives(table, &keys.results(), &names, |row, result, key| {
        let derivative = rows[row][key].as_ref()?[result];
        Some((derivative.value, derivative.is_one_sided()))
    })
}

/// The derivatives of a row of a heading map: of each result by each key, and of the steepest slope.
pub type RowDerivatives = (Vec<Option<Vec<Derivative>>>, Vec<Option<Derivative>>);

/// The rows of a heading map with their derivatives, those of the steepest slope among them.
#[must_use]
pub fn of_heading_map(table: Table, keys: &HeadingKeys, rows: &[RowDerivatives]) -> Table {
    let names: Vec<&str> = keys.names().collect();
    let mut results = keys.results();
    let own = results.len();
    results.push(LIMIT_SLOPE.name);
    with_derivatives(table, &results, &names, |row, result, key| {
        let (of_row, of_limit) = &rows[row];
        let derivative = if result < own { of_row[key].as_ref()?[result] } else { of_limit[key]? };
        Some((derivative.value, derivative.is_one_sided()))
    })
}

/// The steepest slope with its derivatives: one row.
#[must_use]
pub fn of_limit(table: Table, keys: &HeadingKeys, of_limit: &[Option<Derivative>]) -> Table {
    let names: Vec<&str> = keys.names().collect();
    with_derivatives(table, &[LIMIT_SLOPE.name], &names, |_, _, key| {
        of_limit[key].map(|it| (it.value, it.is_one_sided()))
    })
}

/// The derivatives of a run: a row for each record.
///
/// * `records`: how many there are
/// * `on_heights`: whether the ground has heights
#[must_use]
pub fn of_run(keys: &RunKeys, found: &RunDerivatives, records: usize, on_heights: bool) -> Table {
    let names: Vec<&str> = keys.names().collect();
    derivatives(records, &RunKeys::results(on_heights), &names, |record, result, key| {
        found.at(record, result, key).map(|it| (it.value, it.is_one_sided()))
    })
}

/// The rows of a wheel test with the derivatives of all that a wheel has.
///
/// * `keys`: by which
/// * `rows`: of each row those by each key
#[must_use]
pub fn of_wheels(table: Table, keys: &[&str], rows: &[Vec<Option<WheelDerivative>>]) -> Table {
    let results = WHEEL.each_ref().map(|column| column.name);
    with_derivatives(table, &results, keys, |row, result, key| {
        let WheelDerivative { value, sides } = rows[row][key].as_ref()?;
        let of = |settled| WHEEL[result].number(settled);
        Some((of(value), of(&sides[0]) != of(&sides[1])))
    })
}
