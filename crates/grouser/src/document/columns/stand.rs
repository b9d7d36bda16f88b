//! The readings of a simulated test stand.

use super::super::table::Table;
use super::{
    Column, DRAWBAR_PULL, LOAD, OK, SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, STATUS, TORQUE,
    text, whole,
};
use crate::studies::simulated_test::SimulatedTrial;

const TRIAL: &str = "trial";

/// One run of a setting.
pub const TRIALS: [Column<SimulatedTrial>; 9] = [
    LOAD.number("Loads", |it| it.load),
    SLIP_ANGLE.given("Slip angles", |it| Some(it.slip_angle)),
    SLIP_RATIO.number("Slip ratios", |it| it.slip_ratio),
    whole(TRIAL, "Which run of the setting, from 1", |it| Some(it.trial)),
    text(STATUS, "`ok`, or why there are no readings", |it| {
        Some(it.readings.as_ref().map_or_else(ToString::to_string, |_| OK.into()))
    }),
    SINKAGE.reading("Sinkage", |it| it.readings.as_ref().ok().map(|it| it.sinkage)),
    DRAWBAR_PULL
        .reading("Force along the wheel", |it| it.readings.as_ref().ok().map(|it| it.drawbar_pull)),
    SIDE_FORCE.reading("Force across the wheel, positive to the left", |it| {
        it.readings.as_ref().ok().map(|it| it.side_force)
    }),
    TORQUE.reading("Torque of the drive", |it| it.readings.as_ref().ok().map(|it| it.torque)),
];

/// The rows of a simulated test. Readings are missing where `status` is not `ok`.
#[must_use]
pub fn table(trials: &[SimulatedTrial]) -> Table {
    Table::of(&TRIALS, trials)
}

/// The columns of that table for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    [
        LOAD.name,
        SLIP_ANGLE.name,
        SLIP_RATIO.name,
        TRIAL,
        SINKAGE.name,
        DRAWBAR_PULL.name,
        SIDE_FORCE.name,
        TORQUE.name,
        STATUS,
    ]
    .map(String::from)
    .into()
}
