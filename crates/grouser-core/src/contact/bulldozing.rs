//! Soil pushed aside by the side wall of a wheel that moves sideways (Hegedus 1960, Bekker).

use super::inputs::Contact;
use super::kernel::rule::EVEN;
use super::kernel::{LANES, sum};
use super::patch::ContactPatch;
use super::slip::Slip;
use super::stress::RimPoint;
use crate::elementary;
use crate::soil::{Bulldozing, Soil};

/// Resistance of a wall pushed through soil, per metre of wall: *R_b* [N/m].
///
/// ```text
/// R_b(z) = D₁ (c z + D₂ γ z²/2)      D₁ = cot X_c + tan(X_c + φ)      D₂ = cot X_c + cot² X_c / cot φ
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallResistance {
    /// Share that grows with depth, D₁ c [N/m²].
    pub(super) cohesive: f64,
    /// Share that grows with its square, D₁ D₂ γ/2 [N/m³].
    pub(super) frictional: f64,
    /// What the piled-up soil adds to each depth, as a factor [-]; 1 without a surcharge.
    pub(super) heaped: f64,
}

impl WallResistance {
    /// The resistance of a soil of a given weight.
    ///
    /// * `unit_weight`: *γ* [N/m³]
    #[must_use]
    pub fn new(soil: &Soil, unit_weight: f64) -> Self {
        let (cot, tan_phi) = (soil.destructive_cot(), soil.friction());
        // X_c + φ is the complement of X_c.
        let (d_1, d_2) = (d1(cot, cot), d2(cot, tan_phi));
        // The soil piled up reaches cot X_c ahead of the wall and lies at the angle φ.
        let heaped = match soil.bulldozing {
            Bulldozing::SineSquared => 1.0 + tan_phi * cot,
            Bulldozing::None | Bulldozing::Sign | Bulldozing::Sine => 1.0,
        };
        Self { cohesive: d_1 * soil.cohesion, frictional: d_1 * d_2 * unit_weight / 2.0, heaped }
    }

    /// The resistance of the soil under a wheel.
    pub(super) fn of(contact: &Contact) -> Self {
        Self::new(&contact.soil, contact.soil.unit_weight(contact.gravity))
    }

    /// The wall's resistance in soil that mobilises a share [-] of its cohesion.
    #[expect(clippy::inline_always, reason = "part of the kernel")]
    #[inline(always)]
    pub(super) fn pressed(&self, cohesion_share: f64) -> Self {
        Self { cohesive: self.cohesive * cohesion_share, ..*self }
    }

    /// *R_b* [N/m] at a depth [m].
    #[must_use]
    #[expect(clippy::inline_always, reason = "part of the kernel")]
    #[inline(always)]
    pub fn at(&self, depth: f64) -> f64 {
        let z = depth * self.heaped;
        self.cohesive * z + self.frictional * z * z
    }
}

/// D₁ = cot X_c + tan(X_c + φ) [-].
///
/// * `cot`: cot X_c [-], and `tan_sum`: tan(X_c + φ) [-]
fn d1(cot: f64, tan_sum: f64) -> f64 {
    cot + tan_sum
}

/// D₂ = cot X_c + cot² X_c / cot φ [-].
///
/// * `cot`: cot X_c [-], and `tan_phi`: tan φ [-]
fn d2(cot: f64, tan_phi: f64) -> f64 {
    cot + cot * cot * tan_phi
}

/// The soil's force on the buried segment of a side wall, and where it acts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SideWallLoad {
    /// Full force, *F_s* [N], before any dependence on the slip angle.
    pub force: f64,
    /// Distance of its line of action below the hub [m].
    pub below_hub: f64,
    /// Distance of its line of action ahead of the hub [m].
    pub ahead_of_hub: f64,
}

/// Share of the depth at which the pressure of loose soil on a wall acts: it grows linearly with
/// depth, so its resultant lies at two thirds. Source: Rankine's earth pressure.
const CENTRE_OF_PRESSURE: f64 = 2.0 / 3.0;

