//! The `[uncertainty]` of a soil: how well its numbers are known, and the soils that they may be.
//!
//! It either names keys of the document with standard deviations and correlations, around the
//! values that the document gives, or a file of samples, a row for each. Both become an
//! [`UncertainSoil`], which makes a soil of a draw by putting the drawn numbers in the document's
//! place of them: a draw passes the same checks as the document itself.

use std::fmt::Write as _;
use std::ops::RangeInclusive;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::range_at;
use super::error::{DocumentError, Problem};
use super::samples::SampleTable;
use super::schema::{json, paths_of, range};
use super::soil::SoilDocument;
use super::soil_numbers::{SoilNumbers, lookup, meant};
use super::text::Node;
use super::{Companion, Kind};
use crate::error::ParameterError;
use crate::soil::Soil;
use crate::studies::uncertainty::{Correlation, Distribution, Marginal, NothingAccepted};

/// How well the numbers of a soil are known: keys with standard deviations, or a file of samples.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UncertaintySection {
    /// A CSV file of samples, from the folder of this document: columns are keys, rows are samples.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub samples: Option<String>,
    /// The keys that are uncertain, each around the value that the document gives it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parameter: Vec<UncertainParameter>,
    /// Correlations between them; pairs that are not named have none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlation: Vec<CorrelationSection>,
    /// What that means, once the document is read.
    #[serde(skip)]
    pub(super) meaning: Option<Arc<Meaning>>,
}

/// A key that is uncertain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UncertainParameter {
    /// A number of this document, with the tables it stands in: `pressure_sinkage.k_phi`.
    pub key: String,
    /// Its standard deviation, in the unit of the key.
    #[schemars(range(min = 0.0, max = 1e12))]
    pub standard_deviation: f64,
    /// Its distribution; the value in the document is its mean.
    #[serde(default)]
    pub distribution: DistributionWord,
}

/// The distribution of a key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DistributionWord {
    /// Symmetric about its mean.
    #[default]
    Normal,
    /// Of a number above zero whose logarithm is normal.
    Lognormal,
}

/// How two keys go together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CorrelationSection {
    /// Two of the uncertain keys.
    pub between: [String; 2],
    /// Their correlation (of the logarithm, where a key is lognormal) [-].
    #[schemars(range(min = -1.0, max = 1.0))]
    pub value: f64,
}

/// What an uncertainty means.
#[derive(Debug, PartialEq)]
pub(super) struct Meaning {
    soils: UncertainSoil,
    /// The samples' file as it was read.
    samples: Option<String>,
}

/// The soils that a document's numbers may be.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainSoil {
    numbers: SoilNumbers,
    keys: Vec<UncertainKey>,
    distribution: Distribution,
}

/// A number of a document and where it may lie.
#[derive(Clone, Debug, PartialEq)]
struct UncertainKey {
    path: String,
    range: RangeInclusive<f64>,
}

/// The name of the samples' file beside a resolved document.
pub const SAMPLES_FILE: &str = "soil-samples.csv";

impl UncertainSoil {
    /// Soil number `index`, which depends on the seed and that number alone. Draws outside the
    /// range of a key, or that are no soil together, are drawn again.
    ///
    /// # Errors
    /// [`NothingAccepted`] if that does not end.
    pub fn draw(&self, seed: u64, index: u64) -> Result<Soil, NothingAccepted> {
        self.distribution.draw(seed, index, |values| self.soil(values)?.ok())
    }

    /// The keys that differ from draw to draw.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|key| key.path.as_str())
    }

    /// The soil with these values of its keys; `None` if one is outside its range.
    fn soil(&self, values: &[f64]) -> Option<Result<Soil, ParameterError>> {
        let pairs = self.keys.iter().zip(values);
        // NaN is in no range.
        if !pairs.clone().all(|(key, value)| key.range.contains(value)) {
            return None;
        }
        let document = self.numbers.with(pairs.map(|(key, &value)| (&*key.path, value)))?;
        Some(document.meaning().map_err(|misfit| misfit.error))
    }
}

impl UncertaintySection {
    /// The uncertainty of a document with a file of samples beside it.
    pub(super) fn of_samples(file: &str) -> Self {
        Self { samples: Some(file.to_owned()), ..Self::default() }
    }

    /// The soils that are meant; there are some once the document is read.
    pub(super) fn soils(&self) -> Option<&UncertainSoil> {
        self.meaning.as_ref().map(|meaning| &meaning.soils)
    }

    /// The samples' file under the name that the resolved document gives it.
    pub(super) fn companion(&self) -> Option<Companion> {
        let content = self.meaning.as_ref()?.samples.clone()?;
        Some(Companion { name: SAMPLES_FILE.to_owned(), content })
    }

