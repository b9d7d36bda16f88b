//! Cohesion under a wheel that hardly presses the soil: a tension cut-off, for soils with
//! [`ShearBound::Coulomb`].
//!
//! Cohesion is where a line through shear tests at several kilopascals meets τ = 0. Under less
//! pressure loose soil has less strength than the line: it takes no tension. On a rim that is
//! pressed with σ, and at which the soil fails, the smallest principal stress is σ − τ tan X_c with
//! X_c = 45° − φ/2. It is not negative where
//!
//! ```text
//! τ ≤ σ cot X_c      so that      c ≤ σ/cos φ
//! ```
//!
//! for τ = c + σ tan φ. The cohesion that a wheel mobilises passes smoothly from the one to the
//! other,
//!
//! ```text
//! c_m = c/√(1 + (c cos φ/σ_m)²)
//! ```
//!
//! with σ_m, the largest normal stress on the rim: one cohesion for the whole wheel, its side wall
//! and its wedges. A cut-off at each point would be a corner near both ends of the arc, which no
//! quadrature of few nodes follows. Without it a locked wheel without a load is an anchor: shear on
//! the arc in front pulls it down by c b (1 − λ) h, and pressure grows like h^(n + ½), slower at
//! first.
//!
//! Source: Coulomb's envelope with a tension cut-off (Chen 1975); the smooth passage, and one
//! pressure for the whole wheel, are ours.

#![expect(clippy::inline_always, reason = "part of the kernel")]

use crate::elementary;
use crate::soil::{ShearBound, Soil};

/// What a soil has of cohesion under a pressure.
#[derive(Clone, Copy, Debug)]
pub struct Cohesion {
    /// *c* [Pa]
    pub(super) full: f64,
    /// Pressure below which the soil would be in tension, c cos φ [Pa]; 0 where its law is as
    /// published.
    pub(super) tension: f64,
}

impl Cohesion {
    /// The cohesion of a soil, with the cut-off where its shear is bounded.
    #[must_use]
    pub fn of(soil: &Soil) -> Self {
        let (_, cos) = elementary::sin_cos(soil.friction_angle);
        let tension = match soil.shear_bound {
            ShearBound::None => 0.0,
            ShearBound::Coulomb => soil.cohesion * cos,
        };
        Self { full: soil.cohesion, tension }
    }

    /// c_m/c [-] under a wheel whose largest normal stress is `pressure` [Pa].
    #[must_use]
    #[inline(always)]
    pub fn share(&self, pressure: f64) -> f64 {
        let some = if pressure > f64::MIN_POSITIVE { pressure } else { f64::MIN_POSITIVE };
        let ratio = self.tension / some;
        1.0 / (1.0 + ratio * ratio).sqrt()
    }

    /// The cohesion *c_m* [Pa] under a wheel whose largest normal stress is `pressure` [Pa].
    #[must_use]
    #[inline(always)]
    pub fn mobilised(&self, pressure: f64) -> f64 {
        self.full * self.share(pressure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRANITE: Cohesion = Cohesion { full: 5000.0, tension: 3940.0 };

    #[test]
    fn it_is_whole_under_high_pressure_and_follows_a_low_one() {
        assert!((GRANITE.mobilised(1e6) / GRANITE.full - 1.0).abs() < 1e-5);
        let (pressure, steepest) = (1.0, GRANITE.full / GRANITE.tension);
        assert!((GRANITE.mobilised(pressure) / pressure / steepest - 1.0).abs() < 1e-6);
        assert_eq!(GRANITE.mobilised(0.0), 0.0);
    }

    #[test]
    fn a_published_law_keeps_its_bits() {
        let published = Cohesion { full: 800.0, tension: 0.0 };
        assert_eq!([0.0, 1e-300, 1e4].map(|pressure| published.mobilised(pressure)), [800.0; 3]);
    }
}
