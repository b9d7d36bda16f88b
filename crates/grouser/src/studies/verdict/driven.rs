//! What becomes of a rover that is driven as the card says: nose set to the row's heading, and set
//! again after every leg.
//!
//! A contour traverse balances forces, not the yaw moment: the nose turns on the way. In the steady
//! motion at the heading γ it turns by κ over the way, so that over a leg of length L the heading
//! is γ + ε + κ L/2 on average, with the error ε of the driver who set it, and the drift is that of
//! the steady motion there.
//!
//! A rover that holds its heading by itself has its forces balanced, and a yaw moment that it makes
//! itself: κ = 0. The driver sets the nose once, and it stays at γ + ε.

use rand_chacha::ChaCha8Rng;

use super::super::ensemble::samples::{Sample, outputs_of_places};
use super::super::ensemble::{Band, Probability, outputs};
use super::super::heading::{HeadingStudy, STRAIGHT_DOWN, STUCK, Steering};
use super::held::Holding;
use super::slip_check::SlipCheck;
use crate::elementary::wide::sin;
use crate::simulation::power::electrical;
use crate::simulation::{MOST_SLIP, Seeking, SteadyMotion};
use crate::soil::SlopeStability;
use crate::studies::random;
use crate::vehicle::{Rover, roll_and_pitch};

/// The nose is set to this [rad], each heading within it being as likely, and falls by this much
/// before it is set again: 2°. Source: ours; about what a driver reads off an instrument that shows
/// whole degrees.
pub const HEADING_ERROR: f64 = 2.0 * std::f64::consts::PI / 180.0;

/// The heading is set again after this way at the latest [m]. Source: ours.
const LONGEST_LEG: f64 = 10.0;

/// Where the heading had to be set again after less nobody can hold it [m]: no such slope is to be
/// driven. Source: ours; a driver who stops as often does not get ahead.
pub const SHORTEST_LEG: f64 = 0.1;

/// The way that the drift of the card is over [m]. Source: ours; some ten lengths of a small rover.
pub const DRIFT_WAY: f64 = 10.0;

/// A slope, driven as the card says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Heading that is set at the start of every leg, *γ* [rad], positive uphill.
    pub yaw: f64,
    /// Roll that instruments show then [rad], positive with the uphill side higher.
    pub roll: f64,
    /// Pitch that they show [rad], positive with the nose higher.
    pub pitch: f64,
    /// Pitch with the nose too low and too high by [`HEADING_ERROR`] [rad].
    pub pitch_range: [f64; 2],
    /// The motion by it, if the rover moves on any of the samples.
    pub motion: Option<DrivenMotion>,
    /// By how much the slope could be steeper before the rover tips over, at rest [rad].
    pub tipping_margin: f64,
}

/// The motion by the card's heading, over the samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrivenMotion {
    /// After how much way the heading is to be set again [m]; `None` for a rover that holds it by
    /// itself.
    pub correct_every: Option<f64>,
    /// By how much the nose falls over the way [rad/m], positive downhill, over the samples that
    /// move; `None` where the rover holds it.
    pub heading_fall: Option<Band>,
    /// Drift, way off the course and downhill for a metre travelled [-], over all samples: 1 where
    /// the rover is stuck.
    pub drift: Option<Band>,
    /// Mean slip ratio of the wheels [-], over all samples: 1 where the rover is stuck.
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m], over the samples that move.
    pub sinkage: Option<Band>,
    /// Largest torque of a wheel [N·m], likewise.
    pub torque: Option<Band>,
    /// Largest current of a motor [A], driving or braking, likewise; of a rover whose motors are
    /// known.
    pub current: Option<Band>,
    /// Way of the rims for a metre of ground [-], likewise.
    pub rim_way: Option<Band>,
    /// Samples in which the rover is stuck: it has no steady motion, or its wheels all but spin.
    pub stuck: Probability,
    /// Samples in which the ground slides by itself, or the rover off its course faster than its
    /// rims turn.
    pub slides: Probability,
    /// Where to stop and look at the slip.
    pub slip_check: SlipCheck,
}

impl Driven {
    /// What does not depend on the soil.
    pub(in super::super) fn at_rest(study: &HeadingStudy, slope: f64, yaw: f64) -> Self {
        let [roll, pitch] = roll_and_pitch(slope, yaw);
        let pitch_range = [-HEADING_ERROR, HEADING_ERROR].map(|error| {
            let [_, pitch] = roll_and_pitch(slope, yaw + error);
            pitch
        });
        let tipping_margin = study.tipping_slope(yaw) - slope;
        Self { yaw, roll, pitch, pitch_range, motion: None, tipping_margin }
    }
}

