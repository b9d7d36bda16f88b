//! A file of MCAP before its messages are read: its topics, its chunks, and from when to when it is.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use grouser_io::{escape, file};

use crate::error::{Problem, TelemetryError};
use crate::mapping::topic::Topic;
use crate::mcap::format::{
    Channel, ChunkIndex, Footer, Head, MAGIC, Part as _, Record as _, Schema,
};
use crate::mcap::order::Chronological;
use crate::mcap::read::{Known, Messages, OverBudget, known_of};
use crate::ros::decode::Wire;
use crate::ros::types::has_wide_texts;
use crate::telemetry::options::LogOptions;

/// A file that is looked into, and whose messages are read in its turn.
pub(crate) struct McapFile {
    /// What messages call it.
    pub(super) label: String,
    path: PathBuf,
    pub(super) topics: Vec<Topic>,
    chunks: Vec<ChunkIndex>,
    budget: OverBudget,
    /// When its first and its last message were recorded [ns]; nothing without messages, or where
    /// nobody asks.
    pub(super) span: Option<[u64; 2]>,
}

impl McapFile {
    /// Looks into a file.
    ///
    /// * `is_one_of_several`: whether its span is asked for
    pub(crate) fn look(
        path: &Path,
        options: &LogOptions,
        is_one_of_several: bool,
    ) -> Result<Self, TelemetryError> {
        let label = escape::path(path);
        let failed = |error| TelemetryError::of_reading(&label, error);
        let mut file =
            file::open(path).map_err(|problem| TelemetryError::new(&label, problem.into()))?;
        let budget = options.budget(&file).map_err(failed)?;
        let (known, chunks, mut span) = contents(&mut file, budget).map_err(failed)?;
        if is_one_of_several && span.is_none() && chunks.is_empty() {
            (_, span) = scanned(&mut file, budget).map_err(failed)?;
        }
        let topics = topics(&known);
        Ok(Self { path: path.to_owned(), topics, chunks, budget, span, label })
    }

    /// Its messages, from the first on.
    pub(super) fn messages(&mut self) -> Result<Chronological, TelemetryError> {
        let opened = file::open(&self.path);
        let file = opened.map_err(|problem| TelemetryError::new(&self.label, problem.into()))?;
        let messages = Chronological::new(file, std::mem::take(&mut self.chunks), self.budget);
        let changed = || io::Error::other("the file changed while it was read");
        let messages = messages.and_then(|it| it.ok_or_else(changed));
        messages.map_err(|error| TelemetryError::of_reading(&self.label, error))
    }

    /// Puts files in the order of their messages; whether they are to be read side by side, as files
    /// of one sensor each are.
    ///
    /// * `overlap`: by how much one may go on while the next has begun [ns]
    ///
    /// # Errors
    /// [`Problem::Overlap`] where one goes on for longer, and some have a topic in common.
    pub(super) fn sort(files: &mut [Self], overlap: u64) -> Result<bool, TelemetryError> {
        // What has no messages comes last.
        files.sort_by_key(|it| (it.span.is_none(), it.span));
        for pair in files.windows(2) {
            let (Some([_, ends]), Some([begins, _])) = (pair[0].span, pair[1].span) else { break };
            if ends > begins.saturating_add(overlap) {
                if have_own_topics(files) {
                    return Ok(true);
                }
                let [ends, begins] = [ends, begins].map(|time| time as f64 / 1e9);
                let next = pair[1].label.clone();
                let problem = Problem::Overlap { next, ends, begins };
                return Err(TelemetryError::new(&pair[0].label, problem));
            }
        }
        Ok(false)
    }

    /// Whether files have no topic in common, as where each is of one sensor; not where one cannot be
    /// looked into.
    pub(crate) fn share_no_topic(paths: &[PathBuf], options: &LogOptions) -> bool {
        let files = paths.iter().map(|path| Self::look(path, options, false));
        files.collect::<Result<Vec<_>, _>>().is_ok_and(|files| have_own_topics(&files))
    }
}

fn have_own_topics(files: &[McapFile]) -> bool {
    let mut known = BTreeSet::new();
    files.iter().all(|file| {
        let own: BTreeSet<&str> = file.topics.iter().map(|it| it.name.as_str()).collect();
        own.into_iter().all(|topic| known.insert(topic))
    })
}

/// What a log has, and where its chunks are: from the index at its end, or, without one, from all
/// that is there.
fn contents(
    file: &mut File,
    budget: OverBudget,
) -> io::Result<(Known, Vec<ChunkIndex>, Option<[u64; 2]>)> {
    let Some((known, chunks)) = indexed(file)? else {
        let (known, span) = scanned(file, budget)?;
        return Ok((known, Vec::new(), span));
    };
    // A chunk without messages is from 0 to 0.
    let spans = chunks.iter().map(|it| [it.first, it.last]).filter(|it| *it != [0, 0]);
    let span = spans.reduce(|one, other| [one[0].min(other[0]), one[1].max(other[1])]);
    Ok((known, chunks, span))
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

/// Channels and schemas of all chunks, and from when to when messages were recorded [ns].
fn scanned(file: &mut File, budget: OverBudget) -> io::Result<(Known, Option<[u64; 2]>)> {
    file.rewind()?;
    let Some(mut messages) = Messages::new(BufReader::new(&*file), budget)? else {
        return Ok((Known::default(), None));
    };
    let mut span: Option<[u64; 2]> = None;
    while let Some(message) = messages.next_message(|_, _| true)? {
        let time = message.log_time;
        span = Some(span.map_or([time; 2], |[first, last]| [first.min(time), last.max(time)]));
    }
    Ok((messages.known, span))
}
