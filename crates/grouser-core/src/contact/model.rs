//! What a theory of the wheel-soil reaction is.

use super::bearing::Bearing;
use super::forces::WheelForces;
use super::slip::Slip;
use crate::soil::Soil;
use crate::wheel::Wheel;

/// One wheel on one soil, in one motion: all that decides the reaction, but for the sinkage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The wheel.
    pub wheel: Wheel,
    /// The soil under it.
    pub soil: Soil,
    /// How the rim moves against the soil.
    pub slip: Slip,
    /// Gravity, *g* [m/s²]; it gives the soil its weight.
    pub gravity: f64,
}

/// A theory of the wheel-soil reaction: a contact in, the wheel's forces out.
///
/// A theory is stateless and total: for any motion and any sinkage from 0 to the axle's depth
/// it returns finite forces, continuous in the sinkage, and none at sinkage 0.
pub trait WheelSoilModel: Sync {
    /// The reaction of the soil on a wheel sunk by `sinkage` [m].
    fn forces(&self, contact: &Contact, sinkage: f64) -> WheelForces;

    /// The contact made ready for a search over sinkages, if the theory knows how.
    ///
    /// Its normal force has the bits of [`forces`](Self::forces). A theory without it is asked for
    /// all its forces at every sinkage.
    fn bearing(&self, contact: &Contact) -> Option<Bearing> {
        let _ = contact;
        None
    }

    /// [`forces`](Self::forces) of a contact that was made ready before, with the same bits.
    fn forces_of(&self, contact: &Contact, bearing: &Bearing, sinkage: f64) -> WheelForces {
        let _ = bearing;
        self.forces(contact, sinkage)
    }
}

/// An end of the wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Front,
    Back,
}

/// The reaction for any motion, from a theory of a wheel that enters the soil with its front; none
/// without sinkage.
///
/// A wheel that rolls backward is seen in a mirror. Where rim and hub oppose each other both
/// views count, in the proportion of [`Slip::entering_side`]: the theories know only one, and to
/// switch between them would be a jump in force.
pub(super) fn from_both_sides(
    contact: &Contact,
    sinkage: f64,
    entering_front: impl Fn(&Contact, Side) -> WheelForces,
) -> WheelForces {
    if sinkage <= 0.0 {
        return WheelForces::default();
    }
    let front = || entering_front(contact, Side::Front);
    let back = || {
        let mirrored = Contact { slip: contact.slip.front_to_back(), ..*contact };
        entering_front(&mirrored, Side::Back).front_to_back()
    };
    let (front_share, back_share) = contact.slip.shares_of_sides();
    if back_share <= 0.0 {
        front()
    } else if front_share <= 0.0 {
        back()
    } else if front_share >= back_share {
        front() * front_share + back() * back_share
    } else {
        back() * back_share + front() * front_share
    }
}