impl DrivenMotion {
    /// The same with corrections and looks at the slip at least as often as on a gentler slope:
    /// where samples get stuck, those that are left may seem to need fewer.
    pub(in super::super) fn no_laxer_than(mut self, gentler: Option<&Self>) -> Self {
        if let Some(gentler) = gentler {
            let corrections = self.correct_every.zip(gentler.correct_every);
            self.correct_every = corrections.map(|(one, other)| one.min(other));
            let looks = self.slip_check.every.zip(gentler.slip_check.every);
            self.slip_check.every = looks.map(|(one, other)| one.min(other));
        }
        self
    }

    /// Drives all samples on a slope by a heading; `None` if the rover is stuck in each of them, or
    /// its nose falls too fast to be held.
    ///
    /// * `holds_heading`: whether the rover keeps its nose by itself
    /// * `samples`: of soil and model, one at least, and whether each holds the course
    /// * `slip_limit`: above which the driver turns back at a look [-]
    pub(super) fn of(
        study: &HeadingStudy,
        (rim_speed, holds_heading): (f64, bool),
        (samples, held): (&[Sample], &[Holding]),
        (slope, course, yaw): (f64, f64, f64),
        slip_limit: f64,
    ) -> Option<Self> {
        let rims = vec![rim_speed; study.rover.wheel_count()];
        let moves =
            |motion: SteadyMotion| (motion.slip_ratio().abs() <= MOST_SLIP).then_some(motion);
        // The forces on a rover change little with its nose a few degrees off: it goes at about the
        // velocity at which the sample's own heading holds the course.
        let knows_crab = study.steering == Steering::None;
        let motions = outputs_of_places(samples, &|| true, |place| {
            let study = study.of_sample(&samples[place]);
            let near = held[place].velocity(course, rim_speed).filter(|_| knows_crab);
            let seeking = Seeking { near, is_held: holds_heading };
            moves(study.motion_sought(slope, yaw, &rims, seeking).ok()?)
        });
        let motions: Vec<Option<SteadyMotion>> = motions.unwrap_or_default();
        let moving = || motions.iter().flatten();
        let fastest = Band::of(moving().map(|it| it.turning().abs()))?.high;
        let correct_every = drivable(HEADING_ERROR / fastest.max(HEADING_ERROR / LONGEST_LEG))?;
        let places: Vec<usize> = (0..samples.len()).collect();
        let drift = outputs(&places, |place| {
            let place = *place;
            let motion = motions[place].as_ref()?;
            let error = mean_error(place, samples.len(), settings(correct_every));
            let mean = yaw + error + 0.5 * motion.turning() * correct_every;
            let study = study.of_sample(&samples[place]);
            let motion = study.steady_motion_near(motion, slope, mean, rim_speed).ok()?;
            Some(sin(course - moves(motion)?.course()))
        });
        let slides = |(sample, motion): (&Sample, &Option<SteadyMotion>)| {
            let own = SlopeStability { factor_of_safety: 1.0, ..study.stability };
            let off = |it: &SteadyMotion| sin(course - it.course()) * it.speed() > rim_speed;
            slope > sample.soil.stable_slope(study.gravity, own) || motion.as_ref().is_some_and(off)
        };
        let slides = samples.iter().zip(&motions).filter(|it| slides(*it)).count();
        let slip = |it: &Option<SteadyMotion>| it.as_ref().map_or(STUCK, SteadyMotion::slip_ratio);
        let slips: Vec<f64> = motions.iter().map(slip).collect();
        let stuck = motions.iter().filter(|it| it.is_none()).count();
        let falls = moving().map(|it| -it.turning());
        Some(Self {
            correct_every: (!holds_heading).then_some(correct_every),
            heading_fall: if holds_heading { None } else { Band::of(falls) },
            drift: Band::of(drift.into_iter().map(|it| it.unwrap_or(STRAIGHT_DOWN))),
            slip_check: SlipCheck::of(&slips, slip_limit),
            slip_ratio: Band::of(slips),
            sinkage: Band::of(moving().map(mean_sinkage)),
            torque: Band::of(moving().map(largest_torque)),
            current: Band::of(moving().filter_map(|it| largest_current(&study.rover, it, &rims))),
            rim_way: Band::of(moving().map(|it| rim_speed / it.speed())),
            stuck: Probability { successes: stuck, trials: samples.len() },
            slides: Probability { successes: slides, trials: samples.len() },
        })
    }
}

