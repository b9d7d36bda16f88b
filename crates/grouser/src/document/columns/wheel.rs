//! The columns of a settled wheel: sinkage, forces, moments and angles.

use super::super::table::Table;
use super::super::unit::{DEG, KPA, N, NM};
use super::{
    Column, DRAWBAR_PULL, LOAD, OK, Quantity, SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, STATUS,
    TORQUE, number, quantity, text,
};
use crate::contact::Settled;
use crate::studies::wheel_test::WheelTestRow;

pub(in super::super) const NORMAL_FORCE: Quantity = quantity("normal_force_n", N);
const ENTRY_ANGLE: Quantity = quantity("entry_angle_deg", DEG);
pub(super) const MAX_NORMAL_STRESS: Quantity = quantity("max_normal_stress_kpa", KPA);

/// The results of a wheel; angles are from straight down, moments about the hub.
pub const WHEEL: [Column<Settled>; 15] = [
    SINKAGE.number("Sinkage of the grouser tips", |it| it.sinkage),
    ENTRY_ANGLE.number("Entry angle", |it| it.forces.patch.entry),
    number("exit_angle_deg", DEG, "Exit angle, not positive", |it| it.forces.patch.exit),
    number("max_stress_angle_deg", DEG, "Angle of the largest normal stress", |it| {
        it.forces.patch.max_stress
    }),
    DRAWBAR_PULL.number("Force along the wheel: thrust less motion resistance", |it| {
        it.forces.drawbar_pull
    }),
    SIDE_FORCE.number("Force across the wheel, positive to the left", |it| it.forces.side_force),
    number("side_force_from_shear_n", N, "Part of the side force from shear", |it| {
        it.forces.side_force_from_shear
    }),
    number(
        "bulldozing_load_n",
        N,
        "Full load of the soil that the side wall pushes aside, before the slip angle's share",
        |it| it.forces.bulldozing_load,
    ),
    NORMAL_FORCE.number("Force out of the ground", |it| it.forces.normal_force),
    TORQUE.number("Torque of the drive, positive while it drives the wheel forward", |it| {
        it.forces.torque
    }),
    number("overturning_moment_nm", NM, "Moment about the wheel's long axis", |it| {
        it.forces.overturning_moment
    }),
    number("aligning_moment_nm", NM, "Moment about the wheel's upright axis", |it| {
        it.forces.aligning_moment
    }),
    number("thrust_n", N, "Part of the drawbar pull from shear", |it| it.forces.thrust),
    number(
        "motion_resistance_n",
        N,
        "Part of the drawbar pull from normal stress and bulldozing; it counts negative",
        |it| it.forces.motion_resistance,
    ),
    MAX_NORMAL_STRESS.number("Largest normal stress on the rim", |it| it.forces.max_normal_stress),
];

/// The settings of a test stand, and the status of the wheel.
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

/// The rows of a wheel test. Results are missing where `status` is not `ok`.
#[must_use]
pub fn table(rows: &[WheelTestRow]) -> Table {
    let settled: Vec<Option<&Settled>> = rows.iter().map(|row| row.result.as_ref().ok()).collect();
    Table::of(&SETTING, rows).and(&WHEEL, &settled)
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
    ]
    .map(String::from)
    .into()
}
