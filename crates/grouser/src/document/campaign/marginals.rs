//! One number that is uncertain: what its section means, and that it can be.

use std::ops::RangeInclusive;

use super::super::error::{DocumentError, Problem};
use super::super::text::Node;
use super::sections::ParameterSection;
use crate::studies::uncertainty::Marginal;

/// A number of the base that is uncertain.
pub(super) struct Key {
    /// Its key, with the tables it stands in.
    pub(super) path: String,
    /// What the base says.
    pub(super) value: f64,
    /// What it may be.
    pub(super) range: RangeInclusive<f64>,
}

/// Of the draws of a key as many must be in its range [-]: with fewer, the distribution is far from
/// the one that was written down.
const LEAST_INSIDE: f64 = 0.01;

impl ParameterSection {
    /// The same with its mean, where it had none.
    pub(super) fn around(&self, value: f64) -> Self {
        let mut section = self.clone();
        if let Self::Normal { mean, .. } | Self::Lognormal { mean, .. } = &mut section {
            mean.get_or_insert(value);
        }
        section
    }

    /// Its distribution; one whose mean is known.
    pub(super) fn marginal(&self) -> Marginal {
        match *self {
            Self::Normal { mean, standard_deviation, .. } => {
                Marginal::Normal { mean: mean.unwrap_or_default(), standard_deviation }
            }
            Self::Lognormal { mean, standard_deviation, .. } => {
                Marginal::Lognormal { mean: mean.unwrap_or_default(), standard_deviation }
            }
            Self::Uniform { low, high, .. } => Marginal::Uniform { low, high },
            Self::Triangular { low, mode, high, .. } => Marginal::Triangular { low, mode, high },
        }
    }
}

/// That a distribution is one, and mostly in its key's range.
///
/// * `path`: where its section stands in the tree
pub(super) fn check_marginal(
    key: &Key,
    section: &ParameterSection,
    tree: &Node,
    path: &str,
) -> Result<(), DocumentError> {
    let at = |name: &str, problem| {
        Err(DocumentError::at(tree.origin_of(&format!("{path}.{name}")), problem))
    };
    let outside = |name: &str, value: f64, range: String| {
        at(name, Problem::OutOfRange { key: name.to_owned(), value, range })
    };
    match *section {
        ParameterSection::Lognormal { mean: Some(mean), .. } if mean <= 0.0 => {
            return outside("mean", mean, "above 0 to be lognormal".to_owned());
        }
        ParameterSection::Uniform { low, high, .. }
        | ParameterSection::Triangular { low, high, .. } => {
            for (name, value) in [("low", low), ("high", high)] {
                if !key.range.contains(&value) {
                    return at(name, out_of_range(&key.path, value, &key.range));
                }
            }
            if low >= high {
                return outside("high", high, format!("above low, {low}"));
            }
        }
        _ => {}
    }
    if let ParameterSection::Triangular { low, mode, high, .. } = *section
        && !(low..=high).contains(&mode)
    {
        return outside("mode", mode, format!("{low} to {high}"));
    }
    if section.marginal().share_within(&key.range) >= LEAST_INSIDE {
        return Ok(());
    }
    let range = format!("{} to {}", key.range.start(), key.range.end());
    at("key", Problem::OutsideRange { key: key.path.clone(), range })
}

/// A value outside its key's range.
pub(super) fn out_of_range(key: &str, value: f64, range: &RangeInclusive<f64>) -> Problem {
    let range = format!("{} to {}", range.start(), range.end());
    Problem::OutOfRange { key: key.to_owned(), value, range }
}
