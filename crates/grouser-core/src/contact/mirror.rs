//! Wheels that enter the soil with their back, as their mirror images.

use super::forces::WheelForces;
use super::inputs::Contact;

/// An end of the wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Front,
    Back,
}

/// The reaction for any motion, from a model of a wheel that enters the soil with its front; none
/// without sinkage.
///
/// A wheel that rolls backward is seen in a mirror. Where rim and hub oppose each other both
/// views count, in the proportion of
/// [`Slip::entering_side`](super::slip::Slip::entering_side): the models know only one, and to
/// switch between them would be a jump in force.
#[inline]
pub(super) fn from_both_sides(
    contact: &Contact,
    sinkage: f64,
    entering_front: impl Fn(&Contact, Side) -> WheelForces,
) -> WheelForces {
    if sinkage <= 0.0 {
        return WheelForces::default();
    }
    let front = || entering_front(contact, Side::Front);
    let back = || entering_front(&contact.front_to_back(), Side::Back).front_to_back();
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
