//! The container MCAP, read from its start to its end: messages of channels, in chunks that may be compressed.
//!
//! Nothing is sought in the index at the end, so that a log whose recorder lost its power is read as far as it was
//! written. What is damaged is passed over and counted. Sizes that a file states are believed only within limits, and
//! no more memory is taken than bytes are there. Source: "MCAP Format Specification", version 0, mcap.dev/spec.

use std::collections::HashMap;
use std::io::{self, Cursor, Read};

/// How a file begins.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
/// The largest chunk that is read, as it is stored [bytes].
const MOST_STORED: u64 = 128 << 20;
/// The largest chunk that is unpacked [bytes].
const MOST_UNPACKED: u64 = 1 << 30;
/// The largest record that is kept: a message, a schema, a channel [bytes].
const MOST_RECORD: u64 = 16 << 20;
/// So much of all schemas and channels is kept [bytes].
const MOST_KNOWN: usize = 64 << 20;

/// Kinds of records, by their codes.
pub(crate) mod kind {
    pub(crate) const FOOTER: u8 = 2;
    pub(crate) const SCHEMA: u8 = 3;
    pub(crate) const CHANNEL: u8 = 4;
    pub(crate) const MESSAGE: u8 = 5;
    pub(crate) const CHUNK: u8 = 6;
    pub(crate) const DATA_END: u8 = 15;
}

/// What messages are.
#[derive(Clone, Debug, Default)]
pub(crate) struct Schema {
    pub(crate) name: String,
    pub(crate) data: Vec<u8>,
}

/// A topic's channel.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    pub(crate) topic: String,
    pub(crate) schema: u16,
    /// Of its messages: `json`, `protobuf`, `cdr`, …
    pub(crate) encoding: String,
}

/// Schemas and channels that were met.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known {
    pub(crate) schemas: HashMap<u16, Schema>,
    pub(crate) channels: HashMap<u16, Channel>,
    size: usize,
}

impl Known {
    /// Takes in a record of a schema or a channel; whether it is one, and there is room for it. What is known already
    /// stands: recorders repeat it in every chunk.
    pub(crate) fn take(&mut self, kind: u8, content: &[u8]) -> bool {
        let Some(id) = Fields(content).u16() else { return false };
        let is_schema = kind == kind::SCHEMA;
        if is_schema && self.schemas.contains_key(&id)
            || !is_schema && self.channels.contains_key(&id)
        {
            return true;
        }
        self.size += content.len();
        if self.size > MOST_KNOWN {
            return false;
        }
        let taken = if is_schema { self.schema(content) } else { self.channel(content) };
        taken.is_some()
    }

    fn schema(&mut self, content: &[u8]) -> Option<()> {
        let mut fields = Fields(content);
        let (id, name, _encoding) = (fields.u16()?, fields.text()?, fields.text()?);
        let data = fields.counted()?.to_vec();
        self.schemas.insert(id, Schema { name, data });
        Some(())
    }

    fn channel(&mut self, content: &[u8]) -> Option<()> {
        let mut fields = Fields(content);
        let (id, schema) = (fields.u16()?, fields.u16()?);
        let (topic, encoding) = (fields.text()?, fields.text()?);
        self.channels.insert(id, Channel { topic, schema, encoding });
        Some(())
    }
}

/// The content of a record, field by field.
pub(crate) struct Fields<'a>(pub(crate) &'a [u8]);

impl<'a> Fields<'a> {
    fn bytes(&mut self, count: usize) -> Option<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(bytes)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.bytes(N)?.try_into().ok()
    }

    pub(crate) fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub(crate) fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    fn counted(&mut self) -> Option<&'a [u8]> {
        let count = usize::try_from(self.u32()?).ok()?;
        self.bytes(count)
    }

    pub(crate) fn text(&mut self) -> Option<String> {
        self.counted().map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }
}

/// A message; its data are those of the reader.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Message {
    pub(crate) channel: u16,
    /// When it was recorded [ns].
    pub(crate) log_time: u64,
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
    /// Records whose content is none.
    pub(crate) records: u64,
}

impl Damage {
    /// A sentence for each kind of damage.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let cut = self.cut_at.map(|byte| {
            format!("the log ends at byte {byte} without its end, as after a loss of power; all before is read")
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
    chunk: Option<Chunk>,
    pub(crate) known: Known,
    pub(crate) damage: Damage,
    data: Vec<u8>,
    has_ended: bool,
}

/// The first bytes of a record.
#[derive(Clone, Copy, Debug)]
struct Head {
    kind: u8,
    length: u64,
}

impl<R: Read> Messages<R> {
    /// Reads how the file begins; nothing if it is no MCAP.
    pub(crate) fn new(mut source: R) -> io::Result<Option<Self>> {
        let mut magic = Vec::new();
        (&mut source).take(MAGIC.len() as u64).read_to_end(&mut magic)?;
        if magic != MAGIC {
            return Ok(None);
        }
        let source = Counting { source, count: magic.len() as u64 };
        let (known, damage) = (Known::default(), Damage::default());
        Ok(Some(Self { source, chunk: None, known, damage, data: Vec::new(), has_ended: false }))
    }

