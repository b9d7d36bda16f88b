//! The columns of a model beside measurements: cells and trials, measured and predicted.

use super::super::measurements::Measurements;
use super::super::table::Table;
use super::flags;
use super::{
    Column, DRAWBAR_PULL, LOAD, OK, Quantity, RIM_SPEED_SETTING, SIDE_FORCE, SINKAGE, SLIP_ANGLE,
    SLIP_RATIO, STATUS, TORQUE, TOTAL_SLIP, text, whole,
};
use crate::contact::{SettleError, Settled};
use crate::studies::measurement::{Quantity as Measured, Trial};
use crate::studies::validation::{CellComparison, Group, Validation};

/// The column of a measured quantity.
#[must_use]
pub const fn column_of(measured: Measured) -> Quantity {
    match measured {
        Measured::DrawbarPull => DRAWBAR_PULL,
        Measured::SideForce => SIDE_FORCE,
        Measured::Sinkage => SINKAGE,
        Measured::Torque => TORQUE,
    }
}

/// A cell's condition.
const CELL: [Column<CellComparison>; 7] = [
    SLIP_ANGLE.given("Slip angle", |it| Some(it.slip_angle)),
    text(MOTION, "`driven` or `skid`", |it| Some(motion(Some(it.driven)).into())),
    TOTAL_SLIP.number("Slip by the total speed", |it| it.total_slip),
    LOAD.number("Load, the mean over the trials", |it| it.load),
    RIM_SPEED_SETTING.maybe("Rim speed that was set", |it| it.rim_speed),
    whole("trials", "How many trials it has", |it| Some(it.trials)),
    whole(UNSETTLED, "How many of them the soil cannot carry, by the model", |it| {
        Some(it.unsettled)
    }),
];

/// The columns that tell cells apart.
pub const SETTINGS: [&str; 2] = [SLIP_ANGLE.name, TOTAL_SLIP.name];

/// Why a cell is an extrapolation.
const FLAGS: [Column<CellComparison>; 1] = [flags::flags(|it| flags::names(&it.findings))];

/// Means over a cell: measured, the standard deviation between the trials or within a single one,
/// and predicted.
const MEANS: [Column<CellComparison>; 4] = [
    DRAWBAR_PULL.compared("Drawbar pull", |it| means(it, Measured::DrawbarPull)),
    SIDE_FORCE.compared("Side force", |it| means(it, Measured::SideForce)),
    SINKAGE.compared("Sinkage", |it| means(it, Measured::Sinkage)),
    TORQUE.compared("Torque", |it| means(it, Measured::Torque)),
];

const MOTION: &str = "motion";
const UNSETTLED: &str = "unsettled_trials";

fn means(cell: &CellComparison, measured: Measured) -> [Option<f64>; 3] {
    cell.quantities[measured].as_ref().map_or([None; 3], |it| {
        [Some(it.measured), it.repeatability.or(it.scatter), Some(it.predicted)]
    })
}

/// The cells of a validation; quantities that were not measured are missing.
#[must_use]
pub fn cells(cells: &[CellComparison]) -> Table {
    let rows: Vec<Option<&CellComparison>> = cells.iter().map(Some).collect();
    Table::default().and(&CELL, &rows).and(&MEANS, &rows).and(&FLAGS, &rows)
}

struct OfTrial<'a> {
    line: u64,
    trial: &'a Trial,
    prediction: &'a Result<Settled, SettleError>,
}

const fn condition<'a>() -> [Column<OfTrial<'a>>; 4] {
    [
        whole("line", "The line of the measurement file", |it| usize::try_from(it.line).ok()),
        SLIP_ANGLE.number("Slip angle", |it| it.trial.slip.angle),
        SLIP_RATIO.number("Slip ratio", |it| it.trial.slip.ratio),
        LOAD.number("Load", |it| it.trial.load),
    ]
}

const fn readings<'a>() -> [Column<OfTrial<'a>>; 5] {
    [
        DRAWBAR_PULL.measured("Drawbar pull", |it| pair(it, Measured::DrawbarPull)),
        SIDE_FORCE.measured("Side force", |it| pair(it, Measured::SideForce)),
        SINKAGE.measured("Sinkage", |it| pair(it, Measured::Sinkage)),
        TORQUE.measured("Torque", |it| pair(it, Measured::Torque)),
        text(STATUS, "`ok`, or why there is no prediction", |it| {
            Some(it.prediction.as_ref().map_or_else(SettleError::to_string, |_| OK.to_owned()))
        }),
    ]
}

fn pair(it: &OfTrial<'_>, measured: Measured) -> [Option<f64>; 2] {
    let settled = it.prediction.as_ref().ok();
    [
        it.trial.readings[measured].map(|reading| reading.value),
        settled.map(|settled| measured.of(settled)),
    ]
}

/// Every trial with its prediction, in the order of the file.
#[must_use]
pub fn trials(measurements: &Measurements, validation: &Validation) -> Table {
    let trials = measurements.tests.trials.iter().zip(&measurements.lines);
    let rows = trials.zip(&validation.predictions);
    let rows: Vec<OfTrial<'_>> = rows
        .map(|((trial, line), prediction)| OfTrial { line: *line, trial, prediction })
        .collect();
    let rows: Vec<Option<&OfTrial<'_>>> = rows.iter().map(Some).collect();
    Table::default().and(&condition(), &rows).and(&readings(), &rows)
}

/// Which cells a group has.
pub(in super::super) fn motion(driven: Option<bool>) -> &'static str {
    match driven {
        Some(true) => "driven",
        Some(false) => "skid",
        None => "all",
    }
}

/// A group of cells; its errors are beside it.
pub(in super::super) const GROUP: [Column<Group>; 5] = [
    SLIP_ANGLE.given("Slip angle of the cells; none for all of them", |it| it.slip_angle),
    text(MOTION, "`driven`, `skid`, or `all`", |it| Some(motion(it.driven).into())),
    whole("cells", "How many cells there are", |it| Some(it.cells)),
    whole("trials", "How many trials they have", |it| Some(it.trials)),
    whole(
        UNSETTLED,
        "How many trials the soil cannot carry, by the model; they are in no error",
        |it| Some(it.unsettled),
    ),
];
