//! Writes the container MCAP.
//!
//! Chunks are not compressed: a log is small beside the recordings for which the format is made.
//! All positions are counted, never sought, so that anything that takes bytes can be written to.

use std::io::{self, Write};
use std::mem;

use crate::mcap::format::{
    Attachment, AttachmentIndex, Channel, Chunk, ChunkIndex, DataEnd, Footer, Header, MAGIC,
    Message, MessageIndex, Metadata, MetadataIndex, Part as _, Record, Schema, Statistics,
    SummaryOffset, compression,
};

/// From how many bytes on a chunk is written: all that is kept in memory beside the index. Source:
/// ours, as many as readers fetch at a time.
const CHUNK: usize = 1 << 20;

/// A channel by its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ChannelId(u16);

/// What a channel's messages are.
#[derive(Clone, Debug)]
pub(crate) struct SchemaOf<'a> {
    pub(crate) name: &'a str,
    /// `protobuf` or `ros2msg`.
    pub(crate) encoding: &'a str,
    pub(crate) data: Vec<u8>,
    /// Encoding of the messages: `protobuf` or `cdr`.
    pub(crate) messages: &'a str,
}

/// The least and the largest time of some messages [ns].
#[derive(Clone, Copy, Debug, Default)]
struct Span(Option<(u64, u64)>);

impl Span {
    fn add(&mut self, time: u64) {
        let (first, last) = self.0.unwrap_or((time, time));
        self.0 = Some((first.min(time), last.max(time)));
    }

    fn ends(self) -> (u64, u64) {
        self.0.unwrap_or((0, 0))
    }
}

/// A file on its way.
#[derive(Debug)]
pub(crate) struct Container<W> {
    out: W,
    /// How many bytes were written.
    written: u64,
    schemas: Vec<Schema>,
    channels: Vec<Channel>,
    /// Messages of each channel, over all chunks.
    counts: Vec<u64>,
    /// Times and places of each channel's messages in the chunk.
    places: Vec<Vec<(u64, u64)>>,
    chunk: Vec<u8>,
    chunk_span: Span,
    span: Span,
    chunk_indexes: Vec<ChunkIndex>,
    attachment_indexes: Vec<AttachmentIndex>,
    metadata_indexes: Vec<MetadataIndex>,
}

impl<W: Write> Container<W> {
    /// * `library`: what writes it
    pub(crate) fn begin(out: W, library: &str) -> io::Result<Self> {
        let mut container = Self {
            out,
            written: 0,
            schemas: Vec::new(),
            channels: Vec::new(),
            counts: Vec::new(),
            places: Vec::new(),
            chunk: Vec::new(),
            chunk_span: Span::default(),
            span: Span::default(),
            chunk_indexes: Vec::new(),
            attachment_indexes: Vec::new(),
            metadata_indexes: Vec::new(),
        };
        container.write(&MAGIC)?;
        let header = Header { profile: String::new(), library: library.to_owned() };
        container.write(&header.to_bytes())?;
        Ok(container)
    }

    /// A new channel; channels of the same schema share it.
    ///
    /// * `about`: what is known of the channel
    pub(crate) fn channel(
        &mut self,
        topic: &str,
        schema: &SchemaOf<'_>,
        about: &[(String, String)],
    ) -> ChannelId {
        let known = self.schemas.iter().position(|known| known.name == schema.name);
        let place = known.unwrap_or_else(|| {
            let new = Schema {
                // No schema has the number 0.
                id: id(self.schemas.len() + 1),
                name: schema.name.to_owned(),
                encoding: schema.encoding.to_owned(),
                data: schema.data.clone(),
            };
            self.chunk.extend_from_slice(&new.to_bytes());
            self.schemas.push(new);
            self.schemas.len() - 1
        });
        let channel = Channel {
            id: id(self.channels.len()),
            schema: self.schemas[place].id,
            topic: topic.to_owned(),
            encoding: schema.messages.to_owned(),
            metadata: about.to_vec(),
        };
        let to = ChannelId(channel.id);
        self.chunk.extend_from_slice(&channel.to_bytes());
        self.channels.push(channel);
        self.counts.push(0);
        self.places.push(Vec::new());
        to
    }

    /// * `time`: since the start of the run [ns]
    pub(crate) fn message(&mut self, to: ChannelId, time: u64, data: &[u8]) -> io::Result<()> {
        let place = usize::from(to.0);
        let sequence = u32::try_from(self.counts[place] & u64::from(u32::MAX)).unwrap_or(0);
        self.counts[place] += 1;
        self.places[place].push((time, self.chunk.len() as u64));
        let message = Message { channel: to.0, sequence, log_time: time, publish_time: time };
        self.chunk.extend_from_slice(&message.to_bytes_with(data));
        self.chunk_span.add(time);
        self.span.add(time);
        if self.chunk.len() >= CHUNK { self.end_chunk() } else { Ok(()) }
    }

