//! Pressure under a plate or a rim as a power of its sinkage: the laws of Bekker and of Reece.
//!
//! Both read σ = K_σ zⁿ; they differ in what K_σ is made of, and so in how a soil changes with
//! the wheel's width and with gravity. Each variant has constants in units of its own.

use super::domain::Span;
use crate::elementary;
use crate::error::{ParameterError, finite, positive};

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

    /// This law with an exponent that does not change in skid.
    pub(crate) fn unchanged_in_skid(mut self) -> Self {
        let (Self::Bekker { exponent, .. } | Self::Reece { exponent, .. }) = &mut self;
        exponent.per_skid = 0.0;
        self
    }

    /// Checks that the law gives a pressure: with moduli that are not negative under every width,
    /// with a negative one over a range of widths that is stated.
    ///
    /// Negative moduli are published, and predict well near the plates they were fitted to; K_σ
    /// changes its sign at a width not far from theirs. It is monotone in the width, so that the
    /// ends of the range suffice.
    ///
    /// * `cohesion`: *c* [Pa]
    /// * `unit_weight`: the range of *γ* [N/m³], which Reece's law reads
    /// * `widths`: the range of *b* [m] for which the moduli are known to hold
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that gives none.
    pub fn check(
        &self,
        cohesion: f64,
        unit_weight: Span,
        widths: Span,
    ) -> Result<(), ParameterError> {
        let (k_c, k_phi, exponent) = self.moduli();
        for slip_ratio in [-1.0, 0.0, 1.0] {
            positive("sinkage exponent n, at any slip from -1 to 1,", exponent.at(slip_ratio))?;
        }
        let modulus = |name: &str| format!("pressure-sinkage modulus {name}");
        for (name, value) in [("k_c", k_c), ("k_phi", k_phi)] {
            finite(&modulus(name), value)?;
        }
        if !self.has_negative_modulus() {
            let together = if self.is_without_cohesion(cohesion) { k_phi } else { k_c + k_phi };
            return positive(
                "pressure-sinkage moduli, k_c (with cohesion) and k_phi together",
                together,
            );
        }
        if !(widths.low > 0.0 && widths.high.is_finite()) {
            let (name, value) = if k_c < 0.0 { ("k_c", k_c) } else { ("k_phi", k_phi) };
            return Err(ParameterError::new(modulus(name), value, WITHOUT_WIDTHS));
        }
        for unit_weight in [unit_weight.low, unit_weight.high] {
            for width in [widths.low, widths.high] {
                self.check_width(width, cohesion, unit_weight)?;
            }
        }
        Ok(())
    }

    /// Checks that the law gives a pressure under a rim or a plate of one width.
    ///
    /// * `width`: *b* [m]
    /// * `cohesion`: *c* [Pa]
    /// * `unit_weight`: *γ* [N/m³]
    ///
    /// # Errors
    /// [`ParameterError`] with the width, if K_σ is not above zero there.
    pub fn check_width(
        &self,
        width: f64,
        cohesion: f64,
        unit_weight: f64,
    ) -> Result<(), ParameterError> {
        let stiffness = self.scaled(width, cohesion, unit_weight, 0.0).at_scale;
        if stiffness.is_finite() && stiffness > 0.0 {
            return Ok(());
        }
        let sum = match self {
            Self::Bekker { .. } => "k_c/b + k_phi",
            Self::Reece { .. } => "c k_c + density g b k_phi",
        };
        let name = format!("the soil's stiffness {sum} under a width b of {width} m");
        Err(ParameterError::new(name, stiffness, NOT_STIFF))
    }

    /// Whether one of the moduli is below zero, so that the law holds for some widths only.
    #[must_use]
    pub fn has_negative_modulus(&self) -> bool {
        let (k_c, k_phi, _) = self.moduli();
        k_c < 0.0 || k_phi < 0.0
    }

    /// k_c, k_φ and n, in the law's own units.
    fn moduli(&self) -> (f64, f64, SinkageExponent) {
        let (Self::Bekker { k_c, k_phi, exponent } | Self::Reece { k_c, k_phi, exponent }) = *self;
        (k_c, k_phi, exponent)
    }

    /// Whether k_c has nothing to act on.
    fn is_without_cohesion(&self, cohesion: f64) -> bool {
        matches!(self, Self::Reece { .. }) && cohesion == 0.0
    }
}

/// What a negative modulus asks of a soil.
const WITHOUT_WIDTHS: &str = "finite and not negative, unless the soil states for which widths it \
                              holds: with `domain.width_m = [smallest, largest]`, over which the \
                              stiffness must be above zero";

/// What a stiffness must be under a wheel.
const NOT_STIFF: &str = "above zero: a negative modulus holds for the widths of its plates, \
                         `domain.width_m`, and near them";
