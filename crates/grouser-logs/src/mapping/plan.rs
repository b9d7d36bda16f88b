//! A mapping, applied to the topics of a log and to the wheels of a rover.

use std::collections::BTreeMap;

use grouser_core::vehicle::Rover;
use grouser_io::columns::TIME;
use grouser_io::measurements::telemetry::{FORWARD, LEFTWARD, ROTATION};
use grouser_io::telemetry_mapping::{
    Axes, FieldPath, PoseColumn, PoseOf, Reading, RowRule, TelemetryMapping, WHEEL, What,
};

use crate::error::Problem;
use crate::mapping::topic::Topic;

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
    Number { field: FieldPath, column: usize, factor: f64, offset: f64 },
    Pose { of: PoseOf, columns: Vec<(PoseColumn, usize)>, axes: Axes, slot: usize },
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
        };
        let wheels: Vec<&str> = rover.mounts().iter().map(|mount| mount.name.as_str()).collect();
        for reading in &mapping.readings {
            if reading.is_of_wheels() {
                wheels.iter().try_for_each(|it| plan.add(mapping, reading, topics, it, choices))?;
            } else {
                plan.add(mapping, reading, topics, "*", choices)?;
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
        wheel: &str,
        choices: &TopicChoices,
    ) -> Result<(), Problem> {
        let written = match &reading.what {
            What::Number { column, .. } => vec![column.replace(WHEEL, wheel)],
            What::Pose { columns, .. } => columns.clone(),
        };
        let free: Vec<String> =
            written.into_iter().filter(|name| !self.columns.contains(name)).collect();
        let mut found: Vec<&Topic> =
            topics.iter().filter(|it| reading.reads(&it.name, &it.message, wheel)).collect();
        if free.is_empty() || found.is_empty() {
            return Ok(());
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
            What::Number { field, factor, offset, .. } => {
                // A name that would end the brackets is written without what does.
                let wheel = wheel.replace([']', '|', '*'], "_");
                let path = field.replace(WHEEL, &wheel);
                let field = FieldPath::parse(&path)
                    .ok_or_else(|| Problem::Mapping(format!("`{path}` is no path to a field")))?;
                Planned::Number { field, column: place, factor: *factor, offset: *offset }
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
        let time = reading.time.clone().or_else(|| mapping.time.clone());
        let is_optional = reading.is_optional;
        self.readings.push(PlannedReading { topics, time, is_optional, what });
        Ok(())
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
