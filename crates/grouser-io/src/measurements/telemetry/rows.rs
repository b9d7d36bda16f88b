//! Rows of telemetry from a source of any kind: names of columns become a header, cells become
//! records in SI, and what is damaged is counted.
//!
//! Ways and rotations are since the row before. A row that is left out hands its own on to the next
//! record, or marks that one's as incomplete: as no way at all they would be slip.

use std::iter;

use grouser_core::vehicle::Rover;

use super::super::super::check::nearest;
use super::super::super::columns::{TIME, X, Y};
use super::super::super::given_file::{FileContent, GivenFile};
use super::super::super::reading::four_digits;
use super::super::error::{MeasurementError, MeasurementProblem as Problem};
use super::super::log_column::LogColumn;
use super::cell::Cell;
use super::clock::{OTHER_TIMES, TimeUnit};
use super::frozen::Frozen;
use super::sides::Sides;
use super::units::{OfUnit, column_in};
use super::{
    COLUMNS, FORWARD, LEFTWARD, Lost, OF_ROVER, OF_WHEEL, OTHER_NAMES, Odometry, ROTATION,
    TelemetryRecord, WheelTelemetry,
};

/// Rows with named columns, which become records in the order in which they come.
#[derive(Clone, Debug)]
pub struct TelemetryRows {
    header: Header,
    odometry: Odometry,
    frozen: Frozen,
    last: Option<TelemetryRecord>,
    /// What rows moved that were left out since the last record.
    carried: Moved,
    /// The unit of times, once one was read.
    time_unit: Option<TimeUnit>,
    rows: u64,
    lost: Lost,
    times: Times,
    sides: Sides,
}

/// How times follow each other.
#[derive(Clone, Copy, Debug, Default)]
struct Times {
    /// The time of the row before [s].
    last: Option<f64>,
    /// Rows with a time before that of the row before them.
    backward: u64,
    /// Rows with the time of the row before, whose ways belong to the next record.
    joined: u64,
    /// The least that times of records are apart [s].
    step: Option<f64>,
}

/// How far a rover moved over some rows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Moved {
    /// Forward, leftward [m] and by rotation [rad], where something was read.
    by: [Option<f64>; 3],
    /// Whether some of it is not known.
    is_incomplete: bool,
}

impl Moved {
    fn of(record: &TelemetryRecord) -> Self {
        let [forward, leftward] = record.displacement;
        Self { by: [forward, leftward, record.rotation], is_incomplete: record.is_way_incomplete }
    }

    /// Over two rows, one after the other.
    fn and(self, other: Self) -> Self {
        let sum = |one: Option<f64>, other: Option<f64>| match (one, other) {
            (Some(one), Some(other)) => Some(one + other),
            (one, other) => one.or(other),
        };
        let by = [0, 1, 2].map(|place| sum(self.by[place], other.by[place]));
        Self { by, is_incomplete: self.is_incomplete || other.is_incomplete }
    }

    fn give_to(self, record: &mut TelemetryRecord) {
        let [forward, leftward, rotation] = self.by;
        record.displacement = [forward, leftward];
        record.rotation = rotation;
        record.is_way_incomplete = self.is_incomplete;
    }
}

impl TelemetryRows {
    /// Understands the names of the columns.
    ///
    /// * `label`: what messages call the source
    /// * `rover`: the rover that was driven, for the names of its wheels
    ///
    /// # Errors
    /// [`MeasurementError`] for columns without the time, with a column twice, or with the column
    /// of a wheel that the rover does not have.
    pub fn new(label: &str, names: &[String], rover: &Rover) -> Result<Self, MeasurementError> {
        Self::in_units(label, names, &[], rover)
    }

    /// The header of a table with the units below its names; none where a table has no such row.
    pub(super) fn in_units(
        label: &str,
        names: &[String],
        units: &[String],
        rover: &Rover,
    ) -> Result<Self, MeasurementError> {
        let header = Header::new(label, names, units, rover)?;
        let (carried, lost) = (Moved::default(), Lost::default());
        let time_unit = header.time_unit;
        let odometry = Odometry::Visual;
        let columns = header.columns.iter().map(|it| it.as_ref().map(|it| it.column));
        let frozen = Frozen::of(columns);
        let (last, times, sides) = (None, Times::default(), Sides::of(rover));
        Ok(Self { header, odometry, frozen, last, carried, time_unit, rows: 0, lost, times, sides })
    }

