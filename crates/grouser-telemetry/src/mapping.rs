//! A mapping, `telemetry-mapping/1`: which topics and fields of a log of messages are which columns of telemetry.
//!
//! `docs/guide/telemetry.md` has its reference; the folder `data` has the mappings that are built in.

mod schema;

use std::fs;
use std::path::Path;

use grouser_io::columns::{PITCH, ROLL, STEERING, YAW};
use grouser_io::escape;
use grouser_io::measurements::Dimension;
use grouser_io::measurements::motor_log::LogColumn;
use grouser_io::measurements::telemetry::{COLUMNS, FORWARD, LEFTWARD, ROTATION};
use serde::Deserialize;

use crate::error::{Problem, TelemetryError};
use crate::field::FieldPath;
use crate::pose::Axes;
use crate::topic::Topic;

/// The schema's name.
const SCHEMA: &str = "telemetry-mapping/1";
/// What stands for the name of a wheel.
pub(crate) const WHEEL: &str = "{wheel}";
/// The largest document [bytes].
const MOST: u64 = 1 << 20;
/// The longest window and interval [s].
const LONGEST_S: f64 = 3600.0;
/// Messages may be so much out of order, where the document does not say [s]. Source: ours, many times the delay of a
/// recorder's buffers.
const USUAL_WINDOW_S: f64 = 1.0;

/// Mappings that are built in, each with its text; the first that fits the messages of a log is taken.
const BUILT_IN: [(&str, &str); 3] = [
    ("grouser", include_str!("../data/grouser.toml")),
    ("ros", include_str!("../data/ros.toml")),
    ("foxglove", include_str!("../data/foxglove.toml")),
];

/// Which topics and fields of a log are which columns.
#[derive(Clone, Debug)]
pub struct Mapping {
    /// What messages call it.
    pub(crate) label: String,
    pub(crate) name: String,
    /// How far messages may be out of order [ns].
    pub(crate) window: i64,
    pub(crate) rows: RowRule,
    /// Where messages have their time; without it that of the log counts.
    pub(crate) time: Option<FieldPath>,
    pub(crate) readings: Vec<Reading>,
}

/// What becomes one row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum RowRule {
    /// All that has one time.
    EachTime,
    /// All within an interval [ns].
    Interval(i64),
    /// All since the last message of a topic.
    Topic(String),
}

/// What is read of the messages of a topic.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    pub(crate) topic: Option<String>,
    pub(crate) message: Option<String>,
    pub(crate) time: Option<FieldPath>,
    /// Whether messages may have no such field, which is then not noted.
    pub(crate) is_optional: bool,
    pub(crate) what: What,
}

#[derive(Clone, Debug)]
pub(crate) enum What {
    /// A number: factor and offset make it one in the column's unit.
    Number { field: String, column: String, factor: f64, offset: f64 },
    /// A pose, for several columns.
    Pose { of: PoseOf, columns: Vec<String>, axes: Axes },
}

