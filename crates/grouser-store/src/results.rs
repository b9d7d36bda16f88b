//! A campaign's folder, for reading: each shard is read once, checked to the last bit, and given
//! away column by column, so that memory holds no more than one of them.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use bytes::Bytes;
use grouser::document::table::{Cell, Table, Values};
use parquet::errors::ParquetError;
use sha2::{Digest as _, Sha256};

use crate::error::{ShardFault, StoreError};
use crate::manifest::Manifest;
use crate::place::{self, RUNS, STUDY};
use crate::shard::{self, Checked};
use crate::shards::ShardSet;
use crate::study::{Study, hex, sha256};

/// The most bytes of a resolved study: samples are in it.
pub(crate) const MOST_STUDY_BYTES: u64 = 1 << 30;

/// A campaign whose shards are all there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finished {
    /// SHA-256 over the shards' bytes in their order: what `cat runs/*.parquet | sha256sum` prints.
    pub digest: String,
    /// How many shards there are.
    pub shards: u64,
    /// How many bytes they have.
    pub bytes: u64,
}

/// The results in a folder. Nothing is locked: a campaign may be writing there.
///
/// Nothing that is read is taken on trust: the manifest carries a hash of itself and one of the
/// study, a shard one of itself; and where all shards are there, the digest over them is compared
/// with the manifest's.
#[derive(Clone, Debug)]
pub struct Results {
    path: PathBuf,
    manifest: Manifest,
    study: String,
    missing: ShardSet,
}

impl Results {
    /// Those of a folder, finished or not.
    ///
    /// # Errors
    /// [`StoreError::NoCampaign`]; [`StoreError::Manifest`], [`StoreError::OldManifest`] or
    /// [`StoreError::StudyChanged`] if the folder's own files are not as they were written; or that
    /// the folder cannot be read.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let manifest = Manifest::read(path)?;
        let manifest = manifest.ok_or_else(|| StoreError::NoCampaign(path.to_owned()))?;
        let file = path.join(STUDY);
        let study = place::read(&file, MOST_STUDY_BYTES)?.unwrap_or_default();
        let is_right = sha256(&study) == manifest.study_sha256;
        let study = String::from_utf8(study).ok().filter(|_| is_right);
        let study = study.ok_or(StoreError::StudyChanged(file))?;
        let mut missing = manifest.all();
        for name in place::names(&path.join(RUNS))? {
            if let Some(shard) = shard::number_of(&name) {
                missing.remove(shard);
            }
        }
        Ok(Self { path: path.to_owned(), manifest, study, missing })
    }

    /// Checks that the manifest is that of a study, in everything that it records of the study.
    ///
    /// # Errors
    /// [`StoreError::StudyChanged`] if the study is another one, [`StoreError::Manifest`] if the
    /// manifest says something else of it.
    pub fn require_study(&self, study: &Study) -> Result<(), StoreError> {
        if study.hash != self.manifest.study_sha256 {
            return Err(StoreError::StudyChanged(self.study_file()));
        }
        if self.manifest.is_of(study, self.manifest.part) {
            return Ok(());
        }
        let problem = "it does not say what the study says".to_owned();
        Err(StoreError::Manifest { file: self.path.join(crate::manifest::FILE), problem })
    }

    /// The manifest.
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
    pub fn missing(&self) -> &ShardSet {
        &self.missing
    }

    /// Checks that all shards are there.
    ///
    /// # Errors
    /// [`StoreError::Unfinished`].
    pub fn require_all(&self) -> Result<(), StoreError> {
        if self.missing.is_empty() {
            return Ok(());
        }
        Err(StoreError::Unfinished { folder: self.path.clone(), shards: self.missing.clone() })
    }

    /// Reads the shards that are there, each once and in order: some columns of each, and at the
    /// end the digest over all bytes.
    ///
    /// * `each`: gets a shard's number and columns
    ///
    /// # Errors
    /// [`StoreError::Damaged`] for the first shard that is not as it was written;
    /// [`StoreError::OtherDigest`] if all are, and are not those that the campaign was finished
    /// with.
    pub fn read(
        &self,
        columns: &[&str],
        each: &mut dyn FnMut(u64, Table),
    ) -> Result<Finished, StoreError> {
        let finished = read(&self.path, &self.manifest, &self.missing.others(), columns, each)?;
        let recorded = self.manifest.digest.as_ref().filter(|_| self.missing.is_empty());
        match recorded {
            Some(recorded) if *recorded != finished.digest => Err(StoreError::OtherDigest {
                folder: self.path.clone(),
                recorded: recorded.clone(),
                found: finished.digest,
            }),
            _ => Ok(finished),
        }
    }

    /// The digest, computed from the files.
    ///
    /// # Errors
    /// The same as [`read`](Self::read), and [`StoreError::Unfinished`] if a shard is missing.
    pub fn digest(&self) -> Result<Finished, StoreError> {
        self.require_all()?;
        self.read(&[], &mut |_, _| {})
    }

    /// The file of a shard.
    #[must_use]
    pub fn file(&self, shard: u64) -> PathBuf {
        self.path.join(RUNS).join(shard::file_name(shard))
    }

    /// The bytes of a shard, checked.
    pub(crate) fn bytes(&self, shard: u64) -> Result<Bytes, StoreError> {
        Ok(bytes(&self.path, &self.manifest, shard)?.0)
    }

    /// Some columns of a shard.
    ///
    /// # Errors
    /// [`StoreError::Damaged`] if it is not there or not as it was written,
    /// [`StoreError::NoColumn`].
    pub fn shard(&self, shard: u64, columns: &[&str]) -> Result<Table, StoreError> {
        bytes(&self.path, &self.manifest, shard)?.1.table(columns)
    }

    /// Columns of all shards that are there, in the order of the runs, and the digest.
    ///
    /// # Errors
    /// The same as [`read`](Self::read), and [`StoreError::NoColumn`].
    pub fn columns(&self, names: &[&str]) -> Result<(Vec<Values>, Finished), StoreError> {
        let mut all: Vec<Values> = Vec::new();
        let mut fits = true;
        let finished = self.read(names, &mut |_, table| {
            let more = table.columns.into_iter().map(|(_, values)| values);
            if all.is_empty() {
                all = more.collect();
            } else {
                for (values, more) in all.iter_mut().zip(more) {
                    fits &= shard::append(values, more);
                }
            }
        })?;
        if !fits {
            return Err(ParquetError::General("a column changes its type".into()).into());
        }
        match names.get(all.len()) {
            Some(name) => Err(StoreError::NoColumn((*name).to_owned())),
            None => Ok((all, finished)),
        }
    }

    /// The row of a run, as it is stored.
    ///
    /// # Errors
    /// [`StoreError::NoRun`] if the campaign has no such run, or [`StoreError::Damaged`] if its
    /// shard is not there or not as it was written.
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
            Values::Words(values) => values.get(place).map(|names| Cell::Words(names.clone())),
        };
        let columns = self.shard(shard, &names)?.columns;
        let cells = columns.into_iter().map(|(name, values)| Some((name, cell(values)?)));
        cells.collect::<Option<_>>().ok_or(StoreError::NoRun { run, runs })
    }
}

