//! Writes MCAP logs as recorders of others do: with or without compression, and with or without an
//! end.

use super::format::{
    Channel, Chunk, ChunkIndex, DataEnd, Footer, Header, MAGIC, Message, Record as _, Schema,
    compression,
};

/// How a chunk is stored.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Packed {
    Not,
    Zstd,
    Lz4,
}

/// What every log begins with.
pub(crate) fn header() -> Vec<u8> {
    let header = Header { profile: "ros2".to_owned(), library: "a test".to_owned() };
    [&MAGIC[..], &header.to_bytes()].concat()
}

/// A log on its way.
pub(crate) struct Container {
    bytes: Vec<u8>,
    chunk: Vec<u8>,
    packed: Packed,
    channels: u16,
    /// Schemas and channels again, as an index has them, and where chunks are.
    described: Vec<u8>,
    places: Vec<ChunkIndex>,
    /// Times of the messages of the chunk [ns].
    times: Vec<u64>,
}

impl Container {
    pub(crate) fn begin(packed: Packed) -> Self {
        Self {
            bytes: header(),
            chunk: Vec::new(),
            packed,
            channels: 0,
            described: Vec::new(),
            places: Vec::new(),
            times: Vec::new(),
        }
    }

    /// A channel of messages in JSON, by its number.
    pub(crate) fn channel(&mut self, topic: &str, message: &str) -> u16 {
        self.channel_of(topic, message, "json", ("jsonschema", ""))
    }

    /// * `encoding`: of the messages
    /// * `described`: the encoding of their schema, and its text
    pub(crate) fn channel_of(
        &mut self,
        topic: &str,
        message: &str,
        encoding: &str,
        (described, text): (&str, &str),
    ) -> u16 {
        self.channels += 1;
        let (id, schema) = (self.channels, self.channels);
        let (name, data) = (message.to_owned(), text.into());
        let described = Schema { id, name, encoding: described.to_owned(), data };
        let (topic, encoding, metadata) = (topic.to_owned(), encoding.to_owned(), Vec::new());
        let channel = Channel { id, schema, topic, encoding, metadata };
        let described = [described.to_bytes(), channel.to_bytes()].concat();
        self.chunk.extend_from_slice(&described);
        self.described.extend(described);
        id
    }

    /// Zeros, which are empty records of no kind.
    pub(crate) fn stuff(&mut self, bytes: usize) {
        self.chunk.resize(self.chunk.len() + bytes, 0);
    }

    /// * `time`: [ns]
    pub(crate) fn message(&mut self, channel: u16, time: u64, data: &[u8]) {
        let message = Message { channel, sequence: 0, log_time: time, publish_time: time };
        self.times.push(time);
        self.chunk.extend(message.to_bytes_with(data));
    }

    pub(crate) fn end_chunk(&mut self) {
        let chunk = std::mem::take(&mut self.chunk);
        let (name, stored) = match self.packed {
            Packed::Not => (compression::NONE, chunk.clone()),
            Packed::Zstd => {
                let level = ruzstd::encoding::CompressionLevel::Fastest;
                (compression::ZSTD, ruzstd::encoding::compress_to_vec(&chunk[..], level))
            }
            Packed::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
                std::io::Write::write_all(&mut encoder, &chunk).unwrap();
                (compression::LZ4, encoder.finish().unwrap())
            }
        };
        let head = Chunk {
            size: chunk.len() as u64,
            sum: crc32fast::hash(&chunk),
            compression: name.to_owned(),
            stored: stored.len() as u64,
            ..Chunk::default()
        };
        let (start, record) = (self.bytes.len() as u64, head.to_bytes_with(&stored));
        let times = std::mem::take(&mut self.times);
        let of = |time: Option<&u64>| time.copied().unwrap_or(0);
        let (first, last) = (of(times.iter().min()), of(times.iter().max()));
        let length = record.len() as u64;
        self.places.push(ChunkIndex { first, last, start, length, ..ChunkIndex::default() });
        self.bytes.extend(record);
    }

    /// The log as it is before its recorder ends it.
    pub(crate) fn cut(mut self) -> Vec<u8> {
        self.end_chunk();
        self.bytes
    }

    /// The log with its end, and an index of schemas, channels and chunks.
    pub(crate) fn finish_with_index(mut self) -> Vec<u8> {
        self.end_chunk();
        self.bytes.extend(DataEnd::default().to_bytes());
        let summary = self.bytes.len() as u64;
        self.bytes.extend(self.described);
        self.bytes.extend(self.places.iter().flat_map(ChunkIndex::to_bytes));
        self.bytes.extend(Footer { summary, ..Footer::default() }.to_bytes());
        self.bytes.extend(MAGIC);
        self.bytes
    }

    /// The log with its end, and no index.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.end_chunk();
        self.bytes.extend(DataEnd::default().to_bytes());
        self.bytes.extend(Footer::default().to_bytes());
        self.bytes.extend(MAGIC);
        self.bytes
    }
}