    /// Finds out what is meant, and that it can be.
    ///
    /// * `soil`: the document that this is a section of
    /// * `tree`: its tree
    pub(super) fn prepare(
        &mut self,
        soil: &SoilDocument,
        tree: &Node,
    ) -> Result<(), DocumentError> {
        let reader = Reader { tree, numbers: SoilNumbers::of(soil) };
        let table = match &self.samples {
            Some(_) if !self.parameter.is_empty() || !self.correlation.is_empty() => {
                let problem = Problem::Conflict(
                    "`uncertainty` has `samples` and `parameter` or `correlation`: it is one or the other",
                );
                return Err(DocumentError::at(tree.origin_of("uncertainty.samples"), problem));
            }
            None if self.parameter.is_empty() => {
                let problem = Problem::MissingKey { key: "uncertainty.parameter".to_owned() };
                let hint = "name keys with their standard deviations, or a file of samples: \
                            samples = \"posterior.csv\"";
                return Err(DocumentError::at(tree.origin_of("uncertainty"), problem)
                    .with_hint(hint.to_owned()));
            }
            None => None,
            Some(name) => Some(SampleTable::read(name, tree.origin_of("uncertainty.samples"))?),
        };
        let (keys, distribution) = match &table {
            Some(table) => reader.sampled(table)?,
            None => reader.stated(self)?,
        };
        let soils = UncertainSoil { numbers: reader.numbers, keys, distribution };
        match &table {
            Some(table) => check_rows(&soils, table)?,
            None => check_first_draw(&soils, tree)?,
        }
        self.samples = self.samples.take().map(|_| SAMPLES_FILE.to_owned());
        let samples = table.map(SampleTable::into_content);
        self.meaning = Some(Arc::new(Meaning { soils, samples }));
        Ok(())
    }
}

/// That draws can be had: one that takes too many tries at the door takes them everywhere.
fn check_first_draw(soils: &UncertainSoil, tree: &Node) -> Result<(), DocumentError> {
    soils.draw(0, 0).map(drop).map_err(|error| {
        let mut ranges = String::new();
        for UncertainKey { path, range } in &soils.keys {
            let separator = if ranges.is_empty() { "" } else { ", " };
            // Writing to a string does not fail.
            let _ = write!(ranges, "{separator}`{path}` {} to {}", range.start(), range.end());
        }
        let hint = format!("a draw has to lie within the ranges of its keys: {ranges}");
        DocumentError::at(tree.origin_of("uncertainty"), Problem::NoDraws(error)).with_hint(hint)
    })
}

/// That each row of a table is a soil.
fn check_rows(soils: &UncertainSoil, table: &SampleTable) -> Result<(), DocumentError> {
    for (index, row) in table.rows().iter().enumerate() {
        if let Some(Err(error)) = soils.soil(row) {
            return Err(DocumentError::at(&table.row_origin(index), Problem::Unfit(error)));
        }
    }
    Ok(())
}

/// Correlations by the places of their keys, added to those that there are already.
///
/// * `keys`: all that may be correlated
/// * `path`: where the sections stand in the tree
pub(super) fn correlations(
    sections: &[CorrelationSection],
    keys: &[&str],
    tree: &Node,
    path: &str,
    mut all: Vec<Correlation>,
) -> Result<Vec<Correlation>, DocumentError> {
    for (index, CorrelationSection { between, value }) in sections.iter().enumerate() {
        let path = format!("{path}.{index}.between");
        let mut places = [0; 2];
        for (end, name) in between.iter().enumerate() {
            let found = keys.iter().position(|key| key == name);
            places[end] = found.ok_or_else(|| {
                let problem = Problem::NotUncertain { key: name.clone() };
                let origin = tree.origin_of(&format!("{path}.{end}"));
                DocumentError::at(origin, problem).with_hint(meant(name, keys))
            })?;
        }
        places.sort_unstable();
        let origin = tree.origin_of(&path);
        if places[0] == places[1] {
            let problem = Problem::Conflict("a key has no correlation with itself");
            return Err(DocumentError::at(origin, problem));
        }
        if all.iter().any(|other| other.between == places) {
            let name = between.join(", ");
            return Err(DocumentError::at(origin, Problem::RepeatedName { key: path, name }));
        }
        all.push(Correlation { between: places, value: *value });
    }
    Ok(all)
}

/// Reads an uncertainty beside the document it is of.
struct Reader<'a> {
    tree: &'a Node,
    numbers: SoilNumbers,
}

