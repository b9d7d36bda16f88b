//! A file that grows, read to its end and then as it grows; what happens to it meanwhile is told at
//! once.

mod head;

use std::fs::{self, File, Metadata};
use std::io::{self, Read, Seek as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use grouser::document::escape;

use self::head::TableHead;
use crate::failure::Failure;
use crate::interrupt;

/// How often a file is asked whether it has grown.
const PATIENCE: Duration = Duration::from_millis(50);
/// A file is silent once it has not grown for so long, and for so many of its own intervals.
/// Source: ours.
const SILENT_AFTER: Duration = Duration::from_secs(10);
const SILENT_INTERVALS: u32 = 5;

/// Until when a file is followed: until Ctrl-C, or until it has not grown for some time.
#[derive(Clone)]
pub(crate) struct Following {
    /// The time without growth after which it ends.
    pub(crate) quiet: Option<Duration>,
    /// Is told what happens to the file, in words.
    pub(crate) tell: Arc<dyn Fn(&str) + Send + Sync>,
    /// Counts the lines that were read.
    pub(crate) lines: Arc<AtomicU64>,
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
        Ok(FollowedFile {
            path: path.to_owned(),
            file,
            following: self,
            head: TableHead::default(),
            given: Vec::new(),
            read: 0,
            ends_line: true,
            grew: Instant::now(),
            interval: Duration::ZERO,
            is_silent: false,
            is_gone: false,
        })
    }
}

/// A file that is followed.
pub(crate) struct FollowedFile {
    path: PathBuf,
    file: File,
    following: Following,
    /// The lines up to that of the columns, which a file that takes its place has, too.
    head: TableHead,
    /// Bytes that were read, and are to be given first.
    given: Vec<u8>,
    /// Bytes of the file that were read.
    read: u64,
    /// Whether the last byte ended a line.
    ends_line: bool,
    grew: Instant,
    /// The longest of its intervals between two growths, as it was seen of late.
    interval: Duration,
    is_silent: bool,
    is_gone: bool,
}

impl Read for FollowedFile {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            if !self.given.is_empty() {
                let count = buffer.len().min(self.given.len());
                buffer[..count].copy_from_slice(&self.given[..count]);
                self.given.drain(..count);
                return Ok(count);
            }
            let count = self.file.read(buffer)?;
            if count > 0 {
                self.grow(count);
                self.take(&buffer[..count])?;
                continue;
            }
            self.look()?;
            let is_quiet = self.following.quiet.is_some_and(|quiet| self.grew.elapsed() >= quiet);
            if is_quiet || interrupt::is_asked_to_stop() {
                return Ok(0);
            }
            thread::sleep(PATIENCE);
        }
    }
}

impl FollowedFile {
    fn tell(&self, what: &str) {
        (self.following.tell)(&format!("{}: {what}", escape::path(&self.path)));
    }

    fn grow(&mut self, count: usize) {
        // What was there at the start did not grow.
        if self.read > 0 {
            // An interval that does not come again is forgotten.
            self.interval = self.grew.elapsed().max(self.interval.mul_f64(0.9));
        }
        self.read += count as u64;
        self.grew = Instant::now();
        if std::mem::take(&mut self.is_silent) {
            self.tell("it grows again");
        }
    }

    /// Takes bytes of the file: all of the first one, of another what comes after its head.
    fn take(&mut self, bytes: &[u8]) -> io::Result<()> {
        let rows = self.head.take(bytes).map_err(io::Error::other)?;
        if let Some(last) = rows.last() {
            self.ends_line = *last == b'\n';
        }
        let lines =
            rows.split_inclusive(|byte| *byte == b'\n').filter(|it| it.ends_with(b"\n")).count();
        self.following.lines.fetch_add(lines as u64, Ordering::Relaxed);
        self.given.extend(rows);
        Ok(())
    }

    /// Looks at what became of a file whose end was read.
    fn look(&mut self) -> io::Result<()> {
        let about = self.file.metadata()?;
        // A pipe has no length, and no other takes its place.
        if about.is_file() {
            if about.len() < self.read {
                self.tell("it became shorter while it was followed: read on from its start");
                self.file.rewind()?;
                self.begin_another();
            } else {
                self.look_for_another(&about)?;
            }
        }
        let patience = SILENT_AFTER.max(SILENT_INTERVALS * self.interval);
        if !self.is_silent && self.grew.elapsed() >= patience {
            self.is_silent = true;
            self.tell(&format!("no data for {} s", self.grew.elapsed().as_secs()));
        }
        Ok(())
    }

    fn look_for_another(&mut self, about: &Metadata) -> io::Result<()> {
        match fs::metadata(&self.path) {
            Ok(there) if is_same(about, &there) => self.is_gone = false,
            Ok(_) => {
                self.tell("another file took its place: going on with that");
                self.file = File::open(&self.path)?;
                self.begin_another();
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                if !std::mem::replace(&mut self.is_gone, true) {
                    self.tell("it was removed or moved: waiting for another of its name");
                }
            }
            Err(error) => return Err(error),
        }
        Ok(())
    }

    fn begin_another(&mut self) {
        (self.read, self.is_gone) = (0, false);
        self.head.begin_another();
        if !std::mem::replace(&mut self.ends_line, true) {
            self.given.push(b'\n');
        }
    }
}

#[cfg(unix)]
fn is_same(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Files have no name of their own here: one that takes the place of another is not seen.
#[cfg(not(unix))]
fn is_same(_: &Metadata, _: &Metadata) -> bool {
    true
}
