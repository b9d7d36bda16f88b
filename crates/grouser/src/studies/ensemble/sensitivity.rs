//! Sobol indices: the shares of an output's variance that each input causes.
//!
//! ```text
//! S_i = V[E(f | x_i)] / V(f)            first order: what goes away on average once x_i is known
//! T_i = E[V(f | x_~i)] / V(f)           total: what is left while x_i alone is unknown
//! ```
//!
//! For inputs that are independent, 0 ≤ S_i ≤ T_i ≤ 1 and Σ S_i ≤ 1; what T_i has more than S_i is
//! interaction. They are estimated from the runs of A, B and A with input *i* of B
//! ([`Matrix`](super::Matrix)):
//!
//! ```text
//! S_i = (1/N) Σ f_B (f_ABi − f_A) / V        (Saltelli et al. 2010, table 2 b)
//! T_i = (1/2N) Σ (f_A − f_ABi)² / V          (Jansen 1999)
//! ```
//!
//! with the mean of f taken away first, which changes no expectation and much of the scatter.
//! Estimates scatter about the indices and may lie just below 0. Intervals are bootstrapped over
//! the points; they take the points for independent and are too wide, never too narrow in practice,
//! for a Sobol design.

use rayon::prelude::*;

use super::design::resampling;
use super::statistics::Estimate;
use crate::studies::random;
use grouser_io::statistics::quantile;

/// The indices of one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SobolIndex {
    /// First order, *S_i* [-].
    pub first: Estimate,
    /// Total, *T_i* [-].
    pub total: Estimate,
}

/// The indices of all inputs, for one output.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// For each input, in the plan's order of dimensions.
    pub indices: Vec<SobolIndex>,
    /// Mean of the output over A and B.
    pub mean: f64,
    /// Variance of the output over A and B.
    pub variance: f64,
    /// Points of which all runs have the output.
    pub points: usize,
    /// Points that were left out, because some run has none.
    pub missing: usize,
}

/// Resampled sets of points for the intervals: the ends are known to a few percent of the width.
const RESAMPLES: u64 = 1000;

impl Sensitivity {
    /// The indices of an output in the order of a plan's runs; nothing if fewer than two points
    /// have it or it does not vary.
    ///
    /// Points of which a run has no output are left out: the indices are then those of the part of
    /// the inputs that has one, as far as that is still a box.
    ///
    /// * `outputs`: of all runs, points one after another; a last point that is cut short is left
    ///   out
    /// * `inputs`: their number
    /// * `seed`: of the resampling
    #[must_use]
    pub fn of(outputs: &[Option<f64>], inputs: usize, seed: u64) -> Option<Self> {
        let whole = outputs.chunks_exact(inputs + 2);
        let all = whole.len();
        let mut rows: Vec<Vec<f64>> =
            whole.filter_map(|runs| runs.iter().copied().collect::<Option<_>>()).collect();
        if rows.len() < 2 {
            return None;
        }
        let ends = rows.iter().flat_map(|row| &row[..2]);
        let mean = ends.sum::<f64>() / (2 * rows.len()) as f64;
        rows.iter_mut().flatten().for_each(|output| *output -= mean);
        let sums = Sums::of(rows.iter(), inputs);
        let variance = sums.variance();
        if variance <= 0.0 {
            return None;
        }
        let resampled: Vec<Vec<(f64, f64)>> = (0..RESAMPLES)
            .into_par_iter()
            .map(|stream| {
                let mut random = resampling(seed, stream);
                let place = || random::below(&mut random, rows.len());
                let drawn = std::iter::repeat_with(place).take(rows.len());
                Sums::of(drawn.map(|place| &rows[place]), inputs).indices()
            })
            .collect();
        let estimate = |value: f64, index: usize, part: fn(&(f64, f64)) -> f64| {
            let mut ends: Vec<f64> = resampled.iter().map(|all| part(&all[index])).collect();
            ends.sort_by(f64::total_cmp);
            let end = |share: f64| quantile(&ends, share).unwrap_or(value);
            Estimate { value, low: end(0.025), high: end(0.975) }
        };
        let indices =
            sums.indices().into_iter().enumerate().map(|(index, (first, total))| SobolIndex {
                first: estimate(first, index, |pair| pair.0),
                total: estimate(total, index, |pair| pair.1),
            });
        Some(Self {
            indices: indices.collect(),
            mean,
            variance,
            points: rows.len(),
            missing: all - rows.len(),
        })
    }
}

/// Sums over points from which the indices follow.
struct Sums {
    points: f64,
    /// Σ (f_A + f_B) and Σ (f_A² + f_B²).
    ends: (f64, f64),
    /// Σ f_B (f_ABi − f_A) and Σ (f_A − f_ABi)², for each input.
    exchanged: Vec<(f64, f64)>,
}

impl Sums {
    /// * `rows`: f_A, f_B and each f_ABi of a point
    fn of<'r>(rows: impl Iterator<Item = &'r Vec<f64>>, inputs: usize) -> Self {
        let mut sums = Self { points: 0.0, ends: (0.0, 0.0), exchanged: vec![(0.0, 0.0); inputs] };
        for row in rows {
            let (a, b) = (row[0], row[1]);
            sums.points += 1.0;
            sums.ends.0 += a + b;
            sums.ends.1 += a * a + b * b;
            for (sum, ab) in sums.exchanged.iter_mut().zip(&row[2..]) {
                sum.0 += b * (ab - a);
                sum.1 += (a - ab) * (a - ab);
            }
        }
        sums
    }

    fn variance(&self) -> f64 {
        let count = 2.0 * self.points;
        (self.ends.1 - self.ends.0 * self.ends.0 / count) / count
    }

    /// First and total index of each input; 0 where a set of points happens not to vary.
    fn indices(&self) -> Vec<(f64, f64)> {
        let variance = self.variance();
        let over = |sum: f64| if variance > 0.0 { sum / (self.points * variance) } else { 0.0 };
        self.exchanged.iter().map(|(first, total)| (over(*first), over(total / 2.0))).collect()
    }
}