#[derive(Clone, Debug)]
pub(crate) enum PoseOf {
    /// A quaternion.
    Attitude(FieldPath),
    /// Position and orientation.
    Pose(FieldPath),
    /// A frame in another, by the transforms that lead there.
    Transform { parent: String, child: String },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    schema: String,
    name: String,
    #[serde(default, rename = "source")]
    _source: Option<String>,
    window_s: Option<f64>,
    row_interval_s: Option<f64>,
    row_topic: Option<String>,
    time: Option<String>,
    reading: Vec<ReadingDocument>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReadingDocument {
    topic: Option<String>,
    message: Option<String>,
    time: Option<String>,
    field: Option<String>,
    attitude: Option<String>,
    pose: Option<String>,
    transform: Option<[String; 2]>,
    column: Option<String>,
    columns: Option<Vec<String>>,
    unit: Option<String>,
    scale: Option<f64>,
    sign: Option<f64>,
    offset: Option<f64>,
    axes: Option<String>,
    #[serde(default)]
    optional: bool,
}

impl Mapping {
    /// Reads the document of a file, or takes the built-in one of that name.
    ///
    /// # Errors
    /// [`TelemetryError`] for a file that cannot be read or is no mapping.
    pub fn find(name: &Path) -> Result<Self, TelemetryError> {
        let built_in = BUILT_IN.iter().find(|(known, _)| name == Path::new(known));
        if let Some((known, text)) = built_in {
            return Self::parse(&format!("mapping {known}"), text);
        }
        let label = escape::path(name);
        let failed = |error| {
            TelemetryError::open(name, error).with_hint(format!(
                "name a file of TOML, or one of the built-in mappings: {}",
                Self::built_in_names().join(", ")
            ))
        };
        let about = fs::metadata(name).map_err(failed)?;
        if about.len() > MOST {
            let problem = Problem::Mapping(format!("larger than a mapping can be, {MOST} bytes"));
            return Err(TelemetryError::new(&label, problem));
        }
        let bytes = fs::read(name).map_err(failed)?;
        let text = String::from_utf8(bytes).map_err(|_| {
            TelemetryError::new(&label, Problem::Mapping("this is not UTF-8 text".to_owned()))
        })?;
        Self::parse(&label, &text)
    }

    /// The names of the mappings that are built in.
    #[must_use]
    pub fn built_in_names() -> [&'static str; 3] {
        BUILT_IN.map(|(name, _)| name)
    }

    /// The text of a mapping that is built in, to start from.
    #[must_use]
    pub fn built_in_text(name: &str) -> Option<&'static str> {
        BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
    }

    /// The built-in mapping that reads a log; nothing if none knows one of its topics.
    pub(crate) fn for_topics(topics: &[Topic]) -> Option<Self> {
        let mappings = BUILT_IN
            .iter()
            .filter_map(|(name, text)| Self::parse(&format!("mapping {name}"), text).ok());
        let reads = |mapping: &Self| {
            let fits = |reading: &Reading| topics.iter().any(|topic| reading.may_read(topic));
            mapping.readings.iter().any(fits)
        };
        mappings.into_iter().find(reads)
    }

    /// Reads the text of a document.
    ///
    /// * `label`: what messages call it
    ///
    /// # Errors
    /// [`TelemetryError`] with line and column, or with the reading, for a text that is no mapping.
    pub fn parse(label: &str, text: &str) -> Result<Self, TelemetryError> {
        let failed = |why: String| TelemetryError::new(label, Problem::Mapping(why));
        let document: Document = toml::from_str(text)
            .map_err(|error| failed(error.to_string().trim_end().to_owned()))?;
        if document.schema != SCHEMA {
            return Err(failed(format!("schema = '{}', it must be '{SCHEMA}'", document.schema)));
        }
        let interval = document.row_interval_s.filter(|it| *it != 0.0);
        let rows = match (interval, document.row_topic) {
            (Some(_), Some(_)) => {
                return Err(failed("row_interval_s and row_topic exclude each other".to_owned()));
            }
            (Some(interval), None) => {
                RowRule::Interval(nanoseconds("row_interval_s", interval).map_err(failed)?)
            }
            (None, Some(topic)) => RowRule::Topic(topic),
            (None, None) => RowRule::EachTime,
        };
        let window = document.window_s.unwrap_or(USUAL_WINDOW_S);
        let window = nanoseconds("window_s", window).map_err(failed)?;
        let time = document.time.as_deref().map(FieldPath::parse).transpose().map_err(failed)?;
        let readings = document.reading.into_iter().enumerate().map(|(place, reading)| {
            reading.read().map_err(|why| failed(format!("reading {}: {why}", place + 1)))
        });
        let readings = readings.collect::<Result<Vec<_>, _>>()?;
        if readings.is_empty() {
            return Err(failed("has no [[reading]]".to_owned()));
        }
        let (label, name) = (label.to_owned(), document.name);
        Ok(Self { label, name, window, rows, time, readings })
    }
}

