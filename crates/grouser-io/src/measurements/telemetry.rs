//! Reads telemetry of a drive, `telemetry/1`, row by row: what a rover's instruments said over
//! time.
//!
//! A table has a row for each time and columns of [`COLUMNS`], all but the time optional and in any
//! order; the column of a wheel ends with its name (`wheel_speed_rad_s_front-left`) or begins with
//! it, as those of runs do (`front-left.wheel_speed_rad_s`). An empty cell is a gap. Displacement
//! and rotation by visual odometry are those since the last row that has one.
//!
//! Telemetry is damaged telemetry: a cell that is no number, or out of its range, is a gap, and a
//! row without a time of its own is left out. [`Lost`] counts all of that. Memory does not grow
//! with the length of the log.

mod cell;
mod clock;
mod frozen;
mod odometry;
mod reader;
mod rows;
mod sides;
mod units;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::RangeInclusive;

use grouser_core::vehicle::Rover;

use super::super::columns::{
    CURRENT, PITCH, Quantity, ROLL, SINKAGE, STEERING, TIME, TORQUE, WHEEL_SPEED, X, Y, YAW,
    quantity,
};
use super::super::reading::counted;
use super::super::unit::{A, DEG, M, NM};
use super::log_column::{LogColumn, column};
pub use cell::Cell;
pub use clock::{TimeUnit, day_of};
pub use odometry::Odometry;
pub use reader::{CellReader, NextRow, TelemetryReader};
pub use rows::{TelemetryRows, TimeColumn, is_same_wheel};

/// Way along the body's x since the last one, by visual odometry.
pub const FORWARD: Quantity = quantity("vo_dx_m", M);
/// Way to its left.
pub const LEFTWARD: Quantity = quantity("vo_dy_m", M);
/// Rotation to the left.
pub const ROTATION: Quantity = quantity("vo_dyaw_deg", DEG);
/// Torque on a wheel.
pub const WHEEL_TORQUE: Quantity = quantity("wheel_torque_nm", NM);
/// Current of a wheel's motor.
pub const MOTOR_CURRENT: Quantity = quantity("motor_current_a", A);

const ANGLE: RangeInclusive<f64> = -90.0..=90.0;
const TURN: RangeInclusive<f64> = -360.0..=360.0;
const WAY: RangeInclusive<f64> = -1e3..=1e3;
const PLACE: RangeInclusive<f64> = -1e7..=1e7;

/// Every column that is known.
pub const COLUMNS: [LogColumn; 14] = [
    column(TIME, false, "time, which rises from row to row", -1e12..=1e12),
    column(ROLL, false, "roll of the body, positive with its right side down", ANGLE),
    column(PITCH, false, "pitch of the body, positive with its nose up", ANGLE),
    column(YAW, false, "yaw from the contour, positive uphill, on a plane", TURN),
    column(FORWARD, false, "way since the last one along the body's x, by visual odometry", WAY),
    column(LEFTWARD, false, "way since the last one to the body's left", WAY),
    column(ROTATION, false, "rotation since the last one, positive to the left", TURN),
    column(X, false, "position along the contour, from a fix", PLACE),
    column(Y, false, "position uphill, from a fix", PLACE),
    column(WHEEL_SPEED, true, "angular speed of the wheel, negative backward", -1e4..=1e4),
    column(WHEEL_TORQUE, true, "torque on the wheel", -1e5..=1e5),
    column(MOTOR_CURRENT, true, "current of its motor, in place of a torque", -1e5..=1e5),
    column(STEERING, true, "steering angle, positive to the left", -180.0..=180.0),
    column(SINKAGE, true, "sinkage, as a camera sees it", 0.0..=1e4),
];

/// What other tables call some of them: those of runs.
const OTHER_NAMES: [(Quantity, Quantity); 2] = [(TORQUE, WHEEL_TORQUE), (CURRENT, MOTOR_CURRENT)];

