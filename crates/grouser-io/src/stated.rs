//! What documents say of numbers that are not known exactly, as it is written.

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
}

/// Two keys that are correlated.
#[derive(Clone, Debug, Default)]
pub struct Pair {
    /// The two keys.
    pub between: [String; 2],
    /// Their correlation [-].
    pub value: f64,
}

impl Parameter {
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

    /// Its distribution, about a value unless it has a mean of its own.
    pub(crate) fn around(&self, value: f64) -> Marginal {
        let mut whole = self.clone();
        if let Some(mean) = whole.mean_mut().filter(|mean| mean.is_nan()) {
            *mean = value;
        }
        whole.marginal
    }
}
