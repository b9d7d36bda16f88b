//! A campaign's folder, for reading: one column after another, so that memory holds no more than that.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use grouser::document::campaign::{Cell, Table, Values};

use crate::error::StoreError;
use crate::folder::{Finished, RUNS, STUDY, digest};
use crate::manifest::Manifest;
use crate::{place, shard};

/// The results in a folder. Nothing is locked: a campaign may be writing there.
#[derive(Clone, Debug)]
pub struct Results {
    path: PathBuf,
    manifest: Manifest,
    study: String,
    missing: Vec<u64>,
}

impl Results {
    /// Those of a folder, finished or not.
    ///
    /// # Errors
    /// [`StoreError::NoCampaign`], or that the folder cannot be read.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let manifest = Manifest::read(path)?;
        let manifest = manifest.ok_or_else(|| StoreError::NoCampaign(path.to_owned()))?;
        let file = path.join(STUDY);
        let study = fs::read_to_string(&file).map_err(StoreError::at("read", &file))?;
        let there: BTreeSet<u64> = place::names(&path.join(RUNS))?
            .iter()
            .filter_map(|name| shard::number_of(name))
            .collect();
        let missing = manifest.own_shards().filter(|shard| !there.contains(shard)).collect();
        Ok(Self { path: path.to_owned(), manifest, study, missing })
    }

    /// What the folder says of itself.
    #[must_use]
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// The resolved study, as TOML.
    #[must_use]
    pub fn study(&self) -> &str {
        &self.study
    }

    /// Its file.
    #[must_use]
    pub fn study_file(&self) -> PathBuf {
        self.path.join(STUDY)
    }

    /// The shards that belong here and are not there.
    #[must_use]
    pub fn missing(&self) -> &[u64] {
        &self.missing
    }

    /// That all shards are there.
    ///
    /// # Errors
    /// [`StoreError::Unfinished`].
    pub fn require_all(&self) -> Result<(), StoreError> {
        if self.missing.is_empty() {
            return Ok(());
        }
        Err(StoreError::Unfinished { folder: self.path.clone(), shards: self.missing.clone() })
    }

    /// The digest, computed from the files.
    ///
    /// # Errors
    /// [`StoreError::Disk`], also if a shard is missing.
    pub fn digest(&self) -> Result<Finished, StoreError> {
        digest(&self.path, &self.manifest)
    }

    /// The file of a shard.
    #[must_use]
    pub fn file(&self, shard: u64) -> PathBuf {
        self.path.join(RUNS).join(shard::file_name(shard))
    }

    /// Some columns of a shard.
    ///
    /// # Errors
    /// [`StoreError`] if it is not there, or not whole, or has no such column.
    pub fn shard(&self, shard: u64, columns: &[&str]) -> Result<Table, StoreError> {
        let path = self.file(shard);
        let file = File::open(&path).map_err(StoreError::at("read", &path))?;
        shard::read(file, columns)
    }

    /// A column of all shards that are there, in the order of the runs.
    ///
    /// # Errors
    /// [`StoreError`] if a shard is not whole, or has no such column.
    pub fn column(&self, name: &str) -> Result<Values, StoreError> {
        let mut all: Option<Values> = None;
        for shard in self.manifest.own_shards().filter(|shard| !self.missing.contains(shard)) {
            for (_, more) in self.shard(shard, &[name])?.columns {
                match &mut all {
                    None => all = Some(more),
                    Some(values) => shard::append(values, more),
                }
            }
        }
        all.ok_or_else(|| StoreError::NoColumn(name.to_owned()))
    }

    /// The row of a run, as it is stored.
    ///
    /// # Errors
    /// [`StoreError::NoRun`] if the campaign has no such run, or [`StoreError`] if its shard is not
    /// there.
    pub fn row(&self, run: u64) -> Result<Vec<(String, Cell)>, StoreError> {
        let runs = self.manifest.runs;
        if run >= runs {
            return Err(StoreError::NoRun { run, runs });
        }
        let shard = run / self.manifest.shard_runs;
        let place = usize::try_from(run - self.manifest.runs_of(shard).start).unwrap_or(usize::MAX);
        let names: Vec<&str> =
            self.manifest.columns.iter().map(|column| column.name.as_str()).collect();
        let cell = |values: Values| match values {
            Values::Float(values) => values.get(place).map(|value| Cell::Float(*value)),
            Values::Whole(values) => values.get(place).map(|value| Cell::Whole(*value)),
            Values::Text(values) => values.get(place).map(|value| Cell::Text(value.clone())),
        };
        let columns = self.shard(shard, &names)?.columns;
        let cells = columns.into_iter().map(|(name, values)| Some((name, cell(values)?)));
        cells.collect::<Option<_>>().ok_or(StoreError::NoRun { run, runs })
    }
}