    /// The same, gone on with after the record of a time: rows that do not come after it are out of
    /// order.
    #[must_use]
    pub fn after(self, last_time: Option<f64>) -> Self {
        let last = last_time.map(|time| TelemetryRecord { time, ..TelemetryRecord::default() });
        Self { last, ..self }
    }

    /// The same with ways and rotations that were measured in some way; without it by cameras, as
    /// the names of the columns say. What wheels measure is left out.
    #[must_use]
    pub fn measured_by(self, odometry: Odometry) -> Self {
        Self { odometry, ..self }
    }

    /// A sentence on how ways were measured, where they may not be the rover's.
    #[must_use]
    pub fn sentence_of_odometry(&self) -> Option<String> {
        let is_of_motion =
            |it: &LogColumn| is_of_way(it) || [X, Y].iter().any(|xy| xy.name == it.name);
        let has_way = self.header.columns.iter().flatten().any(|it| is_of_motion(it.column));
        self.odometry.sentence().filter(|_| has_way).map(str::to_owned)
    }

    /// Whether the column at a place is known, and so is read.
    #[must_use]
    pub fn is_used(&self, place: usize) -> bool {
        self.header.columns.get(place).is_some_and(Option::is_some)
    }

    /// Columns that are not known, and left aside.
    #[must_use]
    pub fn unused(&self) -> &[String] {
        &self.header.unused
    }

    /// A sentence with these columns, as many as it bears; nothing where all are known.
    #[must_use]
    pub fn sentence_of_unused(&self) -> Option<String> {
        const MOST: usize = 6;
        let names = self.unused();
        let more = names.len().saturating_sub(MOST);
        let more = if more == 0 { String::new() } else { format!(" and {more} more") };
        let first = names.get(..MOST).unwrap_or(names).join(", ");
        (!names.is_empty()).then(|| format!("columns not used: {first}{more}"))
    }

    /// A sentence with the unit of times, where that is not what the column's name says.
    #[must_use]
    pub fn sentence_of_time(&self) -> Option<String> {
        let unit = self.time_unit.filter(|it| Some(*it) != self.header.time_unit)?;
        let name = &self.header.time_name;
        let is_seconds = unit == TimeUnit::Seconds;
        (!is_seconds || *name != TIME.name)
            .then(|| format!("times of `{name}` are read as {}", unit.name()))
    }

    /// A sentence on times that are rounded, or that run backward; nothing where each row has its
    /// own, after that of the row before.
    #[must_use]
    pub fn sentence_of_times(&self) -> Option<String> {
        let Times { backward, joined, step, .. } = self.times;
        let name = &self.header.time_name;
        let (rows, out_of_order) = (self.rows, self.lost.rows_out_of_order);
        // Rows that leap back once go on forward from there.
        if backward > 2 && 10 * backward >= 9 * out_of_order {
            return Some(format!(
                "times of `{name}` run backward, in {backward} of {rows} rows, as in a file that is \
                 sorted newest first: sort its rows by `{name}`"
            ));
        }
        let step = step.map_or_else(String::new, |it| format!(" to {} s", four_digits(it)));
        (joined > 0).then(|| {
            format!(
                "{joined} of {rows} rows have the time of the row before, as where times are rounded\
                 {step}: their ways are added to those of the next record"
            )
        })
    }

    /// A sentence on wheels of one side that turn backward on a way ahead.
    #[must_use]
    pub fn sentence_of_sides(&self) -> Option<String> {
        self.sides.sentence()
    }

    /// How many rows were read so far.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// What the rows so far gave; those that became records count.
    ///
    /// * `file`: its name
    #[must_use]
    pub fn given(&self, file: &str) -> GivenFile {
        let Lost { damaged_rows, rows_without_time, rows_out_of_order, .. } = self.lost;
        let used = self.rows - rows_without_time - rows_out_of_order;
        GivenFile::new(file, FileContent::Telemetry, self.rows + damaged_rows, used)
    }

    /// The share of all rows that became records so far; 1 before the first row.
    #[must_use]
    pub fn share_used(&self) -> f64 {
        let GivenFile { there, used, .. } = self.given("");
        if there == 0 { 1.0 } else { used as f64 / there as f64 }
    }

