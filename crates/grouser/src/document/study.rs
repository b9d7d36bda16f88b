//! Results of wheel tests and attitudes in the words of tables, JSON and CSV.

use std::ops::RangeInclusive;

use serde::Serialize;

use crate::studies::attitude::{Attitude, AttitudeCurve, NoAttitude};
use crate::studies::attitude_band::{AttitudeBand, SlopeBand};
use crate::studies::attitude_map::{AttitudeMap, AttitudeRow};
use crate::studies::ensemble::Band;
use crate::studies::wheel_test::WheelTestRow;
use crate::vehicle::Rover;

/// Loads that a wheel test may ask for [N].
pub const LOAD_N: RangeInclusive<f64> = 0.0..=1e5;
/// Slip ratios that a wheel test may ask for [-].
pub const SLIP_RATIO: RangeInclusive<f64> = -2.0..=2.0;
/// Slip angles that a wheel test may ask for [°].
pub const SLIP_ANGLE_DEG: RangeInclusive<f64> = -90.0..=90.0;

/// Courses that an attitude map may ask for [°].
pub const COURSE_DEG: RangeInclusive<f64> = -90.0..=90.0;
/// Rim speeds that an attitude map may ask for [m/s].
pub const MAP_SPEED_M_S: RangeInclusive<f64> = 1e-6..=10.0;

/// Status of a row that has its results.
pub const OK: &str = "ok";

/// One setting of the wheel test stand. Results are null where `status` is not `ok`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WheelTestRecord {
    /// Load on the wheel [N].
    pub load_n: f64,
    /// Slip angle [°], positive where the hub moves to the left.
    pub slip_angle_deg: f64,
    /// Slip ratio [-], positive where the wheel drives.
    pub slip_ratio: f64,
    /// `ok`, or why there is no result.
    pub status: String,
    /// Results, null together.
    #[serde(flatten)]
    pub wheel: WheelRecord,
}

/// What the soil does to a settled wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct WheelRecord {
    /// Sinkage of the grouser tips [mm].
    pub sinkage_mm: Option<f64>,
    /// Entry angle [°] from straight down.
    pub entry_angle_deg: Option<f64>,
    /// Exit angle [°] from straight down, not positive.
    pub exit_angle_deg: Option<f64>,
    /// Angle of the largest normal stress [°].
    pub max_stress_angle_deg: Option<f64>,
    /// Force along the wheel [N].
    pub drawbar_pull_n: Option<f64>,
    /// Force across the wheel [N], positive to the left.
    pub side_force_n: Option<f64>,
    /// Part of the side force from shear [N].
    pub side_force_from_shear_n: Option<f64>,
    /// Full load of the soil that the flank pushes aside [N], before the slip angle's share of it.
    pub bulldozing_load_n: Option<f64>,
    /// Force out of the ground [N].
    pub normal_force_n: Option<f64>,
    /// Driving torque [N·m].
    pub torque_nm: Option<f64>,
    /// Overturning moment about the hub [N·m].
    pub overturning_moment_nm: Option<f64>,
    /// Aligning moment about the hub [N·m].
    pub aligning_moment_nm: Option<f64>,
    /// Part of the drawbar pull from shear [N].
    pub thrust_n: Option<f64>,
    /// Part of the drawbar pull from normal stress and bulldozing [N], negative.
    pub motion_resistance_n: Option<f64>,
    /// Largest normal stress on the rim [kPa].
    pub max_normal_stress_kpa: Option<f64>,
}

impl WheelRecord {
    /// The record of a settled wheel, all of it known.
    #[must_use]
    pub fn new(settled: &crate::contact::Settled) -> Self {
        let forces = &settled.forces;
        Self {
            sinkage_mm: Some(settled.sinkage * 1e3),
            entry_angle_deg: Some(forces.patch.entry.to_degrees()),
            exit_angle_deg: Some(forces.patch.exit.to_degrees()),
            max_stress_angle_deg: Some(forces.patch.max_stress.to_degrees()),
            drawbar_pull_n: Some(forces.drawbar_pull),
            side_force_n: Some(forces.side_force),
            side_force_from_shear_n: Some(forces.side_force_from_shear),
            bulldozing_load_n: Some(forces.bulldozing_load),
            normal_force_n: Some(forces.normal_force),
            torque_nm: Some(forces.torque),
            overturning_moment_nm: Some(forces.overturning_moment),
            aligning_moment_nm: Some(forces.aligning_moment),
            thrust_n: Some(forces.thrust),
            motion_resistance_n: Some(forces.motion_resistance),
            max_normal_stress_kpa: Some(forces.max_normal_stress * 1e-3),
        }
    }
}

