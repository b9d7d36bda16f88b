//! Settings of a test stand, and what a wheel does there.

use super::super::table::Table;
use super::flags::{self, FLAGS};
use super::wheel::{ENTRY_ANGLE, WHEEL};
use super::{
    Column, DRAWBAR_PULL, LOAD, OK, SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, STATUS, TORQUE,
    text,
};
use crate::contact::Settled;
use crate::studies::wheel_test::WheelTestRow;

/// What is set on a test stand, and whether the wheel settled.
const SETTING: [Column<WheelTestRow>; 4] = [
    LOAD.number("Load, as asked", |it| it.load),
    SLIP_ANGLE.given("Slip angle, as asked; positive where the hub moves to the left", |it| {
        Some(it.slip_angle)
    }),
    SLIP_RATIO.number("Slip ratio, as asked", |it| it.slip_ratio),
    text(STATUS, "`ok`, or why there is no result", |it| {
        Some(it.result.as_ref().map_or_else(ToString::to_string, |_| OK.into()))
    }),
];

/// The columns that tell rows apart.
pub const SETTINGS: [&str; 3] = [LOAD.name, SLIP_ANGLE.name, SLIP_RATIO.name];

/// Why a row is an extrapolation.
pub(super) const VALIDITY: [Column<WheelTestRow>; 1] =
    [flags::flags(|it| flags::names(&it.findings))];

/// The rows of a wheel test. Results are missing where `status` is not `ok`.
#[must_use]
pub fn table(rows: &[WheelTestRow]) -> Table {
    let settled: Vec<Option<&Settled>> = rows.iter().map(|row| row.result.as_ref().ok()).collect();
    let all: Vec<Option<&WheelTestRow>> = rows.iter().map(Some).collect();
    Table::of(&SETTING, rows).and(&WHEEL, &settled).and(&VALIDITY, &all)
}

/// The columns of that table for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    [
        LOAD.name,
        SLIP_ANGLE.name,
        SLIP_RATIO.name,
        SINKAGE.name,
        DRAWBAR_PULL.name,
        SIDE_FORCE.name,
        TORQUE.name,
        ENTRY_ANGLE.name,
        STATUS,
        FLAGS,
    ]
    .map(String::from)
    .into()
}
