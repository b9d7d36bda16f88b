//! How far off a wheel–soil model may be under a wheel that nobody tested on a soil: a discrepancy
//! drawn for each sample of a band.
//!
//! The spread of a model's constants, and of models, is not all: measured wheels scatter about
//! every model, and what a model misses at one slip it misses at the next. Each sample therefore
//! has one smooth function of slip and slip angle for each quantity
//! ([`Discrepancy`](crate::soil::Discrepancy)), from a Gaussian process with the deviations and
//! lengths of `process`. A soil whose samples bring a discrepancy of their own, from a calibration,
//! keeps that.
//!
//! Source: ours. The deviations are about those of the residuals that are left, on the published
//! wheel tests, beside the spread of soils and models (`docs/validation.md`); slips 0.5 apart, and
//! slip angles 30° apart, are correlated by e^(−1/2), as the residuals of the CMU wheels are.

mod coordinates;
mod process;

pub use self::coordinates::DiscrepancyCoordinates;
pub use self::process::drawn;
use crate::soil::Soil;

/// A soil with the discrepancy of sample number `index`, which depends on the seed and that number
/// alone; one that has a discrepancy keeps it.
#[must_use]
pub fn with_discrepancy(soil: Soil, seed: u64, index: u64) -> Soil {
    let discrepancy = soil.discrepancy.or_else(|| Some(drawn(seed, index)));
    Soil { discrepancy, ..soil }
}
