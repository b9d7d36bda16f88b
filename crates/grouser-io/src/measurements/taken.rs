//! What becomes of the rows of a measurement file.

use super::super::escape;
use super::error::QUOTED;
use super::wheel_tests::{PerQuantity, Reading};
use grouser_core::contact::Slip;

/// What becomes of a row.
pub(super) enum Taken {
    /// It is read.
    Row(Row),
    /// It does not meet the conditions.
    Unwanted,
    /// Its status is not `ok`.
    NotOk(LeftOut),
}

/// A row, in SI.
pub(super) struct Row {
    pub(super) line: u64,
    pub(super) wheel: Option<String>,
    /// What rows that repeat each other have in common.
    pub(super) cell: String,
    pub(super) slip: Slip,
    pub(super) slip_angle: f64,
    pub(super) rim_speed_setting: Option<f64>,
    pub(super) load: f64,
    pub(super) readings: PerQuantity<Option<Reading>>,
}

/// Rows that do not count, by their own word.
pub(super) struct LeftOut {
    /// The first of them.
    line: u64,
    /// Its status.
    pub(super) status: String,
    /// How many there are.
    count: usize,
}

impl LeftOut {
    /// The first of them.
    pub(super) fn first(line: u64, status: &str) -> Self {
        Self { line, status: escape::short_line(status, QUOTED), count: 1 }
    }

    /// With one more.
    pub(super) fn and_another(self) -> Self {
        Self { count: self.count + 1, ..self }
    }

    /// What there is to say about them.
    pub(super) fn note(&self) -> String {
        let Self { line, status, count } = self;
        let rows = if *count == 1 { "1 row is".to_owned() } else { format!("{count} rows are") };
        format!("{rows} left out, for `status` is not `ok`; the first, line {line}: {status}")
    }
}
