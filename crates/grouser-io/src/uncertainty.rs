//! Reads the uncertain numbers of soils and campaigns.
//!
//! A document names keys with distributions and correlations, or rows of samples; [`Stated`] is
//! that as it is written. [`Inputs::read`] checks it against the numbers that it is about, and
//! makes a [`Distribution`] of it.

use super::error::{DocumentError, Problem};
use super::samples::SampleTable;
pub use super::stated::{Pair, Parameter, Samples, Stated};
use super::tree::{Node, Origin};
use super::varied::{Key, Numbers, meant};
use crate::statistics::{Contradiction, Correlation, Distribution, Marginal};

/// The uncertain numbers of one place.
pub struct Statement<'a> {
    /// What is stated there.
    pub stated: &'a Stated,
    /// The document in which it stands.
    pub tree: &'a Node,
    /// The table in which it stands, with a dot; nothing for the document itself.
    pub table: &'static str,
    /// What its keys begin with among the numbers that it is about.
    pub prefix: &'static str,
    /// Whether it gives way where another states the same key, as priors do.
    pub yields: bool,
}

/// The uncertain numbers, checked.
#[derive(Debug)]
pub struct Inputs {
    /// Those of the parameters, then those of the samples.
    pub keys: Vec<Key>,
    /// How many of them are parameters.
    pub parameters: usize,
    /// Whether some of them are correlated.
    pub is_correlated: bool,
    /// The table of samples, and what its keys begin with.
    pub samples: Option<(SampleTable, &'static str)>,
    /// Distribution of the keys' values.
    pub distribution: Distribution,
}

/// Least share of a key's values that must be in its range [-]: with fewer, the distribution is far
/// from the one that was written down.
const LEAST_INSIDE: f64 = 0.01;

impl Inputs {
    /// Collects and checks the statements on some numbers.
    ///
    /// # Errors
    /// [`DocumentError`] for keys that are no numbers, distributions outside their ranges,
    /// impossible correlations, and samples that cannot be read.
    pub fn read(
        numbers: &dyn Numbers,
        statements: &[Statement<'_>],
    ) -> Result<Self, DocumentError> {
        let mut rows = Rows::default();
        for statement in statements.iter().filter(|it| !it.yields) {
            rows.add(numbers, statement, &[])?;
        }
        let sampled = Sampled::read(numbers, statements, &rows.keys)?;
        for statement in statements.iter().filter(|it| it.yields) {
            rows.add(numbers, statement, &sampled.keys)?;
        }
        let correlations = correlations(statements, &rows.keys)?;
        let mut distribution = Distribution::of_marginals(rows.marginals, &correlations)
            .map_err(|error| contradiction(statements, error))?;
        if let Some((table, _)) = &sampled.table {
            distribution = distribution.and(table.distribution());
        }
        Ok(Self {
            parameters: rows.keys.len(),
            keys: rows.keys.into_iter().chain(sampled.keys).collect(),
            is_correlated: !correlations.is_empty(),
            samples: sampled.table,
            distribution,
        })
    }

    /// The same, each parameter cut off at the ends of its key's range.
    #[must_use]
    pub fn cut(mut self) -> Self {
        let ranges: Vec<_> = self.keys.iter().map(|key| key.range.clone()).collect();
        self.distribution = self.distribution.within(&ranges);
        self
    }
}

/// Keys with distributions.
#[derive(Default)]
struct Rows {
    keys: Vec<Key>,
    marginals: Vec<Marginal>,
}

impl Rows {
    /// Adds those of a statement; of one that yields, those that are not there yet.
    ///
    /// * `sampled`: keys that rows of samples have
    fn add(
        &mut self,
        numbers: &dyn Numbers,
        statement: &Statement<'_>,
        sampled: &[Key],
    ) -> Result<(), DocumentError> {
        for (place, parameter) in statement.stated.parameters.iter().enumerate() {
            let path = format!("parameter.{place}");
            let key_path = format!("{path}.key");
            let origin = statement.origin(&key_path);
            let key =
                numbers.key(&statement.named(&parameter.key)).map_err(|error| error.at(origin))?;
            let mut others = self.keys.iter().chain(sampled);
            if statement.yields && others.any(|other| other.path == key.path) {
                continue;
            }
            check_new(&self.keys, &key, origin, &format!("{}{key_path}", statement.table))?;
            let marginal = parameter.around(key.value);
            let is_around_value = parameter.has_no_mean();
            check_marginal(&key, &marginal, is_around_value).map_err(|(name, problem)| {
                DocumentError::at(statement.origin(&format!("{path}.{name}")), problem)
            })?;
            self.keys.push(key);
            self.marginals.push(marginal);
        }
        Ok(())
    }
}

/// Keys with rows of samples.
#[derive(Default)]
struct Sampled {
    keys: Vec<Key>,
    table: Option<(SampleTable, &'static str)>,
}

impl Sampled {
    /// * `others`: keys with distributions, which must be others
    fn read(
        numbers: &dyn Numbers,
        statements: &[Statement<'_>],
        others: &[Key],
    ) -> Result<Self, DocumentError> {
        let mut sampled = Self::default();
        for statement in statements {
            let origin = statement.origin("samples");
            let table = match &statement.stated.samples {
                None => continue,
                Some(_) if sampled.table.is_some() => {
                    let problem = Problem::Conflict(
                        "the soil's uncertainty is a table of samples, too: it is one or the other",
                    );
                    return Err(DocumentError::at(origin, problem));
                }
                Some(Samples::File(name)) => SampleTable::read(name, origin)?,
                Some(Samples::Inline(csv)) => {
                    let label = format!("{}, samples", origin.text.label);
                    SampleTable::of_text(label, csv.clone())?
                }
            };
            for (column, name) in table.columns().iter().enumerate() {
                let origin = table.column_origin(column);
                let key = numbers.key(&statement.named(name)).map_err(|error| error.at(&origin))?;
                check_new(others, &key, &origin, "column")?;
                check_new(&sampled.keys, &key, &origin, "column")?;
                sampled.keys.push(key);
            }
            check_rows(numbers, &sampled.keys, &table)?;
            sampled.table = Some((table, statement.prefix));
        }
        Ok(sampled)
    }
}

impl Statement<'_> {
    fn origin(&self, path: &str) -> &Origin {
        self.tree.origin_of(&format!("{}{path}", self.table))
    }