/// What a rover's instruments said at one time, in SI units; gaps are `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TelemetryRecord {
    /// Time [s].
    pub time: f64,
    /// Roll [rad], positive with the right side down.
    pub roll: Option<f64>,
    /// Pitch [rad], positive with the nose up.
    pub pitch: Option<f64>,
    /// Yaw, *γ* [rad], from the contour, positive uphill.
    pub yaw: Option<f64>,
    /// Way since the last record that has one, along the body and to its left [m].
    pub displacement: [Option<f64>; 2],
    /// Rotation since the last record that has one [rad].
    pub rotation: Option<f64>,
    /// Whether ways and rotation may lack some since the last record: a row between could not be
    /// read. They tell no velocity.
    pub is_way_incomplete: bool,
    /// Position along the contour and uphill [m].
    pub position: [Option<f64>; 2],
    /// Telemetry of each wheel, in the order of the rover's mounts.
    pub wheels: Vec<WheelTelemetry>,
}

/// What was read of one wheel, in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelTelemetry {
    /// Angular speed, *ω* [rad/s].
    pub speed: Option<f64>,
    /// Torque, *T* [N·m].
    pub torque: Option<f64>,
    /// Current of the motor, *i* [A].
    pub current: Option<f64>,
    /// Steering angle, *δ* [rad].
    pub steering: Option<f64>,
    /// Sinkage [m].
    pub sinkage: Option<f64>,
}

/// What a reader left out.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lost {
    /// Rows that are no rows of the table: too few or too many cells, or no text.
    pub damaged_rows: u64,
    /// Rows without a time.
    pub rows_without_time: u64,
    /// Rows whose time does not come after that of the row before.
    pub rows_out_of_order: u64,
    /// Rows in which the torques, or the currents, of all wheels are exactly 0 while they turn.
    pub rows_without_torque: u64,
    /// Cells that stay exactly the same while others of their kind change, by column.
    pub frozen: BTreeMap<String, u64>,
    /// Cells that are no numbers, or out of their ranges, by column.
    pub cells: BTreeMap<String, u64>,
}

impl Lost {
    /// Whether nothing was lost.
    #[must_use]
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }

    /// Counts a cell of a column that is no number within its range.
    fn cell(&mut self, column: &str) {
        if let Some(count) = self.cells.get_mut(column) {
            *count += 1;
        } else {
            self.cells.insert(column.to_owned(), 1);
        }
    }

    /// What was lost together with something else.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        self.combined(other, |one, other| one + other)
    }

    /// What was lost since an earlier time.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> Self {
        self.combined(earlier, u64::saturating_sub)
    }

    fn combined(&self, other: &Self, both: fn(u64, u64) -> u64) -> Self {
        let by_column = |one: &BTreeMap<String, u64>, other: &BTreeMap<String, u64>| {
            let of =
                |it: &BTreeMap<String, u64>, column: &str| it.get(column).copied().unwrap_or(0);
            let columns = one.keys().chain(other.keys());
            let all = columns.map(|it| (it.clone(), both(of(one, it), of(other, it))));
            all.filter(|(_, count)| *count > 0).collect()
        };
        Self {
            damaged_rows: both(self.damaged_rows, other.damaged_rows),
            rows_without_time: both(self.rows_without_time, other.rows_without_time),
            rows_out_of_order: both(self.rows_out_of_order, other.rows_out_of_order),
            rows_without_torque: both(self.rows_without_torque, other.rows_without_torque),
            frozen: by_column(&self.frozen, &other.frozen),
            cells: by_column(&self.cells, &other.cells),
        }
    }

    /// A sentence for each kind of loss.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let rows = [
            (self.damaged_rows, "with another number of cells than the header, or no text"),
            (self.rows_without_time, "without a time"),
            (self.rows_out_of_order, "whose time is not after that of the row before"),
        ];
        let rows = rows.into_iter().filter(|(count, _)| *count > 0);
        let rows = rows.map(|(count, why)| match count {
            1 => format!("1 row {why} is left out"),
            _ => format!("{count} rows {why} are left out"),
        });
        let cells = self.cells.iter().map(|(column, count)| match count {
            1 => format!("1 cell of `{column}` is no number within its range, and counts as a gap"),
            _ => format!(
                "{count} cells of `{column}` are no numbers within its range, and count as gaps"
            ),
        });
        let frozen = self.frozen.iter().map(|(column, count)| {
            let cells = counted(*count, "cell", "cells");
            format!(
                "{cells} of `{column}` in a row have exactly one value while others of their kind \
                 change, as those of a frozen channel, and count as gaps"
            )
        });
        let torques = (self.rows_without_torque > 0).then(|| {
            let rows = counted(self.rows_without_torque, "row has", "rows have");
            format!(
                "{rows} torques, or currents, of exactly 0 on all wheels while they turn, which no \
                 sensor measures, and which count as gaps"
            )
        });
        rows.chain(cells).chain(frozen).chain(torques).collect()
    }
}

