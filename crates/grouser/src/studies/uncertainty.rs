//! What is not known exactly: distributions that are drawn from, and what many draws say.
//!
//! A [`Distribution`] is over a few values, whatever they stand for. Draw *i* depends on the seed
//! and on *i* alone, so that it can be repeated on its own and does not care what other draws
//! there are or which thread they run on. What comes of the draws is told by a [`Band`] of a
//! quantity, and by the [`Probability`] of an event.

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;

use super::random;

/// What is known of one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marginal {
    /// Its mean, in the value's own unit.
    pub mean: f64,
    /// Its standard deviation, in the same unit.
    pub standard_deviation: f64,
    /// Its distribution.
    pub shape: Shape,
}

/// The distribution of one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// x = m + d z.
    Normal,
    /// x = m e^(σz − σ²/2) with σ² = ln(1 + d²/m²): positive, with mean m and deviation d.
    Lognormal,
}

impl Marginal {
    /// The value at a standard normal score, *z* [-], by the formula of its [`Shape`].
    #[must_use]
    pub fn at(&self, score: f64) -> f64 {
        let (m, d, z) = (self.mean, self.standard_deviation, score);
        match self.shape {
            Shape::Normal => m + d * z,
            Shape::Lognormal => {
                let variance = (d / m).powi(2).ln_1p();
                m * (variance.sqrt() * z - variance / 2.0).exp()
            }
        }
    }
}

/// Correlation of the normal scores of two values, *ρ* [-]: of normal values themselves, of
/// lognormal ones' logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// The places of the two values.
    pub between: [usize; 2],
    /// Its size, above −1 and below 1.
    pub value: f64,
}

/// Correlations that no values can have together: their matrix is not positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no values can have these correlations together: their matrix is not positive definite")]
pub struct Contradiction;

/// A distribution over several values.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution(Law);

#[derive(Clone, Debug, PartialEq)]
enum Law {
    /// Values with normal scores L z, where L Lᵀ is their matrix of correlations.
    Scores { marginals: Vec<Marginal>, factor: DMatrix<f64> },
    /// One of several rows of values, each as likely as the others.
    Samples(Vec<Vec<f64>>),
}

/// Draws of which none was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{tries} tries of draw {index} gave nothing that can be used")]
pub struct NothingAccepted {
    /// The draw's number.
    pub index: u64,
    /// How often it was tried.
    pub tries: u32,
}

/// Tries for one draw. A distribution of which less than one in a hundred draws can be used is far
/// from the one that was written down; then 1000 tries succeed in all but 4e-5 of the draws.
const MOST_TRIES: u32 = 1000;

impl Distribution {
    /// Values with given marginals and correlations; pairs that are not named are uncorrelated.
    ///
    /// # Errors
    /// [`Contradiction`] if no values can have these correlations.
    ///
    /// # Panics
    /// If a correlation is between places that no value has.
    pub fn of_marginals(
        marginals: Vec<Marginal>,
        correlations: &[Correlation],
    ) -> Result<Self, Contradiction> {
        /// Squares of a factor's diagonal below this are round-off [-].
        const SINGULAR: f64 = 1e-12;
        let mut matrix = DMatrix::identity(marginals.len(), marginals.len());
        for Correlation { between: [one, other], value } in correlations {
            matrix[(*one, *other)] = *value;
            matrix[(*other, *one)] = *value;
        }
        let factor = matrix.cholesky().ok_or(Contradiction)?.unpack();
        if factor.diagonal().iter().any(|pivot| pivot * pivot <= SINGULAR) {
            return Err(Contradiction);
        }
        Ok(Self(Law::Scores { marginals, factor }))
    }

    /// Rows of samples, such as those of a posterior; each draw is one of them, whichever were
    /// drawn before.
    ///
    /// # Panics
    /// If there are none.
    #[must_use]
    pub fn of_samples(rows: Vec<Vec<f64>>) -> Self {
        assert!(!rows.is_empty(), "a distribution needs samples");
        Self(Law::Samples(rows))
    }

