//! Telemetry of MCAP logs, whose messages are JSON, Protocol Buffers or those of ROS.
//!
//! A log may be several files: those that follow one another, as recorders part them, are read in turn,
//! those that overlap and share no topic side by side, and their messages become rows as those of one
//! file do.

mod file;

use std::collections::HashMap;
use std::io;
use std::rc::Rc;

use grouser_core::vehicle::Rover;
use grouser_io::given_file::{FileContent, GivenFile};
use grouser_io::measurements::telemetry::TelemetryRecord;
use serde_json::Value;

pub(crate) use self::file::McapFile;
use crate::error::TelemetryError;
use crate::mapping::messages::MessageRows;
use crate::mapping::topic::Topic;
use crate::mcap::format::{Message, Schema};
use crate::mcap::order::Chronological;
use crate::mcap::read::Known;
use crate::protobuf::decode::Description;
use crate::ros::decode::{RosDescription, Wire, kind_not_read};
use crate::telemetry::options::LogOptions;

/// An MCAP log, record by record.
pub(crate) struct McapLog {
    /// All files, in the order of their messages.
    files: Vec<McapFile>,
    /// Those that are read: one, or all where each is of one sensor.
    opened: Vec<Opened>,
    rows: MessageRows,
    /// What each file gave, in their order, and the time up to which rows are its own [s].
    gave: Vec<(GivenFile, f64)>,
    /// Sentences on the damage of files that were read to their ends.
    damage: Vec<String>,
    /// Messages whose channel the log does not describe.
    without_channel: u64,
    /// Messages of kinds of CDR that are not read, with the first of these kinds.
    of_other_kind: Option<(u64, String)>,
    is_read: bool,
}

/// A file that is read.
struct Opened {
    /// Its place among the files.
    at: usize,
    messages: Chronological,
    /// How messages of a channel are decoded; nothing for channels that are not read.
    decoders: HashMap<u16, Option<Decoder>>,
    /// Types that were read already, by their schemas' numbers.
    descriptions: HashMap<u16, Option<Rc<OfSchema>>>,
    /// The next message, where it had to be looked at, and its content.
    next: Option<(Message, Vec<u8>)>,
    /// Whether any message of it was read.
    has_given: bool,
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

impl Opened {
    /// Opens the file of a place. Channels and schemas have numbers of their own in each.
    fn new(files: &mut [McapFile], at: usize) -> Result<Self, TelemetryError> {
        let messages = files[at].messages()?;
        let (decoders, descriptions) = (HashMap::new(), HashMap::new());
        Ok(Self { at, messages, decoders, descriptions, next: None, has_given: false })
    }

    /// Its next message on a channel that is read.
    fn next_message(
        &mut self,
        rows: &MessageRows,
        without_channel: &mut u64,
    ) -> io::Result<Option<(Message, Vec<u8>)>> {
        let Self { messages, decoders, descriptions, .. } = self;
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
}

impl McapLog {
    /// * `files`: one or more, in any order
    pub(crate) fn new(
        label: &str,
        mut files: Vec<McapFile>,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let mut topics: Vec<Topic> = Vec::new();
        for topic in files.iter().flat_map(|file| &file.topics) {
            if !topics.contains(topic) {
                topics.push(topic.clone());
            }
        }
        let rows = MessageRows::new(label, &topics, rover, options)?;
        let is_side_by_side = McapFile::sort(&mut files, rows.window())?;
        let none = |it: &McapFile| GivenFile::new(it.label.clone(), FileContent::Telemetry, 0, 0);
        let gave = files.iter().map(|it| (none(it), f64::INFINITY)).collect();
        let count = if is_side_by_side { files.len() } else { 1 };
        let opened = (0..count).map(|at| Opened::new(&mut files, at)).collect::<Result<_, _>>()?;
        Ok(Self {
            files,
            opened,
            rows,
            gave,
            damage: Vec::new(),
            without_channel: 0,
            of_other_kind: None,
            is_read: false,
        })
    }

