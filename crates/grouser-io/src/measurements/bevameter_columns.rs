//! The columns of plate and shear tests: their names, units and ranges.

use std::ops::RangeInclusive;

use super::super::columns as results;
use super::super::unit::{KPA, MM, ONE};
use super::columns::{Column, Meaning};

/// The smaller side of a rectangular plate.
pub const PLATE_WIDTH: &str = "plate_width_mm";
/// The diameter of a round plate.
pub const PLATE_DIAMETER: &str = "plate_diameter_mm";
/// The radius of a round plate.
pub const PLATE_RADIUS: &str = "plate_radius_mm";
/// The sinkage of a plate.
pub const SINKAGE: &str = results::SINKAGE.name;
/// The pressure under a plate.
pub const PRESSURE: &str = "pressure_kpa";
/// Standard deviation of that pressure.
pub const PRESSURE_SCATTER: &str = "pressure_std_kpa";
/// How far a patch was sheared.
pub const SHEAR_DISPLACEMENT: &str = "shear_displacement_mm";
/// The stress that this took.
pub const SHEAR_STRESS: &str = "shear_stress_kpa";
/// The stress that pressed the patch down.
pub const NORMAL_STRESS: &str = "normal_stress_kpa";
/// Standard deviation of the shear stress.
pub const SHEAR_STRESS_SCATTER: &str = "shear_stress_std_kpa";
/// What tells curves of one setting apart.
pub const REPEAT: &str = "repeat";

/// No plate is narrower than a millimetre: one that is was written in another unit.
const SIZE_MM: RangeInclusive<f64> = 1.0..=1e4;
/// A raw log starts before the plate meets the soil.
const PLACE_MM: RangeInclusive<f64> = -1e4..=1e4;
/// Noise about zero is data.
const STRESS_KPA: RangeInclusive<f64> = -1e5..=1e5;
const SCATTER_KPA: RangeInclusive<f64> = 0.0..=1e5;
const PRESSED_KPA: RangeInclusive<f64> = 0.01..=1e5;
const ANY: RangeInclusive<f64> = f64::MIN..=f64::MAX;

const fn length(name: &'static str, range: RangeInclusive<f64>) -> Column {
    Column { name, meaning: Meaning::BevameterLength, unit: MM, range }
}

const fn stress(name: &'static str, range: RangeInclusive<f64>) -> Column {
    Column { name, meaning: Meaning::BevameterStress, unit: KPA, range }
}

const fn label(name: &'static str) -> Column {
    Column { name, meaning: Meaning::Trial, unit: ONE, range: ANY }
}

/// The columns of plate tests.
pub static PLATE_COLUMNS: [Column; 7] = [
    length(PLATE_WIDTH, SIZE_MM),
    length(PLATE_DIAMETER, SIZE_MM),
    length(PLATE_RADIUS, SIZE_MM),
    length(SINKAGE, PLACE_MM),
    stress(PRESSURE, STRESS_KPA),
    stress(PRESSURE_SCATTER, SCATTER_KPA),
    label(REPEAT),
];

/// The columns of shear tests.
pub static SHEAR_COLUMNS: [Column; 5] = [
    length(SHEAR_DISPLACEMENT, PLACE_MM),
    stress(SHEAR_STRESS, STRESS_KPA),
    stress(NORMAL_STRESS, PRESSED_KPA),
    stress(SHEAR_STRESS_SCATTER, SCATTER_KPA),
    label(REPEAT),
];
