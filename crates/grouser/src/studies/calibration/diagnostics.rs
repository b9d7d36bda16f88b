//! Diagnostics of the sampler and summaries of its samples: R-hat, effective sample size, moments,
//! quantiles.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::Calibration;
use super::posterior::{Chain, PosteriorState};
use grouser_io::statistics::quantile;

/// Samples of several chains that sampled one density, each by itself.
///
/// The walkers of an ensemble lead each other, so that together they are one chain, which is at
/// several places at each of its steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Chains, each step by step, walker by walker; every place is a row of values.
    pub chains: Vec<Vec<Vec<f64>>>,
    /// Walkers of a chain.
    pub walkers: usize,
}

/// The posterior of one value in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Median.
    pub median: f64,
    /// The value that 2.5 % of the samples lie below.
    pub lower: f64,
    /// The value that 2.5 % of the samples lie above.
    pub upper: f64,
    /// Split R-hat [-]: 1 if the chains agree, and the halves of each; see [`r_hat`].
    pub r_hat: f64,
    /// Effective sample size: independent samples with the same standard error [-].
    pub effective_samples: f64,
    /// Integrated autocorrelation time, in kept steps [-].
    pub autocorrelation_time: f64,
}

/// The share of the samples between [`Summary::lower`] and [`Summary::upper`] [-].
pub const INTERVAL: f64 = 0.95;

impl Samples {
    /// The samples of a calibration: values of its parameters, then of its discrepancies.
    ///
    /// * `discarded`: share of the steps that does not count, from the start [-]
    #[must_use]
    pub fn of(calibration: &Calibration, state: &PosteriorState, discarded: f64) -> Self {
        let chains = state.settled_chains(discarded);
        let walkers = chains.first().map_or(1, |chain| chain.walkers);
        let values =
            |chain: &Chain| chain.places.iter().map(|place| calibration.values_at(place)).collect();
        Self { chains: chains.iter().map(values).collect(), walkers }
    }

    /// All rows, chain by chain.
    pub fn rows(&self) -> impl Iterator<Item = &Vec<f64>> {
        self.chains.iter().flatten()
    }

    /// How many rows there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.chains.iter().map(Vec::len).sum()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// At most `count` rows, evenly spread over steps and walkers.
    #[must_use]
    pub fn thinned(&self, count: usize) -> Vec<&[f64]> {
        let mut stride = self.len().div_ceil(count.max(1)).max(1);
        // With a divisor in common, the same walkers would be met again and again.
        while greatest_common_divisor(stride, self.walkers.max(1)) > 1 {
            stride += 1;
        }
        self.rows().step_by(stride).map(Vec::as_slice).collect()
    }

    /// The summary of each value.
    #[must_use]
    pub fn summaries(&self) -> Vec<Summary> {
        let width = self.rows().next().map_or(0, Vec::len);
        (0..width).into_par_iter().map(|column| self.summary(column)).collect()
    }

    fn summary(&self, column: usize) -> Summary {
        let chains: Vec<Vec<f64>> =
            self.chains.iter().map(|chain| chain.iter().map(|row| row[column]).collect()).collect();
        let mut sorted: Vec<f64> = chains.iter().flatten().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let (mean, variance) = moments(&sorted);
        let time = autocorrelation_time(&chains, self.walkers);
        let tail = 0.5 * (1.0 - INTERVAL);
        let at = |share| quantile(&sorted, share).unwrap_or(mean);
        Summary {
            mean,
            deviation: variance.sqrt(),
            median: at(0.5),
            lower: at(tail),
            upper: at(1.0 - tail),
            r_hat: r_hat(&chains, self.walkers),
            effective_samples: sorted.len() as f64 / time,
            autocorrelation_time: time,
        }
    }

    /// Correlation of each value with each other [-].
    #[must_use]
    pub fn correlations(&self) -> DMatrix<f64> {
        correlations_of(&covariance_of(&self.rows().map(Vec::as_slice).collect::<Vec<_>>()))
    }
}

fn greatest_common_divisor(one: usize, other: usize) -> usize {
    if other == 0 { one } else { greatest_common_divisor(other, one % other) }
}

