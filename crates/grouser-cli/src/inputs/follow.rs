//! A file that grows, read to its end and then as it grows.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use grouser::document::escape;

use crate::failure::Failure;
use crate::interrupt;

/// How often a file is asked whether it has grown.
const PATIENCE: Duration = Duration::from_millis(50);

/// Until when a file is followed: until Ctrl-C, or until it has not grown for some time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Following {
    /// The time without growth after which it ends.
    pub(crate) quiet: Option<Duration>,
}

impl Following {
    /// A file of CSV, from its start.
    pub(crate) fn open(self, path: &Path) -> Result<FollowedFile, Failure> {
        let label = escape::path(path);
        let failed = |why: &str| {
            Failure::Usage(format!("{label}: {why}\nhint: --follow reads a file of CSV, or a pipe"))
        };
        if path.is_dir() {
            return Err(failed("this is a folder, not a file"));
        }
        let file = File::open(path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => failed("there is no such file"),
            _ => Failure::Run(format!("{label}: cannot be read: {error}")),
        })?;
        Ok(FollowedFile { file, quiet: self.quiet, read: 0, grew: Instant::now() })
    }
}

/// A file that is followed.
pub(crate) struct FollowedFile {
    file: File,
    quiet: Option<Duration>,
    read: u64,
    grew: Instant,
}

impl Read for FollowedFile {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            let count = self.file.read(buffer)?;
            if count > 0 {
                self.read += count as u64;
                self.grew = Instant::now();
                return Ok(count);
            }
            // A pipe has no length.
            let about = self.file.metadata()?;
            if about.is_file() && about.len() < self.read {
                return Err(io::Error::other("it became shorter while it was followed"));
            }
            let is_quiet = self.quiet.is_some_and(|quiet| self.grew.elapsed() >= quiet);
            if is_quiet || interrupt::is_asked_to_stop() {
                return Ok(0);
            }
            thread::sleep(PATIENCE);
        }
    }
}
