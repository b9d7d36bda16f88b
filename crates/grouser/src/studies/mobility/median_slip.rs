//! Slip along one course by slope, in the middle of the samples.

use crate::studies::ensemble::Band;
use crate::studies::heading::{HeadingCurve, LimitedBy, STUCK};

/// Slopes are so far apart [rad], half a degree, and there are so many: up to 60°.
const SLOPE_STEP: f64 = std::f64::consts::PI / 360.0;
const SLOPES: usize = 121;

/// The median over the samples of the slip ratio with which each holds a course by its own heading,
/// for slopes from level ground on. A sample that holds it by none, or slips more than a no-go, has
/// slip 1; one for which the search gave up does not count.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MedianSlip(Vec<f64>);

impl MedianSlip {
    /// * `samples`: the [slips](slips) of each
    pub(super) fn of(samples: &[&[f64]]) -> Self {
        let median = |place: usize| {
            let known = samples.iter().map(|slips| slips[place]).filter(|slip| !slip.is_nan());
            Band::of(known).map_or(f64::NAN, |band| band.median)
        };
        Self((0..SLOPES).map(median).collect())
    }

    /// On a slope [rad]; NaN where no sample is known.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a place in a list, and slopes are not negative"
    )]
    pub(super) fn at(&self, slope: f64) -> f64 {
        let place = (slope / SLOPE_STEP).clamp(0.0, (SLOPES - 1) as f64);
        let below = (place as usize).min(SLOPES - 2);
        let (one, other) = (self.0[below], self.0[below + 1]);
        let share = place - below as f64;
        if share == 0.0 { one } else { one + share * (other - one) }
    }

    /// The mean of those on two courses.
    pub(super) fn between(one: &Self, other: &Self) -> Self {
        Self(one.0.iter().zip(&other.0).map(|(one, other)| f64::midpoint(*one, *other)).collect())
    }
}

/// The slip ratio of one sample on each of the slopes, between the points of its curve: 1 beyond
/// its end, and where it slips more than a no-go; NaN beyond where the search gave up.
pub(super) fn slips(curve: &HeadingCurve, most_slip: f64) -> Vec<f64> {
    let points: Vec<[f64; 3]> = curve.points().collect();
    let gave_up = curve.limited_by() == Some(LimitedBy::NotFound)
        || curve.limit().is_err_and(|none| none.is_not_found());
    let beyond = if gave_up { f64::NAN } else { STUCK };
    let slip = |place: usize| {
        let slope = place as f64 * SLOPE_STEP;
        let Some(above) = points.iter().position(|point| point[0] >= slope) else { return beyond };
        let (low, high) = (points[above.saturating_sub(1)], points[above]);
        let rise = high[0] - low[0];
        let share = if rise > 0.0 { (slope - low[0]) / rise } else { 1.0 };
        let slip = low[1] + share * (high[1] - low[1]);
        if slip.abs() > most_slip { STUCK } else { slip }
    };
    (0..SLOPES).map(slip).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One that gave up does not count, and between nodes lies a straight line.
    #[test]
    fn the_middle_sample_is_read_between_slopes() {
        let sample = |level: f64, next: f64| {
            let mut slips = vec![1.0; SLOPES];
            slips[..2].copy_from_slice(&[level, next]);
            slips
        };
        let of = |samples: &[Vec<f64>]| {
            MedianSlip::of(&samples.iter().map(Vec::as_slice).collect::<Vec<_>>())
        };
        let found =
            of(&[sample(0.1, 0.2), sample(0.3, 0.5), sample(0.2, 0.3), sample(f64::NAN, f64::NAN)]);
        assert_eq!(found.at(0.0), 0.2);
        assert!((found.at(0.5 * SLOPE_STEP) - 0.25).abs() < 1e-12);
        assert_eq!(found.at(2.0), 1.0);
        let none = of(&[sample(f64::NAN, 0.1)]);
        assert!(none.at(0.0).is_nan() && MedianSlip::between(&found, &none).at(0.0).is_nan());
    }
}
