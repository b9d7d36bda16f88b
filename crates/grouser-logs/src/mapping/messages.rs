//! Messages, decoded, become records of telemetry by a mapping.

use std::collections::HashMap;

use grouser_core::vehicle::Rover;
use grouser_io::given_file::{FileContent, GivenFile};
use grouser_io::measurements::telemetry::{
    Cell, FORWARD, LEFTWARD, Odometry, ROTATION, TelemetryRecord, TelemetryRows,
};
use grouser_io::telemetry_mapping::{Axes, FieldPath, Found, PoseColumn, PoseOf, Reading, RowRule};
use serde_json::Value;

use crate::error::{Problem, TelemetryError};
use crate::mapping::Mapping;
use crate::mapping::clock::{Clock, When};
use crate::mapping::merge::{Merge, Readings};
use crate::mapping::plan::{NumberField, Plan, Planned, PlannedReading, WheelNames};
use crate::mapping::pose::{Frames, Pose, Rotation};
use crate::mapping::topic::Topic;
use crate::mapping::turning::{Angle, Turned};
use crate::telemetry::options::LogOptions;

/// Records of messages, which are added as they come.
pub struct MessageRows {
    plan: Plan,
    mapping: String,
    /// What a mapping of the user's gave.
    given: Option<GivenFile>,
    /// The readings of each topic.
    by_topic: HashMap<String, Vec<usize>>,
    clock: Clock,
    merge: Merge,
    table: TelemetryRows,
    frames: Frames,
    /// The last pose of each slot that was in a row.
    last: Vec<Option<Pose>>,
    /// The last angle of each slot that was.
    last_angles: Vec<Option<Angle>>,
    counts: Counts,
}

#[derive(Clone, Debug, Default)]
struct Counts {
    /// Messages without a time of their own, which have that of the log.
    without_stamp: u64,
    with_stamp: u64,
    /// Messages that have a time that no log has.
    outside: u64,
    /// Messages that cannot be decoded.
    damaged: u64,
    /// Readings whose field is not there, or is several, by topic.
    without_field: HashMap<String, u64>,
    several: HashMap<String, u64>,
    /// Readings that are no numbers or no rotations, by topic.
    damaged_fields: HashMap<String, u64>,
    /// Orientations that are exactly none, by topic.
    unmeasured: HashMap<String, u64>,
    /// Poses that turn about the vertical alone, and so have no roll and no pitch, by topic.
    flat: HashMap<String, u64>,
}

impl MessageRows {
    /// * `label`: what messages call the log
    /// * `options`: how it is read
    ///
    /// # Errors
    /// [`TelemetryError`] where the mapping reads none of the topics or is ambiguous, names a wheel
    /// that the rover does not have, or reads ways of which nothing says how they were measured.
    pub fn new(
        label: &str,
        topics: &[Topic],
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let built_in;
        let mapping = if let Some(mapping) = &options.mapping {
            mapping
        } else {
            built_in = Mapping::for_topics(topics).ok_or_else(|| {
                let topics = topics.iter().map(|it| format!("{} ({})", it.name, it.message));
                let mapping = "built-in ones".to_owned();
                let problem = Problem::NothingMapped { mapping, topics: topics.collect() };
                TelemetryError::new(label, problem)
            })?;
            &built_in
        };
        let plan = Plan::new(&mapping.rules, topics, rover, &options.topics)
            .map_err(|problem| TelemetryError::new(label, problem))?;
        let stated = options.odometry.or(mapping.rules.odometry);
        if let (None, Some(topic)) = (stated, plan.way_of()) {
            let (topic, mapping) = (topic.to_owned(), mapping.label.clone());
            let problem = Problem::OdometryNotStated { topic, mapping };
            return Err(TelemetryError::new(label, problem));
        }
        let table = TelemetryRows::new(&mapping.label, &plan.columns, rover)?
            .measured_by(stated.unwrap_or(Odometry::Visual));
        let mut by_topic: HashMap<String, Vec<usize>> = HashMap::new();
        for (place, reading) in plan.readings.iter().enumerate() {
            for topic in &reading.topics {
                by_topic.entry(topic.clone()).or_default().push(place);
            }
        }
        if let RowRule::Topic(topic) = &plan.rows {
            by_topic.entry(topic.clone()).or_default();
        }
        let is_way = |name: &String| [FORWARD, LEFTWARD, ROTATION].iter().any(|it| it.name == name);
        let ways = plan.columns.iter().map(is_way).collect();
        let turning = Turned::new(plan.angles.iter().map(|(_, wrap)| *wrap).collect());
        let merge = Merge::new(plan.window, plan.rows.clone(), ways, turning);
        let (last, last_angles) = (vec![None; plan.poses], vec![None; plan.angles.len()]);
        let given = given(mapping, topics, rover);
        let mapping = mapping.rules.name.clone();
        let (clock, frames, counts) = (Clock::default(), Frames::default(), Counts::default());
        Ok(Self {
            plan,
            mapping,
            given,
            by_topic,
            clock,
            merge,
            table,
            frames,
            last,
            last_angles,
            counts,
        })
    }

