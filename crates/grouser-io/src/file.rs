//! Reads files up to a limit of size, without waiting for devices or pipes.
//!
//! A regular file is read, and a pipe that the caller was given already: the standard input as
//! `/dev/stdin`, and another descriptor as `/dev/fd/N`, which is what a shell makes of
//! `<(command)`. Devices have no end, and a pipe with a name waits until something writes: both are
//! refused.

use std::fs::{self, File, FileType, Metadata};
use std::io::{self, Read as _};
use std::path::{Component, Path, PathBuf};

use grouser_raster::beside;

/// A file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileProblem {
    /// A path that leads nowhere.
    #[error("there is no such file")]
    NoSuchFile,
    /// A link whose file is gone.
    #[error("this is a link to {}, which does not exist", super::escape::path(.target))]
    BrokenLink {
        /// What the link says.
        target: PathBuf,
    },
    /// A path, or a link behind it, that leads out of the folder that files may be in.
    #[error("this leads out of the folder that files may be in")]
    Outside,
    /// A folder where a file should be.
    #[error("this is a folder, not a file")]
    Folder,
    /// A device, a socket, or a pipe with a name.
    #[error(
        "this is {what}, not a file: files are read, and pipes that are open already, as \
         /dev/stdin and /dev/fd/N"
    )]
    NotAFile {
        /// What it is.
        what: &'static str,
    },
    /// More than is read.
    #[error("is larger than {limit} bytes, the most that is read")]
    TooLarge {
        /// The most that is read.
        limit: u64,
    },
    /// The disk, or permission for it, failed.
    #[error("cannot be read: {message}")]
    Unreadable {
        /// What failed.
        kind: io::ErrorKind,
        /// The system's message.
        message: String,
    },
}

/// The bytes of a file.
///
/// * `limit`: the most that may be in it [bytes]
///
/// # Errors
/// [`FileProblem`] for what is no file, is not there, may not be read, or is larger.
pub fn read(path: &Path, limit: u64) -> Result<Vec<u8>, FileProblem> {
    read_in(path, None, limit)
}

/// [`read`], of a file that has to be in a folder, if one is given.
///
/// # Errors
/// The same as [`read`], and [`FileProblem`] for one that is not in the folder.
pub fn read_in(path: &Path, within: Option<&Path>, limit: u64) -> Result<Vec<u8>, FileProblem> {
    let file = open_in(path, within)?;
    let mut bytes = Vec::new();
    // One byte more than allowed distinguishes a file that is too large from one that just fits,
    // without trusting a length that pipes do not have.
    let read = file.take(limit.saturating_add(1)).read_to_end(&mut bytes);
    read.map_err(|error| failed(path, &error))?;
    if bytes.len() as u64 > limit {
        return Err(FileProblem::TooLarge { limit });
    }
    Ok(bytes)
}

/// A path without links, if it stays within a folder. Of what is outside nothing is said, not even
/// whether it is there.
///
/// * `within`: the folder, itself without links
///
/// # Errors
/// [`FileProblem`] for a path that leads out of the folder, or nowhere.
pub(crate) fn confined(path: &Path, within: &Path) -> Result<PathBuf, FileProblem> {
    let mut steps = within.join(path);
    if steps.components().any(|step| step == Component::ParentDir) {
        let mut plain = PathBuf::new();
        for step in steps.components() {
            match step {
                Component::ParentDir => drop(plain.pop()),
                step => plain.push(step),
            }
        }
        steps = plain;
    }
    if !steps.starts_with(within) {
        return Err(FileProblem::Outside);
    }
    let found = fs::canonicalize(&steps).map_err(|error| {
        let mut inside: Vec<_> =
            steps.ancestors().take_while(|it| it.starts_with(within)).collect();
        inside.reverse();
        // The first step that leads out or nowhere. A link that leads nowhere may name what is
        // outside, which is said as if it were there.
        let is_inside =
            |step: &&Path| fs::canonicalize(step).is_ok_and(|it| it.starts_with(within));
        let step = inside.into_iter().find(|step| !is_inside(step)).unwrap_or(&steps);
        let is_out = step.is_symlink() || fs::canonicalize(step).is_ok();
        if is_out { FileProblem::Outside } else { failed(step, &error) }
    })?;
    if found.starts_with(within) { Ok(found) } else { Err(FileProblem::Outside) }
}

