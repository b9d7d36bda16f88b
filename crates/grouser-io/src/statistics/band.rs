//! The middle 95 % of a sampled quantity, and how probable something is after some trials.

use super::random::place_below;

/// Standard normal score of 97.5 % [-].
const Z: f64 = 1.959_963_984_540_054;

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

/// The value below which a share of sorted draws lies, interpolated between the two nearest: the
/// k-th of n draws is the quantile (k − 1)/(n − 1) (Hyndman and Fan 1996, their type 7). Draws may
/// be infinite.
#[must_use]
pub fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = share * last as f64;
    let below = sorted[place_below(place, sorted.len())];
    let above = sorted[place_below(place.ceil(), sorted.len())];
    // Between two draws that are infinite there is no number.
    let is_between = place.fract() > 0.0 && below < above;
    Some(if is_between { below + (above - below) * place.fract() } else { below })
}

/// The draw below which, with itself, a share of the draws' weight lies; `None` if there are none.
///
/// * `draws`: value and weight of each
#[must_use]
pub fn weighted_quantile(mut draws: Vec<(f64, f64)>, share: f64) -> Option<f64> {
    draws.sort_by(|one, other| one.0.total_cmp(&other.0));
    let total: f64 = draws.iter().map(|(_, weight)| weight).sum();
    let mut below = 0.0;
    let found = draws.iter().find(|(_, weight)| {
        below += weight / total;
        below >= share
    });
    // Round-off may leave the last sum just below 1.
    found.or(draws.last()).map(|(value, _)| *value)
}

/// Interval score of the middle 95 %: its width, and forty times by how much it misses.
///
/// ```text
/// S = (u − l) + (2/α) max(l − y, 0) + (2/α) max(y − u, 0)      α = 0.05
/// ```
///
/// Source: Gneiting and Raftery (2007), Eq. 43.
#[must_use]
pub fn interval_score([low, high]: [f64; 2], value: f64) -> f64 {
    const ALPHA: f64 = 0.05;
    let outside = (low - value).max(0.0) + (value - high).max(0.0);
    high - low + 2.0 / ALPHA * outside
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

    /// The 95 % [confidence interval](share_interval) of the probability, both ends [-].
    #[must_use]
    pub fn interval(&self) -> (f64, f64) {
        share_interval(self.estimate(), self.trials as f64)
    }
}

/// The 95 % confidence interval of a probability (Wilson 1927), both ends [-].
///
/// ```text
/// [p + z²/2n ± z √(p(1 − p)/n + z²/4n²)] / (1 + z²/n)
/// ```
///
/// It stays within 0 and 1, and says something after no success or nothing but successes.
///
/// * `share`: p, of the trials in which it happened [-]
/// * `trials`: n, independent ones; infinite where the share is exact
#[must_use]
pub fn share_interval(share: f64, trials: f64) -> (f64, f64) {
    let (p, n) = (share, trials);
    let centre = p + Z * Z / (2.0 * n);
    let half = Z * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
    let end = |sum: f64| (sum / (1.0 + Z * Z / n)).clamp(0.0, 1.0);
    // Where p is 0 or 1 the interval ends there; round-off would leave it just beside.
    let low = if p == 0.0 { 0.0 } else { end(centre - half) };
    let high = if p == 1.0 { 1.0 } else { end(centre + half) };
    (low, high)
}
