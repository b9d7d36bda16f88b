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

/// What a soil's discrepancy comes to on a wheel in one motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correction {
    /// Sense of rolling [-].
    along: f64,
    /// Sign of the side force [-].
    across: f64,
    /// Shares of the load [-], the torque's times the shearing radius.
    drawbar_pull: f64,
    side_force: f64,
    torque: f64,
    /// r_s [m].
    radius: f64,
    /// e^(δ_h) [-].
    sinkage: f64,
}

impl Correction {
    /// The correction of a contact; none on a soil without a discrepancy.
    pub(crate) fn of(contact: &Contact) -> Option<Self> {
        let discrepancy = contact.soil.discrepancy.as_ref()?;
        let slip = &contact.slip;
        let blend = Blend::at(slip.total(), slip.angle);
        Some(Self {
            along: sense_of_rolling(slip),
            // Without a slip angle there is no side force, so its sign there does not matter.
            across: f64::copysign(1.0, slip.angle),
            drawbar_pull: blend.of(&discrepancy.drawbar_pull),
            side_force: blend.of_side_force(&discrepancy.side_force),
            torque: blend.of(&discrepancy.torque),
            radius: contact.wheel.shearing_radius(),
            sinkage: exp(blend.of(&discrepancy.sinkage)),
        })
    }

    /// The forces with it, under the load F_z.
    pub(crate) fn forces(&self, forces: WheelForces) -> WheelForces {
        let load = forces.normal_force;
        let (along, across) = (self.along * load, self.across * load);
        WheelForces {
            drawbar_pull: forces.drawbar_pull + along * self.drawbar_pull,
            side_force: forces.side_force + across * self.side_force,
            torque: forces.torque + along * self.radius * self.torque,
            ..forces
        }
    }

    /// The sinkage [m] with it, never beyond the axle.
    pub(crate) fn sinkage(&self, own: f64) -> f64 {
        (own * self.sinkage).min(self.radius)
    }
}

/// The forces with the soil's discrepancy, under the load F_z.
pub(super) fn corrected(contact: &Contact, forces: WheelForces) -> WheelForces {
    Correction::of(contact).map_or(forces, |correction| correction.forces(forces))
}

/// The model's own sinkage [m] where it is this one with the soil's discrepancy; at the axle it may
/// be any that is deeper.
pub(crate) fn own_sinkage(contact: &Contact, corrected: f64) -> f64 {
    Correction::of(contact).map_or(corrected, |correction| corrected / correction.sinkage)
}