    /// What the mapping gave, if it is a file.
    #[must_use]
    pub fn given_mapping(&self) -> Option<&GivenFile> {
        self.given.as_ref()
    }

    /// Whether messages of a topic are read.
    #[must_use]
    pub fn wants(&self, topic: &str) -> bool {
        self.by_topic.contains_key(topic)
    }

    /// Adds a message; messages may be out of order within the mapping's window.
    ///
    /// * `log_time`: when it was recorded [ns]
    /// * `message`: its fields as a tree, a quaternion's, say, as
    ///   `{"x": 0, "y": 0, "z": 0, "w": 1}`
    pub fn add(&mut self, topic: &str, log_time: i64, message: &Value) {
        let Some(places) = self.by_topic.get(topic) else { return };
        let ends_row = matches!(&self.plan.rows, RowRule::Topic(it) if it == topic);
        if places.is_empty() && ends_row {
            let readings = Readings { ends_row, ..Readings::default() };
            return self.place(log_time, When::Recorded, readings);
        }
        let is_transform = |it: &PlannedReading| {
            matches!(&it.what, Planned::Pose { of: PoseOf::Transform { .. }, .. })
        };
        let readings = places.iter().map(|place| &self.plan.readings[*place]);
        let moved =
            if readings.clone().any(is_transform) { self.frames.take(message) } else { Vec::new() };
        let mut by_time: Vec<(When, Readings)> = Vec::new();
        let context = Context { topic, message, moved: &moved, frames: &self.frames, log_time };
        for reading in readings {
            let Some((when, readings)) = context.read(reading, &mut self.counts) else { continue };
            match by_time.iter_mut().find(|(known, _)| *known == when) {
                Some((_, known)) => {
                    known.cells.extend(readings.cells);
                    known.poses.extend(readings.poses);
                    known.angles.extend(readings.angles);
                }
                None => by_time.push((when, readings)),
            }
        }
        for (when, mut readings) in by_time {
            readings.ends_row = ends_row;
            self.place(log_time, when, readings);
        }
    }

    fn place(&mut self, log_time: i64, when: When, readings: Readings) {
        for (time, readings) in self.clock.place(log_time, (when, readings)) {
            self.merge.add(time, readings);
        }
    }

    /// Counts a message that cannot be decoded.
    pub fn damaged_message(&mut self) {
        self.counts.damaged += 1;
    }

    /// Counts a row of a table that cannot be read.
    pub(crate) fn damaged_row(&mut self) {
        self.table.damaged_row();
    }

    /// Rows of a table are lost, and how far the rover went over them.
    pub(crate) fn lose_way(&mut self) {
        self.table.lose_way();
    }

    /// Counts a row of a table that has no time.
    pub(crate) fn row_without_time(&mut self) {
        self.table.row_without_time();
    }

    /// No more messages come: what waited for earlier ones becomes records.
    pub fn end(&mut self) {
        for (time, readings) in self.clock.end() {
            self.merge.add(time, readings);
        }
        self.merge.end();
    }

    /// The next record that is complete, if there is one.
    pub fn next_record(&mut self) -> Option<TelemetryRecord> {
        loop {
            let (time, readings) = self.merge.next_row()?;
            if self.merge.take_lost_ways() {
                self.table.lose_way();
            }
            let cells = self.cells(time, &readings);
            if let Some(record) = self.table.record(cells.into_iter()) {
                return Some(record);
            }
        }
    }