/// Mean sinkage of the wheels [m].
fn mean_sinkage(motion: &SteadyMotion) -> f64 {
    let sum: f64 = motion.wheels.iter().map(|wheel| wheel.settled.sinkage).sum();
    sum / motion.wheels.len() as f64
}

/// Torque of the wheel that has most [N·m].
pub(in super::super) fn largest_torque(motion: &SteadyMotion) -> f64 {
    motion.wheels.iter().map(|wheel| wheel.settled.forces.torque.abs()).fold(0.0, f64::max)
}

/// Current of the motor that takes most [A], driving or braking, where motors are known.
///
/// * `rim_speeds`: [m/s]
pub(in super::super) fn largest_current(
    rover: &Rover,
    motion: &SteadyMotion,
    rim_speeds: &[f64],
) -> Option<f64> {
    let each = rover.mounts().iter().zip(&motion.wheels).zip(rover.wheel_speeds(rim_speeds));
    let current = each.filter_map(|((mount, wheel), speed)| {
        Some(electrical(mount, wheel.settled.forces.torque, speed)?.current.abs())
    });
    current.reduce(f64::max)
}

/// A way that a driver can keep to, at most as long as this one [m]: with one digit, or halves
/// above 1 m; `None` where it is too short.
fn drivable(way: f64) -> Option<f64> {
    let step = if way >= 1.0 { 0.5 } else { 0.1 };
    // 0.3 over 0.1 is less than 3.
    let steps = (way / step + 1e-9).floor();
    (steps * step >= SHORTEST_LEG).then_some(steps * step)
}

/// How often the nose is set over [`DRIFT_WAY`].
///
/// * `leg`: way between two settings [m]
pub(in super::super) fn settings(leg: f64) -> usize {
    /// Legs are not shorter.
    const MOST: u32 = 1000;
    let enough = |legs: &u32| f64::from(*legs) * leg >= DRIFT_WAY - 1e-9;
    (1..MOST).find(enough).unwrap_or(MOST) as usize
}

/// By how much a driver who sets the nose misses the heading [rad].
pub(in super::super) fn heading_error(random: &mut ChaCha8Rng) -> f64 {
    HEADING_ERROR * (2.0 * random::uniform(random) - 1.0)
}

/// The mean error of the headings that are set over the way [rad], by the driver of one sample;
/// none where there is one sample alone, and no band.
fn mean_error(place: usize, samples: usize, settings: usize) -> f64 {
    /// Seed of a driver's errors: no soil is drawn from it.
    const SEED: u64 = 0x0D12_17E5;
    if samples == 1 {
        return 0.0;
    }
    let mut random = random::generator(SEED, place as u64);
    let sum: f64 = (0..settings).map(|_| heading_error(&mut random)).sum();
    sum / settings as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_rounded_down_to_what_can_be_driven() {
        for (way, expected) in [(0.349, 0.3), (0.3, 0.3), (0.199, 0.1), (1.49, 1.0), (7.9, 7.5)] {
            let found = drivable(way).expect("it is long enough");
            assert!((found - expected).abs() < 1e-12, "{way}");
        }
        assert_eq!(drivable(0.099), None);
    }

    #[test]
    fn the_nose_is_set_at_the_start_of_every_leg() {
        for (leg, expected) in [(10.0, 1), (6.0, 2), (0.3, 34), (0.1, 100), (20.0, 1)] {
            assert_eq!(settings(leg), expected, "{leg}");
        }
    }

    /// The errors of one setting spread over all of ±2°, those of a hundred cancel to a tenth.
    #[test]
    fn a_drivers_errors_cancel_over_the_way() {
        let spread = |settings: usize| {
            let all = (0..400).map(|place| mean_error(place, 400, settings).powi(2));
            (all.sum::<f64>() / 400.0).sqrt() / HEADING_ERROR
        };
        let expected = 1.0 / 3.0_f64.sqrt();
        assert!((spread(1) - expected).abs() < 0.05 * expected, "{}", spread(1));
        assert!((spread(100) - 0.1 * expected).abs() < 0.01 * expected, "{}", spread(100));
        assert_eq!(mean_error(0, 1, 3), 0.0);
    }
}
