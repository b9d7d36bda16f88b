//! A log of CSV, row by row, whatever parts its fields.

use std::borrow::Cow;
use std::io::Read;

use csv::StringRecord;
use grouser_core::vehicle::Rover;

use super::super::super::escape;
use super::super::error::{MeasurementError, MeasurementProblem as Problem, QUOTED};
use super::super::limits::Limits;
use super::super::row::name_of;
use super::super::table::{Dialect, LookedAt, Table};
use super::cell::Cell;
use super::clock::is_other_date;
use super::rows::{TelemetryRows, TimeColumn};
use super::units::units_of;
use super::{Odometry, TelemetryRecord};

/// Rows of a table in CSV, whatever they mean.
pub struct CellReader<'a, R> {
    table: Table<'a, LookedAt<R>>,
    dialect: Dialect,
    names: Vec<String>,
    /// Units of the columns, of a table that has them below its header.
    units: Option<Vec<String>>,
    /// The column of the time, until one was read.
    time: Option<TimeColumn>,
    row: StringRecord,
    /// The first row, until it is asked for.
    first: Option<Result<bool, MeasurementError>>,
    cells: Vec<Cell>,
}

/// What comes next of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NextRow<'r> {
    /// A row, in the order of the columns.
    Cells(&'r [Cell]),
    /// What is no row of the table.
    Damaged,
    /// No row any more.
    End,
}

impl<'a, R: Read> CellReader<'a, R> {
    /// Reads the header, and the row of units below it, if there is one.
    ///
    /// * `label`: what messages call the source
    ///
    /// # Errors
    /// [`MeasurementError`] where reading fails, or what comes is no text.
    pub fn new(label: impl Into<Cow<'a, str>>, source: R) -> Result<Self, MeasurementError> {
        let limits = Limits { rows: usize::MAX };
        let (mut table, dialect) = Table::of_any_dialect(label, source, limits)?;
        let names: Vec<String> = table.header()?.iter().map(name_of).collect();
        let time = TimeColumn::of(&names);
        let mut row = StringRecord::new();
        let mut first = Some(table.next_row(&mut row));
        let units = if matches!(first, Some(Ok(true))) { units_of(&row) } else { None };
        first = first.filter(|_| units.is_none());
        Ok(Self { table, dialect, names, units, time, row, first, cells: Vec::new() })
    }

    /// The names of the columns.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The units below the names of the columns, where the table has such a row.
    #[must_use]
    pub fn units(&self) -> Option<&[String]> {
        self.units.as_deref()
    }

    /// The next row.
    ///
    /// # Errors
    /// [`MeasurementError`] where reading fails, or a row is too long to be one.
    pub fn next_row(&mut self) -> Result<NextRow<'_>, MeasurementError> {
        let first = self.first.take();
        match first.unwrap_or_else(|| self.table.next_row(&mut self.row)) {
            Ok(true) => {}
            Ok(false) => return Ok(NextRow::End),
            Err(error) if matches!(error.problem(), Problem::NotCsv(_)) => {
                return Ok(NextRow::Damaged);
            }
            Err(error) => return Err(error),
        }
        let has_commas = self.dialect.has_decimal_commas;
        let cell = |text: &str| {
            if has_commas && text.contains(',') {
                Cell::of_text(&text.replacen(',', ".", 1))
            } else {
                Cell::of_text(text)
            }
        };
        self.cells.clear();
        self.cells.extend(self.row.iter().map(cell));
        self.check_date()?;
        Ok(NextRow::Cells(&self.cells))
    }

    /// Checks that the first time is none that another clock wrote; later ones are damage.
    fn check_date(&mut self) -> Result<(), MeasurementError> {
        let Some(time) = self.time else { return Ok(()) };
        let text = self.row.get(time.place()).unwrap_or_default();
        if time.seconds(&self.cells).is_some() {
            self.time = None;
        } else if is_other_date(text) {
            let line = self.row.position().map_or(0, csv::Position::line);
            let (column, text) =
                (self.names[time.place()].clone(), escape::short_line(text, QUOTED));
            let problem = Problem::OtherDate { column, text };
            let hint = "ISO 8601 is read, 2026-11-29T10:00:00.5Z, and seconds as a number";
            return Err(self.table.failed(line, problem).with_hint(hint.to_owned()));
        }
        Ok(())
    }
}

/// Reads a log of CSV row by row.
pub struct TelemetryReader<'a, R> {
    cells: CellReader<'a, R>,
    rows: TelemetryRows,
}

impl<'a, R: Read> TelemetryReader<'a, R> {
    /// Reads the header.
    ///
    /// * `label`: what messages call the source
    /// * `rover`: the rover that was driven, for the names of its wheels
    ///
    /// # Errors
    /// [`MeasurementError`] for a source without a header, without the time, with a column twice,
    /// with a unit below a column that it cannot have, or with the column of a wheel that the rover
    /// does not have.
    pub fn new(
        label: impl Into<Cow<'a, str>>,
        source: R,
        rover: &Rover,
    ) -> Result<Self, MeasurementError> {
        let label = label.into();
        let cells = CellReader::new(label.clone(), source)?;
        let units = cells.units().unwrap_or_default();
        let rows = TelemetryRows::in_units(&label, cells.names(), units, rover)?;
        Ok(Self { cells, rows })
    }

    /// The same with ways that were measured in some way; see [`TelemetryRows::measured_by`].
    #[must_use]
    pub fn measured_by(self, odometry: Odometry) -> Self {
        Self { rows: self.rows.measured_by(odometry), ..self }
    }

    /// The next record, if there is one.
    ///
    /// # Errors
    /// [`MeasurementError`] where reading fails, or a row is too long to be one.
    pub fn next_record(&mut self) -> Result<Option<TelemetryRecord>, MeasurementError> {
        loop {
            match self.cells.next_row()? {
                NextRow::Cells(cells) => {
                    if let Some(record) = self.rows.record(cells.iter().copied()) {
                        return Ok(Some(record));
                    }
                }
                NextRow::Damaged => self.rows.damaged_row(),
                NextRow::End => return Ok(None),
            }
        }
    }

    /// The rows that were read so far, with what was lost of them.
    #[must_use]
    pub fn rows(&self) -> &TelemetryRows {
        &self.rows
    }
}