impl From<&WheelTestRow> for WheelTestRecord {
    fn from(row: &WheelTestRow) -> Self {
        let (status, wheel) = match &row.result {
            Ok(settled) => (OK.into(), WheelRecord::new(settled)),
            Err(error) => (error.to_string(), WheelRecord::default()),
        };
        Self {
            load_n: row.load,
            slip_angle_deg: printed_degrees(row.slip_angle),
            slip_ratio: row.slip_ratio,
            status,
            wheel,
        }
    }
}

/// An angle that came in as degrees, as it was written: 15, not 14.999999999999998.
pub(super) fn printed_degrees(angle: f64) -> f64 {
    let degrees = angle.to_degrees();
    let rounded = (degrees * 1e9).round() / 1e9;
    if rounded.to_radians() == angle || (rounded - degrees).abs() < 1e-12 {
        rounded
    } else {
        degrees
    }
}

/// The level attitude on one slope. Results are null where `status` is not `ok`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeRecord {
    /// Slope [°].
    pub slope_deg: f64,
    /// Yaw that keeps the traverse level [°], positive uphill.
    pub yaw_deg: Option<f64>,
    /// Slip ratio of every wheel [-].
    pub slip_ratio: Option<f64>,
    /// Mean sinkage of the wheels [mm].
    pub sinkage_mm: Option<f64>,
    /// Torque of all wheels together [N·m].
    pub torque_nm: Option<f64>,
    /// Work of the wheels per metre along the contour [J/m].
    pub energy_j_per_m: Option<f64>,
    /// Yaw moment left over [N·m]; negative turns the nose downhill.
    pub yaw_moment_nm: Option<f64>,
    /// `ok`, or why there is no result.
    pub status: String,
}

impl AttitudeRecord {
    /// The record of a curve at a slope [rad].
    #[must_use]
    pub fn of(curve: &AttitudeCurve, rover: &Rover, slope: f64) -> Self {
        Self::new(curve.at(slope).as_ref(), rover, slope)
    }

    fn new(attitude: Result<&Attitude, &NoAttitude>, rover: &Rover, slope: f64) -> Self {
        let slope_deg = printed_degrees(slope);
        match attitude {
            Ok(attitude) => Self {
                slope_deg,
                yaw_deg: Some(attitude.yaw.to_degrees()),
                slip_ratio: Some(attitude.slip_ratio),
                sinkage_mm: Some(attitude.mean_sinkage() * 1e3),
                torque_nm: Some(attitude.torque()),
                energy_j_per_m: Some(attitude.energy_per_metre(rover)),
                yaw_moment_nm: Some(attitude.yaw_moment),
                status: OK.into(),
            },
            Err(error) => Self {
                slope_deg,
                yaw_deg: None,
                slip_ratio: None,
                sinkage_mm: None,
                torque_nm: None,
                energy_j_per_m: None,
                yaw_moment_nm: None,
                status: error.to_string(),
            },
        }
    }
}

/// The attitude of one course on one slope and soil. Results are null where `status` is not `ok`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeMapRecord {
    /// The soil's name.
    pub soil: String,
    /// Direction of travel from the contour [°], positive uphill.
    pub course_deg: f64,
    /// The attitude there: its yaw is the body's, and its work that of a metre along the course.
    #[serde(flatten)]
    pub attitude: AttitudeRecord,
    /// Power of the motors at the map's rim speed [W].
    pub power_w: Option<f64>,
    /// The steepest slope on which the course can be held [°]; null where the rover cannot move.
    pub limit_slope_deg: Option<f64>,
}

impl AttitudeMapRecord {
    /// The records of a map, row by row.
    ///
    /// * `soils`: the name of each study's soil
    /// * `rim_speed`: for the power [m/s]
    #[must_use]
    pub fn of(map: &AttitudeMap, soils: &[String], rover: &Rover, rim_speed: f64) -> Vec<Self> {
        let cells = |row: &AttitudeRow| {
            let record = |(slope, cell): (&f64, &Result<Attitude, NoAttitude>)| Self {
                soil: soils[row.study].clone(),
                course_deg: printed_degrees(row.course),
                attitude: AttitudeRecord::new(cell.as_ref(), rover, *slope),
                power_w: cell.as_ref().ok().map(|attitude| attitude.power(rover, rim_speed)),
                limit_slope_deg: row.limit.as_ref().ok().map(|(slope, _)| slope.to_degrees()),
            };
            map.slopes.iter().zip(&row.cells).map(record).collect::<Vec<Self>>()
        };
        map.rows.iter().flat_map(cells).collect()
    }
}

/// The steepest slope that can be crossed level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeLimit {
    /// That slope [°]; null where the rover cannot move at all.
    pub limit_slope_deg: Option<f64>,
    /// What ends the curve there.
    pub limit_reason: String,
}

impl From<&AttitudeCurve> for AttitudeLimit {
    fn from(curve: &AttitudeCurve) -> Self {
        match curve.limit() {
            Ok((slope, reason)) => {
                Self { limit_slope_deg: Some(slope.to_degrees()), limit_reason: reason.into() }
            }
            Err(NoAttitude::CannotMove(reason) | NoAttitude::TooSteep { reason, .. }) => {
                Self { limit_slope_deg: None, limit_reason: reason }
            }
        }
    }
}