    /// What was lost so far.
    #[must_use]
    pub fn lost(&self) -> &Lost {
        &self.lost
    }

    /// Counts a row that cannot be read.
    pub fn damaged_row(&mut self) {
        self.lost.damaged_rows += 1;
        self.lose_way();
    }

    /// Counts a row that has no time.
    pub fn row_without_time(&mut self) {
        self.rows += 1;
        self.lost.rows_without_time += 1;
        self.lose_way();
    }

    /// Ways that belong to the next record are not known.
    pub fn lose_way(&mut self) {
        self.carried.is_incomplete = true;
    }

    /// The record of a row; nothing if it has no time of its own, which is counted.
    ///
    /// * `cells`: in the order of the columns
    pub fn record(&mut self, cells: impl Iterator<Item = Cell>) -> Option<TelemetryRecord> {
        self.rows += 1;
        let seen = (&mut self.lost, &mut self.frozen, &mut self.time_unit);
        let (time, mut record) = self.header.record(cells, seen);
        self.lost.rows_without_torque += u64::from(record.leave_out_zero_torques());
        self.sides.see(&record);
        if self.odometry == Odometry::Wheels {
            record.leave_out_motion();
        }
        let moved = self.carried.and(Moved::of(&record));
        let Some(time) = time else {
            self.lost.rows_without_time += 1;
            self.carried = moved;
            return None;
        };
        record.time = time;
        let is_backward = self.times.last.replace(time).is_some_and(|last| time < last);
        self.times.backward += u64::from(is_backward);
        if let Some(last) = self.last.as_ref().filter(|last| time <= last.time) {
            // A row of the same time as the last belongs to the way after it, where times were
            // rounded; one that comes too late, or twice, belongs nobody knows where.
            let is_next = time == last.time && record != *last;
            if is_next {
                self.times.joined += 1;
                self.carried = moved;
            } else {
                self.lost.rows_out_of_order += 1;
                self.carried.is_incomplete = true;
            }
            return None;
        }
        let since = self.last.as_ref().map(|last| time - last.time);
        self.times.step = [self.times.step, since].into_iter().flatten().reduce(f64::min);
        self.last = Some(record.clone());
        moved.give_to(&mut record);
        // What is incomplete stays so until a way is read.
        let has_way = moved.by.iter().any(Option::is_some);
        let is_incomplete = moved.is_incomplete && !has_way;
        self.carried = Moved { is_incomplete, ..Moved::default() };
        Some(record)
    }
}

/// Where a number goes in a record.
#[derive(Clone, Copy, Debug)]
enum Place {
    Time,
    Rover(fn(&mut TelemetryRecord) -> &mut Option<f64>),
    Wheel(usize, fn(&mut WheelTelemetry) -> &mut Option<f64>),
}

impl Place {
    /// * `wheel`: its place among the rover's, of a column of wheels
    fn of(column: &LogColumn, wheel: Option<usize>) -> Option<Self> {
        match wheel {
            Some(wheel) => {
                let (_, field) = OF_WHEEL.iter().find(|(it, _)| it.name == column.name)?;
                Some(Self::Wheel(wheel, *field))
            }
            None if column.name == TIME.name => Some(Self::Time),
            None => {
                let (_, field) = OF_ROVER.iter().find(|(it, _)| it.name == column.name)?;
                Some(Self::Rover(*field))
            }
        }
    }
}

/// A column that is known.
#[derive(Clone, Debug)]
struct KnownColumn {
    /// What the source calls it.
    name: String,
    column: &'static LogColumn,
    wheel: Option<usize>,
    place: Place,
    /// What a number is of one in the column's unit [-].
    factor: f64,
}

/// The header, understood.
#[derive(Clone, Debug)]
struct Header {
    columns: Vec<Option<KnownColumn>>,
    unused: Vec<String>,
    wheels: usize,
    /// What the source calls the time, and its unit, where the name says it.
    time_name: String,
    time_unit: Option<TimeUnit>,
}