/// Covariance of the columns of rows.
#[must_use]
pub fn covariance_of(rows: &[&[f64]]) -> DMatrix<f64> {
    let width = rows.first().map_or(0, |row| row.len());
    let count = rows.len() as f64;
    let mean = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / count;
    let means: Vec<f64> = (0..width).map(mean).collect();
    let mut sums: DMatrix<f64> = DMatrix::zeros(width, width);
    for row in rows {
        for i in 0..width {
            for j in 0..=i {
                sums[(i, j)] += (row[i] - means[i]) * (row[j] - means[j]);
            }
        }
    }
    DMatrix::from_fn(width, width, |i, j| sums[(i.max(j), i.min(j))] / (count - 1.0).max(1.0))
}

/// Correlations [-] from covariances; 0 beside a value that does not vary.
#[must_use]
pub fn correlations_of(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let width = covariance.nrows();
    DMatrix::from_fn(width, width, |i, j| {
        let scale = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        match (i == j, scale > 0.0) {
            (true, _) => 1.0,
            (false, true) => (covariance[(i, j)] / scale).clamp(-1.0, 1.0),
            (false, false) => 0.0,
        }
    })
}

/// Split R-hat [-] (Gelman and Rubin 1992; split: Gelman et al. 2013): how much wider the samples
/// of all chains lie than those of one half of one chain.
///
/// ```text
/// R_hat = √[(W (n−1)/n + B)/W]      W: mean variance within halves      B: variance of their means
/// ```
///
/// * `walkers`: places of each step
#[must_use]
pub fn r_hat(chains: &[Vec<f64>], walkers: usize) -> f64 {
    let mut halves = Vec::new();
    for chain in chains {
        let middle = chain.len() / walkers / 2 * walkers;
        halves.push(moments(&chain[..middle]));
        halves.push(moments(&chain[middle..]));
    }
    let within = halves.iter().map(|(_, variance)| variance).sum::<f64>() / halves.len() as f64;
    let means: Vec<f64> = halves.iter().map(|(mean, _)| *mean).collect();
    let (_, between) = moments(&means);
    let n = chains.first().map_or(0, |chain| chain.len() / 2) as f64;
    if within > 0.0 {
        ((within * (n - 1.0).max(0.0) / n + between) / within).sqrt()
    } else if between > 0.0 {
        // Chains that stand still at different places.
        f64::MAX
    } else {
        1.0
    }
}

/// Integrated autocorrelation time τ = 1 + 2 Σ ρ(t), in steps [-], at least 1.
///
/// The autocorrelation ρ is taken about the mean of all chains and averaged over all walkers, so
/// that chains shorter than τ do not look as if they mixed. The sum ends at the first lag above
/// 5 τ (Sokal 1989), or at half of the chain.
///
/// * `walkers`: places of each step
#[must_use]
pub fn autocorrelation_time(chains: &[Vec<f64>], walkers: usize) -> f64 {
    /// A window of so many times: its neglected tail is below a percent of an exponential one.
    const WINDOW: f64 = 5.0;
    let all: Vec<f64> = chains.iter().flatten().copied().collect();
    let (mean, variance) = moments(&all);
    if variance.is_nan() || variance <= 0.0 {
        return 1.0;
    }
    let steps = chains.iter().map(|chain| chain.len() / walkers).min().unwrap_or(0);
    let correlation = |lag: usize| {
        let (mut sum, mut count) = (0.0, 0);
        for chain in chains {
            let later = &chain[lag * walkers..];
            for (one, other) in chain.iter().zip(later) {
                sum += (one - mean) * (other - mean);
            }
            count += later.len();
        }
        sum / (count as f64 * variance)
    };
    let mut time = 1.0;
    for lag in 1..steps / 2 {
        time += 2.0 * correlation(lag);
        if lag as f64 >= WINDOW * time {
            break;
        }
    }
    time.max(1.0)
}

/// Mean and variance; of fewer than two numbers the variance is 0.
fn moments(numbers: &[f64]) -> (f64, f64) {
    let count = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / count.max(1.0);
    let squares: f64 = numbers.iter().map(|number| (number - mean).powi(2)).sum();
    (mean, squares / (count - 1.0).max(1.0))
}

