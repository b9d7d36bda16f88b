//! Computes what is missing of a campaign: one thread has the shards computed, by all threads, one
//! shard after another; another one takes them to the disk, so that no thread waits for that.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread;

use grouser::document::Campaign;

use crate::error::StoreError;
use crate::folder::Folder;
use crate::shard_bytes;
use crate::shards::ShardSet;

/// Computes the shards that a folder misses, until all are there, `go_on` is false or one cannot be
/// taken in.
///
/// * `go_on`: asked before each run, from any thread
/// * `take`: [accepts](Folder::accept) a shard by its number and bytes
///
/// # Errors
/// Those of `take`, and [`StoreError`] if rows cannot be written.
pub fn compute<E: From<StoreError>>(
    campaign: &Campaign,
    folder: &mut Folder,
    go_on: &(dyn Fn() -> bool + Sync),
    mut take: impl FnMut(&mut Folder, u64, &[u8]) -> Result<(), E>,
) -> Result<(), E> {
    // Two shards wait at most: more would only fill memory where the disk is slow.
    let (sender, receiver) = sync_channel(2);
    let missing = folder.missing().clone();
    let disk_failed = AtomicBool::new(false);
    thread::scope(|scope| {
        let is_on = || go_on() && !disk_failed.load(Ordering::Relaxed);
        let computing = scope.spawn(move || compute_shards(campaign, &missing, &is_on, &sender));
        let kept = receiver.into_iter().try_for_each(|(shard, bytes)| take(folder, shard, &bytes));
        disk_failed.store(kept.is_err(), Ordering::Relaxed);
        let computed = computing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        kept.and(computed.map_err(E::from))
    })
}

fn compute_shards(
    campaign: &Campaign,
    shards: &ShardSet,
    go_on: &(dyn Fn() -> bool + Sync),
    sender: &SyncSender<(u64, Vec<u8>)>,
) -> Result<(), StoreError> {
    for shard in shards.iter() {
        let Some(bytes) = shard_bytes(campaign, shard, go_on)? else { break };
        // Nobody takes shards any more once the disk failed.
        if sender.send((shard, bytes)).is_err() {
            break;
        }
    }
    Ok(())
}
