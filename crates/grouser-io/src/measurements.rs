//! Reads measured wheel tests from CSV, and converts their columns, units, slip definitions and
//! signs.
//!
//! A file has a header and a row for each trial. [`columns`] lists what the columns may be called
//! and what they mean; those it does not know are left aside and named in
//! [`Measurements::notes`]. A row needs a load and its slip; everything else may be missing.
//!
//! The slip is taken from the two speeds where both are given, or else from `slip_ratio`, or from
//! `slip_ratio_total_speed`. Where a file gives speeds and a slip, they must agree.
//!
//! Rows repeat each other, and form one cell, if they have the same `cell`; in a file without that
//! column, if they have the same wheel, slip angle and settings of rim speed and load; and without
//! settings, if slip, slip angle and load are written alike.
//!
//! A rover on slopes has files of its own, which [`slope_tests`] reads, and so have logs of motors
//! ([`motor_log`]).
//!
//! What `grouser wheel-test` writes is such a file. Rows whose `status` is not `ok` are left out.

pub mod bevameter_columns;
pub mod bevameter_sets;
pub mod columns;
mod condition;
mod dimension;
mod error;
mod import;
mod limits;
pub mod log_column;
pub mod motor_log;
mod notes;
mod row;
pub mod slope_tests;
mod source;
pub mod table;
mod taken;
pub mod telemetry;
pub mod wheel_tests;

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

pub use columns::{Column, Meaning};
pub use condition::Condition;
pub use dimension::Dimension;
pub use error::{MeasurementError, MeasurementProblem};
pub use import::{Imported, Layout, Mapping, SlipDefinition, import};
pub use limits::{Excess, Limits};
pub use source::Source;

use super::escape;
use super::file;
use super::given_file::{FileContent, GivenFile};
use row::{Header, name_of};
use taken::{LeftOut, Row, Taken};
use wheel_tests::{Cell, Quantity, Trial, WheelTests};

/// Which rows of a file are wanted.
#[derive(Clone, Debug, Default)]
pub struct Choice {
    /// Conditions that a row must meet, all of them. `line` stands for the line of the file in which
    /// a row begins: `line!=17` leaves out one trial.
    pub conditions: Vec<Condition>,
    /// Name of the wheel that was tested, for files with rows of several.
    ///
    /// The label `smooth` in the column `wheel` belongs to wheels called `smooth`, `cmu-smooth`,
    /// `cmu_smooth` or `wheels/smooth.toml`.
    pub wheel: Option<String>,
    /// How much of the file is read.
    pub limits: Limits,
}

/// A measurement file that was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// The trials, in SI units and Grouser's signs.
    pub tests: WheelTests,
    /// The line of the file in which each trial stands.
    pub lines: Vec<u64>,
    /// What the file gave.
    pub given: GivenFile,
    /// What was noticed and left: columns not used, values that look like another unit's.
    pub notes: Vec<String>,
}

/// Reads a measurement file.
///
/// With which force did sand hold back a locked wheel of 125 mm diameter in three measured trials?
///
/// ```
/// use std::path::Path;
///
/// use grouser_io::measurements::{self, Choice, Condition};
///
/// let file = Path::new("data/measurements/cmu_single_wheel.csv");
/// let locked = ["wheel=smooth", "slip_angle_deg=0", "peripheral_speed_setpoint_mm_s=0"];
/// let conditions = locked.iter().map(|text| Condition::parse(text)).collect::<Result<_, _>>()?;
/// let tests = measurements::read(file, &Choice { conditions, ..Choice::default() })?.tests;
///
/// let pulls = tests.trials.iter().filter_map(|trial| trial.readings.drawbar_pull);
/// let pulls: Vec<String> = pulls.map(|pull| format!("{:.1} N", pull.value)).collect();
/// assert_eq!(pulls.join(", "), "-38.2 N, -39.1 N, -39.2 N");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MeasurementError`] with file and line for whatever is not as [`columns`] says, and if no row
/// is left.
pub fn read(path: &Path, choice: &Choice) -> Result<Measurements, MeasurementError> {
    let bytes = read_bytes(path, choice.limits)?;
    read_from(&escape::path(path), bytes.as_slice(), choice)
}

/// The bytes of a measurement file.
///
/// A regular file is read, and a pipe that is open already, as `/dev/stdin` or `/dev/fd/N`. A
/// device is refused, and so is a pipe with a name, which would wait until somebody writes.
///
/// # Errors
/// [`MeasurementError`] if there is no file, if it may not be read, or if it is too large.
pub fn read_bytes(path: &Path, limits: Limits) -> Result<Vec<u8>, MeasurementError> {
    let read = file::read(path, limits.bytes());
    read.map_err(|problem| MeasurementError::whole(&escape::path(path), problem.into()))
}

/// A table of texts, for columns that no trial has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextTable {
    /// The names of its columns.
    pub header: Vec<String>,
    /// Its rows, each with the line in which it starts.
    pub rows: Vec<(u64, Vec<String>)>,
}

/// Reads a table from a file, its cells trimmed.
///
/// # Errors
/// [`MeasurementError`] with file and line for what is no table, or is too large.
pub fn read_texts(path: &Path, limits: Limits) -> Result<TextTable, MeasurementError> {
    let (bytes, label) = (read_bytes(path, limits)?, escape::path(path));
    let mut table = table::Table::new(&label, bytes.as_slice(), b',', limits);
    let header = table.header()?.iter().map(name_of).collect();
    let (mut rows, mut record) = (Vec::new(), csv::StringRecord::new());
    while table.next_row(&mut record)? {
        let line = record.position().map_or(0, csv::Position::line);
        if (rows.len() + 1).saturating_mul(record.len()) > limits.cells() {
            let excess = Excess::AllCells { most: limits.cells() };
            return Err(MeasurementError::at(&label, line, MeasurementProblem::TooLarge(excess)));
        }
        rows.push((line, record.iter().map(|text| escape::plain(text).to_owned()).collect()));
    }
    Ok(TextTable { header, rows })
}

