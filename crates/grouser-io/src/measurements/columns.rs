//! The columns of measurement files: their names, units and meanings.

use std::ops::RangeInclusive;
use std::sync::LazyLock;

use super::super::columns::flags::FLAGS;
use super::super::columns::wheel::{NORMAL_FORCE, WHEEL};
use super::super::columns::{
    DRAWBAR_PULL, DRAWS, LOAD, PROBABILITY_CARRIED, Quantity as Named, RIM_SPEED_SETTING,
    SIDE_FORCE, SINKAGE, SLIP_ANGLE, SLIP_RATIO, TORQUE, TOTAL_SLIP,
};
use super::super::unit::{M, M_S, MM, MM_S, N, NM, ONE, QUANTILES, Unit};
use crate::measurements::wheel_tests::Quantity;

/// The meaning of a column.
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
    /// Drawbar pull over the load of the same row.
    PullOverLoad,
    /// Side force that counts as positive where it opposes the hub's sideways motion.
    OpposingSideForce,
    /// Standard deviation within the trial.
    Scatter(Quantity),
    /// Which wheel.
    Wheel,
    /// The number of the repeat: not used.
    Trial,
    /// Which rows repeat each other.
    Cell,
    /// Whether the row counts: `ok` or nothing; anything else says why it does not.
    Status,
    /// A length of a plate or shear test.
    BevameterLength,
    /// A pressure or stress of a plate or shear test.
    BevameterStress,
    /// Known, and of no use here.
    Unused,
}

/// A column that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name in the header.
    pub name: &'static str,
    /// Its meaning.
    pub meaning: Meaning,
    /// Its unit.
    pub unit: Unit,
    /// What its values may be, in its own unit.
    pub range: RangeInclusive<f64>,
}

const FORCE: RangeInclusive<f64> = -1e5..=1e5;
const NOT_NEGATIVE: RangeInclusive<f64> = 0.0..=1e5;
const PULL_OVER_LOAD: RangeInclusive<f64> = -10.0..=10.0;
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
    unit: Unit,
    range: RangeInclusive<f64>,
) -> Column {
    Column { name, meaning, unit, range }
}

/// A column with the name and the unit of a result.
const fn of(quantity: Named, meaning: Meaning, range: RangeInclusive<f64>) -> Column {
    column(quantity.name, meaning, quantity.unit, range)
}

/// What stands write. Names of the same meaning differ in unit, or in whose files they
/// are: `longitudinal_force_n`, `normal_force_n` and `peripheral_speed_…` are those of the open
/// single-wheel data of Carnegie Mellon University.
const READ: [Column; 33] = {
    use Meaning::{
        Cell, Load, LoadSetting, Reading, RimSpeed, RimSpeedSetting, Scatter, SlipAngle, SlipRatio,
        Status, TotalSlip, TravelSpeed, Trial, Unused, Wheel,
    };
    use Quantity::{DrawbarPull, SideForce, Sinkage, Torque};
    [
        column("wheel", Wheel, ONE, ANY),
        column("cell", Cell, ONE, ANY),
        column("trial", Trial, ONE, ANY),
        of(SLIP_RATIO, SlipRatio, SLIP),
        of(TOTAL_SLIP, TotalSlip, SLIP),
        of(SLIP_ANGLE, SlipAngle, RIGHT_ANGLE),
        column("travel_speed_m_s", TravelSpeed, M_S, TRAVEL_M_S),
        column("travel_speed_mm_s", TravelSpeed, MM_S, TRAVEL_MM_S),
        column("rim_speed_m_s", RimSpeed, M_S, SPEED_M_S),
        column("rim_speed_mm_s", RimSpeed, MM_S, SPEED_MM_S),
        column("peripheral_speed_mm_s", RimSpeed, MM_S, SPEED_MM_S),
        of(RIM_SPEED_SETTING, RimSpeedSetting, SPEED_M_S),
        column("rim_speed_setting_mm_s", RimSpeedSetting, MM_S, SPEED_MM_S),
        column("peripheral_speed_setpoint_mm_s", RimSpeedSetting, MM_S, SPEED_MM_S),
        of(LOAD, Load, NOT_NEGATIVE),
        of(NORMAL_FORCE, Load, NOT_NEGATIVE),
        column("load_setting_n", LoadSetting, N, NOT_NEGATIVE),
        of(DRAWBAR_PULL, Reading(DrawbarPull), FORCE),
        column("longitudinal_force_n", Reading(DrawbarPull), N, FORCE),
        column("drawbar_pull_over_load", Meaning::PullOverLoad, ONE, PULL_OVER_LOAD),
        of(SIDE_FORCE, Reading(SideForce), FORCE),
        column("side_force_opposing_n", Meaning::OpposingSideForce, N, FORCE),
        of(TORQUE, Reading(Torque), FORCE),
        of(SINKAGE, Reading(Sinkage), SINKAGE_MM),
        column("sinkage_m", Reading(Sinkage), M, SINKAGE_M),
        column("drawbar_pull_std_n", Scatter(DrawbarPull), N, NOT_NEGATIVE),
        column("longitudinal_force_std_n", Scatter(DrawbarPull), N, NOT_NEGATIVE),
        column("side_force_std_n", Scatter(SideForce), N, NOT_NEGATIVE),
        column("torque_std_nm", Scatter(Torque), NM, NOT_NEGATIVE),
        column("sinkage_std_mm", Scatter(Sinkage), MM, NOT_NEGATIVE),
        column("status", Status, ONE, ANY),
        column("normal_force_std_n", Unused, N, ANY),
        column(FLAGS, Unused, ONE, ANY),
    ]
};

/// Every column that is known: what stands write, and what results of wheels have beyond that.
pub static COLUMNS: LazyLock<Vec<Column>> = LazyLock::new(|| {
    let is_read = |name: &str| READ.iter().any(|column| column.name == name);
    let others = WHEEL.iter().filter(|result| !is_read(result.name));
    let others = others.map(|result| column(result.name, Meaning::Unused, result.unit, ANY));
    READ.into_iter().chain(others).collect()
});

/// Whether a column is one of the bands that Grouser writes beside results: quantiles of a known
/// column, the probability that the soil carries the wheel, the number of samples.
pub(super) fn is_of_a_band(name: &str) -> bool {
    let is_quantile = |end: &str| name.strip_suffix(end).is_some_and(|of| known(of).is_some());
    QUANTILES.iter().any(|end| is_quantile(end))
        || PROBABILITY_CARRIED.interval().iter().any(|known| known == name)
        || name == DRAWS
}

/// The column whose presence tells a file of Carnegie Mellon's: there `side_force_n` is positive
/// where it opposes the hub's sideways motion.
pub(super) const OF_OPPOSING_SIDE_FORCES: &str = "longitudinal_force_n";

/// Whether a column has the time, so that rows are samples of runs and no trials.
pub(super) fn is_of_time(name: &str) -> bool {
    const TIMES: [&str; 7] = ["time", "t", "timestamp", "stamp", "elapsed", "seconds", "sample"];
    /// Units of the time, behind such a name.
    const UNITS: [&str; 4] = ["_s", "_ms", "_us", "_ns"];
    let name = name.to_ascii_lowercase();
    let bare = UNITS.into_iter().find_map(|unit| name.strip_suffix(unit));
    TIMES.contains(&bare.unwrap_or(&name))
}

/// The column of a name.
#[must_use]
pub fn known(name: &str) -> Option<&'static Column> {
    COLUMNS.iter().find(|column| column.name == name)
}
