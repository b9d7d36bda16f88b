//! What becomes of a rover that is driven as the card says: nose set to the row's heading, and set again after
//! every leg.
//!
//! A contour traverse balances forces, not the yaw moment: the nose turns on the way. In the steady motion at the
//! heading γ it turns by κ over the way, so that over a leg of length L the heading is γ + κ L/2 on average, and
//! the drift is that of the steady motion there.

use super::super::ensemble::samples::{Sample, outputs_of_places, outputs_of_samples};
use super::super::ensemble::{Band, Probability};
use super::super::heading::HeadingStudy;
use crate::elementary::wide::{asin, atan2, cos, sin};
use crate::simulation::{MOST_SLIP, SteadyMotion};

/// The heading may be off by this much before it is set again [rad]: 2°. Source: ours; about what a driver reads off
/// an instrument that shows whole degrees.
pub const HEADING_ERROR: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// The heading is set again after this way at the latest [m]. Source: ours.
const LONGEST_LEG: f64 = 10.0;

/// Slip ratio of a rover that holds no course [-].
pub(super) const STUCK: f64 = 1.0;

/// Drift of a rover that slides: straight downhill [m/m].
pub(super) const STRAIGHT_DOWN: f64 = 1.0;

/// A slope, driven as the card says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Heading that is set at the start of every leg, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Roll that instruments show then [rad], positive with the uphill side higher.
    pub roll: f64,
    /// Pitch that they show [rad], positive with the nose higher.
    pub pitch: f64,
    /// The motion by it, if the rover moves on any of the samples.
    pub motion: Option<DrivenMotion>,
    /// By how much the slope could be steeper before the rover tips over, at rest [rad].
    pub tipping_margin: f64,
}

/// The motion by the card's heading, over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenMotion {
    /// After how much way the heading is to be set again [m].
    pub correct_every: f64,
    /// By how much the nose falls over the way [rad/m], positive downhill, over the samples that move.
    pub heading_fall: Option<Band>,
    /// Drift, way downhill for a metre travelled [-], over all samples: 1 where the rover is stuck.
    pub drift: Option<Band>,
    /// Mean slip ratio of the wheels [-], over all samples: 1 where the rover is stuck.
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m], over the samples that move.
    pub sinkage: Option<Band>,
    /// Largest torque of a wheel [N·m], likewise.
    pub torque: Option<Band>,
    /// Way of the rims for a metre of ground [-], likewise.
    pub rim_way: Option<Band>,
    /// Samples in which the rover is stuck: it has no steady motion, or its wheels all but spin.
    pub stuck: Probability,
}

/// Roll and pitch of a rover on a plane slope [rad].
///
/// * `slope`, `yaw`: *α*, *γ* [rad]
///
/// ```text
/// sin θ = sin α sin γ        tan φ = tan α cos γ
/// ```
#[must_use]
pub fn roll_and_pitch(slope: f64, yaw: f64) -> [f64; 2] {
    let across = sin(slope) * cos(yaw);
    [atan2(across, cos(slope)), asin(sin(slope) * sin(yaw))]
}

impl Driven {
    /// What does not depend on the soil.
    pub(super) fn at_rest(study: &HeadingStudy, slope: f64, yaw: f64) -> Self {
        let [roll, pitch] = roll_and_pitch(slope, yaw);
        let tipping_margin = study.tipping_slope(yaw) - slope;
        Self { yaw, roll, pitch, motion: None, tipping_margin }
    }
}

