//! The arc of the rim that touches the soil: where it enters, where it leaves, where stress peaks.

#![expect(clippy::inline_always, reason = "part of the kernel")]

use crate::elementary;
use crate::soil::Soil;
use crate::stored::stored;

/// The arc in contact, in angles [rad] from straight down, positive on the entering side.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactPatch {
    /// Entry angle, *θ_f* [rad].
    pub entry: f64,
    /// Angle of maximum stress, *θ_m* [rad].
    pub max_stress: f64,
    /// Exit angle, *θ_r* [rad], not positive.
    pub exit: f64,
}

stored!(struct ContactPatch { entry, max_stress, exit });

impl ContactPatch {
    /// The arc of a wheel sunk by *h*.
    ///
    /// ```text
    /// θ_f = acos(1 − h/r_s)    θ_m = (a₀ + a₁ |s|) θ_f    θ_r = −acos(1 − λ h/r_s)
    /// ```
    ///
    /// after Ishigami et al. (2007), on the shearing radius.
    ///
    /// * `shearing_radius`: *r_s* [m]
    /// * `sinkage`: *h* [m], 0 to 2 r_s
    /// * `slip_ratio`: *s* [-], counted along the rolling direction
    #[must_use]
    pub fn new(soil: &Soil, shearing_radius: f64, sinkage: f64, slip_ratio: f64) -> Self {
        let (peak, exit) = (soil.stress_peak.share(slip_ratio), soil.exit.ratio(slip_ratio));
        Self::of_depth(sinkage / shearing_radius, peak, exit)
    }

    /// The arc of a wheel sunk by so many radii.
    ///
    /// * `depth`: h/r_s [-], 0 to 2
    /// * `peak_share`: θ_m/θ_f [-]
    /// * `exit_ratio`: *λ* [-]
    #[inline(always)]
    pub(super) fn of_depth(depth: f64, peak_share: f64, exit_ratio: f64) -> Self {
        let entry = angle_at_depth(depth);
        // Most soils rise behind the wheel as high as before it.
        let exit = if exit_ratio == 1.0 { entry } else { angle_at_depth(exit_ratio * depth) };
        Self { entry, max_stress: peak_share * entry, exit: -exit }
    }
}

/// Angle from straight down [rad] at which a rim crosses a surface `depth` radii above its bottom.
///
/// acos(1 − depth), written so that shallow contact keeps its digits. Depths beyond the wheel's
/// top count as the top.
#[inline(always)]
fn angle_at_depth(depth: f64) -> f64 {
    2.0 * elementary::asin((depth / 2.0).clamp(0.0, 1.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_entry_angle_is_the_arc_cosine() {
        for depth in [0.01, 0.1, 0.5, 1.0, 1.7, 2.0_f64] {
            assert!((angle_at_depth(depth) - (1.0 - depth).acos()).abs() < 1e-12);
        }
    }

    /// θ² ≈ 2 h/r for shallow contact; acos would have lost all digits here.
    #[test]
    fn shallow_contact_keeps_its_digits() {
        let depth = 1e-18_f64;
        assert!((angle_at_depth(depth) / (2.0 * depth).sqrt() - 1.0).abs() < 1e-12);
    }
}
