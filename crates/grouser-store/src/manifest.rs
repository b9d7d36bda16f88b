//! The manifest: the campaign of a folder, its progress, and when it was computed.
//!
//! Its last value is the SHA-256 of the file itself, computed with zeros in that place, as in a
//! shard.

use std::io::ErrorKind;
use std::path::Path;

use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};

use crate::error::StoreError;
use crate::identity::{ColumnRecord, Identity};
use crate::part::Part;
use crate::place;
use crate::shards::{Progression, ShardSet};
use crate::study::{Study, VERSION, hex};

/// The manifest's file.
pub(crate) const FILE: &str = "manifest.json";
const SCHEMA: &str = "grouser.campaign.manifest.v2";
/// The form without a hash.
const OLD_SCHEMA: &str = "grouser.campaign.manifest.v1";
/// What stands before the manifest's hash of itself.
const HASH_KEY: &str = "\"manifest_sha256\": \"";
/// Digits of a SHA-256.
const HASH_DIGITS: usize = 64;
/// The most bytes that a manifest may have: a campaign of 10 000 columns and as many sessions has a
/// tenth.
const MOST_BYTES: u64 = 1 << 26;
/// The most runs of a shard, as in the range of the document's `shard_runs`.
const MOST_SHARD_RUNS: u64 = 1_000_000;

/// The manifest of a folder.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    schema: String,
    /// The program's version.
    pub version: String,
    /// The study's name.
    pub name: String,
    /// SHA-256 of the resolved study, `study.toml`.
    pub study_sha256: String,
    /// Seed of the samples.
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
    /// SHA-256 of the file; zeros in memory.
    #[serde(rename = "manifest_sha256", default = "zeros")]
    own_sha256: String,
}

