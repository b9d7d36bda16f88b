//! Reads the container MCAP from its start to its end: messages of channels, in chunks that may be
//! compressed.
//!
//! Nothing is sought in the index at the end, so that a log whose recorder lost its power is read
//! as far as it was written. What is damaged is passed over and counted. Sizes that a file states
//! are believed only within limits, no more memory is taken than bytes are there, and no more work
//! is done than a log of its size needs.

use std::collections::HashMap;
use std::io::{self, Cursor, Read};

use crate::mcap::format::{
    Channel, Chunk, ChunkIndex, DataEnd, Footer, Head, MAGIC, Message, Part as _, Record as _,
    Schema, compression,
};

/// The largest chunk that is read, as it is stored [bytes].
const MOST_STORED: u64 = 128 << 20;
/// The largest chunk that is unpacked [bytes].
const MOST_UNPACKED: u64 = 1 << 30;
/// The largest record that is kept: a message, a schema, a channel [bytes].
const MOST_RECORD: u64 = 16 << 20;
/// So much of all schemas and channels is kept [bytes].
const MOST_KNOWN: usize = 64 << 20;

/// Records that are unpacked of any log, and for each of its bytes: a message takes five bytes of a
/// log that is packed well.
const RECORDS: u64 = 4_000_000;
const RECORDS_PER_BYTE: u64 = 1;
/// Bytes that are unpacked of any log, and for each of its bytes.
const UNPACKED: u64 = 256 << 20;
const UNPACKED_PER_BYTE: u64 = 64;

/// A log that unpacks to more than a log of its size may, or than was allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "its {length} bytes unpack to more than {} MiB or {} records, the most that are read of {}",
    self.most_unpacked() >> 20, self.most_records(),
    if self.allowed.is_some() { "it" } else { "a log of that size" }
)]
pub struct OverBudget {
    /// Size of the log [bytes].
    pub(crate) length: u64,
    /// The most that was allowed, in place of what its size allows [bytes].
    pub(crate) allowed: Option<u64>,
}

impl OverBudget {
    pub(crate) fn most_unpacked(self) -> u64 {
        let by_size = || UNPACKED.saturating_add(self.length.saturating_mul(UNPACKED_PER_BYTE));
        self.allowed.unwrap_or_else(by_size)
    }

    fn most_records(self) -> u64 {
        let by_size = || RECORDS.saturating_add(self.length.saturating_mul(RECORDS_PER_BYTE));
        self.allowed.map_or_else(by_size, |bytes| bytes / (UNPACKED / RECORDS))
    }
}

/// What a log may still take.
#[derive(Clone, Copy, Debug)]
struct Budget {
    unpacked: u64,
    records: u64,
}

/// Schemas and channels that were met.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    pub(crate) schemas: HashMap<u16, Schema>,
    pub(crate) channels: HashMap<u16, Channel>,
    size: usize,
}

impl Known {
    /// Takes in a record of a schema or a channel; whether it is one, and there is room for it.
    /// What is known already stands: recorders repeat it in every chunk.
    fn take(&mut self, opcode: u8, content: &[u8]) -> bool {
        let Some(id) = u16::take(&mut &content[..]) else { return false };
        let is_schema = opcode == Schema::OPCODE;
        if is_schema && self.schemas.contains_key(&id)
            || !is_schema && self.channels.contains_key(&id)
        {
            return true;
        }
        self.size += content.len();
        if self.size > MOST_KNOWN {
            return false;
        }
        let mut rest = content;
        let taken = if is_schema {
            Schema::take(&mut rest).map(|it| drop(self.schemas.insert(id, it)))
        } else {
            Channel::take(&mut rest).map(|it| drop(self.channels.insert(id, it)))
        };
        taken.is_some()
    }
}

/// What of a file could not be read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Damage {
    /// The byte at which the file ends, if that is in the middle or without its end.
    pub(crate) cut_at: Option<u64>,
    /// Chunks that cannot be unpacked to their end.
    pub(crate) chunks: u64,
    /// Chunks whose checksum is not that of their content, which was read nevertheless.
    pub(crate) sums: u64,
    /// Chunks and records larger than is read.
    pub(crate) too_large: u64,
    /// Records whose content is invalid.
    pub(crate) records: u64,
}

impl Damage {
    /// A sentence for each kind of damage.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let cut = self.cut_at.map(|byte| {
            format!(
                "the log ends at byte {byte} without its end, as after a loss of power; all \
                     before is read"
            )
        });
        let counts = [
            (self.chunks, "chunks are damaged and read to the damage only"),
            (self.sums, "chunks have another checksum than stated, and are read nevertheless"),
            (self.too_large, "chunks or records are larger than any telemetry, and left out"),
            (self.records, "records are damaged and left out"),
        ];
        let counts = counts.into_iter().filter(|(count, _)| *count > 0);
        cut.into_iter().chain(counts.map(|(count, what)| format!("{count} {what}"))).collect()
    }
}

