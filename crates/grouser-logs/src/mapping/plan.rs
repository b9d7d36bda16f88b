//! A mapping, applied to the topics of a log and to the wheels of a rover.

use std::collections::BTreeMap;

use grouser_core::vehicle::{Mount, Rover};
use grouser_io::columns::TIME;
use grouser_io::measurements::telemetry::{FORWARD, LEFTWARD, ROTATION};
use grouser_io::telemetry_mapping::{
    Axes, FieldPath, PoseColumn, PoseOf, Reading, RowRule, TelemetryMapping, WHEEL, What,
};

use crate::error::Problem;
use crate::mapping::topic::Topic;

/// Columns of what turns with a wheel's joint: they have its sign.
const TURNING: [&str; 2] = ["wheel_speed_", "wheel_torque_"];

/// Which topic is meant where several have the messages that a mapping asks for: by the type of the
/// messages, or the pattern of topics, as the mapping has it.
pub type TopicChoices = BTreeMap<String, String>;

/// What is read of which topic, and into which column.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The names of the columns; the first is the time.
    pub(crate) columns: Vec<String>,
    pub(crate) readings: Vec<PlannedReading>,
    pub(crate) window: i64,
    pub(crate) rows: RowRule,
    /// Poses that are kept from row to row.
    pub(crate) poses: usize,
    /// Angles of wheels that are, each with its column and what it begins again after [rad].
    pub(crate) angles: Vec<(usize, f64)>,
}

#[derive(Clone, Debug)]
pub(crate) struct PlannedReading {
    /// Its topics: one, but for transforms.
    pub(crate) topics: Vec<String>,
    pub(crate) time: Option<FieldPath>,
    pub(crate) is_optional: bool,
    pub(crate) what: Planned,
}

#[derive(Clone, Debug)]
pub(crate) enum Planned {
    /// A number, by the first of its fields that is there.
    Number {
        fields: Vec<NumberField>,
        column: usize,
    },
    Pose {
        of: PoseOf,
        columns: Vec<(PoseColumn, usize)>,
        axes: Axes,
        slot: usize,
    },
}

/// A field with a number.
#[derive(Clone, Debug)]
pub(crate) struct NumberField {
    pub(crate) field: FieldPath,
    pub(crate) factor: f64,
    pub(crate) offset: f64,
    /// The slot of the angle that it is.
    pub(crate) angle: Option<usize>,
}

impl Plan {
    /// # Errors
    /// [`Problem`] where the mapping reads none of the topics, where several topics fit and no
    /// choice is made, or where the messages cannot be decoded here.
    pub(crate) fn new(
        mapping: &TelemetryMapping,
        topics: &[Topic],
        rover: &Rover,
        choices: &TopicChoices,
    ) -> Result<Self, Problem> {
        let mut plan = Self {
            columns: vec![TIME.name.to_owned()],
            readings: Vec::new(),
            window: mapping.window,
            rows: mapping.rows.clone(),
            poses: 0,
            angles: Vec::new(),
        };
        let wheels: Vec<WheelNames> = rover.mounts().iter().map(WheelNames::of).collect();
        for reading in &mapping.readings {
            if reading.is_of_wheels() {
                wheels.iter().try_for_each(|it| plan.add(mapping, reading, topics, it, choices))?;
            } else {
                plan.add(mapping, reading, topics, &WheelNames::any(), choices)?;
            }
        }
        if plan.readings.is_empty() {
            return Err(Problem::NothingMapped {
                mapping: mapping.name.clone(),
                topics: topics.iter().map(described).collect(),
            });
        }
        if let RowRule::Topic(name) = &plan.rows
            && !topics.iter().any(|topic| topic.name == *name)
        {
            let why = format!("row_topic = '{name}' of the mapping is no topic of the log");
            return Err(Problem::Mapping(why));
        }
        let is_read =
            |topic: &&Topic| plan.readings.iter().any(|it| it.topics.contains(&topic.name));
        if let Some(topic) = topics.iter().filter(is_read).find(|topic| !topic.is_readable()) {
            let (name, encoding) = (topic.name.clone(), topic.encoding.clone().unwrap_or_default());
            return Err(Problem::Encoding { topic: name, encoding });
        }
        Ok(plan)
    }

