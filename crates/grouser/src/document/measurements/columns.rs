//! The columns of measurement files: their names, units and meanings.

use std::ops::RangeInclusive;

use crate::studies::measurement::Quantity;

/// What a column tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Grouser's slip ratio, by the speed along the wheel.
    SlipRatio,
    /// The slip by the total speed, (rim − travel)/max(rim, travel).
    TotalSlip,
    /// Slip angle, between the wheel's plane and its way; positive where the hub moves left.
    SlipAngle,
    /// Speed of the hub over the ground, in whatever direction.
    TravelSpeed,
    /// Speed of the rim, ω r_s.
    RimSpeed,
    /// The rim speed that was set.
    RimSpeedSetting,
    /// The load that the wheel carried.
    Load,
    /// The load that was set.
    LoadSetting,
    /// What was read.
    Reading(Quantity),
    /// Side force that counts as positive where it opposes the hub's sideways motion.
    OpposingSideForce,
    /// Standard deviation within the trial.
    Scatter(Quantity),
    /// Which wheel.
    Wheel,
    /// Which repeat: not used, for rows are told apart already.
    Trial,
    /// Which rows repeat each other.
    Cell,
    /// Whether the row counts: `ok` or nothing; anything else says why it does not.
    Status,
    /// Known, and of no use here.
    Unused,
}

/// A column that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name in the header.
    pub name: &'static str,
    /// What it tells.
    pub meaning: Meaning,
    /// Factor from its unit to SI.
    pub to_si: f64,
    /// What its values may be, in its own unit.
    pub range: RangeInclusive<f64>,
}

const FORCE: RangeInclusive<f64> = -1e5..=1e5;
const LOAD: RangeInclusive<f64> = 0.0..=1e5;
const SLIP: RangeInclusive<f64> = -2.0..=2.0;
const RIGHT_ANGLE: RangeInclusive<f64> = -90.0..=90.0;
const SPEED_MM_S: RangeInclusive<f64> = -1e4..=1e4;
const SPEED_M_S: RangeInclusive<f64> = -10.0..=10.0;
const TRAVEL_MM_S: RangeInclusive<f64> = 0.0..=1e4;
const TRAVEL_M_S: RangeInclusive<f64> = 0.0..=10.0;
/// Sinkage is measured from a surface that is never quite level, so that it may start below zero.
const SINKAGE_MM: RangeInclusive<f64> = -100.0..=2000.0;
const SINKAGE_M: RangeInclusive<f64> = -0.1..=2.0;
const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

const fn column(
    name: &'static str,
    meaning: Meaning,
    to_si: f64,
    range: RangeInclusive<f64>,
) -> Column {
    Column { name, meaning, to_si, range }
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Every column that is known. Names of the same meaning differ in unit, or in whose files they
/// are: `longitudinal_force_n`, `normal_force_n` and `peripheral_speed_…` are those of the open
/// single-wheel data of Carnegie Mellon University.
pub static COLUMNS: [Column; 41] = {
    use Meaning::{
        Cell, Load, LoadSetting, Reading, RimSpeed, RimSpeedSetting, Scatter, SlipAngle, SlipRatio,
        Status, TotalSlip, TravelSpeed, Trial, Unused, Wheel,
    };
    use Quantity::{DrawbarPull, SideForce, Sinkage, Torque};
    [
        column("wheel", Wheel, 1.0, ANY),
        column("cell", Cell, 1.0, ANY),
        column("trial", Trial, 1.0, ANY),
        column("slip_ratio", SlipRatio, 1.0, SLIP),
        column("slip_ratio_total_speed", TotalSlip, 1.0, SLIP),
        column("slip_angle_deg", SlipAngle, DEGREE, RIGHT_ANGLE),
        column("travel_speed_m_s", TravelSpeed, 1.0, TRAVEL_M_S),
        column("travel_speed_mm_s", TravelSpeed, 1e-3, TRAVEL_MM_S),
        column("rim_speed_m_s", RimSpeed, 1.0, SPEED_M_S),
        column("rim_speed_mm_s", RimSpeed, 1e-3, SPEED_MM_S),
        column("peripheral_speed_mm_s", RimSpeed, 1e-3, SPEED_MM_S),
        column("rim_speed_setting_m_s", RimSpeedSetting, 1.0, SPEED_M_S),
        column("rim_speed_setting_mm_s", RimSpeedSetting, 1e-3, SPEED_MM_S),
        column("peripheral_speed_setpoint_mm_s", RimSpeedSetting, 1e-3, SPEED_MM_S),
        column("load_n", Load, 1.0, LOAD),
        column("normal_force_n", Load, 1.0, LOAD),
        column("load_setting_n", LoadSetting, 1.0, LOAD),
        column("drawbar_pull_n", Reading(DrawbarPull), 1.0, FORCE),
        column("longitudinal_force_n", Reading(DrawbarPull), 1.0, FORCE),
        column("side_force_n", Reading(SideForce), 1.0, FORCE),
        column("side_force_opposing_n", Meaning::OpposingSideForce, 1.0, FORCE),
        column("torque_nm", Reading(Torque), 1.0, FORCE),
        column("sinkage_mm", Reading(Sinkage), 1e-3, SINKAGE_MM),
        column("sinkage_m", Reading(Sinkage), 1.0, SINKAGE_M),
        column("drawbar_pull_std_n", Scatter(DrawbarPull), 1.0, LOAD),
        column("longitudinal_force_std_n", Scatter(DrawbarPull), 1.0, LOAD),
        column("side_force_std_n", Scatter(SideForce), 1.0, LOAD),
        column("torque_std_nm", Scatter(Torque), 1.0, LOAD),
        column("sinkage_std_mm", Scatter(Sinkage), 1e-3, LOAD),
        column("status", Status, 1.0, ANY),
        column("normal_force_std_n", Unused, 1.0, ANY),
        // What `grouser wheel-test` tells beyond what a stand reads.
        column("entry_angle_deg", Unused, DEGREE, ANY),
        column("exit_angle_deg", Unused, DEGREE, ANY),
        column("max_stress_angle_deg", Unused, DEGREE, ANY),
        column("side_force_from_shear_n", Unused, 1.0, ANY),
        column("bulldozing_load_n", Unused, 1.0, ANY),
        column("overturning_moment_nm", Unused, 1.0, ANY),
        column("aligning_moment_nm", Unused, 1.0, ANY),
        column("thrust_n", Unused, 1.0, ANY),
        column("motion_resistance_n", Unused, 1.0, ANY),
        column("max_normal_stress_kpa", Unused, 1e3, ANY),
    ]
};

/// The column whose presence tells a file of Carnegie Mellon's: there `side_force_n` is positive
/// where it opposes the hub's sideways motion.
pub(super) const OF_OPPOSING_SIDE_FORCES: &str = "longitudinal_force_n";

/// The column of a name.
#[must_use]
pub fn known(name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|column| column.name == name)
}