    /// Draw number `index`: what `accept` makes of the first values that it takes. What it refuses
    /// is drawn again, so that the distribution is truncated to what it takes.
    ///
    /// # Errors
    /// [`NothingAccepted`] if it refuses a thousand in a row.
    pub fn draw<T>(
        &self,
        seed: u64,
        index: u64,
        mut accept: impl FnMut(&[f64]) -> Option<T>,
    ) -> Result<T, NothingAccepted> {
        let mut random = random::generator(seed, index);
        let drawn = (0..MOST_TRIES).find_map(|_| accept(&self.values(&mut random)));
        drawn.ok_or(NothingAccepted { index, tries: MOST_TRIES })
    }

    fn values(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        match &self.0 {
            Law::Samples(rows) => {
                rows[place_below(random::uniform(random) * rows.len() as f64, rows.len())].clone()
            }
            Law::Scores { marginals, factor } => {
                let independent: Vec<f64> =
                    marginals.iter().map(|_| random::standard_normal(random)).collect();
                let scores = (0..marginals.len()).map(|row| {
                    (0..=row).map(|column| factor[(row, column)] * independent[column]).sum()
                });
                marginals.iter().zip(scores).map(|(marginal, score)| marginal.at(score)).collect()
            }
        }
    }
}

/// The whole part of a place in a list that is not negative; the last one for what is beyond.
fn place_below(place: f64, length: usize) -> usize {
    // Saturating: what is beyond the largest number of all is beyond the list, too.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let whole = place as usize;
    whole.min(length - 1)
}

/// The middle 95 % of a quantity, and its median.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The 2.5 % quantile.
    pub low: f64,
    /// The 50 % quantile.
    pub median: f64,
    /// The 97.5 % quantile.
    pub high: f64,
}

impl Band {
    /// The band of some draws; `None` if there are none.
    #[must_use]
    pub fn of(draws: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = draws.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            low: quantile(&sorted, 0.025)?,
            median: quantile(&sorted, 0.5)?,
            high: quantile(&sorted, 0.975)?,
        })
    }
}

/// The value below which a share of sorted draws lies, interpolated between the two nearest:
/// the k-th of n draws is the quantile (k − 1)/(n − 1) (Hyndman and Fan 1996, their type 7).
pub(super) fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let below = sorted[place_below(place, sorted.len())];
    let above = sorted[place_below(place.ceil(), sorted.len())];
    Some(below + (above - below) * place.fract())
}

/// How often something happened in independent trials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probability {
    /// Trials in which it did.
    pub successes: usize,
    /// All trials; at least one.
    pub trials: usize,
}

impl Probability {
    /// The share of successes [-].
    #[must_use]
    pub fn estimate(&self) -> f64 {
        self.successes as f64 / self.trials as f64
    }

    /// The 95 % confidence interval of the probability (Wilson 1927), both ends [-].
    ///
    /// ```text
    /// [p + z²/2n ± z √(p(1 − p)/n + z²/4n²)] / (1 + z²/n)
    /// ```
    ///
    /// It stays within 0 and 1, and says something after no success or nothing but successes.
    #[must_use]
    pub fn interval(&self) -> (f64, f64) {
        /// Standard normal score of 97.5 % [-].
        const Z: f64 = 1.959_963_984_540_054;
        let (p, n) = (self.estimate(), self.trials as f64);
        let centre = p + Z * Z / (2.0 * n);
        let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        let end = |sum: f64| (sum / (1.0 + Z * Z / n)).clamp(0.0, 1.0);
        // Where p is 0 or 1 the interval ends there; round-off would leave it just beside.
        let low = if self.successes == 0 { 0.0 } else { end(centre - half) };
        let high = if self.successes == self.trials { 1.0 } else { end(centre + half) };
        (low, high)
    }
}
