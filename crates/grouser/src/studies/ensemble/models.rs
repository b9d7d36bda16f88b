//! The wheel–soil models of a band: where no model is asked for, each sample has one of several, by weight.
//!
//! Models disagree by more than the parameters of any of them vary, so that a band of one model's parameters
//! alone is too narrow. [`WEIGHTS`] is the one table of their weights.

use crate::contact::Theory;
use crate::studies::random;

/// The weights of the models where a soil was made for none of them; only their ratios count. Source: ours: nothing
/// yet tells three independent descriptions of the stress under a wheel apart for all wheels and soils. Bekker's
/// closed form is a cross-check of the first one's stresses, no description of its own: it has no weight unless a
/// soil was made for it.
pub const WEIGHTS: [(Theory, f64); 4] =
    [(Theory::Ishigami, 1.0), (Theory::SmallWheel, 1.0), (Theory::Rft, 1.0), (Theory::Bekker, 0.0)];

/// The share of the model that a soil was made for [-]; the others have the rest, by their [`WEIGHTS`]. Source:
/// ours: constants fitted with one model mean less in another, but a fit does not make its model right elsewhere.
pub const OWN_SHARE: f64 = 0.8;

/// The models that samples may have, with their shares.
///
/// ```
/// use grouser::contact::Theory;
/// use grouser::studies::ensemble::models::ModelSpread;
///
/// let spread = ModelSpread::all(None);
/// let count = |theory| (0..300).filter(|index| spread.theory(1, *index) == theory).count();
/// assert!((99..=101).contains(&count(Theory::Rft)));
/// assert_eq!(count(Theory::Bekker), 0);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ModelSpread {
    /// Shares above 0, with the sum 1 but for round-off.
    shares: Vec<(Theory, f64)>,
}

impl ModelSpread {
    /// One model alone: what is asked for by name.
    #[must_use]
    pub fn one(theory: Theory) -> Self {
        Self { shares: vec![(theory, 1.0)] }
    }

    /// All models by their [`WEIGHTS`]; with [`OWN_SHARE`] for one that the soil was made for.
    #[must_use]
    pub fn all(made_for: Option<Theory>) -> Self {
        let others = || WEIGHTS.into_iter().filter(|(theory, _)| Some(*theory) != made_for);
        let sum: f64 = others().map(|(_, weight)| weight).sum();
        let rest = if made_for.is_some() { 1.0 - OWN_SHARE } else { 1.0 };
        let own = made_for.map(|theory| (theory, OWN_SHARE));
        let others = others().map(|(theory, weight)| (theory, rest * weight / sum));
        Self { shares: own.into_iter().chain(others).filter(|(_, share)| *share > 0.0).collect() }
    }

    /// Some models with their shares [-], above 0 and with the sum 1.
    #[must_use]
    pub(in crate::studies) fn of_shares(shares: Vec<(Theory, f64)>) -> Self {
        Self { shares }
    }

    /// The models with their shares [-].
    #[must_use]
    pub fn shares(&self) -> &[(Theory, f64)] {
        &self.shares
    }

    /// The model of sample number `index`, which depends on the seed and that number alone.
    ///
    /// Steps of the golden ratio around a circle whose arcs are the shares, from a start that the seed gives: any
    /// number of samples in a row have the models by their shares, to within a few samples (Weyl 1916; the golden
    /// ratio's discrepancy is the smallest).
    #[must_use]
    pub fn theory(&self, seed: u64, index: u64) -> Theory {
        let mut random = random::generator(seed, STREAM);
        self.at((random::uniform(&mut random) + golden_steps(index)).fract())
    }

    /// The model at a place on the circle of the shares.
    ///
    /// * `place`: 0 to 1
    #[must_use]
    pub fn at(&self, place: f64) -> Theory {
        let mut end = 0.0;
        let within = self.shares.iter().find(|(_, share)| {
            end += share;
            place < end
        });
        // Round-off may leave the last end just below 1.
        within.or(self.shares.last()).map_or_else(Theory::default, |(theory, _)| *theory)
    }
}

/// A stream of random numbers that no sample has.
const STREAM: u64 = u64::MAX;

/// The fraction of `index` golden ratios [-], in whole numbers: the same on every machine.
fn golden_steps(index: u64) -> f64 {
    /// (√5 − 1)/2 in units of 2⁻⁶⁴.
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    const PARTS: f64 = (1_u64 << 53) as f64;
    (index.wrapping_mul(GOLDEN) >> 11) as f64 / PARTS
}
