//! The most that the ground resists a wheel: friction under its load, and the soil wedges that it
//! would have to push out of its way.
//!
//! A wheel moves over the ground only as far as the soil below and around it fails. Along every
//! surface on which it fails, Coulomb's law holds: |τ| ≤ c + σ tan φ. The soil under the wheel
//! fails along the wheel's base, which carries its load; the soil in front of it and beside it
//! fails along planes that rise at the destructive angle X_c from the depth of the rim, and carries
//! the weight of a wedge each. A wedge of weight G on such a plane yields to G tan(X_c + φ), which
//! is G cot X_c.
//!
//! ```text
//! B = F_z tan φ + c A + (G_front + G_side) cot X_c + 2 c cot X_c (S_front + S_side)
//! G = ½ γ D₂ ∫ H² dl      S = ∫ H dl      H = (1 + tan φ cot X_c) h(l)      D₂ = cot X_c + cot² X_c tan φ
//! ```
//!
//! H is the wall's depth with the soil that it has piled up: a pile that reaches as far as the
//! wedge, cot X_c times the depth, at the angle of repose φ. G has the soil on top of the wedge,
//! piled at φ again (Hegedus 1960). In front the wall is the rim, of width b and depth h; beside
//! the wheel it is the buried segment of one side wall, taken as a parabola: h(l) = h (1 − l²/a²),
//! a² = h (2 r_s − h), which at the axle is a fifth less than the segment. A is the rim's contact,
//! and c the cohesion that the wheel's pressure mobilises ([`cohesion`](super::cohesion)).
//!
//! [`coulomb`](super::coulomb) has a tighter bound, by bare wedges, for the other models on soils
//! that state it. The mounds and the side wall of the small-wheel model are of piled-up soil, and
//! it has this one on every soil.
//!
//! On a slope the wedges resist less against being pushed downhill ([`Soil::on_slope`]), and not at
//! all where it is as steep as the angle of friction: a rover on cohesionless soil holds on no
//! steeper slope.
//!
//! Source: Rankine's passive pressure, ½ γ H² cot² X_c + 2 c H cot X_c for a bare wedge; the pile's
//! shape after Hegedus and the laboratory's code of 2007 ([`Bulldozing::SineSquared`]).
//!
//! [`Bulldozing::SineSquared`]: crate::soil::Bulldozing::SineSquared
//! [`Soil::on_slope`]: crate::soil::Soil::on_slope

use super::cohesion::Cohesion;
use super::coulomb::shrunk;
use super::forces::WheelForces;
use super::inputs::Contact;
use crate::elementary::wide;

/// ∫ (1 − t²)² dt and ∫ (1 − t²) dt over −1 to 1: a parabola's square, and itself [-].
const PARABOLA: [f64; 2] = [16.0 / 15.0, 4.0 / 3.0];

/// The largest horizontal force of the soil on a wheel, *B* [N].
///
/// * `forces`: of the wheel sunk by `sinkage` [m]; their F_z and arc of contact count
#[must_use]
pub fn largest_horizontal_force(contact: &Contact, forces: &WheelForces, sinkage: f64) -> f64 {
    let Contact { wheel, soil, gravity, .. } = contact;
    let (cot, tan_phi) = (soil.destructive_cot(), soil.friction());
    let c = Cohesion::of(soil).mobilised(forces.max_normal_stress);
    let r = wheel.shearing_radius();
    let depth = sinkage.clamp(0.0, r);
    let half_chord = (depth * (2.0 * r - depth)).sqrt();

    let piled = depth * (1.0 + tan_phi * cot);
    let [square, area] = PARABOLA;
    let squares = piled * piled * (wheel.width + square * half_chord);
    let walls = piled * (wheel.width + area * half_chord);
    let d_2 = cot + cot * cot * tan_phi;
    let share = soil.small_wheel.wedge_share;
    let wedges = share * 0.5 * soil.unit_weight(*gravity) * d_2 * squares;
    let base = wheel.width * r * (forces.patch.entry - forces.patch.exit);

    forces.normal_force.max(0.0) * tan_phi + c * base + cot * (wedges + 2.0 * c * walls)
}

/// The same reaction within what the ground resists: where its horizontal force is larger than *B*,
/// all horizontal forces, torque and moments come down alike.
///
/// The wheel then takes the soil around it along, and moves less against it.
#[must_use]
pub(super) fn within_the_cone(contact: &Contact, forces: WheelForces, sinkage: f64) -> WheelForces {
    let most = largest_horizontal_force(contact, &forces, sinkage);
    let asked = wide::hypot(forces.drawbar_pull, forces.side_force);
    if asked <= most { forces } else { shrunk(forces, most / asked) }
}
