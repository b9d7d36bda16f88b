//! What a model gets wrong, put right on one wheel: the soil's
//! [`Discrepancy`](crate::soil::Discrepancy) added to the reaction.
//!
//! ```text
//! F_x += e W δ_x(S, |β|)      F_y += W sgn(β) δ_y(S, |β|)
//! T   += e W r_s δ_T(S, |β|)  h   *= e^(δ_h(S, |β|))
//! ```
//!
//! It comes on top of everything that the model has, its bound by the soil's friction included: a
//! sample's force may exceed that by δ W.
//!
//! Here with the load W (F_z of a settled wheel), the slip by the total speed S, the slip angle β,
//! and the sense of rolling e. A mirrored motion has mirrored forces, an unloaded wheel and one at
//! rest have none.

use super::forces::WheelForces;
use super::inputs::Contact;
use super::slip::Slip;
use crate::elementary::exp;
use crate::elementary::wide::hypot;
use crate::soil::discrepancy::Blend;

/// Sense in which a wheel rolls, *e* [-]: 1 forward, −1 backward.
///
/// ```text
/// e = u (3 − u²)/2      u = (ω r_s + v_x)/(|ω r_s| + V)      V = √(v_x² + v_y²)
/// ```
///
/// 1 for any wheel whose rim and hub move forward, at small slip angles; it passes through 0 with
/// no jump where rim and hub oppose each other, where a locked wheel is dragged sideways, and at
/// rest.
#[must_use]
pub fn sense_of_rolling(slip: &Slip) -> f64 {
    let travel = hypot(slip.forward, slip.lateral);
    let speeds = slip.rim.abs() + travel;
    let u = (slip.rim + slip.forward) / hypot(speeds, slip.creep());
    u * (3.0 - u * u) / 2.0
}

/// The forces with the soil's discrepancy, under the load F_z.
pub(super) fn corrected(contact: &Contact, forces: WheelForces) -> WheelForces {
    let Some(discrepancy) = &contact.soil.discrepancy else { return forces };
    let (slip, load) = (&contact.slip, forces.normal_force);
    let blend = Blend::at(slip.total(), slip.angle);
    let along = sense_of_rolling(slip) * load;
    // Without a slip angle there is no side force, so its sign there does not matter.
    let across = load * f64::copysign(1.0, slip.angle);
    WheelForces {
        drawbar_pull: forces.drawbar_pull + along * blend.of(&discrepancy.drawbar_pull),
        side_force: forces.side_force + across * blend.of_side_force(&discrepancy.side_force),
        torque: forces.torque
            + along * contact.wheel.shearing_radius() * blend.of(&discrepancy.torque),
        ..forces
    }
}

/// The sinkage [m] with the soil's discrepancy, never beyond the axle.
pub(super) fn corrected_sinkage(contact: &Contact, sinkage: f64) -> f64 {
    match sinkage_factor(contact) {
        Some(factor) => (sinkage * factor).min(contact.wheel.shearing_radius()),
        None => sinkage,
    }
}

/// The model's own sinkage [m] where it is this one with the soil's discrepancy; at the axle it may
/// be any that is deeper.
pub(super) fn own_sinkage(contact: &Contact, corrected: f64) -> f64 {
    sinkage_factor(contact).map_or(corrected, |factor| corrected / factor)
}

/// e^(δ_h) [-]; none on a soil without a discrepancy.
fn sinkage_factor(contact: &Contact) -> Option<f64> {
    let discrepancy = contact.soil.discrepancy.as_ref()?;
    let slip = &contact.slip;
    Some(exp(Blend::at(slip.total(), slip.angle).of(&discrepancy.sinkage)))
}
