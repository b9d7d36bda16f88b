//! One writer for a folder: a lock on the folder itself, which ends with the program, however that
//! ends.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use grouser::document::escape;

use crate::failure::Failure;

/// The folders that this program has taken.
static TAKEN: Mutex<Vec<(PathBuf, File)>> = Mutex::new(Vec::new());

/// Takes a folder that is there for this program alone; whether it had it already.
pub(super) fn take(folder: &Path) -> Result<bool, Failure> {
    let place = folder.canonicalize().map_err(Failure::at("cannot look into", folder))?;
    let mut taken = TAKEN.lock().unwrap_or_else(PoisonError::into_inner);
    if taken.iter().any(|(own, _)| *own == place) {
        return Ok(true);
    }
    // Not every system opens folders, and not every disk has locks: better none than no results.
    let Ok(opened) = File::open(&place) else { return Ok(false) };
    match opened.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let shown = escape::path(folder);
            Err(Failure::Run(format!(
                "another program of Grouser is writing to the folder {shown}\nhint: wait for it, or \
                 choose another folder"
            )))
        }
        Ok(()) | Err(TryLockError::Error(_)) => {
            taken.push((place, opened));
            Ok(false)
        }
    }
}

/// Makes a folder for what a run keeps there until it ends, and takes it.
pub(crate) fn make_folder(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(Failure::at("cannot make the folder", folder))?;
    take(folder).map(drop)
}
