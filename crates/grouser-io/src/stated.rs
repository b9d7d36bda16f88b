//! What documents say of numbers that are not known exactly, as it is written.

use std::ops::RangeInclusive;

use serde_json::{Value as Json, json};

use crate::statistics::Marginal;

/// The uncertain numbers of a document.
#[derive(Clone, Debug, Default)]
pub struct Stated {
    /// Rows of samples, if it has some.
    pub samples: Option<Samples>,
    /// Numbers with distributions.
    pub parameters: Vec<Parameter>,
    /// Correlations of pairs of them.
    pub correlations: Vec<Pair>,
}

/// The place of rows of samples.
#[derive(Clone, Debug)]
pub enum Samples {
    /// In a CSV file, from the folder of the document.
    File(String),
    /// In the document.
    Inline(String),
}

/// An uncertain number.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its key, with the tables it stands in.
    pub key: String,
    /// Its distribution; the mean is NaN where it is left out.
    pub marginal: Marginal,
    /// What a row of a prior says besides.
    pub(crate) belief: Belief,
}

/// What a row of a prior says besides its distribution.
#[derive(Clone, Debug)]
pub(crate) struct Belief {
    /// The median; NaN where it is left out.
    pub median: f64,
    /// The key of which the row's numbers are multiples; empty if they are in the key's own unit.
    pub relative_to: String,
    /// The soils that it is about.
    pub soils: Soils,
    /// The table or key that a soil must not state; empty if there is none.
    pub unless: String,
    /// A keyword of the soil and what it has to be, as `key=word`; empty for all soils.
    pub when: String,
    /// Why it is so.
    pub reason: String,
}

/// The soils that a row of a prior is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Soils {
    /// All of them.
    #[default]
    Any,
    /// Loose ones: sand, regolith, simulant.
    Loose,
    /// Firm ones: clay, loam, tamped ground.
    Firm,
}

/// What is believed of numbers that sources do not print.
#[derive(Clone, Debug, Default)]
pub(crate) struct Priors {
    /// Numbers that a soil does not state.
    pub missing: Vec<Parameter>,
    /// Keywords that a soil does not state.
    pub keywords: Vec<KeywordPrior>,
    /// How well stated numbers are known.
    pub stated: Vec<Parameter>,
    /// Correlations of pairs of all these numbers.
    pub correlations: Vec<Pair>,
}

/// A keyword that a soil does not state.
#[derive(Clone, Debug, Default)]
pub(crate) struct KeywordPrior {
    /// Its key, with the tables it stands in.
    pub key: String,
    /// The keyword.
    pub word: String,
    /// Why it is so.
    pub reason: String,
}

/// Two keys that are correlated.
#[derive(Clone, Debug, Default)]
pub struct Pair {
    /// The two keys.
    pub between: [String; 2],
    /// Their correlation [-].
    pub value: f64,
}

/// What a number is before a document's is put in; a mean that is left out stays so.
pub(crate) const UNSET: f64 = f64::NAN;
pub(crate) const NORMAL: Marginal = Marginal::Normal { mean: UNSET, standard_deviation: UNSET };

impl Belief {
    const NONE: Self = Self {
        median: UNSET,
        relative_to: String::new(),
        soils: Soils::Any,
        unless: String::new(),
        when: String::new(),
        reason: String::new(),
    };
}

impl Parameter {
    /// One before its distribution is put in: normal, about the value that the key has.
    pub(crate) fn blank() -> Self {
        Self { key: String::new(), marginal: NORMAL, belief: Belief::NONE }
    }

    /// Its mean, if its distribution has one.
    pub(crate) fn mean_mut(&mut self) -> Option<&mut f64> {
        match &mut self.marginal {
            Marginal::Normal { mean, .. } | Marginal::Lognormal { mean, .. } => Some(mean),
            Marginal::Uniform { .. } | Marginal::Triangular { .. } => None,
        }
    }

    /// Whether its mean is left out.
    #[must_use]
    pub fn has_no_mean(&self) -> bool {
        self.clone().mean_mut().is_some_and(|mean| mean.is_nan())
    }

    /// Its row in a document, without what priors say besides.
    ///
    /// * `key`: what the document calls it
    #[must_use]
    pub fn to_json(&self, key: &str) -> Json {
        match self.marginal {
            Marginal::Normal { mean, standard_deviation } => {
                json!({ "key": key, "distribution": "normal", "mean": mean,
                    "standard_deviation": standard_deviation })
            }
            Marginal::Lognormal { mean, standard_deviation } => {
                json!({ "key": key, "distribution": "lognormal", "mean": mean,
                    "standard_deviation": standard_deviation })
            }
            Marginal::Uniform { low, high } => {
                json!({ "key": key, "distribution": "uniform", "low": low, "high": high })
            }
            Marginal::Triangular { low, mode, high } => {
                json!({ "key": key, "distribution": "triangular", "low": low, "mode": mode,
                    "high": high })
            }
        }
    }

    /// Its distribution, about a value unless it has a mean of its own.
    pub(crate) fn around(&self, value: f64) -> Marginal {
        let mut whole = self.clone();
        if let Some(mean) = whole.mean_mut().filter(|mean| mean.is_nan()) {
            *mean = value;
        }
        whole.marginal
    }
}

impl Parameter {
    /// Its distribution in the key's own unit; none if that is no distribution, such as a lognormal
    /// one about 0.
    ///
    /// * `own`: the value that the key has, if it has one
    /// * `reference`: that of the key of which the numbers are multiples, or 1
    /// * `range`: of the key, at which the ends of a bounded distribution are cut off
    pub(crate) fn scaled(
        &self,
        own: Option<f64>,
        reference: f64,
        range: &RangeInclusive<f64>,
    ) -> Option<Marginal> {
        let within = |value: f64| (value * reference).clamp(*range.start(), *range.end());
        let median = self.belief.median * reference;
        let mean = |stated: f64| if stated.is_nan() { own } else { Some(stated * reference) };
        let marginal = match self.marginal {
            Marginal::Normal { mean: m, standard_deviation } => Marginal::Normal {
                mean: if median.is_nan() { mean(m)? } else { median },
                standard_deviation: standard_deviation * reference,
            },
            Marginal::Lognormal { mean: m, standard_deviation: d } => {
                let standard_deviation = d * reference;
                let mean = if median.is_nan() {
                    mean(m)?
                } else {
                    lognormal_mean(median, standard_deviation)
                };
                Marginal::Lognormal { mean, standard_deviation }
            }
            Marginal::Uniform { low, high } => {
                Marginal::Uniform { low: within(low), high: within(high) }
            }
            Marginal::Triangular { low, mode, high } => {
                Marginal::Triangular { low: within(low), mode: within(mode), high: within(high) }
            }
        };
        let is_one = match marginal {
            Marginal::Lognormal { mean, .. } => mean > 0.0,
            Marginal::Uniform { low, high } | Marginal::Triangular { low, high, .. } => low < high,
            Marginal::Normal { .. } => true,
        };
        (reference > 0.0 && is_one).then_some(marginal)
    }
}

/// The mean of a lognormal distribution with a median *m* and a standard deviation *d*.
///
/// ```text
/// mean = m √y,   y = [1 + √(1 + 4 d²/m²)]/2        from d² = m² y (y − 1), y = e^(σ²)
/// ```
fn lognormal_mean(median: f64, standard_deviation: f64) -> f64 {
    let ratio = standard_deviation / median;
    let y = f64::midpoint(1.0, (1.0 + 4.0 * ratio * ratio).sqrt());
    median * y.sqrt()
}