impl Reader<'_> {
    /// Keys with standard deviations and correlations.
    fn stated(
        &self,
        section: &UncertaintySection,
    ) -> Result<(Vec<UncertainKey>, Distribution), DocumentError> {
        let mut keys: Vec<UncertainKey> = Vec::new();
        let mut marginals = Vec::new();
        for (index, parameter) in section.parameter.iter().enumerate() {
            let path = format!("uncertainty.parameter.{index}.key");
            let origin = self.tree.origin_of(&path);
            let (key, mean) = self.key(&parameter.key).map_err(|told| told.at(origin))?;
            if keys.contains(&key) {
                let problem = Problem::RepeatedName { key: path, name: key.path };
                return Err(DocumentError::at(origin, problem));
            }
            let standard_deviation = parameter.standard_deviation;
            let marginal = match parameter.distribution {
                DistributionWord::Normal => Marginal::Normal { mean, standard_deviation },
                DistributionWord::Lognormal if mean > 0.0 => {
                    Marginal::Lognormal { mean, standard_deviation }
                }
                DistributionWord::Lognormal => {
                    let range = "above 0 to be lognormal".to_owned();
                    let problem = Problem::OutOfRange { key: key.path, value: mean, range };
                    return Err(DocumentError::at(origin, problem));
                }
            };
            keys.push(key);
            marginals.push(marginal);
        }
        let names: Vec<&str> = keys.iter().map(|key| key.path.as_str()).collect();
        let place = "uncertainty.correlation";
        let correlations =
            correlations(&section.correlation, &names, self.tree, place, Vec::new())?;
        let distribution =
            Distribution::of_marginals(marginals, &correlations).map_err(|error| {
                let origin = self.tree.origin_of("uncertainty.correlation");
                DocumentError::at(origin, Problem::Contradiction(error)).with_hint(
                    "pairs that are not named have none, and ±1 is too much for any: name the \
                     pairs between, or make the others smaller"
                        .to_owned(),
                )
            })?;
        Ok((keys, distribution))
    }

    /// A table of samples.
    fn sampled(
        &self,
        table: &SampleTable,
    ) -> Result<(Vec<UncertainKey>, Distribution), DocumentError> {
        let mut keys: Vec<UncertainKey> = Vec::new();
        for (column, name) in table.columns().iter().enumerate() {
            let origin = table.column_origin(column);
            let (key, _) = self.key(name).map_err(|told| told.at(&origin))?;
            if keys.contains(&key) {
                let problem = Problem::RepeatedName { key: "column".to_owned(), name: key.path };
                return Err(DocumentError::at(&origin, problem));
            }
            keys.push(key);
        }
        for (index, row) in table.rows().iter().enumerate() {
            let outside = keys.iter().zip(row).position(|(key, value)| !key.range.contains(value));
            if let Some(column) = outside {
                let UncertainKey { path: key, range } = keys[column].clone();
                let range = format!("{} to {}", range.start(), range.end());
                let problem = Problem::OutOfRange { key, value: row[column], range };
                return Err(DocumentError::at(&table.cell_origin(index, column), problem));
            }
        }
        Ok((keys, Distribution::of_samples(table.rows().to_vec())))
    }

    /// A number of the document, and its value.
    fn key(&self, path: &str) -> Result<(UncertainKey, f64), NoNumber> {
        if let Some(value) = self.numbers.value(path) {
            // A table that the document leaves out has its default, and the widest range will do.
            let range = range_at(Kind::Soil, self.tree, path).or_else(|| range(Kind::Soil, path));
            let range = range.unwrap_or(f64::MIN..=f64::MAX);
            return Ok((UncertainKey { path: path.to_owned(), range }, value));
        }
        let key = path.escape_debug().to_string();
        if lookup(&self.tree.to_toml(), path).is_some() {
            return Err(NoNumber { problem: Problem::NotANumber { key }, hint: None });
        }
        let last = path.rsplit('.').next().unwrap_or(path);
        let is_known = paths_of(json(Kind::Soil), last).iter().any(|known| known == path);
        let hint = if is_known {
            "the document gives this key no value: give it one first, if its law has the key"
                .to_owned()
        } else {
            self.numbers.meant(path)
        };
        Err(NoNumber { problem: Problem::UnknownKey { key }, hint: Some(hint) })
    }
}

/// Why a key cannot be uncertain.
struct NoNumber {
    problem: Problem,
    hint: Option<String>,
}

impl NoNumber {
    fn at(self, origin: &super::text::Origin) -> DocumentError {
        DocumentError::at(origin, self.problem).with_hint(self.hint)
    }
}
