//! Drives by the operator's card, beside what it states.

use super::super::table::Table;
use super::super::unit::{M_PER_M, ONE};
use super::card::DRIVEN_DRIFT;
use super::run::DISTANCE;
use super::verdict::{PROBABILITY_STUCK_WITHOUT_CHECKS, VERDICT};
use super::{Column, Quantity, SLOPE, number, quantity, text, whole};
use crate::studies::card::drives::RowDrives;

/// Drift that the card states.
pub const STATED_DRIFT: Quantity = quantity("stated_drift_m_per_m", M_PER_M);
/// Share within it.
pub const PROBABILITY_WITHIN: Quantity = quantity("probability_within", ONE);
/// Share that is stuck by the card's samples.
pub const STATED_STUCK: Quantity = quantity("stated_probability_stuck_without_checks", ONE);
/// Way between two corrections over the card's.
const LATENESS: &str = "lateness";
const DRIVES: &str = "drives";

const COLUMNS: [Column<RowDrives>; 10] = [
    SLOPE.given("Slope", |it| Some(it.slope)),
    text(VERDICT, "The card's verdict", |it| Some(it.verdict.name().to_owned())),
    number(LATENESS, ONE, "Way between two corrections, over that of the card", |it| it.lateness),
    DISTANCE.number("Way that is driven", |it| it.way),
    STATED_DRIFT.number("Drift below which the card states that 97.5 % stay", |it| it.stated_drift),
    PROBABILITY_WITHIN.probability("Share of the drives that stay within it", |it| Some(it.within)),
    DRIVEN_DRIFT.band("Drift of the drives; 1 where the rover gets stuck", |it| it.drift),
    STATED_STUCK
        .probability("Share of the card's samples that are stuck", |it| Some(it.stated_stuck)),
    PROBABILITY_STUCK_WITHOUT_CHECKS
        .probability("Share of the drives that get stuck", |it| Some(it.stuck)),
    whole(DRIVES, "Drives", |it| Some(it.within.trials)),
];

/// A row for each slope and driver.
#[must_use]
pub fn table(rows: &[RowDrives]) -> Table {
    Table::of(&COLUMNS, rows)
}

/// The columns of [`table`] for reading.
#[must_use]
pub fn brief() -> Vec<String> {
    let [_, _, high] = DRIVEN_DRIFT.quantiles();
    let names = [SLOPE.name, VERDICT, LATENESS, DISTANCE.name, STATED_DRIFT.name, &high];
    let after =
        [PROBABILITY_WITHIN.name, STATED_STUCK.name, PROBABILITY_STUCK_WITHOUT_CHECKS.name, DRIVES];
    names.into_iter().chain(after).map(String::from).collect()
}