/// # Errors
/// A sentence, for a time that no window has.
fn nanoseconds(key: &str, seconds: f64) -> Result<i64, String> {
    if !(0.0..=LONGEST_S).contains(&seconds) {
        return Err(format!("{key} = {seconds}, it must be 0 to {LONGEST_S}"));
    }
    // Up to an hour in nanoseconds is a whole number far below 2⁶³.
    #[expect(clippy::cast_possible_truncation)]
    Ok((seconds * 1e9).round() as i64)
}

impl ReadingDocument {
    fn read(self) -> Result<Reading, String> {
        if self.topic.is_none() && self.message.is_none() {
            return Err("names neither a `topic` nor a type of `message`".to_owned());
        }
        let time = self.time.as_deref().map(FieldPath::parse).transpose()?;
        let axes = self.axes()?;
        let what = match (&self.field, self.pose_of()?) {
            (Some(field), None) => self.number(field, axes)?,
            (None, Some(of)) => self.pose(of, axes)?,
            _ => {
                return Err("needs one of `field`, `attitude`, `pose` and `transform`".to_owned());
            }
        };
        let Self { topic, message, optional: is_optional, .. } = self;
        Ok(Reading { topic, message, time, is_optional, what })
    }

    fn axes(&self) -> Result<Axes, String> {
        let Some(written) = &self.axes else {
            return Ok(if self.field.is_some() { Axes::Grouser } else { Axes::Ros });
        };
        let found = Axes::ALL.into_iter().find(|(name, _)| name == written);
        found.map(|(_, axes)| axes).ok_or_else(|| {
            let names = Axes::ALL.map(|(name, _)| name).join(", ");
            format!("axes = '{written}', it must be one of {names}")
        })
    }

    fn pose_of(&self) -> Result<Option<PoseOf>, String> {
        let all = [
            self.attitude.as_deref().map(|it| FieldPath::parse(it).map(PoseOf::Attitude)),
            self.pose.as_deref().map(|it| FieldPath::parse(it).map(PoseOf::Pose)),
            self.transform.as_ref().map(|[parent, child]| {
                let name = |it: &String| it.trim_start_matches('/').to_owned();
                Ok(PoseOf::Transform { parent: name(parent), child: name(child) })
            }),
        ];
        let mut all = all.into_iter().flatten();
        match (all.next(), all.next()) {
            (Some(_), Some(_)) => Err("reads one of `attitude`, `pose` and `transform`".to_owned()),
            (only, _) => only.transpose(),
        }
    }

    fn number(&self, field: &str, axes: Axes) -> Result<What, String> {
        if self.columns.is_some() {
            return Err("a `field` is one `column`".to_owned());
        }
        let written = self.column.as_ref().ok_or("needs the `column` that its field is")?;
        let column = column_of(written)?;
        let sign = self.sign.unwrap_or(1.0);
        if sign.abs() != 1.0 {
            return Err(format!("sign = {sign}, it must be 1 or -1"));
        }
        let size = match &self.unit {
            None => 1.0,
            Some(unit) => size_of(unit, column)? / column.unit.to_si(1.0),
        };
        let (scale, offset) = (self.scale.unwrap_or(1.0), self.offset.unwrap_or(0.0));
        if !(scale.is_finite() && offset.is_finite()) {
            return Err("`scale` and `offset` must be finite".to_owned());
        }
        // That it is a path is checked with any wheel's name.
        FieldPath::parse(&field.replace(WHEEL, "wheel"))?;
        if let Some(topic) = self.topic.as_ref().filter(|it| it.contains(WHEEL))
            && !written.contains(WHEEL)
        {
            return Err(format!("the topic {topic} is of each wheel, its column is not"));
        }
        let factor = scale * sign * axes_sign(axes, column) * size;
        Ok(What::Number { field: field.to_owned(), column: written.clone(), factor, offset })
    }