/// The load on a side wall from the soil it pushes aside (Ishigami et al. 2007).
///
/// ```text
/// F_s = ∫ R_b(h(θ)) [r_s − h(θ) cos θ] dθ      h(θ) = r_s (cos θ − cos θ_f), over the buried arc
/// ```
///
/// * `patch`: the arc in contact; behind −θ_f (λ > 1) the rim is above the surface, without load
/// * `shearing_radius`: *r_s* [m]
#[expect(clippy::inline_always, reason = "part of the kernel")]
#[inline(always)]
#[must_use]
pub fn side_wall_load(
    resistance: &WallResistance,
    patch: &ContactPatch,
    shearing_radius: f64,
) -> SideWallLoad {
    let (mut force, mut below, mut ahead) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    for lane in 0..LANES {
        let node = (EVEN.abscissa[lane], EVEN.width[lane]);
        (force[lane], below[lane], ahead[lane]) = strip(resistance, patch, shearing_radius, node);
    }
    SideWallLoad::of_sums(sum(&force), sum(&below), sum(&ahead))
}

/// What a strip of the wall from the rim up bears: its force [N], and its moments [N·m] about the
/// hub for a force across the wheel.
///
/// * `node`: its abscissa and its width, as shares of the buried arc
#[expect(clippy::inline_always, reason = "part of the kernel")]
#[inline(always)]
pub(super) fn strip(
    resistance: &WallResistance,
    patch: &ContactPatch,
    shearing_radius: f64,
    (abscissa, width): (f64, f64),
) -> (f64, f64, f64) {
    let r = shearing_radius;
    let start = patch.exit.max(-patch.entry);
    let span = patch.entry - start;
    let surface = RimPoint::new(patch.entry, 0.0).height;
    let point = RimPoint::new(start + abscissa * span, 0.0);
    let (sin, cos) = (point.sin, point.cosine());
    let depth = r * (surface - point.height);
    let strip = width * span * resistance.at(depth) * (r - depth * cos);
    (strip, strip * (r * cos - (1.0 - CENTRE_OF_PRESSURE) * depth), strip * r * sin)
}

impl SideWallLoad {
    /// * `force`: of all strips [N]
    /// * `below`, `ahead`: their moments [N·m]
    #[expect(clippy::inline_always, reason = "part of the kernel")]
    #[inline(always)]
    pub(super) fn of_sums(force: f64, below: f64, ahead: f64) -> Self {
        if force == 0.0 {
            return Self::default();
        }
        Self { force, below_hub: below / force, ahead_of_hub: ahead / force }
    }
}

/// How the side wall's load acts in a motion: its shares across and along the wheel [-].
///
/// Across, positive to the left: against the lateral motion. Along: against the travel.
///
/// The full force of [`Bulldozing::Sign`] reverses within
/// [`CREEP_SPEED`](super::slip::CREEP_SPEED), as all forces of a wheel that comes to rest do:
/// without that no integrator gets past a rover that rolls straight ahead.
#[must_use]
#[inline]
pub fn shares(law: Bulldozing, slip: &Slip) -> (f64, f64) {
    let sin_cos = || elementary::sin_cos(slip.angle);
    match law {
        Bulldozing::None => (0.0, 0.0),
        Bulldozing::Sign => (-slip.sideways, 0.0),
        Bulldozing::Sine => (-sin_cos().0, 0.0),
        Bulldozing::SineSquared => {
            let (sin, cos) = sin_cos();
            (-sin * sin.abs(), -sin.abs() * cos)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    /// Source: D₁ and D₂ for φ = 38°, X_c = 26°, and for φ = 37.2°, X_c = 26.4°: independent code.
    #[test]
    fn wall_coefficients() {
        for (phi, x_c, first, second) in
            [(38.0, 26.0, 4.100_608, 5.334_630), (37.2, 26.4, 4.028_974, 5.094_796)]
        {
            let cot = 1.0 / deg(x_c).tan();
            assert!((d1(cot, deg(x_c + phi).tan()) - first).abs() < 1e-6);
            assert!((d2(cot, deg(phi).tan()) - second).abs() < 1e-6);
        }
    }

    #[test]
    fn every_law_but_sign_is_continuous_at_zero_slip_angle() {
        let just_turned = Slip::on_test_stand(0.2, 1e-9);
        for law in [Bulldozing::None, Bulldozing::Sine, Bulldozing::SineSquared] {
            let (across, along) = shares(law, &just_turned);
            assert!(across.abs() <= 1e-9 && along.abs() <= 1e-9, "{law:?}");
        }
        assert_eq!(shares(Bulldozing::Sign, &just_turned).0, -1.0);
    }
}
