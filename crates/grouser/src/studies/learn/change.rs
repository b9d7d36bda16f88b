//! Whether the soil has become another: the last stretches beside what was believed before them.
//!
//! Over the last decimetres, up to a metre, what was read lies off what was expected by *r*, of
//! which a part is the same all along a patch of the ground, and a part each stretch's own:
//!
//! ```text
//! S = J P Jᵀ + U / patches + R / stretches        S' = J Jᵀ + U / patches + R / stretches
//! strangeness = ln N(r; S') − ln N(r; S)
//! ```
//!
//! with the covariance P of what was believed before these stretches, and 1 of what is believed of
//! a soil of which nothing is known. If the soil is what it was, exp(strangeness) is 1 on the mean,
//! so that more than [`CHANGED`] has a probability below exp(−[`CHANGED`]). Stretches count by
//! their median: a single one is no soil.

use std::collections::VecDeque;

use nalgebra::{DMatrix, DVector};

use super::archive::{Archive, items};
use super::gaussian::log_density;
use super::passed::Passed;

/// The last stretches.
#[derive(Clone, Debug, Default)]
pub(super) struct SoilChange {
    passed: VecDeque<Passed>,
    /// The filter that they were expected by.
    filter: u64,
}

/// Strangeness at which the soil counts as another: on the same soil a half metre has it with a
/// probability below 1 to 22,000.
const CHANGED: f64 = 10.0;
/// The fewest stretches in a row that are taken for another soil.
const LEAST: usize = 3;
/// The rims' way over which they do, at most [m].
const LONGEST: f64 = 1.05;
/// By so much the motion has to differ from what was expected, over the fastest rim's speed [-]:
/// what differs by less is learnt, and no reason to warn.
const MATERIAL: f64 = 0.05;

impl SoilChange {
    /// Whether the soil has just been found to be another.
    ///
    /// * `filter`: the number of the filter that expected it
    /// * `patch`: the way over which what no soil explains is the same [m]
    pub(super) fn look(&mut self, filter: u64, passed: Passed, patch: f64) -> bool {
        if filter != self.filter {
            self.filter = filter;
            self.passed.clear();
        }
        self.passed.push_back(passed);
        while self.way_of(self.passed.len()) > LONGEST {
            self.passed.pop_front();
        }
        let longest = self.passed.len();
        let is_another = (LEAST..=longest).any(|count| self.is_strange(count, patch) == Some(true));
        if is_another {
            self.passed.clear();
        }
        is_another
    }

    fn way_of(&self, last: usize) -> f64 {
        self.passed.iter().rev().take(last).map(|it| it.way).sum()
    }

    /// Whether the last stretches are another soil's; `None` where nothing can be said.
    fn is_strange(&self, count: usize, patch: f64) -> Option<bool> {
        let last = || self.passed.iter().skip(self.passed.len() - count);
        let before = &last().next()?.belief;
        let in_all = |reading: &&u64| last().all(|it| it.readings.contains(reading));
        let readings: Vec<u64> = last().next()?.readings.iter().filter(in_all).copied().collect();
        let each: Vec<Passed> = last().map(|it| it.with(&readings)).collect();
        let off: Vec<DVector<f64>> =
            each.iter().map(|it| &it.seen - &it.jacobian * &before.mean).collect();
        let median = DVector::from_fn(readings.len(), |row, _| {
            let mut values: Vec<f64> = off.iter().map(|it| it[row]).collect();
            values.sort_by(f64::total_cmp);
            grouser_io::statistics::quantile(&values, 0.5).unwrap_or(0.0)
        });
        if median.iter().take(2).all(|it| it.abs() < MATERIAL) {
            return Some(false);
        }
        /// Variance of a median over that of a mean, π/2 [-].
        const OF_MEDIAN: f64 = std::f64::consts::FRAC_PI_2;
        let stretches = count as f64;
        let patches = (self.way_of(count) / patch).max(1.0);
        let jacobian = each.iter().map(|it| &it.jacobian).sum::<DMatrix<f64>>() / stretches;
        let of_patch = each.iter().map(|it| &it.of_patch).sum::<DMatrix<f64>>() / stretches;
        let own = each.iter().map(|it| &it.own).sum::<DVector<f64>>() / stretches;
        let noise = of_patch / patches + DMatrix::from_diagonal(&own) * (OF_MEDIAN / stretches);
        let known = &jacobian * &before.covariance * jacobian.transpose() + &noise;
        let unknown = &jacobian * jacobian.transpose() + noise;
        Some(log_density(&median, unknown)? - log_density(&median, known)? > CHANGED)
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { passed, filter } = self;
        archive.count("filter", filter);
        let mut of_passed: Vec<Passed> = passed.drain(..).collect();
        items(archive, "passed", &mut of_passed, Passed::blank, Passed::walk);
        passed.extend(of_passed);
    }

