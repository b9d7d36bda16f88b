//! Permitted settings of simulated wheel tests.

use std::ops::RangeInclusive;

/// How often a simulated test may run each setting.
pub const TRIALS: RangeInclusive<f64> = 1.0..=1000.0;
/// Standard deviations of noise that may be asked for, in N, mm and N·m.
pub const NOISE: RangeInclusive<f64> = 0.0..=1e3;
