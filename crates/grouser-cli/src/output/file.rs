//! A single output file: written beside and renamed; an old one is replaced only on request.

#[cfg(unix)]
use std::fs::Permissions;
use std::io::{BufWriter, Write};
use std::path::Path;

use grouser::document::{self, escape};
use tempfile::NamedTempFile;

use crate::failure::Failure;
use crate::interrupt;

/// Checks that a file may be written: it is not there yet, or may be replaced.
pub(crate) fn check_new(out: &Path, may_replace: bool) -> Result<(), Failure> {
    if out.is_dir() {
        let out = escape::path(out);
        return Err(Failure::Usage(format!("{out} is a folder, not a file")));
    }
    if let Some(missing) = document::file::broken_link(out) {
        let (out, missing) = (escape::path(out), escape::path(&missing));
        return Err(Failure::Usage(format!(
            "{out} is a link to {missing}, which does not exist: choose another name"
        )));
    }
    check_ordinary(out)?;
    let folder = folder_of(out);
    if !folder.is_dir() {
        let (out, folder) = (escape::path(out), escape::path(folder));
        return Err(Failure::Usage(format!(
            "cannot write {out}: {folder} is no folder; make it, or choose another name"
        )));
    }
    if out.exists() && !may_replace {
        let out = escape::path(out);
        return Err(Failure::Usage(format!(
            "{out} exists already: choose another name, or add --force to replace it"
        )));
    }
    Ok(())
}

/// Checks that what is to be replaced is a file: nothing would be left of a device or a pipe.
pub(super) fn check_ordinary(out: &Path) -> Result<(), Failure> {
    if out.metadata().is_ok_and(|found| !found.is_file()) {
        let out = escape::path(out);
        return Err(Failure::Usage(format!(
            "{out} is a device or a pipe, which is not replaced: choose another name"
        )));
    }
    Ok(())
}

/// The folder that a file is in, or is to be in.
fn folder_of(out: &Path) -> &Path {
    match out.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Writes a file of bytes that are all there, as [`write_by`] does.
pub(crate) fn write(out: &Path, content: &[u8]) -> Result<(), Failure> {
    write_by(out, |file| file.write_all(content).map_err(Failure::at("cannot write", out)))
}

/// Writes a file that was asked for, as [`write`] does, and tells a terminal.
pub(crate) fn write_result(out: &Path, content: &[u8]) -> Result<(), Failure> {
    write(out, content).inspect(|()| say_written(out))
}

/// Tells a terminal which file was written.
pub(crate) fn say_written(out: &Path) {
    if super::terminal::has_progress() {
        super::message(&format!("wrote {}", escape::path(out)));
    }
}

/// Writes beside and renames, so that the file is whole or not there. It has the permissions of the
/// file that it replaces, or those of any new file.
///
/// * `content`: writes it
pub(crate) fn write_by(
    out: &Path,
    content: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let _deferred = interrupt::defer_ctrl_c();
    // A link stays one, and leads to the new file.
    let behind_link = out.is_symlink().then(|| out.canonicalize()).and_then(Result::ok);
    let out = behind_link.as_deref().unwrap_or(out);
    let failed = || Failure::at("cannot write", out);
    let file = new_file(folder_of(out)).map_err(failed())?;
    let mut buffer = BufWriter::new(file);
    content(&mut buffer)?;
    let file = buffer.into_inner().map_err(|error| failed()(error.into_error()))?;
    if let Ok(replaced) = out.metadata() {
        file.as_file().set_permissions(replaced.permissions()).map_err(failed())?;
    }
    file.as_file().sync_all().map_err(failed())?;
    file.persist(out).map(drop).map_err(|error| failed()(error.error))
}

/// A file without a name yet. Of their own, temporary files are for their owner alone.
#[cfg(unix)]
fn new_file(folder: &Path) -> std::io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt as _;
    /// What every new file may be, before the user's mask.
    const FOR_ALL: u32 = 0o666;
    tempfile::Builder::new().permissions(Permissions::from_mode(FOR_ALL)).tempfile_in(folder)
}

#[cfg(not(unix))]
fn new_file(folder: &Path) -> std::io::Result<NamedTempFile> {
    NamedTempFile::new_in(folder)
}