/// Cells of a map at the most that is read in a folder which others may name files of:
/// 1024 × 1024.
pub const CONFINED_CELLS: u64 = 1 << 20;
/// The largest file that is read there [bytes]: text takes some sixty for a cell.
pub const CONFINED_BYTES: u64 = 1 << 26;

/// Opens files by their paths, as [`grouser_raster::MapPath`] asks for.
///
/// * `within`: the folder that they have to be in, itself without links; `None` for any
pub fn opener(within: Option<&Path>) -> impl Fn(&Path) -> io::Result<File> {
    move |path| match open_in(path, within) {
        // What the system says stays as it is.
        Err(FileProblem::Unreadable { kind, message }) => Err(io::Error::new(kind, message)),
        opened => opened.map_err(io::Error::other),
    }
}

/// Opens a file, which has to be in a folder, if one is given, however links change meanwhile.
pub(crate) fn open_in(path: &Path, within: Option<&Path>) -> Result<File, FileProblem> {
    let Some(within) = within else { return open(path) };
    let path = confined(path, within)?;
    let steps = path.strip_prefix(within).map_err(|_| FileProblem::Outside)?;
    let file = open_steps(within, steps).map_err(|error| failed(&path, &error))?;
    let metadata = file.metadata().map_err(|error| failed(&path, &error))?;
    check(&metadata, false)?;
    if metadata.len() > CONFINED_BYTES {
        return Err(FileProblem::TooLarge { limit: CONFINED_BYTES });
    }
    Ok(file)
}

/// Opens a file step by step, and follows no link: a path had none when it was looked at.
#[cfg(unix)]
fn open_steps(folder: &Path, steps: &Path) -> io::Result<File> {
    use rustix::fs::{Mode, OFlags, open, openat};
    let flags = OFlags::RDONLY | OFlags::CLOEXEC | OFlags::NOFOLLOW | OFlags::NONBLOCK;
    let mut at = open(folder, flags, Mode::empty())?;
    for step in steps {
        at = openat(&at, step, flags, Mode::empty())?;
    }
    Ok(at.into())
}

#[cfg(not(unix))]
fn open_steps(folder: &Path, steps: &Path) -> io::Result<File> {
    File::open(folder.join(steps))
}

/// A map's path without links, if neither it nor what is read with it leads out of a folder, and it
/// is a file.
///
/// * `within`: the folder, itself without links
///
/// # Errors
/// [`FileProblem`] for a path that leads out of the folder, or to no file.
pub fn confined_map(path: &Path, within: &Path) -> Result<PathBuf, FileProblem> {
    let path = confined(path, within)?;
    check_regular(&path, Some(within))?;
    check_beside(&path, within)?;
    Ok(path)
}

/// Checks that what is read with a map does not lead out of a folder.
pub(crate) fn check_beside(map: &Path, within: &Path) -> Result<(), FileProblem> {
    beside(map).iter().try_for_each(|file| confined(file, within).map(drop))
}

/// A link that leads nowhere, and where it should lead.
#[must_use]
pub fn broken_link(path: &Path) -> Option<PathBuf> {
    let is_broken = fs::metadata(path).is_err_and(|error| is_absent(&error));
    is_broken.then(|| fs::read_link(path).ok()).flatten()
}

/// Checks that a path leads to a file that ends, for callers that open it themselves.
///
/// * `within`: the folder that it has to be in
///
/// # Errors
/// The same as [`read`].
pub(crate) fn check_regular(path: &Path, within: Option<&Path>) -> Result<(), FileProblem> {
    open_in(path, within).map(drop)
}

/// Opens a file without waiting, for callers that read it bit by bit.
///
/// # Errors
/// The same as [`read`], but for the size.
pub fn open(path: &Path) -> Result<File, FileProblem> {
    let failed = |error: io::Error| failed(path, &error);
    if let Some(input) = standard_input(path) {
        let file = input.map_err(failed)?;
        return check(&file.metadata().map_err(failed)?, true).map(|()| file);
    }
    let metadata = fs::metadata(path).map_err(failed)?;
    let is_given = is_descriptor(path);
    check(&metadata, is_given)?;
    let file = if is_given { File::open(path) } else { open_at_once(path) }.map_err(failed)?;
    // Between the first look and the opening something else may have come there.
    check(&file.metadata().map_err(failed)?, is_given)?;
    Ok(file)
}

