//! Settings of a test stand, and what a wheel does there.

use super::super::table::Table;
use super::flags::{self, FLAGS};
use super::heading::DRAWS;
use super::wheel::{ENTRY_ANGLE, WHEEL};
use super::{
    Column, DRAWBAR_PULL, LOAD, OK, PROBABILITY_CARRIED, SIDE_FORCE, SINKAGE, SLIP_ANGLE,
    SLIP_RATIO, STATUS, TORQUE, text, whole,
};
use crate::contact::Settled;
use crate::studies::wheel_test::WheelTestRow;
use crate::studies::wheel_test_band::SettledBand;

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

/// Quantiles over samples of soil and model. Where the soil does not carry the wheel, a sample
/// counts as sunk to the axle, with the values of [`SettledBand`].
pub const BAND: [Column<SettledBand>; 6] = [
    SINKAGE.band("Sinkage of the grouser tips", |it| it.sinkage),
    DRAWBAR_PULL.band("Force along the wheel", |it| it.drawbar_pull),
    SIDE_FORCE.band("Force across the wheel, positive to the left", |it| it.side_force),
    TORQUE.band("Torque of the drive", |it| it.torque),
    PROBABILITY_CARRIED.probability(
        "Probability that the soil carries the wheel: the share of the samples in which it does",
        |it| (it.carried.trials > 0).then_some(it.carried),
    ),
    whole(DRAWS, "All samples", |it| Some(it.carried.trials)),
];

/// A table with a row for each setting, and the columns of [`BAND`] added.
#[must_use]
pub fn with_bands(table: Table, bands: &[SettledBand]) -> Table {
    table.and(&BAND, &bands.iter().map(Some).collect::<Vec<_>>())
}

/// The columns of [`with_bands`] for reading.
#[must_use]
pub fn bands_brief() -> Vec<String> {
    let setting = [LOAD, SLIP_ANGLE, SLIP_RATIO].map(|it| vec![it.name.to_owned()]);
    let results = [SINKAGE, DRAWBAR_PULL, SIDE_FORCE, TORQUE].map(|it| {
        let [low, _, high] = it.quantiles();
        vec![it.name.to_owned(), low, high]
    });
    let rest = [PROBABILITY_CARRIED.name, STATUS, FLAGS].map(|name| vec![name.to_owned()]);
    setting.into_iter().chain(results).chain(rest).flatten().collect()
}

/// The columns of [`table`] for reading.
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
