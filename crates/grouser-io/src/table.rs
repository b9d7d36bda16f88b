//! Results as a table of named columns. Every output of rows is written from it: terminal, CSV,
//! JSON, Parquet, Arrow and arrays.

use std::borrow::Cow;

use serde::ser::{Serialize, SerializeMap, SerializeSeq, Serializer};

pub use super::cell::{BETWEEN_NAMES, Cell, ColumnKind, Values};
use super::columns::{Column, Quantity};

/// Rows by their columns. As JSON it is a list of rows, an object each.
///
/// The sinkage of a wheel under three loads, as numbers and as JSON:
///
/// ```
/// use grouser_core::contact::{Contact, Ishigami, Slip, settle};
/// use grouser_io::columns::wheel::WHEEL;
/// use grouser_io::table::Table;
/// use grouser_io::{Overrides, Source, read_scenario};
///
/// let scenario = read_scenario(&Source::default_scenario(), &Overrides::none())?.value;
/// let (wheel, soil) = (scenario.rover.mounts()[0].unit.wheel, scenario.ground.soil);
/// let slip = Slip::on_test_stand(0.2, 0.0);
/// let contact = Contact { wheel, soil, slip, gravity: scenario.gravity };
/// let settled = [10.0, 17.0, 24.0].map(|load| settle(&Ishigami::DEFAULT, &contact, load));
/// let settled = settled.into_iter().collect::<Result<Vec<_>, _>>()?;
///
/// let table = Table::of(&WHEEL, &settled).select(&["sinkage_mm"], &[0, 1, 2]);
/// let sinkages = table.numbers("sinkage_mm").iter().flatten();
/// let rounded: Vec<String> = sinkages.map(|sinkage| format!("{sinkage:.1} mm")).collect();
/// assert_eq!(rounded.join(", "), "10.2 mm, 13.0 mm, 15.2 mm");
/// assert!(serde_json::to_string(&table)?.starts_with(r#"[{"sinkage_mm":"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names and values, in their order; all of one length.
    pub columns: Vec<(String, Values)>,
}