    pub(crate) fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        loop {
            if let Some(record) = self.rows.next_record() {
                self.count(record.time);
                return Ok(Some(record));
            }
            if self.is_read {
                self.count(f64::INFINITY);
                return Ok(None);
            }
            if let Some((place, message, data)) = self.next_message()? {
                self.add(place, &message, &data);
            } else if !self.next_file()? {
                self.is_read = true;
                self.rows.end();
            }
        }
    }

    /// Goes on with the next file, if there is one.
    fn next_file(&mut self) -> Result<bool, TelemetryError> {
        let at = self.at();
        let recorded = self.files[at].span.map(|[_, last]| last as f64);
        let newest = self.rows.newest().map(|it| it as f64).or(recorded);
        if at + 1 == self.files.len() {
            return Ok(false);
        }
        self.gave[at].1 = newest.map_or(f64::NEG_INFINITY, |it| it / 1e9);
        self.damage.extend(self.damage_of_opened());
        self.opened = vec![Opened::new(&mut self.files, at + 1)?];
        Ok(true)
    }

    /// The place of the last file that is read.
    fn at(&self) -> usize {
        self.opened.last().map_or(0, |it| it.at)
    }

    /// Counts the rows since the last record for the file that they are of.
    ///
    /// * `time`: of the last of them [s]
    fn count(&mut self, time: f64) {
        let all = self.rows.rows().given("");
        let sum = |of: fn(&GivenFile) -> u64| self.gave.iter().map(|(it, _)| of(it)).sum::<u64>();
        let (there, used) = (all.there - sum(|it| it.there), all.used - sum(|it| it.used));
        let own = self.gave.iter().position(|(_, until)| time <= *until).unwrap_or(self.at());
        let at = own.min(self.at());
        let gave = &mut self.gave[at].0;
        (gave.there, gave.used) = (gave.there + there, gave.used + used);
    }

    /// What each file gave. Files that are read side by side gave the same rows together.
    pub(crate) fn given(&self) -> Vec<GivenFile> {
        let of = |(file, _): &(GivenFile, f64)| file.clone();
        let mut given: Vec<GivenFile> = self.gave.iter().map(of).collect();
        if self.opened.len() > 1 {
            let all = self.rows.rows().given("");
            for opened in &self.opened {
                let (there, used) = if opened.has_given { (all.there, all.used) } else { (0, 0) };
                given[opened.at] = GivenFile { there, used, ..given[opened.at].clone() };
            }
        }
        given
    }

    fn damage_of_opened(&self) -> Vec<String> {
        let of = |opened: &Opened| {
            let sentences = opened.messages.messages().damage.sentences();
            let label = &self.files[opened.at].label;
            let is_alone = self.files.len() == 1;
            let named = move |it: String| if is_alone { it } else { format!("{label}: {it}") };
            sentences.into_iter().map(named).collect::<Vec<_>>()
        };
        self.opened.iter().flat_map(of).collect()
    }

    /// The earliest message of the files that are read, with the place of its file among them.
    fn next_message(&mut self) -> Result<Option<(usize, Message, Vec<u8>)>, TelemetryError> {
        let Self { files, opened, rows, without_channel, .. } = self;
        for it in opened.iter_mut().filter(|it| it.next.is_none()) {
            let next = it.next_message(rows, without_channel);
            it.next =
                next.map_err(|error| TelemetryError::of_reading(&files[it.at].label, error))?;
        }
        let time = |it: &Opened| it.next.as_ref().map(|(message, _)| message.log_time);
        let times = opened.iter().enumerate().filter_map(|(place, it)| Some((time(it)?, place)));
        let Some((_, place)) = times.min() else { return Ok(None) };
        Ok(opened[place].next.take().map(|(message, data)| (place, message, data)))
    }

    fn add(&mut self, place: usize, message: &Message, data: &[u8]) {
        self.opened[place].has_given = true;
        let decoder = self.opened[place].decoders.get(&message.channel).and_then(Option::as_ref);
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
        let damage = self.damage.iter().cloned().chain(self.damage_of_opened());
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
