//! Designs: a row for each limit, and a row for each rover that was measured.

use serde_json::Value as Json;

use super::super::design::Measure;
use super::super::table::{Table, Values};
use super::super::unit::ONE;
use super::{Column, flags, number, text, whole};
use crate::contact::validity::Finding;
use crate::studies::design::{KeptLimit, Measures};

/// What a row is of.
pub const ROW: &str = "row";
/// The wheel–soil model of a row.
pub const MODEL: &str = "model";
/// What was chosen for a row.
pub const CHOSEN: &str = "chosen";
/// The share of fresh samples that keeps a limit.
pub const SHARE: &str = "share";

/// A limit, and how a design keeps it.
pub const LIMITS: &[Column<KeptLimit>] = &[
    whole("ground", "The ground: 1 for the document's own, then those of `also`", |it| {
        Some(it.limit.ground + 1)
    }),
    text("name", "What is limited", |it| Some(it.limit.measure.name().to_owned())),
    text("side", "`at_least` or `at_most`", |it| Some(it.limit.side.name().to_owned())),
    number("bound", ONE, "The limit, in the unit of its name", |it| {
        it.limit.measure.unit().as_given(it.limit.bound)
    }),
    number("value", ONE, "What the design has, in the unit of its name", |it| {
        it.limit.measure.unit().from_si(it.value)
    }),
    number(
        "price",
        ONE,
        "By how much the aim falls if the limit is loosened by one, each in its unit",
        |it| it.price,
    ),
    super::maybe(SHARE, ONE, "Share of fresh samples of soil and model that keeps it", |it| {
        it.share
    }),
];

/// A rover that was measured.
#[derive(Clone, Debug)]
pub struct DesignRow {
    /// Whether it was given or found.
    pub name: String,
    /// The model by which it was measured.
    pub model: String,
    /// What was chosen for it.
    pub chosen: Vec<(String, Json)>,
    /// Its free numbers, in their keys' units; none where there is no such rover.
    pub values: Vec<f64>,
    /// What is measured of it; nothing where it does not move.
    pub measures: Option<Measures>,
    /// Where it is outside of what its model and the soils were tested for.
    pub findings: Vec<Finding>,
}

impl DesignRow {
    fn measure(&self, measure: Measure) -> Option<f64> {
        Some(self.measures?[measure.place()]).filter(|it| it.is_finite())
    }
}

/// What is measured of a rover on the first ground.
pub const DESIGNS: &[Column<DesignRow>] = &[
    text(ROW, "`as given`, `found`, or `found by it`: by the model of the row", |it| {
        Some(it.name.clone())
    }),
    text(MODEL, "The wheel–soil model that measures it", |it| Some(it.model.clone())),
    text(CHOSEN, "What was chosen for it", |it| {
        let chosen = it.chosen.iter().map(|(key, value)| format!("{key}={value}"));
        (!it.chosen.is_empty()).then(|| chosen.collect::<Vec<_>>().join(", "))
    }),
    measured(Measure::LimitSlope, |it| it.measure(Measure::LimitSlope)),
    measured(Measure::SinkageRatio, |it| it.measure(Measure::SinkageRatio)),
    measured(Measure::SlipRatio, |it| it.measure(Measure::SlipRatio)),
    measured(Measure::EnergyPerMetre, |it| it.measure(Measure::EnergyPerMetre)),
    measured(Measure::Crab, |it| it.measure(Measure::Crab)),
    measured(Measure::Torque, |it| it.measure(Measure::Torque)),
    measured(Measure::BrakingTorque, |it| it.measure(Measure::BrakingTorque)),
    measured(Measure::Current, |it| it.measure(Measure::Current)),
    measured(Measure::TippingSlope, |it| it.measure(Measure::TippingSlope)),
    measured(Measure::Width, |it| it.measure(Measure::Width)),
    measured(Measure::WheelMass, |it| it.measure(Measure::WheelMass)),
    flags::flags(|it| flags::names(&it.findings)),
];

const fn measured(measure: Measure, of: fn(&DesignRow) -> Option<f64>) -> Column<DesignRow> {
    super::maybe(measure.name(), measure.unit(), measure.doc(), of)
}

/// The limits, and how a design keeps them.
#[must_use]
pub fn limits(kept: &[KeptLimit]) -> Table {
    Table::of(LIMITS, kept)
}

/// Rovers that were measured, with a column for each free number.
#[must_use]
pub fn designs(rows: &[DesignRow], keys: &[&str]) -> Table {
    let mut table = Table::of(DESIGNS, rows);
    for (place, key) in keys.iter().enumerate() {
        let values = rows.iter().map(|row| row.values.get(place).copied()).collect();
        table.columns.push(((*key).to_owned(), Values::Float(values)));
    }
    table
}
