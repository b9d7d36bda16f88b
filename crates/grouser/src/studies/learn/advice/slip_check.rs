//! How often to stop and look at the slip, and at which slip to go no further.
//!
//! Between two looks the rover drives blind over a way of its rims. A look compares the ground that
//! odometry saw since the last one with the rims' way,
//!
//! ```text
//! ŝ = 1 − (1 − s_m)(1 + q z)        z standard normal
//! ```
//!
//! with the mean slip s_m over the interval and odometry's relative error q, and ends the drive
//! where ŝ is above the limit. The rover gets stuck where there is no steady motion, or its wheels
//! slip by more than [`MOST_SLIP`](crate::simulation::MOST_SLIP), before a look has ended the
//! drive. The soil along each of many ways is a [`SoilWay`]; all intervals and limits are judged on
//! the same ways.

use super::super::bank::Bank;
use super::super::settings::LearnSettings;
use super::course::{moving, slip_of};
use super::soil_ahead::{SoilAhead, SoilWay};
use crate::simulation::MOST_SLIP;
use crate::studies::ensemble::samples::Sample;
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
    /// Ways that are simulated. Without a stuck rover among 1000 the probability is known to be
    /// below 0.4 %.
    pub ways: u32,
}

impl CheckSettings {
    /// Source: ours; odometry of 2 % is that of missions' sensors.
    pub const USUAL: Self = Self {
        stuck_probability: 0.01,
        false_stops: 0.05,
        odometry_error: 0.02,
        soil: SoilAhead::USUAL,
        ways: 1000,
    };
}

/// The way of the rims that is looked ahead [m]: that over which cards have their drift.
pub const WAY_AHEAD: f64 = 10.0;

/// Ways of the rims between two looks that are tried [m], in steps of [`STEP`]. Source: as cards',
/// the longest by the practice of Opportunity's drivers.
const INTERVALS: [(f64, usize); 4] = [(5.0, 10), (2.0, 4), (1.0, 2), (0.5, 1)];
/// Way of the rims between two places whose slip is computed [m].
const STEP: f64 = 0.5;
/// How many there are.
const STEPS: usize = 20;
/// Limits of slip that are tried, in steps of a twentieth.
const LIMITS: std::ops::RangeInclusive<u8> = 1..=17;
/// So many steps are a slip of 1.
const LIMIT_STEPS: f64 = 20.0;
/// The practice of Opportunity's drivers: every 5 m, 40 %.
const PRACTICE: (usize, f64) = (10, 0.4);

/// How often to look at the slip on a slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckAdvice {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// The check that is advised; `None` where none of those that are tried is known to be safe
    /// enough.
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
    /// Ways that a look ends, of those on which the rover would not have got stuck; `None` where
    /// there are none.
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

