//! Rows of bevameter tests from CSV: named columns of numbers, a label for repeats, and what was
//! noticed.

use std::io::Read;

use super::escape;
use super::given_file::{FileContent, GivenFile};
use super::measurements::bevameter_columns::{PLATE_DIAMETER, REPEAT};
use super::measurements::table::{Table, delimiter_hint};
use super::measurements::{Column, Limits, MeasurementError, MeasurementProblem as Problem};
use super::unit::MM;

/// A file of rows, and its columns that are known.
pub(super) struct Rows<'a, R> {
    label: &'a str,
    table: Table<'a, R>,
    header: Vec<String>,
    columns: &'static [Column],
    record: csv::StringRecord,
    /// The lowest stress below zero, with its line, and the highest above it [Pa].
    lowest: (f64, u64),
    highest: f64,
}

impl<'a, R: Read> Rows<'a, R> {
    /// * `what`: which tests these are, in a message about a column that is missing
    /// * `needed`: names of columns; of each group one must be there, and no two may be
    pub(super) fn open(
        label: &'a str,
        source: R,
        limits: Limits,
        columns: &'static [Column],
        what: &'static str,
        needed: &[&[&str]],
    ) -> Result<Self, MeasurementError> {
        let mut table = Table::new(label, source, b',', limits);
        let header: Vec<String> = table.header()?.iter().map(str::to_owned).collect();
        if header.iter().all(String::is_empty) {
            return Err(MeasurementError::whole(label, Problem::NoHeader));
        }
        let record = csv::StringRecord::new();
        let rows = Self { label, table, header, columns, record, lowest: (0.0, 0), highest: 0.0 };
        let known = columns.iter().map(|column| column.name);
        let mut twice = known.filter(|name| rows.places(name).count() > 1);
        if let Some(name) = twice.next() {
            return Err(rows.of_header(Problem::RepeatedColumn(name.to_owned())));
        }
        needed.iter().try_for_each(|group| rows.check_group(what, group))?;
        Ok(rows)
    }

    /// Checks that one of some columns is there, and no two are.
    fn check_group(&self, what: &'static str, group: &[&str]) -> Result<(), MeasurementError> {
        let mut there = group.iter().filter(|name| self.has(name));
        match (there.next(), there.next()) {
            (Some(_), None) => Ok(()),
            (Some(one), Some(other)) => {
                let problem = Problem::CompetingColumns((*one).to_owned(), (*other).to_owned());
                Err(self.of_header(problem).with_hint(Some("keep one of them".to_owned())))
            }
            (None, _) => {
                let names: Vec<String> = group.iter().map(|name| format!("`{name}`")).collect();
                let problem = Problem::MissingColumn { what, expected: names.join(" or ") };
                let of_round = if group.contains(&PLATE_DIAMETER) {
                    "; `plate_width_mm` is the smaller side of a rectangular plate, a round one has \
                     its diameter or its radius"
                } else {
                    ""
                };
                let hint = delimiter_hint(&self.header).unwrap_or_else(|| {
                    format!("the file's columns are {}{of_round}", self.header.join(", "))
                });
                Err(self.of_header(problem).with_hint(hint))
            }
        }
    }

    fn of_header(&self, problem: Problem) -> MeasurementError {
        MeasurementError::at(self.label, 1, problem)
    }

    fn places(&self, name: &str) -> impl Iterator<Item = usize> {
        (0..self.header.len()).filter(move |place| self.header[*place] == name)
    }

    /// Whether a column is there.
    pub(super) fn has(&self, name: &str) -> bool {
        self.places(name).next().is_some()
    }

    /// Goes to the next row, if there is one.
    pub(super) fn advance(&mut self) -> Result<bool, MeasurementError> {
        let there_is_one = self.table.next_row(&mut self.record)?;
        if there_is_one && self.record.iter().eq(self.header.iter().map(String::as_str)) {
            return Err(self.of_row(Problem::RepeatedHeader));
        }
        Ok(there_is_one)
    }

