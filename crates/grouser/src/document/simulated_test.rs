//! Simulated wheel tests in the words of tables, JSON and CSV: what a stand reads, no more.

use std::ops::RangeInclusive;

use serde::Serialize;

use super::study::{OK, printed_degrees};
use crate::studies::measurement::Quantity;
use crate::studies::simulated_test::SimulatedTrial;

/// How often a simulated test may run each setting.
pub const TRIALS: RangeInclusive<f64> = 1.0..=1000.0;
/// Standard deviations of noise that may be asked for, in N, mm and N·m.
pub const NOISE: RangeInclusive<f64> = 0.0..=1e3;

/// One run on a simulated stand. Readings are null where `status` is not `ok`.
///
/// They are rounded to a ten-thousandth of their unit: finer than any stand, coarse enough for the
/// same file on every machine.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SimulatedTrialRecord {
    /// Load on the wheel [N].
    pub load_n: f64,
    /// Slip angle [°], positive where the hub moves to the left.
    pub slip_angle_deg: f64,
    /// Slip ratio [-], positive where the wheel drives.
    pub slip_ratio: f64,
    /// Which run of the setting, from 1.
    pub trial: usize,
    /// `ok`, or why there are no readings.
    pub status: String,
    /// Sinkage [mm].
    pub sinkage_mm: Option<f64>,
    /// Force along the wheel [N].
    pub drawbar_pull_n: Option<f64>,
    /// Force across the wheel [N], positive to the left.
    pub side_force_n: Option<f64>,
    /// Driving torque [N·m].
    pub torque_nm: Option<f64>,
}

impl From<&SimulatedTrial> for SimulatedTrialRecord {
    fn from(trial: &SimulatedTrial) -> Self {
        let read = |quantity: Quantity, from_si: f64| {
            let readings = trial.readings.as_ref().ok();
            readings.map(|readings| as_a_stand_shows(readings[quantity] * from_si))
        };
        Self {
            load_n: trial.load,
            slip_angle_deg: printed_degrees(trial.slip_angle),
            slip_ratio: trial.slip_ratio,
            trial: trial.trial,
            status: trial.readings.as_ref().map_or_else(ToString::to_string, |_| OK.into()),
            sinkage_mm: read(Quantity::Sinkage, 1e3),
            drawbar_pull_n: read(Quantity::DrawbarPull, 1.0),
            side_force_n: read(Quantity::SideForce, 1.0),
            torque_nm: read(Quantity::Torque, 1.0),
        }
    }
}

/// Rounded; zero without a sign.
fn as_a_stand_shows(value: f64) -> f64 {
    (value * 1e4).round() / 1e4 + 0.0
}
