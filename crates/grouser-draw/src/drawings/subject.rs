//! What is drawn: a wheel in its soil, and a rover on a slope.

use grouser_core::contact::{Contact, Settled};
use grouser_core::vehicle::Rover;
use grouser_core::vehicle::on_ground::WheelReaction;

/// A wheel in its soil, settled under its load.
#[derive(Clone, Copy, Debug)]
pub struct WheelInSoil<'a> {
    /// The wheel, the soil, and how they move against each other.
    pub contact: &'a Contact,
    /// Sinkage and forces.
    pub settled: &'a Settled,
    /// Its load [N].
    pub load: f64,
}

/// A rover that holds the contour of a slope.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<'a> {
    /// The rover.
    pub rover: &'a Rover,
    /// Inclination of the slope, *α* [rad].
    pub slope: f64,
    /// Yaw, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Gravity [m/s²].
    pub gravity: f64,
    /// The wheels, in the mounts' order.
    pub wheels: &'a [WheelReaction],
}