    /// The topic that ways, rotations or a pose's position are read of, if any is.
    pub(crate) fn way_of(&self) -> Option<&str> {
        let is_way = |name: &str| [FORWARD, LEFTWARD, ROTATION].iter().any(|it| it.name == name);
        let has_way = |reading: &&PlannedReading| match &reading.what {
            Planned::Number { column, .. } => is_way(&self.columns[*column]),
            Planned::Pose { columns, .. } => {
                let of_motion = |column: PoseColumn, place: usize| {
                    matches!(column, PoseColumn::X | PoseColumn::Y) || is_way(&self.columns[place])
                };
                columns.iter().any(|(column, place)| of_motion(*column, *place))
            }
        };
        self.readings.iter().find(has_way)?.topics.first().map(String::as_str)
    }

    /// Adds a reading, if its topic is there, for the columns that no reading before it gives.
    fn add(
        &mut self,
        mapping: &TelemetryMapping,
        reading: &Reading,
        topics: &[Topic],
        wheel: &WheelNames,
        choices: &TopicChoices,
    ) -> Result<(), Problem> {
        let written = match &reading.what {
            What::Number { column, .. } => vec![column.replace(WHEEL, &wheel.own)],
            What::Pose { columns, .. } => columns.clone(),
        };
        let reads = |it: &&Topic| wheel.is_read(reading, &it.name, &it.message);
        let mut found: Vec<&Topic> = topics.iter().filter(reads).collect();
        let time = reading.time.clone().or_else(|| mapping.time.clone());
        let free: Vec<String> =
            written.iter().filter(|name| !self.columns.contains(name)).cloned().collect();
        if free.is_empty() || found.is_empty() {
            return self.add_beside((reading, time), &found, &written, wheel);
        }
        let is_transform = matches!(&reading.what, What::Pose { of: PoseOf::Transform { .. }, .. });
        if is_transform {
            // What moves and what stays are in topics of their own.
            let of_type = |topic: &&Topic| found.iter().any(|it| it.message == topic.message);
            found = topics.iter().filter(of_type).collect();
        } else if found.len() > 1 {
            found = vec![chosen(reading, &found, choices)?];
        }
        let place = self.columns.len();
        let what = match &reading.what {
            What::Number { .. } => {
                Planned::Number { fields: self.fields(reading, wheel, place)?, column: place }
            }
            What::Pose { of, axes, .. } => {
                let columns = free.iter().filter_map(|name| PoseColumn::named(name));
                let columns = columns.zip(place..).collect();
                self.poses += 1;
                Planned::Pose { of: of.clone(), columns, axes: *axes, slot: self.poses - 1 }
            }
        };
        self.columns.extend(free);
        let topics = found.iter().map(|topic| topic.name.clone()).collect();
        let is_optional = reading.is_optional;
        self.readings.push(PlannedReading { topics, time, is_optional, what });
        Ok(())
    }

    /// Adds the field of a reading behind those that give its column already of the same topic: it
    /// is read of messages that lack the others.
    fn add_beside(
        &mut self,
        (reading, time): (&Reading, Option<FieldPath>),
        found: &[&Topic],
        written: &[String],
        wheel: &WheelNames,
    ) -> Result<(), Problem> {
        let place = self.columns.iter().position(|known| written == std::slice::from_ref(known));
        let gives = |it: &PlannedReading| {
            let is_it =
                matches!(&it.what, Planned::Number { column, .. } if Some(*column) == place);
            is_it && it.time == time && found.iter().any(|topic| it.topics == [topic.name.as_str()])
        };
        let before = self.readings.iter().position(gives);
        let (Some(place), Some(before)) = (place, before) else { return Ok(()) };
        let more = self.fields(reading, wheel, place)?;
        if let Some(PlannedReading { what: Planned::Number { fields, .. }, .. }) =
            self.readings.get_mut(before)
        {
            fields.extend(more);
        }
        Ok(())
    }

