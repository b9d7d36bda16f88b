//! How often to stop and look at the slip, and at which slip to go no further.
//!
//! Between two looks the rover drives blind over a way of its rims. A look compares the ground that odometry saw since the
//! last one with the rims' way,
//!
//! ```text
//! ŝ = 1 − (1 − s̄)(1 + q z)        z standard normal
//! ```
//!
//! with the mean slip s̄ over the interval and odometry's relative error q, and ends the drive where ŝ is above the limit.
//! The rover gets stuck where there is no steady motion, or its wheels slip by more than
//! [`MOST_SLIP`](crate::simulation::MOST_SLIP), before a look has ended the drive. The soil along each of many ways is a
//! [`SoilWay`]; all intervals and limits are judged on the same ways.

use super::super::bank::Bank;
use super::super::settings::LearnSettings;
use super::course::{moving, slip_of};
use super::soil_ahead::{SoilAhead, SoilWay};
use crate::simulation::MOST_SLIP;
use crate::studies::ensemble::{Probability, outputs_while};
use crate::studies::heading::HeadingStudy;
use crate::studies::random;
use grouser_io::statistics::NothingAccepted;

/// How slip is checked, and what may go wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckSettings {
    /// The rover may get stuck on this share of the ways of [`WAY_AHEAD`] [-].
    pub stuck_probability: f64,
    /// A look may end this share of the ways on which the rover would not have got stuck [-].
    pub false_stops: f64,
    /// Error of odometry over the way since the last look, over that way, *q* [-].
    pub odometry_error: f64,
    /// The soil ahead.
    pub soil: SoilAhead,
}

impl CheckSettings {
    /// Source: ours; odometry of 2 % is that of missions' sensors.
    pub const USUAL: Self = Self {
        stuck_probability: 0.01,
        false_stops: 0.05,
        odometry_error: 0.02,
        soil: SoilAhead::USUAL,
    };
}

/// The way of the rims that is looked ahead [m]: that over which cards have their drift.
pub const WAY_AHEAD: f64 = 10.0;

/// Ways of the rims between two looks that are tried [m], in steps of [`STEP`]. Source: as cards', the longest by the
/// practice of Opportunity's drivers.
const INTERVALS: [(f64, usize); 4] = [(5.0, 10), (2.0, 4), (1.0, 2), (0.5, 1)];
/// Way of the rims between two places whose slip is computed [m].
const STEP: f64 = 0.5;
/// How many there are.
const STEPS: usize = 20;
/// Limits of slip that are tried [%].
const LIMITS: std::ops::RangeInclusive<u8> = 1..=17;
/// Between two of them [-].
const LIMIT_STEP: f64 = 0.05;
/// The practice of Opportunity's drivers: every 5 m, 40 %.
const PRACTICE: (usize, f64) = (10, 0.4);

/// How often to look at the slip on a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckAdvice {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The check that is advised; `None` where none of those that are tried is known to be safe enough.
    pub check: Option<Check>,
    /// Ways on which a rover gets stuck that nobody looks after.
    pub unchecked: Probability,
    /// Looks every 5 m against a limit of 40 %, as Opportunity's drivers had it.
    pub practice: Check,
    /// The shortest interval that is tried.
    pub closest: Check,
}

/// Looks at the slip, and what they come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Check {
    /// Way of the rims between two looks [m].
    pub every: f64,
    /// The slip ratio above which to go no further [-].
    pub limit: f64,
    /// Ways on which the rover gets stuck all the same.
    pub stuck: Probability,
    /// Ways that a look ends, of those on which the rover would not have got stuck; `None` where there are none.
    pub false_stops: Option<Probability>,
}

/// What becomes of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    Driven,
    Stopped,
    Stuck,
}

/// The slip along a way, place by place, until the rover is stuck; and odometry's errors.
struct SlipWay {
    slips: Vec<f64>,
    errors: Vec<f64>,
}

/// How many ways are needed.
fn count(stuck_probability: f64) -> u64 {
    /// Without a stuck rover among so many over the probability, its confidence interval is half of what is asked for.
    const ENOUGH: f64 = 8.0;
    const LEAST: f64 = 1000.0;
    const MOST: f64 = 10_000.0;
    (ENOUGH / stuck_probability.max(f64::MIN_POSITIVE)).clamp(LEAST, MOST) as u64
}