/// Reads measurements from anywhere.
///
/// * `label`: what messages call the source
///
/// # Errors
/// The same as [`read`].
pub fn read_from(
    label: &str,
    source: impl Read,
    choice: &Choice,
) -> Result<Measurements, MeasurementError> {
    let mut table = table::Table::new(label, source, b',', choice.limits);
    let header = Header::new(label, &table.header()?, &choice.conditions)?;
    let mut rows: Vec<Row> = Vec::new();
    let mut left_out: Option<LeftOut> = None;
    let mut record = csv::StringRecord::new();
    while table.next_row(&mut record)? {
        match header.row(&record)? {
            Taken::Row(row) => rows.push(row),
            Taken::Unwanted => {}
            Taken::NotOk(row) => left_out = Some(left_out.map_or(row, LeftOut::and_another)),
        }
    }
    let mut rows = of_one_wheel(label, rows, choice)?;
    let without = header.leave_out_lines(&mut rows);
    if rows.is_empty() {
        return Err(MeasurementError::whole(label, why_there_are_none(choice, left_out)));
    }
    let was_read = |quantity| rows.iter().any(|row| row.readings[quantity].is_some());
    if !Quantity::ALL.into_iter().any(was_read) {
        return Err(MeasurementError::whole(label, MeasurementProblem::NoReadings));
    }
    let mut notes = header.notes();
    notes.extend(header.empty_readings(was_read));
    notes.extend(other_wheel(&rows, choice));
    notes.extend(left_out.iter().map(LeftOut::note));
    notes.extend(without);
    notes.extend(notes::suspicions(&rows));
    // They quote what the file says.
    let notes = notes.iter().map(|note| escape::line(note).into_owned()).collect();
    let given = GivenFile::new(label, FileContent::WheelTests, table.rows(), rows.len() as u64);
    let lines = rows.iter().map(|row| row.line).collect();
    Ok(Measurements { lines, given, notes, tests: tests(rows) })
}

fn why_there_are_none(choice: &Choice, left_out: Option<LeftOut>) -> MeasurementProblem {
    let conditions: Vec<String> = choice.conditions.iter().map(ToString::to_string).collect();
    match left_out {
        Some(rows) => MeasurementProblem::NoRowOk { first: rows.status },
        None if conditions.is_empty() => MeasurementProblem::NoRows,
        None => MeasurementProblem::NoRowMeets { conditions: conditions.join(", ") },
    }
}

/// The rows of the wheel that was asked for.
fn of_one_wheel(
    label: &str,
    rows: Vec<Row>,
    choice: &Choice,
) -> Result<Vec<Row>, MeasurementError> {
    let mut labels: Vec<String> = Vec::new();
    for row in &rows {
        if let Some(wheel) = &row.wheel
            && !labels.contains(wheel)
        {
            labels.push(wheel.clone());
        }
    }
    if labels.len() < 2 {
        return Ok(rows);
    }
    let belongs =
        |wheel: &String| choice.wheel.as_ref().is_some_and(|name| is_label_of(wheel, name));
    match &labels.iter().filter(|wheel| belongs(wheel)).collect::<Vec<_>>()[..] {
        [wheel] => {
            let wheel = (*wheel).clone();
            Ok(rows.into_iter().filter(|row| row.wheel.as_ref() == Some(&wheel)).collect())
        }
        _ => Err(MeasurementError::whole(label, MeasurementProblem::SeveralWheels { labels })),
    }
}

/// A word on rows of a single wheel that goes by another name.
fn other_wheel(rows: &[Row], choice: &Choice) -> Option<String> {
    let (name, label) = (choice.wheel.as_ref()?, rows.first()?.wheel.as_ref()?);
    (!is_label_of(label, name)).then(|| {
        format!("the column `wheel` says `{label}`; its rows are taken as those of `{name}`")
    })
}

/// Whether rows labelled so were measured with the wheel of that name or path.
fn is_label_of(label: &str, wheel: &str) -> bool {
    let stem = Path::new(wheel).file_stem().map_or(wheel.into(), |stem| stem.to_string_lossy());
    let (label, stem) = (label.to_lowercase(), stem.to_lowercase());
    stem == label || stem.ends_with(&format!("-{label}")) || stem.ends_with(&format!("_{label}"))
}

/// Sorts rows into cells, in the order in which the cells begin.
fn tests(rows: Vec<Row>) -> WheelTests {
    let mut tests = WheelTests::default();
    let mut cells: HashMap<String, usize> = HashMap::new();
    for (place, row) in rows.into_iter().enumerate() {
        let cell = *cells.entry(row.cell).or_insert_with(|| {
            tests.cells.push(Cell {
                slip_angle: row.slip_angle,
                rim_speed: row.rim_speed_setting,
                total_slip: 0.0,
                trials: Vec::new(),
            });
            tests.cells.len() - 1
        });
        tests.cells[cell].trials.push(place);
        tests.trials.push(Trial { slip: row.slip, load: row.load, readings: row.readings });
    }
    for cell in &mut tests.cells {
        let slips = cell.trials.iter().map(|&trial| tests.trials[trial].slip.total());
        cell.total_slip = slips.sum::<f64>() / cell.trials.len() as f64;
    }
    tests
}