    /// The fields that a reading of a number means, one for each name of the wheel.
    fn fields(
        &mut self,
        reading: &Reading,
        wheel: &WheelNames,
        column: usize,
    ) -> Result<Vec<NumberField>, Problem> {
        let What::Number { field, factor, offset, wrap, column: written } = &reading.what else {
            return Ok(Vec::new());
        };
        let of_turning = TURNING.iter().any(|it| written.starts_with(it));
        let angle = wrap.map(|wrap| {
            self.angles.push((column, wrap));
            self.angles.len() - 1
        });
        let read = |(name, path): (usize, String)| {
            let reversed = wheel.is_reversed && of_turning && name == 0;
            let sign = if reversed { -1.0 } else { 1.0 };
            let field = FieldPath::parse(&path)
                .ok_or_else(|| Problem::Mapping(format!("`{path}` is no path to a field")))?;
            Ok(NumberField { field, factor: sign * factor, offset: sign * offset, angle })
        };
        wheel.paths(field).into_iter().enumerate().map(read).collect()
    }
}

/// What a wheel is called.
pub(crate) struct WheelNames {
    /// By the rover, and by columns.
    own: String,
    /// By logs: those that are tried first come first.
    in_logs: Vec<String>,
    /// Whether positive numbers under the first of these turn it backward.
    is_reversed: bool,
}

impl WheelNames {
    /// Robots' logs have the names of joints; where the rover has that of a link, what URDF puts
    /// behind those may be missing.
    pub(crate) fn of(mount: &Mount) -> Self {
        let own = mount.name.clone();
        let bare = own.strip_suffix("_link").map(str::to_owned);
        let joint = mount.joint.as_deref();
        let reversed = joint.and_then(|name| name.strip_prefix('-'));
        let joint = reversed.or(joint).map(str::to_owned);
        let in_logs = joint.into_iter().chain([own.clone()]).chain(bare).collect();
        Self { own, in_logs, is_reversed: reversed.is_some() }
    }

    /// Any name, for what is no wheel's.
    pub(crate) fn any() -> Self {
        Self { own: "*".to_owned(), in_logs: vec!["*".to_owned()], is_reversed: false }
    }

    /// Whether a reading reads the messages of a topic, of the wheel by any of its names.
    ///
    /// * `message`: the type of the messages
    pub(crate) fn is_read(&self, reading: &Reading, topic: &str, message: &str) -> bool {
        self.in_logs.iter().any(|name| reading.reads(topic, message, name))
    }

    /// The paths that a field of a mapping means, one for each name.
    pub(crate) fn paths(&self, field: &str) -> Vec<String> {
        // A name that would end the brackets is written without what does.
        let path = |name: &String| field.replace(WHEEL, &name.replace([']', '|', '*'], "_"));
        let mut paths: Vec<String> = self.in_logs.iter().map(path).collect();
        paths.dedup();
        paths
    }
}

/// The topic that is meant of several.
fn chosen<'t>(
    reading: &Reading,
    found: &[&'t Topic],
    choices: &TopicChoices,
) -> Result<&'t Topic, Problem> {
    let choice = choices.get(reading.selector());
    let chosen = choice.and_then(|name| found.iter().find(|topic| topic.name == *name));
    chosen.copied().ok_or_else(|| Problem::Ambiguous {
        what: reading.selector().to_owned(),
        topics: found.iter().map(|topic| topic.name.clone()).collect(),
    })
}

fn described(topic: &Topic) -> String {
    format!("{} ({})", topic.name, topic.message)
}