    fn pose(&self, of: PoseOf, axes: Axes) -> Result<What, String> {
        let numbers = [
            self.unit.is_some(),
            self.scale.is_some(),
            self.sign.is_some(),
            self.offset.is_some(),
            self.column.is_some(),
        ];
        if numbers.contains(&true) {
            return Err(
                "an attitude, a pose or a transform has `columns` and `axes` only".to_owned()
            );
        }
        let attitude = || vec![ROLL.name.to_owned(), PITCH.name.to_owned()];
        let odometry = || [FORWARD, LEFTWARD, ROTATION].map(|it| it.name.to_owned()).to_vec();
        let usual = || if matches!(of, PoseOf::Pose(_)) { odometry() } else { attitude() };
        let columns = self.columns.clone().unwrap_or_else(usual);
        let turned = matches!(of, PoseOf::Attitude(_));
        for column in &columns {
            let known = PoseColumn::ALL.iter().find(|(name, _)| name == column);
            let Some((_, known)) = known else {
                let names = PoseColumn::ALL.map(|(name, _)| name).join(", ");
                return Err(format!("`{column}` is no column of a pose, which are {names}"));
            };
            if turned && known.needs_position() {
                return Err(format!("an attitude has no position, which `{column}` needs"));
            }
        }
        if columns.is_empty() {
            return Err("`columns` is empty".to_owned());
        }
        Ok(What::Pose { of, columns, axes })
    }
}

/// A column that a pose gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PoseColumn {
    Roll,
    Pitch,
    Yaw,
    Forward,
    Leftward,
    Rotation,
    X,
    Y,
}

impl PoseColumn {
    pub(crate) const ALL: [(&'static str, Self); 8] = [
        (ROLL.name, Self::Roll),
        (PITCH.name, Self::Pitch),
        (YAW.name, Self::Yaw),
        (FORWARD.name, Self::Forward),
        (LEFTWARD.name, Self::Leftward),
        (ROTATION.name, Self::Rotation),
        (grouser_io::columns::X.name, Self::X),
        (grouser_io::columns::Y.name, Self::Y),
    ];

    fn needs_position(self) -> bool {
        matches!(self, Self::Forward | Self::Leftward | Self::X | Self::Y)
    }
}

/// The column that is written, of a wheel with the wheel's name behind it.
fn column_of(written: &str) -> Result<&'static LogColumn, String> {
    let is_it = |column: &&LogColumn| match written.strip_prefix(column.name) {
        Some("") => !column.is_of_wheel,
        Some(rest) => column.is_of_wheel && rest.starts_with('_') && rest.len() > 1,
        None => false,
    };
    // The time is not read from a field of its own: `time` says where it is.
    let mut all = COLUMNS.iter().filter(|it| it.name != grouser_io::columns::TIME.name);
    all.find(is_it).ok_or_else(|| {
        let name = |it: &LogColumn| {
            if it.is_of_wheel { format!("{}_{WHEEL}", it.name) } else { it.name.to_owned() }
        };
        let names: Vec<String> = COLUMNS.iter().skip(1).map(name).collect();
        format!("`{written}` is no column of telemetry, which are {}", names.join(", "))
    })
}

/// The size of a unit in SI, if it measures what the column holds.
fn size_of(unit: &str, column: &LogColumn) -> Result<f64, String> {
    let dimension = match column.unit.symbol {
        "m" | "mm" => Dimension::Length,
        "°" => Dimension::Angle,
        "rad/s" => Dimension::AngularSpeed,
        "N·m" => Dimension::Moment,
        "A" => Dimension::Current,
        _ => Dimension::Text,
    };
    dimension.size_of(unit).map_err(|known| {
        format!("'{unit}' is no unit for `{}`; known: {}", column.name, known.join(", "))
    })
}

/// The sign that a number in other axes has in ours.
fn axes_sign(axes: Axes, column: &LogColumn) -> f64 {
    let turned: &[&str] = match axes {
        Axes::Grouser => &[],
        Axes::Ros => &[PITCH.name],
        Axes::Ned => &[YAW.name, LEFTWARD.name, ROTATION.name, STEERING.name],
    };
    if turned.contains(&column.name) { -1.0 } else { 1.0 }
}

