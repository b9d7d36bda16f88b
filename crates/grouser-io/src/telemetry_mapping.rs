//! Reads a mapping, `telemetry-mapping/1`: which topics and fields of a log of messages are which
//! columns of telemetry.
//!
//! Logs themselves are read by the crate `grouser-logs`; `docs/guide/telemetry.md` is the guide of
//! mappings.

mod field_path;
pub(crate) mod given;

use std::f64::consts::TAU;

use super::check::{did_you_mean, nearest};
use super::columns::{PITCH, ROLL, STEERING, TIME, WHEEL_SPEED, YAW};
use super::describe::telemetry_mapping::TELEMETRY_MAPPING;
use super::error::{DocumentError, Problem};
use super::field::Inner as _;
use super::kind::Kind;
use super::loaded::Loaded;
use super::measurements::Dimension;
use super::measurements::log_column::LogColumn;
use super::measurements::telemetry::{COLUMNS, FORWARD, LEFTWARD, Odometry, ROTATION};
use super::overrides::Overrides;
use super::read::{Written, written};
use super::source::Source;
use super::tree::Node;
use given::{Given, GivenReading};

pub use field_path::{FieldPath, Found, matches, plain};
pub use given::{Axes, PoseColumn, WHEEL};

/// Which topics and fields of a log are which columns of telemetry.
///
/// Which columns does the mapping that comes with the library read of the messages of an IMU?
///
/// ```
/// use grouser_io::telemetry_mapping::{What, read_telemetry_mapping};
/// use grouser_io::{Kind, Overrides, Source};
///
/// let source = Source::find(Kind::TelemetryMapping, "ros")?;
/// let ros = read_telemetry_mapping(&source, &Overrides::none())?.value;
/// let of_imu = ros.readings.iter().find(|it| it.selector() == "sensor_msgs/Imu").expect("it reads
/// them"); let What::Pose { columns, .. } = &of_imu.what else { panic!("its attitude") };
/// assert_eq!(columns.join(", "), "roll_deg, pitch_deg");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TelemetryMapping {
    /// What messages call it.
    pub name: String,
    /// How far messages may be out of order [ns].
    pub window: i64,
    /// What becomes one row.
    pub rows: RowRule,
    /// Where messages have their time; without it that of the log counts.
    pub time: Option<FieldPath>,
    /// What measured ways and rotations, if it says so.
    pub odometry: Option<Odometry>,
    /// What is read, each of the messages of a topic.
    pub readings: Vec<Reading>,
}

/// What becomes one row.
#[derive(Clone, Debug, PartialEq)]
pub enum RowRule {
    /// All that has one time.
    EachTime,
    /// All within an interval [ns].
    Interval(i64),
    /// All since the last message of a topic.
    Topic(String),
}

/// What is read of the messages of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The topic, or a pattern of topics.
    pub topic: Option<String>,
    /// The type of the messages.
    pub message: Option<String>,
    /// Where they have their time, if that is somewhere else than the mapping says.
    pub time: Option<FieldPath>,
    /// Whether messages may have no such field, which is then not noted.
    pub is_optional: bool,
    /// What it is.
    pub what: What,
}

/// What a reading gives.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// A number: factor and offset make it one in the column's unit.
    Number {
        /// The path to it, with [`WHEEL`] for the name of a wheel.
        field: String,
        /// The column that it is, with the same.
        column: String,
        /// What it is multiplied by.
        factor: f64,
        /// What is added at last.
        offset: f64,
        /// Where it is the angle of a wheel, whose speed the column is: what it begins again after
        /// [rad], infinite if it does not.
        wrap: Option<f64>,
    },
    /// A pose, for several columns.
    Pose {
        /// Where it is.
        of: PoseOf,
        /// The names of the columns.
        columns: Vec<String>,
        /// The axes that it has.
        axes: Axes,
    },
}

/// Where a pose is.
#[derive(Clone, Debug, PartialEq)]
pub enum PoseOf {
    /// In a quaternion, without a position.
    Attitude(FieldPath),
    /// In a position and an orientation.
    Pose(FieldPath),
    /// In a position and an orientation that are apart.
    Parts {
        /// The field with the position.
        position: FieldPath,
        /// The field with the quaternion.
        orientation: FieldPath,
    },
    /// A frame in another, by the transforms that lead there.
    Transform {
        /// The frame in which the other is.
        parent: String,
        /// The frame that is in it.
        child: String,
    },
}

