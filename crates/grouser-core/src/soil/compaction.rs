//! How a soil differs where a wheel has passed: denser, and with its shear strength mobilised
//! sooner.

use super::{Shear, ShearModulus, Soil};
use crate::elementary::exp;

/// What passes of wheels make of a soil: factors.
///
/// How much denser, and how much stiffer in shear, is a rut behind a wheel that slipped by 0.2?
///
/// ```
/// use grouser_core::soil::Compaction;
///
/// let rut = Compaction::of_passes(0.2, 1);
/// assert_eq!(format!("{:.3} {:.3}", rut.density, rut.shear_modulus), "1.171 0.829");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compaction {
    /// On the density [-].
    pub density: f64,
    /// On the shear deformation moduli [-].
    pub shear_modulus: f64,
}

/// Passes after which a soil is as dense as it gets; the source's law would go on. Source: ours.
pub const MOST_PASSES: u32 = 3;

impl Compaction {
    /// None: fresh soil.
    pub const NONE: Self = Self { density: 1.0, shear_modulus: 1.0 };

    /// Returns the compaction after passes of wheels, by the law of [Holm1969] in the form of
    /// [SenatoreSandu2011]:
    ///
    /// ```text
    /// ρ_p/ρ = 1 + (1 − e^(−s₀/k₁)) k₂ + k₃ n        K_p/K = 1 − (1 − e^(−s₀/k₁)) k₂ − k₃ n
    /// ```
    ///
    /// with s₀ = max(0, s). Its constants are of tyres on dry loam. As printed it has no bound;
    /// here n is at most [`MOST_PASSES`], so that ρ grows by 27 % and K falls by 27 % at the most.
    ///
    /// * `slip_ratio`: of the last wheel that passed [-]
    /// * `passes`: how many wheels passed
    #[must_use]
    pub fn of_passes(slip_ratio: f64, passes: u32) -> Self {
        const K_1: f64 = 0.1178;
        const K_2: f64 = 0.1672;
        const K_3: f64 = 0.0348;
        let (s, n) = (slip_ratio.max(0.0), f64::from(passes.min(MOST_PASSES)));
        let change = (1.0 - exp(-s / K_1)) * K_2 + K_3 * n;
        Self { density: 1.0 + change, shear_modulus: 1.0 - change }
    }

    /// This one where another covers a share of the width, 0 to 1. What is dense already stays so.
    #[must_use]
    pub fn covered(self, other: Self, share: f64) -> Self {
        Self {
            density: self.density.max(self.density + share * (other.density - self.density)),
            shear_modulus: self
                .shear_modulus
                .min(self.shear_modulus + share * (other.shear_modulus - self.shear_modulus)),
        }
    }
}

impl Soil {
    /// The same soil, compacted. Its pressure–sinkage relation follows where it is in units of the
    /// soil's weight (Reece's); constants of Bekker's, and of resistive force theory, stay as they
    /// are.
    #[must_use]
    pub fn compacted(&self, by: Compaction) -> Self {
        let k = by.shear_modulus;
        let shear = match self.shear {
            Shear::Anisotropic { longitudinal, lateral } => Shear::Anisotropic {
                longitudinal: longitudinal.times(k),
                lateral: lateral.times(k),
            },
            Shear::Isotropic { modulus } => Shear::Isotropic { modulus: modulus.times(k) },
        };
        Self { density: by.density * self.density, shear, ..*self }
    }
}

impl ShearModulus {
    /// The modulus times a factor, at every slip angle.
    fn times(self, factor: f64) -> Self {
        match self {
            Self::Linear { at_zero, per_radian } => {
                Self::Linear { at_zero: factor * at_zero, per_radian: factor * per_radian }
            }
            Self::Quadratic { at_zero, per_radian, per_radian_squared, angle_limit } => {
                Self::Quadratic {
                    at_zero: factor * at_zero,
                    per_radian: factor * per_radian,
                    per_radian_squared: factor * per_radian_squared,
                    angle_limit,
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: the law as printed, at its ends.
    #[test]
    fn the_law_has_bounds() {
        let once = Compaction::of_passes(0.0, 1);
        assert!((once.density - 1.0348).abs() < 1e-12);
        assert_eq!(Compaction::of_passes(-0.5, 1), once);
        let most = Compaction::of_passes(1.0, 3);
        assert_eq!(Compaction::of_passes(1.0, 1_000_000), most);
        assert!(most.density < 1.272 && most.shear_modulus > 0.728, "{most:?}");
    }

    #[test]
    fn what_is_dense_stays_dense() {
        let dense = Compaction { density: 1.2, shear_modulus: 0.8 };
        let less = Compaction { density: 1.1, shear_modulus: 0.9 };
        assert_eq!(dense.covered(less, 1.0), dense);
        assert_eq!(Compaction::NONE.covered(dense, 0.0), Compaction::NONE);
        let half = Compaction::NONE.covered(dense, 0.5);
        assert!((half.density - 1.1).abs() < 1e-12 && (half.shear_modulus - 0.9).abs() < 1e-12);
    }
}