impl Reading {
    /// What messages call the topic or the messages that it reads.
    pub(crate) fn selector(&self) -> &str {
        self.topic.as_deref().or(self.message.as_deref()).unwrap_or_default()
    }

    /// Whether it could read a topic, of whatever wheel.
    fn may_read(&self, topic: &Topic) -> bool {
        self.reads(topic, "*")
    }

    /// Whether it reads a topic.
    ///
    /// * `wheel`: the wheel's name, where the reading is of each wheel
    pub(crate) fn reads(&self, topic: &Topic, wheel: &str) -> bool {
        let is_topic = self.topic.as_ref().is_none_or(|pattern| {
            let pattern = crate::field::plain(&pattern.replace(WHEEL, wheel));
            crate::field::matches(&pattern, &crate::field::plain(&topic.name))
        });
        let is_message = self
            .message
            .as_ref()
            .is_none_or(|message| message_name(message) == message_name(&topic.message));
        is_topic && is_message
    }

    /// Whether there is one for each wheel.
    pub(crate) fn is_of_wheels(&self) -> bool {
        matches!(&self.what, What::Number { column, .. } if column.contains(WHEEL))
    }
}

/// The name of a type of messages, however it is written: `sensor_msgs/Imu`, `sensor_msgs/msg/Imu`, `sensor_msgs.Imu`.
fn message_name(written: &str) -> String {
    let written = written.replace('.', "/").replace("/msg/", "/");
    written.strip_prefix("ros/").unwrap_or(&written).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(lines: &str) -> String {
        let text = format!("schema = \"{SCHEMA}\"\nname = \"test\"\n{lines}");
        Mapping::parse("m.toml", &text).unwrap_err().to_string()
    }

    #[test]
    fn built_in_mappings_are_valid() {
        for (name, text) in BUILT_IN {
            Mapping::parse(name, text).unwrap();
        }
    }

    #[test]
    fn what_is_no_mapping_says_why() {
        let reading = |rest: &str| format!("[[reading]]\ntopic = \"/a\"\n{rest}");
        for (text, part) in [
            ("", "reading"),
            ("reading = []", "has no [[reading]]"),
            ("window_s = -1.0\nreading = []", "it must be 0 to 3600"),
            ("colour = 1", "colour"),
            (&reading("field = \"x\""), "needs the `column`"),
            (
                &reading("field = \"x\"\ncolumn = \"rol_deg\""),
                "no column of telemetry, which are roll_deg",
            ),
            (&reading("field = \"x\"\ncolumn = \"time_s\""), "no column of telemetry"),
            (&reading("field = \"x[\"\ncolumn = \"roll_deg\""), "is no path"),
            (&reading("field = \"x\"\ncolumn = \"roll_deg\"\nunit = \"m\""), "known: deg, rad"),
            (&reading("field = \"x\"\ncolumn = \"roll_deg\"\nsign = 2"), "it must be 1 or -1"),
            (&reading("field = \"x\"\npose = \"y\"\ncolumn = \"roll_deg\""), "needs one of"),
            (&reading("attitude = \"q\"\ncolumns = [\"x_m\"]"), "has no position"),
            (&reading("pose = \"q\"\ncolumns = [\"sinkage_mm\"]"), "no column of a pose"),
            (&reading("pose = \"q\"\naxes = \"enu\""), "it must be one of ros, ned, grouser"),
            ("[[reading]]\nfield = \"x\"\ncolumn = \"roll_deg\"", "neither a `topic` nor"),
        ] {
            let found = error(text);
            assert!(found.contains(part) && found.starts_with("m.toml: "), "{text}: {found}");
        }
    }

    #[test]
    fn types_of_messages_are_one_however_written() {
        for written in
            ["sensor_msgs/Imu", "sensor_msgs/msg/Imu", "sensor_msgs.Imu", "ros.sensor_msgs.Imu"]
        {
            assert_eq!(message_name(written), "sensor_msgs/Imu");
        }
    }
}
