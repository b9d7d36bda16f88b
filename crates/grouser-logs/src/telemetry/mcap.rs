//! Telemetry of MCAP logs, whose messages are JSON, Protocol Buffers or those of ROS.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::rc::Rc;

use grouser_core::vehicle::Rover;
use grouser_io::measurements::telemetry::TelemetryRecord;
use serde_json::Value;

use crate::error::{Problem, TelemetryError};
use crate::mapping::messages::MessageRows;
use crate::mapping::topic::Topic;
use crate::mcap::format::{
    Channel, ChunkIndex, Footer, Head, MAGIC, Message, Part as _, Record as _, Schema,
};
use crate::mcap::order::Chronological;
use crate::mcap::read::{Known, Messages, OverBudget, known_of};
use crate::protobuf::decode::Description;
use crate::ros::decode::{RosDescription, Wire, kind_not_read};
use crate::ros::types::has_wide_texts;
use crate::telemetry::options::LogOptions;

/// An MCAP log, record by record.
pub(crate) struct McapLog {
    label: String,
    messages: Chronological,
    rows: MessageRows,
    /// How messages of a channel are decoded; nothing for channels that are not read.
    decoders: HashMap<u16, Option<Decoder>>,
    /// Types that were read already, by their schemas' numbers.
    descriptions: HashMap<u16, Option<Rc<OfSchema>>>,
    /// Messages whose channel the log does not describe.
    without_channel: u64,
    /// Messages of kinds of CDR that are not read, with the first of these kinds.
    of_other_kind: Option<(u64, String)>,
    is_read: bool,
}

#[derive(Clone, Debug)]
enum Decoder {
    Json(String),
    OfSchema(String, Rc<OfSchema>),
    /// A topic that is read, but whose messages the log does not describe.
    Unknown,
}

/// A type of messages as the log describes it.
#[derive(Clone, Debug)]
enum OfSchema {
    Protobuf(Description),
    Ros(RosDescription),
}

impl OfSchema {
    /// Reads a schema; nothing if it does not describe messages of that encoding.
    fn read(encoding: &str, schema: &Schema) -> Option<Self> {
        let Schema { name, data, .. } = schema;
        if encoding == "protobuf" {
            return Description::read(data, name).map(Self::Protobuf);
        }
        let wire = Wire::of(encoding, &schema.encoding)?;
        RosDescription::read(data, name, wire).map(Self::Ros)
    }

    fn is_cdr(&self) -> bool {
        matches!(self, Self::Ros(description) if description.is_cdr())
    }

    fn decode(&self, message: &[u8]) -> Option<Value> {
        match self {
            Self::Protobuf(description) => description.decode(message),
            Self::Ros(description) => description.decode(message),
        }
    }
}

impl McapLog {
    pub(crate) fn new(
        label: &str,
        mut file: File,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let failed = |error| failure(label, error);
        let budget = options.budget(&file).map_err(failed)?;
        let (known, chunks) = contents(&mut file, budget).map_err(failed)?;
        let rows = MessageRows::new(label, &topics(&known), rover, options)?;
        let messages = Chronological::new(file, chunks, budget).map_err(failed)?;
        let messages = messages
            .ok_or_else(|| failed(io::Error::other("the file changed while it was read")))?;
        let (decoders, descriptions) = (HashMap::new(), HashMap::new());
        let label = label.to_owned();
        Ok(Self {
            label,
            messages,
            rows,
            decoders,
            descriptions,
            without_channel: 0,
            of_other_kind: None,
            is_read: false,
        })
    }

    pub(crate) fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        loop {
            if let Some(record) = self.rows.next_record() {
                return Ok(Some(record));
            }
            if self.is_read {
                return Ok(None);
            }
            let message = self.next_message().map_err(|error| failure(&self.label, error))?;
            if let Some((message, data)) = message {
                self.add(&message, &data);
            } else {
                self.is_read = true;
                self.rows.end();
            }
        }
    }

    fn next_message(&mut self) -> io::Result<Option<(Message, Vec<u8>)>> {
        let Self { messages, rows, decoders, descriptions, without_channel, .. } = self;
        messages.next_message(|known, channel| {
            if !known.channels.contains_key(&channel) {
                *without_channel += 1;
                return false;
            }
            let decoder = decoders
                .entry(channel)
                .or_insert_with(|| decoder(known, channel, rows, descriptions));
            decoder.is_some()
        })
    }

    fn add(&mut self, message: &Message, data: &[u8]) {
        let decoder = self.decoders.get(&message.channel).and_then(Option::as_ref);
        let Some(decoder) = decoder else { return };
        let (topic, tree) = match decoder {
            Decoder::Json(topic) => (topic, serde_json::from_slice::<Value>(data).ok()),
            Decoder::OfSchema(topic, description) => (topic, description.decode(data)),
            Decoder::Unknown => return self.rows.damaged_message(),
        };
        match (tree, i64::try_from(message.log_time)) {
            (Some(tree), Ok(time)) => self.rows.add(topic, time, &tree),
            (None, _) => {
                let is_of_ros = matches!(decoder, Decoder::OfSchema(_, it) if it.is_cdr());
                match kind_not_read(data).filter(|_| is_of_ros) {
                    Some(kind) => self.of_other_kind.get_or_insert((0, kind)).0 += 1,
                    None => self.rows.damaged_message(),
                }
            }
            _ => self.rows.damaged_message(),
        }
    }

    pub(crate) fn messages(&self) -> &MessageRows {
        &self.rows
    }

    pub(crate) fn notes(&self) -> Vec<String> {
        let count = self.without_channel;
        let lost = (count > 0).then(|| {
            format!("{count} messages are of channels that the log does not describe, and left out")
        });
        let damage = self.messages.messages().damage.sentences().into_iter();
        let other = self.of_other_kind.as_ref().map(|(count, kind)| {
            format!("{count} messages are encoded as {kind}, which is not read here, and left out")
        });
        damage.chain(lost).chain(other).chain(self.rows.notes()).collect()
    }
}

