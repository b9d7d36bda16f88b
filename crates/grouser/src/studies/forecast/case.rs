//! One case of a forecast: a rover of one mass on one soil, by one model.

use super::error::ForecastError;
use crate::studies::heading::{
    HeadingOffset, HeadingStudy, LimitedBy, NoHeading, STRAIGHT_DOWN, STUCK,
};
use crate::vehicle::Rover;

/// The numbers that a forecast needs of a case.
#[derive(Clone)]
pub(super) struct OfCase {
    /// Steepest slope on which a heading holds the contour [rad]; 0 where the rover cannot move.
    pub(super) limit: f64,
    /// On each slope.
    pub(super) slopes: Vec<OnSlope>,
}

/// The same on a slope; every number is one without a heading too.
#[derive(Clone, Copy)]
pub(super) struct OnSlope {
    /// Infinite where no heading holds the contour.
    pub(super) yaw: f64,
    pub(super) slip_ratio: f64,
    pub(super) sinkage: f64,
    /// Infinite likewise.
    pub(super) power: f64,
    /// Infinite likewise.
    pub(super) energy_per_metre: f64,
    /// With the nose on the contour.
    pub(super) drift: f64,
}

impl OfCase {
    pub(super) fn of(
        study: &HeadingStudy,
        rim_speed: f64,
        slopes: &[f64],
    ) -> Result<Self, ForecastError> {
        let (level, drifting) = (study.curve()?, study.drift_curve()?);
        let on_slope = |slope: &f64| {
            let drift = known(drifting.at(*slope))?.map_or(STRAIGHT_DOWN, |it| it.drift());
            Ok(match known(level.at(*slope))? {
                Some(heading) => OnSlope::held(&heading, &study.rover, rim_speed, drift),
                None => OnSlope::stuck(&study.rover, drift),
            })
        };
        let limit = known(level.limit())?.map_or(0.0, |(slope, _)| slope);
        if level.limited_by() == Some(LimitedBy::NotFound) {
            // The slope beyond the last that was found, by its reason.
            known(level.at(limit.next_up()))?;
        }
        let slopes = slopes.iter().map(on_slope).collect::<Result<_, ForecastError>>()?;
        Ok(Self { limit, slopes })
    }
}

/// What was found, or nothing where no heading holds the course.
///
/// # Errors
/// [`ForecastError::NotFound`] where the search gave up.
pub(super) fn known<T>(found: Result<T, NoHeading>) -> Result<Option<T>, ForecastError> {
    match found {
        Ok(it) => Ok(Some(it)),
        Err(none) if none.is_not_found() => Err(ForecastError::NotFound(none)),
        Err(_) => Ok(None),
    }
}

impl OnSlope {
    /// Whether no heading holds the contour.
    pub(super) fn is_stuck(&self) -> bool {
        self.yaw.is_infinite()
    }

    fn held(heading: &HeadingOffset, rover: &Rover, rim_speed: f64, drift: f64) -> Self {
        Self {
            yaw: heading.yaw,
            slip_ratio: heading.slip_ratio,
            sinkage: heading.mean_sinkage(),
            power: heading.power(rover, rim_speed),
            energy_per_metre: heading.energy_per_metre(rover),
            drift,
        }
    }

    fn stuck(rover: &Rover, drift: f64) -> Self {
        Self {
            yaw: f64::INFINITY,
            slip_ratio: STUCK,
            sinkage: rover.mean_axle_height(),
            power: f64::INFINITY,
            energy_per_metre: f64::INFINITY,
            drift,
        }
    }
}
