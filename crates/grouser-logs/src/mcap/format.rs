//! What the writer and the reader of MCAP share: how a file begins and ends, and each kind of
//! record, declared once.

use std::io::{self, Read};

/// How a file begins and ends.
pub(crate) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";

/// How the records of a chunk are packed, by the names that chunks have for it.
pub(crate) mod compression {
    pub(crate) const NONE: &str = "";
    pub(crate) const ZSTD: &str = "zstd";
    pub(crate) const LZ4: &str = "lz4";
}

/// The first bytes of every record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Head {
    /// What kind of record it is.
    pub(crate) opcode: u8,
    /// Bytes of the content.
    pub(crate) length: u64,
}

impl Head {
    /// Size of a head [bytes].
    pub(crate) const SIZE: usize = 9;

    /// Reads the head of the next record; nothing where the source ends before.
    pub(crate) fn read(source: &mut impl Read) -> io::Result<Option<Self>> {
        let mut bytes = [0; Self::SIZE];
        match source.read_exact(&mut bytes) {
            Ok(()) => Ok(Self::take(&mut &bytes[..])),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(None),
            Err(error) => Err(error),
        }
    }
}

/// A part of a record's content.
pub(crate) trait Part: Sized {
    fn put(&self, out: &mut Vec<u8>);

    /// Takes it from the start of what is left of a content; nothing where that ends before.
    fn take(content: &mut &[u8]) -> Option<Self>;
}

/// A kind of record.
pub(crate) trait Record: Part {
    const OPCODE: u8;

    /// The whole record.
    fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes_with(&[])
    }

    /// The whole record, with bytes behind its fields.
    fn to_bytes_with(&self, rest: &[u8]) -> Vec<u8> {
        let mut out = vec![0; Head::SIZE];
        self.put(&mut out);
        out.extend_from_slice(rest);
        let length = (out.len() - Head::SIZE) as u64;
        let mut head = Vec::with_capacity(Head::SIZE);
        Head { opcode: Self::OPCODE, length }.put(&mut head);
        out[..Head::SIZE].copy_from_slice(&head);
        out
    }
}

/// Declares parts: each field with its type, in the order of the bytes; and records, which have an
/// opcode.
macro_rules! parts {
    ($($name:ident { $($field:ident),* })*) => {$(
        impl Part for $name {
            fn put(&self, out: &mut Vec<u8>) {
                $(self.$field.put(out);)*
            }

            fn take(content: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Part::take(content)?),* })
            }
        }
    )*};
}

macro_rules! records {
    ($($(#[$doc:meta])* $opcode:literal $name:ident { $($field:ident: $kind:ty),* $(,)? })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub(crate) struct $name {
            $(pub(crate) $field: $kind,)*
        }

        parts! { $name { $($field),* } }

        impl Record for $name {
            const OPCODE: u8 = $opcode;
        }
    )*};
}

parts! { Head { opcode, length } }

