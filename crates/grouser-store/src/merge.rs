//! Brings the parts of an array of jobs together.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::error::StoreError;
use crate::folder::Folder;
use crate::results::{Finished, Results};
use crate::shards::{Progression, ShardSet};
use crate::study::{Study, VERSION, difference};

/// Copies the shards of several folders to one, which is then as if one program had computed all.
/// Interrupted, it goes on where it stopped. Each shard is checked to the last bit on its way.
///
/// * `copied`: called after every shard with how many there are now, and of how many
///
/// # Errors
/// [`StoreError`] before anything is written if a folder has another study or version, is not
/// finished, or shards are missing or twice; [`StoreError::Damaged`] on the way.
pub fn merge(
    target: &Path,
    study: &Study,
    folders: &[PathBuf],
    copied: &mut dyn FnMut(u64, u64),
) -> Result<Finished, StoreError> {
    let parts = folders.iter().map(|folder| part(study, folder)).collect::<Result<Vec<_>, _>>()?;
    let shards = owners(&parts, folders)?;
    let all = study.shards();
    let mut missing = ShardSet::all(Progression::of(all, None));
    for shard in shards.keys() {
        missing.remove(*shard);
    }
    if !missing.is_empty() {
        return Err(StoreError::Missing { shards: missing, all });
    }
    let mut folder = Folder::open(target, study, None)?;
    for shard in folder.missing().clone().iter() {
        folder.accept(shard, &parts[shards[&shard]].bytes(shard)?)?;
        copied(all - folder.missing().len(), all);
    }
    folder.finish()
}

/// A folder whose part is finished.
fn part(study: &Study, folder: &Path) -> Result<Results, StoreError> {
    let results = Results::open(folder)?;
    check_identity(folder, study, &results)?;
    results.require_all()?;
    Ok(results)
}

/// Which folder has which shard, by its place in the list. The parts are finished, so that there
/// are no more shards than files.
fn owners(parts: &[Results], folders: &[PathBuf]) -> Result<BTreeMap<u64, usize>, StoreError> {
    let mut shards: BTreeMap<u64, usize> = BTreeMap::new();
    for (place, part) in parts.iter().enumerate() {
        for shard in part.manifest().own_shards() {
            if let Some(first) = shards.insert(shard, place) {
                let (first, second) = (folders[first].clone(), folders[place].clone());
                return Err(StoreError::Duplicate { shard, first, second });
            }
        }
    }
    Ok(shards)
}

fn check_identity(folder: &Path, study: &Study, results: &Results) -> Result<(), StoreError> {
    let (manifest, folder) = (results.manifest(), folder.to_owned());
    if manifest.study_sha256 != study.hash {
        let difference = difference(results.study(), &study.text);
        return Err(StoreError::OtherStudy { folder, difference });
    }
    if manifest.version != VERSION {
        let (theirs, ours) = (manifest.version.clone(), VERSION.to_owned());
        return Err(StoreError::OtherVersion { folder, theirs, ours });
    }
    results.require_study(study)
}
