//! The slip that is to be kept.

use crate::studies::verdict::Rule;

/// The slip that a rover is to keep, and how surely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Slip ratio [-].
    pub slip_ratio: f64,
    /// A heading is not advised at which it is not kept in this share of the samples, or more [-].
    pub no_go_probability: f64,
    /// Rim speed ω r_s that is asked for [m/s].
    pub rim_speed: f64,
}

impl Limits {
    /// Whether so many of all samples keep the slip that a heading may be advised.
    pub(super) fn is_kept(&self, kept: usize, all: usize) -> bool {
        /// 1 of 5 is 0.2, whatever the rounding [-].
        const ROUND_OFF: f64 = 1e-9;
        ((all - kept) as f64) < self.no_go_probability * all as f64 - ROUND_OFF
    }

    /// Those below which a slope is a no-go by [`Rule::DEFAULT`].
    #[must_use]
    pub fn usual(rim_speed: f64) -> Self {
        let Rule { no_go_slip_ratio, no_go_probability, .. } = Rule::DEFAULT;
        Self { slip_ratio: no_go_slip_ratio, no_go_probability, rim_speed }
    }
}