    fn line(&self) -> u64 {
        self.record.position().map_or(0, csv::Position::line)
    }

    fn of_row(&self, problem: Problem) -> MeasurementError {
        MeasurementError::at(self.label, self.line(), problem)
    }

    /// Looks at a stress of the row that counts [Pa].
    pub(super) fn see_stress(&mut self, stress: f64) {
        self.highest = self.highest.max(stress);
        if stress < self.lowest.0 {
            self.lowest = (stress, self.line());
        }
    }

    /// Checks that no stress was farther below zero than noise about it is.
    pub(super) fn check_signs(&self, column: &str) -> Result<(), MeasurementError> {
        /// Noise over the highest stress [-]. Source: ours; offsets of load cells are a few per cent.
        const NOISE: f64 = 0.1;
        let (lowest, line) = self.lowest;
        let least = 0.0 - NOISE * self.highest;
        let known = self.columns.iter().find(|it| it.name == column);
        let Some(known) = known.filter(|_| lowest < least) else { return Ok(()) };
        let [value, least] = [lowest, least].map(|it| known.unit.from_si(it));
        let most = *known.range.end();
        let problem = Problem::OutOfRange { column: column.to_owned(), value, least, most };
        let hint = "soil resists with stresses above zero, and noise is a tenth of the highest at \
                    most: is the sign another, or is this the way back?";
        Err(MeasurementError::at(self.label, line, problem).with_hint(hint.to_owned()))
    }

    /// What stands in a column of the row; nothing where the column is not there.
    fn text(&self, name: &str) -> &str {
        self.places(name).next().map_or("", |place| &self.record[place])
    }

    /// What tells the row's curve from others of its setting.
    pub(super) fn repeat(&self) -> &str {
        self.text(REPEAT)
    }

    /// A number of the row in SI.
    pub(super) fn number(&self, name: &str) -> Result<f64, MeasurementError> {
        let Some(column) = self.columns.iter().find(|column| column.name == name) else {
            return Ok(0.0);
        };
        let text = self.text(name);
        let Ok(value) = text.parse::<f64>() else {
            let value = escape::short_line(text, 60);
            return Err(self.of_row(Problem::NotANumber { column: name.to_owned(), value }));
        };
        if !column.range.contains(&value) {
            let (least, most) = (*column.range.start(), *column.range.end());
            let problem = Problem::OutOfRange { column: name.to_owned(), value, least, most };
            let unit = if column.unit == MM { "millimetres" } else { "kilopascals" };
            return Err(self.of_row(problem).with_hint(format!("is it in {unit}?")));
        }
        Ok(column.unit.to_si(value))
    }

    /// The same of a number that may be unknown: 0 then.
    pub(super) fn number_or_zero(&self, name: &str) -> Result<f64, MeasurementError> {
        if self.text(name).is_empty() { Ok(0.0) } else { self.number(name) }
    }

    /// What the file gave.
    ///
    /// * `left_out`: rows that do not count
    pub(super) fn given(&self, content: FileContent, left_out: u64) -> GivenFile {
        let rows = self.table.rows();
        GivenFile::new(self.label, content, rows, rows.saturating_sub(left_out))
    }

    /// Returns the error for a file that has no rows that count.
    pub(super) fn no_rows(&self) -> MeasurementError {
        MeasurementError::whole(self.label, Problem::NoRows)
    }

    /// A note on each column that is not used.
    pub(super) fn unused_notes(&self) -> Vec<String> {
        let is_known =
            |name: &String| name.is_empty() || self.columns.iter().any(|it| it.name == name);
        let unknown = self.header.iter().filter(|name| !is_known(name));
        unknown.map(|name| format!("column `{}` is not used", escape::line(name))).collect()
    }
}

/// A note on rows that were left out, if there are any.
pub(super) fn left_out_note(count: usize, why: &str) -> Option<String> {
    let rows = if count == 1 { "row is" } else { "rows are" };
    (count > 0).then(|| format!("{count} {rows} left out: {why}"))
}
