//! The heading to set on a slope, and the steepest heading that keeps the slip within its limit.

use super::limits::Limits;
use crate::elementary::wide::sin;
use crate::simulation::{MOST_SLIP, SteadyMotion};
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::ensemble::{Band, Probability};
use crate::studies::heading::{HeadingStudy, STRAIGHT_DOWN, STRAIGHT_UP, STUCK};
use crate::studies::heading_band::SlopeBand;

/// The heading to set on a slope.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadingAdvice {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The heading that holds the contour, *γ* [rad], positive uphill: the median over the samples,
    /// and its band; `None` where no heading holds it in half of them.
    pub contour: Option<Band>,
    /// The steepest heading, 0 to 90°, at which the slip keeps its limit in as many samples as it
    /// must [rad]; `None` where it does not even with the nose on the contour.
    pub steepest: Option<f64>,
    /// What to set; `None` where no heading both keeps the limit and does not take the rover far
    /// off the contour.
    pub advised: Option<AdvisedHeading>,
}

/// A heading, with what the rover does at it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdvisedHeading {
    /// Heading, *γ* [rad]: that which holds the contour, or the steepest that keeps the limit where
    /// that is less.
    pub yaw: f64,
    /// Samples in which the slip keeps its limit.
    pub within: Probability,
    /// Mean slip ratio of the wheels [-], over all samples: 1 where the rover is stuck.
    pub slip_ratio: Band,
    /// Drift, way downhill for a metre travelled [-], likewise.
    pub drift: Band,
    /// Torque of all wheels over their shearing radii [N], over the samples that move: power over
    /// the rims' speed.
    pub thrust: Option<Band>,
}

impl HeadingAdvice {
    /// * `band`: the headings that hold the contour of the slope
    /// * `go_on`: asked before each sample; `None` if it was false
    pub(super) fn on_slope(
        study: &HeadingStudy,
        samples: &[Sample],
        band: &SlopeBand,
        limits: &Limits,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let slope = band.slope;
        let contour = band.yaw.filter(|yaw| yaw.median.is_finite());
        let steepest = outputs_of_samples(samples, go_on, |sample| {
            steepest_within(&study.of_sample(sample), slope, limits)
        })?;
        let steepest = kept_by_enough(steepest, limits);
        let yaw = contour.zip(steepest).map(|(contour, steepest)| contour.median.min(steepest));
        let advised = match yaw {
            Some(yaw) => Some(AdvisedHeading::at(study, samples, (slope, yaw), limits, go_on)?)
                .filter(|it| limits.is_kept(it.within.successes, it.within.trials)),
            None => None,
        };
        Some(Self { slope, contour, steepest, advised })
    }
}

impl AdvisedHeading {
    fn at(
        study: &HeadingStudy,
        samples: &[Sample],
        (slope, yaw): (f64, f64),
        limits: &Limits,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Option<Self> {
        let motions = outputs_of_samples(samples, go_on, |sample| {
            moving(&study.of_sample(sample), (slope, yaw), limits.rim_speed, None)
        })?;
        let slips = || motions.iter().map(|it| slip_of(it.as_ref()));
        let kept = slips().filter(|slip| *slip <= limits.slip_ratio).count();
        let drift = |it: &Option<SteadyMotion>| {
            it.as_ref().map_or(STRAIGHT_DOWN, |motion| -sin(motion.course()))
        };
        Some(Self {
            yaw,
            within: Probability { successes: kept, trials: motions.len() },
            slip_ratio: Band::of(slips())?,
            drift: Band::of(motions.iter().map(drift))?,
            thrust: Band::of(motions.iter().flatten().map(|it| thrust_of(study, it))),
        })
    }

    /// Power of the motors at a rim speed [m/s]: the median and its band [W].
    #[must_use]
    pub fn power(&self, rim_speed: f64) -> Option<Band> {
        self.thrust.map(|it| Band {
            low: it.low * rim_speed,
            median: it.median * rim_speed,
            high: it.high * rim_speed,
        })
    }
}

/// Torque of all wheels over their shearing radii [N].
fn thrust_of(study: &HeadingStudy, motion: &SteadyMotion) -> f64 {
    let each = motion.wheels.iter().zip(study.rover.mounts());
    each.map(|(wheel, mount)| wheel.settled.forces.torque / mount.shearing_radius()).sum()
}

/// The steady motion on a slope at a yaw; `None` of a rover that is stuck.
///
/// * `near`: another on that slope, to begin with
pub(super) fn moving(
    study: &HeadingStudy,
    (slope, yaw): (f64, f64),
    rim_speed: f64,
    near: Option<&SteadyMotion>,
) -> Option<SteadyMotion> {
    let motion = match near {
        Some(near) => study.steady_motion_near(near, slope, yaw, rim_speed),
        None => study.steady_motion(slope, yaw, rim_speed),
    };
    motion.ok().filter(|it| it.slip_ratio() <= MOST_SLIP)
}

/// Mean slip ratio of the wheels [-].
pub(super) fn slip_of(motion: Option<&SteadyMotion>) -> f64 {
    motion.map_or(STUCK, SteadyMotion::slip_ratio)
}

/// The steepest heading at which the slip is within its limit in one soil [rad]: it grows as the
/// nose turns uphill. `None` where it is not with the nose on the contour.
fn steepest_within(study: &HeadingStudy, slope: f64, limits: &Limits) -> Option<f64> {
    /// To a third of a degree.
    const ROUNDS: usize = 8;
    let at = |yaw: f64, near: Option<&SteadyMotion>| {
        moving(study, (slope, yaw), limits.rim_speed, near)
            .filter(|it| it.slip_ratio() <= limits.slip_ratio)
    };
    let mut motion = at(0.0, None)?;
    if at(STRAIGHT_UP, None).is_some() {
        return Some(STRAIGHT_UP);
    }
    let (mut low, mut high) = (0.0, STRAIGHT_UP);
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low + high);
        match at(middle, Some(&motion)) {
            Some(there) => (low, motion) = (middle, there),
            None => high = middle,
        }
    }
    Some(low)
}

/// The highest value that enough of all reach; `None` where not enough have one.
fn kept_by_enough(values: Vec<Option<f64>>, limits: &Limits) -> Option<f64> {
    let all = values.len();
    let enough = (1..=all).find(|count| limits.is_kept(*count, all))?;
    let mut known: Vec<f64> = values.into_iter().flatten().collect();
    known.sort_by(|one, other| other.total_cmp(one));
    known.get(enough - 1).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn enough_of_all_reach_the_value() {
        let values = || vec![Some(3.0), None, Some(1.0), Some(2.0), Some(5.0)];
        let by = |no_go_probability: f64| {
            let limits = Limits { slip_ratio: 0.6, no_go_probability, rim_speed: 0.06 };
            kept_by_enough(values(), &limits)
        };
        assert_eq!(by(1.0), Some(5.0));
        assert_eq!(by(0.8), Some(3.0));
        assert_eq!(by(0.21), Some(1.0));
        // One in five is as many as make a no-go.
        assert_eq!(by(0.2), None);
    }
}
