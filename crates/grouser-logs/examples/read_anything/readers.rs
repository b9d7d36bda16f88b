//! Every reader of the workspace, with files that it reads.

mod documents;
mod logs;
mod rasters;
mod tables;

use std::error::Error;
use std::fmt::{Debug, Display};
use std::fs::OpenOptions;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use grouser_core::paper;
use grouser_core::vehicle::Rover;
use grouser_io::{Kind, Overrides, Source, read_rover};
use tempfile::TempDir;

/// What became of an input.
pub(crate) enum Outcome {
    /// Something was read.
    Read,
    /// It was refused, for this reason.
    Refused(String),
    /// Something was read that should not be, such as a number that is not finite.
    Wrong(String),
}

/// A reader.
pub(crate) struct Reader {
    pub(crate) name: &'static str,
    /// How many of the cases it gets, relative to the others.
    pub(crate) share: u32,
    /// What is damaged.
    pub(crate) files: Vec<Vec<u8>>,
    /// Puts check sums right, behind which there is more to damage.
    pub(crate) mend: Option<fn(&mut Vec<u8>)>,
    pub(crate) read: fn(&[u8], &Stage) -> Outcome,
}

impl Reader {
    fn new(
        name: &'static str,
        share: u32,
        files: Vec<Vec<u8>>,
        read: fn(&[u8], &Stage) -> Outcome,
    ) -> Self {
        Self { name, share, files, mend: None, read }
    }
}

/// All of them.
///
/// # Errors
/// Where a file of the repository cannot be read, or one cannot be made.
pub(crate) fn all() -> Result<Vec<Reader>, Box<dyn Error>> {
    let mut all = documents::all();
    all.extend(tables::all());
    all.extend(rasters::all()?);
    all.extend(logs::all()?);
    Ok(all)
}

/// What readers need beside the bytes.
pub(crate) struct Stage {
    folder: TempDir,
    rover: Rover,
    /// A rover like that, with motors.
    motors: Rover,
}

impl Stage {
    pub(crate) fn new() -> io::Result<Self> {
        // In memory, where the system has such a folder.
        let memory = Path::new("/dev/shm");
        let folder = if memory.is_dir() { TempDir::new_in(memory)? } else { TempDir::new()? };
        let rover = paper::traverse().map_err(io::Error::other)?.rover;
        let motor = Overrides::parse(["rover.motor=maxon-re-25"]);
        let source = Source::find(Kind::Rover, "hakuto");
        let motors = source.and_then(|source| read_rover(&source, &motor?));
        let motors = motors.map_err(io::Error::other)?.value;
        Ok(Self { folder, rover, motors })
    }

    /// A file with these bytes, for readers that open one.
    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.folder.path().join(name);
        // A file that was emptied first is written to the disk at once by some systems.
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
        let written = file.and_then(|mut file| {
            file.write_all(bytes)?;
            file.set_len(bytes.len() as u64)
        });
        written.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        path
    }
}

/// What was read, if anything; its numbers are not looked at.
fn any<T, E: Display>(read: &Result<T, E>) -> Outcome {
    match read {
        Ok(_) => Outcome::Read,
        Err(error) => refused(error),
    }
}

/// What was read, if anything, and whether its numbers are finite.
fn finite<T: Debug, E: Display>(read: &Result<T, E>) -> Outcome {
    match read {
        Ok(read) => crate::finite::finite(read),
        Err(error) => refused(error),
    }
}

fn refused(error: &impl Display) -> Outcome {
    Outcome::Refused(error.to_string())
}