/// Messages of a file, one after the other.
pub(crate) struct Messages<R> {
    source: Counting<R>,
    chunk: Option<OpenChunk>,
    /// Chunks that were begun.
    chunks: usize,
    budget: Budget,
    of_length: OverBudget,
    pub(crate) known: Known,
    pub(crate) damage: Damage,
    data: Vec<u8>,
    has_ended: bool,
}

impl<R: Read> Messages<R> {
    /// Reads how the file begins; nothing if it is no MCAP.
    ///
    /// * `of_length`: how much of it is read
    pub(crate) fn new(mut source: R, of_length: OverBudget) -> io::Result<Option<Self>> {
        let mut magic = Vec::new();
        (&mut source).take(MAGIC.len() as u64).read_to_end(&mut magic)?;
        if magic != MAGIC {
            return Ok(None);
        }
        let source = Counting { source, count: magic.len() as u64 };
        let (known, damage) = (Known::default(), Damage::default());
        let budget =
            Budget { unpacked: of_length.most_unpacked(), records: of_length.most_records() };
        Ok(Some(Self {
            source,
            chunk: None,
            chunks: 0,
            budget,
            of_length,
            known,
            damage,
            data: Vec::new(),
            has_ended: false,
        }))
    }

    /// How many chunks were begun.
    pub(crate) fn chunks(&self) -> usize {
        self.chunks
    }

    /// Whether the last message was in a chunk.
    pub(crate) fn is_in_chunk(&self) -> bool {
        self.chunk.is_some()
    }

    /// The content of the last message.
    pub(crate) fn data(&self) -> &[u8] {
        self.data.get(Message::SIZE..).unwrap_or_default()
    }

    /// The next message on a channel that is wanted.
    ///
    /// # Errors
    /// Where the disk fails, and [`OverBudget`]; all else is damage, and counted.
    pub(crate) fn next_message(
        &mut self,
        mut is_wanted: impl FnMut(&Known, u16) -> bool,
    ) -> io::Result<Option<Message>> {
        while !self.has_ended {
            let Some(chunk) = &mut self.chunk else {
                self.next_at_top()?;
                if let Some(message) = self.pending_at_top(&mut is_wanted) {
                    return Ok(Some(message));
                }
                continue;
            };
            let met = (&mut self.known, &mut self.damage);
            match chunk.next(met, &mut self.data, &mut is_wanted, &mut self.budget) {
                Inside::Message(message) => return Ok(Some(message)),
                Inside::End => self.chunk = None,
                Inside::OverBudget => {
                    self.has_ended = true;
                    return Err(io::Error::other(self.of_length));
                }
            }
        }
        Ok(None)
    }

    /// A message that stands outside of all chunks.
    fn pending_at_top(
        &mut self,
        is_wanted: &mut impl FnMut(&Known, u16) -> bool,
    ) -> Option<Message> {
        if self.chunk.is_some() || self.has_ended || self.data.is_empty() {
            return None;
        }
        let message = Message::take(&mut &self.data[..]);
        if message.is_none() {
            self.damage.records += 1;
        }
        message.filter(|message| is_wanted(&self.known, message.channel))
    }

    /// Takes in the next record outside of chunks: a message becomes the data, a chunk the chunk.
    fn next_at_top(&mut self) -> io::Result<()> {
        self.data.clear();
        let Some(head) = Head::read(&mut self.source)? else {
            self.cut();
            return Ok(());
        };
        match head.opcode {
            DataEnd::OPCODE | Footer::OPCODE => {
                self.has_ended = true;
                return Ok(());
            }
            Schema::OPCODE | Channel::OPCODE | Message::OPCODE if head.length <= MOST_RECORD => {}
            Chunk::OPCODE if head.length <= MOST_STORED => {}
            _ => {
                let is_of_interest = matches!(head.opcode, Schema::OPCODE..=Chunk::OPCODE);
                self.damage.too_large += u64::from(is_of_interest);
                let passed = io::copy(&mut (&mut self.source).take(head.length), &mut io::sink())?;
                if passed < head.length {
                    self.cut();
                }
                return Ok(());
            }
        }
        let mut content = std::mem::take(&mut self.data);
        let read = (&mut self.source).take(head.length).read_to_end(&mut content)? as u64;
        if head.opcode == Chunk::OPCODE {
            // Of a chunk that is cut off, all records that are there are read.
            match OpenChunk::of(content) {
                Ok(chunk) => {
                    self.chunks += 1;
                    self.chunk = Some(chunk);
                }
                Err(Refused::TooLarge) => self.damage.too_large += 1,
                Err(Refused::Damaged) => self.damage.chunks += u64::from(read == head.length),
            }
            if read < head.length {
                self.damage.cut_at = Some(self.source.count);
                if let Some(chunk) = &mut self.chunk {
                    chunk.is_cut = true;
                } else {
                    self.has_ended = true;
                }
            }
            return Ok(());
        }
        if read < head.length {
            self.cut();
            return Ok(());
        }
        if head.opcode == Message::OPCODE {
            self.data = content;
        } else if !self.known.take(head.opcode, &content) {
            self.damage.records += 1;
        }
        Ok(())
    }

    /// The file ends within a record.
    fn cut(&mut self) {
        self.damage.cut_at.get_or_insert(self.source.count);
        self.has_ended = true;
        self.data.clear();
    }
}

