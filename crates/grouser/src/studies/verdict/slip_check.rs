//! Where to stop and look at the slip, and up to which slip to go on.
//!
//! The samples of the card say how much rovers slip on a slope, each on a soil of its own. Here the
//! soil changes on the way: the slip at each place is one of theirs, and places a way x apart have
//! normal scores that are correlated by e^(−x/ℓ). A driver who looks every so many metres, and
//! turns back where the slip is above a limit, gets stuck where it rises beyond
//! [`MOST_SLIP`](crate::simulation::MOST_SLIP) between two looks. The interval is the longest of a
//! few at which that happens on few enough ways.

use std::sync::OnceLock;

use grouser_io::statistics::normal::normal_score;
use rayon::prelude::*;

use super::rule::STUCK_ON_GO;
use crate::elementary::exp;
use crate::simulation::MOST_SLIP;
use crate::studies::ensemble::Band;
use crate::studies::random;

/// No slip above this is passed over at a stop [-]. Source: the practice of Opportunity's drivers,
/// who had slip checked every 5 m against a limit of 40 %.
pub const MOST_CHECKED_SLIP: f64 = 0.4;

/// Way over which the soil changes [m]: ℓ. Source: ours, assumed: no variogram of slip on sand is
/// known to us.
pub const SOIL_LENGTH: f64 = 5.0;

/// The share of the ways of [`DRIFT_WAY`](super::DRIFT_WAY) on which a driver who looks may get
/// stuck [-]: 5 of 1000, as on a go.
pub const STUCK_WITH_CHECKS: f64 = STUCK_ON_GO;

/// Ways between two looks that are tried [m], in steps of the way. Source: ours, the longest by
/// Opportunity's practice.
const INTERVALS: [(f64, usize); 4] = [(5.0, 50), (2.0, 20), (1.0, 10), (0.5, 5)];
/// Way between two places whose slips are drawn [m], and how many there are on a way.
const STEP: f64 = 0.1;
const STEPS: usize = 100;

/// Stops on the way to look at the slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipCheck {
    /// The slip ratio above which to turn back [-].
    pub limit: f64,
    /// Way between two looks [m]; `None` where none of those that are tried is short enough.
    pub every: Option<f64>,
    /// Share of the ways of [`DRIFT_WAY`](super::DRIFT_WAY) on which the rover gets stuck all the
    /// same [-]; without an interval, with the shortest.
    pub stuck: f64,
}

impl SlipCheck {
    /// The slip above which to turn back [-]: what 97.5 % of the samples stay below that hold the
    /// course each by its own heading, 40 % at most. It is no less on a steeper slope.
    ///
    /// * `slips`: of the samples [-], 1 where no heading holds the course
    pub(super) fn limit(slips: impl Iterator<Item = f64>) -> f64 {
        Band::of(slips).map_or(MOST_CHECKED_SLIP, |band| band.high).min(MOST_CHECKED_SLIP)
    }

    /// Way between two looks [m]: the shortest that is tried where none is short enough.
    pub(in crate::studies) fn interval(&self) -> f64 {
        let [.., (shortest, _)] = INTERVALS;
        self.every.unwrap_or(shortest)
    }

    /// The check for a slope.
    ///
    /// * `slips`: of all samples [-], 1 where stuck; one at least
    pub(super) fn of(slips: &[f64], limit: f64) -> Self {
        static WAYS: OnceLock<Ways> = OnceLock::new();
        let mut sorted = slips.to_vec();
        sorted.sort_by(f64::total_cmp);
        let share_within =
            |most: f64| sorted.partition_point(|slip| *slip <= most) as f64 / sorted.len() as f64;
        let (passed, free) = (share_within(limit), share_within(MOST_SLIP));
        if free == 1.0 {
            return Self { limit, every: Some(INTERVALS[0].0), stuck: 0.0 };
        }
        let ways = WAYS.get_or_init(|| Ways::draw(SOIL_LENGTH));
        let mut stuck = 1.0;
        for (interval, steps) in INTERVALS {
            stuck = ways.stuck(steps, passed, free);
            if stuck <= STUCK_WITH_CHECKS {
                return Self { limit, every: Some(interval), stuck };
            }
        }
        Self { limit, every: None, stuck }
    }
}

