//! The log of a replayed drive: what was measured and what was predicted, side by side.

use std::io::Write;

use grouser::document::columns::Quantity;
use grouser::document::columns::replay::{columns_of, measured_channels, quantity_of};
use grouser::studies::replay::{Channel, ChannelValue, Replay, ReplayedStretch};
use grouser_core::vehicle::Rover;

use crate::mcap::write::{ChannelId, Container, SchemaOf};
use crate::protobuf::message::{Types, put_double};
use crate::run_log::error::LogError;
use crate::run_log::frames::WheelName;
use crate::run_log::nanoseconds;

/// A topic's end, the type of its messages, and its channels with their places.
struct Group {
    topic: String,
    schema: &'static str,
    fields: Vec<(usize, Channel)>,
}

/// What one side of a log has of a channel.
type Side = fn(&ChannelValue) -> Option<f64>;

/// The two sides of a log, by the beginnings of their topics.
const SIDES: [(&str, Side); 2] = [("measured", |it| it.measured), ("predicted", |it| it.predicted)];

/// Writes a log of a replayed drive, with the topics `/measured/…` and `/predicted/…`; what it was
/// written to comes back.
///
/// A message has all numbers of its topic; where one of them is missing, there is no message.
/// Times are those of the telemetry.
///
/// * `title`: what was driven, a line
/// * `attachments`: names and texts of documents
///
/// # Errors
/// [`LogError`] if it cannot be written to, or has a time that no log can have.
pub fn write_replay<W: Write>(
    out: W,
    title: &str,
    (replay, rover): (&Replay, &Rover),
    attachments: &[(String, Vec<u8>)],
) -> Result<W, LogError> {
    let library = concat!("grouser ", env!("CARGO_PKG_VERSION"));
    let mut out = Container::begin(out, library)?;
    let about = [("title", title), ("time", "that of the telemetry")];
    out.metadata("grouser", &about.map(|(key, value)| (key.to_owned(), value.to_owned())))?;
    let groups = groups(replay, rover);
    let mut topics: Vec<(ChannelId, Side, &Group)> = Vec::new();
    for (side, of) in SIDES {
        for group in &groups {
            let (schema, about) = (group.schema(), group.described());
            let topic = format!("/{side}/{}", group.topic);
            topics.push((out.channel(&topic, &schema, &about), of, group));
        }
    }
    for stretch in &replay.stretches {
        let time = nanoseconds(stretch.time)?;
        for (to, of, group) in &topics {
            if let Some(message) = group.message(stretch, *of) {
                out.message(*to, time, &message)?;
            }
        }
    }
    for (name, content) in attachments {
        out.attach(name, "text/plain", content)?;
    }
    Ok(out.finish()?)
}

/// Those that anything was measured of.
fn groups(replay: &Replay, rover: &Rover) -> Vec<Group> {
    let measured = measured_channels(replay, rover);
    let of = |topic: &str, schema: &'static str, has: &dyn Fn(Channel) -> bool| Group {
        topic: topic.to_owned(),
        schema,
        fields: measured.iter().copied().filter(|(_, channel)| has(*channel)).collect(),
    };
    let is_pose = |it: Channel| {
        matches!(it, Channel::X | Channel::Y | Channel::Yaw | Channel::Roll | Channel::Pitch)
    };
    let is_motion = |it: Channel| it.wheel().is_none() && it != Channel::Power && !is_pose(it);
    let mut groups = vec![
        of("motion", "grouser.ReplayedMotion", &is_motion),
        of("power", "grouser.ReplayedPower", &|it| it == Channel::Power),
        of("pose", "grouser.ReplayedPose", &is_pose),
    ];
    // All wheels have one type of messages.
    let count = rover.wheel_count();
    let of_all = |first: Channel| {
        measured
            .iter()
            .filter(|(_, it)| it.wheel().is_some() && it.of_first_wheel() == first)
            .count()
            == count
    };
    for (wheel, name) in WheelName::all(rover.mounts()).iter().enumerate() {
        let has = |it: Channel| it.wheel() == Some(wheel) && of_all(it.of_first_wheel());
        groups.push(of(&format!("wheels/{}", name.frame), "grouser.ReplayedWheel", &has));
    }
    groups.retain(|group| !group.fields.is_empty());
    groups
}

impl Group {
    fn quantities(&self) -> impl Iterator<Item = Quantity> {
        self.fields.iter().map(|(_, channel)| quantity_of(*channel))
    }

    fn schema(&self) -> SchemaOf<'static> {
        let data = Types::of_numbers(self.schema, self.quantities().map(|it| it.name));
        SchemaOf { name: self.schema, encoding: "protobuf", data, messages: "protobuf" }
    }

    /// What each field is, with its unit.
    fn described(&self) -> Vec<(String, String)> {
        let described = |(_, channel): &(usize, Channel)| {
            let [column, _] = columns_of(*channel);
            (column.name.to_owned(), format!("{} [{}]", column.doc, column.unit.symbol))
        };
        self.fields.iter().map(described).collect()
    }

    fn message(&self, stretch: &ReplayedStretch, of: Side) -> Option<Vec<u8>> {
        let mut out = Vec::with_capacity(10 * self.fields.len());
        for (number, (place, channel)) in (1..).zip(&self.fields) {
            let value = of(stretch.values.get(*place)?)?;
            put_double(quantity_of(*channel).unit.from_si(value), number, &mut out);
        }
        Some(out)
    }
}