    fn cells(&mut self, time: i64, readings: &Readings) -> Vec<Cell> {
        let mut cells = vec![Cell::Gap; self.plan.columns.len()];
        cells[0] = Cell::Number(time as f64 / 1e9);
        for (column, cell) in &readings.cells {
            cells[*column] = *cell;
        }
        for reading in &self.plan.readings {
            let Planned::Pose { of, columns, axes, slot } = &reading.what else { continue };
            let Some((_, pose)) = readings.poses.iter().find(|(known, _)| known == slot) else {
                continue;
            };
            let (last, mut flat) = (self.last[*slot].replace(*pose), 0);
            let numbers = numbers_of(pose, last.as_ref(), *axes);
            // What goes on a plane has no roll and no pitch, which is no reading of them.
            let is_flat = matches!(of, PoseOf::Pose(_) | PoseOf::Parts { .. })
                && pose.rotation.is_about_vertical();
            for (what, column) in columns {
                if is_flat && matches!(what, PoseColumn::Roll | PoseColumn::Pitch) {
                    flat += 1;
                    continue;
                }
                cells[*column] = numbers(*what).map_or(Cell::Gap, Cell::of_number);
            }
            if flat > 0 {
                *self.counts.flat.entry(reading.topics.join(", ")).or_default() += 1;
            }
        }
        for (slot, angle) in &readings.angles {
            let last = self.last_angles[*slot].replace(*angle);
            let speed = last.and_then(|last| angle.speed_since(last));
            let cell = &mut cells[self.plan.angles[*slot].0];
            if *cell == Cell::Gap {
                *cell = speed.map_or(Cell::Gap, Cell::of_number);
            }
        }
        cells
    }

    /// How much later a message may come than others of its time [ns].
    pub(crate) fn window(&self) -> u64 {
        u64::try_from(self.plan.window).unwrap_or(0)
    }

    /// The latest time of which there was a reading [ns].
    pub(crate) fn newest(&self) -> Option<i64> {
        self.merge.newest()
    }

    /// The rows so far, with what was lost of them.
    #[must_use]
    pub fn rows(&self) -> &TelemetryRows {
        &self.table
    }

    /// The share of all readings, and of all rows, that was used so far: the less of both.
    #[must_use]
    pub fn share_used(&self) -> f64 {
        self.merge.share_used().min(self.table.share_used())
    }

    /// What was noticed so far, beside what was lost of rows: a sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let columns = self.plan.columns.len() - 1;
        let mut notes =
            vec![format!("the mapping '{}' has {columns} columns of telemetry", self.mapping)];
        let Counts { without_stamp, with_stamp, outside, damaged, .. } = self.counts;
        if without_stamp > 0 && with_stamp > 0 {
            notes.push(format!(
                "{without_stamp} messages have no time of their own, and take their place among \
                 those that have one"
            ));
        }
        let window = self.plan.window as f64 / 1e9;
        for (count, what) in [
            (
                self.merge.late,
                format!(
                    "readings came more than {window} s too late and are left out (window_s in the \
                     mapping)"
                ),
            ),
            (
                self.merge.leaps,
                "readings leap ahead by ten minutes or more, alone, and are left out".to_owned(),
            ),
            (damaged, "messages cannot be decoded, and are left out".to_owned()),
            (outside, "messages have a time that no log has, and are left out".to_owned()),
        ] {
            if count > 0 {
                notes.push(format!("{count} {what}"));
            }
        }
        for (counts, what) in [
            (&self.counts.damaged_fields, "are no numbers or no rotations, and count as gaps"),
            (&self.counts.without_field, "without a field that the mapping reads there"),
            (
                &self.counts.unmeasured,
                "are exactly the identity, which no sensor measures, and count as gaps",
            ),
            (
                &self.counts.flat,
                "turn about the vertical alone, as what moves on a plane does, and have no roll and \
                 no pitch",
            ),
            (
                &self.counts.several,
                "in which several elements fit a name of the mapping, and none is read",
            ),
        ] {
            let mut counts: Vec<_> = counts.iter().collect();
            counts.sort();
            notes.extend(
                counts.iter().map(|(topic, count)| format!("{count} readings of {topic} {what}")),
            );
        }
        notes
    }
}

/// What a pose says, in the columns' units.
fn numbers_of(pose: &Pose, last: Option<&Pose>, axes: Axes) -> impl Fn(PoseColumn) -> Option<f64> {
    let attitude = pose.attitude(axes).map(f64::to_degrees);
    let [forward, leftward, turned] = last.map_or([None; 3], |last| pose.since(last, axes));
    let position = pose.position;
    move |column| match column {
        PoseColumn::Roll => Some(attitude[0]),
        PoseColumn::Pitch => Some(attitude[1]),
        PoseColumn::Yaw => Some(attitude[2]),
        PoseColumn::Forward => forward,
        PoseColumn::Leftward => leftward,
        PoseColumn::Rotation => turned.map(f64::to_degrees),
        PoseColumn::X => position.map(|it| it.x),
        PoseColumn::Y => position.map(|it| it.y),
    }
}

