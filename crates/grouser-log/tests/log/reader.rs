//! A reader of MCAP, for tests: record by record, with every sum checked, and by the index at the end. Source: "MCAP
//! Format Specification", version 0, mcap.dev/spec.

use std::collections::BTreeMap;

/// A message.
#[derive(Clone, Debug)]
pub(crate) struct Message {
    pub(crate) topic: String,
    pub(crate) time: u64,
    pub(crate) data: Vec<u8>,
}

#[derive(Clone, Debug)]
pub(crate) struct Channel {
    id: u16,
    pub(crate) topic: String,
    pub(crate) metadata: BTreeMap<String, String>,
}

/// What the index says of a chunk.
#[derive(Clone, Debug)]
pub(crate) struct ChunkIndex {
    pub(crate) times: [u64; 2],
    start: u64,
    size: u64,
    /// Places of the indexes of its messages.
    indexes: Vec<u64>,
}

/// The index at the end of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Summary {
    pub(crate) messages: u64,
    pub(crate) times: [u64; 2],
    pub(crate) channels: Vec<Channel>,
    pub(crate) chunks: Vec<ChunkIndex>,
}

const MAGIC: &[u8] = b"\x89MCAP0\r\n";

/// Bytes that are read one after the other.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: u64) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(usize::try_from(count).expect("a count"));
        self.0 = rest;
        taken
    }

    fn whole(&mut self, size: u64) -> u64 {
        self.take(size).iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
    }

    fn counted(&mut self) -> Bytes<'a> {
        let count = self.whole(4);
        Bytes(self.take(count))
    }

    fn text(&mut self) -> String {
        String::from_utf8(self.counted().0.into()).expect("a text")
    }

    fn id(&mut self) -> u16 {
        u16::try_from(self.whole(2)).expect("a number")
    }

    /// The next record's kind and content.
    fn record(&mut self) -> Option<(u64, Bytes<'a>)> {
        if self.0.is_empty() {
            return None;
        }
        let kind = self.whole(1);
        let size = self.whole(8);
        Some((kind, Bytes(self.take(size))))
    }

    fn channel(mut self) -> Channel {
        let id = self.id();
        assert!(self.id() > 0, "a channel of ours has a schema");
        let (topic, _) = (self.text(), self.text());
        let mut entries = self.counted();
        let mut metadata = BTreeMap::new();
        while !entries.0.is_empty() {
            let key = entries.text();
            assert!(metadata.insert(key, entries.text()).is_none(), "each key once");
        }
        Channel { id, topic, metadata }
    }

    fn message(mut self, channels: &[Channel]) -> Message {
        let id = self.id();
        let channel = channels.iter().find(|it| it.id == id).expect("its channel comes first");
        let [_, time, published] = [4, 8, 8].map(|size| self.whole(size));
        assert_eq!(time, published);
        Message { topic: channel.topic.clone(), time, data: self.0.into() }
    }

    /// The records of a chunk, whose sum is right, and its times.
    fn chunk(mut self) -> (Bytes<'a>, [u64; 2]) {
        let times = [self.whole(8), self.whole(8)];
        let (size, sum) = (self.whole(8), self.whole(4));
        assert_eq!(self.text(), "");
        assert_eq!(self.whole(8), size);
        let records = self.take(size);
        assert_eq!(u64::from(crc32fast::hash(records)), sum);
        assert!(self.0.is_empty());
        (Bytes(records), times)
    }
}

fn within(file: &[u8]) -> Bytes<'_> {
    let inner = file.strip_prefix(MAGIC).and_then(|file| file.strip_suffix(MAGIC));
    Bytes(inner.expect("a file begins and ends as it must"))
}

/// All messages, in the order of the file.
pub(crate) fn messages(file: &[u8]) -> Vec<Message> {
    let (mut records, mut channels, mut all) = (within(file), Vec::new(), Vec::new());
    while let Some((kind, content)) = records.record() {
        if kind != 6 {
            continue;
        }
        let (mut inner, [first, last]) = content.chunk();
        let before = all.len();
        while let Some((kind, content)) = inner.record() {
            match kind {
                4 => channels.push(content.channel()),
                5 => all.push(content.message(&channels)),
                other => assert_eq!(other, 3, "a schema"),
            }
        }
        assert!(all[before..].iter().all(|it| (first..=last).contains(&it.time)));
    }
    all
}

impl Summary {
    /// By the footer, as viewers find it.
    pub(crate) fn of(file: &[u8]) -> Self {
        const FOOTER: usize = 1 + 8 + 20;
        let inner = within(file);
        let (before, mut footer) = inner.0.split_at(inner.0.len() - FOOTER);
        assert_eq!(footer[0], 2);
        footer = &footer[9..];
        let mut footer = Bytes(footer);
        let (start, _, sum) = (footer.whole(8), footer.whole(8), footer.whole(4));
        let start = usize::try_from(start).expect("a place");
        let summed = &file[start..file.len() - MAGIC.len() - 4];
        assert_eq!(u64::from(crc32fast::hash(summed)), sum);
        let mut records = Bytes(&before[start - MAGIC.len()..]);
        let mut summary = Self::default();
        while let Some((kind, mut content)) = records.record() {
            match kind {
                4 => summary.channels.push(content.channel()),
                8 => {
                    let times = [content.whole(8), content.whole(8)];
                    let (start, size) = (content.whole(8), content.whole(8));
                    let (mut places, mut indexes) = (content.counted(), Vec::new());
                    while !places.0.is_empty() {
                        places.id();
                        indexes.push(places.whole(8));
                    }
                    summary.chunks.push(ChunkIndex { times, start, size, indexes });
                }
                11 => {
                    summary.messages = content.whole(8);
                    content.take(2 + 4 * 4);
                    summary.times = [content.whole(8), content.whole(8)];
                }
                _ => {}
            }
        }
        summary
    }
}

impl ChunkIndex {
    /// The chunk's messages, by the indexes of its channels.
    pub(crate) fn messages(&self, file: &[u8]) -> Vec<Message> {
        let at = |place: u64| Bytes(&file[usize::try_from(place).expect("a place")..]);
        let mut chunk = Bytes(at(self.start).take(self.size));
        let (kind, content) = chunk.record().expect("a chunk");
        assert!(kind == 6 && chunk.0.is_empty());
        let (records, _) = content.chunk();
        let channels = Summary::of(file).channels;
        let mut all = Vec::new();
        for index in &self.indexes {
            let (kind, mut index) = at(*index).record().expect("an index");
            assert_eq!(kind, 7);
            let id = index.id();
            let mut entries = index.counted();
            while !entries.0.is_empty() {
                let (time, place) = (entries.whole(8), entries.whole(8));
                let (kind, content) = Bytes(&records.0[usize::try_from(place).expect("a place")..])
                    .record()
                    .expect("it");
                assert_eq!(kind, 5);
                let message = content.message(&channels);
                let channel = channels.iter().find(|it| it.id == id).expect("a channel");
                assert!(message.time == time && message.topic == channel.topic);
                all.push(message);
            }
        }
        all
    }
}