impl DrivenMotion {
    /// Drives all samples on a slope by a heading; `None` if the rover is stuck in each of them.
    ///
    /// * `samples`: of soil and model, one at least
    pub(super) fn of(
        study: &HeadingStudy,
        samples: &[Sample],
        rim_speed: f64,
        (slope, yaw): (f64, f64),
    ) -> Option<Self> {
        let moves = |motion: SteadyMotion| (motion.slip_ratio() <= MOST_SLIP).then_some(motion);
        let motions = outputs_of_samples(samples, &|| true, |sample| {
            moves(study.of_sample(sample).steady_motion(slope, yaw, rim_speed).ok()?)
        });
        let motions: Vec<Option<SteadyMotion>> = motions.unwrap_or_default();
        let moving = || motions.iter().flatten();
        let fastest = Band::of(moving().map(|it| it.turning().abs()))?.high;
        let correct_every = drivable(HEADING_ERROR / fastest.max(HEADING_ERROR / LONGEST_LEG));
        let drift = outputs_of_places(samples, &|| true, |place| {
            let motion = motions[place].as_ref()?;
            let mean = yaw + 0.5 * motion.turning() * correct_every;
            let study = study.of_sample(&samples[place]);
            let motion = study.steady_motion_near(motion, slope, mean, rim_speed).ok()?;
            Some(-sin(moves(motion)?.course()))
        });
        let drift = drift.unwrap_or_default();
        let slips = motions.iter().map(|it| it.as_ref().map_or(STUCK, SteadyMotion::slip_ratio));
        let stuck = motions.iter().filter(|it| it.is_none()).count();
        Some(Self {
            correct_every,
            heading_fall: Band::of(moving().map(|it| -it.turning())),
            drift: Band::of(drift.into_iter().map(|it| it.unwrap_or(STRAIGHT_DOWN))),
            slip_ratio: Band::of(slips),
            sinkage: Band::of(moving().map(mean_sinkage)),
            torque: Band::of(moving().map(largest_torque)),
            rim_way: Band::of(moving().map(|it| rim_speed / it.speed())),
            stuck: Probability { successes: stuck, trials: samples.len() },
        })
    }
}

/// Mean sinkage of the wheels [m].
fn mean_sinkage(motion: &SteadyMotion) -> f64 {
    let sum: f64 = motion.wheels.iter().map(|wheel| wheel.settled.sinkage).sum();
    sum / motion.wheels.len() as f64
}

/// Torque of the wheel that has most [N·m].
fn largest_torque(motion: &SteadyMotion) -> f64 {
    motion.wheels.iter().map(|wheel| wheel.settled.forces.torque).fold(0.0, f64::max)
}

/// A way that a driver can keep to, at most as long as this one [m]: with one digit, or halves above 1 m.
fn drivable(way: f64) -> f64 {
    /// Nobody drives by less than this [m].
    const SHORTEST: f64 = 1e-3;
    let steps = [(1.0, 0.5), (0.1, 0.1), (0.01, 0.01)];
    let step = steps.iter().find(|(from, _)| way >= *from).map_or(SHORTEST, |(_, step)| *step);
    // 0.3 over 0.1 is less than 3.
    (way / step + 1e-9).floor() * step
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    /// Along the contour all of the slope is roll, straight up all of it is pitch, and the upright's share is
    /// always the slope's.
    #[test]
    fn roll_and_pitch_share_the_slope() {
        for (slope, yaw) in [(10.0, 0.0), (10.0, 90.0), (25.0, 30.0), (13.0, 8.0)] {
            let (slope, yaw) = (deg(slope), deg(yaw));
            let [roll, pitch] = roll_and_pitch(slope, yaw);
            assert!((cos(roll) * cos(pitch) - cos(slope)).abs() < 1e-12);
        }
        let [roll, pitch] = roll_and_pitch(deg(10.0), 0.0);
        assert!((roll - deg(10.0)).abs() < 1e-12 && pitch == 0.0);
        let [roll, pitch] = roll_and_pitch(deg(10.0), deg(90.0));
        assert!(roll.abs() < 1e-12 && (pitch - deg(10.0)).abs() < 1e-12);
    }

    #[test]
    fn a_way_is_rounded_down_to_what_can_be_driven() {
        for (way, expected) in [(0.349, 0.3), (0.3, 0.3), (0.061, 0.06), (1.49, 1.0), (7.9, 7.5)] {
            assert!((drivable(way) - expected).abs() < 1e-12, "{way}");
        }
    }
}
