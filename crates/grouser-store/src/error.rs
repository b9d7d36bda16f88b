//! Errors of a campaign's folder.

use std::io;
use std::path::{Path, PathBuf};

use crate::shards::ShardSet;

/// A folder that cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// The disk or its permissions.
    #[error("cannot {operation} {}: {source}", path.display())]
    Disk {
        /// The operation, such as `write`.
        operation: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// A file stands where the folder has to be.
    #[error("{} is a file: a campaign needs a folder, a new one or that of the same \
             study", .0.display())]
    NotAFolder(PathBuf),
    /// Another program writes there.
    #[error(
        "another campaign is writing to {}\nhint: wait until it is done, stop it, or choose another folder",
        .0.display()
    )]
    Locked(PathBuf),
    /// The folder has files that no campaign wrote.
    #[error(
        "the folder {} is not empty, and holds no campaign: {found} is in it\nhint: choose another folder",
        folder.display()
    )]
    NotACampaign {
        /// The folder.
        folder: PathBuf,
        /// One of the things in it.
        found: String,
    },
    /// There is no campaign to read.
    #[error("{} holds no campaign: it has no manifest.json", .0.display())]
    NoCampaign(PathBuf),
    /// The manifest is not as it was written.
    #[error(
        "{}: {problem}\nhint: going on with the same study in this folder checks every shard and writes the manifest anew",
        file.display()
    )]
    Manifest {
        /// The manifest.
        file: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// The manifest is from before manifests carried a hash.
    #[error(
        "{}: it is of an earlier form, without a hash of itself, so that a change of it would not be noticed\nhint: going on with the same study in this folder checks every shard and writes the manifest anew",
        .0.display()
    )]
    OldManifest(PathBuf),
    /// The study in a folder is not the one that its manifest names.
    #[error(
        "{}: its SHA-256 is not that of the study whose runs are here: it was changed or damaged\nhint: going on with the same study in this folder writes it anew",
        .0.display()
    )]
    StudyChanged(PathBuf),
    /// A shard's file is not as it was written, or not in its place.
    #[error("{}: {fault}\nhint: going on with the campaign in this folder computes the shard anew", file.display())]
    Damaged {
        /// The shard's file.
        file: PathBuf,
        /// What is wrong with it.
        fault: ShardFault,
    },
    /// The folder has the results of another study.
    #[error(
        "the folder {} has the runs of another study: {difference}\nhint: choose another folder, or give the study its old values",
        folder.display()
    )]
    OtherStudy {
        /// The folder.
        folder: PathBuf,
        /// What differs, key by key.
        difference: String,
    },
    /// The folder has the results of another version of the program, which may compute otherwise.
    #[error(
        "the folder {} has runs of grouser {theirs}, this is {ours}: their numbers may differ\nhint: choose another folder, or go on with grouser {theirs}",
        folder.display()
    )]
    OtherVersion {
        /// The folder.
        folder: PathBuf,
        /// Its version.
        theirs: String,
        /// This one.
        ours: String,
    },
    /// The folder is for another part of an array of jobs.
    #[error("the folder {} is for {theirs}, not for {ours}\nhint: give every part a folder of its own", folder.display())]
    OtherPart {
        /// The folder.
        folder: PathBuf,
        /// What it is for.
        theirs: String,
        /// What was asked for.
        ours: String,
    },
    /// A Parquet file that the campaign does not have.
    #[error("{} is no shard of this campaign: move it away", .0.display())]
    UnknownShard(PathBuf),
    /// A shard is not whole, or not one of this campaign.
    #[error("shard {shard}: {fault}")]
    Shard {
        /// Its number.
        shard: u64,
        /// What is wrong.
        fault: ShardFault,
    },
    /// Shards that were not computed yet.
    #[error("{} of {all} shards are missing: {shards}", shards.len())]
    Missing {
        /// Which ones.
        shards: ShardSet,
        /// How many there should be.
        all: u64,
    },
    /// A part's folder in which the part is not finished.
    #[error("{} is not finished: {} of its shards are missing\nhint: run its campaign again, it goes on where it stopped", folder.display(), shards.len())]
    Unfinished {
        /// The folder.
        folder: PathBuf,
        /// What is missing.
        shards: ShardSet,
    },
    /// Two folders have the same shard.
    #[error("{} and {} both have shard {shard}\nhint: leave one of them out", first.display(), second.display())]
    Duplicate {
        /// Its number.
        shard: u64,
        /// A folder.
        first: PathBuf,
        /// Another one.
        second: PathBuf,
    },
    /// The bytes of a finished campaign have changed.
    #[error(
        "{}: its digest was {recorded}, now it is {found}\nhint: some shard was computed anew with other numbers; run the campaign in a new folder",
        folder.display()
    )]
    OtherDigest {
        /// The folder.
        folder: PathBuf,
        /// The digest that the manifest has.
        recorded: String,
        /// The digest of the shards as they are.
        found: String,
    },
    /// A column that the campaign does not have.
    #[error("there is no column {0}")]
    NoColumn(String),
    /// A run that the campaign does not have.
    #[error("there is no run {run}: the campaign has runs 0 to {}", runs.saturating_sub(1))]
    NoRun {
        /// Its number.
        run: u64,
        /// How many there are.
        runs: u64,
    },
    /// The writer or reader of Parquet failed.
    #[error("Parquet: {0}")]
    Parquet(#[from] parquet::errors::ParquetError),
}

/// The fault of a shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShardFault {
    /// It ends too early, or bits of it have changed.
    #[error("the file is truncated or damaged")]
    Damaged,
    /// It is not there, or no longer.
    #[error("there is no such file")]
    Absent,
    /// A link to a device, a pipe or a folder, which is not read.
    #[error("it is no regular file")]
    NotRegular,
    /// No shard of so many rows and columns is that long.
    #[error(
        "the file has {bytes} bytes, more than the {most} that a shard of this campaign may have"
    )]
    TooLarge {
        /// Bytes of the file.
        bytes: u64,
        /// The most bytes that it may have.
        most: u64,
    },
    /// It is a shard of another study, another version, or has another number.
    #[error("the file is that of another {0}")]
    Foreign(&'static str),
    /// It has too few or too many rows.
    #[error("the file has {found} rows, it should have {expected}")]
    Rows {
        /// Rows of the file.
        found: u64,
        /// Rows that it should have.
        expected: u64,
    },
}

impl StoreError {
    /// Whether the disk, its permissions or another program are in the way, or files are damaged:
    /// the request itself is right.
    #[must_use]
    pub fn is_environment(&self) -> bool {
        matches!(
            self,
            Self::Disk { .. } | Self::Locked(_) | Self::Parquet(_) | Self::OtherDigest { .. }
        ) || self.mendable_folder().is_some()
    }

    /// The folder in which going on with the campaign mends what is wrong.
    #[must_use]
    pub fn mendable_folder(&self) -> Option<&Path> {
        match self {
            Self::Manifest { file, .. } | Self::OldManifest(file) | Self::StudyChanged(file) => {
                file.parent()
            }
            Self::Damaged { file, .. } => file.parent()?.parent(),
            _ => None,
        }
    }

    /// A failed operation on a file or folder.
    pub(crate) fn at(operation: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Disk { operation, path, source }
    }
}