/// A mapping that was read.
pub type LoadedTelemetryMapping = Loaded<TelemetryMapping>;

/// Reads a mapping.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_telemetry_mapping(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedTelemetryMapping, DocumentError> {
    let Written { tree, document, assumptions } =
        written(Kind::TelemetryMapping, source, overrides)?;
    let mut given = Given::default();
    TELEMETRY_MAPPING.put(&mut given, document.keys());
    let value = TelemetryMapping::read(given, &tree)?;
    Ok(Loaded { assumptions, ..Loaded::of(document, value) })
}

impl TelemetryMapping {
    fn read(given: Given, tree: &Node) -> Result<Self, DocumentError> {
        let at = |key: &str| At { tree, path: key.to_owned() };
        let rows = match (given.row_interval > 0.0, given.row_topic) {
            (is_interval, topic) if topic.is_empty() => {
                if is_interval {
                    RowRule::Interval(nanoseconds(given.row_interval))
                } else {
                    RowRule::EachTime
                }
            }
            (false, topic) => RowRule::Topic(topic),
            (true, _) => {
                let why = "`row_interval_s` and `row_topic` exclude each other";
                return Err(at("row_topic").fault(Problem::Conflict(why)));
            }
        };
        let readings =
            given.readings.iter().enumerate().map(|(place, reading)| {
                reading.read(&At { tree, path: format!("reading.{place}") })
            });
        Ok(Self {
            name: given.name,
            window: nanoseconds(given.window),
            rows,
            time: at("time").optional_path(&given.time)?,
            odometry: given.odometry,
            readings: readings.collect::<Result<_, _>>()?,
        })
    }
}

/// A time of at most an hour [s] in nanoseconds, which are far below 2⁶³.
#[expect(clippy::cast_possible_truncation)]
fn nanoseconds(seconds: f64) -> i64 {
    (seconds * 1e9).round() as i64
}

/// A key of the document, for errors.
struct At<'t> {
    tree: &'t Node,
    path: String,
}

impl At<'_> {
    fn key(&self, key: &str) -> Self {
        Self { tree: self.tree, path: format!("{}.{key}", self.path) }
    }

    fn fault(&self, problem: Problem) -> DocumentError {
        DocumentError::at(self.tree.origin_of(&self.path), problem)
    }

    fn not_allowed(&self, value: &str, allowed: String) -> DocumentError {
        let (key, value) = (self.path.clone(), value.escape_debug().to_string());
        self.fault(Problem::NotAllowed { key, value, allowed })
    }

    fn path(&self, text: &str) -> Result<FieldPath, DocumentError> {
        FieldPath::parse(text).ok_or_else(|| {
            let path = "a path to a field: names with dots between, [2] or [name=front*]";
            self.not_allowed(text, path.to_owned())
        })
    }

    fn optional_path(&self, text: &str) -> Result<Option<FieldPath>, DocumentError> {
        (!text.is_empty()).then(|| self.path(text)).transpose()
    }
}

impl GivenReading {
    fn read(&self, at: &At<'_>) -> Result<Reading, DocumentError> {
        let stated = |text: &String| (!text.is_empty()).then(|| text.clone());
        let what = match self.pose_of(at)? {
            None => self.number(at)?,
            Some(of) => self.pose(of, at)?,
        };
        Ok(Reading {
            topic: stated(&self.topic),
            message: stated(&self.message),
            time: at.key("time").optional_path(&self.time)?,
            is_optional: self.is_optional,
            what,
        })
    }

    fn pose_of(&self, at: &At<'_>) -> Result<Option<PoseOf>, DocumentError> {
        let path = |key: &str, text: &str| at.key(key).path(text);
        let name = |frame: &String| frame.trim_start_matches('/').to_owned();
        let [parent, child] = &self.transform;
        Ok(if !self.attitude.is_empty() {
            Some(PoseOf::Attitude(path("attitude", &self.attitude)?))
        } else if !self.orientation.is_empty() {
            let position = path("pose", &self.pose)?;
            Some(PoseOf::Parts { position, orientation: path("orientation", &self.orientation)? })
        } else if !self.pose.is_empty() {
            Some(PoseOf::Pose(path("pose", &self.pose)?))
        } else if self.field.is_empty() {
            Some(PoseOf::Transform { parent: name(parent), child: name(child) })
        } else {
            None
        })
    }

