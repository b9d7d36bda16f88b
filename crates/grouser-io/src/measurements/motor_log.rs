//! Reads logs of a rover's motors from CSV: the current and the speed of each wheel over time.
//!
//! A file has a row for each time, with columns of each wheel that begin with its name and a dot
//! (`front-left.current_a`), as runs are written; or a row for each wheel and time, with the name
//! in the column `wheel`. Rows of one time that follow each other are one record. [`COLUMNS`] lists
//! the columns; others are left aside.
//!
//! Telemetry, as `learn` reads it, becomes such a log by [`MotorLogOfTelemetry`].

use std::ops::RangeInclusive;

use csv::StringRecord;
use grouser_core::vehicle::{Mount, Rover, slope_and_yaw};

use super::super::check::nearest;
use super::super::columns::{
    COURSE, CURRENT, LOAD, Quantity, SLIP_ANGLE, SLIP_RATIO, SLOPE, STEERING, TIME, WHEEL_SPEED,
    YAW,
};
use super::super::escape;
use super::super::given_file::{FileContent, GivenFile};
use super::error::{MeasurementError, MeasurementProblem as Problem};
use super::limits::Limits;
use super::log_column::{LogColumn, column};
use super::row::{name_of, number_of};
use super::table;
use super::telemetry::{MOTOR_CURRENT, TelemetryRecord, WheelTelemetry};

/// Name of the wheel, in files with a row for each wheel.
pub const WHEEL: &str = "wheel";

/// A log of a rover's motors.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotorLog {
    /// In the order of the file.
    pub records: Vec<MotorRecord>,
}

impl MotorLog {
    /// What a file with the log gave: its readings of wheels, all of which count.
    ///
    /// * `file`: its name
    #[must_use]
    pub fn given(&self, file: &str) -> GivenFile {
        let readings = self.records.iter().flat_map(|record| record.wheels.iter().flatten());
        let readings = readings.count() as u64;
        GivenFile::new(file, FileContent::MotorLog, readings, readings)
    }
}

/// What was read of a rover at one time, in SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotorRecord {
    /// Time [s].
    pub time: f64,
    /// Slope of the ground, *α* [rad].
    pub slope: Option<f64>,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: Option<f64>,
    /// Course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: Option<f64>,
    /// Reading of each wheel, in the order of the rover's mounts; `None` where there is no reading.
    pub wheels: Vec<Option<MotorReading>>,
}

/// What was read of a wheel and its motor, in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotorReading {
    /// Current, *i* [A].
    pub current: f64,
    /// Angular speed of the wheel, *ω* [rad/s].
    pub wheel_speed: f64,
    /// Load on the wheel [N].
    pub load: Option<f64>,
    /// Slip angle, *β* [rad].
    pub slip_angle: Option<f64>,
    /// Steering angle, *δ* [rad].
    pub steering: Option<f64>,
    /// Slip ratio measured by other means, *s* [-].
    pub slip_ratio: Option<f64>,
}

const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

/// Every column that is known.
pub const COLUMNS: [LogColumn; 10] = [
    column(TIME, false, "time", ANY),
    column(CURRENT, true, "current of the motor, negative where it brakes", -1e5..=1e5),
    column(WHEEL_SPEED, true, "angular speed of the wheel, negative backward", -1e4..=1e4),
    column(LOAD, true, "load on the wheel; without it that of the load transfer", 0.0..=1e5),
    column(
        SLIP_ANGLE,
        true,
        "slip angle; without it that of the yaw and the steering angle against the course, or 0",
        -90.0..=90.0,
    ),
    column(
        STEERING,
        true,
        "steering angle, positive to the left; without it that of the rover's document",
        -180.0..=180.0,
    ),
    column(
        SLIP_RATIO,
        true,
        "slip ratio measured by other means: set beside the estimate",
        -2.0..=2.0,
    ),
    column(SLOPE, false, "slope of the ground", 0.0..=60.0),
    column(YAW, false, "yaw, positive uphill", ANY),
    column(COURSE, false, "direction of travel from the contour, positive uphill", -180.0..=180.0),
];

