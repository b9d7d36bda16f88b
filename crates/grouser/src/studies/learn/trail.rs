//! The last stretches that were passed, and straight lines through what was seen on them.

use std::collections::VecDeque;
use std::ops::Range;

use super::archive::{Archive, items, named};
use crate::elementary::wide::cos;

/// The last stretches.
#[derive(Clone, Debug, Default)]
pub(super) struct Trail(VecDeque<Past>);

/// What is kept of a stretch.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Past {
    /// When it ended [s].
    pub(super) time: f64,
    /// The rims' way until then, and that over the ground [m].
    pub(super) way: f64,
    pub(super) ground: f64,
    pub(super) slip_ratio: f64,
    /// The slip ratio as −ln(1 − s), and its variance by what no soil explains.
    pub(super) strain: f64,
    pub(super) strain_variance: f64,
    pub(super) slope: f64,
    pub(super) yaw: f64,
    /// By how much the ground was weaker than that at the start, as a force against the way over
    /// the weight [-], and its variance.
    pub(super) weakness: Option<f64>,
    pub(super) weakness_variance: f64,
}

/// A straight line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trend {
    /// What it rises by over a metre of ground.
    pub(super) rise: f64,
    /// The standard error of that.
    error: f64,
    /// Its value at the last stretch.
    pub(super) now: f64,
}

impl Trend {
    /// Whether it rises by more than it could by chance.
    pub(super) fn is_no_chance(&self) -> bool {
        const SURE: f64 = 2.5;
        self.rise > SURE * self.error
    }
}

impl Trail {
    /// Adds a stretch, and drops those that are farther behind it than a way of the rims [m].
    pub(super) fn push(&mut self, past: Past, longest: f64) {
        self.0.push_back(past);
        while self.0.front().is_some_and(|it| it.way < past.way - longest) {
            self.0.pop_front();
        }
    }

    /// The last stretch, or that before it, and so on.
    pub(super) fn back(&self, before: usize) -> Option<&Past> {
        self.0.iter().nth_back(before)
    }

    /// The stretches that the rims passed within a way before the end [m].
    ///
    /// * `within`: how far before it: the last ones are those from 0
    pub(super) fn before(&self, within: Range<f64>) -> impl Iterator<Item = &Past> {
        let end = self.0.back().map_or(0.0, |it| it.way);
        self.0.iter().filter(move |it| within.contains(&(end - it.way)))
    }

    /// Forgets how weak the ground was: what that is measured from is no longer known.
    pub(super) fn forget_weakness(&mut self) {
        self.0.iter_mut().for_each(|it| it.weakness = None);
    }

    /// Speed over the ground on the mean of the last stretches, over a way of the rims [m/s].
    pub(super) fn ground_speed(&self, way: f64) -> f64 {
        match (self.before(0.0..way).next(), self.0.back()) {
            (Some(first), Some(last)) if last.time > first.time => {
                (last.ground - first.ground) / (last.time - first.time)
            }
            _ => 0.0,
        }
    }

