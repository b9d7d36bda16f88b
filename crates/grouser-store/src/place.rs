//! Writes files atomically, so that each is complete or missing.

use std::fs::{self, File};
use std::io::{Read as _, Write as _};
use std::path::{Path, PathBuf};

use crate::error::{ShardFault, StoreError};

/// Where the shards are.
pub(crate) const RUNS: &str = "runs";
/// The resolved study.
pub(crate) const STUDY: &str = "study.toml";

/// What names of unfinished files contain. They start with a dot, too: readers of data sets leave
/// such files out.
const UNFINISHED: &str = ".partial-";

/// Writes a file beside its place, waits until it is on disk, and renames it.
///
/// # Errors
/// [`StoreError::Disk`]; the place is as it was, and nothing is left beside it.
pub(crate) fn put(path: &Path, content: &[u8]) -> Result<(), StoreError> {
    let beside = beside(path);
    let written = write(&beside, content)
        .map_err(StoreError::at("write", path))
        .and_then(|()| fs::rename(&beside, path).map_err(StoreError::at("write", path)));
    if written.is_err() {
        // The disk's error was reported already.
        let _ = fs::remove_file(&beside);
    }
    written?;
    sync_folder(path);
    Ok(())
}

fn write(path: &Path, content: &[u8]) -> std::io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(content)?;
    file.sync_all()
}

/// All of a file, which is looked at before it is opened: a pipe or a device has no end.
///
/// * `most`: bytes that it may have
///
/// # Errors
/// The outer one of the disk; the inner one of a file that is not to be read.
pub(crate) fn read(path: &Path, most: u64) -> Result<Result<Vec<u8>, ShardFault>, StoreError> {
    let failed = || StoreError::at("read", path);
    let about = fs::metadata(path).map_err(failed())?;
    if !about.is_file() {
        return Ok(Err(ShardFault::NotRegular));
    }
    let too_large = |bytes: u64| Ok(Err(ShardFault::TooLarge { bytes, most }));
    if about.len() > most {
        return too_large(about.len());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(about.len()).unwrap_or(0));
    let file = File::open(path).map_err(failed())?;
    // It may grow meanwhile; one byte more than allowed tells.
    file.take(most.saturating_add(1)).read_to_end(&mut bytes).map_err(failed())?;
    if bytes.len() as u64 > most { too_large(bytes.len() as u64) } else { Ok(Ok(bytes)) }
}

/// The name of an unfinished file: only one process writes to a folder at a time, and on disks
/// without locks the number of the process keeps two apart.
fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}{UNFINISHED}{}", std::process::id()))
}

/// After a rename, for the case that the power fails. Not every system can; then it is as safe as
/// that system's renames.
fn sync_folder(path: &Path) {
    let folder = path.parent().and_then(|folder| File::open(folder).ok());
    drop(folder.map(|folder| folder.sync_all()));
}

/// Whether a name is that of an unfinished file.
pub(crate) fn is_unfinished(name: &str) -> bool {
    name.starts_with('.') && name.contains(UNFINISHED)
}

/// The names in a folder, sorted; none if it does not exist.
pub(crate) fn names(folder: &Path) -> Result<Vec<String>, StoreError> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(StoreError::at("look into", folder)(error)),
    };
    let name = |entry: std::io::Result<fs::DirEntry>| {
        entry.map(|entry| entry.file_name().to_string_lossy().into_owned())
    };
    let mut names: Vec<String> =
        entries.map(name).collect::<Result<_, _>>().map_err(StoreError::at("look into", folder))?;
    names.sort();
    Ok(names)
}

/// Removes what killed programs left unfinished.
pub(crate) fn remove_unfinished(folder: &Path) -> Result<(), StoreError> {
    for name in names(folder)?.iter().filter(|name| is_unfinished(name)) {
        let path = folder.join(name);
        fs::remove_file(&path).map_err(StoreError::at("remove", &path))?;
    }
    Ok(())
}
