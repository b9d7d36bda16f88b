//! A log of CSV, row by row, whatever parts its fields.

use std::borrow::Cow;
use std::io::Read;

use csv::StringRecord;
use grouser_core::vehicle::Rover;

use super::super::error::{MeasurementError, MeasurementProblem as Problem};
use super::super::limits::Limits;
use super::super::row::name_of;
use super::super::table::{Dialect, LookedAt, Table};
use super::rows::{Cell, TelemetryRows};
use super::{Odometry, TelemetryRecord};

/// Reads a log of CSV row by row.
pub struct TelemetryReader<'a, R> {
    table: Table<'a, LookedAt<R>>,
    dialect: Dialect,
    row: StringRecord,
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
    /// or with the column of a wheel that the rover does not have.
    pub fn new(
        label: impl Into<Cow<'a, str>>,
        source: R,
        rover: &Rover,
    ) -> Result<Self, MeasurementError> {
        let label = label.into();
        let limits = Limits { rows: usize::MAX };
        let (mut table, dialect) = Table::of_any_dialect(label.clone(), source, limits)?;
        let names: Vec<String> = table.header()?.iter().map(name_of).collect();
        let rows = TelemetryRows::new(&label, names, rover)?;
        Ok(Self { table, dialect, row: StringRecord::new(), rows })
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
            match self.table.next_row(&mut self.row) {
                Ok(true) => {}
                Ok(false) => return Ok(None),
                Err(error) if matches!(error.problem(), Problem::NotCsv(_)) => {
                    self.rows.damaged_row();
                    continue;
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
            if let Some(record) = self.rows.record(self.row.iter().map(cell)) {
                return Ok(Some(record));
            }
        }
    }

    /// The rows that were read so far, with what was lost of them.
    #[must_use]
    pub fn rows(&self) -> &TelemetryRows {
        &self.rows
    }
}