impl Table {
    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
    }

    /// The names of its columns.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.columns.iter().map(|(name, _)| name.clone()).collect()
    }

    /// The values of a column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&Values> {
        self.columns.iter().find(|(known, _)| known == name).map(|(_, values)| values)
    }

    /// The numbers of a column; none if it has none.
    #[must_use]
    pub fn numbers(&self, name: &str) -> &[Option<f64>] {
        match self.column(name) {
            Some(Values::Float(values)) => values,
            _ => &[],
        }
    }

    /// Two columns of numbers as points, where both are there.
    pub fn points<'t>(&'t self, x: &str, y: &str) -> impl Iterator<Item = (f64, f64)> + 't {
        let pairs = self.numbers(x).iter().zip(self.numbers(y));
        pairs.filter_map(|(x, y)| x.zip(*y))
    }

    /// The words of a column; none if it has none.
    #[must_use]
    pub fn texts(&self, name: &str) -> &[Option<String>] {
        match self.column(name) {
            Some(Values::Text(values)) => values,
            _ => &[],
        }
    }

    /// The lists of names in a column; none if it has none.
    #[must_use]
    pub fn words(&self, name: &str) -> &[Vec<Cow<'static, str>>] {
        match self.column(name) {
            Some(Values::Words(values)) => values,
            _ => &[],
        }
    }

    /// The count in the first row of a column.
    #[must_use]
    pub fn count(&self, name: &str) -> Option<u64> {
        match self.column(name)? {
            Values::Whole(values) => *values.first()?,
            _ => None,
        }
    }

    /// The edges of a band over a quantity, (x, low, high), in the rows that have all three.
    ///
    /// * `ends`: the names of the columns of its low and its high end
    #[must_use]
    pub fn edges(&self, over: Quantity, ends: [&str; 2]) -> Vec<(f64, f64, f64)> {
        let [lows, highs] = ends.map(|end| self.numbers(end));
        let rows = self.numbers(over.name).iter().zip(lows.iter().zip(highs));
        rows.filter_map(|(x, (low, high))| Some(((*x)?, (*low)?, (*high)?))).collect()
    }

    /// Some columns of some rows, by names and places.
    #[must_use]
    pub fn select(&self, names: &[&str], rows: &[usize]) -> Self {
        let one = |name: &&str| Some(((*name).to_owned(), self.column(name)?.select(rows)));
        Self { columns: names.iter().filter_map(one).collect() }
    }

    /// Some rows, by their places.
    #[must_use]
    pub fn rows_at(&self, rows: &[usize]) -> Self {
        let one = |(name, values): &(String, Values)| (name.clone(), values.select(rows));
        Self { columns: self.columns.iter().map(one).collect() }
    }

    /// A row as an object of JSON.
    #[must_use]
    pub fn row(&self, row: usize) -> Row<'_> {
        Row { table: self, row }
    }

    /// With more columns, of as many rows.
    ///
    /// * `rows`: what they are of; a row that is not there has nothing in these columns
    #[must_use]
    pub fn and<'c, R: 'c>(
        self,
        columns: impl IntoIterator<Item = &'c Column<R>>,
        rows: &[Option<&R>],
    ) -> Self {
        self.and_named("", columns, rows)
    }

    /// The same, with something before each name.
    #[must_use]
    pub fn and_named<'c, R: 'c>(
        mut self,
        prefix: &str,
        columns: impl IntoIterator<Item = &'c Column<R>>,
        rows: &[Option<&R>],
    ) -> Self {
        for column in columns {
            for (end, name) in column.names().into_iter().enumerate() {
                let mut values = Values::of(column.kind(), rows.len());
                for row in rows {
                    values.push(column.cell(*row, end));
                }
                self.columns.push((format!("{prefix}{name}"), values));
            }
        }
        self
    }

    /// With a column before all others that has one word in every row.
    #[must_use]
    pub fn with_word(mut self, name: &str, word: &str) -> Self {
        let words = vec![Some(word.to_owned()); self.rows()];
        self.columns.insert(0, (name.to_owned(), Values::Text(words)));
        self
    }

    /// With rows that have nothing behind its own, until there are this many.
    #[must_use]
    pub fn padded(mut self, rows: usize) -> Self {
        for (_, values) in &mut self.columns {
            values.pad(rows);
        }
        self
    }

    /// Rows of another table with these columns behind its own; an empty table becomes the other.
    pub fn append(&mut self, more: Self) {
        if self.columns.is_empty() {
            *self = more;
            return;
        }
        for ((_, values), (_, more)) in self.columns.iter_mut().zip(more.columns) {
            values.append(more);
        }
    }

    /// Tables one below the other, with the columns of all by their names: each of so many rows, of
    /// which those that it does not have, and columns that it lacks, have nothing.
    #[must_use]
    pub fn stacked(tables: impl IntoIterator<Item = Self>, rows: usize) -> Self {
        let mut all = Self::default();
        for (place, table) in tables.into_iter().enumerate() {
            for (name, values) in table.columns {
                let known = all.columns.iter().position(|(known, _)| *known == name);
                let known = known.unwrap_or_else(|| {
                    all.columns.push((name, values.select(&[])));
                    all.columns.len() - 1
                });
                let (_, column) = &mut all.columns[known];
                column.pad(place * rows);
                column.append(values);
            }
            all = all.padded((place + 1) * rows);
        }
        all
    }

    /// A table of rows that are all there.
    #[must_use]
    pub fn of<R>(columns: &[Column<R>], rows: &[R]) -> Self {
        Self::default().and(columns, &rows.iter().map(Some).collect::<Vec<_>>())
    }

    /// Rows of cells under their columns.
    pub fn of_cells<'c>(
        columns: impl Iterator<Item = (&'c str, ColumnKind)>,
        rows: Vec<Vec<Cell>>,
    ) -> Self {
        let empty =
            |(name, kind): (&str, ColumnKind)| (name.to_owned(), Values::of(kind, rows.len()));
        let mut table = Self { columns: columns.map(empty).collect() };
        for row in rows {
            for ((_, values), cell) in table.columns.iter_mut().zip(row) {
                values.push(cell);
            }
        }
        table
    }
}

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut rows = serializer.serialize_seq(Some(self.rows()))?;
        for row in 0..self.rows() {
            rows.serialize_element(&self.row(row))?;
        }
        rows.end()
    }
}

