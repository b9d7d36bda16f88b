//! The columns of a settled wheel: sinkage, forces, moments and angles.

use super::super::unit::{DEG, KPA, N, NM};
use super::{Column, DRAWBAR_PULL, Quantity, SIDE_FORCE, SINKAGE, TORQUE, number, quantity};
use grouser_core::contact::Settled;

pub const NORMAL_FORCE: Quantity = quantity("normal_force_n", N);
pub const ENTRY_ANGLE: Quantity = quantity("entry_angle_deg", DEG);
pub const MAX_NORMAL_STRESS: Quantity = quantity("max_normal_stress_kpa", KPA);

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