impl Header {
    fn new(
        label: &str,
        names: &[String],
        units: &[String],
        rover: &Rover,
    ) -> Result<Self, MeasurementError> {
        if names.iter().all(String::is_empty) {
            return Err(MeasurementError::whole(label, Problem::NoHeader));
        }
        let wheels: Vec<&str> = rover.mounts().iter().map(|mount| mount.name.as_str()).collect();
        let units = units.iter().map(String::as_str).chain(iter::repeat(""));
        let columns = names.iter().zip(units).map(|(name, unit)| {
            let own = known(name, &wheels).ok().flatten();
            let own = COLUMNS.iter().find(|it| own.is_some_and(|(name, _)| name == it.name));
            column_in(name, unit, own).map_err(|why| MeasurementError::at(label, 2, why))
        });
        let columns = columns.collect::<Result<Vec<_>, _>>()?;
        let names: Vec<String> = columns.iter().map(|it| it.name.clone()).collect();
        let (time_name, time_unit) = time_of(&names);
        let mut header = Self {
            columns: Vec::new(),
            unused: Vec::new(),
            wheels: wheels.len(),
            time_name,
            time_unit,
        };
        for column in columns {
            header.add(label, column, &wheels)?;
        }
        let known = || header.columns.iter().flatten();
        if known().any(|known| known.column.name == TIME.name) {
            return match known().nth(1) {
                Some(_) => Ok(header),
                None => Err(MeasurementError::at(label, 1, header.nothing_known())),
            };
        }
        let near = header.unused.iter().find(|name| nearest(name, [TIME.name]).is_some());
        let hint = near.map(|name| format!("is `{name}` meant as `{}`?", TIME.name));
        let expected = format!("`{}`", TIME.name);
        let problem = Problem::MissingColumn { what: "the time", expected };
        Err(MeasurementError::at(label, 1, problem).with_hint(hint))
    }

    fn nothing_known(&self) -> Problem {
        let sought = COLUMNS.iter().map(|it| it.name).filter(|name| *name != TIME.name);
        Problem::NoKnownColumn { there: self.unused.clone(), sought: sought.collect() }
    }

    fn add(
        &mut self,
        label: &str,
        OfUnit { name, factor }: OfUnit,
        wheels: &[&str],
    ) -> Result<(), MeasurementError> {
        let failed = |problem| MeasurementError::at(label, 1, problem);
        let is_time = name == self.time_name;
        let known = if is_time { Ok(Some((TIME.name, None))) } else { known(&name, wheels) };
        let known = known.map_err(|wheel| {
            let all = wheels.iter().map(|it| (*it).to_owned()).collect();
            let hint = nearest(&wheel, wheels.iter().copied());
            failed(Problem::UnknownWheel { name: wheel, wheels: all })
                .with_hint(hint.map(|meant| format!("did you mean `{meant}`?")))
        })?;
        let mut others = self.columns.iter().flatten();
        let rival = others.find(|other| known == Some((other.column.name, other.wheel)));
        if let Some(rival) = rival {
            return Err(failed(if rival.name == name {
                Problem::RepeatedColumn(name)
            } else {
                Problem::CompetingColumns(rival.name.clone(), name)
            }));
        }
        let found = known.and_then(|(column, wheel)| {
            let column = COLUMNS.iter().find(|it| it.name == column)?;
            let place = Place::of(column, wheel)?;
            Some(KnownColumn { name: name.clone(), column, wheel, place, factor })
        });
        if found.is_none() && !name.is_empty() {
            self.unused.push(name);
        }
        self.columns.push(found);
        Ok(())
    }

    /// A row in SI with its time, if it has one; the record's own is not set.
    fn record(
        &self,
        cells: impl Iterator<Item = Cell>,
        (lost, frozen, time_unit): (&mut Lost, &mut Frozen, &mut Option<TimeUnit>),
    ) -> (Option<f64>, TelemetryRecord) {
        let mut time = None;
        let mut record = TelemetryRecord {
            wheels: vec![WheelTelemetry::default(); self.wheels],
            ..TelemetryRecord::default()
        };
        for (place, (known, cell)) in self.columns.iter().zip(cells).enumerate() {
            let (Some(known), false) = (known, cell == Cell::Gap) else { continue };
            let is_time = matches!(known.place, Place::Time);
            let cell = if is_time { in_seconds(cell, self.time_unit, time_unit) } else { cell };
            let number = match cell.times(known.factor) {
                Cell::Number(number) if known.column.range.contains(&number) => number,
                _ => {
                    lost.cell(&known.name);
                    record.is_way_incomplete |= is_of_way(known.column);
                    continue;
                }
            };
            if frozen.is_frozen_with(place, number) {
                *lost.frozen.entry(known.name.clone()).or_default() += 1;
                record.is_way_incomplete |= is_of_way(known.column);
                continue;
            }
            let value = Some(known.column.unit.to_si(number));
            match known.place {
                Place::Time => time = value,
                Place::Rover(field) => *field(&mut record) = value,
                Place::Wheel(wheel, field) => *field(&mut record.wheels[wheel]) = value,
            }
        }
        (time, record)
    }
}

