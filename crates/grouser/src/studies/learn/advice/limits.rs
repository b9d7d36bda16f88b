//! The slip that is to be kept.

use crate::studies::card::Rule;

/// The slip that a rover is to keep, and how surely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// The share of the samples in which it is to be kept at least [-].
    pub probability: f64,
    /// Rim speed ω r_s that is asked for [m/s].
    pub rim_speed: f64,
}

impl Limits {
    /// Those below which a slope is a no-go by [`Rule::DEFAULT`].
    #[must_use]
    pub fn usual(rim_speed: f64) -> Self {
        let Rule { no_go_slip_ratio, no_go_probability, .. } = Rule::DEFAULT;
        Self { slip_ratio: no_go_slip_ratio, probability: no_go_probability, rim_speed }
    }
}
