//! Statistics of one quantity over many runs: mean, quantiles and probabilities, with confidence
//! intervals.
//!
//! Intervals are 95 % confidence intervals for independent samples: [`Quantile`]s without any
//! assumption on the distribution, the mean by the central limit, a
//! [`Probability`](super::Probability) by Wilson. For a Latin hypercube they are wide rather than
//! narrow: its mean's variance is at most N/(N − 1) times that of independent samples (Owen 1997).
//! For a scrambled Sobol design they are wide for every result that is smooth in its inputs; what
//! is guaranteed is only that its variance is within a constant of that of independent samples.

use grouser_io::statistics::quantile;

use crate::studies::random::place_below;

/// An estimate with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// A quantile and its interval. An end is missing where there are too few samples to bound it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantile {
    /// The share of samples below it [-].
    pub share: f64,
    /// The estimate, interpolated between two samples.
    pub value: f64,
    /// Lower end of the interval: one of the samples.
    pub low: Option<f64>,
    /// Upper end: one of the samples.
    pub high: Option<f64>,
}

/// A quantity over samples in a few numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Samples that have the quantity.
    pub count: usize,
    /// Samples that do not.
    pub missing: usize,
    /// Mean.
    pub mean: Estimate,
    /// Standard deviation.
    pub deviation: f64,
    /// The smallest sample.
    pub least: f64,
    /// The largest sample.
    pub most: f64,
    /// The quantiles that were asked for.
    pub quantiles: Vec<Quantile>,
}

/// Standard normal score of 97.5 % [-].
const Z: f64 = 1.959_963_984_540_054;
/// Chance that an interval's end is on the wrong side [-].
const TAIL: f64 = 0.025;

impl Summary {
    /// The summary of samples, `None` for those without the quantity; nothing if fewer than two
    /// have it.
    ///
    /// * `shares`: of the quantiles [-], above 0 and below 1
    #[must_use]
    pub fn of(draws: &[Option<f64>], shares: &[f64]) -> Option<Self> {
        let mut sorted: Vec<f64> = draws.iter().copied().flatten().collect();
        if sorted.len() < 2 {
            return None;
        }
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len() as f64;
        let mean = sorted.iter().sum::<f64>() / count;
        let squares: f64 = sorted.iter().map(|value| (value - mean).powi(2)).sum();
        let deviation = (squares / (count - 1.0)).sqrt();
        let half = Z * deviation / count.sqrt();
        Some(Self {
            count: sorted.len(),
            missing: draws.len() - sorted.len(),
            mean: Estimate { value: mean, low: mean - half, high: mean + half },
            deviation,
            least: sorted[0],
            most: sorted[sorted.len() - 1],
            quantiles: shares.iter().filter_map(|share| Quantile::of(&sorted, *share)).collect(),
        })
    }
}

impl Quantile {
    /// The quantile of samples from the smallest to the largest; nothing without samples, or for an
    /// invalid share.
    ///
    /// The number of samples below the true quantile is binomial whatever their distribution, so
    /// that the quantile lies between the l-th and the u-th sample with
    ///
    /// ```text
    /// P(K < l) ≤ 2.5 %        P(K ≥ u) ≤ 2.5 %        K ~ Bin(n, p)
    /// ```
    ///
    /// (David and Nagaraja 2003, section 7.1).
    ///
    /// * `share`: *p* [-], above 0 and below 1
    #[must_use]
    pub fn of(sorted: &[f64], share: f64) -> Option<Self> {
        if !(0.0..=1.0).contains(&share) {
            return None;
        }
        let count = sorted.len();
        let value = quantile(sorted, share)?;
        // P(K ≤ k) grows with k: the smallest k at which it passes a bound.
        let first_above = |bound: f64| {
            let (mut below, mut above) = (0, count);
            while below < above {
                let middle = usize::midpoint(below, above);
                if binomial_share(count, share, middle) > bound {
                    above = middle;
                } else {
                    below = middle + 1;
                }
            }
            below
        };
        // The largest l with P(K ≤ l − 1) ≤ 2.5 %, counted from 1.
        let lower = first_above(TAIL);
        // The smallest u with P(K ≤ u − 1) ≥ 97.5 %, counted from 1.
        let upper = first_above(1.0 - TAIL) + 1;
        let draw = |rank: usize| rank.checked_sub(1).and_then(|place| sorted.get(place)).copied();
        Some(Self { share, value, low: draw(lower), high: draw(upper) })
    }
}

/// P(K ≤ k) of a binomial K ~ Bin(n, p) [-], to 1e-12.
///
/// Its terms over the largest one, each from its neighbour, until they no longer count: no
/// function is needed that differs between machines, and the few hundred terms of a million
/// samples cost nothing beside the samples.
fn binomial_share(n: usize, p: f64, k: usize) -> f64 {
    /// Terms fall faster than a geometric series from here on.
    const NEGLIGIBLE: f64 = 1e-20;
    if k >= n || p <= 0.0 {
        return 1.0;
    }
    if p >= 1.0 {
        return 0.0;
    }
    let odds = p / (1.0 - p);
    let mode = place_below((n + 1) as f64 * p, n + 1);
    let (mut below, mut above) = (0.0, 0.0);
    let mut count = |at: usize, term: f64| *(if at <= k { &mut below } else { &mut above }) += term;
    let mut term = 1.0;
    count(mode, term);
    for at in (0..mode).rev() {
        term *= (at + 1) as f64 / ((n - at) as f64 * odds);
        if term < NEGLIGIBLE {
            break;
        }
        count(at, term);
    }
    term = 1.0;
    for at in mode + 1..=n {
        term *= odds * (n + 1 - at) as f64 / at as f64;
        if term < NEGLIGIBLE {
            break;
        }
        count(at, term);
    }
    below / (below + above)
}

/// Convergence: the statistics of the first runs of a campaign, for more and more of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Convergence {
    /// Number of runs.
    pub runs: usize,
    /// Their summary; nothing while fewer than two have the quantity.
    pub summary: Option<Summary>,
}

impl Convergence {
    /// The convergence of samples in the order of their runs: after each number of runs from 16 up
    /// that is a power of two, and after all.
    ///
    /// * `shares`: of the quantiles [-]
    #[must_use]
    pub fn of(draws: &[Option<f64>], shares: &[f64]) -> Vec<Self> {
        const FIRST: usize = 16;
        let counts = std::iter::successors(Some(FIRST), |count| count.checked_mul(2));
        let counts = counts.take_while(|count| *count < draws.len());
        counts
            .chain([draws.len()])
            .map(|runs| Self { runs, summary: Summary::of(&draws[..runs], shares) })
            .collect()
    }
}
