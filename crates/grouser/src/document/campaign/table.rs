//! The columns of a campaign's rows.

use super::super::table::ColumnKind;
use super::super::unit::unit_of;

/// What a row has at one place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// As documents and results name it: `sinkage_mm`, or an input's key.
    pub name: String,
    /// What stands in it.
    pub kind: ColumnKind,
    /// What it tells of a run.
    pub role: Role,
}

/// What a column tells of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Which run it is.
    Index,
    /// What was drawn for it.
    Input,
    /// Whether it has an answer, and what became of it.
    Status,
    /// The answer.
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