/// What the draws of an uncertain soil say of the level attitude on one slope. Quantiles are over
/// the draws that have one there, and null where none has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeBandRecord {
    /// 2.5 % quantile of the yaw [°].
    pub yaw_deg_p2_5: Option<f64>,
    /// Median of the yaw [°].
    pub yaw_deg_p50: Option<f64>,
    /// 97.5 % quantile of the yaw [°].
    pub yaw_deg_p97_5: Option<f64>,
    /// 2.5 % quantile of the slip ratio [-].
    pub slip_ratio_p2_5: Option<f64>,
    /// Median of the slip ratio [-].
    pub slip_ratio_p50: Option<f64>,
    /// 97.5 % quantile of the slip ratio [-].
    pub slip_ratio_p97_5: Option<f64>,
    /// 2.5 % quantile of the mean sinkage of the wheels [mm].
    pub sinkage_mm_p2_5: Option<f64>,
    /// Median of the mean sinkage [mm].
    pub sinkage_mm_p50: Option<f64>,
    /// 97.5 % quantile of the mean sinkage [mm].
    pub sinkage_mm_p97_5: Option<f64>,
    /// 2.5 % quantile of the work per metre along the contour [J/m].
    pub energy_j_per_m_p2_5: Option<f64>,
    /// Median of that work [J/m].
    pub energy_j_per_m_p50: Option<f64>,
    /// 97.5 % quantile of that work [J/m].
    pub energy_j_per_m_p97_5: Option<f64>,
    /// Probability that a level attitude exists [-]: the share of the draws that have one.
    pub probability_level: f64,
    /// Lower end of its 95 % confidence interval, for the number of draws [-].
    pub probability_level_low: f64,
    /// Upper end of that interval [-].
    pub probability_level_high: f64,
    /// Draws with a level attitude: those that the quantiles are over.
    pub draws_level: usize,
    /// All draws.
    pub draws: usize,
}

impl From<&SlopeBand> for AttitudeBandRecord {
    fn from(band: &SlopeBand) -> Self {
        let degrees = band.yaw.map(|yaw| scaled(yaw, f64::to_degrees));
        let millimetres = band.sinkage.map(|sinkage| scaled(sinkage, |metres| metres * 1e3));
        let low = |band: Option<Band>| band.map(|band| band.low);
        let median = |band: Option<Band>| band.map(|band| band.median);
        let high = |band: Option<Band>| band.map(|band| band.high);
        let (probability_level_low, probability_level_high) = band.level.interval();
        Self {
            yaw_deg_p2_5: low(degrees),
            yaw_deg_p50: median(degrees),
            yaw_deg_p97_5: high(degrees),
            slip_ratio_p2_5: low(band.slip_ratio),
            slip_ratio_p50: median(band.slip_ratio),
            slip_ratio_p97_5: high(band.slip_ratio),
            sinkage_mm_p2_5: low(millimetres),
            sinkage_mm_p50: median(millimetres),
            sinkage_mm_p97_5: high(millimetres),
            energy_j_per_m_p2_5: low(band.energy_per_metre),
            energy_j_per_m_p50: median(band.energy_per_metre),
            energy_j_per_m_p97_5: high(band.energy_per_metre),
            probability_level: band.level.estimate(),
            probability_level_low,
            probability_level_high,
            draws_level: band.level.successes,
            draws: band.level.trials,
        }
    }
}

/// What the draws say of the steepest slope that can be crossed level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AttitudeBandLimit {
    /// 2.5 % quantile of that slope [°], over the draws on which the rover can move at all.
    pub limit_slope_deg_p2_5: Option<f64>,
    /// Its median [°].
    pub limit_slope_deg_p50: Option<f64>,
    /// Its 97.5 % quantile [°].
    pub limit_slope_deg_p97_5: Option<f64>,
    /// Draws on which the rover can move on level ground.
    pub draws_mobile: usize,
    /// All draws.
    pub draws: usize,
}

impl From<&AttitudeBand> for AttitudeBandLimit {
    fn from(band: &AttitudeBand) -> Self {
        let degrees = band.limit.map(|limit| scaled(limit, f64::to_degrees));
        Self {
            limit_slope_deg_p2_5: degrees.map(|band| band.low),
            limit_slope_deg_p50: degrees.map(|band| band.median),
            limit_slope_deg_p97_5: degrees.map(|band| band.high),
            draws_mobile: band.mobile.successes,
            draws: band.mobile.trials,
        }
    }
}

/// A band in another unit.
fn scaled(band: Band, convert: fn(f64) -> f64) -> Band {
    Band { low: convert(band.low), median: convert(band.median), high: convert(band.high) }
}
