//! A reader of MCAP, for tests: every sum is checked, and messages are found by the index too.

use std::collections::BTreeMap;

use super::super::format::{
    Channel, Chunk, ChunkIndex, Footer, Head, MAGIC, Message as Fields, MessageIndex, Part as _,
    Record, Schema, Statistics,
};

/// A message.
#[derive(Clone, Debug)]
pub(crate) struct Message {
    pub(crate) topic: String,
    pub(crate) time: u64,
    pub(crate) data: Vec<u8>,
}

/// The index at the end of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Summary {
    pub(crate) statistics: Statistics,
    pub(crate) channels: Vec<Channel>,
    pub(crate) chunks: Vec<ChunkIndex>,
}

fn place(count: u64) -> usize {
    usize::try_from(count).expect("a count")
}

/// A record of a known kind, from its fields.
fn whole<R: Record>(mut content: &[u8]) -> R {
    let record = R::take(&mut content).expect("its fields");
    assert!(content.is_empty());
    record
}

/// The opcode and the content of the record at the start of some bytes.
fn first<'a>(bytes: &mut &'a [u8]) -> (u8, &'a [u8]) {
    let head = Head::take(bytes).expect("a record");
    let (content, rest) = bytes.split_at(place(head.length));
    *bytes = rest;
    (head.opcode, content)
}

fn all(mut bytes: &[u8]) -> Vec<(u8, &[u8])> {
    let mut records = Vec::new();
    while !bytes.is_empty() {
        records.push(first(&mut bytes));
    }
    records
}

/// The records of a chunk, whose sum is right, and its fields.
fn chunk(mut content: &[u8]) -> (Chunk, &[u8]) {
    let chunk = Chunk::take(&mut content).expect("its fields");
    assert_eq!((chunk.compression.as_str(), chunk.stored), ("", chunk.size));
    assert_eq!((chunk.size, chunk.sum), (content.len() as u64, crc32fast::hash(content)));
    (chunk, content)
}

fn message(mut data: &[u8], channels: &[Channel]) -> Message {
    let fields = Fields::take(&mut data).expect("its fields");
    let channel = channels.iter().find(|it| it.id == fields.channel);
    let topic = channel.expect("its channel comes first").topic.clone();
    assert_eq!(fields.log_time, fields.publish_time);
    Message { topic, time: fields.log_time, data: data.into() }
}

fn within(file: &[u8]) -> &[u8] {
    let inner = file.strip_prefix(&MAGIC).and_then(|file| file.strip_suffix(&MAGIC));
    inner.expect("a file begins and ends as it must")
}

/// All messages, in the order of the file.
pub(crate) fn messages(file: &[u8]) -> Vec<Message> {
    let (mut channels, mut found): (Vec<Channel>, Vec<Message>) = (Vec::new(), Vec::new());
    for (_, content) in all(within(file)).into_iter().filter(|(opcode, _)| *opcode == Chunk::OPCODE)
    {
        let (chunk, records) = chunk(content);
        let before = found.len();
        for (opcode, content) in all(records) {
            match opcode {
                Channel::OPCODE => channels.push(whole(content)),
                Fields::OPCODE => found.push(message(content, &channels)),
                other => assert_eq!(other, Schema::OPCODE),
            }
        }
        assert!(found[before..].iter().all(|it| (chunk.first..=chunk.last).contains(&it.time)));
    }
    found
}

impl Summary {
    /// By the footer, as viewers find it.
    pub(crate) fn of(file: &[u8]) -> Self {
        let inner = within(file);
        let (_, footer) = inner.split_at(inner.len() - Head::SIZE - Footer::SIZE);
        let (opcode, content) = first(&mut &footer[..]);
        assert_eq!(opcode, Footer::OPCODE);
        let Footer { summary: start, sum, .. } = whole(content);
        let end = file.len() - MAGIC.len();
        assert_eq!(crc32fast::hash(&file[place(start)..end - size_of::<u32>()]), sum);
        let mut summary = Self::default();
        for (opcode, content) in all(&file[place(start)..end]) {
            match opcode {
                Channel::OPCODE => summary.channels.push(whole(content)),
                ChunkIndex::OPCODE => summary.chunks.push(whole(content)),
                Statistics::OPCODE => summary.statistics = whole(content),
                _ => {}
            }
        }
        assert!(summary.channels.iter().all(|it| it.schema > 0), "a channel of ours has a schema");
        summary
    }

    /// Names and values beside a channel.
    pub(crate) fn metadata(&self, topic: &str) -> BTreeMap<String, String> {
        let channel = self.channels.iter().find(|it| it.topic == topic).expect("a channel");
        channel.metadata.iter().cloned().collect()
    }

    /// A chunk's messages, by the indexes of its channels.
    pub(crate) fn messages(&self, of: &ChunkIndex, file: &[u8]) -> Vec<Message> {
        let at = |start: u64| &file[place(start)..];
        let (opcode, content) = first(&mut &at(of.start)[..place(of.length)]);
        assert_eq!(opcode, Chunk::OPCODE);
        let (_, records) = chunk(content);
        let mut found = Vec::new();
        for (channel, start) in &of.indexes {
            let (opcode, content) = first(&mut at(*start));
            assert_eq!(opcode, MessageIndex::OPCODE);
            let index: MessageIndex = whole(content);
            assert_eq!(index.channel, *channel);
            for (time, start) in index.entries {
                let (opcode, content) = first(&mut &records[place(start)..]);
                assert_eq!(opcode, Fields::OPCODE);
                assert!(content.starts_with(&channel.to_le_bytes()));
                found.push(message(content, &self.channels));
                assert!(found.last().is_some_and(|it| it.time == time));
            }
        }
        found
    }
}