// Times are in ns; places are in the file, unless they are of messages in a chunk.
records! {
    /// The first record of a file, with what wrote it.
    1 Header { profile: String, library: String }

    /// The last record: places of the summary and of the offsets of its groups, and the checksum
    /// from the start of the summary up to that field.
    2 Footer { summary: u64, offsets: u64, sum: u32 }

    /// What the messages of a channel are; the encoding is that of the data. No schema has the
    /// number 0.
    3 Schema { id: u16, name: String, encoding: String, data: Vec<u8> }

    /// A topic's channel; the encoding is that of its messages: `json`, `protobuf`, `cdr`, …
    4 Channel {
        id: u16, schema: u16, topic: String, encoding: String, metadata: Vec<(String, String)>,
    }

    /// A message, recorded and sent at two times; its data follow.
    5 Message { channel: u16, sequence: u32, log_time: u64, publish_time: u64 }

    /// Records, with the least and the largest time of their messages, their size and checksum (or
    /// 0) before they are packed, and their size as they are stored; they follow.
    6 Chunk { first: u64, last: u64, size: u64, sum: u32, compression: String, stored: u64 }

    /// Times and places of a channel's messages in the chunk before.
    7 MessageIndex { channel: u16, entries: Vec<(u64, u64)> }

    /// Where a chunk is, and where the indexes of its messages are, by channels.
    8 ChunkIndex {
        first: u64, last: u64, start: u64, length: u64, indexes: Vec<(u16, u64)>, index_length: u64,
        compression: String, stored: u64, size: u64,
    }

    /// A file within the file; its data and a checksum follow.
    9 Attachment { log_time: u64, create_time: u64, name: String, media_type: String, size: u64 }

    /// Where a file within the file is.
    10 AttachmentIndex {
        start: u64, length: u64, log_time: u64, create_time: u64, size: u64, name: String,
        media_type: String,
    }

    /// What a file has, and how many messages each channel has.
    11 Statistics {
        messages: u64, schemas: u16, channels: u32, attachments: u32, metadata: u32, chunks: u32,
        first: u64, last: u64, counts: Vec<(u16, u64)>,
    }

    /// Names and values beside the messages.
    12 Metadata { name: String, entries: Vec<(String, String)> }

    /// Where such names and values are.
    13 MetadataIndex { start: u64, length: u64, name: String }

    /// Where the records of one kind are in the summary.
    14 SummaryOffset { opcode: u8, start: u64, length: u64 }

    /// The end of all data, with a checksum of it, or 0.
    15 DataEnd { sum: u32 }
}

impl Message {
    /// Bytes of its fields.
    pub(crate) const SIZE: usize = 22;
}

impl Footer {
    /// Bytes of its fields.
    pub(crate) const SIZE: usize = 20;
}

/// Whole numbers, the least byte first.
macro_rules! numbers {
    ($($kind:ty),*) => {$(
        impl Part for $kind {
            fn put(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn take(content: &mut &[u8]) -> Option<Self> {
                let (bytes, rest) = content.split_first_chunk()?;
                *content = rest;
                Some(Self::from_le_bytes(*bytes))
            }
        }
    )*};
}

numbers!(u8, u16, u32, u64);

/// Writes bytes with their count before them, which is far below four billion.
fn put_counted(bytes: &[u8], out: &mut Vec<u8>) {
    u32::try_from(bytes.len()).unwrap_or(u32::MAX).put(out);
    out.extend_from_slice(bytes);
}

fn take_counted<'a>(content: &mut &'a [u8]) -> Option<&'a [u8]> {
    let count = usize::try_from(u32::take(content)?).ok()?;
    let (bytes, rest) = content.split_at_checked(count)?;
    *content = rest;
    Some(bytes)
}

impl Part for Vec<u8> {
    fn put(&self, out: &mut Vec<u8>) {
        put_counted(self, out);
    }

    fn take(content: &mut &[u8]) -> Option<Self> {
        take_counted(content).map(<[u8]>::to_vec)
    }
}

impl Part for String {
    fn put(&self, out: &mut Vec<u8>) {
        put_counted(self.as_bytes(), out);
    }

    fn take(content: &mut &[u8]) -> Option<Self> {
        take_counted(content).map(|bytes| Self::from_utf8_lossy(bytes).into_owned())
    }
}

/// Pairs, with the count of their bytes before them. Pairs that are damaged are left out: no
/// message needs them.
impl<A: Part, B: Part> Part for Vec<(A, B)> {
    fn put(&self, out: &mut Vec<u8>) {
        let mut inner = Vec::new();
        for (one, other) in self {
            one.put(&mut inner);
            other.put(&mut inner);
        }
        put_counted(&inner, out);
    }

    fn take(content: &mut &[u8]) -> Option<Self> {
        let mut inner = take_counted(content).unwrap_or_default();
        let mut pair = || A::take(&mut inner).zip(B::take(&mut inner));
        Some(std::iter::from_fn(&mut pair).collect())
    }
}
