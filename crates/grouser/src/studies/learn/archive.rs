//! Where a state of learning is written to or read from, and the walks that its parts share.

use nalgebra::{DMatrix, DVector};

use grouser_io::measurements::telemetry::{TelemetryRecord, WheelTelemetry};

/// Where a state is written to or read from. Inside of lists names do not count.
pub trait Archive {
    /// A number.
    fn number(&mut self, name: &str, value: &mut f64);
    /// A number that may be missing.
    fn maybe(&mut self, name: &str, value: &mut Option<f64>);
    /// A whole number.
    fn count(&mut self, name: &str, value: &mut u64);
    /// A text.
    fn word(&mut self, name: &str, value: &mut String);
    /// Begins a list; how many items it has: `length` where it is written, as many as there are
    /// where it is read.
    fn list(&mut self, name: &str, length: usize) -> usize;
    /// Begins a group of named fields.
    fn group(&mut self, name: &str);
    /// Ends the list or group that was begun last.
    fn end(&mut self);
    /// Says that what was read under a name cannot be.
    fn refuse(&mut self, name: &str);
}

/// A list of items, each a group.
///
/// * `blank`: an item to read into
pub(super) fn items<T>(
    archive: &mut dyn Archive,
    name: &str,
    items: &mut Vec<T>,
    blank: impl FnMut() -> T,
    mut walk: impl FnMut(&mut T, &mut dyn Archive),
) {
    let count = archive.list(name, items.len());
    items.resize_with(count, blank);
    for item in items {
        archive.group("");
        walk(item, archive);
        archive.end();
    }
    archive.end();
}

/// Numbers by their names.
pub(super) fn named<const COUNT: usize>(
    archive: &mut dyn Archive,
    numbers: [(&str, &mut f64); COUNT],
) {
    for (name, value) in numbers {
        archive.number(name, value);
    }
}

/// A list of numbers.
pub(super) fn numbers(archive: &mut dyn Archive, name: &str, values: &mut Vec<f64>) {
    list(archive, name, values, |archive, value| archive.number("", value));
}

/// A list of numbers that may be missing.
pub(super) fn maybes(archive: &mut dyn Archive, name: &str, values: &mut Vec<Option<f64>>) {
    list(archive, name, values, |archive, value| archive.maybe("", value));
}

/// A list of whole numbers.
pub(super) fn counts(archive: &mut dyn Archive, name: &str, values: &mut Vec<u64>) {
    list(archive, name, values, |archive, value| archive.count("", value));
}

/// A list of plain values.
fn list<T: Clone + Default>(
    archive: &mut dyn Archive,
    name: &str,
    values: &mut Vec<T>,
    walk: impl Fn(&mut dyn Archive, &mut T),
) {
    let count = archive.list(name, values.len());
    values.resize(count, T::default());
    for value in values {
        walk(archive, value);
    }
    archive.end();
}

/// A vector.
pub(super) fn vector(archive: &mut dyn Archive, name: &str, vector: &mut DVector<f64>) {
    let mut values = vector.as_slice().to_vec();
    numbers(archive, name, &mut values);
    *vector = DVector::from_vec(values);
}

/// A matrix, column by column; one whose numbers fill no rows is read as empty.
pub(super) fn matrix(archive: &mut dyn Archive, name: &str, matrix: &mut DMatrix<f64>) {
    archive.group(name);
    let (mut rows, mut values) = (matrix.nrows() as u64, matrix.as_slice().to_vec());
    archive.count("rows", &mut rows);
    numbers(archive, "values", &mut values);
    archive.end();
    let rows = usize::try_from(rows).unwrap_or(0);
    let columns = values.len().checked_div(rows).unwrap_or(0);
    values.truncate(rows * columns);
    *matrix = DMatrix::from_vec(if columns == 0 { 0 } else { rows }, columns, values);
}

/// A record of telemetry.
pub(super) fn record(record: &mut TelemetryRecord, archive: &mut dyn Archive) {
    let TelemetryRecord {
        time,
        roll,
        pitch,
        yaw,
        displacement,
        rotation,
        position,
        wheels,
        // It matters before a record is kept.
        is_way_incomplete: _,
    } = record;
    archive.number("time", time);
    let [forward, leftward] = displacement;
    let [x, y] = position;
    let all = [roll, pitch, yaw, forward, leftward, rotation, x, y];
    let names = ["roll", "pitch", "yaw", "forward", "leftward", "rotation", "x", "y"];
    names.into_iter().zip(all).for_each(|(name, value)| archive.maybe(name, value));
    items(archive, "wheels", wheels, WheelTelemetry::default, |wheel, archive| {
        let WheelTelemetry { speed, torque, current, steering, sinkage } = wheel;
        let all = [speed, torque, current, steering, sinkage];
        let names = ["speed", "torque", "current", "steering", "sinkage"];
        names.into_iter().zip(all).for_each(|(name, value)| archive.maybe(name, value));
    });
}
