//! What a study of heading offsets is about.

use crate::contact::Theory;
use crate::soil::{SlopeStability, Soil};
use crate::vehicle::{LoadSharing, OwnMoments, Rover};

/// Finds heading offsets of a rover on a soil, for any slope.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingStudy {
    /// The rover.
    pub rover: Rover,
    /// The soil.
    pub soil: Soil,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
    /// The wheel–soil model.
    pub theory: Theory,
    /// How the weight is transferred between the wheels.
    pub sharing: LoadSharing,
    /// Whether the wheels' own moments act on the rover.
    pub own_moments: OwnMoments,
    /// What is asked of the ground's own strength before a rover crosses it.
    pub stability: SlopeStability,
}

/// The farthest course from the contour [rad]: straight up or down the slope. Beyond it a rover
/// travels the other way, and is its own mirror image.
pub const STRAIGHT_UP: f64 = std::f64::consts::FRAC_PI_2;
