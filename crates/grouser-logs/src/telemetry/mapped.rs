//! Tables whose columns are fields of messages by a mapping: `/odom/pose/pose/position/x`.
//!
//! A row is a message of each topic that has a cell in it. Names of columns are parted by `/`, `.`
//! and brackets, and what ends with `_x`, `_y`, `_z` or `_w` is a part of a vector as well; a topic
//! is what stands before the field that the mapping reads, `/` where nothing does.

use std::collections::BTreeSet;
use std::io::Read;

use grouser_core::vehicle::Rover;
use grouser_io::measurements::telemetry::{Cell, CellReader, NextRow, TelemetryRecord, TimeColumn};
use grouser_io::telemetry_mapping::{FieldPath, Found, PoseOf, Reading, What};
use serde_json::{Map, Value};

use crate::error::{Problem, TelemetryError};
use crate::mapping::Mapping;
use crate::mapping::messages::{MessageRows, stamp};
use crate::mapping::plan::WheelNames;
use crate::mapping::topic::Topic;
use crate::telemetry::options::LogOptions;
use crate::telemetry::parquet::ParquetCells;

/// Parts of a column's name, at most; no message is deeper.
const DEEPEST: usize = 32;

/// Whose units count.
const OWN_UNITS: &str =
    "units stand below the names of the columns, and are not used: the mapping says its own";

/// A table, record by record.
pub(crate) struct MappedTable<R> {
    reader: Rows<R>,
    columns: Columns,
    /// Topics that are read, each with the parts of its name.
    topics: Vec<(String, Vec<String>)>,
    time: Option<TimeColumn>,
    /// Where a message has a time of its own.
    own_time: Option<FieldPath>,
    rows: MessageRows,
    /// What the mapping looks for and the table does not have.
    missing: Option<String>,
    is_read: bool,
}

/// Rows of cells.
pub(crate) enum Rows<R> {
    Csv(Box<CellReader<'static, R>>),
    Parquet(Box<ParquetCells>),
}

/// What comes next of them.
enum Next<'r> {
    /// Cells, and whether rows before them are lost.
    Cells(&'r [Cell], bool),
    Damaged,
    End,
}

impl<R: Read> Rows<R> {
    pub(crate) fn of_csv(label: &str, source: R) -> Result<Self, TelemetryError> {
        Ok(Self::Csv(Box::new(CellReader::new(label.to_owned(), source)?)))
    }

    fn names(&self) -> &[String] {
        match self {
            Self::Csv(reader) => reader.names(),
            Self::Parquet(cells) => cells.names(),
        }
    }

    /// Whether units stand below the names.
    fn has_units(&self) -> bool {
        matches!(self, Self::Csv(reader) if reader.units().is_some())
    }

    fn next_row(&mut self) -> Result<Next<'_>, TelemetryError> {
        Ok(match self {
            Self::Csv(reader) => match reader.next_row()? {
                NextRow::Cells(cells) => Next::Cells(cells, false),
                NextRow::Damaged => Next::Damaged,
                NextRow::End => Next::End,
            },
            Self::Parquet(cells) => match cells.next_row()? {
                Some((cells, has_lost)) => Next::Cells(cells, has_lost),
                None => Next::End,
            },
        })
    }
}

impl<R: Read> MappedTable<R> {
    pub(crate) fn new(
        label: &str,
        reader: Rows<R>,
        mapping: &Mapping,
        rover: &Rover,
        options: &LogOptions,
    ) -> Result<Self, TelemetryError> {
        let columns = Columns::of(reader.names());
        let found = Fitting::of(&columns, mapping, rover);
        let failed = |problem| TelemetryError::new(label, problem);
        let (names, sought) = (reader.names().to_vec(), found.missing);
        if found.topics.is_empty() {
            let mapping = mapping.rules.name.clone();
            let other = Mapping::built_in().find(|other| {
                let found = Fitting::of(&columns, other, rover);
                !found.topics.is_empty() && found.missing.is_empty()
            });
            let other = other.map(|it| it.label);
            return Err(failed(Problem::NoColumnMapped { mapping, sought, columns: names, other }));
        }
        let (time, own_time) = (TimeColumn::of(&names), mapping.rules.time.clone());
        if time.is_none() && own_time.is_none() {
            return Err(failed(Problem::NoTime(names)));
        }
        let missing = (!sought.is_empty()).then(|| {
            let [sought, names] = [&sought, &names].map(|all| some_of(all));
            format!("the mapping looks for {sought}, which no column has; there are {names}")
        });
        let rows = MessageRows::new(label, &found.topics, rover, options)?;
        let topics = found.topics.into_iter().map(|it| (parts(&it.name), it.name));
        let topics = topics.map(|(parts, name)| (name, parts)).collect();
        let is_read = false;
        Ok(Self { reader, columns, topics, time, own_time, rows, missing, is_read })
    }

