//! Derivatives of answers by the numbers of their documents: of the answer as the documents are
//! written, with one model.

mod heading;
mod run;
mod wheel;

pub use self::heading::HeadingKeys;
pub use self::run::{RunDerivatives, RunKeys};
pub use self::wheel::{ChangedKeys, StandSetting, WheelKeys};

use std::ops::RangeInclusive;

use crate::difference::Variable;
use crate::document::varied::{Key, Numbers, meant};
use crate::soil::Span;

/// The keys that an answer is differentiated by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GradientKeys {
    /// Every number of its documents.
    All,
    /// These.
    These(Vec<String>),
}

/// A key that an answer is differentiated by.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedKey {
    /// The key, with the document that it stands in: `soil.friction_angle_deg`.
    pub name: String,
    /// Its number; nothing where the document lacks it.
    pub key: Option<Key>,
}

/// A key that no document of an answer has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no derivative by `{key}`: {reason}")]
pub struct NoSuchKey {
    /// The key, as it was asked for.
    pub key: String,
    /// What is wrong with it, and how it may be mended.
    pub reason: String,
}

impl GradientKeys {
    /// Stands for every number.
    pub const ALL: &'static str = "all";

    /// The keys of a list: `all` alone is every number.
    #[must_use]
    pub fn of(names: &[String]) -> Self {
        match names {
            [one] if one == Self::ALL => Self::All,
            names => Self::These(names.to_vec()),
        }
    }

    /// The keys as they were asked for.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::All => vec![Self::ALL.to_owned()],
            Self::These(names) => names.clone(),
        }
    }
}

impl AskedKey {
    /// The variable that a difference moves, in the key's unit; one that is not there goes nowhere.
    ///
    /// * `value`: where it stands, if not where the document has it
    fn variable(&self, value: Option<f64>) -> Variable {
        let Some(key) = &self.key else {
            return Variable { value: 0.0, scale: 1.0, range: Span::new(0.0, 0.0) };
        };
        let key = Key { value: value.unwrap_or(key.value), ..key.clone() };
        let range = Span::new(*key.range.start(), *key.range.end());
        Variable { value: key.value, scale: key.scale(), range }
    }

    /// A number that is set, and stands in no document.
    fn setting(name: &str, range: Option<RangeInclusive<f64>>) -> Self {
        let key = range.map(|range| Key { path: name.to_owned(), value: 0.0, range });
        Self { name: name.to_owned(), key }
    }
}

impl NoSuchKey {
    /// A name that is none of the known ones.
    fn among(name: &str, known: &[String]) -> Self {
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        Self { key: name.to_owned(), reason: meant(name, &known) }
    }
}

/// A key of a document, or that it lacks this one.
fn asked(name: &str, path: &str, document: &impl Numbers) -> Result<AskedKey, NoSuchKey> {
    let key = match document.key(path) {
        Ok(key) => Some(key),
        Err(none) if none.is_lacking => None,
        Err(none) => {
            let hint = none.hint.map_or_else(String::new, |hint| format!(": {hint}"));
            return Err(NoSuchKey {
                key: name.to_owned(),
                reason: format!("{}{hint}", none.problem),
            });
        }
    };
    Ok(AskedKey { name: name.to_owned(), key })
}
