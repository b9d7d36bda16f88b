//! Numbers printed in the source paper, from `data/experiments/`.

use serde::Deserialize;

use crate::studies::comparison::MeasuredTraverse;

/// A row of `data/experiments/hakuto-slope/table4.csv`; its README says what the columns mean.
#[derive(Deserialize)]
struct Table4Row {
    slope_deg: f64,
    model_yaw_deg: f64,
    initial_yaw_deg: f64,
    final_yaw_deg: f64,
    initial_yaw_error_percent: f64,
    final_yaw_error_percent: f64,
    rms_distance_error_percent: f64,
    final_distance_error_m: f64,
}

impl From<Table4Row> for MeasuredTraverse {
    fn from(row: Table4Row) -> Self {
        let share = |percent: f64| percent / 100.0;
        Self {
            slope: row.slope_deg.to_radians(),
            model_yaw: row.model_yaw_deg.to_radians(),
            initial_yaw: row.initial_yaw_deg.to_radians(),
            final_yaw: row.final_yaw_deg.to_radians(),
            initial_yaw_error: share(row.initial_yaw_error_percent),
            final_yaw_error: share(row.final_yaw_error_percent),
            rms_distance_error: share(row.rms_distance_error_percent),
            final_distance_error: row.final_distance_error_m,
        }
    }
}

/// The traverses of [FourWheel], Table 4.
///
/// # Panics
/// Never: the table comes with the program.
#[must_use]
pub fn table_4() -> Vec<MeasuredTraverse> {
    let text = include_str!("../../data/experiments/hakuto-slope/table4.csv");
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows = reader.deserialize::<Table4Row>();
    rows.map(|row| row.expect("the embedded table is well formed").into()).collect()
}