    /// A straight line through a number of the last stretches over the way over the ground.
    ///
    /// * `within`: as [`before`](Self::before)
    /// * `of`: the number, and its variance
    pub(super) fn trend(
        &self,
        within: Range<f64>,
        of: impl Fn(&Past) -> Option<(f64, f64)>,
    ) -> Option<Trend> {
        const LEAST: usize = 4;
        let yaw = self.0.back()?.yaw;
        /// A rover that turns has other slips for another reason [rad].
        const TURNS: f64 = 0.25;
        let turns =
            self.before(within.clone()).any(|it| 1.0 - cos(it.yaw - yaw) > 0.5 * TURNS * TURNS);
        let all: Option<Vec<[f64; 3]>> = self
            .before(within.clone())
            .map(|it| of(it).map(|(y, variance)| [it.ground, y, variance]))
            .collect();
        let all = all.filter(|it| it.len() >= LEAST && !turns)?;
        let count = all.len() as f64;
        let mean = |place: usize| all.iter().map(|it| it[place]).sum::<f64>() / count;
        let [x, y, variance] = [0, 1, 2].map(mean);
        let xx: f64 = all.iter().map(|it| (it[0] - x).powi(2)).sum();
        let xy: f64 = all.iter().map(|it| (it[0] - x) * (it[1] - y)).sum();
        if xx <= 0.0 {
            return None;
        }
        let rise = xy / xx;
        let off = |it: &[f64; 3]| (it[1] - y - rise * (it[0] - x)).powi(2);
        let scatter = all.iter().map(off).sum::<f64>() / (count - 2.0);
        let now = y + rise * (self.0.back()?.ground - x);
        Some(Trend { rise, error: (scatter.max(variance) / xx).sqrt(), now })
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let mut all: Vec<Past> = self.0.drain(..).collect();
        items(archive, "stretches", &mut all, Past::default, Past::walk);
        self.0.extend(all);
    }
}

impl Past {
    fn walk(&mut self, archive: &mut dyn Archive) {
        let Self {
            time,
            way,
            ground,
            slip_ratio,
            strain,
            strain_variance,
            slope,
            yaw,
            weakness,
            weakness_variance,
        } = self;
        archive.maybe("weakness", weakness);
        named(archive, [("time", time), ("way", way), ("ground", ground)]);
        named(archive, [("slip_ratio", slip_ratio), ("strain", strain)]);
        named(archive, [("strain_variance", strain_variance), ("slope", slope), ("yaw", yaw)]);
        named(archive, [("weakness_variance", weakness_variance)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::random;

    /// Stretches of a decimetre over which the weakness is a number of each.
    fn trail(count: u32, weakness: impl Fn(u32) -> f64, variance: f64) -> Trail {
        let mut trail = Trail::default();
        for place in 0..count {
            let way = 0.1 * f64::from(place + 1);
            let weakness = Some(weakness(place));
            let past =
                Past { way, ground: way, weakness, weakness_variance: variance, ..Past::default() };
            trail.push(past, 3.0);
        }
        trail
    }

    fn of_weakness(past: &Past) -> Option<(f64, f64)> {
        Some((past.weakness?, past.weakness_variance))
    }

    #[test]
    fn a_straight_line_is_found_with_its_value_at_the_end() {
        let trail = trail(50, |place| 0.3 + 0.02 * f64::from(place), 0.0);
        let found = trail.trend(0.0..1.0, of_weakness).unwrap();
        assert!((found.rise - 0.2).abs() < 1e-12 && (found.now - 1.28).abs() < 1e-12, "{found:?}");
        assert!(trail.before(0.0..9.0).count() < 32, "what is far behind is dropped");
        assert!(trail.trend(0.0..0.25, of_weakness).is_none(), "three stretches are no trend");
    }

    /// About six of a thousand trends of noise alone, whose variance is known, rise by 2.5 standard
    /// errors.
    #[test]
    fn noise_rises_by_chance_as_seldom_as_it_should() {
        let mut random = random::generator(3, 1);
        let mut rises = 0;
        for _ in 0..1000 {
            let noise: Vec<f64> = (0..12).map(|_| random::standard_normal(&mut random)).collect();
            let found = trail(12, |place| noise[place as usize], 1.0).trend(0.0..2.0, of_weakness);
            rises += u32::from(found.unwrap().is_no_chance());
        }
        assert!((1..=14).contains(&rises), "{rises}");
    }

    #[test]
    fn a_rover_that_turns_has_no_trend() {
        let mut trail = trail(20, f64::from, 0.0);
        trail.0[15].yaw = 0.5;
        assert!(trail.trend(0.0..1.0, of_weakness).is_none());
        assert!(trail.trend(0.0..0.35, of_weakness).is_some(), "it has turned before");
    }
}