    pub(crate) fn next_record(&mut self) -> Result<Option<TelemetryRecord>, TelemetryError> {
        loop {
            if let Some(record) = self.rows.next_record() {
                return Ok(Some(record));
            }
            if self.is_read {
                return Ok(None);
            }
            match self.reader.next_row()? {
                Next::Damaged => self.rows.damaged_row(),
                Next::End => {
                    self.is_read = true;
                    self.rows.end();
                }
                Next::Cells(cells, has_lost) => {
                    if has_lost {
                        self.rows.lose_way();
                    }
                    let tree = self.columns.tree(cells);
                    let time = self.time.and_then(|it| it.seconds(cells)).map(|it| it * 1e9);
                    self.add(time, &tree);
                }
            }
        }
    }

    /// Adds a row.
    ///
    /// * `time`: by the table's column [ns]
    fn add(&mut self, time: Option<f64>, tree: &Value) {
        let messages = self.topics.iter().filter_map(|(name, parts)| {
            let message = within(tree, parts)?;
            has_cell(message).then_some((name, message))
        });
        let messages: Vec<(&String, &Value)> = messages.collect();
        let own = |message: &Value| match self.own_time.as_ref()?.find(message) {
            Found::One(value) => stamp(value),
            _ => None,
        };
        let time = time.or_else(|| messages.iter().find_map(|(_, message)| own(message)));
        /// Times of logs are below [ns]: 64 bits hold them.
        const LAST: f64 = 9.2e18;
        let Some(time) = time.filter(|time| time.abs() < LAST) else {
            return self.rows.row_without_time();
        };
        // Within the range that was just asked for.
        #[expect(clippy::cast_possible_truncation)]
        let time = time.round() as i64;
        for (topic, message) in messages {
            self.rows.add(topic, time, message);
        }
    }

    pub(crate) fn messages(&self) -> &MessageRows {
        &self.rows
    }

    /// The file of Parquet that it is, if it is one.
    pub(crate) fn parquet(&self) -> Option<&ParquetCells> {
        match &self.reader {
            Rows::Csv(_) => None,
            Rows::Parquet(cells) => Some(cells),
        }
    }

    pub(crate) fn notes(&self) -> Vec<String> {
        let of_file = self.parquet().map(ParquetCells::notes).into_iter().flatten();
        let units = self.reader.has_units().then(|| OWN_UNITS.to_owned());
        of_file.chain(self.rows.notes()).chain(self.missing.clone()).chain(units).collect()
    }
}

/// As many names as a sentence bears.
fn some_of(names: &[String]) -> String {
    const MOST: usize = 12;
    let more = names.len().saturating_sub(MOST);
    let more = if more == 0 { String::new() } else { format!(" and {more} more") };
    names.get(..MOST).unwrap_or(names).join(", ") + &more
}

/// The parts of a name; more than a message is deep are none.
fn parts(name: &str) -> Vec<String> {
    let parts = name.split(['/', '.', '[', ']']).map(str::trim).filter(|part| !part.is_empty());
    let parts: Vec<String> = parts.map(str::to_owned).collect();
    if parts.len() <= DEEPEST { parts } else { Vec::new() }
}

/// What stands below some names.
fn within<'v>(tree: &'v Value, parts: &[String]) -> Option<&'v Value> {
    parts.iter().try_fold(tree, |tree, part| tree.get(part))
}

/// Whether anything below is a number, or should be.
fn has_cell(tree: &Value) -> bool {
    match tree {
        Value::Object(children) => children.values().any(has_cell),
        leaf => !leaf.is_null(),
    }
}

/// Where cells go in the tree of a row: for each column one path or two.
struct Columns(Vec<Vec<Vec<String>>>);

impl Columns {
    fn of(names: &[String]) -> Self {
        let paths = |name: &String| {
            let path = parts(name);
            let ends = ["_x", "_y", "_z", "_w"];
            let vector = path.split_last().and_then(|(last, before)| {
                let end = ends.iter().find(|end| last.len() > 2 && last.ends_with(**end))?;
                let part = [last.strip_suffix(end)?, &end[1..]].map(str::to_owned);
                Some([before, &part].concat())
            });
            [path].into_iter().filter(|it| !it.is_empty()).chain(vector).collect()
        };
        Self(names.iter().map(paths).collect())
    }

    /// The cells of a row as a tree; gaps are null.
    fn tree(&self, cells: &[Cell]) -> Value {
        let mut tree = Value::Object(Map::new());
        for (paths, cell) in self.0.iter().zip(cells) {
            let value = match cell {
                Cell::Gap => Value::Null,
                Cell::Number(number) => (*number).into(),
                // What is no number is none wherever it is read.
                Cell::Damaged => Value::String(String::new()),
            };
            for path in paths {
                put(&mut tree, path, &value);
            }
        }
        tree
    }

