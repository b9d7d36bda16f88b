//! Messages of a log in the order of time.
//!
//! MCAP lets a recorder write messages in any order: topic after topic, say. The index at the end
//! says from when to when each chunk is, so that chunks are read in the order in which they begin,
//! and a message waits until no chunk is left that begins before it. Without a whole index chunks
//! are read as they stand, and messages of each in the order of time.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};

use crate::mcap::format::{ChunkIndex, DataEnd, MAGIC, Message, Record};
use crate::mcap::read::{Known, Messages, OverBudget};

/// What waits for its turn at the most [bytes]; more is passed on before.
const MOST_WAITING: usize = 64 << 20;

/// Messages in the order of time.
pub(crate) struct Chronological {
    messages: Messages<Box<dyn Read>>,
    /// When each chunk begins, in the order in which they are read [ns]; empty without an index.
    begins: Vec<u64>,
    waiting: BTreeMap<(u64, u64), (Message, Vec<u8>)>,
    /// Size of what waits [bytes].
    size: usize,
    /// Messages that came so far, and those among them that came before the chunk that is read.
    count: u64,
    before_chunk: u64,
    has_ended: bool,
}

impl Chronological {
    /// Begins at the start of a file; nothing if it is no MCAP.
    ///
    /// * `index`: of its chunks, if it is whole
    /// * `budget`: how much of it is read
    pub(crate) fn new(
        mut file: File,
        index: Vec<ChunkIndex>,
        budget: OverBudget,
    ) -> io::Result<Option<Self>> {
        file.rewind()?;
        let chunks = to_be_sorted(index);
        let begins = chunks.iter().map(|it| it.first).collect();
        let source: Box<dyn Read> = match &chunks[..] {
            [] => Box::new(BufReader::new(file)),
            _ => {
                Box::new(ChunksOf { file, chunks, next: 0, rest: MAGIC.to_vec(), has_ended: false })
            }
        };
        let messages = Messages::new(source, budget)?;
        Ok(messages.map(|messages| Self {
            messages,
            begins,
            waiting: BTreeMap::new(),
            size: 0,
            count: 0,
            before_chunk: 0,
            has_ended: false,
        }))
    }

    /// What was read so far.
    pub(crate) fn messages(&self) -> &Messages<Box<dyn Read>> {
        &self.messages
    }

    /// The next message on a channel that is wanted, with its content.
    ///
    /// # Errors
    /// Where the disk fails, or the log unpacks to more than a log of its size may.
    pub(crate) fn next_message(
        &mut self,
        mut is_wanted: impl FnMut(&Known, u16) -> bool,
    ) -> io::Result<Option<(Message, Vec<u8>)>> {
        loop {
            let is_due = self.waiting.first_key_value().is_some_and(|(key, _)| self.is_due(*key));
            if is_due && let Some((_, found)) = self.waiting.pop_first() {
                self.size -= found.1.len();
                return Ok(Some(found));
            }
            if self.has_ended {
                return Ok(None);
            }
            let before = self.messages.chunks();
            let Some(message) = self.messages.next_message(&mut is_wanted)? else {
                self.has_ended = true;
                continue;
            };
            let data = self.messages.data().to_vec();
            if self.messages.chunks() != before {
                self.before_chunk = self.count;
            }
            self.size += data.len();
            self.waiting.insert((message.log_time, self.count), (message, data));
            self.count += 1;
            if !self.messages.is_in_chunk() {
                self.before_chunk = self.count;
            }
        }
    }

    fn is_due(&self, (time, number): (u64, u64)) -> bool {
        let begin = self.messages.chunks().checked_sub(1).and_then(|it| self.begins.get(it));
        let is_before = match begin {
            Some(begin) => time <= *begin,
            None => number < self.before_chunk,
        };
        self.has_ended || self.size > MOST_WAITING || is_before
    }
}

/// The chunks in the order in which they begin; none where they stand so already.
fn to_be_sorted(mut chunks: Vec<ChunkIndex>) -> Vec<ChunkIndex> {
    if chunks.is_sorted_by(|one, other| one.last <= other.first) {
        return Vec::new();
    }
    chunks.sort_by_key(|it| (it.first, it.start));
    chunks
}

/// The record after all data, without a check sum.
const END: [u8; 13] = [DataEnd::OPCODE, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0];

/// A file that has nothing but some chunks.
struct ChunksOf {
    file: File,
    chunks: Vec<ChunkIndex>,
    next: usize,
    /// What is read next.
    rest: Vec<u8>,
    /// Whether the record that ends a file is part of it.
    has_ended: bool,
}

impl Read for ChunksOf {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        /// A chunk is read in parts of this size [bytes].
        const PART: u64 = 1 << 20;
        while self.rest.is_empty() {
            let Some(chunk) = self.chunks.get_mut(self.next) else {
                if self.has_ended {
                    return Ok(0);
                }
                (self.has_ended, self.rest) = (true, END.to_vec());
                continue;
            };
            let part = chunk.length.min(PART);
            self.file.seek(SeekFrom::Start(chunk.start))?;
            (&self.file).take(part).read_to_end(&mut self.rest)?;
            (chunk.start, chunk.length) = (chunk.start + part, chunk.length - part);
            self.next += usize::from(chunk.length == 0);
        }
        let count = self.rest.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.rest[..count]);
        self.rest.drain(..count);
        Ok(count)
    }
}
