//! What is not known exactly: distributions that are drawn from, and what many draws say.
//!
//! A [`Distribution`] is over a few values, whatever they stand for. Draw *i* depends on the seed
//! and on *i* alone, so that it can be repeated on its own and does not care what other draws
//! there are or which thread they run on. What comes of the draws is told by a [`Band`] of a
//! quantity, and by the [`Probability`] of an event.

use std::ops::RangeInclusive;

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;

use super::normal::{normal_score, normal_share};
use super::random::{self, place_below};
use crate::elementary::exp;
use crate::elementary::wide::{ln, ln_1p};

/// The distribution of one value, in the value's own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marginal {
    /// x = m + d z.
    Normal {
        /// Mean, *m*.
        mean: f64,
        /// Standard deviation, *d*.
        standard_deviation: f64,
    },
    /// x = m e^(σz − σ²/2) with σ² = ln(1 + d²/m²): positive, with mean m and deviation d.
    Lognormal {
        /// Mean, *m*; above 0.
        mean: f64,
        /// Standard deviation, *d*.
        standard_deviation: f64,
    },
    /// x = a + (b − a) Φ(z): every value between two is as likely as the others.
    Uniform {
        /// Lower end, *a*.
        low: f64,
        /// Upper end, *b*.
        high: f64,
    },
    /// A density that rises linearly from a to c and falls linearly to b.
    ///
    /// ```text
    /// x = a + √[Φ(z) (b − a)(c − a)]        up to c
    /// x = b − √[Φ(−z) (b − a)(b − c)]       beyond
    /// ```
    Triangular {
        /// Lower end, *a*.
        low: f64,
        /// The most likely value, *c*.
        mode: f64,
        /// Upper end, *b*.
        high: f64,
    },
}

impl Marginal {
    /// The value at a standard normal score, *z* [-]; it grows with the score.
    #[must_use]
    pub fn at(&self, score: f64) -> f64 {
        let z = score;
        match *self {
            Self::Normal { mean: m, standard_deviation: d } => m + d * z,
            Self::Lognormal { mean: m, standard_deviation: d } => {
                let variance = ln_1p((d / m).powi(2));
                m * exp(variance.sqrt() * z - variance / 2.0)
            }
            Self::Uniform { low: a, high: b } => a + (b - a) * normal_share(z),
            Self::Triangular { low: a, mode: c, high: b } => {
                let share = normal_share(z);
                if share * (b - a) < c - a {
                    a + (share * (b - a) * (c - a)).sqrt()
                } else {
                    b - (normal_share(-z) * (b - a) * (b - c)).sqrt()
                }
            }
        }
    }

    /// The share of draws below a value, *F(x)* [-], where draws differ.
    fn share_below(&self, value: f64) -> f64 {
        let x = value;
        match *self {
            Self::Normal { mean, standard_deviation } => {
                normal_share((x - mean) / standard_deviation)
            }
            Self::Lognormal { mean, standard_deviation } => {
                let variance = ln_1p((standard_deviation / mean).powi(2));
                // The logarithm of what is not positive is below that of all that is.
                let log = if x > 0.0 { ln(x / mean) } else { f64::NEG_INFINITY };
                normal_share((log + variance / 2.0) / variance.sqrt())
            }
            Self::Uniform { low: a, high: b } => ((x - a) / (b - a)).clamp(0.0, 1.0),
            Self::Triangular { low: a, mode: c, high: b } => {
                if x <= a {
                    0.0
                } else if x < c {
                    (x - a).powi(2) / ((b - a) * (c - a))
                } else if x < b {
                    1.0 - (b - x).powi(2) / ((b - a) * (b - c))
                } else {
                    1.0
                }
            }
        }
    }

    /// The share of draws within a range [-].
    #[must_use]
    pub fn share_within(&self, range: &RangeInclusive<f64>) -> f64 {
        if self.is_certain() {
            return if range.contains(&self.at(0.0)) { 1.0 } else { 0.0 };
        }
        self.share_below(*range.end()) - self.share_below(*range.start())
    }