    /// Whether what it has kept fits together, and goes with the unknowns of its filter.
    ///
    /// * `unknowns`: how many a filter has; `None` of one that is not there
    pub(super) fn is_whole(&self, unknowns: impl Fn(u64) -> Option<usize>) -> bool {
        let count = unknowns(self.filter);
        count.is_some_and(|count| self.passed.iter().all(|it| it.is_whole(count)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::gaussian::Gaussian;
    use super::*;
    use crate::studies::random;

    const PATCH: f64 = 0.5;
    /// Standard deviations of what is believed, of a patch, and of a stretch's own readings.
    const BELIEVED: f64 = 0.02;
    const OF_PATCH: f64 = 0.03;
    const OWN: f64 = 0.01;

    /// A decimetre on which the way along the body is off what was expected; that to the side and
    /// the turn are not.
    fn passed(off: f64) -> Passed {
        let mut belief = Gaussian::standard(1);
        belief.covariance *= BELIEVED * BELIEVED;
        Passed {
            way: 0.1,
            belief,
            readings: vec![0, 1, 2],
            seen: DVector::from_row_slice(&[off, 0.0, 0.0]),
            jacobian: DMatrix::from_row_slice(3, 1, &[1.0, 0.0, 0.0]),
            of_patch: DMatrix::identity(3, 3) * (OF_PATCH * OF_PATCH),
            own: DVector::from_element(3, OWN * OWN),
        }
    }

    fn flags(offs: &[f64]) -> Vec<bool> {
        let mut change = SoilChange::default();
        offs.iter().map(|off| change.look(0, passed(*off), PATCH)).collect()
    }

    #[test]
    fn three_strange_stretches_are_another_soil_and_one_is_none() {
        assert_eq!(flags(&[0.0, 0.3, 0.3, 0.3]), [false, false, true, false]);
        assert_eq!(flags(&[0.0, 0.0, 0.9, 0.0, 0.0]), [false; 5]);
        assert!(flags(&[-0.3, -0.3, -0.3])[2]);
    }

    #[test]
    fn another_filter_begins_anew() {
        let mut change = SoilChange::default();
        let mut look = |filter| change.look(filter, passed(0.3), PATCH);
        assert_eq!(
            [look(0), look(0), look(1), look(1), look(1)],
            [false, false, false, false, true]
        );
    }

    /// Over 5000 patches of the same soil, whatever it is within what is believed: none is flagged,
    /// where the bound is one in 22,000. A change by eight deviations of all that is uncertain is
    /// flagged within a patch, nearly every time.
    #[test]
    fn noise_is_no_change_and_a_change_is_no_noise() {
        let mut random = random::generator(8, 2);
        let mut normal = |deviation: f64| deviation * random::standard_normal(&mut random);
        let (mut alarms, mut found) = (0, 0);
        for _ in 0..2500 {
            let soil = normal(BELIEVED);
            let mut patch = |change: f64| {
                let patch = normal(OF_PATCH);
                [0; 5].map(|_| soil + change + patch + normal(OWN))
            };
            alarms += u32::from(flags(&[patch(0.0), patch(0.0)].concat()).contains(&true));
            let size = 8.0 * (BELIEVED.powi(2) + OF_PATCH.powi(2)).sqrt();
            found += u32::from(flags(&[patch(0.0), patch(size)].concat()).contains(&true));
        }
        assert_eq!(alarms, 0);
        assert!(found > 2475, "{found}");
    }
}