/// The column of a table that has the time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimeColumn {
    place: usize,
    unit: Option<TimeUnit>,
}

impl TimeColumn {
    /// The column by its name among all, if there is one.
    #[must_use]
    pub fn of(names: &[String]) -> Option<Self> {
        let (name, unit) = time_of(names);
        let place = names.iter().position(|it| *it == name)?;
        Some(Self { place, unit })
    }

    /// Its place among all columns.
    #[must_use]
    pub(super) fn place(self) -> usize {
        self.place
    }

    /// The time of a row [s]; nothing where there is none.
    #[must_use]
    pub fn seconds(&self, cells: &[Cell]) -> Option<f64> {
        match in_seconds(*cells.get(self.place)?, self.unit, &mut None) {
            Cell::Number(time) => Some(time),
            Cell::Gap | Cell::Damaged => None,
        }
    }
}

/// A time in seconds. Without a unit in the column's name each number says it, so that a damaged one
/// changes no other.
///
/// * `unit`: of the last time
fn in_seconds(cell: Cell, of_name: Option<TimeUnit>, unit: &mut Option<TimeUnit>) -> Cell {
    let Cell::Number(time) = cell else { return cell };
    let found = of_name.unwrap_or_else(|| TimeUnit::of(time));
    *unit = Some(found);
    Cell::Number(time / found.per_second())
}

/// The column of the time among all, and its unit, where the name says it: `time_s` may be in
/// another than it says.
fn time_of(names: &[String]) -> (String, Option<TimeUnit>) {
    let own = (TIME.name, None);
    let all = std::iter::once(own).chain(OTHER_TIMES);
    let found = all.into_iter().find(|(name, _)| names.iter().any(|it| it == name));
    let (name, unit) = found.unwrap_or(own);
    (name.to_owned(), unit)
}

/// Whether a column has a way, or a rotation, since the row before.
fn is_of_way(column: &LogColumn) -> bool {
    [FORWARD, LEFTWARD, ROTATION].iter().any(|it| it.name == column.name)
}

/// The column and the wheel of a name; nothing for one that is not known.
///
/// # Errors
/// The wheel's name, where the column is a wheel's and the rover has no such wheel.
fn known(name: &str, wheels: &[&str]) -> Result<Option<(&'static str, Option<usize>)>, String> {
    let of_rover = COLUMNS.iter().find(|column| !column.is_of_wheel && column.name == name);
    if let Some(column) = of_rover {
        return Ok(Some((column.name, None)));
    }
    let of_wheels = COLUMNS.iter().filter(|column| column.is_of_wheel).map(|it| (it.name, it.name));
    let others = OTHER_NAMES.iter().map(|(other, own)| (other.name, own.name));
    for (written, own) in of_wheels.chain(others) {
        let before = name.strip_suffix(written).and_then(|rest| rest.strip_suffix('.'));
        let after = name.strip_prefix(written).and_then(|rest| rest.strip_prefix('_'));
        let Some(wheel) = before.or(after).filter(|wheel| !wheel.is_empty()) else { continue };
        let place = wheels.iter().position(|known| is_same_wheel(known, wheel));
        return place.map(|place| Some((own, Some(place)))).ok_or_else(|| wheel.to_owned());
    }
    Ok(None)
}

/// Whether two names of a wheel are one: capitals, and what parts words, do not count.
#[must_use]
pub fn is_same_wheel(one: &str, other: &str) -> bool {
    let plain = |name: &str| name.to_ascii_lowercase().replace(['-', ' ', '.'], "_");
    plain(one) == plain(other)
}