    /// A file within the file.
    pub(crate) fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> io::Result<()> {
        self.end_chunk()?;
        let (size, name, media_type) = (data.len() as u64, name.to_owned(), media_type.to_owned());
        // Neither time is known: nothing here depends on a clock.
        let (log_time, create_time) = (0, 0);
        let about = Attachment {
            log_time,
            create_time,
            name: name.clone(),
            media_type: media_type.clone(),
            size,
        };
        let mut summed = Vec::new();
        about.put(&mut summed);
        summed.extend_from_slice(data);
        let sum = crc32fast::hash(&summed).to_le_bytes();
        let (start, record) = (self.written, about.to_bytes_with(&[data, &sum].concat()));
        self.write(&record)?;
        let length = record.len() as u64;
        let index =
            AttachmentIndex { start, length, log_time, create_time, size, name, media_type };
        self.attachment_indexes.push(index);
        Ok(())
    }

    /// Names and values beside the messages.
    pub(crate) fn metadata(&mut self, name: &str, entries: &[(String, String)]) -> io::Result<()> {
        self.end_chunk()?;
        let record = Metadata { name: name.to_owned(), entries: entries.to_vec() }.to_bytes();
        let (start, length) = (self.written, record.len() as u64);
        self.write(&record)?;
        self.metadata_indexes.push(MetadataIndex { start, length, name: name.to_owned() });
        Ok(())
    }

    /// Writes the rest and the index.
    pub(crate) fn finish(mut self) -> io::Result<W> {
        self.end_chunk()?;
        self.write(&DataEnd { sum: 0 }.to_bytes())?;
        let groups = [
            group(&self.schemas),
            group(&self.channels),
            group(&[self.statistics()]),
            group(&self.chunk_indexes),
            group(&self.attachment_indexes),
            group(&self.metadata_indexes),
        ];
        let start = self.written;
        let (mut summary, mut offsets) = (Vec::new(), Vec::new());
        for (opcode, records) in groups.iter().filter(|(_, records)| !records.is_empty()) {
            let (start, length) = (start + summary.len() as u64, records.len() as u64);
            offsets.extend(SummaryOffset { opcode: *opcode, start, length }.to_bytes());
            summary.extend_from_slice(records);
        }
        let footer = Footer { summary: start, offsets: start + summary.len() as u64, sum: 0 };
        summary.extend(offsets);
        summary.extend(footer.to_bytes());
        // The sum is of all down to the footer's last number but one, with the head of its record.
        summary.truncate(summary.len() - size_of::<u32>());
        let sum = crc32fast::hash(&summary);
        self.write(&summary)?;
        self.write(&sum.to_le_bytes())?;
        self.write(&MAGIC)?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn statistics(&self) -> Statistics {
        let (first, last) = self.span.ends();
        let counts = (0..).zip(self.counts.iter().copied());
        Statistics {
            messages: self.counts.iter().sum(),
            schemas: id(self.schemas.len()),
            channels: short(self.channels.len()),
            attachments: short(self.attachment_indexes.len()),
            metadata: short(self.metadata_indexes.len()),
            chunks: short(self.chunk_indexes.len()),
            first,
            last,
            counts: counts.filter(|(_, count)| *count > 0).collect(),
        }
    }

    /// Writes the chunk, if there is something in it, with the index of its messages.
    fn end_chunk(&mut self) -> io::Result<()> {
        if self.chunk.is_empty() {
            return Ok(());
        }
        let records = mem::take(&mut self.chunk);
        let (first, last) = mem::take(&mut self.chunk_span).ends();
        let (start, size, stored) = (self.written, records.len() as u64, records.len() as u64);
        let (sum, compression) = (crc32fast::hash(&records), compression::NONE.to_owned());
        let chunk = Chunk { first, last, size, sum, compression, stored };
        let record = chunk.to_bytes_with(&records);
        self.write(&record)?;
        let after = self.written;
        let mut indexes = Vec::new();
        for place in 0..self.channels.len() {
            let entries = mem::take(&mut self.places[place]);
            if entries.is_empty() {
                continue;
            }
            let channel = id(place);
            indexes.push((channel, self.written));
            self.write(&MessageIndex { channel, entries }.to_bytes())?;
        }
        self.chunk_indexes.push(ChunkIndex {
            first,
            last,
            start,
            length: record.len() as u64,
            indexes,
            index_length: self.written - after,
            compression: chunk.compression,
            stored,
            size,
        });
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.written += bytes.len() as u64;
        self.out.write_all(bytes)
    }
}

/// Records of one kind, one after the other, with their opcode.
fn group<R: Record>(records: &[R]) -> (u8, Vec<u8>) {
    (R::OPCODE, records.iter().flat_map(Record::to_bytes).collect())
}

/// A count of what one record holds, which is far below four billion.
fn short(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// The number of a channel or schema: rovers have a few wheels.
fn id(place: usize) -> u16 {
    u16::try_from(place).unwrap_or(u16::MAX)
}
