//! Pressure under a plate or a rim as a power of its sinkage: the laws of Bekker and of Reece.
//!
//! Both read σ = K_σ zⁿ; they differ in what K_σ is made of, and so in how a soil changes with
//! the wheel's width and with gravity. Each variant has constants in units of its own.

use crate::elementary;
use crate::error::{ParameterError, not_negative, positive};

/// A pressure-sinkage law, σ = K_σ zⁿ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PressureSinkage {
    /// K_σ = k_c/b + k_φ (Bekker 1960). Its constants do not know gravity.
    Bekker {
        /// Cohesive modulus, *k_c* [N/m^(n+1)].
        k_c: f64,
        /// Frictional modulus, *k_φ* [N/m^(n+2)].
        k_phi: f64,
        /// Sinkage exponent, *n* [-].
        exponent: SinkageExponent,
    },
    /// K_σ = (c k'_c + γ b k'_φ) / bⁿ (Reece 1965). Scales with gravity through γ = ρ g.
    Reece {
        /// Cohesive modulus, *k'_c* [-].
        k_c: f64,
        /// Frictional modulus, *k'_φ* [-].
        k_phi: f64,
        /// Sinkage exponent, *n* [-].
        exponent: SinkageExponent,
    },
}

/// Sinkage exponent *n* = n₀ + n₁ max(s, 0) + n₂ max(−s, 0) [-] (Ding 2010; skid: Pavlov 2024).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinkageExponent {
    /// *n₀* [-].
    pub at_zero: f64,
    /// *n₁* [-]; 0 in the classical model.
    pub per_slip: f64,
    /// *n₂* [-]; 0 in the classical model.
    pub per_skid: f64,
}

impl SinkageExponent {
    /// An exponent that does not depend on slip.
    #[must_use]
    pub fn constant(exponent: f64) -> Self {
        Self { at_zero: exponent, per_slip: 0.0, per_skid: 0.0 }
    }

    /// The exponent *n* [-] at a slip ratio; slips beyond ±1 count as ±1.
    #[must_use]
    pub fn at(&self, slip_ratio: f64) -> f64 {
        let s = slip_ratio.clamp(-1.0, 1.0);
        self.at_zero + self.per_slip * s.max(0.0) + self.per_skid * (-s).max(0.0)
    }
}

/// K_σ and n, ready to be used: the pressure at a sinkage is K_σ zⁿ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// *K_σ* [Pa/mⁿ].
    pub modulus: f64,
    /// *n* [-].
    pub exponent: f64,
}

impl Stiffness {
    /// Pressure σ [Pa] at a sinkage [m]; zero above the surface.
    #[must_use]
    #[expect(clippy::inline_always, reason = "part of the kernel")]
    #[inline(always)]
    pub fn pressure(&self, sinkage: f64) -> f64 {
        self.modulus * elementary::pow(sinkage, self.exponent)
    }
}

/// σ = σ₀ (z/z₀)ⁿ: the law without a power of the width, which would be one more to compute.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScaledPressure {
    /// σ₀ [Pa].
    pub(crate) at_scale: f64,
    /// z₀ [m]: the width in Reece's law, a metre in Bekker's.
    pub(crate) scale: f64,
    /// *n* [-].
    pub(crate) exponent: f64,
}

impl PressureSinkage {
    /// The law for a rim of a given width.
    ///
    /// * `width`: *b* [m]
    /// * `cohesion`: *c* [Pa]
    /// * `unit_weight`: *γ* [N/m³]
    /// * `slip_ratio`: *s* [-], for soils whose exponent depends on it
    #[must_use]
    pub fn stiffness(
        &self,
        width: f64,
        cohesion: f64,
        unit_weight: f64,
        slip_ratio: f64,
    ) -> Stiffness {
        let ScaledPressure { at_scale, scale, exponent } =
            self.scaled(width, cohesion, unit_weight, slip_ratio);
        Stiffness { modulus: at_scale / elementary::pow(scale, exponent), exponent }
    }

    /// The same law on the length that it has of its own.
    #[inline]
    pub(crate) fn scaled(
        &self,
        width: f64,
        cohesion: f64,
        unit_weight: f64,
        slip_ratio: f64,
    ) -> ScaledPressure {
        let b = width;
        let (at_scale, scale, exponent) = match *self {
            Self::Bekker { k_c, k_phi, exponent } => (k_c / b + k_phi, 1.0, exponent),
            Self::Reece { k_c, k_phi, exponent } => {
                (cohesion * k_c + unit_weight * b * k_phi, b, exponent)
            }
        };
        ScaledPressure { at_scale, scale, exponent: exponent.at(slip_ratio) }
    }

    /// The same law with an exponent that does not change in skid.
    pub(crate) fn unchanged_in_skid(mut self) -> Self {
        let (Self::Bekker { exponent, .. } | Self::Reece { exponent, .. }) = &mut self;
        exponent.per_skid = 0.0;
        self
    }

    /// That the law gives a pressure, for a soil of this cohesion [Pa].
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that does not.
    pub fn check(&self, cohesion: f64) -> Result<(), ParameterError> {
        let (k_c, k_phi, exponent) = match *self {
            Self::Bekker { k_c, k_phi, exponent } => (k_c, k_phi, exponent),
            Self::Reece { k_c, k_phi, exponent } => (cohesion * k_c, k_phi, exponent),
        };
        not_negative("pressure-sinkage modulus k_c", k_c)?;
        not_negative("pressure-sinkage modulus k_phi", k_phi)?;
        positive("pressure-sinkage moduli, k_c (with cohesion) and k_phi together", k_c + k_phi)?;
        for slip_ratio in [-1.0, 0.0, 1.0] {
            positive("sinkage exponent n, at any slip from -1 to 1,", exponent.at(slip_ratio))?;
        }
        Ok(())
    }
}
