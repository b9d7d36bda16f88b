//! Records as rows of a table, of CSV or of JSON: the keys are the columns.

use std::borrow::Borrow;

use grouser::contact::validity::Flag;
use grouser::document::columns::flags::FLAGS;
use grouser::document::columns::{STATUS, X, Y, Z};
use grouser::document::escape;
use grouser::document::reading::{joined, metres, short};
use grouser::document::table::Table;
use serde::Serialize;
use serde_json::{Map, Value};

use super::text::{Grid, Text};
use crate::failure::Failure;

/// The column that says what an outcome means.
const REASON: &str = "reason";

/// Rows with the same keys, in their order.
pub(crate) struct Rows(Vec<Map<String, Value>>);

impl Rows {
    /// Records that serialise as flat objects.
    ///
    /// Values that are no numbers of this world would be null; the library does not make any.
    pub(crate) fn of<T: Serialize>(records: &[T]) -> Self {
        let object = |record| match serde_json::to_value(record) {
            Ok(Value::Object(map)) => map,
            other => unreachable!("a record is an object, not {other:?}"),
        };
        Self(records.iter().map(object).collect())
    }

    /// The rows of a table of the library's.
    pub(crate) fn of_table(table: &Table) -> Self {
        let rows: Vec<_> = (0..table.rows()).map(|row| table.row(row)).collect();
        Self::of(&rows)
    }

    /// Rows from maps that are at hand already.
    pub(crate) fn from_maps(maps: Vec<Map<String, Value>>) -> Self {
        Self(maps)
    }

    /// Some of the rows.
    pub(crate) fn part(&self, rows: std::ops::Range<usize>) -> Self {
        Self(self.0[rows].to_vec())
    }

    /// The rows as CSV with a header; null is an empty field.
    pub(crate) fn to_csv(&self) -> Result<String, Failure> {
        let columns: Vec<String> =
            self.0.first().map_or(Vec::new(), |row| row.keys().cloned().collect());
        csv(&columns, self.0.iter())
    }

    /// The rows as an aligned table of some of their columns; a column's header is its key.
    pub(crate) fn to_table(&self, columns: &[impl AsRef<str>]) -> Text {
        let raised = self.raised();
        // Without any flag the column would be empty.
        let columns = columns.iter().map(AsRef::as_ref);
        let columns: Vec<&str> =
            columns.filter(|column| *column != FLAGS || !raised.is_empty()).collect();
        let header: Vec<String> = columns.iter().map(|column| (*column).to_owned()).collect();
        let place = |name: &str| columns.iter().position(|column| *column == name);
        let mut grid = Grid::new(&header, &self.cells(&columns))
            .with_reasons([STATUS, REASON].into_iter().filter_map(place));
        if let Some(column) = place(FLAGS) {
            grid = grid.with_notes(column, self.meanings());
        }
        grid.into()
    }

    /// The cells of some columns, for reading.
    pub(crate) fn cells(&self, columns: &[impl AsRef<str>]) -> Vec<Vec<String>> {
        let cell = |row: &Map<String, Value>, column: &str| match row.get(column) {
            None => String::new(),
            Some(value) if PLACES.contains(&column) => {
                value.as_f64().map_or_else(|| short(value), metres)
            }
            Some(value) => short(value),
        };
        let cells = |row| columns.iter().map(|column| cell(row, column.as_ref())).collect();
        self.0.iter().map(cells).collect()
    }

    /// The flags of the rows, each with its meaning.
    fn meanings(&self) -> Vec<(String, String)> {
        let pair = |flag: &Flag| (flag.name().to_owned(), flag.rule().meaning.to_owned());
        self.raised().iter().map(pair).collect()
    }

    /// The flags that any row has, in the order of the list.
    fn raised(&self) -> Vec<Flag> {
        let is_raised = |flag: &Flag| {
            let lists = self.0.iter().filter_map(|row| row.get(FLAGS)?.as_array());
            lists.flatten().any(|name| name.as_str() == Some(flag.name()))
        };
        Flag::ALL.into_iter().filter(is_raised).collect()
    }
}

/// Rows as CSV with a header; what is null or missing is an empty field.
pub(crate) fn csv<M: Borrow<Map<String, Value>>>(
    columns: &[String],
    rows: impl Iterator<Item = M>,
) -> Result<String, Failure> {
    let failed = |error: csv::Error| Failure::Run(format!("CSV: {error}"));
    let mut writer = csv::Writer::from_writer(Vec::new());
    if !columns.is_empty() {
        let names = columns.iter().map(|column| escape::cell(column).into_owned());
        writer.write_record(names).map_err(failed)?;
    }
    for row in rows {
        let row = row.borrow();
        let cells = columns.iter().map(|column| row.get(column).map_or(String::new(), exact));
        writer.write_record(cells).map_err(failed)?;
    }
    let bytes = writer.into_inner().map_err(|error| Failure::Run(format!("CSV: {error}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// A value with every digit; a text so that no spreadsheet computes it.
fn exact(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => escape::cell(text).into_owned(),
        Value::Array(names) => joined(names),
        other => other.to_string(),
    }
}

/// Columns of places, which on a map are far from the origin.
const PLACES: [&str; 3] = [X.name, Y.name, Z.name];

/// Columns under their headers: numbers to the right, words to the left, each cell on its line.
pub(crate) fn aligned(header: &[String], rows: &[Vec<String>]) -> Text {
    Grid::new(header, rows).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_quotes_what_needs_it_and_leaves_null_empty() {
        let row = serde_json::json!({"a": 1.5, "status": "no, \"never\"", "b": null});
        let Value::Object(map) = row else { panic!("an object") };
        let csv = Rows::from_maps(vec![map]).to_csv().unwrap();
        assert_eq!(csv, "a,status,b\n1.5,\"no, \"\"never\"\"\",\n");
    }
}
