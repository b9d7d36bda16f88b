//! What the writer writes, the reader reads; and what is cut off or damaged is said.

use std::fmt::Debug;
use std::io;

use proptest::collection::vec;
use proptest::prelude::*;

use super::format::{
    Attachment, AttachmentIndex, Channel, Chunk, ChunkIndex, DataEnd, Footer, Head, Header, MAGIC,
    Message, MessageIndex, Metadata, MetadataIndex, Part as _, Record, Schema, Statistics,
    SummaryOffset,
};
use super::read::{Damage, Messages, OverBudget};
use super::write::{Container, SchemaOf};

/// A message: the place of its channel, its time [ns] and its data.
type Sent = (usize, u64, Vec<u8>);

const TOPICS: [&str; 3] = ["/rover", "/wheels/front-left", "/räder/{}"];

fn sent() -> impl Strategy<Value = Vec<Sent>> {
    vec((0..TOPICS.len(), any::<u64>(), vec(any::<u8>(), 0..200)), 0..60)
}

/// A file with three channels, with names and values before half of the messages, and a file within
/// it behind them.
fn written(sent: &[Sent]) -> io::Result<Vec<u8>> {
    let mut out = Container::begin(Vec::new(), "a test")?;
    let channel = |topic: &&str| {
        let schema = SchemaOf {
            name: "test.Number",
            encoding: "protobuf",
            data: topic.as_bytes().to_vec(),
            messages: "protobuf",
        };
        out.channel(topic, &schema, &[("unit".to_owned(), "mm".to_owned())])
    };
    let channels: Vec<_> = TOPICS.iter().map(channel).collect();
    let (before, after) = sent.split_at(sent.len() / 2);
    for (channel, time, data) in before {
        out.message(channels[*channel], *time, data)?;
    }
    out.metadata("grouser", &[("title".to_owned(), "a drive".to_owned())])?;
    for (channel, time, data) in after {
        out.message(channels[*channel], *time, data)?;
    }
    out.attach("scenario.toml", "application/toml", b"slope_deg = 10")?;
    out.finish()
}

/// All messages of a file, as far as it can be read.
fn read(file: &[u8]) -> io::Result<(Vec<Sent>, Damage)> {
    let Some(mut messages) = Messages::new(file, OverBudget { length: 1 << 20, allowed: None })?
    else {
        return Ok((vec![], Damage::default()));
    };
    let mut all = Vec::new();
    while let Some(Message { channel, log_time, .. }) = messages.next_message(|_, _| true)? {
        let topic = messages.known.channels.get(&channel).map(|it| it.topic.clone());
        let place = TOPICS.iter().position(|known| topic.as_deref() == Some(known));
        all.push((place.unwrap_or(TOPICS.len()), log_time, messages.data().to_vec()));
    }
    Ok((all, messages.damage))
}

/// A record is read as it was written, and no part of it as the whole.
fn check_record<R: Record + PartialEq + Debug>(record: &R, rest: &[u8]) {
    let bytes = record.to_bytes_with(rest);
    let mut content = &bytes[..];
    let head = Head::take(&mut content).expect("a head");
    assert_eq!(head, Head { opcode: R::OPCODE, length: content.len() as u64 });
    let whole = content;
    assert_eq!(R::take(&mut content).as_ref(), Some(record));
    assert_eq!(content, rest);
    // The pairs at the end of some may be none: without their count they are the same.
    let size = whole.len() - rest.len() - size_of::<u32>();
    for length in 0..size {
        assert_ne!(R::take(&mut &whole[..length]).as_ref(), Some(record));
    }
}

