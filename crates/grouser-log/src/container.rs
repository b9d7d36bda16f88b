//! The container MCAP: records of messages in chunks, with an index at the end.
//!
//! Chunks are not compressed: the format's compressions would each bring a library, and a log is small beside the
//! recordings for which the format is made. All positions are counted, never sought, so that anything that takes bytes
//! can be written to. Source: "MCAP Format Specification", version 0, mcap.dev/spec.

use std::io::{self, Write};

/// How a file begins and ends.
const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
/// From how many bytes on a chunk is written: all that is kept in memory beside the index. Source: ours, as many
/// as readers fetch at a time.
const CHUNK: usize = 1 << 20;

/// Kinds of records, by their codes.
mod kind {
    pub(super) const HEADER: u8 = 1;
    pub(super) const FOOTER: u8 = 2;
    pub(super) const SCHEMA: u8 = 3;
    pub(super) const CHANNEL: u8 = 4;
    pub(super) const MESSAGE: u8 = 5;
    pub(super) const CHUNK: u8 = 6;
    pub(super) const MESSAGE_INDEX: u8 = 7;
    pub(super) const CHUNK_INDEX: u8 = 8;
    pub(super) const ATTACHMENT: u8 = 9;
    pub(super) const ATTACHMENT_INDEX: u8 = 10;
    pub(super) const STATISTICS: u8 = 11;
    pub(super) const METADATA: u8 = 12;
    pub(super) const METADATA_INDEX: u8 = 13;
    pub(super) const SUMMARY_OFFSET: u8 = 14;
    pub(super) const DATA_END: u8 = 15;
}

/// The content of a record.
#[derive(Clone, Debug, Default)]
struct Content(Vec<u8>);

impl Content {
    fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    fn u8(self, value: u8) -> Self {
        self.bytes(&[value])
    }

    fn u16(self, value: u16) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    fn u32(self, value: u32) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    fn u64(self, value: u64) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    /// Bytes with their count before them.
    fn counted(self, bytes: &[u8]) -> Self {
        self.u32(short(bytes.len())).bytes(bytes)
    }

    fn text(self, text: &str) -> Self {
        self.counted(text.as_bytes())
    }

    fn map(self, entries: &[(String, String)]) -> Self {
        let inner =
            entries.iter().fold(Self::default(), |all, (key, value)| all.text(key).text(value));
        self.counted(&inner.0)
    }

    /// The whole record.
    fn record(self, kind: u8) -> Vec<u8> {
        Self::default().u8(kind).u64(self.0.len() as u64).bytes(&self.0).0
    }
}

/// A count of what one record holds, which is far below four billion.
fn short(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

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
    /// Of the messages: `protobuf` or `cdr`.
    pub(crate) messages: &'a str,
}

/// A channel, and how much was written to it.
#[derive(Debug)]
struct Channel {
    record: Vec<u8>,
    messages: u64,
    /// Times and places of its messages in the chunk.
    index: Vec<(u64, u64)>,
}

/// The least and the largest time of some messages, in nanoseconds.
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
    schemas: Vec<(String, Vec<u8>)>,
    channels: Vec<Channel>,
    chunk: Vec<u8>,
    chunk_span: Span,
    span: Span,
    chunk_indexes: Vec<Vec<u8>>,
    attachment_indexes: Vec<Vec<u8>>,
    metadata_indexes: Vec<Vec<u8>>,
}

impl<W: Write> Container<W> {
    /// * `library`: what writes it
    pub(crate) fn begin(out: W, library: &str) -> io::Result<Self> {
        let mut container = Self {
            out,
            written: 0,
            schemas: Vec::new(),
            channels: Vec::new(),
            chunk: Vec::new(),
            chunk_span: Span::default(),
            span: Span::default(),
            chunk_indexes: Vec::new(),
            attachment_indexes: Vec::new(),
            metadata_indexes: Vec::new(),
        };
        container.write(&MAGIC)?;
        container.write(&Content::default().text("").text(library).record(kind::HEADER))?;
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
        let known = self.schemas.iter().position(|(name, _)| name == schema.name);
        let place = known.unwrap_or(self.schemas.len());
        // No schema has the number 0.
        let schema_id = id(place + 1);
        if known.is_none() {
            let record = Content::default()
                .u16(schema_id)
                .text(schema.name)
                .text(schema.encoding)
                .counted(&schema.data)
                .record(kind::SCHEMA);
            self.chunk.extend_from_slice(&record);
            self.schemas.push((schema.name.to_owned(), record));
        }
        let channel_id = id(self.channels.len());
        let record = Content::default()
            .u16(channel_id)
            .u16(schema_id)
            .text(topic)
            .text(schema.messages)
            .map(about)
            .record(kind::CHANNEL);
        self.chunk.extend_from_slice(&record);
        self.channels.push(Channel { record, messages: 0, index: Vec::new() });
        ChannelId(channel_id)
    }

    /// * `time`: since the start of the run, in nanoseconds
    pub(crate) fn message(&mut self, to: ChannelId, time: u64, data: &[u8]) -> io::Result<()> {
        let channel = &mut self.channels[usize::from(to.0)];
        let sequence = u32::try_from(channel.messages & u64::from(u32::MAX)).unwrap_or(0);
        channel.messages += 1;
        channel.index.push((time, self.chunk.len() as u64));
        let content = Content::default().u16(to.0).u32(sequence).u64(time).u64(time).bytes(data);
        self.chunk.extend_from_slice(&content.record(kind::MESSAGE));
        self.chunk_span.add(time);
        self.span.add(time);
        if self.chunk.len() >= CHUNK { self.end_chunk() } else { Ok(()) }
    }

