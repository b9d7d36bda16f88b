//! Writes MCAP logs as recorders of others do: with or without compression, and with or without an end.

/// How a chunk is stored.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Packed {
    Not,
    Zstd,
    Lz4,
}

/// A log on its way.
pub(crate) struct Container {
    bytes: Vec<u8>,
    chunk: Vec<u8>,
    packed: Packed,
    channels: u16,
}

fn text(text: &str) -> Vec<u8> {
    counted(text.as_bytes())
}

fn counted(bytes: &[u8]) -> Vec<u8> {
    let count = u32::try_from(bytes.len()).unwrap();
    [&count.to_le_bytes(), bytes].concat()
}

pub(crate) fn record(kind: u8, content: &[u8]) -> Vec<u8> {
    [&[kind], &(content.len() as u64).to_le_bytes()[..], content].concat()
}

impl Container {
    pub(crate) fn begin(packed: Packed) -> Self {
        let mut bytes = b"\x89MCAP0\r\n".to_vec();
        bytes.extend(record(1, &[text("ros2"), text("a test")].concat()));
        Self { bytes, chunk: Vec::new(), packed, channels: 0 }
    }

    /// A channel of messages in JSON, by its number.
    pub(crate) fn channel(&mut self, topic: &str, message: &str) -> u16 {
        self.channel_of(topic, message, "json", &[])
    }

    pub(crate) fn channel_of(
        &mut self,
        topic: &str,
        message: &str,
        encoding: &str,
        schema: &[u8],
    ) -> u16 {
        let id = self.channels + 1;
        self.channels = id;
        let number = id.to_le_bytes();
        let schema = [&number[..], &text(message), &text("jsonschema"), &counted(schema)].concat();
        let channel = [&number[..], &number, &text(topic), &text(encoding), &counted(&[])].concat();
        self.chunk.extend(record(3, &schema));
        self.chunk.extend(record(4, &channel));
        id
    }

    /// * `time`: [ns]
    pub(crate) fn message(&mut self, channel: u16, time: u64, data: &[u8]) {
        let times = [time.to_le_bytes(), time.to_le_bytes()].concat();
        let content = [&channel.to_le_bytes()[..], &[0; 4], &times, data].concat();
        self.chunk.extend(record(5, &content));
    }

    pub(crate) fn end_chunk(&mut self) {
        let chunk = std::mem::take(&mut self.chunk);
        let (name, stored) = match self.packed {
            Packed::Not => ("", chunk.clone()),
            Packed::Zstd => {
                let level = ruzstd::encoding::CompressionLevel::Fastest;
                ("zstd", ruzstd::encoding::compress_to_vec(&chunk[..], level))
            }
            Packed::Lz4 => {
                let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
                std::io::Write::write_all(&mut encoder, &chunk).unwrap();
                ("lz4", encoder.finish().unwrap())
            }
        };
        let content = [
            &[0; 16][..],
            &(chunk.len() as u64).to_le_bytes(),
            &crc32fast::hash(&chunk).to_le_bytes(),
            &text(name),
            &(stored.len() as u64).to_le_bytes(),
            &stored,
        ];
        self.bytes.extend(record(6, &content.concat()));
    }

    /// The log as it is before its recorder ends it.
    pub(crate) fn cut(mut self) -> Vec<u8> {
        self.end_chunk();
        self.bytes
    }

    /// The log with its end, and no index.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.end_chunk();
        self.bytes.extend(record(15, &[0; 4]));
        self.bytes.extend(record(2, &[0; 20]));
        self.bytes.extend(b"\x89MCAP0\r\n");
        self.bytes
    }
}