/// Checks that there is something to read.
///
/// * `is_given`: whether it was open already, so that a pipe has somebody who writes
fn check(metadata: &Metadata, is_given: bool) -> Result<(), FileProblem> {
    let kind = metadata.file_type();
    if kind.is_file() || (is_given && is_pipe(kind)) {
        return Ok(());
    }
    if kind.is_dir() {
        return Err(FileProblem::Folder);
    }
    let what = if is_pipe(kind) { "a named pipe" } else { "a device" };
    Err(FileProblem::NotAFile { what })
}

#[cfg(unix)]
fn is_pipe(kind: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    kind.is_fifo() || kind.is_socket()
}

#[cfg(not(unix))]
fn is_pipe(_: FileType) -> bool {
    false
}

/// Without waiting for somebody who writes, if it has become a pipe meanwhile.
#[cfg(unix)]
fn open_at_once(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt as _;
    File::options().read(true).custom_flags(libc::O_NONBLOCK).open(path)
}

#[cfg(not(unix))]
fn open_at_once(path: &Path) -> io::Result<File> {
    File::open(path)
}

/// The standard input, if that is what a path names. It is used as it is, not opened again: a named
/// pipe behind it may have nobody left who writes.
#[cfg(unix)]
fn standard_input(path: &Path) -> Option<io::Result<File>> {
    use std::os::fd::AsFd as _;
    let names = ["/dev/stdin", "/dev/fd/0", "/proc/self/fd/0"];
    let is_it = names.into_iter().any(|name| path == Path::new(name));
    is_it.then(|| io::stdin().as_fd().try_clone_to_owned().map(File::from))
}

#[cfg(not(unix))]
fn standard_input(_: &Path) -> Option<io::Result<File>> {
    None
}

/// Whether a path names a descriptor of this process.
fn is_descriptor(path: &Path) -> bool {
    ["/dev/fd", "/proc/self/fd"].into_iter().any(|folder| path.parent() == Some(Path::new(folder)))
}

fn is_absent(error: &io::Error) -> bool {
    use io::ErrorKind::{InvalidInput, NotADirectory, NotFound};
    matches!(error.kind(), NotFound | NotADirectory | InvalidInput)
}

fn failed(path: &Path, error: &io::Error) -> FileProblem {
    match error.kind() {
        _ if is_absent(error) => match broken_link(path) {
            Some(target) => FileProblem::BrokenLink { target },
            None => FileProblem::NoSuchFile,
        },
        io::ErrorKind::IsADirectory => FileProblem::Folder,
        kind => FileProblem::Unreadable { kind, message: error.to_string() },
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    /// A folder that becomes a link between the look and the opening.
    #[test]
    fn a_link_that_came_meanwhile_is_not_followed() {
        let root = std::env::temp_dir().join(format!("grouser-links-{}", std::process::id()));
        let [folder, outside] = ["folder", "outside"].map(|name| root.join(name));
        fs::create_dir_all(folder.join("sub")).unwrap();
        fs::create_dir_all(&outside).unwrap();
        fs::write(folder.join("sub/file"), "inside").unwrap();
        fs::write(outside.join("file"), "outside").unwrap();
        let steps = Path::new("sub/file");
        assert!(open_steps(&folder, steps).is_ok());
        fs::remove_dir_all(folder.join("sub")).unwrap();
        std::os::unix::fs::symlink(&outside, folder.join("sub")).unwrap();
        let (of_folder, of_file) =
            (open_steps(&folder, steps), open_steps(&outside, Path::new("file")));
        assert!(of_folder.is_err() && of_file.is_ok());
        std::os::unix::fs::symlink(outside.join("file"), folder.join("file")).unwrap();
        assert!(open_steps(&folder, Path::new("file")).is_err());
        fs::remove_dir_all(root).unwrap();
    }
}