    /// A file within the file.
    pub(crate) fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> io::Result<()> {
        self.end_chunk()?;
        // Neither time is known: nothing here depends on a clock.
        let content = Content::default().u64(0).u64(0).text(name).text(media_type);
        let content = content.u64(data.len() as u64).bytes(data);
        let sum = crc32fast::hash(&content.0);
        let (place, record) = (self.written, content.u32(sum).record(kind::ATTACHMENT));
        self.write(&record)?;
        let index = Content::default().u64(place).u64(record.len() as u64).u64(0).u64(0);
        let index = index.u64(data.len() as u64).text(name).text(media_type);
        self.attachment_indexes.push(index.record(kind::ATTACHMENT_INDEX));
        Ok(())
    }

    /// Names and values beside the messages.
    pub(crate) fn metadata(&mut self, name: &str, entries: &[(String, String)]) -> io::Result<()> {
        self.end_chunk()?;
        let record = Content::default().text(name).map(entries).record(kind::METADATA);
        let index = Content::default().u64(self.written).u64(record.len() as u64).text(name);
        self.write(&record)?;
        self.metadata_indexes.push(index.record(kind::METADATA_INDEX));
        Ok(())
    }

    /// Writes the rest and the index.
    pub(crate) fn finish(mut self) -> io::Result<W> {
        self.end_chunk()?;
        self.write(&Content::default().u32(0).record(kind::DATA_END))?;
        let groups = [
            (kind::SCHEMA, self.schemas.iter().flat_map(|it| it.1.clone()).collect()),
            (kind::CHANNEL, self.channels.iter().flat_map(|it| it.record.clone()).collect()),
            (kind::STATISTICS, self.statistics()),
            (kind::CHUNK_INDEX, self.chunk_indexes.concat()),
            (kind::ATTACHMENT_INDEX, self.attachment_indexes.concat()),
            (kind::METADATA_INDEX, self.metadata_indexes.concat()),
        ];
        let start = self.written;
        let (mut summary, mut offsets) = (Vec::new(), Vec::new());
        for (kind, records) in
            groups.iter().filter(|(_, records): &&(u8, Vec<u8>)| !records.is_empty())
        {
            let offset = Content::default().u8(*kind).u64(start + summary.len() as u64);
            offsets.extend(offset.u64(records.len() as u64).record(kind::SUMMARY_OFFSET));
            summary.extend_from_slice(records);
        }
        let offsets_start = start + summary.len() as u64;
        summary.extend(offsets);
        // The sum is of all down to the footer's last number but one, with the head of its record.
        let footer = Content::default().u64(start).u64(offsets_start);
        const SIZE: u64 = 20;
        let head = Content::default().u8(kind::FOOTER).u64(SIZE).bytes(&footer.0);
        summary.extend_from_slice(&head.0);
        let sum = crc32fast::hash(&summary);
        self.write(&summary)?;
        self.write(&sum.to_le_bytes())?;
        self.write(&MAGIC)?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn statistics(&self) -> Vec<u8> {
        let (first, last) = self.span.ends();
        let counts = (0_u16..).zip(&self.channels).filter(|(_, channel)| channel.messages > 0);
        let counts =
            counts.fold(Content::default(), |all, (id, channel)| all.u16(id).u64(channel.messages));
        Content::default()
            .u64(self.channels.iter().map(|channel| channel.messages).sum())
            .u16(id(self.schemas.len()))
            .u32(short(self.channels.len()))
            .u32(short(self.attachment_indexes.len()))
            .u32(short(self.metadata_indexes.len()))
            .u32(short(self.chunk_indexes.len()))
            .u64(first)
            .u64(last)
            .counted(&counts.0)
            .record(kind::STATISTICS)
    }

    /// Writes the chunk, if there is something in it, with the index of its messages.
    fn end_chunk(&mut self) -> io::Result<()> {
        if self.chunk.is_empty() {
            return Ok(());
        }
        let chunk = std::mem::take(&mut self.chunk);
        let (first, last) = std::mem::take(&mut self.chunk_span).ends();
        let (start, size) = (self.written, chunk.len() as u64);
        let record = Content::default()
            .u64(first)
            .u64(last)
            .u64(size)
            .u32(crc32fast::hash(&chunk))
            .text("")
            .u64(size)
            .bytes(&chunk)
            .record(kind::CHUNK);
        self.write(&record)?;
        let after = self.written;
        let mut places = Content::default();
        for place in 0..self.channels.len() {
            let index = std::mem::take(&mut self.channels[place].index);
            if index.is_empty() {
                continue;
            }
            places = places.u16(id(place)).u64(self.written);
            let entries =
                index.iter().fold(Content::default(), |all, (time, at)| all.u64(*time).u64(*at));
            let index = Content::default().u16(id(place)).counted(&entries.0);
            self.write(&index.record(kind::MESSAGE_INDEX))?;
        }
        let index = Content::default()
            .u64(first)
            .u64(last)
            .u64(start)
            .u64(record.len() as u64)
            .counted(&places.0)
            .u64(self.written - after)
            .text("")
            .u64(size)
            .u64(size)
            .record(kind::CHUNK_INDEX);
        self.chunk_indexes.push(index);
        Ok(())
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.written += bytes.len() as u64;
        self.out.write_all(bytes)
    }
}

/// The number of a channel or schema: rovers have a few wheels.
fn id(place: usize) -> u16 {
    u16::try_from(place).unwrap_or(u16::MAX)
}
