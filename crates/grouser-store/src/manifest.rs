//! The manifest: which campaign a folder has, how far it is, when it was computed.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use grouser::document::campaign::{Column, ColumnKind, Role};
use serde::{Deserialize, Serialize};

use crate::error::StoreError;
use crate::place;
use crate::study::{Study, VERSION};

/// The manifest's file.
pub(crate) const FILE: &str = "manifest.json";
const SCHEMA: &str = "grouser.campaign.manifest.v1";

/// What a folder says of itself.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    schema: String,
    /// The program's version.
    pub version: String,
    /// What the study calls itself.
    pub name: String,
    /// SHA-256 of the resolved study, `study.toml`.
    pub study_sha256: String,
    /// What the draws were drawn from.
    pub seed: u64,
    /// Runs of the whole campaign.
    pub runs: u64,
    /// Runs of every shard but the last.
    pub shard_runs: u64,
    /// Shards of the whole campaign.
    pub shards: u64,
    /// Which of the shards belong here; none for all.
    pub part: Option<Part>,
    /// The columns, in order.
    pub columns: Vec<ColumnRecord>,
    /// SHA-256 over the shards' bytes, in order; none until all are there.
    pub digest: Option<String>,
    /// When it was computed.
    pub sessions: Vec<Session>,
}

/// A part of an array of jobs: the shards whose number, divided by `of`, leaves `index` − 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Part {
    /// From 1 to `of`.
    pub index: u64,
    /// How many parts there are.
    pub of: u64,
}

/// A time in which a program computed shards.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Session {
    /// In UTC.
    pub started: String,
    /// In UTC; none if it was killed.
    pub ended: Option<String>,
    /// Shards that it computed; 0 if it was killed.
    pub shards: u64,
}

/// What a column has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ColumnRecord {
    /// In the door's words.
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
            ColumnKind::Text => "text",
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

impl Part {
    /// Whether a shard belongs to it.
    #[must_use]
    pub fn has(self, shard: u64) -> bool {
        shard % self.of == self.index - 1
    }
}

/// As the flag is written.
impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl Manifest {
    /// That of a campaign of which nothing is computed yet.
    #[must_use]
    pub fn new(study: &Study, part: Option<Part>) -> Self {
        Self {
            schema: SCHEMA.into(),
            version: VERSION.into(),
            name: study.name.clone(),
            study_sha256: study.hash.clone(),
            seed: study.seed,
            runs: study.runs,
            shard_runs: study.shard_runs,
            shards: study.shards(),
            part,
            columns: study.columns.iter().map(ColumnRecord::from).collect(),
            digest: None,
            sessions: Vec::new(),
        }
    }

    /// That of a folder, if it has one.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, StoreError> {
        let file = folder.join(FILE);
        let text = match fs::read_to_string(&file) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) if error.kind() == ErrorKind::InvalidData => {
                return Err(StoreError::Manifest { file, problem: "it is no text".into() });
            }
            Err(error) => return Err(StoreError::at("read", &file)(error)),
        };
        let manifest: Self = serde_json::from_str(&text).map_err(|error| StoreError::Manifest {
            file: file.clone(),
            problem: error.to_string(),
        })?;
        manifest.check().map_err(|problem| StoreError::Manifest { file, problem })?;
        Ok(Some(manifest))
    }

    /// What nobody but an editor can have broken.
    fn check(&self) -> Result<(), String> {
        if self.schema != SCHEMA {
            return Err(format!("its schema is {}, not {SCHEMA}", self.schema));
        }
        let split = self.shard_runs > 0 && self.runs.div_ceil(self.shard_runs) == self.shards;
        let part = self.part.is_none_or(|part| part.index >= 1 && part.index <= part.of);
        if split && part { Ok(()) } else { Err("its numbers contradict each other".into()) }
    }

    pub(crate) fn write(&self, folder: &Path) -> Result<(), StoreError> {
        // Text keys, and writing to memory: it does not fail.
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        place::put(&folder.join(FILE), text.as_bytes())
    }

    /// Whether a shard belongs here.
    #[must_use]
    pub fn has(&self, shard: u64) -> bool {
        shard < self.shards && self.part.is_none_or(|part| part.has(shard))
    }

    /// The shards that belong here.
    pub fn own_shards(&self) -> impl Iterator<Item = u64> + use<> {
        let part = self.part;
        (0..self.shards).filter(move |shard| part.is_none_or(|part| part.has(*shard)))
    }

    /// Runs of a shard.
    #[must_use]
    pub fn runs_of(&self, shard: u64) -> std::ops::Range<u64> {
        let start = shard.saturating_mul(self.shard_runs).min(self.runs);
        start..start.saturating_add(self.shard_runs).min(self.runs)
    }
}