/// The names of all columns of a rover's telemetry.
#[must_use]
pub fn column_names(rover: &Rover) -> Vec<String> {
    let (of_wheels, of_rover): (Vec<_>, Vec<_>) = COLUMNS.iter().partition(|it| it.is_of_wheel);
    let of_rover = of_rover.into_iter().map(|it| it.name.to_owned());
    let each = of_wheels.into_iter().flat_map(|column| {
        rover.mounts().iter().map(|mount| format!("{}_{}", column.name, mount.name))
    });
    of_rover.chain(each).collect()
}

/// What a record has in these columns, each in its unit; gaps are `None`.
pub fn numbers(record: &TelemetryRecord) -> impl Iterator<Item = Option<f64>> {
    let of_rover =
        COLUMNS.iter().filter(|it| !it.is_of_wheel).map(|it| (it, record.of_rover(it.name)));
    let each = COLUMNS
        .iter()
        .filter(|it| it.is_of_wheel)
        .flat_map(|column| record.wheels.iter().map(move |wheel| (column, wheel.of(column.name))));
    of_rover.chain(each).map(|(column, value)| value.map(|it| column.unit.from_si(it)))
}

/// The header of a table with all columns, and its line end.
#[must_use]
pub fn csv_header(rover: &Rover) -> String {
    column_names(rover).join(",") + "\n"
}

/// A record as a line below that header; gaps are empty.
#[must_use]
pub fn csv_line(record: &TelemetryRecord) -> String {
    let mut line = String::with_capacity(512);
    for (place, number) in numbers(record).enumerate() {
        if place > 0 {
            line.push(',');
        }
        if let Some(number) = number {
            // Writing to memory does not fail.
            let _ = write!(line, "{number}");
        }
    }
    line.push('\n');
    line
}

/// What [`COLUMNS`] are of a record, but for the time.
type OfRover = (Quantity, fn(&mut TelemetryRecord) -> &mut Option<f64>);
type OfWheel = (Quantity, fn(&mut WheelTelemetry) -> &mut Option<f64>);

const OF_ROVER: [OfRover; 8] = [
    (ROLL, |it| &mut it.roll),
    (PITCH, |it| &mut it.pitch),
    (YAW, |it| &mut it.yaw),
    (FORWARD, |it| &mut it.displacement[0]),
    (LEFTWARD, |it| &mut it.displacement[1]),
    (ROTATION, |it| &mut it.rotation),
    (X, |it| &mut it.position[0]),
    (Y, |it| &mut it.position[1]),
];

const OF_WHEEL: [OfWheel; 5] = [
    (WHEEL_SPEED, |it| &mut it.speed),
    (WHEEL_TORQUE, |it| &mut it.torque),
    (MOTOR_CURRENT, |it| &mut it.current),
    (STEERING, |it| &mut it.steering),
    (SINKAGE, |it| &mut it.sinkage),
];

impl TelemetryRecord {
    /// Leaves out what tells how the rover moved.
    fn leave_out_motion(&mut self) {
        (self.displacement, self.rotation) = ([None; 2], None);
        (self.position, self.is_way_incomplete) = ([None; 2], false);
    }

    /// Leaves out torques and currents that are exactly 0 on all wheels while they turn; whether
    /// there were some.
    fn leave_out_zero_torques(&mut self) -> bool {
        let turns = self.wheels.iter().any(|it| it.speed.is_some_and(|speed| speed != 0.0));
        let mut were_some = false;
        for (_, field) in OF_WHEEL.iter().filter(|(it, _)| {
            [WHEEL_TORQUE, MOTOR_CURRENT].iter().any(|torque| torque.name == it.name)
        }) {
            let read: Vec<f64> = self.wheels.iter_mut().filter_map(|it| *field(it)).collect();
            if turns && read.len() > 1 && read.iter().all(|it| *it == 0.0) {
                self.wheels.iter_mut().for_each(|it| *field(it) = None);
                were_some = true;
            }
        }
        were_some
    }

    fn of_rover(&self, column: &str) -> Option<f64> {
        if column == TIME.name {
            return Some(self.time);
        }
        let (_, place) = OF_ROVER.iter().find(|(it, _)| it.name == column)?;
        *place(&mut self.clone())
    }
}