proptest! {
    #[test]
    fn every_record_is_read_as_it_was_written(
        [first, last, start, length] in any::<[u64; 4]>(),
        [one, other] in any::<[u16; 2]>(),
        count in any::<u32>(),
        [name, text] in any::<[String; 2]>(),
        pairs in vec(any::<(String, String)>(), 0..4),
        places in vec(any::<(u16, u64)>(), 0..4),
        entries in vec(any::<(u64, u64)>(), 0..4),
        data in vec(any::<u8>(), 0..20),
    ) {
        let (name, text) = (|| name.clone(), || text.clone());
        check_record(&Header { profile: name(), library: text() }, &[]);
        check_record(&Footer { summary: first, offsets: last, sum: count }, &[]);
        check_record(&Schema { id: one, name: name(), encoding: text(), data: data.clone() }, &[]);
        let channel = Channel {
            id: one, schema: other, topic: name(), encoding: text(), metadata: pairs.clone(),
        };
        check_record(&channel, &[]);
        let message =
            Message { channel: one, sequence: count, log_time: first, publish_time: last };
        check_record(&message, &data);
        prop_assert_eq!(message.to_bytes().len(), Head::SIZE + Message::SIZE);
        prop_assert_eq!(Footer::default().to_bytes().len(), Head::SIZE + Footer::SIZE);
        let chunk =
            Chunk { first, last, size: start, sum: count, compression: name(), stored: length };
        check_record(&chunk, &data);
        check_record(&MessageIndex { channel: one, entries }, &[]);
        let index = ChunkIndex {
            first, last, start, length, indexes: places.clone(), index_length: start,
            compression: name(), stored: first, size: last,
        };
        check_record(&index, &[]);
        let attachment = Attachment {
            log_time: first, create_time: last, name: name(), media_type: text(), size: start,
        };
        check_record(&attachment, &data);
        let index = AttachmentIndex {
            start, length, log_time: first, create_time: last, size: start, name: name(),
            media_type: text(),
        };
        check_record(&index, &[]);
        let statistics = Statistics {
            messages: start, schemas: one, channels: count, attachments: count, metadata: count,
            chunks: count, first, last, counts: places,
        };
        check_record(&statistics, &[]);
        check_record(&Metadata { name: name(), entries: pairs }, &[]);
        check_record(&MetadataIndex { start, length, name: name() }, &[]);
        check_record(&SummaryOffset { opcode: Chunk::OPCODE, start, length }, &[]);
        check_record(&DataEnd { sum: count }, &[]);
    }

    #[test]
    fn messages_are_read_as_they_were_written(sent in sent()) {
        let file = written(&sent)?;
        prop_assert!(file.starts_with(&MAGIC) && file.ends_with(&MAGIC));
        let (found, damage) = read(&file)?;
        prop_assert_eq!(found, sent);
        prop_assert_eq!(damage.sentences(), Vec::<String>::new());
    }

    /// Wherever a file ends, all messages before that are read, and the damage says where it ends.
    #[test]
    fn a_file_that_is_cut_off_says_so(sent in sent(), at in any::<prop::sample::Index>()) {
        let file = written(&sent)?;
        let length = at.index(file.len());
        let (found, damage) = read(&file[..length])?;
        prop_assert_eq!(&found[..], &sent[..found.len()]);
        // Behind the end of all data there is nothing to miss, and without the magic the file is no
        // MCAP.
        if found.len() < sent.len() && length >= MAGIC.len() {
            let sentences = damage.sentences();
            let says = format!("ends at byte {length} without its end");
            prop_assert!(sentences.iter().any(|it| it.contains(&says)), "{:?}", sentences);
        }
    }

    /// A byte of a chunk that is not as it was written is damage, whatever it stands for.
    #[test]
    fn a_byte_that_is_changed_is_said(
        sent in sent(),
        at in any::<prop::sample::Index>(),
        change in 1_u8..,
    ) {
        let mut file = written(&sent)?;
        let header = Header { profile: String::new(), library: "a test".to_owned() };
        let start = MAGIC.len() + header.to_bytes().len();
        let mut content = &file[start + Head::SIZE..];
        let size = usize::try_from(Chunk::take(&mut content).expect("a chunk").stored)?;
        let place = file.len() - content.len() + at.index(size);
        file[place] ^= change;
        let (_, damage) = read(&file)?;
        prop_assert!(!damage.sentences().is_empty(), "{:?}", damage);
    }

    #[test]
    fn any_bytes_are_read_to_some_end(mut bytes in vec(any::<u8>(), 0..400)) {
        read(&bytes)?;
        bytes.splice(..0, MAGIC);
        read(&bytes)?;
    }
}
