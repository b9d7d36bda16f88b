//! The source paper's theory: stresses integrated along the arc (Ishigami et al. 2007).
//!
//! The stresses of [`StressField`] act on the rim of a wheel of shearing radius *r_s* and width
//! *b*; the soil pushed aside acts on its flank. With θ from straight down, the rim's point is
//! (r_s sin θ, 0, −r_s cos θ), normal stress points to the hub and shear stress along the rim, so
//!
//! ```text
//! F_x = r_s b ∫ (τ_x cos θ − σ sin θ) dθ       T   = r_s² b ∫ τ_x dθ
//! F_y = r_s b ∫ τ_y dθ − F_s sin β             M_x = r_s² b ∫ τ_y cos θ dθ + flank
//! F_z = r_s b ∫ (τ_x sin θ + σ cos θ) dθ       M_z = r_s² b ∫ τ_y sin θ dθ + flank
//! ```
//!
//! `docs/models/ishigami.md` has the assumptions and how to get the parameters.

use super::bulldozing::{self, FlankLoad, WallResistance};
use super::forces::WheelForces;
use super::gauss::{GAUSS_16, GAUSS_64, Rule};
use super::model::{Contact, WheelSoilModel, from_both_sides};
use super::stress::StressField;

/// The theory of Ishigami, Miwa, Nagatani and Yoshida (2007), with the options of its successors.
#[derive(Clone, Copy, Debug)]
pub struct Ishigami {
    rule: &'static Rule,
}

impl Default for Ishigami {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl Ishigami {
    /// Sixteen nodes for each smooth piece of the arc: an error below 1e-6 of the load for driving
    /// wheels, about 1e-5 in skid where K is half a millimetre; at worst, for isotropic shear
    /// under large wheels that nearly roll, 1e-3.
    pub const DEFAULT: Self = Self { rule: &GAUSS_16 };

    /// The same theory with four times as many nodes, to measure the error of the quadrature.
    #[must_use]
    pub fn reference() -> Self {
        Self { rule: &GAUSS_64 }
    }
}

impl WheelSoilModel for Ishigami {
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        if sinkage <= 0.0 {
            return WheelForces::default();
        }
        from_both_sides(contact, |contact| self.entering_front(contact, sinkage))
    }
}

impl Ishigami {
    fn entering_front(&self, contact: &Contact, sinkage: f64) -> WheelForces {
        let field = StressField::new(contact, sinkage);
        let resistance =
            WallResistance::new(&contact.soil, contact.soil.unit_weight(contact.gravity));
        let radius = contact.wheel.shearing_radius();
        let flank = bulldozing::flank_load(&resistance, &field.patch, radius);
        reaction(contact, &field, &flank, self.rule)
    }
}

/// The stresses on the rim and the load on the flank, added up.
pub(super) fn reaction(
    contact: &Contact,
    field: &StressField,
    flank: &FlankLoad,
    rule: &Rule,
) -> WheelForces {
    let sums = integrate(field, rule);
    let r = contact.wheel.shearing_radius();
    let area = r * contact.wheel.width;
    let (across, along) = bulldozing::shares(contact.soil.bulldozing, &contact.slip);
    let (flank_y, flank_x) = (across * flank.force, along * flank.force);

    let thrust = area * sums.shear_forward;
    let motion_resistance = flank_x - area * sums.normal_back;
    let side_force_from_shear = area * sums.lateral;
    WheelForces {
        drawbar_pull: thrust + motion_resistance,
        side_force: side_force_from_shear + flank_y,
        normal_force: area * sums.up,
        torque: area * r * sums.shear,
        overturning_moment: area * r * sums.lateral_below + flank_y * flank.below_hub,
        aligning_moment: area * r * sums.lateral_ahead + flank_y * flank.ahead_of_hub,
        thrust,
        motion_resistance,
        side_force_from_shear,
        bulldozing_load: flank.force,
        max_normal_stress: field.max_normal(),
        patch: field.patch,
    }
}

/// Integrals of the stresses over the arc [Pa·rad].
#[derive(Clone, Copy, Debug, Default)]
struct StressSums {
    /// ∫ τ_x cos θ dθ
    shear_forward: f64,
    /// ∫ σ sin θ dθ
    normal_back: f64,
    /// ∫ (τ_x sin θ + σ cos θ) dθ
    up: f64,
    /// ∫ τ_x dθ
    shear: f64,
    /// ∫ τ_y dθ
    lateral: f64,
    /// ∫ τ_y cos θ dθ
    lateral_below: f64,
    /// ∫ τ_y sin θ dθ
    lateral_ahead: f64,
}

/// The force integral: every piece of the arc on which the stresses are smooth, by one Gauss rule.
///
/// At both ends of the arc the stress starts like a power *n* of the distance, which is no
/// polynomial. Squaring the variable there (θ = θ_f − span x²) turns it into 2n + 1, smooth
/// enough for the rule from n = 0.5 on.
fn integrate(field: &StressField, rule: &Rule) -> StressSums {
    let mut sums = StressSums::default();
    let entry = field.patch.entry;
    let (count, breaks) = field.breaks();
    for (piece, ends) in breaks[..count].windows(2).enumerate() {
        let (front, back) = (ends[0], ends[1]);
        let span = front - back;
        for &(x, weight) in rule {
            // Distance from the piece's front end, and its derivative by x, over the span.
            let (share, slope) = if piece == 0 {
                (x * x, 2.0 * x)
            } else if piece == count - 2 {
                (1.0 - x * x, 2.0 * x)
            } else {
                (x, 1.0)
            };
            let point = field.point((entry - front) + span * share);
            let stress = field.stress(&point);
            let (sin, cos) = (point.sin, point.cos);
            let dtheta = weight * slope * span;
            sums.shear_forward += stress.longitudinal * cos * dtheta;
            sums.normal_back += stress.normal * sin * dtheta;
            sums.up += (stress.longitudinal * sin + stress.normal * cos) * dtheta;
            sums.shear += stress.longitudinal * dtheta;
            sums.lateral += stress.lateral * dtheta;
            sums.lateral_below += stress.lateral * cos * dtheta;
            sums.lateral_ahead += stress.lateral * sin * dtheta;
        }
    }
    sums
}