/// What a mapping gave: of its readings those that read a topic count.
fn given(mapping: &Mapping, topics: &[Topic], rover: &Rover) -> Option<GivenFile> {
    let any = [WheelNames::any()];
    let wheels: Vec<WheelNames> = rover.mounts().iter().map(WheelNames::of).collect();
    let readings = &mapping.rules.readings;
    let is_read = |reading: &&Reading| {
        let wheels = if reading.is_of_wheels() { &wheels[..] } else { &any };
        let reads = |topic: &Topic| {
            wheels.iter().any(|it| it.is_read(reading, &topic.name, &topic.message))
        };
        topics.iter().any(reads)
    };
    let (there, used) = (readings.len(), readings.iter().filter(is_read).count());
    let file =
        || GivenFile::new(mapping.label.clone(), FileContent::Mapping, there as u64, used as u64);
    mapping.is_file.then(file)
}

/// A message with what it is read by.
struct Context<'m> {
    topic: &'m str,
    message: &'m Value,
    /// Frames that it moved, each with its transform.
    moved: &'m [(&'m str, &'m Value)],
    frames: &'m Frames,
    log_time: i64,
}

impl Context<'_> {
    /// What a reading reads of it, with its time.
    fn read(&self, reading: &PlannedReading, counts: &mut Counts) -> Option<(When, Readings)> {
        let mut readings = Readings::default();
        match &reading.what {
            Planned::Number { fields, column } => {
                let (field, value) = self.first(fields, reading.is_optional, counts)?;
                let number = number(value).map(|it| it * field.factor + field.offset);
                let Some(number) = number.filter(|it| !it.is_nan()) else {
                    return self.damaged(counts);
                };
                match field.angle {
                    // It has its time where readings are in order.
                    Some(slot) => readings.angles.push((slot, Angle { at: number, time: 0 })),
                    None => readings.cells.push((*column, Cell::Number(number))),
                }
            }
            Planned::Pose { of: PoseOf::Transform { parent, child }, slot, .. } => {
                return self.transform(parent, child, *slot, counts);
            }
            Planned::Pose { of: PoseOf::Parts { position, orientation }, slot, .. } => {
                let pose = self.parts((position, orientation), reading.is_optional, counts)?;
                readings.poses.push((*slot, pose));
            }
            Planned::Pose { of, slot, .. } => {
                let pose = self.pose(of, reading.is_optional, counts)?;
                readings.poses.push((*slot, pose));
            }
        }
        let time = match &reading.time {
            Some(path) => match path.find(self.message) {
                Found::One(value) => stamp(value),
                _ => None,
            },
            None => return Some((When::Recorded, readings)),
        };
        Some((self.stamped(time, counts)?, readings))
    }

    /// When a message was sent that should have a time of its own [ns]; nothing for a time that no log
    /// has.
    fn stamped(&self, time: Option<f64>, counts: &mut Counts) -> Option<When> {
        let Some(time) = time else {
            // At the log's very start no time is the time.
            if self.log_time == 0 {
                return Some(When::Stamped(0));
            }
            counts.without_stamp += 1;
            return Some(When::Recorded);
        };
        /// Times of logs are below [ns]: 64 bits hold them.
        const LAST: f64 = 9.2e18;
        if time.abs() > LAST {
            counts.outside += 1;
            return None;
        }
        counts.with_stamp += 1;
        // Within the range that was just asked for.
        #[expect(clippy::cast_possible_truncation)]
        Some(When::Stamped(time as i64))
    }

    /// Counts an invalid reading.
    fn damaged<T>(&self, counts: &mut Counts) -> Option<T> {
        *counts.damaged_fields.entry(self.topic.to_owned()).or_default() += 1;
        None
    }

    /// The first of some fields that has a value, and it.
    fn first<'f>(
        &self,
        fields: &'f [NumberField],
        is_optional: bool,
        counts: &mut Counts,
    ) -> Option<(&'f NumberField, &Value)> {
        let mut missing = Found::Nothing;
        for field in fields {
            match field.field.find(self.message) {
                Found::One(value) if !value.is_null() => return Some((field, value)),
                Found::Nothing => {}
                other => missing = other,
            }
        }
        // What is empty is no reading, and nothing to count.
        self.one(missing, is_optional, counts)?;
        None
    }

    fn field(&self, field: &FieldPath, is_optional: bool, counts: &mut Counts) -> Option<&Value> {
        self.one(field.find(self.message), is_optional, counts)
    }

    /// The value that was found; what was not is counted.
    fn one<'v>(
        &self,
        found: Found<'v>,
        is_optional: bool,
        counts: &mut Counts,
    ) -> Option<&'v Value> {
        let count = match found {
            Found::One(value) => return Some(value),
            Found::Nothing if is_optional => return None,
            Found::Nothing => &mut counts.without_field,
            Found::Several => &mut counts.several,
        };
        *count.entry(self.topic.to_owned()).or_default() += 1;
        None
    }

    /// The pose in a field; one that is damaged is counted.
    fn pose(&self, of: &PoseOf, is_optional: bool, counts: &mut Counts) -> Option<Pose> {
        let (PoseOf::Attitude(field) | PoseOf::Pose(field)) = of else { return None };
        let value = self.field(field, is_optional, counts)?;
        if is_gap(value) || self.is_unknown(field) {
            return None;
        }
        let PoseOf::Attitude(_) = of else {
            return Pose::read(value).or_else(|| self.damaged(counts));
        };
        let Some(rotation) = Rotation::read(value) else { return self.damaged(counts) };
        // What a sensor without a filter leaves in the field.
        if rotation == Rotation::NONE {
            *counts.unmeasured.entry(self.topic.to_owned()).or_default() += 1;
            return None;
        }
        Some(Pose { position: None, rotation })
    }

    /// The pose of a position and a quaternion; one that is damaged is counted.
    fn parts(
        &self,
        (position, orientation): (&FieldPath, &FieldPath),
        is_optional: bool,
        counts: &mut Counts,
    ) -> Option<Pose> {
        let position = self.field(position, is_optional, counts)?;
        let orientation = self.field(orientation, is_optional, counts)?;
        if is_gap(position) || is_gap(orientation) {
            return None;
        }
        Pose::of_parts(position, orientation).or_else(|| self.damaged(counts))
    }

    /// Whether a covariance beside the field says that it is not measured, as `sensor_msgs/Imu`
    /// does by −1.
    fn is_unknown(&self, field: &FieldPath) -> bool {
        let beside = field
            .parent(self.message)
            .and_then(|(parent, name)| parent.get(format!("{name}_covariance"))?.get(0)?.as_f64());
        beside == Some(-1.0)
    }

    /// The pose of a frame in another, at the time of the transform that moved it.
    fn transform(
        &self,
        parent: &str,
        child: &str,
        slot: usize,
        counts: &mut Counts,
    ) -> Option<(When, Readings)> {
        let is_between =
            |(frame, _): &&(&str, &Value)| self.frames.is_between(frame, child, parent);
        let (_, moved) = self.moved.iter().rev().find(is_between)?;
        let pose = self.frames.pose(child, parent)?;
        let own = moved.get("timestamp").or_else(|| moved.get("header")?.get("stamp"));
        let time = own.and_then(stamp);
        let readings = Readings { poses: vec![(slot, pose)], ..Readings::default() };
        Some((self.stamped(time, counts)?, readings))
    }
}

/// Whether there is nothing, or all below are gaps, as of a table's empty cells.
fn is_gap(value: &Value) -> bool {
    let is_empty = |it: &serde_json::Map<String, Value>| !it.is_empty() && it.values().all(is_gap);
    value.is_null() || value.as_object().is_some_and(is_empty)
}

/// A number, also one that is written as a text or a truth.
fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.trim().parse().ok(),
        Value::Bool(is_true) => Some(f64::from(u8::from(*is_true))),
        _ => None,
    }
}

/// A time [ns]: seconds with nanoseconds, or seconds; nothing for one that was not set.
pub(crate) fn stamp(value: &Value) -> Option<f64> {
    let part = |names: [&str; 4]| names.into_iter().find_map(|name| value.get(name)?.as_f64());
    let time = if let Some(seconds) = value.as_f64() {
        (seconds * 1e9).round()
    } else {
        let nanoseconds = part(["nanosec", "nsec", "nanos", "nsecs"]).unwrap_or(0.0);
        part(["sec", "seconds", "secs", "s"])? * 1e9 + nanoseconds
    };
    (time != 0.0).then_some(time)
}
