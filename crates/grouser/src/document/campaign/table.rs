//! The columns of a campaign's rows.

use super::super::table::ColumnKind;
use super::super::unit::unit_of;

/// A column of a campaign's rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// The name in documents and results: `sinkage_mm`, or an input's key.
    pub name: String,
    /// The kind of its values.
    pub kind: ColumnKind,
    /// Its role in a run.
    pub role: Role,
}

/// The role of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The number of the run.
    Index,
    /// A sampled input.
    Input,
    /// Its status or outcome.
    Status,
    /// A result.
    Result,
}

impl Column {
    pub(super) fn new(name: impl Into<String>, kind: ColumnKind, role: Role) -> Self {
        Self { name: name.into(), kind, role }
    }

    /// Its unit, by the end of its name; none for a number without and for texts.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        let is_number = self.kind == ColumnKind::Float;
        is_number.then(|| unit_of(&self.name)).flatten().map(|unit| unit.symbol)
    }
}
