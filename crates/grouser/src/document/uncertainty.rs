//! The `[uncertainty]` of a soil: how well its numbers are known, and the soils that they may be.
//!
//! It either names keys of the document with standard deviations and correlations, around the
//! values that the document gives, or a file of samples, a row for each. Both become an
//! [`UncertainSoil`], which makes a soil of a draw by putting the drawn numbers in the document's
//! place of them: a draw passes the same checks as the document itself.

use std::fmt::Write as _;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use super::check::range_at;
use super::error::{DocumentError, Problem};
use super::samples::SampleTable;
use super::schema::{paths_of, range, root};
use super::text::Node;
use super::values::{Described, Misfit};
use super::{Companion, Document, Kind, nearest};
use crate::soil::Soil;
use crate::studies::uncertainty::{Correlation, Distribution, Marginal, NothingAccepted};

/// How well the numbers of a soil are known: keys with standard deviations, or a file of samples.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct UncertaintySection {
    /// A CSV file of samples.
    pub samples: Option<String>,
    /// The keys that are uncertain, each around the value that the document gives it.
    pub parameter: Vec<UncertainParameter>,
    /// Correlations between them; pairs that are not named have none.
    pub correlation: Vec<CorrelationSection>,
}

/// A key that is uncertain.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct UncertainParameter {
    /// A number of the document, with the tables it stands in.
    pub key: String,
    /// Its standard deviation, in the unit of the key.
    pub standard_deviation: f64,
    /// Its distribution.
    pub distribution: DistributionWord,
}

/// The distribution of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum DistributionWord {
    /// Symmetric about its mean.
    Normal,
    /// Of a number above zero whose logarithm is normal.
    Lognormal,
}

/// How two keys go together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CorrelationSection {
    /// Two of the uncertain keys.
    pub between: [String; 2],
    /// Their correlation (of the logarithm, where a key is lognormal) [-].
    pub value: f64,
}

/// The soils that a document's numbers may be.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertainSoil {
    base: Soil,
    keys: Vec<UncertainKey>,
    distribution: Distribution,
    is_sampled: bool,
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

    /// Whether its uncertainty is a file of samples.
    #[must_use]
    pub fn is_sampled(&self) -> bool {
        self.is_sampled
    }

    /// The keys that differ from draw to draw.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(|key| key.path.as_str())
    }

    /// The soil with these values of its keys; `None` if one is outside its range.
    fn soil(&self, values: &[f64]) -> Option<Result<Soil, Misfit>> {
        let pairs = self.keys.iter().zip(values);
        // NaN is in no range.
        if !pairs.clone().all(|(key, value)| key.range.contains(value)) {
            return None;
        }
        Some(self.base.with(pairs.map(|(key, &value)| (&*key.path, value))))
    }
}

/// The soils that a document, or its soil, may be; none if it does not say how well it is known. The samples'
/// file is given the name that it has beside a resolved document.
///
/// * `place`: the key of the soil, or nothing
/// * `tree`: the soil's tree
pub(super) fn read(
    document: &mut Document,
    place: &str,
    tree: &Node,
    companions: &mut Vec<Companion>,
) -> Result<Option<UncertainSoil>, DocumentError> {
    let soil =
        if place.is_empty() { Some(document.clone()) } else { document.part(Kind::Soil, place) };
    let Some(soil) = soil else { return Ok(None) };
    let Some((soils, samples)) = understood(&soil, tree)? else { return Ok(None) };
    if let Some(content) = samples {
        let name = SAMPLES_FILE.to_owned();
        *document = document.changed(|keys| {
            let soil = if place.is_empty() { Some(keys) } else { keys[place].as_object_mut() };
            if let Some(samples) = soil.and_then(|soil| soil["uncertainty"].get_mut("samples")) {
                *samples = name.clone().into();
            }
        });
        companions.push(Companion { name, content });
    }
    Ok(Some(soils))
}

impl UncertaintySection {
    /// What a soil says of it.
    pub(super) fn of(soil: &Document) -> Option<Self> {
        serde_json::from_value(soil.get("uncertainty")?.clone()).ok()
    }

    /// The uncertainty of a soil with a file of samples beside it.
    pub(super) fn of_samples(file: &str) -> Json {
        serde_json::json!({ "samples": file })
    }
}

/// Finds out what is meant, and that it can be: the soils, and the file of their samples.
///
/// * `tree`: of the soil
pub(super) fn understood(
    soil: &Document,
    tree: &Node,
) -> Result<Option<(UncertainSoil, Option<String>)>, DocumentError> {
    let Some(section) = UncertaintySection::of(soil) else { return Ok(None) };
    let reader = Reader { tree, numbers: numbers(soil), base: Soil::of(soil) };
    let table = match &section.samples {
        Some(_) if !section.parameter.is_empty() || !section.correlation.is_empty() => {
            let problem = Problem::Conflict(
                "`uncertainty` has `samples` and `parameter` or `correlation`: it is one or the other",
            );
            return Err(DocumentError::at(tree.origin_of("uncertainty.samples"), problem));
        }
        None if section.parameter.is_empty() => {
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
        None => reader.stated(&section)?,
    };
    let soils =
        UncertainSoil { base: reader.base, keys, distribution, is_sampled: table.is_some() };
    match &table {
        Some(table) => check_rows(&soils, table)?,
        None => check_first_draw(&soils, tree)?,
    }
    Ok(Some((soils, table.map(SampleTable::into_content))))
}

/// A soil without its uncertainty, whose numbers are not the soil's.
pub(super) fn numbers(soil: &Document) -> Document {
    soil.changed(|keys| drop(keys.shift_remove("uncertainty")))
}

/// What a misspelt key was meant to be, or all that it could have been.
pub(super) fn meant(name: &str, known: &[&str]) -> String {
    let same_end = known.iter().copied().find(|key| key.rsplit('.').next() == Some(name));
    match same_end.or_else(|| nearest(name, known.iter().copied())) {
        Some(key) => format!("did you mean `{key}`?"),
        None => format!("there are {}", known.join(", ")),
    }
}

/// The same among the numbers of a soil.
pub(super) fn meant_number(soil: &Document, name: &str) -> String {
    let known = soil.number_keys();
    meant(name, &known.iter().map(String::as_str).collect::<Vec<_>>())
}

/// That draws can be had: one that takes too many tries here takes them everywhere.
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
        if let Some(Err(misfit)) = soils.soil(row) {
            return Err(DocumentError::at(&table.row_origin(index), *misfit.problem));
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
    numbers: Document,
    base: Soil,
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
        if let Some(value) = self.numbers.number(path) {
            // A table that the document leaves out has its default, and the widest range will do.
            let range = range_at(Kind::Soil, self.tree, path).or_else(|| range(Kind::Soil, path));
            let range = range.unwrap_or(f64::MIN..=f64::MAX);
            return Ok((UncertainKey { path: path.to_owned(), range }, value));
        }
        let key = path.escape_debug().to_string();
        let steps = path.split('.').try_fold(self.tree, |node, step| Some(&node.entry(step)?.node));
        if steps.is_some() {
            return Err(NoNumber { problem: Problem::NotANumber { key }, hint: None });
        }
        let last = path.rsplit('.').next().unwrap_or(path);
        let is_known = paths_of(root(Kind::Soil), last).iter().any(|known| known == path);
        let hint = if is_known {
            "the document gives this key no value: give it one first, if its law has the key"
                .to_owned()
        } else {
            meant_number(&self.numbers, path)
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