    /// Whether it has one value alone.
    fn is_certain(&self) -> bool {
        match *self {
            Self::Normal { standard_deviation, .. }
            | Self::Lognormal { standard_deviation, .. } => standard_deviation == 0.0,
            Self::Uniform { low, high } | Self::Triangular { low, high, .. } => low == high,
        }
    }
}

/// A distribution cut off at the ends of a range: what is outside is spread over the inside in
/// proportion.
///
/// ```text
/// x = F⁻¹{F(low) + Φ(z) [F(high) − F(low)]}
/// ```
///
/// A cut by formula instead of by drawing again keeps a designed set of points what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cut {
    marginal: Marginal,
    /// The ends of the range.
    range: (f64, f64),
    /// The shares of draws below the range and above it [-].
    outside: (f64, f64),
}

impl Cut {
    /// A distribution as it is.
    fn nowhere(marginal: Marginal) -> Self {
        Self { marginal, range: (f64::NEG_INFINITY, f64::INFINITY), outside: (0.0, 0.0) }
    }

    fn at_ends(marginal: Marginal, range: &RangeInclusive<f64>) -> Self {
        // One value alone is inside, also where it is an end.
        if marginal.is_certain() {
            return Self::nowhere(marginal);
        }
        let (low, high) = (*range.start(), *range.end());
        let outside = (marginal.share_below(low), 1.0 - marginal.share_below(high));
        Self { marginal, range: (low, high), outside }
    }

    fn at(&self, score: f64) -> f64 {
        let (below, above) = self.outside;
        let inside = 1.0 - below - above;
        let cut = if below == 0.0 && above == 0.0 {
            score
        } else if score < 0.0 {
            normal_score(below + normal_share(score) * inside)
        } else {
            // From the other end, where small shares are exact.
            -normal_score(above + normal_share(-score) * inside)
        };
        // Round-off may lead just beside an end.
        self.marginal.at(cut).clamp(self.range.0, self.range.1)
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
    Scores { marginals: Vec<Cut>, factor: DMatrix<f64> },
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
        let marginals = marginals.into_iter().map(Cut::nowhere).collect();
        Ok(Self(Law::Scores { marginals, factor }))
    }

    /// The same, each value's distribution cut off at the ends of its range. (Correlations are of
    /// the scores, and stay what they are; samples are not cut.)
    ///
    /// * `ranges`: one for each value; each with some share of its value's draws inside
    #[must_use]
    pub fn within(self, ranges: &[RangeInclusive<f64>]) -> Self {
        match self.0 {
            Law::Scores { marginals, factor } => {
                let cut = |(cut, range): (&Cut, _)| Cut::at_ends(cut.marginal, range);
                let marginals = marginals.iter().zip(ranges).map(cut).collect();
                Self(Law::Scores { marginals, factor })
            }
            samples @ Law::Samples(_) => Self(samples),
        }
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

    /// How many uniform numbers a draw is made of: one for each marginal, or one for samples.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        match &self.0 {
            Law::Scores { marginals, .. } => marginals.len(),
            Law::Samples(_) => 1,
        }
    }

    /// How many values a draw has.
    #[must_use]
    pub fn width(&self) -> usize {
        match &self.0 {
            Law::Scores { marginals, .. } => marginals.len(),
            Law::Samples(rows) => rows[0].len(),
        }
    }

    /// The values at a point of the unit cube: uniform points make draws of the distribution.
    ///
    /// * `point`: a number above 0 and below 1 for each of the [`dimensions`](Self::dimensions)
    #[must_use]
    pub fn at(&self, point: &[f64]) -> Vec<f64> {
        match &self.0 {
            Law::Samples(rows) => {
                rows[place_below(point[0] * rows.len() as f64, rows.len())].clone()
            }
            Law::Scores { marginals, factor } => {
                let independent: Vec<f64> = point.iter().map(|u| normal_score(*u)).collect();
                let scores = (0..marginals.len()).map(|row| {
                    (0..=row).map(|column| factor[(row, column)] * independent[column]).sum()
                });
                marginals.iter().zip(scores).map(|(marginal, score)| marginal.at(score)).collect()
            }
        }
    }

    fn values(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        let point: Vec<f64> = (0..self.dimensions()).map(|_| random::uniform(random)).collect();
        self.at(&point)
    }
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
