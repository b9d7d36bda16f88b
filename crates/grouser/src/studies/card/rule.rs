//! Go, caution, no-go: the rule, and what no rule may allow.

use std::f64::consts::PI;

use serde::Serialize;

use crate::error::ParameterError;
use crate::soil::SlopeStability;
use crate::studies::heading::HeadingStudy;

/// Whether to drive on a slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Drive.
    Go,
    /// Drive only after a second check: measured slip, a stop on the way, a person's decision.
    Caution,
    /// Do not drive.
    NoGo,
}

/// The limits of the verdicts. Source of all numbers: ours; a mission has its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rule {
    /// Go: a contour traverse exists and slips at most this much [-] …
    pub go_slip_ratio: f64,
    /// … in at least this share of the samples [-].
    pub go_probability: f64,
    /// No-go: a contour traverse exists and slips at most this much [-] …
    pub no_go_slip_ratio: f64,
    /// … in less than this share of the samples [-].
    pub no_go_probability: f64,
}

/// No slope is a go that is not this much flatter than the soil's friction angle [rad], whatever
/// its cohesion: 5°. Source: ours.
pub const BELOW_FRICTION_ANGLE: f64 = 5.0 * PI / 180.0;

/// No slope is a go on which the rover is stuck by the card's heading in more than this share of
/// the samples [-]: 5 of 1000. Source: ours.
pub const STUCK_ON_GO: f64 = 0.005;

/// The steepest slopes that can be a go, and a caution [rad], whatever the samples say: no go near
/// the friction angle, none below the usual factor of safety, none without a stated uncertainty;
/// and neither ground that slides by itself, nor above the friction angle, where it stands by a
/// cohesion that wheels break, is to be driven.
///
/// * `is_uncertainty_stated`: of the soil
pub(in crate::studies) fn best_slopes(
    heading: &HeadingStudy,
    is_uncertainty_stated: bool,
) -> (Option<f64>, f64) {
    let (soil, gravity) = (&heading.soil, heading.gravity);
    let caution = heading.ground_limit().min(soil.friction_angle);
    let by_friction = soil.friction_angle - BELOW_FRICTION_ANGLE;
    let flattest = by_friction.min(soil.stable_slope(gravity, SlopeStability::USUAL));
    (is_uncertainty_stated.then_some(flattest.min(caution)), caution)
}

impl Rule {
    /// Slip 0.3: rims go 1.4 times the way, and thrust still grows with slip. 0.95: the share of a
    /// 95 % band.
    /// Slip 0.6: rims go 2.5 times the way, and thrust hardly grows any more: nothing is left to
    /// get out with. 0.8: on one soil in five no heading holds the contour.
    pub const DEFAULT: Self = Self {
        go_slip_ratio: 0.3,
        go_probability: 0.95,
        no_go_slip_ratio: 0.6,
        no_go_probability: 0.8,
    };

    /// Checks that no slope can be both a go and a no-go.
    ///
    /// # Errors
    /// [`ParameterError`] for shares and slip ratios outside 0 to 1, and a go that asks for less
    /// than a no-go.
    pub fn check(&self) -> Result<(), ParameterError> {
        let within = |name: &str, value: f64, most: f64, expected: &'static str| {
            let inside = (0.0..=most).contains(&value);
            inside.then_some(()).ok_or_else(|| ParameterError::new(name, value, expected))
        };
        let (slip, share) = (self.no_go_slip_ratio, self.go_probability);
        within("the no-go slip ratio", slip, 1.0, "0 to 1")?;
        within("the go slip ratio", self.go_slip_ratio, slip, "0 to the no-go slip ratio")?;
        within("the go probability", share, 1.0, "0 to 1")?;
        let most = "0 to the go probability";
        within("the no-go probability", self.no_go_probability, share, most)
    }

    /// The verdict on a slope.
    ///
    /// * `slips`: slip ratio of the contour traverse in each sample for which it is known, `None`
    ///   where no heading holds the contour
    /// * `not_found`: how many samples there are beside them, which make no slope a go and none a
    ///   no-go
    pub(super) fn verdict(&self, slips: &[Option<f64>], not_found: usize) -> Verdict {
        let share_within = |most: f64, unknown: usize| {
            let count = slips.iter().flatten().filter(|slip| **slip <= most).count();
            (count + unknown) as f64 / (slips.len() + not_found) as f64
        };
        if share_within(self.go_slip_ratio, 0) >= self.go_probability {
            Verdict::Go
        } else if share_within(self.no_go_slip_ratio, not_found) < self.no_go_probability {
            Verdict::NoGo
        } else {
            Verdict::Caution
        }
    }
}
