//! The columns of recorded drives beside predictions: each cell with each model, and each drive.

use super::super::table::Table;
use super::super::unit::M;
use super::advice::RIM_SPEED;
use super::learn::gross_in_words;
use super::run::YAW_RATE;
use super::{Column, DRIFT, MODEL, POWER, Quantity, SLIP_RATIO, SLOPE, YAW, quantity, text, whole};
use crate::studies::drive_validation::{DriveCell, DriveQuantity, DriveValidation, RecordedDrive};

/// Radius of a turn.
pub const TURN_RADIUS: Quantity = quantity("turn_radius_m", M);
/// The set of a drive: `training` or `test`.
pub const SPLIT: &str = "split";
/// How many drives repeat each other in a cell.
pub const TRIALS: &str = "trials";
/// How many of them have no prediction.
pub const NO_PREDICTION: &str = "no_prediction";

/// The name and unit of what is compared.
#[must_use]
pub const fn quantity_of(quantity: DriveQuantity) -> Quantity {
    match quantity {
        DriveQuantity::SlipRatio => SLIP_RATIO,
        DriveQuantity::Drift => DRIFT,
        DriveQuantity::YawRate => YAW_RATE,
        DriveQuantity::Power => POWER,
    }
}

/// A cell beside a model.
pub struct DriveScores<'a> {
    cell: &'a DriveCell,
    model: usize,
}

impl DriveScores<'_> {
    fn compared(&self, quantity: DriveQuantity) -> [Option<f64>; 3] {
        let place = quantity as usize;
        let measured = self.cell.measured[place];
        let predicted = self.cell.predicted[self.model][place];
        [measured.map(|it| it.value), measured.and_then(|it| it.deviation), predicted]
    }
}

/// The columns of a cell beside a model.
#[must_use]
pub const fn cell_columns<'a>() -> [Column<DriveScores<'a>>; 11] {
    [
        text(SPLIT, "The set of the drives: `training` or `test`", |it| {
            Some(it.cell.split.name().to_owned())
        }),
        SLOPE.given("Slope of the ground, in classes of 5°", |it| Some(it.cell.conditions.slope)),
        YAW.given("Yaw from the contour, in classes of 45°; none on level ground", |it| {
            it.cell.conditions.yaw
        }),
        TURN_RADIUS.given(
            "Radius of the turn that the rims would make, to one digit, positive to the left; none \
             straight on",
            |it| it.cell.conditions.radius,
        ),
        RIM_SPEED.given("Speed that the rims would give the body, to one digit", |it| {
            Some(it.cell.conditions.speed)
        }),
        whole(TRIALS, "How many drives have such stretches", |it| Some(it.cell.trials)),
        whole(NO_PREDICTION, "How many of them the model predicts nothing for", |it| {
            Some(it.cell.no_prediction[it.model])
        }),
        SLIP_RATIO.compared(
            "Mean slip ratio of the wheels: measured, the standard deviation between drives, and \
             predicted",
            |it| it.compared(DriveQuantity::SlipRatio),
        ),
        DRIFT.compared("Way downhill per metre travelled, the same; none on level ground", |it| {
            it.compared(DriveQuantity::Drift)
        }),
        YAW_RATE.compared("Yaw rate, the same", |it| it.compared(DriveQuantity::YawRate)),
        POWER.compared("Mechanical power of all wheels, the same", |it| {
            it.compared(DriveQuantity::Power)
        }),
    ]
}

/// A row for each cell with each model, in the order of the names.
///
/// * `models`: the names of the models that were asked
#[must_use]
pub fn cells(validation: &DriveValidation, models: &[&str]) -> Table {
    let mut all = Table::default();
    for (model, name) in models.iter().enumerate() {
        let rows: Vec<DriveScores<'_>> =
            validation.cells.iter().map(|cell| DriveScores { cell, model }).collect();
        all.append(Table::of(&cell_columns(), &rows).with_word(MODEL, name));
    }
    all
}

/// The columns of a drive.
pub const DRIVE: [Column<RecordedDrive>; 5] = [
    text("drive", "The file, seen from the folder", |it| Some(it.name.clone())),
    text(SPLIT, "The set that it belongs to, by a hash of its readings", |it| {
        Some(it.split.name().to_owned())
    }),
    whole("records", "How many records it has", |it| Some(it.records)),
    whole("stretches", "How many stretches of a decimetre or so", |it| Some(it.stretches.len())),
    text("gross_faults", "Gross faults of its telemetry, which are left out", |it| {
        let faults: Vec<String> = it.gross_faults.iter().map(gross_in_words).collect();
        (!faults.is_empty()).then(|| faults.join("; "))
    }),
];

/// A row for each drive.
#[must_use]
pub fn drives(drives: &[RecordedDrive]) -> Table {
    Table::of(&DRIVE, drives)
}