    /// A key of it among the numbers that it is about.
    fn named(&self, key: &str) -> String {
        format!("{}{key}", self.prefix)
    }
}

/// Checks that a key is not uncertain twice.
///
/// * `path`: what messages call the place in which it is
fn check_new(keys: &[Key], key: &Key, origin: &Origin, path: &str) -> Result<(), DocumentError> {
    if keys.iter().all(|other| other.path != key.path) {
        return Ok(());
    }
    let problem = Problem::RepeatedName { key: path.to_owned(), name: key.path.clone() };
    Err(DocumentError::at(origin, problem))
}

/// Checks that a distribution is valid, and mostly in its key's range; the error has the name of
/// the number that is wrong.
///
/// * `is_around_value`: whether its mean is the key's value
fn check_marginal(
    key: &Key,
    marginal: &Marginal,
    is_around_value: bool,
) -> Result<(), (&'static str, Problem)> {
    let outside = |name: &'static str, value: f64, range: String| {
        Err((name, Problem::OutOfRange { key: name.to_owned(), value, range }))
    };
    match *marginal {
        Marginal::Lognormal { mean, .. } if mean <= 0.0 => {
            let (name, number) =
                if is_around_value { ("key", &*key.path) } else { ("mean", "mean") };
            let range = "above 0 to be lognormal".to_owned();
            return Err((name, Problem::OutOfRange { key: number.to_owned(), value: mean, range }));
        }
        Marginal::Uniform { low, high } | Marginal::Triangular { low, high, .. } => {
            for (name, value) in [("low", low), ("high", high)] {
                if !key.range.contains(&value) {
                    return Err((name, key.out_of_range(value)));
                }
            }
            if low >= high {
                return outside("high", high, format!("above low, {low}"));
            }
        }
        _ => {}
    }
    if let Marginal::Triangular { low, mode, high } = *marginal
        && !(low..=high).contains(&mode)
    {
        return outside("mode", mode, format!("{low} to {high}"));
    }
    if marginal.share_within(&key.range) >= LEAST_INSIDE {
        return Ok(());
    }
    let range = key.range_in_words();
    Err(("key", Problem::OutsideRange { key: key.path.clone(), range }))
}

/// Correlations by the places of their keys.
fn correlations(
    statements: &[Statement<'_>],
    keys: &[Key],
) -> Result<Vec<Correlation>, DocumentError> {
    let names: Vec<&str> = keys.iter().map(|key| &*key.path).collect();
    let mut all: Vec<Correlation> = Vec::new();
    for statement in statements {
        for (index, Pair { between, value }) in statement.stated.correlations.iter().enumerate() {
            let path = format!("correlation.{index}.between");
            let mut places = [0; 2];
            let is_uncertain = |name: &String| names.contains(&&*statement.named(name));
            if statement.yields && !between.iter().all(is_uncertain) {
                continue;
            }
            for (end, name) in between.iter().enumerate() {
                let name = statement.named(name);
                let found = names.iter().position(|key| **key == *name);
                places[end] = found.ok_or_else(|| {
                    let hint = meant(&name, &names);
                    let origin = statement.origin(&format!("{path}.{end}"));
                    DocumentError::at(origin, Problem::NotUncertain { key: name }).with_hint(hint)
                })?;
            }
            places.sort_unstable();
            let problem = if places[0] == places[1] {
                Problem::Conflict("a key has no correlation with itself")
            } else if all.iter().any(|other| other.between == places) {
                let key = format!("{}{path}", statement.table);
                Problem::RepeatedName { key, name: between.join(", ") }
            } else {
                all.push(Correlation { between: places, value: *value });
                continue;
            };
            return Err(DocumentError::at(statement.origin(&path), problem));
        }
    }
    Ok(all)
}

/// Correlations that no values can have, where the last of them are stated.
fn contradiction(statements: &[Statement<'_>], error: Contradiction) -> DocumentError {
    let stating = |it: &&Statement<'_>| !it.stated.correlations.is_empty();
    // Without stated correlations there is no contradiction; priors are the last to blame.
    let own = statements.iter().filter(|it| !it.yields).rfind(stating);
    let origin = own.or(statements.iter().rfind(stating)).unwrap_or(&statements[0]);
    let origin = origin.origin("correlation");
    DocumentError::at(origin, Problem::Contradiction(error)).with_hint(
        "pairs that are not named have none, and ±1 is too much for any: name the pairs between, \
         or make the others smaller"
            .to_owned(),
    )
}

/// Checks that each row of a table is in the ranges of its keys, and possible together.
fn check_rows(
    numbers: &dyn Numbers,
    keys: &[Key],
    table: &SampleTable,
) -> Result<(), DocumentError> {
    for (index, row) in table.rows().iter().enumerate() {
        let outside = keys.iter().zip(row).position(|(key, value)| !key.range.contains(value));
        if let Some(column) = outside {
            let problem = keys[column].out_of_range(row[column]);
            return Err(DocumentError::at(&table.cell_origin(index, column), problem));
        }
        numbers
            .check_with(keys, row)
            .map_err(|misfit| DocumentError::at(&table.row_origin(index), *misfit.problem))?;
    }
    Ok(())
}