    /// What can stand before a field, what holds others first.
    fn nodes(&self) -> BTreeSet<&[String]> {
        let paths = self.0.iter().flatten();
        paths.flat_map(|path| (0..path.len()).map(|end| &path[..end])).collect()
    }
}

/// Puts a value into a tree, unless there is one.
fn put(tree: &mut Value, path: &[String], value: &Value) {
    let Some((last, before)) = path.split_last() else { return };
    let mut here = tree;
    for part in before {
        let Value::Object(children) = here else { return };
        here = children.entry(part.as_str()).or_insert_with(|| Value::Object(Map::new()));
    }
    if let Value::Object(children) = here {
        children.entry(last.as_str()).or_insert_with(|| value.clone());
    }
}

/// What of a mapping fits the columns.
struct Fitting {
    topics: Vec<Topic>,
    /// Readings that may not be missing and are.
    missing: Vec<String>,
}

impl Fitting {
    fn of(columns: &Columns, mapping: &Mapping, rover: &Rover) -> Self {
        let tree = columns.tree(&vec![Cell::Number(0.0); columns.0.len()]);
        let wheels: Vec<WheelNames> = rover.mounts().iter().map(WheelNames::of).collect();
        let mut readings: Vec<(&Reading, bool)> =
            mapping.rules.readings.iter().map(|it| (it, false)).collect();
        let (mut topics, mut known): (Vec<Topic>, Vec<&[String]>) = (Vec::new(), Vec::new());
        for node in columns.nodes() {
            let Some(below) = within(&tree, node) else { continue };
            let name = format!("/{}", node.join("/"));
            // A pose within a message is no message, unless its topic is named.
            let is_part = known.iter().any(|it| !it.is_empty() && node.starts_with(it));
            if let Some(message) = message_at((&name, below), is_part, &mut readings, &wheels) {
                topics.push(Topic { name, message, encoding: None });
                known.push(node);
            }
        }
        let missing = readings.iter().filter(|(reading, fits)| !fits && !reading.is_optional);
        Self { topics, missing: missing.map(|(reading, _)| sought(reading)).collect() }
    }
}

/// The type of the messages of a topic, empty where no reading asks for one; nothing where none
/// reads of them. Readings that do are marked.
fn message_at(
    (name, below): (&str, &Value),
    is_part: bool,
    readings: &mut [(&Reading, bool)],
    wheels: &[WheelNames],
) -> Option<String> {
    let any = [WheelNames::any()];
    let mut found: Option<String> = None;
    for (reading, fits) in readings {
        let message = reading.message.clone().unwrap_or_default();
        let wheels = if reading.is_of_wheels() { wheels } else { &any };
        let mut wheels = wheels.iter();
        let reads =
            wheels.any(|it| it.is_read(reading, name, &message) && has_field(reading, it, below));
        // Messages have one type, that of the first reading that asks for one.
        let is_other = found
            .as_ref()
            .is_some_and(|known| !known.is_empty() && !message.is_empty() && *known != message);
        if !reads || is_other || (is_part && reading.topic.is_none()) {
            continue;
        }
        *fits = true;
        found = found.filter(|known| !known.is_empty()).or(Some(message));
    }
    found
}

/// Whether the field of a reading is among those of a message.
fn has_field(reading: &Reading, wheel: &WheelNames, message: &Value) -> bool {
    let at = |path: &FieldPath| match path.find(message) {
        Found::One(value) => Some(value),
        _ => None,
    };
    let has_turn = |value: &Value| value.get("w").is_some();
    match &reading.what {
        What::Number { field, .. } => {
            let mut paths = wheel.paths(field).into_iter();
            paths.any(|path| {
                let path = FieldPath::parse(&path);
                path.is_some_and(|path| at(&path).is_some_and(|value| !value.is_object()))
            })
        }
        What::Pose { of: PoseOf::Attitude(path), .. } => at(path).is_some_and(has_turn),
        What::Pose { of: PoseOf::Pose(path), .. } => {
            let turn = |it: &Value| it.get("orientation").or_else(|| it.get("rotation")).cloned();
            at(path).and_then(turn).is_some_and(|it| has_turn(&it))
        }
        What::Pose { of: PoseOf::Parts { position, orientation }, .. } => {
            at(position).is_some() && at(orientation).is_some_and(has_turn)
        }
        // No table has frames by their names.
        What::Pose { of: PoseOf::Transform { .. }, .. } => false,
    }
}

/// What a reading looks for, as messages have it.
fn sought(reading: &Reading) -> String {
    let what = match &reading.what {
        What::Number { field, .. } => format!("`{field}`"),
        What::Pose { .. } => "a pose".to_owned(),
    };
    format!("{what} of {}", reading.selector())
}