#[cfg(test)]
mod tests {
    use super::super::ensemble::normal_numbers;
    use super::*;

    /// x_{t+1} = a x_t + √(1 − a²) N(0, 1).
    fn autoregressive(a: f64, steps: usize, stream: u64) -> Vec<f64> {
        let numbers = normal_numbers(11, stream, steps);
        let mut x = numbers[0];
        let mut chain = vec![x];
        for number in &numbers[1..] {
            x = a * x + (1.0 - a * a).sqrt() * number;
            chain.push(x);
        }
        chain
    }

    /// Closed form: ρ(t) = aᵗ, so τ = (1 + a)/(1 − a). The estimate errs by √(2 (2 M + 1)/n) of
    /// itself (Sokal), M = 5 τ steps of n: 10 % at a = 0.9.
    #[test]
    fn the_autocorrelation_time_of_an_autoregression_is_known() {
        for (a, stream) in [(0.0, 1), (0.5, 2), (0.9, 3)] {
            let chain = autoregressive(a, 40_000, stream);
            let expected = (1.0 + a) / (1.0 - a);
            let found = autocorrelation_time(&[chain], 1);
            assert!((found / expected - 1.0).abs() < 0.2, "{a}: {found} instead of {expected}");
        }
    }

    /// Every walker is among the samples that are kept, also where the plain stride would meet one
    /// alone: 4800 rows to 100 are one in 48.
    #[test]
    fn thinned_samples_are_of_all_walkers() {
        const WALKERS: usize = 48;
        let chain = (0..100 * WALKERS).map(|place| vec![(place % WALKERS) as f64]).collect();
        let samples = Samples { chains: vec![chain], walkers: WALKERS };
        let kept = samples.thinned(100);
        assert!((90..=100).contains(&kept.len()), "{}", kept.len());
        let mut met: Vec<f64> = kept.iter().map(|row| row[0]).collect();
        met.sort_by(f64::total_cmp);
        met.dedup();
        assert_eq!(met.len(), WALKERS);
    }

    /// Places of several walkers side by side have the time of one.
    #[test]
    fn walkers_side_by_side_have_the_same_time() {
        let walkers: Vec<Vec<f64>> = (0..4).map(|k| autoregressive(0.8, 10_000, 20 + k)).collect();
        let chain: Vec<f64> =
            (0..10_000).flat_map(|step| walkers.iter().map(move |walker| walker[step])).collect();
        let found = autocorrelation_time(&[chain], 4);
        // τ = 9, found to 7 %.
        assert!((found / 9.0 - 1.0).abs() < 0.2, "{found}");
    }

    #[test]
    fn chains_of_one_density_agree_and_shifted_ones_do_not() {
        let chain = |stream| autoregressive(0.5, 4000, stream);
        let mut chains: Vec<Vec<f64>> = (30..34).map(chain).collect();
        // Means of halves vary by τ/n = 3/2000 of the variance.
        assert!(r_hat(&chains, 1) < 1.003);
        for value in &mut chains[0] {
            *value += 1.0;
        }
        assert!(r_hat(&chains, 1) > 1.05);
    }

    /// A chain that drifts disagrees with itself: that is what the split is for.
    #[test]
    fn a_drifting_chain_is_seen() {
        let drifting: Vec<f64> = (0..1000).map(f64::from).collect();
        assert!(r_hat(&[drifting.clone(), drifting], 1) > 1.5);
    }

    #[test]
    fn covariances_of_a_line_are_its_slopes() {
        let rows: Vec<[f64; 2]> = (0..11).map(|k| [f64::from(k), -2.0 * f64::from(k)]).collect();
        let rows: Vec<&[f64]> = rows.iter().map(|row| &row[..]).collect();
        let covariance = covariance_of(&rows);
        // The variance of 0 to 10 is 11.
        assert!((covariance[(0, 0)] - 11.0).abs() < 1e-12);
        assert!((covariance[(0, 1)] + 22.0).abs() < 1e-12);
        assert!((correlations_of(&covariance)[(1, 0)] + 1.0).abs() < 1e-12);
    }
}