/// Schemas and channels of an index, and where chunks are; nothing if it is damaged.
pub(crate) fn known_of(mut source: impl Read) -> io::Result<Option<(Known, Vec<ChunkIndex>)>> {
    let (mut known, mut chunks) = (Known::default(), Vec::new());
    let mut content = Vec::new();
    while let Some(head) = Head::read(&mut source)? {
        content.clear();
        let read = (&mut source).take(head.length).read_to_end(&mut content)? as u64;
        let is_known = matches!(head.opcode, Schema::OPCODE | Channel::OPCODE);
        if read < head.length || (is_known && !known.take(head.opcode, &content)) {
            return Ok(None);
        }
        if head.opcode == ChunkIndex::OPCODE {
            let Some(chunk) = ChunkIndex::take(&mut &content[..]) else { return Ok(None) };
            chunks.push(chunk);
        }
    }
    Ok(Some((known, chunks)))
}

/// A chunk on its way.
struct OpenChunk {
    records: Summing<Box<dyn Read>>,
    /// Checksum, as the file states it; 0 where it does not.
    sum: u32,
    /// The file ends within it.
    is_cut: bool,
}

enum Refused {
    TooLarge,
    Damaged,
}

enum Inside {
    Message(Message),
    End,
    OverBudget,
}

impl OpenChunk {
    fn of(content: Vec<u8>) -> Result<Self, Refused> {
        let mut rest = &content[..];
        let Chunk { size, sum, compression, .. } =
            Chunk::take(&mut rest).ok_or(Refused::Damaged)?;
        // How much is stored is what is there, whatever is stated.
        let place = content.len() - rest.len();
        if size > MOST_UNPACKED {
            return Err(Refused::TooLarge);
        }
        let mut stored = Cursor::new(content);
        stored.set_position(place as u64);
        let records: Box<dyn Read> = match compression.as_str() {
            compression::NONE => Box::new(stored),
            compression::ZSTD => {
                let decoder = ruzstd::decoding::StreamingDecoder::new(stored);
                Box::new(decoder.map_err(|_| Refused::Damaged)?)
            }
            compression::LZ4 => Box::new(lz4_flex::frame::FrameDecoder::new(stored)),
            _ => return Err(Refused::Damaged),
        };
        // Whatever it unpacks to, no more than stated is read.
        let records: Box<dyn Read> = Box::new(records.take(size));
        let records = Summing { source: records, sum: crc32fast::Hasher::new() };
        Ok(Self { records, sum, is_cut: false })
    }

    /// The next message that is wanted.
    fn next(
        &mut self,
        (known, damage): (&mut Known, &mut Damage),
        data: &mut Vec<u8>,
        is_wanted: &mut impl FnMut(&Known, u16) -> bool,
        budget: &mut Budget,
    ) -> Inside {
        loop {
            if budget.records == 0 || budget.unpacked == 0 {
                return Inside::OverBudget;
            }
            let Ok(head) = Head::read(&mut self.records) else { return self.damaged(damage) };
            let Some(Head { opcode, length }) = head else { return self.end(damage) };
            budget.records -= 1;
            data.clear();
            let is_kept = matches!(opcode, Schema::OPCODE | Channel::OPCODE | Message::OPCODE);
            let mut record = (&mut self.records).take(length);
            if is_kept && length > MOST_RECORD {
                damage.too_large += 1;
            }
            let read = if is_kept && length <= MOST_RECORD {
                record.read_to_end(data).map(|count| count as u64)
            } else {
                io::copy(&mut record, &mut io::sink())
            };
            // What a record claims is not yet unpacked.
            let unpacked = read.as_ref().map_or(0, |count| *count) + Head::SIZE as u64;
            budget.unpacked = budget.unpacked.saturating_sub(unpacked);
            if read.ok() != Some(length) {
                return self.damaged(damage);
            }
            if !is_kept || length > MOST_RECORD {
                continue;
            }
            if opcode != Message::OPCODE {
                damage.records += u64::from(!known.take(opcode, data));
                continue;
            }
            match Message::take(&mut &data[..]) {
                Some(message) if is_wanted(known, message.channel) => {
                    return Inside::Message(message);
                }
                Some(_) => {}
                None => damage.records += 1,
            }
        }
    }

    fn damaged(&self, damage: &mut Damage) -> Inside {
        damage.chunks += u64::from(!self.is_cut);
        Inside::End
    }

    fn end(&self, damage: &mut Damage) -> Inside {
        let found = self.records.sum.clone().finalize();
        damage.sums += u64::from(!self.is_cut && self.sum != 0 && found != self.sum);
        Inside::End
    }
}

/// Counts what was read.
struct Counting<R> {
    source: R,
    count: u64,
}

impl<R: Read> Read for Counting<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        self.count += read as u64;
        Ok(read)
    }
}

/// Has the checksum of what was read.
struct Summing<R> {
    source: R,
    sum: crc32fast::Hasher,
}

impl<R: Read> Read for Summing<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        self.sum.update(&buffer[..read]);
        Ok(read)
    }
}