fn zeros() -> String {
    "0".repeat(HASH_DIGITS)
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

impl Manifest {
    /// The manifest of a campaign of which nothing is computed yet.
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
            own_sha256: zeros(),
        }
    }

    /// Reads the manifest of a folder, if it has one.
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, StoreError> {
        Self::bytes(folder)?.map(|bytes| Self::parse(&bytes, &folder.join(FILE))).transpose()
    }

    /// Reads the manifest of a folder, if it was written before manifests had a hash. Nothing
    /// confirms its content.
    pub(crate) fn read_old(folder: &Path) -> Result<Option<Self>, StoreError> {
        let Some(bytes) = Self::bytes(folder)? else { return Ok(None) };
        let old = serde_json::from_slice(&bytes).ok();
        Ok(old.filter(|manifest: &Self| manifest.schema == OLD_SCHEMA))
    }

    fn bytes(folder: &Path) -> Result<Option<Vec<u8>>, StoreError> {
        let file = folder.join(FILE);
        match place::read(&file, MOST_BYTES) {
            Ok(Ok(bytes)) => Ok(Some(bytes)),
            Ok(Err(fault)) => Err(StoreError::Manifest { file, problem: fault.to_string() }),
            Err(StoreError::Disk { source, .. }) if source.kind() == ErrorKind::NotFound => {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// A manifest's file, if its hash of itself is right.
    ///
    /// * `file`: what messages call it
    ///
    /// # Errors
    /// [`StoreError::Manifest`] if it is not as it was written, [`StoreError::OldManifest`] if it
    /// has no hash.
    pub fn parse(bytes: &[u8], file: &Path) -> Result<Self, StoreError> {
        let wrong = |problem: &str| StoreError::Manifest {
            file: file.to_owned(),
            problem: problem.to_owned(),
        };
        let Some(place) = hash_place(bytes) else {
            let parsed: Result<serde_json::Value, _> = serde_json::from_slice(bytes);
            return Err(match parsed {
                Ok(parsed) if parsed["schema"] == OLD_SCHEMA => {
                    StoreError::OldManifest(file.into())
                }
                _ => wrong("it was changed or damaged: it has no hash of itself"),
            });
        };
        let found = Sha256::new()
            .chain_update(&bytes[..place])
            .chain_update(zeros())
            .chain_update(&bytes[place + HASH_DIGITS..])
            .finalize();
        if hex(&found).as_bytes() != &bytes[place..place + HASH_DIGITS] {
            return Err(wrong("it was changed or damaged: its hash of itself is wrong"));
        }
        let manifest: Self =
            serde_json::from_slice(bytes).map_err(|error| wrong(&error.to_string()))?;
        manifest.check().map_err(|problem| wrong(&problem))?;
        Ok(Self { own_sha256: zeros(), ..manifest })
    }

    /// What somebody may have written with a right hash, and no campaign has.
    fn check(&self) -> Result<(), String> {
        if self.schema != SCHEMA {
            return Err(format!("its schema is {}, not {SCHEMA}", self.schema.escape_debug()));
        }
        let split = (1..=MOST_SHARD_RUNS).contains(&self.shard_runs)
            && self.runs.div_ceil(self.shard_runs) == self.shards;
        let part = self.part.is_none_or(|part| part.index >= 1 && part.index <= part.of);
        if split && part { Ok(()) } else { Err("its numbers contradict each other".into()) }
    }

    /// Whether it says of a study what one says that is new, but for what was computed since.
    #[must_use]
    pub fn is_of(&self, study: &Study, part: Option<Part>) -> bool {
        let (digest, sessions) = (self.digest.clone(), self.sessions.clone());
        *self == Self { digest, sessions, ..Self::new(study, part) }
    }

    /// The same in today's form.
    pub(crate) fn renewed(self) -> Self {
        Self { schema: SCHEMA.into(), own_sha256: zeros(), ..self }
    }

    /// Its file: with the hash of itself.
    #[must_use]
    pub fn to_text(&self) -> String {
        let zeroed = Self { own_sha256: zeros(), ..self.clone() };
        // Text keys, and writing to memory: it does not fail.
        let mut text = serde_json::to_string_pretty(&zeroed).unwrap_or_default() + "\n";
        if let Some(place) = hash_place(text.as_bytes()) {
            let hash = hex(&Sha256::digest(text.as_bytes()));
            text.replace_range(place..place + HASH_DIGITS, &hash);
        }
        text
    }

    pub(crate) fn write(&self, folder: &Path) -> Result<(), StoreError> {
        place::put(&folder.join(FILE), self.to_text().as_bytes())
    }

    /// What a shard's file has to say of itself.
    #[must_use]
    pub fn identity(&self, shard: u64) -> Identity {
        let runs = self.runs_of(shard);
        Identity {
            study_sha256: self.study_sha256.clone(),
            version: self.version.clone(),
            shard,
            rows: runs.end - runs.start,
            columns: self.columns.clone(),
        }
    }

    /// Whether a shard belongs here.
    #[must_use]
    pub fn has(&self, shard: u64) -> bool {
        shard < self.shards && self.part.is_none_or(|part| part.has(shard))
    }

    /// The shards that belong here.
    pub fn own_shards(&self) -> impl Iterator<Item = u64> + use<> {
        self.progression().iter()
    }

    /// How many shards belong here.
    #[must_use]
    pub fn own_count(&self) -> u64 {
        self.progression().count()
    }

    fn progression(&self) -> Progression {
        Progression::of(self.shards, self.part)
    }

    /// All shards that belong here.
    pub(crate) fn all(&self) -> ShardSet {
        ShardSet::all(self.progression())
    }

    /// Runs of a shard.
    #[must_use]
    pub fn runs_of(&self, shard: u64) -> std::ops::Range<u64> {
        let start = shard.saturating_mul(self.shard_runs).min(self.runs);
        start..start.saturating_add(self.shard_runs).min(self.runs)
    }

    /// Runs of some shards.
    #[must_use]
    pub fn runs_in(&self, shards: &ShardSet) -> u64 {
        let Some(last) = self.shards.checked_sub(1) else { return 0 };
        let full = shards.len().saturating_mul(self.shard_runs);
        let runs = self.runs_of(last);
        let short = self.shard_runs.saturating_sub(runs.end - runs.start);
        if shards.contains(last) { full.saturating_sub(short) } else { full }
    }
}

/// Where in a manifest its hash stands.
fn hash_place(bytes: &[u8]) -> Option<usize> {
    let key = HASH_KEY.as_bytes();
    let place = bytes.windows(key.len()).rposition(|window| window == key)? + key.len();
    (place + HASH_DIGITS <= bytes.len()).then_some(place)
}