    /// The content of the last message.
    pub(crate) fn data(&self) -> &[u8] {
        // Channel, sequence and two times come first.
        self.data.get(22..).unwrap_or_default()
    }

    /// The next message on a channel that is wanted.
    ///
    /// # Errors
    /// Only where the disk fails; all else is damage, and counted.
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
            match chunk.next(&mut self.known, &mut self.data, &mut is_wanted, &mut self.damage) {
                Inside::Message(message) => return Ok(Some(message)),
                Inside::End => self.chunk = None,
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
        let message = message_of(&self.data);
        if message.is_none() {
            self.damage.records += 1;
        }
        message.filter(|message| is_wanted(&self.known, message.channel))
    }

    /// Takes in the next record outside of chunks: a message becomes the data, a chunk the chunk.
    fn next_at_top(&mut self) -> io::Result<()> {
        self.data.clear();
        let Some(head) = head(&mut self.source)? else {
            self.cut();
            return Ok(());
        };
        match head.kind {
            kind::DATA_END | kind::FOOTER => {
                self.has_ended = true;
                return Ok(());
            }
            kind::SCHEMA | kind::CHANNEL | kind::MESSAGE if head.length <= MOST_RECORD => {}
            kind::CHUNK if head.length <= MOST_STORED => {}
            _ => {
                let is_of_interest = matches!(head.kind, kind::SCHEMA..=kind::CHUNK);
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
        if head.kind == kind::CHUNK {
            // Of a chunk that is cut off, all records that are there are read.
            match Chunk::of(content) {
                Ok(chunk) => self.chunk = Some(chunk),
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
        if head.kind == kind::MESSAGE {
            self.data = content;
        } else if !self.known.take(head.kind, &content) {
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

/// Schemas and channels of an index; nothing if it is damaged.
pub(crate) fn known_of(mut source: impl Read) -> io::Result<Option<Known>> {
    let mut known = Known::default();
    let mut content = Vec::new();
    while let Some(head) = head(&mut source)? {
        content.clear();
        let read = (&mut source).take(head.length).read_to_end(&mut content)? as u64;
        let is_known = matches!(head.kind, kind::SCHEMA | kind::CHANNEL);
        if read < head.length || (is_known && !known.take(head.kind, &content)) {
            return Ok(None);
        }
    }
    Ok(Some(known))
}

fn message_of(content: &[u8]) -> Option<Message> {
    let mut fields = Fields(content);
    let (channel, _sequence, log_time) = (fields.u16()?, fields.u32()?, fields.u64()?);
    fields.u64()?;
    Some(Message { channel, log_time })
}

/// The kind and the length of a record; nothing where the source ends before.
fn head(source: &mut impl Read) -> io::Result<Option<Head>> {
    let mut bytes = [0; 9];
    match source.read_exact(&mut bytes) {
        Ok(()) => {}
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
        Err(error) => return Err(error),
    }
    let mut fields = Fields(&bytes[1..]);
    Ok(fields.u64().map(|length| Head { kind: bytes[0], length }))
}

/// A chunk on its way.
struct Chunk {
    records: Summing<Box<dyn Read>>,
    /// As the file states it; 0 where it does not.
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
}

impl Chunk {
    fn of(content: Vec<u8>) -> Result<Self, Refused> {
        let mut fields = Fields(&content);
        let mut head = || {
            let (_first, _last) = (fields.u64()?, fields.u64()?);
            let (size, sum, compression) = (fields.u64()?, fields.u32()?, fields.text()?);
            // The length of what follows is what is there.
            fields.u64()?;
            Some((size, sum, compression, content.len() - fields.0.len()))
        };
        let (size, sum, compression, place) = head().ok_or(Refused::Damaged)?;
        if size > MOST_UNPACKED {
            return Err(Refused::TooLarge);
        }
        let mut stored = Cursor::new(content);
        stored.set_position(place as u64);
        let records: Box<dyn Read> = match compression.as_str() {
            "" => Box::new(stored),
            "zstd" => {
                let decoder = ruzstd::decoding::StreamingDecoder::new(stored);
                Box::new(decoder.map_err(|_| Refused::Damaged)?)
            }
            "lz4" => Box::new(lz4_flex::frame::FrameDecoder::new(stored)),
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
        known: &mut Known,
        data: &mut Vec<u8>,
        is_wanted: &mut impl FnMut(&Known, u16) -> bool,
        damage: &mut Damage,
    ) -> Inside {
        loop {
            let Ok(head) = head(&mut self.records) else { return self.damaged(damage) };
            let Some(Head { kind, length }) = head else { return self.end(damage) };
            data.clear();
            let is_kept = matches!(kind, kind::SCHEMA | kind::CHANNEL | kind::MESSAGE);
            let mut record = (&mut self.records).take(length);
            if is_kept && length > MOST_RECORD {
                damage.too_large += 1;
            }
            let read = if is_kept && length <= MOST_RECORD {
                record.read_to_end(data).map(|count| count as u64)
            } else {
                io::copy(&mut record, &mut io::sink())
            };
            if read.ok() != Some(length) {
                return self.damaged(damage);
            }
            if !is_kept || length > MOST_RECORD {
                continue;
            }
            if kind != kind::MESSAGE {
                damage.records += u64::from(!known.take(kind, data));
                continue;
            }
            match message_of(data) {
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
