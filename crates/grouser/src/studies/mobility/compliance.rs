//! What slip on slopes is worth to simulators whose wheels slip in proportion to the force on them.
//!
//! Such a wheel's slip is its *compliance* times the tangential force over the normal one, which on
//! a slope is the tangent of the slope. Straight uphill the one lengthwise follows from the slip
//! ratio, and with the nose along the contour the one sideways from the drift:
//!
//! ```text
//! C_x(α) = (s(α) − s(0)) / tan α        C_y(α) = tan c(α) / tan α        sin c: the drift downhill per metre of way
//! ```
//!
//! The slip on level ground, s(0), comes from the soil's resistance, which those simulators do not
//! have: it is left out.

use super::table::MobilityTable;
use crate::elementary::wide::{asin, tan};
use crate::error::ParameterError;
use crate::studies::heading::STRAIGHT_UP;
use crate::studies::verdict::SlopeStudy;

/// Compliances of all wheels together, by slope.
#[derive(Clone, Debug, PartialEq)]
pub struct SlipCompliances {
    uphill: MobilityTable,
    contour: MobilityTable,
}

/// On flatter ground compliances are those of this slope [rad], 1°: they are quotients of what
/// vanishes there.
const FLATTEST: f64 = std::f64::consts::PI / 180.0;

impl SlopeStudy {
    /// Compliances of the soil as written; `None` if `go_on` was false before the end.
    ///
    /// # Errors
    /// The same as [`table`](Self::table).
    pub fn slip_compliances(
        &self,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<SlipCompliances>, ParameterError> {
        let tables = [STRAIGHT_UP, 0.0].map(|course| self.table(course, &[], go_on));
        let [uphill, contour] = tables;
        Ok(uphill?.zip(contour?).map(|(uphill, contour)| SlipCompliances { uphill, contour }))
    }
}

impl SlipCompliances {
    /// Slip ratio for a lengthwise force as large as the load [-]. On a slope that cannot be
    /// climbed it is the one with which a wheel stands still there.
    #[must_use]
    pub fn lengthwise(&self, slope: f64) -> f64 {
        let slope = slope.max(FLATTEST);
        let level = self.uphill.motion(0.0).map_or(0.0, |it| it.slip_ratio);
        let slip_ratio = self.uphill.motion(slope).map_or(1.0, |it| it.slip_ratio);
        (slip_ratio - level).max(0.0) / tan(slope)
    }

    /// Drift for a sideways force as large as the load [m/m]. On a slope where nothing holds the
    /// rover it is that of the steepest slope where something does.
    #[must_use]
    pub fn sideways(&self, slope: f64) -> f64 {
        let steepest = self.contour.steepest_with_drift().unwrap_or(FLATTEST);
        let slope = slope.clamp(FLATTEST, steepest.max(FLATTEST));
        let drift = self.contour.motion(slope).map_or(0.0, |it| it.drift);
        if drift.is_finite() { tan(asin(drift.clamp(0.0, 0.99))) / tan(slope) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;
    use grouser_io::{self as document, Overrides, Source};

    /// A wheel of the compliance slips on the slope as the rover does, beside what it slips on
    /// level ground.
    #[test]
    fn compliances_give_the_slip_back() {
        let scenario =
            document::read_scenario(&Source::default_scenario(), &Overrides::none()).unwrap();
        let study = SlopeStudy::of(&scenario);
        let found = study.slip_compliances(&|| true).unwrap().unwrap();
        let up = study.heading.curve_on(STRAIGHT_UP).unwrap();
        let level = up.at(0.0).unwrap().slip_ratio;
        for slope in [4.0, 9.0, 14.0].map(deg) {
            let slip = found.lengthwise(slope) * slope.tan() + level;
            assert!((slip - up.at(slope).unwrap().slip_ratio).abs() < 2e-3, "{slope}: {slip}");
            let drifting = study.heading.drift_curve().unwrap().at(slope).unwrap();
            let drift = (found.sideways(slope) * slope.tan()).atan();
            assert!((drift - drifting.crab()).abs() < 2e-3, "{slope}: {drift} {drifting:?}");
        }
        // Where it cannot climb, a wheel stands still.
        let steep = deg(40.0);
        assert!((found.lengthwise(steep) * steep.tan() + level - 1.0).abs() < 1e-9);
        assert!(found.sideways(steep).is_finite() && found.sideways(0.0) > 0.0);
    }
}