/// How messages of a channel are decoded, if its topic is read.
fn decoder(
    known: &Known,
    channel: u16,
    rows: &MessageRows,
    descriptions: &mut HashMap<u16, Option<Rc<OfSchema>>>,
) -> Option<Decoder> {
    let channel = known.channels.get(&channel)?;
    if !rows.wants(&channel.topic) {
        return None;
    }
    if channel.encoding == "json" {
        return Some(Decoder::Json(channel.topic.clone()));
    }
    let schema = known.schemas.get(&channel.schema);
    let read = || OfSchema::read(&channel.encoding, schema?).map(Rc::new);
    let described = descriptions.entry(channel.schema).or_insert_with(read).clone();
    Some(described.map_or(Decoder::Unknown, |it| Decoder::OfSchema(channel.topic.clone(), it)))
}

/// Why a log cannot be read on.
fn failure(label: &str, error: io::Error) -> TelemetryError {
    let over = error.get_ref().and_then(|it| it.downcast_ref::<OverBudget>()).copied();
    TelemetryError::new(label, over.map_or(Problem::Unreadable(error), Problem::OverBudget))
}

/// What a log has, and where its chunks are: from the index at its end, or, without one, from all
/// that is there.
fn contents(file: &mut File, budget: OverBudget) -> io::Result<(Known, Vec<ChunkIndex>)> {
    match indexed(file)? {
        Some(found) => Ok(found),
        None => Ok((scanned(file, budget)?, Vec::new())),
    }
}

/// The topics of a log.
fn topics(known: &Known) -> Vec<Topic> {
    let mut topics = Vec::new();
    for channel in known.channels.values() {
        let schema = known.schemas.get(&channel.schema);
        let topic = Topic {
            name: channel.topic.clone(),
            message: schema.map(|it| it.name.clone()).unwrap_or_default(),
            encoding: Some(encoding(channel, schema)),
        };
        if !topics.contains(&topic) {
            topics.push(topic);
        }
    }
    topics.sort_by(|one, other| one.name.cmp(&other.name));
    topics
}

/// How messages of a channel are encoded, and how described where that is not read here.
fn encoding(channel: &Channel, schema: Option<&Schema>) -> String {
    let messages = &channel.encoding;
    let by = schema.filter(|it| !it.data.is_empty()).map_or("", |it| &it.encoding);
    let is_of_ros = matches!(messages.as_str(), "cdr" | "ros1");
    if is_of_ros && schema.is_some_and(|it| has_wide_texts(&it.data)) {
        return format!("{messages} with wide texts (wstring)");
    }
    match (is_of_ros && Wire::of(messages, by).is_none(), by) {
        (false, _) => messages.clone(),
        (true, "") => format!("{messages} without a schema"),
        (true, _) => format!("{messages} with a schema in {by}"),
    }
}

/// Channels, schemas and chunks of the index; nothing without a whole one.
fn indexed(file: &mut File) -> io::Result<Option<(Known, Vec<ChunkIndex>)>> {
    /// The footer's record with the magic behind it [bytes].
    const END: u64 = (Head::SIZE + Footer::SIZE + MAGIC.len()) as u64;
    /// The largest index that is read.
    const MOST: u64 = 256 << 20;
    let size = file.metadata()?.len();
    let Some(start) = size.checked_sub(END) else { return Ok(None) };
    file.seek(SeekFrom::Start(start))?;
    let mut end = Vec::new();
    file.take(END).read_to_end(&mut end)?;
    let mut rest = &end[..];
    let is_footer = Head::take(&mut rest).is_some_and(|head| head.opcode == Footer::OPCODE);
    let footer = Footer::take(&mut rest).filter(|_| is_footer && rest == MAGIC);
    let summary = footer.map(|it| it.summary).filter(|summary| (1..start).contains(summary));
    let Some(summary) = summary else { return Ok(None) };
    if start - summary > MOST {
        return Ok(None);
    }
    file.seek(SeekFrom::Start(summary))?;
    let known = known_of(BufReader::new(&*file).take(start - summary))?;
    let is_within = |chunk: &ChunkIndex| {
        chunk.start.checked_add(chunk.length).is_some_and(|end| end <= summary)
    };
    Ok(known.filter(|(known, chunks)| !known.channels.is_empty() && chunks.iter().all(is_within)))
}

/// Channels and schemas of all chunks.
fn scanned(file: &mut File, budget: OverBudget) -> io::Result<Known> {
    file.rewind()?;
    let Some(mut messages) = Messages::new(BufReader::new(&*file), budget)? else {
        return Ok(Known::default());
    };
    while messages.next_message(|_, _| false)?.is_some() {}
    Ok(messages.known)
}
