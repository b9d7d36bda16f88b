//! How rough heights of a grid are.

use super::super::table::Table;
use super::super::unit::{DEG, M};
use super::{Column, Quantity, quantity};
use crate::terrain::roughness::Deviation;

/// Distance between the points that are compared.
pub const BASELINE: Quantity = quantity("baseline_m", M);

const COLUMNS: [Column<Deviation>; 4] = [
    BASELINE.number("Distance between the points, along rows and columns", |it| it.baseline),
    quantity("rms_deviation_m", M)
        .number("Root mean square of the differences of their heights", |it| it.rms_deviation),
    quantity("rms_slope_deg", DEG).number(
        "Inclination whose tangent is the root mean square of the slopes along rows and columns",
        Deviation::rms_slope,
    ),
    quantity("median_slope_deg", DEG)
        .number("Median of the slope of the ground, between the points", |it| it.median_slope),
];

/// The names of the columns.
#[must_use]
pub fn names() -> [&'static str; 4] {
    COLUMNS.map(|column| column.name)
}

/// A row for each distance.
#[must_use]
pub fn table(deviations: &[Deviation]) -> Table {
    Table::of(&COLUMNS, deviations)
}