/// Which part of a log is read.
#[derive(Clone, Debug, Default)]
pub struct LogChoice {
    /// Names of columns that are left aside as if they were not there; of a wheel's columns,
    /// without the wheel's.
    pub ignored: Vec<String>,
    /// Yaw of rows without a yaw, *γ* [rad].
    pub yaw: Option<f64>,
    /// Course of rows without a course, *χ* [rad].
    pub course: Option<f64>,
    /// How much of the file is read.
    pub limits: Limits,
}

/// Reads a log.
///
/// * `label`: what messages call the source
/// * `rover`: the rover that was driven, for the names of its wheels
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as [`COLUMNS`] says, for wheels that
/// the rover does not have, or that have no motor, and if no reading is left.
pub fn read_motor_log(
    label: &str,
    bytes: &[u8],
    choice: &LogChoice,
    rover: &Rover,
) -> Result<MotorLog, MeasurementError> {
    let mut table = table::Table::new(label, bytes, b',', choice.limits);
    let names = table.header()?.iter().map(name_of).collect();
    let header = Header::new(label, names, choice, rover)?;
    let mut log = MotorLog::default();
    let mut record = StringRecord::new();
    while table.next_row(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        if record.iter().map(escape::plain).eq(header.names.iter().map(String::as_str)) {
            return Err(MeasurementError::at(label, line, Problem::RepeatedHeader));
        }
        header.add(&mut log, &record, line)?;
    }
    checked(label, log)
}

/// Telemetry as a log of motors: attitude, currents, speeds and steering angles, record by record.
#[derive(Clone, Debug, Default)]
pub struct MotorLogOfTelemetry {
    log: MotorLog,
    /// Slope and yaw as they were last read [rad].
    attitude: Option<[f64; 2]>,
}

impl MotorLogOfTelemetry {
    /// Adds a record; how the body leans holds until it is read again.
    ///
    /// * `rover`: the rover that was driven: wheels without a motor have no readings
    pub fn add(&mut self, record: &TelemetryRecord, choice: &LogChoice, rover: &Rover) {
        let is_read = |column: Quantity| choice.ignored.iter().all(|name| name != column.name);
        if let (Some(roll), Some(pitch)) = (record.roll, record.pitch) {
            self.attitude = Some(slope_and_yaw(roll, pitch));
        }
        let [slope, leaning] = self.attitude.map_or([None; 2], |it| it.map(Some));
        let reading = |(wheel, mount): (&WheelTelemetry, &Mount)| {
            mount.unit.motor.as_ref()?;
            Some(MotorReading {
                current: wheel.current?,
                wheel_speed: wheel.speed?,
                steering: wheel.steering.filter(|_| is_read(STEERING)),
                ..MotorReading::default()
            })
        };
        self.log.records.push(MotorRecord {
            time: record.time,
            slope: slope.filter(|_| is_read(SLOPE)),
            yaw: record.yaw.or(leaning).filter(|_| is_read(YAW)).or(choice.yaw),
            course: choice.course,
            wheels: record.wheels.iter().zip(rover.mounts()).map(reading).collect(),
        });
    }

    /// How many records it has.
    #[must_use]
    pub fn count(&self) -> usize {
        self.log.records.len()
    }

    /// The log.
    ///
    /// * `label`: what messages call the source
    ///
    /// # Errors
    /// [`MeasurementError`] of a log without a row, or without a current beside a speed.
    pub fn finish(self, label: &str) -> Result<MotorLog, MeasurementError> {
        checked(label, self.log)
    }
}

/// A log that has readings.
fn checked(label: &str, log: MotorLog) -> Result<MotorLog, MeasurementError> {
    if log.records.is_empty() {
        return Err(MeasurementError::whole(label, Problem::NoRows));
    }
    if log.records.iter().all(|record| record.wheels.iter().all(Option::is_none)) {
        return Err(MeasurementError::whole(label, Problem::NoMotorReadings));
    }
    Ok(log)
}

/// Whether a file is telemetry, as `learn` reads it: it is no table of CSV, or its header has
/// currents by the names of telemetry.
///
/// * `bytes`: of the file, all or the first
#[must_use]
pub fn is_telemetry(bytes: &[u8]) -> bool {
    /// As far as a header reaches, with comments before it [bytes].
    const START: usize = 1 << 14;
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(START)]);
    // What is packed or encoded has characters that no table has.
    let is_encoded = |it: char| it.is_control() && !it.is_whitespace();
    start.contains(MOTOR_CURRENT.name) || start.contains(is_encoded)
}