impl WheelTelemetry {
    fn of(&self, column: &str) -> Option<f64> {
        let (_, place) = OF_WHEEL.iter().find(|(it, _)| it.name == column)?;
        *place(&mut self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::super::error::MeasurementError;
    use super::*;
    use crate::{Kind, Overrides, Source, read_rover};

    fn rover() -> Rover {
        read_rover(&Source::find(Kind::Rover, "hakuto").unwrap(), &Overrides::none()).unwrap().value
    }

    fn all(text: &[u8]) -> Result<(Vec<TelemetryRecord>, Lost), MeasurementError> {
        let mut reader = TelemetryReader::new("log.csv", text, &rover())?;
        let mut records = Vec::new();
        while let Some(record) = reader.next_record()? {
            records.push(record);
        }
        Ok((records, reader.rows().lost().clone()))
    }

    #[test]
    fn what_is_written_is_read() {
        let wheel = WheelTelemetry {
            speed: Some(0.5),
            torque: Some(0.25),
            sinkage: Some(0.01),
            ..WheelTelemetry::default()
        };
        let record = TelemetryRecord {
            time: 2.0,
            roll: Some(0.1),
            displacement: [Some(0.5), None],
            rotation: Some(-0.01),
            wheels: vec![wheel, WheelTelemetry::default(), wheel, wheel],
            ..TelemetryRecord::default()
        };
        let text = csv_header(&rover()) + &csv_line(&record);
        let (found, lost) = all(text.as_bytes()).unwrap();
        assert!(lost.is_nothing());
        let [found] = &found[..] else { panic!("one record") };
        assert_eq!((found.time, found.pitch, found.displacement), (2.0, None, [Some(0.5), None]));
        assert!((found.roll.unwrap() - 0.1).abs() < 1e-12);
        assert_eq!(found.wheels, record.wheels);
    }

    #[test]
    fn wheels_are_named_before_or_behind_and_in_any_spelling() {
        let text =
            "time_s,wheel_speed_rad_s_Front_Left,rear-right.torque_nm,colour\n1,0.5,0.25,red\n";
        let mut reader = TelemetryReader::new("log.csv", text.as_bytes(), &rover()).unwrap();
        assert_eq!(reader.rows().unused(), ["colour"]);
        let record = reader.next_record().unwrap().unwrap();
        let names: Vec<_> = rover().mounts().iter().map(|it| it.name.clone()).collect();
        let place = |name: &str| names.iter().position(|it| it == name).unwrap();
        assert_eq!(record.wheels[place("front-left")].speed, Some(0.5));
        assert_eq!(record.wheels[place("rear-right")].torque, Some(0.25));
    }

    #[test]
    fn damage_is_counted_and_the_rest_is_read() {
        let text = b"time_s,roll_deg,vo_dx_m\n1,5,0.1\n2,oops,0.1\n3,400,nan\n,1,1\n2.5,1,1\n4,1\n\xff,1,1\n5,2,0.3\n";
        let (found, lost) = all(text).unwrap();
        assert_eq!(found.iter().map(|it| it.time).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 5.0]);
        assert_eq!((found[1].roll, found[2].roll), (None, None));
        assert_eq!(lost.cells[ROLL.name], 2);
        assert_eq!((lost.damaged_rows, lost.rows_without_time, lost.rows_out_of_order), (2, 1, 1));
        assert_eq!(lost.sentences().len(), 4);
    }

    /// A roll that stays as it is while the pitch changes, and torques of 0 on all wheels that turn,
    /// are no readings; what is rounded, and what stands, is one.
    #[test]
    fn constants_are_no_readings() {
        let rows = |line: &dyn Fn(u32) -> String| -> String {
            let head = "time_s,roll_deg,pitch_deg,wheel_speed_rad_s_front-left,wheel_speed_rad_s_front-right,wheel_torque_nm_front-left,wheel_torque_nm_front-right\n";
            head.to_owned()
                + &(0..300).map(|row| format!("{row},{}\n", line(row))).collect::<String>()
        };
        let changing = |row: u32| f64::from(row * 37 % 101) / 50.0;
        let frozen = rows(&|row| format!("3.25,{},0,{},0,0", changing(row), changing(row) + 0.5));
        let (found, lost) = all(frozen.as_bytes()).unwrap();
        assert_eq!(found.iter().filter(|it| it.roll.is_some()).count(), 100);
        assert!(found.iter().all(|it| it.pitch.is_some()));
        let place = rover().mounts().iter().position(|it| it.name == "front-left").unwrap();
        assert!(found.iter().all(|it| it.wheels[place].speed == Some(0.0)), "a wheel that stands");
        assert!(found.iter().all(|it| it.wheels.iter().all(|it| it.torque.is_none())));
        assert_eq!((lost.frozen[ROLL.name], lost.frozen.len()), (200, 1));
        assert_eq!(lost.sentences().len(), 2, "{:?}", lost.sentences());
        let rounded = rows(&|row| format!("3.25,{},0.5,0.5,0.1,0.1", changing(row).round()));
        assert!(all(rounded.as_bytes()).unwrap().1.is_nothing());
    }

    /// Times that fall from row to row are those of a file sorted newest first; equal ones are
    /// rounded, and their rows count.
    #[test]
    fn times_that_fall_or_are_rounded_are_named_so() {
        let sentence = |times: &mut dyn Iterator<Item = f64>| {
            let rows: String =
                times.enumerate().map(|(row, it)| format!("{it},0.{row}\n")).collect();
            let text = format!("time_s,vo_dx_m\n{rows}");
            let mut reader = TelemetryReader::new("log.csv", text.as_bytes(), &rover()).unwrap();
            while reader.next_record().unwrap().is_some() {}
            (reader.rows().sentence_of_times(), reader.rows().share_used())
        };
        let (falls, used) = sentence(&mut (0..9).rev().map(f64::from));
        assert!(falls.unwrap().contains("newest first") && used < 0.2);
        let (rounded, used) = sentence(&mut (0..9).map(|it| f64::from(it / 3) / 5.0));
        let rounded = rounded.unwrap();
        assert!(rounded.contains("6 of 9 rows") && rounded.contains("to 0.2 s"), "{rounded}");
        assert!((used - 1.0).abs() < 1e-12);
        let (own, _) = sentence(&mut (0..9).map(f64::from));
        assert_eq!(own, None);
    }

    /// Motors of one side that are mounted the other way round, and a turn on the spot.
    #[test]
    fn mirrored_sides_are_named() {
        let sentence = |rotation: f64| {
            let row = |time: u32| format!("{time},0.1,{rotation},0.9,-1,1,-0.9\n");
            let names = ["front-left", "front-right", "rear-left", "rear-right"];
            let names = names.map(|it| format!("wheel_speed_rad_s_{it}")).join(",");
            let rows: String = (0..30).map(row).collect();
            let text = format!("time_s,vo_dx_m,vo_dyaw_deg,{names}\n{rows}");
            let mut reader = TelemetryReader::new("log.csv", text.as_bytes(), &rover()).unwrap();
            while reader.next_record().unwrap().is_some() {}
            reader.rows().sentence_of_sides()
        };
        let found = sentence(0.1).unwrap();
        assert!(
            found.starts_with("all wheels of the right side turn backward in 30 of"),
            "{found}"
        );
        assert_eq!(sentence(10.0), None);
    }

    /// A day first, or a time of day alone, is no time that is guessed at.
    #[test]
    fn dates_of_other_clocks_are_refused() {
        for date in ["29/11/2026 10:00:00", "10:00:00.5", "2026-11-29"] {
            let error = all(format!("time_s,roll_deg\n{date},1\n").as_bytes()).unwrap_err();
            let error = error.to_string();
            assert!(error.contains(date) && error.contains("hint: ISO 8601"), "{error}");
        }
        // After the first it is damage.
        let (found, lost) = all(b"time_s,roll_deg\n1,1\n29/11/2026,1\n").unwrap();
        assert_eq!((found.len(), lost.rows_without_time), (1, 1));
    }

    #[test]
    fn headers_that_cannot_be_meant_are_refused() {
        for (text, words) in [
            ("", "has no header"),
            ("roll_deg,pitch_deg\n1,2\n", "the time is missing"),
            ("time_s,roll_deg,roll_deg\n", "twice"),
            ("time_s,wheel_speed_rad_s_middle-left\n", "is no wheel of the rover"),
            ("time_s,wheel_speed_rad_s_front-left,front-left.wheel_speed_rad_s\n", "same meaning"),
        ] {
            let error = all(text.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
