//! What decides the reaction on one wheel.

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