/// The header, understood.
struct Header<'a> {
    label: &'a str,
    names: Vec<String>,
    choice: &'a LogChoice,
    /// Names of the rover's wheels, and whether their motors are known.
    wheels: Vec<(&'a str, bool)>,
    /// Whether each wheel has columns of its own.
    is_wide: bool,
}

impl LogChoice {
    /// Leaves a column aside.
    ///
    /// # Errors
    /// A sentence, if there is no such column, or if a log needs it.
    pub fn ignore(&mut self, name: &str) -> Result<(), String> {
        let needed = [TIME, CURRENT, WHEEL_SPEED].map(|it| it.name);
        let names = COLUMNS.iter().map(|column| column.name);
        let others: Vec<&str> = names.filter(|name| !needed.contains(name)).collect();
        if others.contains(&name) {
            self.ignored.push(name.to_owned());
            return Ok(());
        }
        let hint = match nearest(name, others.iter().copied()) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("one of {}", others.join(", ")),
        };
        Err(format!("'{name}' is no column that a log can do without: {hint}"))
    }
}

impl<'a> Header<'a> {
    fn new(
        label: &'a str,
        names: Vec<String>,
        choice: &'a LogChoice,
        rover: &'a Rover,
    ) -> Result<Self, MeasurementError> {
        let failed = |problem| MeasurementError::at(label, 1, problem);
        if names.iter().all(String::is_empty) {
            return Err(MeasurementError::whole(label, Problem::NoHeader));
        }
        let mut seen = std::collections::HashSet::new();
        if let Some(name) = names.iter().find(|name| !name.is_empty() && !seen.insert(*name)) {
            return Err(failed(Problem::RepeatedColumn(name.clone())));
        }
        let of_mount = |mount: &'a grouser_core::vehicle::Mount| {
            (mount.name.as_str(), mount.unit.motor.is_some())
        };
        let wheels = rover.mounts().iter().map(of_mount).collect();
        let is_wide = names.iter().any(|name| wheel_of(name, CURRENT).is_some());
        let header = Self { label, names, choice, wheels, is_wide };
        header.check()?;
        Ok(header)
    }

    fn check(&self) -> Result<(), MeasurementError> {
        let has = |name: &str| self.names.iter().any(|known| known == name);
        if !has(TIME.name) {
            return Err(self.missing("the time", &[TIME.name]));
        }
        if self.is_wide {
            for name in &self.names {
                let Some(wheel) = wheel_of(name, CURRENT) else { continue };
                self.wheel(wheel, 1)?;
                let speed = format!("{wheel}.{}", WHEEL_SPEED.name);
                if !has(&speed) {
                    return Err(self.missing("the speed of a wheel", &[&speed]));
                }
            }
            return Ok(());
        }
        if !has(CURRENT.name) {
            let (first, _) = self.wheels[0];
            let wide = format!("{first}.{}", CURRENT.name);
            let error = self.missing("every current", &[CURRENT.name, &wide]);
            let is_of_a_run = self.names.iter().any(|name| wheel_of(name, WHEEL_SPEED).is_some());
            return Err(if is_of_a_run {
                error.with_hint(
                    "a run has currents if its rover's document has a [motor]".to_owned(),
                )
            } else {
                error
            });
        }
        for name in [WHEEL_SPEED.name, WHEEL] {
            if !has(name) {
                let what = if name == WHEEL { "the wheel's name" } else { "the speed of a wheel" };
                return Err(self.missing(what, &[name]));
            }
        }
        Ok(())
    }

    fn missing(&self, what: &'static str, expected: &[&str]) -> MeasurementError {
        let names: Vec<String> = expected.iter().map(|name| format!("`{name}`")).collect();
        let near = self.names.iter().find_map(|name| {
            let meant = nearest(name, expected.iter().copied())?;
            Some(format!("is `{name}` meant as `{meant}`?"))
        });
        let problem = Problem::MissingColumn { what, expected: names.join(", ") };
        MeasurementError::at(self.label, 1, problem)
            .with_hint(table::delimiter_hint(&self.names).or(near))
    }

    /// The place of a wheel with a motor among the rover's mounts.
    fn wheel(&self, name: &str, line: u64) -> Result<usize, MeasurementError> {
        let failed = |problem| MeasurementError::at(self.label, line, problem);
        match self.wheels.iter().position(|(known, _)| *known == name) {
            Some(place) if self.wheels[place].1 => Ok(place),
            Some(_) => {
                let hint = "a [motor] of the rover, or [mount.motor] of this wheel, describes it";
                Err(failed(Problem::WheelWithoutMotor(name.to_owned())).with_hint(hint.to_owned()))
            }
            None => {
                let wheels: Vec<&str> = self.wheels.iter().map(|(name, _)| *name).collect();
                let hint = nearest(name, wheels.iter().copied());
                let wheels = wheels.iter().map(|it| (*it).to_owned()).collect();
                let error = failed(Problem::UnknownWheel { name: name.to_owned(), wheels });
                Err(error.with_hint(hint.map(|meant| format!("did you mean `{meant}`?"))))
            }
        }
    }

    /// The number of a column in SI, if the row has one.
    ///
    /// * `wheel`: whose column it is, or nothing
    fn number(
        &self,
        (record, line): (&StringRecord, u64),
        quantity: Quantity,
        wheel: &str,
    ) -> Result<Option<f64>, MeasurementError> {
        if self.choice.ignored.iter().any(|name| name == quantity.name) {
            return Ok(None);
        }
        let name = if wheel.is_empty() {
            quantity.name.to_owned()
        } else {
            format!("{wheel}.{}", quantity.name)
        };
        let place = self.names.iter().position(|known| *known == name);
        let text = place.and_then(|place| record.get(place)).map_or("", escape::plain);
        let column = COLUMNS.iter().find(|column| column.name == quantity.name);
        let range = column.map_or(&ANY, |column| &column.range);
        number_of((self.label, line), (&name, quantity.unit, range), text)
    }

    /// Adds a row to the log.
    fn add(
        &self,
        log: &mut MotorLog,
        record: &StringRecord,
        line: u64,
    ) -> Result<(), MeasurementError> {
        let number = |quantity| self.number((record, line), quantity, "");
        let time = number(TIME)?.ok_or_else(|| {
            let why = "a row needs its time";
            let problem = Problem::MissingValue { column: TIME.name.to_owned(), why };
            MeasurementError::at(self.label, line, problem)
        })?;
        let slope = number(SLOPE)?;
        let yaw = number(YAW)?.or(self.choice.yaw);
        let course = number(COURSE)?.or(self.choice.course);
        let wheels = vec![None; self.wheels.len()];
        let mut row = MotorRecord { time, slope, yaw, course, wheels };
        if self.is_wide {
            for (place, (name, has_motor)) in self.wheels.iter().enumerate() {
                if *has_motor {
                    row.wheels[place] = self.reading((record, line), name)?;
                }
            }
            log.records.push(row);
            return Ok(());
        }
        let place = self.names.iter().position(|name| name == WHEEL);
        let name = place.and_then(|place| record.get(place)).map_or("", escape::plain);
        let (wheel, reading) = (self.wheel(name, line)?, self.reading((record, line), "")?);
        match log.records.last_mut() {
            Some(last) if last.time == time => {
                if last.wheels[wheel].is_some() {
                    let problem = Problem::RepeatedReading { wheel: name.to_owned() };
                    return Err(MeasurementError::at(self.label, line, problem));
                }
                last.wheels[wheel] = reading;
            }
            _ => {
                row.wheels[wheel] = reading;
                log.records.push(row);
            }
        }
        Ok(())
    }

    /// What a row has of a wheel; nothing without current and speed.
    fn reading(
        &self,
        row: (&StringRecord, u64),
        wheel: &str,
    ) -> Result<Option<MotorReading>, MeasurementError> {
        let number = |quantity| self.number(row, quantity, wheel);
        let (Some(current), Some(wheel_speed)) = (number(CURRENT)?, number(WHEEL_SPEED)?) else {
            return Ok(None);
        };
        Ok(Some(MotorReading {
            current,
            wheel_speed,
            load: number(LOAD)?,
            slip_angle: number(SLIP_ANGLE)?,
            steering: number(STEERING)?,
            slip_ratio: number(SLIP_RATIO)?,
        }))
    }
}

/// The wheel whose column of a quantity this is, if it is one.
fn wheel_of(name: &str, quantity: Quantity) -> Option<&str> {
    name.strip_suffix(quantity.name)?.strip_suffix('.').filter(|wheel| !wheel.is_empty())
}