impl CheckAdvice {
    /// * `course`: slope and yaw [rad]
    /// * `seed`: of the soils at the start, as [`Learner::samples`](super::super::Learner::samples) has it
    /// * `go_on`: asked before each way; `None` if it was false
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub(super) fn on_course(
        study: &HeadingStudy,
        belief: (&Bank, &LearnSettings),
        (course, rim_speed): ((f64, f64), f64),
        (settings, seed): (&CheckSettings, u64),
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, NothingAccepted> {
        let ways = outputs_while(0..count(settings.stuck_probability), go_on, |index| {
            let mut soil = SoilWay::new(belief, settings.soil, (seed, index))?;
            SlipWay::driven(study, &mut soil, (course, rim_speed), (seed, index))
        });
        let Some(ways) = ways else { return Ok(None) };
        let ways: Vec<SlipWay> = ways.into_iter().collect::<Result<_, _>>()?;
        Ok(Some(Self::of(&ways, course.0, settings)))
    }

    fn of(ways: &[SlipWay], slope: f64, settings: &CheckSettings) -> Self {
        let error = settings.odometry_error;
        let judged = INTERVALS.map(|interval| best_limit(ways, interval, settings));
        let is_safe = |check: &&Check| {
            let (_, most) = check.stuck.interval();
            // The end of a confidence interval, not the share: none in a thousand is not yet never.
            most <= settings.stuck_probability
        };
        let check = judged.iter().flatten().find(is_safe).copied();
        let [.., shortest] = INTERVALS;
        let [.., closest] = judged;
        let lowest = LIMIT_STEP * f64::from(*LIMITS.start());
        let stuck = ways.iter().filter(|way| way.is_stuck()).count();
        Self {
            slope,
            check,
            unchecked: Probability { successes: stuck, trials: ways.len() },
            practice: Check::of(ways, (PRACTICE.0 as f64 * STEP, PRACTICE.0), PRACTICE.1, error),
            closest: closest.unwrap_or_else(|| Check::of(ways, shortest, lowest, error)),
        }
    }
}

/// The lowest limit that ends no more ways than it may: among these fewest get stuck with it. `None` where each ends too
/// many.
fn best_limit(ways: &[SlipWay], interval: (f64, usize), settings: &CheckSettings) -> Option<Check> {
    let limits = LIMITS.map(|step| LIMIT_STEP * f64::from(step));
    limits
        .map(|limit| Check::of(ways, interval, limit, settings.odometry_error))
        .find(|it| it.false_stops.is_none_or(|it| it.estimate() <= settings.false_stops))
}

impl Check {
    fn of(ways: &[SlipWay], (every, steps): (f64, usize), limit: f64, error: f64) -> Self {
        let (mut stuck, mut stopped, mut free) = (0, 0, 0);
        for way in ways {
            let end = way.end(steps, limit, error);
            stuck += usize::from(end == End::Stuck);
            if !way.is_stuck() {
                free += 1;
                stopped += usize::from(end == End::Stopped);
            }
        }
        let false_stops = Probability { successes: stopped, trials: free };
        Self {
            every,
            limit,
            stuck: Probability { successes: stuck, trials: ways.len() },
            false_stops: (free > 0).then_some(false_stops),
        }
    }
}

impl SlipWay {
    /// Drives a way on a course, place by place.
    fn driven(
        study: &HeadingStudy,
        soil: &mut SoilWay<'_>,
        (course, rim_speed): ((f64, f64), f64),
        (seed, index): (u64, u64),
    ) -> Result<Self, NothingAccepted> {
        /// Of odometry's errors: no soil is drawn from it.
        const ERRORS: u64 = 0x0D0E_7A11;
        let mut random = random::generator(seed ^ ERRORS, index);
        let (mut slips, mut errors) = (Vec::new(), Vec::new());
        let mut motion = None;
        for _ in 0..STEPS {
            let here = study.of_sample(soil.sample());
            motion = moving(&here, course, rim_speed, motion.as_ref());
            let slip = slip_of(&motion);
            slips.push(slip);
            errors.push(random::standard_normal(&mut random));
            if motion.is_none() {
                break;
            }
            soil.advance((1.0 - slip).max(0.0) * STEP)?;
        }
        Ok(Self { slips, errors })
    }

    fn is_stuck(&self) -> bool {
        self.slips.iter().any(|slip| *slip > MOST_SLIP)
    }

    /// What becomes of it with looks every so many steps.
    fn end(&self, steps: usize, limit: f64, error: f64) -> End {
        for (interval, errors) in self.slips.chunks(steps).zip(self.errors.chunks(steps)) {
            if interval.iter().any(|slip| *slip > MOST_SLIP) {
                return End::Stuck;
            }
            let mean = interval.iter().sum::<f64>() / interval.len() as f64;
            let seen = 1.0 - (1.0 - mean) * (1.0 + error * errors[0]);
            if interval.len() == steps && seen > limit {
                return End::Stopped;
            }
        }
        End::Driven
    }
}