impl CheckAdvice {
    /// * `course`: slope and yaw [rad]
    /// * `seed`: of the soils at the start, as [`Learner::samples`](super::super::Learner::samples)
    ///   has it
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
        let ways = outputs_while(0..u64::from(settings.ways), go_on, |index| {
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
        let lowest = f64::from(*LIMITS.start()) / LIMIT_STEPS;
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

/// The lowest limit that ends no more ways than it may: among these fewest get stuck with it.
/// `None` where each ends too many.
fn best_limit(ways: &[SlipWay], interval: (f64, usize), settings: &CheckSettings) -> Option<Check> {
    let limits = LIMITS.map(|step| f64::from(step) / LIMIT_STEPS);
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

/// Whether slip between two places some steps apart needs no closer look: it is far from where it
/// runs away.
fn is_calm(first: f64, last: f64) -> bool {
    const LIGHT: f64 = 0.4;
    const CHANGE: f64 = 0.1;
    first.max(last) < LIGHT && (last - first).abs() < CHANGE
}

impl SlipWay {
    /// Drives a way on a course. Where the slip is light and hardly changes over a few places, it
    /// is a line between them.
    fn driven(
        study: &HeadingStudy,
        soil: &mut SoilWay<'_>,
        (course, rim_speed): ((f64, f64), f64),
        (seed, index): (u64, u64),
    ) -> Result<Self, NothingAccepted> {
        /// Mask of the seed for odometry's errors: no soil is drawn from it.
        const ERRORS: u64 = 0x0D0E_7A11;
        /// Places that are taken together.
        const BLOCK: usize = 5;
        let mut random = random::generator(seed ^ ERRORS, index);
        let errors = (0..STEPS).map(|_| random::standard_normal(&mut random)).collect();
        let mut motion = None;
        let mut slip = |sample: &Sample| {
            motion = moving(&study.of_sample(sample), course, rim_speed, motion.as_ref());
            slip_of(motion.as_ref())
        };
        let mut slips = vec![slip(soil.sample())];
        while let Some(first) = slips.last().copied().filter(|it| *it <= MOST_SLIP)
            && slips.len() < STEPS
        {
            let count = BLOCK.min(STEPS - slips.len());
            let mut samples = Vec::new();
            for _ in 0..count {
                soil.advance((1.0 - first).max(0.0) * STEP)?;
                samples.push(soil.sample().clone());
            }
            let last = slip(&samples[count - 1]);
            if is_calm(first, last) {
                let share = |place: usize| (place + 1) as f64 / count as f64;
                slips.extend((0..count).map(|place| first + share(place) * (last - first)));
            } else {
                slips.extend(samples[..count - 1].iter().map(&mut slip));
                slips.push(last);
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: CheckSettings = CheckSettings { odometry_error: 0.0, ..CheckSettings::USUAL };

    fn way(slips: &[f64]) -> SlipWay {
        SlipWay { slips: slips.to_vec(), errors: vec![0.0; slips.len()] }
    }

    #[test]
    fn intervals_are_whole_steps_of_the_way() {
        assert!((STEPS as f64 * STEP - WAY_AHEAD).abs() < 1e-12);
        assert!(INTERVALS.iter().all(|(way, steps)| (*steps as f64 * STEP - way).abs() < 1e-12));
    }

    /// A look stops a rover whose slip rises in time, a later one does not; a slip that comes at
    /// once no look catches.
    #[test]
    fn a_look_in_time_stops_the_rover() {
        let rising = way(&[0.1, 0.2, 0.5, 0.8, 1.0]);
        assert_eq!(rising.end(1, 0.4, 0.0), End::Stopped);
        // The mean over two steps is 0.15, then 0.65.
        assert_eq!(rising.end(2, 0.4, 0.0), End::Stopped);
        assert_eq!(rising.end(4, 0.3, 0.0), End::Stopped);
        assert_eq!(rising.end(10, 0.4, 0.0), End::Stuck);
        assert_eq!(rising.end(1, 0.85, 0.0), End::Stuck);
        assert_eq!(way(&[0.1, 0.1, 1.0]).end(1, 0.4, 0.0), End::Stuck);
        assert_eq!(way(&[0.1; STEPS]).end(10, 0.4, 0.0), End::Driven);
        // Odometry that has the ground 2 % shorter.
        let short = SlipWay { slips: vec![0.39], errors: vec![-1.0] };
        assert_eq!(short.end(1, 0.4, 0.02), End::Stopped);
    }

    /// Ways on which nobody gets stuck are looked at as rarely as may be, at the lowest limit that
    /// ends none of them; where none may get stuck at all no look is safe enough.
    #[test]
    fn ways_without_a_stuck_rover_need_few_looks() {
        let ways: Vec<SlipWay> = (0..1000).map(|_| way(&[0.22; STEPS])).collect();
        let found = CheckAdvice::of(&ways, 0.1, &SETTINGS);
        let check = found.check.expect("a check");
        assert_eq!((check.every, check.stuck.successes), (5.0, 0));
        assert!((check.limit - 0.25).abs() < 1e-12);
        let never = CheckSettings { stuck_probability: 0.0, ..SETTINGS };
        assert_eq!(CheckAdvice::of(&ways, 0.1, &never).check, None);
    }

    /// Slip that rises over two metres: looks every five metres miss it, every metre they do not.
    #[test]
    fn quick_rises_need_frequent_looks() {
        let mut rising = vec![0.1; 13];
        rising.extend([0.3, 0.5, 0.7, 1.0]);
        let ways: Vec<SlipWay> = (0..1000)
            .map(|place| if place < 50 { way(&rising) } else { way(&[0.1; STEPS]) })
            .collect();
        let found = CheckAdvice::of(&ways, 0.2, &SETTINGS);
        assert_eq!(found.unchecked.successes, 50);
        assert_eq!(found.practice.stuck.successes, 50);
        let check = found.check.expect("a check");
        assert!(check.every < 5.0 && check.stuck.successes == 0, "{check:?}");
        let lax = CheckSettings { stuck_probability: 0.1, ..SETTINGS };
        assert_eq!(CheckAdvice::of(&ways, 0.2, &lax).check.map(|it| it.every), Some(5.0));
    }
}