/// Normal scores of the slip along many ways.
struct Ways(Vec<[f64; STEPS + 1]>);

impl Ways {
    /// * `length`: over which the soil changes [m]
    fn draw(length: f64) -> Self {
        /// Seed of the ways: no soil is drawn from it.
        const SEED: u64 = 0x511D_CEC5;
        const COUNT: u64 = 10_000;
        let kept = exp(-STEP / length);
        let new = (1.0 - kept * kept).sqrt();
        let way = |index: u64| {
            let mut random = random::generator(SEED, index);
            let mut scores = [random::standard_normal(&mut random); STEPS + 1];
            for place in 1..=STEPS {
                scores[place] =
                    kept * scores[place - 1] + new * random::standard_normal(&mut random);
            }
            scores
        };
        Self((0..COUNT).into_par_iter().map(way).collect())
    }

    /// The share of the ways on which a rover gets stuck.
    ///
    /// * `steps`: between two looks
    /// * `passed`, `free`: share of the samples with a slip within the limit, and of those that are
    ///   not stuck [-]
    fn stuck(&self, steps: usize, passed: f64, free: f64) -> f64 {
        let score = |share: f64| match share {
            0.0 => f64::NEG_INFINITY,
            1.0 => f64::INFINITY,
            share => normal_score(share),
        };
        let (most, end) = (score(passed), score(free));
        let is_stuck = |way: &&[f64; STEPS + 1]| {
            for (place, here) in way.iter().enumerate() {
                if place % steps == 0 && *here > most {
                    // He looks before he goes on, and turns back.
                    return false;
                }
                if *here > end {
                    return true;
                }
            }
            false
        };
        self.0.iter().filter(is_stuck).count() as f64 / self.0.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::super::driven::DRIFT_WAY;
    use super::*;

    /// A way is as long as the drift is over.
    #[test]
    fn a_way_has_its_steps() {
        assert!((STEPS as f64 * STEP - DRIFT_WAY).abs() < 1e-12);
        assert!(INTERVALS.iter().all(|(way, steps)| (*steps as f64 * STEP - way).abs() < 1e-12));
    }

    /// Where every place has a soil of its own, a rover that is not looked after is free on each of
    /// them by itself: 1 − (1 − p)^n; who looks at every place never gets stuck, and who looks at
    /// every tenth turns back in time on some.
    #[test]
    fn independent_places_are_free_each_by_itself() {
        let ways = Ways::draw(1e-6);
        let free: f64 = 0.998;
        let never = ways.stuck(STEPS + 1, 1.0, free);
        let expected = 1.0 - free.powi(101);
        // Three standard errors of 10 000 ways.
        assert!((never - expected).abs() < 0.012, "{never} and {expected}");
        assert_eq!(ways.stuck(1, 0.95, free), 0.0);
        let at_times = ways.stuck(10, 0.95, free);
        assert!(at_times > 0.0 && at_times < never);
    }

    /// The more often he looks, and the less slip he passes over, the fewer get stuck; soil that
    /// changes slowly gives him time.
    #[test]
    fn looking_helps() {
        let (slow, quick) = (Ways::draw(SOIL_LENGTH), Ways::draw(1.0));
        let free = 0.97;
        let mut before = 1.0;
        for (_, steps) in INTERVALS {
            let stuck = slow.stuck(steps, 0.9, free);
            assert!(stuck < before && stuck < slow.stuck(steps, 0.96, free));
            assert!(stuck < quick.stuck(steps, 0.9, free));
            before = stuck;
        }
    }

    #[test]
    fn a_slope_on_which_nobody_gets_stuck_is_looked_at_rarely() {
        let slips = [0.1, 0.2, 0.15, 0.3];
        let check = |slips: &[f64]| SlipCheck::of(slips, SlipCheck::limit(slips.iter().copied()));
        let (often, check) = (check, check(&slips));
        assert_eq!((check.every, check.stuck), (Some(5.0), 0.0));
        assert!(check.limit > 0.28 && check.limit <= 0.3);
        let mut worse = vec![0.2; 97];
        worse.extend([1.0; 3]);
        let check = often(&worse);
        // All that he sees is 0.2, until it is 1.
        assert_eq!((check.every, check.limit), (None, MOST_CHECKED_SLIP));
        assert!(check.stuck > STUCK_WITH_CHECKS);
    }
}
