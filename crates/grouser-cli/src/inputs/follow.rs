//! A file that grows, read to its end and then as it grows.

use std::fs::File;
use std::io::{self, Read};
use std::thread;
use std::time::{Duration, Instant};

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
    pub(crate) fn of(self, file: File) -> FollowedFile {
        FollowedFile { file, quiet: self.quiet, read: 0, grew: Instant::now() }
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