    fn number(&self, at: &At<'_>) -> Result<What, DocumentError> {
        if !self.columns.is_empty() {
            return Err(at.key("columns").fault(Problem::Conflict("a `field` is one `column`")));
        }
        let known = column_of(&self.column, &at.key("column"))?;
        if self.sign.abs() != 1.0 {
            let (key, value, range) = (at.key("sign").path, self.sign, "1 or -1".to_owned());
            return Err(at.key("sign").fault(Problem::OutOfRange { key, value, range }));
        }
        let size = if self.is_position {
            self.size_of_angle(known, at)?
        } else if self.unit.is_empty() {
            1.0
        } else {
            size_of(&self.unit, known, &at.key("unit"))? / known.unit.to_si(1.0)
        };
        // That it is a path is checked with any wheel's name.
        at.key("field").path(&self.field.replace(WHEEL, "wheel"))?;
        if self.topic.contains(WHEEL) && !self.column.contains(WHEEL) {
            let why = "the topic is of each wheel, the column is not";
            return Err(at.key("column").fault(Problem::Conflict(why)));
        }
        let axes = self.axes.unwrap_or(Axes::Grouser);
        let factor = self.scale * self.sign * axes_sign(axes, known) * size;
        let (field, column) = (self.field.clone(), self.column.clone());
        let wrap = [self.wrap, self.wrap_ticks * size].into_iter().find(|wrap| *wrap > 0.0);
        let wrap = wrap.map_or(f64::INFINITY, |wrap| wrap * self.scale.abs());
        let wrap = self.is_position.then_some(wrap);
        Ok(What::Number { field, column, factor, offset: self.offset, wrap })
    }

    /// What a position of one is as an angle [rad].
    fn size_of_angle(&self, column: &LogColumn, at: &At<'_>) -> Result<f64, DocumentError> {
        if column.name != WHEEL_SPEED.name {
            let why = "a `position` is an angle, whose column is the speed of a wheel";
            return Err(at.key("column").fault(Problem::Conflict(why)));
        }
        if self.offset != 0.0 {
            let why = "a `position` is read by its differences, which have no `offset`";
            return Err(at.key("offset").fault(Problem::Conflict(why)));
        }
        if self.ticks_per_turn > 0.0 {
            let [unit, wrap] = [!self.unit.is_empty(), self.wrap > 0.0];
            let key = if unit { "unit" } else { "wrap_rad" };
            let why = "a `position` in ticks has `wrap_ticks`, and no `unit` or `wrap_rad`";
            let fault = || at.key(key).fault(Problem::Conflict(why));
            return if unit || wrap { Err(fault()) } else { Ok(TAU / self.ticks_per_turn) };
        }
        if self.unit.is_empty() {
            return Ok(1.0);
        }
        let of_angle = |known: Vec<&str>| format!("a unit of an angle: {}", known.join(", "));
        let size = Dimension::Angle.size_of(&self.unit);
        size.map_err(|known| at.key("unit").not_allowed(&self.unit, of_angle(known)))
    }

    fn pose(&self, of: PoseOf, at: &At<'_>) -> Result<What, DocumentError> {
        let usual = match of {
            PoseOf::Pose(_) | PoseOf::Parts { .. } => {
                [FORWARD, LEFTWARD, ROTATION].map(|it| it.name).to_vec()
            }
            PoseOf::Attitude(_) | PoseOf::Transform { .. } => vec![ROLL.name, PITCH.name],
        };
        let columns = if self.columns.is_empty() {
            usual.into_iter().map(str::to_owned).collect()
        } else {
            self.columns.clone()
        };
        let is_missing =
            |name: &String| PoseColumn::named(name).is_some_and(PoseColumn::needs_position);
        if let (PoseOf::Attitude(_), Some(place)) = (&of, columns.iter().position(is_missing)) {
            let given = PoseColumn::ALL.iter().filter(|(_, column)| !column.needs_position());
            let given = given.map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
            let allowed = format!("of an attitude, which has no position: {given}");
            return Err(at.key(&format!("columns.{place}")).not_allowed(&columns[place], allowed));
        }
        Ok(What::Pose { of, columns, axes: self.axes.unwrap_or(Axes::Ros) })
    }
}