/// Rows each of which has an object as its last entry: the row of another table.
#[derive(Clone, Copy, Debug)]
pub struct WithObject<'t> {
    /// The rows.
    pub rows: &'t Table,
    /// The key of the object.
    pub name: &'static str,
    /// The objects, as many.
    pub of: &'t Table,
}

impl Serialize for WithObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row = |row: usize| {
            let (of, object) = (self.rows.row(row), self.of.row(row));
            RowWithObject { row: of, name: self.name, object }
        };
        serializer.collect_seq((0..self.rows.rows()).map(row))
    }
}

struct RowWithObject<'t> {
    row: Row<'t>,
    name: &'static str,
    object: Row<'t>,
}

impl Serialize for RowWithObject<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        self.row.write(&mut map)?;
        map.serialize_entry(self.name, &self.object)?;
        map.end()
    }
}

/// A row of a table: as JSON an object.
#[derive(Clone, Copy, Debug)]
pub struct Row<'t> {
    table: &'t Table,
    row: usize,
}

impl Row<'_> {
    /// Writes its values as entries of an object of JSON.
    ///
    /// # Errors
    /// The writer's.
    pub fn write<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        let columns = &self.table.columns;
        columns.iter().try_for_each(|(name, values)| values.write(map, name, self.row))
    }
}

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.table.columns.len()))?;
        self.write(&mut map)?;
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{SLIP_RATIO, SLOPE};

    #[test]
    fn a_row_has_its_object_last() {
        let table = |name: &str, numbers: [Option<f64>; 2]| Table {
            columns: vec![(name.to_owned(), Values::Float(numbers.to_vec()))],
        };
        let rows = table("slope_deg", [Some(5.0), Some(10.0)]);
        let of = table("yaw_deg", [Some(2.0), None]);
        let text = serde_json::to_string(&WithObject { rows: &rows, name: "advice", of: &of });
        let expected = r#"[{"slope_deg":5.0,"advice":{"yaw_deg":2.0}},{"slope_deg":10.0,"advice":{"yaw_deg":null}}]"#;
        assert_eq!(text.unwrap(), expected);
    }

    #[test]
    fn tables_are_stacked_by_names_and_padded() {
        let table = |names: &[&str], number: f64| Table {
            columns: names
                .iter()
                .map(|name| ((*name).to_owned(), Values::Float(vec![Some(number)])))
                .collect(),
        };
        let tables = [table(&["a"], 1.0), table(&["b", "a"], 2.0), Table::default()];
        let all = Table::stacked(tables, 2);
        assert_eq!(all.numbers("a"), [Some(1.0), None, Some(2.0), None, None, None]);
        assert_eq!(all.numbers("b"), [None, None, Some(2.0), None, None, None]);
    }

    #[test]
    fn a_row_that_lacks_one_end_has_no_edges() {
        let [low, _, high] = SLIP_RATIO.quantiles();
        let column = |name: &str, numbers: [Option<f64>; 3]| {
            (name.to_owned(), Values::Float(numbers.to_vec()))
        };
        let table = Table {
            columns: vec![
                column(SLOPE.name, [Some(5.0), Some(10.0), Some(15.0)]),
                column(&low, [Some(0.1), Some(0.2), Some(0.3)]),
                column(&high, [Some(0.4), None, Some(0.6)]),
            ],
        };
        assert_eq!(table.edges(SLOPE, [&low, &high]), [(5.0, 0.1, 0.4), (15.0, 0.3, 0.6)]);
    }
}