/// Reads shards, each once and in order; the digest is over them.
pub(crate) fn read(
    path: &Path,
    manifest: &Manifest,
    shards: &ShardSet,
    columns: &[&str],
    each: &mut dyn FnMut(u64, Table),
) -> Result<Finished, StoreError> {
    let (mut hash, mut bytes_read) = (Sha256::new(), 0);
    for shard in shards.iter() {
        let (bytes, checked) = bytes(path, manifest, shard)?;
        hash.update(&bytes);
        bytes_read += bytes.len() as u64;
        each(shard, checked.table(columns)?);
    }
    Ok(Finished { digest: hex(&hash.finalize()), shards: shards.len(), bytes: bytes_read })
}

/// A shard's file, checked.
fn bytes(path: &Path, manifest: &Manifest, shard: u64) -> Result<(Bytes, Checked), StoreError> {
    let file = path.join(RUNS).join(shard::file_name(shard));
    let identity = manifest.identity(shard);
    let checked = match place::read(&file, identity.most_bytes()) {
        Ok(read) => read.and_then(|bytes| {
            let bytes = Bytes::from(bytes);
            Checked::open(&identity, bytes.clone()).map(|checked| (bytes, checked))
        }),
        Err(StoreError::Disk { source, .. }) if source.kind() == ErrorKind::NotFound => {
            Err(ShardFault::Absent)
        }
        Err(error) => return Err(error),
    };
    checked.map_err(|fault| StoreError::Damaged { file, fault })
}
