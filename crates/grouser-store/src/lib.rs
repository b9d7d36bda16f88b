//! Stores a campaign's results on disk, so that a kill at any moment loses no more than the shard
//! being computed.
//!
//! ```text
//! DIR/manifest.json              what campaign this is, by which version, when, and its digest once finished
//! DIR/study.toml                 the resolved study: enough to run it again
//! DIR/runs/part-000017.parquet   shard 17: the same bytes always
//! DIR/.lock                      held while a program writes here
//! ```
//!
//! [`Study`] is a campaign as the store sees it, [`shard`] turns rows into a file's bytes and back,
//! [`Folder`] is the folder that a campaign writes, [`Results`] the same for reading, [`merge`]
//! brings the parts of an array of jobs together, [`compute`] has all computed that is missing, and
//! [`Statistics`] has the library's statistics of all that is there.
//!
//! Shards are computed one by one, in any order, anywhere: [`shard_bytes`] makes one,
//! [`Folder::missing`] lists the missing ones, [`Folder::accept`] takes them in. A file appears
//! under its name only when it is whole and on disk (written beside, synced, renamed), and carries
//! a hash of its own bytes, which every reader checks; so does the manifest, and the study is
//! compared with the manifest's hash of it. Neither a clock nor a random number goes into a shard:
//! the [`digest`](Folder::finish) over all of them is that of the campaign, however it was
//! computed.

mod compute;
mod error;
mod figures;
mod folder;
mod identity;
mod manifest;
mod merge;
mod part;
mod place;
mod results;
pub mod shard;
mod shards;
mod statistics;
mod study;
mod time;

#[cfg(test)]
mod damage;
#[cfg(test)]
mod tests;

pub use compute::compute;
pub use error::{ShardFault, StoreError};
pub use figures::{Figure, figures};
pub use folder::Folder;
pub use identity::ColumnRecord;
pub use manifest::{Manifest, Session};
pub use merge::merge;
pub use part::Part;
pub use results::{Finished, Results};
pub use shards::ShardSet;
pub use statistics::{
    ConvergenceRecord, Curve, ProbabilityRecord, SensitivityRecord, Statistics, Table,
};
pub use study::{Study, difference, sha256};

use grouser::document::campaign::Campaign;

/// Computes a shard of a campaign, to its bytes: all that a worker has to do.
///
/// * `go_on`: asked before each run; `None` is returned if it says no
///
/// # Errors
/// [`StoreError`] if the rows cannot be written.
pub fn shard_bytes(
    campaign: &Campaign,
    shard: u64,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Vec<u8>>, StoreError> {
    let Some(table) = campaign.shard(shard, go_on) else { return Ok(None) };
    shard::encode(&Study::of(campaign), shard, &table).map(Some)
}
