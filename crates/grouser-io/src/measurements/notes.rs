//! Notes on a measurement file that can be read: rows left out, values in unlikely units.

use super::super::escape;
use super::error::QUOTED;
use super::row::Row;
use crate::measurements::wheel_tests::Quantity;

/// Rows that do not count, by their own word.
pub(super) struct LeftOut {
    /// The first of them.
    line: u64,
    /// Its status.
    pub(super) status: String,
    /// How many there are.
    count: usize,
}

impl LeftOut {
    /// The first of them.
    pub(super) fn first(line: u64, status: &str) -> Self {
        Self { line, status: escape::short_line(status, QUOTED), count: 1 }
    }

    /// With one more.
    pub(super) fn and_another(self) -> Self {
        Self { count: self.count + 1, ..self }
    }

    /// What there is to say about them.
    pub(super) fn note(&self) -> String {
        let Self { line, status, count } = self;
        let rows = if *count == 1 { "1 row is".to_owned() } else { format!("{count} rows are") };
        format!("{rows} left out, for `status` is not `ok`; the first, line {line}: {status}")
    }
}

/// Values that are possible, but look like those of another unit.
pub(super) fn suspicions(rows: &[Row]) -> Vec<String> {
    /// Forces on a wheel beyond this many loads are rare. Source: ours; a locked wheel resists
    /// with twice its load.
    const MANY_LOADS: f64 = 5.0;
    /// A torque is no more than the load on this arm [m]. Source: ours; the radius of the largest
    /// wheel that documents allow, and soil friction is below one.
    const LONG_ARM: f64 = 1.0;
    /// Sinkages that are all below this were hardly read in millimetres [m]. Source: ours.
    const TINY: f64 = 2e-4;
    let mut notes = Vec::new();
    for (quantity, name) in
        [(Quantity::DrawbarPull, "drawbar pull"), (Quantity::SideForce, "side force")]
    {
        let large = rows.iter().find(|row| {
            let reading = row.readings[quantity];
            reading.is_some_and(|reading| reading.value.abs() > MANY_LOADS * row.load)
        });
        if let Some(row) = large {
            let line = row.line;
            notes.push(format!(
                "line {line}: the {name} is more than {MANY_LOADS} times the load: are both in N?"
            ));
        }
    }
    let large = rows.iter().find(|row| {
        row.readings.torque.is_some_and(|reading| reading.value.abs() > LONG_ARM * row.load)
    });
    if let Some(row) = large {
        let line = row.line;
        notes.push(format!(
            "line {line}: the torque is more than the load on an arm of 1 m: is it in N·m?"
        ));
    }
    let sinkages: Vec<f64> =
        rows.iter().filter_map(|row| row.readings.sinkage).map(|it| it.value.abs()).collect();
    if !sinkages.is_empty() && sinkages.iter().all(|sinkage| *sinkage < TINY) {
        notes.push("all sinkages are below 0.2 mm: are they in metres?".to_owned());
    }
    /// Angles below this are hardly set in degrees, unless they are all zero [rad of degrees].
    const SMALL_ANGLE: f64 = std::f64::consts::FRAC_PI_2 * std::f64::consts::PI / 180.0;
    let largest = rows.iter().map(|row| row.slip_angle.abs()).fold(0.0, f64::max);
    if largest > 0.0 && largest <= SMALL_ANGLE {
        notes.push("all slip angles are below 1.6 degrees: are they in radians?".to_owned());
    }
    notes
}
