//! What a soil can resist at most under a whole wheel: Coulomb's law, for soils with
//! [`ShearBound::Coulomb`].
//!
//! Stresses on a curved rim obey Coulomb's law point by point and still add up to more: a locked
//! wheel leans against the arc in front of it, and pushes soil aside that would give way first. The
//! soil fails at the latest when the wheel slides with all that lies beneath its lowest point held,
//! and lifts a wedge of what lies ahead:
//!
//! ```text
//! √(F_x² + F_y²) ≤ F_z tan φ + c b ℓ + P        P = w (½ K_p γ h² + 2 c √K_p h),  √K_p = cot X_c
//! ```
//!
//! with the contact's length ℓ along the ground, and Rankine's passive earth pressure P on a wall
//! of the height h and of the width that the wheel shows in the direction of the force, w = (b
//! |F_x| + ℓ |F_y|)/F. The cohesion is what the wheel's pressure mobilises
//! ([`cohesion`](super::cohesion)). On a slope the weight of wedges counts by
//! [`Soil::on_slope`](crate::soil::Soil::on_slope). Any such mechanism bounds the resistance from
//! above (limit analysis; Chen 1975). Beyond the bound all parts of the horizontal force, the
//! torque and the moments that go with them shrink alike, so that the soil is never given less work
//! than it takes.

use super::cohesion::Cohesion;
use super::forces::WheelForces;
use super::inputs::Contact;
use crate::elementary::wide::{hypot, sin};
use crate::soil::ShearBound;

/// The reaction within what the soil can resist; the same bits where it is, or without a bound.
///
/// * `sinkage`: *h* [m]
#[must_use]
pub(super) fn bounded(contact: &Contact, sinkage: f64, forces: WheelForces) -> WheelForces {
    match contact.soil.shear_bound {
        ShearBound::None => forces,
        ShearBound::Coulomb => {
            let horizontal = hypot(forces.drawbar_pull, forces.side_force);
            let most = most_resistance(contact, sinkage, &forces);
            if horizontal <= most { forces } else { shrunk(forces, most / horizontal) }
        }
    }
}

/// The most that the soil resists in the direction of the forces [N].
///
/// * `sinkage`: *h* [m]
#[must_use]
pub fn most_resistance(contact: &Contact, sinkage: f64, forces: &WheelForces) -> f64 {
    use std::f64::consts::FRAC_PI_2;
    let Contact { wheel, soil, gravity, .. } = contact;
    let (f_x, f_y) = (forces.drawbar_pull.abs(), forces.side_force.abs());
    let horizontal = hypot(f_x, f_y);
    let cohesion = Cohesion::of(soil).mobilised(forces.max_normal_stress);
    let (h, b, r) = (sinkage.max(0.0), wheel.width, wheel.shearing_radius());
    let reach = |angle: f64| sin(angle.clamp(-FRAC_PI_2, FRAC_PI_2));
    let length = r * (reach(forces.patch.entry) - reach(forces.patch.exit));
    let width = if horizontal > 0.0 { (b * f_x + length * f_y) / horizontal } else { 0.0 };
    let root = soil.destructive_cot();
    let unit_weight = soil.small_wheel.wedge_share * soil.unit_weight(*gravity);
    let pressure = 0.5 * root * root * unit_weight * h * h + 2.0 * cohesion * root * h;
    forces.normal_force.max(0.0) * soil.friction() + cohesion * b * length + width * pressure
}

/// All that goes with the horizontal force, by a factor [-].
pub(super) fn shrunk(forces: WheelForces, factor: f64) -> WheelForces {
    let WheelForces { normal_force, bulldozing_load, max_normal_stress, .. } = forces;
    WheelForces { normal_force, bulldozing_load, max_normal_stress, ..forces * factor }
}
