//! The identity of a shard: the study, version, rows and columns that its file must state.

use grouser::document::campaign::{Column, Role};
use grouser::document::table::ColumnKind;
use serde::{Deserialize, Serialize};

/// The identity that a shard's file must state.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    pub(crate) study_sha256: String,
    pub(crate) version: String,
    pub(crate) shard: u64,
    pub(crate) rows: u64,
    pub(crate) columns: Vec<ColumnRecord>,
}

impl Identity {
    /// The most bytes that its file may have: numbers take eight and what Parquet adds, texts such
    /// as reasons a kilobyte on average at most. [`encode`](crate::shard::encode) writes none that
    /// is longer.
    #[must_use]
    pub fn most_bytes(&self) -> u64 {
        const FILE: u64 = 1 << 20;
        const COLUMN: u64 = 1 << 14;
        const NUMBER: u64 = 32;
        const TEXT: u64 = 1 << 10;
        let texts = self.columns.iter().filter(|column| column.kind == "text").count() as u64;
        let columns = self.columns.len() as u64;
        let row = texts.saturating_mul(TEXT).saturating_add((columns - texts) * NUMBER);
        let names: u64 = self.columns.iter().map(|column| column.name.len() as u64).sum();
        let fixed = FILE + columns * COLUMN + names.saturating_mul(16);
        self.rows.saturating_mul(row).saturating_add(fixed)
    }
}

/// The description of a column.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ColumnRecord {
    /// Name of the column in documents and results.
    pub name: String,
    /// `float`, `whole` or `text`.
    pub kind: String,
    /// `index`, `input`, `status` or `result`.
    pub role: String,
    /// Its unit, if it has one.
    pub unit: Option<String>,
}

impl From<&Column> for ColumnRecord {
    fn from(column: &Column) -> Self {
        let kind = match column.kind {
            ColumnKind::Float => "float",
            ColumnKind::Whole => "whole",
            ColumnKind::Text | ColumnKind::Words => "text",
        };
        let role = match column.role {
            Role::Index => "index",
            Role::Input => "input",
            Role::Status => "status",
            Role::Result => "result",
        };
        Self {
            name: column.name.clone(),
            kind: kind.into(),
            role: role.into(),
            unit: column.unit().map(str::to_owned),
        }
    }
}