/// The column that is written, of a wheel with the wheel's name behind it.
fn column_of(written: &str, at: &At<'_>) -> Result<&'static LogColumn, DocumentError> {
    let is_it = |column: &&LogColumn| match written.strip_prefix(column.name) {
        Some("") => !column.is_of_wheel,
        Some(rest) => column.is_of_wheel && rest.starts_with('_') && rest.len() > 1,
        None => false,
    };
    // The time is not read from a field of its own: `time` says where it is.
    let all = || COLUMNS.iter().filter(|it| it.name != TIME.name);
    all().find(is_it).ok_or_else(|| {
        let name = |it: &LogColumn| {
            if it.is_of_wheel { format!("{}_{WHEEL}", it.name) } else { it.name.to_owned() }
        };
        let names: Vec<String> = all().map(name).collect();
        let meant = nearest(written, names.iter().map(String::as_str));
        let allowed = format!("a column of telemetry: {}", names.join(", "));
        at.not_allowed(written, allowed).with_hint(did_you_mean(meant.as_slice()))
    })
}

/// The size of a unit in SI, if it measures what the column holds.
fn size_of(unit: &str, column: &LogColumn, at: &At<'_>) -> Result<f64, DocumentError> {
    column.dimension().size_of(unit).map_err(|known| {
        at.not_allowed(unit, format!("a unit of `{}`: {}", column.name, known.join(", ")))
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
    #[must_use]
    pub fn selector(&self) -> &str {
        self.topic.as_deref().or(self.message.as_deref()).unwrap_or_default()
    }

    /// Whether it reads the messages of a topic.
    ///
    /// * `topic`: its name
    /// * `message`: the type of its messages
    /// * `wheel`: the wheel's name, where the reading is of each wheel; `*` for any
    #[must_use]
    pub fn reads(&self, topic: &str, message: &str, wheel: &str) -> bool {
        let is_topic = self.topic.as_ref().is_none_or(|pattern| {
            let pattern = plain(&pattern.replace(WHEEL, wheel));
            matches(&pattern, &plain(topic))
        });
        let of_type = self.message.as_ref();
        is_topic && of_type.is_none_or(|it| message_name(it) == message_name(message))
    }

    /// Whether there is one for each wheel.
    #[must_use]
    pub fn is_of_wheels(&self) -> bool {
        matches!(&self.what, What::Number { column, .. } if column.contains(WHEEL))
    }
}

/// The name of a type of messages, however it is written: `sensor_msgs/Imu`, `sensor_msgs/msg/Imu`,
/// `sensor_msgs.Imu`.
fn message_name(written: &str) -> String {
    let written = written.replace('.', "/").replace("/msg/", "/");
    written.strip_prefix("ros/").unwrap_or(&written).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCHEMA: &str = "telemetry-mapping/1";

    fn error(lines: &str) -> String {
        let text = format!("schema = \"{SCHEMA}\"\nname = \"test\"\n{lines}");
        let read = read_telemetry_mapping(&Source::text("m.toml", text), &Overrides::none());
        read.unwrap_err().to_string()
    }

    #[test]
    fn what_is_no_mapping_says_where_and_why() {
        let reading = |rest: &str| format!("[[reading]]\ntopic = \"/a\"\n{rest}");
        let speed = |rest: &str| {
            reading(&format!("field = \"x\"\ncolumn = \"wheel_speed_rad_s_a\"\n{rest}"))
        };
        for (text, place, part) in [
            ("", "", "`reading` is missing"),
            ("reading = []", ":3:11", "`reading` has 0 entries, it must have 1 or more"),
            ("window_s = -1.0\nreading = []", ":3:12", "it must be 0 to 3600"),
            ("colour = 1", ":3:1", "unknown key `colour`"),
            ("windows_s = 1.0", ":3:1", "did you mean `window_s`?"),
            (
                "row_interval_s = 0.1\nrow_topic = \"/a\"\n[[reading]]\ntopic = \"/a\"\npose = \
                 \"p\"",
                ":4:13",
                "exclude each other",
            ),
            ("time = \"\"", ":3:8", "`time` is too short"),
            (
                &reading("field = \"x\""),
                ":5:1",
                "`reading.0.field` goes with `column`, which is not given",
            ),
            (
                &reading("field = \"x\"\ncolumn = \"rol_deg\""),
                ":6:10",
                "is \"rol_deg\", it must be a column of telemetry: roll_deg",
            ),
            (&reading("field = \"x\"\ncolumn = \"rol_deg\""), ":6:10", "did you mean `roll_deg`?"),
            (&reading("field = \"x\"\ncolumn = \"time_s\""), ":6:10", "a column of telemetry"),
            (&reading("field = \"x[\"\ncolumn = \"roll_deg\""), ":5:9", "a path to a field"),
            (
                &reading("field = \"x\"\ncolumn = \"roll_deg\"\nunit = \"m\""),
                ":7:8",
                "a unit of `roll_deg`: deg, rad",
            ),
            (&reading("field = \"x\"\ncolumn = \"roll_deg\"\nunit = \"ell\""), ":7:8", "\"rad/s\""),
            (
                &reading("field = \"x\"\ncolumn = \"roll_deg\"\nsign = 2"),
                ":7:8",
                "it must be -1 to 1",
            ),
            (
                &reading("field = \"x\"\ncolumn = \"roll_deg\"\nsign = 0.5"),
                ":7:8",
                "it must be 1 or -1",
            ),
            (
                &reading("field = \"x\"\ncolumn = \"roll_deg\"\ncolumns = [\"yaw_deg\"]"),
                ":7:11",
                "is one `column`",
            ),
            (
                &reading("field = \"x\"\npose = \"y\"\ncolumn = \"roll_deg\""),
                ":3:1",
                "has `field` and `pose`, which exclude each other",
            ),
            (&reading("pose = \"y\"\nposition = true"), ":6:1", "goes with `field`"),
            (
                &reading("field = \"x\"\ncolumn = \"roll_deg\"\nposition = true"),
                ":6:10",
                "whose column is the speed of a wheel",
            ),
            (&speed("wrap_rad = 6.3"), ":7:1", "`reading.0.wrap_rad` goes with `position`"),
            (&speed("position = true\nwrap_ticks = 9"), ":8:1", "goes with `ticks_per_turn`"),
            (
                &speed("position = true\nticks_per_turn = 9\nwrap_rad = 6.3"),
                ":9:12",
                "has `wrap_ticks`",
            ),
            (
                &speed("position = true\nticks_per_turn = 9\nunit = \"deg\""),
                ":9:8",
                "has `wrap_ticks`",
            ),
            (&speed("position = true\nunit = \"rad/s\""), ":8:8", "a unit of an angle: deg, rad"),
            (&speed("position = true\noffset = 1"), ":8:10", "no `offset`"),
            (&reading("attitude = \"q\"\norientation = \"o\""), ":6:1", "goes with `pose`"),
            (&reading(""), ":3:1", "`reading.0` needs `field`, `attitude`, `pose` or `transform`"),
            (&reading("pose = \"y\"\nunit = \"m\""), ":6:1", "`reading.0.unit` goes with `field`"),
            (&reading("attitude = \"q\"\ncolumns = [\"x_m\"]"), ":6:12", "has no position"),
            (&reading("pose = \"q\"\ncolumns = [\"sinkage_mm\"]"), ":6:12", "\"roll_deg\""),
            (&reading("pose = \"q\"\naxes = \"enu\""), ":6:8", "\"ros\", \"ned\" or \"grouser\""),
            (&reading("transform = [\"odom\"]"), ":5:13", "has 1 entries, it must have 2"),
            (
                "[[reading]]\nfield = \"x\"\ncolumn = \"roll_deg\"",
                ":3:1",
                "`reading.0` needs `topic` or `message`",
            ),
            (
                "[[reading]]\ntopic = \"/a/{wheel}\"\nfield = \"x\"\ncolumn = \"roll_deg\"",
                ":6:10",
                "is of each wheel",
            ),
        ] {
            let found = error(text);
            assert!(
                found.contains(part) && found.starts_with(&format!("m.toml{place}")),
                "{text}: {found}"
            );
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

    /// The examples of the guide, and the guide's words.
    #[test]
    fn mappings_of_the_guide_are_valid() {
        let guide = include_str!("../../../docs/guide/telemetry.md");
        let examples = guide.split("```toml\n").skip(1);
        let examples = examples.filter_map(|rest| rest.split_once("```").map(|(text, _)| text));
        let examples: Vec<&str> = examples.filter(|text| text.contains(SCHEMA)).collect();
        assert!(!examples.is_empty());
        for text in examples {
            read_telemetry_mapping(&Source::text("guide", text), &Overrides::none()).unwrap();
        }
    }
}
