//! What a soil does not state is taken from priors: the median in a single answer, samples in a
//! band.
//!
//! A prior document (`prior/1`) has rows for numbers that a soil leaves out, for keywords, and for
//! how well stated numbers are known. [`fill`] puts medians and keywords into a soil's tree before
//! it is checked, and leaves those rows beside it that hold for this soil: a resolved document has
//! them as its `priors`, so that it gives the same soil and the same samples when it is read again.
//! [`stated_by_priors`] makes distributions of them.

use std::sync::Arc;

use serde_json::Value as Json;

use super::check::keys_at;
use super::describe::prior::PRIORS;
use super::describe::uncertainty::UNCERTAINTY;
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::Inner as _;
use super::kind::{Kind, PRIORS_KEY as KEY};
use super::schema::range;
use super::stated::{Pair, Parameter, Priors, Soils, Stated};
use super::tree::{Entry, Node, Origin, Text, Value, number};
use crate::statistics::Marginal;

/// A number, or a keyword, of a soil that its document does not state.
///
/// What does the soil `dry-sand` not say, and which wheel sinkage ratio does a single answer take?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_soil};
///
/// let sand = read_soil(&Source::find(Kind::Soil, "dry-sand")?, &Overrides::none())?;
/// let ratio = sand.assumed.iter().find(|it| it.key == "exit.ratio").expect("it is not printed");
/// assert_eq!(ratio.prior, "General priors");
/// assert_eq!(format!("{:.3}", ratio.value.expect("a number")), "0.293");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Assumed {
    /// Its key in the soil's document, with the tables it stands in.
    pub key: String,
    /// The name of the priors that it is taken from.
    pub prior: String,
    /// What a single answer takes, in the key's unit: the prior's median; nothing for a keyword.
    pub value: Option<f64>,
}

/// What a soil takes from priors, in the order of their rows; empty if it states everything.
///
/// * `soil`: its resolved document
#[must_use]
pub fn assumed(soil: &Document) -> Vec<Assumed> {
    let prior = soil.text("priors.name").unwrap_or_default();
    let keys = |list: &str| {
        let rows = soil.get(&format!("{KEY}.{list}")).and_then(Json::as_array);
        rows.into_iter().flatten().filter_map(|row| row.get("key")?.as_str())
    };
    let one = |key: &str| Assumed {
        key: key.to_owned(),
        prior: prior.to_owned(),
        value: soil.number(key),
    };
    keys("missing").chain(keys("keyword")).map(one).collect()
}

/// The distributions that a soil's priors give to numbers that it does not state, or states without
/// their spread.
///
/// * `soil`: its resolved document
#[must_use]
pub fn stated_by_priors(soil: &Document) -> Stated {
    let priors = soil.get(KEY).map_or_else(Priors::default, priors_of);
    let rows = priors.missing.iter().chain(&priors.stated).filter_map(|row| {
        let reference = match &*row.belief.relative_to {
            "" => 1.0,
            key => soil.number(key)?,
        };
        let marginal =
            row.scaled(soil.number(&row.key), reference, &range(Kind::Soil, &row.key)?)?;
        Some(Parameter { key: row.key.clone(), marginal, ..Parameter::blank() })
    });
    Stated { samples: None, parameters: rows.collect(), correlations: priors.correlations }
}

/// A soil some of whose numbers were measured: they are no longer the priors'.
///
/// * `keys`: of those numbers
#[must_use]
pub fn without_priors_of(soil: &Document, keys: &[&str]) -> Document {
    let is_kept = |row: &Json| {
        let text = |key: &Json| key.as_str().is_some_and(|key| keys.contains(&key));
        let between = row.get("between").and_then(Json::as_array);
        !row.get("key").is_some_and(text) && !between.into_iter().flatten().any(text)
    };
    with_rows(soil, |_, rows| rows.retain(is_kept))
}

/// A soil whose numbers belong to samples that were found with them: what is the priors' stays at
/// its value, and what is stated is exact.
#[must_use]
pub fn with_priors_held(soil: &Document) -> Document {
    let held = |row: &Json| {
        let key = row.get("key")?.as_str()?;
        let marginal = Marginal::Normal { mean: soil.number(key)?, standard_deviation: 0.0 };
        Some(Parameter { marginal, ..Parameter::blank() }.to_json(key))
    };
    with_rows(soil, |list, rows| match list {
        "missing" => *rows = rows.iter().filter_map(held).collect(),
        "keyword" => {}
        _ => rows.clear(),
    })
}

/// A soil with other rows of priors.
///
/// * `change`: gets the name of a list, and its rows
fn with_rows(soil: &Document, mut change: impl FnMut(&str, &mut Vec<Json>)) -> Document {
    soil.changed(|keys| {
        let lists = keys.get_mut(KEY).and_then(Json::as_object_mut).into_iter().flatten();
        for (list, rows) in lists {
            if let Json::Array(rows) = rows {
                change(list, rows);
            }
        }
    })
}

fn priors_of(given: &Json) -> Priors {
    let mut priors = Priors::default();
    PRIORS.put(&mut priors, given);
    priors
}

// ---- The tree of a soil ----

/// Puts into a soil's tree what it leaves out and its priors have, and leaves those rows of the
/// priors that hold for it.
///
/// * `is_resolved`: whether the soil itself has the rows: then a number that it states and they
///   call missing is the priors', unless it was set from outside
pub(crate) fn fill(tree: &mut Node, is_resolved: bool) {
    let Some(entry) = tree.entry(KEY) else { return };
    let (rows, mut kept) = (priors_of(&entry.node.to_json()), entry.node.clone());
    let name = match kept.entry("name").map(|entry| &entry.node.value) {
        Some(Value::String(name)) => name.clone(),
        _ => "its priors".to_owned(),
    };
    let given_in = tree.origin.text.clone();
    let missing = Vec::new();
    let mut soil = Filled { written: tree.clone(), tree, name, given_in, is_resolved, missing };
    let own = soil.take_own();
    keep(&mut kept, "missing", rows.missing.iter().map(|row| soil.takes(row, &own)));
    keep(
        &mut kept,
        "keyword",
        rows.keywords.iter().map(|row| soil.takes_word(&row.key, &row.word, &row.reason)),
    );
    // Samples belong to the soil's other numbers as they are, unless its own rows say otherwise.
    let is_exact = !is_resolved && at(&soil.written, "uncertainty.samples").is_some();
    let mut stated: Vec<&str> = Vec::new();
    for row in &rows.stated {
        // Of several rows for a key the first that applies is taken.
        let is_first = !stated.contains(&&*row.key);
        let is_kept = is_first && !is_exact && soil.is_stated(row, &own);
        stated.push(if is_kept { &row.key } else { "" });
    }
    keep(&mut kept, "stated", stated.iter().map(|key| !key.is_empty()));
    let is_kept = |key: &String| stated.contains(&&**key) || soil.missing.contains(key);
    let are_kept = |pair: &Pair| pair.between.iter().all(is_kept);
    keep(&mut kept, "correlation", rows.correlations.iter().map(are_kept));
    if let Value::Table(entries) = &mut kept.value {
        entries.retain(|entry| !["source", "notes"].contains(&&*entry.key));
    }
    if let Some(entry) = tree.entry_mut(KEY) {
        entry.node = kept;
    }
}

/// Keeps some rows of a list, without the conditions that they meet and without their reasons.
fn keep(priors: &mut Node, list: &str, is_kept: impl Iterator<Item = bool>) {
    const DROPPED: [&str; 5] = ["soils", "unless", "when", "reason", "source"];
    let mut is_kept = is_kept.collect::<Vec<_>>().into_iter();
    let Some(Value::List(nodes)) = priors.entry_mut(list).map(|entry| &mut entry.node.value) else {
        return;
    };
    nodes.retain_mut(|row| {
        if let Value::Table(entries) = &mut row.value {
            entries.retain(|entry| !DROPPED.contains(&&*entry.key));
        }
        is_kept.next().unwrap_or(false)
    });
}

/// A soil's tree while it is filled.
struct Filled<'t> {
    /// The soil, as its author wrote it.
    written: Node,
    tree: &'t mut Node,
    /// The name of its priors.
    name: String,
    /// The text that has the soil.
    given_in: Arc<Text>,
    is_resolved: bool,
    /// The keys that are the priors'.
    missing: Vec<String>,
}

impl Filled<'_> {
    /// Numbers that the soil's own `[uncertainty]` has a distribution for, and no value: they get
    /// its median. The keys of all its distributions.
    fn take_own(&mut self) -> Vec<String> {
        let Some(entry) = self.tree.entry("uncertainty") else { return Vec::new() };
        let (given, origin) = (entry.node.to_json(), entry.key_origin.clone());
        let mut own = Stated::default();
        UNCERTAINTY.put(&mut own, &given);
        let mut keys = Vec::new();
        for parameter in own.parameters {
            let key = parameter.key.clone();
            if number_at(self.tree, &key).is_none()
                && let Some(range) = range(Kind::Soil, &key)
                && let Some(marginal) = parameter.scaled(None, 1.0, &range)
            {
                self.put(&key, Value::Float(marginal.median()), &origin);
            }
            keys.push(key);
        }
        keys
    }

    /// Whether a number is the prior's; if the soil does not have it, it gets the median.
    fn takes(&mut self, row: &Parameter, own: &[String]) -> bool {
        let key = &*row.key;
        if !self.is_about(row) || self.missing.iter().any(|other| other == key) {
            return false;
        }
        let is_the_priors = match at(self.tree, key) {
            Some(node) => self.is_resolved && !self.is_from_outside(node),
            None => self.median(row).is_some_and(|median| {
                let origin = self.tree.origin_of(KEY).clone();
                let is_put = self.put(key, Value::Float(median), &origin);
                if is_put && !own.iter().any(|other| other == key) {
                    let (value, name) = (three_digits(median), &self.name);
                    let reason = &row.belief.reason;
                    self.note(format!(
                        "{key}: not stated; {value}, the median of \"{name}\": {reason}"
                    ));
                }
                is_put
            }),
        };
        if is_the_priors {
            self.missing.push(key.to_owned());
        }
        is_the_priors
    }

    /// The same of a keyword.
    fn takes_word(&mut self, key: &str, word: &str, reason: &str) -> bool {
        if let Some(node) = at(self.tree, key) {
            return self.is_resolved && !self.is_from_outside(node);
        }
        let origin = self.tree.origin_of(KEY).clone();
        let is_put = self.put(key, Value::String(word.to_owned()), &origin);
        if is_put {
            let name = &self.name;
            self.note(format!("{key}: not stated; \"{word}\", by \"{name}\": {reason}"));
        }
        is_put
    }

    /// Whether a row says how well a number of the soil is known: one that the document states.
    fn is_stated(&self, row: &Parameter, own: &[String]) -> bool {
        let key = &*row.key;
        let is_otherwise_known = |other: &String| other == key;
        let Some(node) = at(self.tree, key) else { return false };
        self.is_about(row)
            && !self.is_from_outside(node)
            && !own.iter().chain(&self.missing).any(is_otherwise_known)
            && self.marginal(row).is_some()
    }

    /// Whether an argument set a value. A soil that is given as one argument is a document like any
    /// other: its values stand beside its priors.
    fn is_from_outside(&self, node: &Node) -> bool {
        let text = &node.origin.text;
        text.is_argument && !Arc::ptr_eq(text, &self.given_in)
    }

    /// Whether a row is about this soil.
    fn is_about(&self, row: &Parameter) -> bool {
        let is_firm = matches!(at(self.tree, "consistency").map(|node| &node.value),
            Some(Value::String(word)) if word == "firm");
        let is_meant = match row.belief.soils {
            Soils::Any => true,
            Soils::Loose => !is_firm,
            Soils::Firm => is_firm,
        };
        let unless = &row.belief.unless;
        is_meant
            && (unless.is_empty() || at(&self.written, unless).is_none())
            && self.has_word(&row.belief.when)
    }

    /// Whether the soil has a keyword, given as `key=word`.
    fn has_word(&self, when: &str) -> bool {
        let Some((key, word)) = when.split_once('=') else { return true };
        matches!(at(&self.written, key).map(|node| &node.value), Some(Value::String(it)) if it == word)
    }

    fn marginal(&self, row: &Parameter) -> Option<Marginal> {
        let reference = match &*row.belief.relative_to {
            "" => 1.0,
            key => number_at(self.tree, key)?,
        };
        row.scaled(number_at(self.tree, &row.key), reference, &range(Kind::Soil, &row.key)?)
    }

    fn median(&self, row: &Parameter) -> Option<f64> {
        let range = range(Kind::Soil, &row.key)?;
        let median = self.marginal(row)?.median().clamp(*range.start(), *range.end());
        median.is_finite().then_some(median)
    }

    /// Puts a value under a key; false if the soil's laws do not have the key.
    fn put(&mut self, key: &str, value: Value, origin: &Origin) -> bool {
        let mut steps: Vec<String> = key.split('.').map(str::to_owned).collect();
        let mut changed = self.tree.clone();
        if put_at(&mut changed, &steps, value, origin).is_none() {
            return false;
        }
        let Some(last) = steps.pop() else { return false };
        let is_known = keys_at(Kind::Soil, &changed, &steps)
            .is_some_and(|known| known.contains(&last.as_str()));
        if is_known {
            *self.tree = changed;
        }
        is_known
    }

    /// Adds an assumption.
    fn note(&mut self, text: String) {
        let origin = self.tree.origin.clone();
        let text = Node { value: Value::String(text), origin: origin.clone() };
        if let Some(entry) = self.tree.entry_mut("assumed") {
            if let Value::List(all) = &mut entry.node.value {
                all.push(text);
            }
        } else if let Value::Table(entries) = &mut self.tree.value {
            let node = Node { value: Value::List(vec![text]), origin: origin.clone() };
            entries.push(Entry { key: "assumed".to_owned(), key_origin: origin, node });
        }
    }
}

/// What stands under a dotted key.
fn at<'n>(tree: &'n Node, key: &str) -> Option<&'n Node> {
    key.split('.').try_fold(tree, |node, step| Some(&node.entry(step)?.node))
}

fn number_at(tree: &Node, key: &str) -> Option<f64> {
    match at(tree, key)?.value {
        Value::Float(float) => Some(float),
        Value::Integer(integer) => Some(integer as f64),
        _ => None,
    }
}

/// Puts a value under a key, and makes the tables on the way; nothing if something else stands
/// there.
fn put_at(node: &mut Node, steps: &[String], value: Value, origin: &Origin) -> Option<()> {
    let (step, further) = steps.split_first()?;
    let position = node.entries().iter().position(|entry| entry.key == *step);
    let Value::Table(entries) = &mut node.value else { return None };
    if let Some(position) = position {
        return put_at(&mut entries[position].node, further, value, origin);
    }
    let mut node = Node { value: Value::Table(Vec::new()), origin: origin.clone() };
    if further.is_empty() {
        node.value = value;
    } else {
        put_at(&mut node, further, value, origin)?;
    }
    entries.push(Entry { key: step.clone(), key_origin: origin.clone(), node });
    Some(())
}

/// A number with three digits that count, as a sentence has it.
fn three_digits(value: f64) -> String {
    number(format!("{value:.2e}").parse().unwrap_or(value))
}

// ---- Checks ----

/// The most of a prior's distribution that may lie outside its key's range [-]: its median stands
/// for the whole.
const MOST_OUTSIDE: f64 = 0.01;

/// Checks that the rows of priors are about numbers of soils, and possible.
pub(crate) fn check(tree: &Node) -> Result<(), DocumentError> {
    let priors = priors_of(&tree.to_json());
    for (list, rows) in [("missing", &priors.missing), ("stated", &priors.stated)] {
        for (place, row) in rows.iter().enumerate() {
            let at = |key: &str| tree.origin_of(&format!("{list}.{place}.{key}"));
            check_row(row, list == "missing")
                .map_err(|(key, problem)| DocumentError::at(at(key), problem))?;
        }
    }
    let all = priors.missing.iter().chain(&priors.stated);
    let keys: Vec<&str> = all.map(|row| &*row.key).collect();
    for (place, pair) in priors.correlations.iter().enumerate() {
        let unknown = pair.between.iter().position(|key| !keys.contains(&&**key));
        if let Some(end) = unknown {
            let origin = tree.origin_of(&format!("correlation.{place}.between.{end}"));
            let problem = Problem::NotUncertain { key: pair.between[end].clone() };
            return Err(DocumentError::at(origin, problem));
        }
    }
    Ok(())
}

/// Checks that a row is possible; the error has the name of what is wrong in it.
fn check_row(row: &Parameter, is_missing: bool) -> Result<(), (&'static str, Problem)> {
    let unknown = |name: &'static str, key: &str| {
        Err((name, Problem::UnknownKey { key: key.escape_debug().to_string() }))
    };
    let relative_to = &*row.belief.relative_to;
    let Some(range) = range(Kind::Soil, &row.key) else { return unknown("key", &row.key) };
    if !relative_to.is_empty() && self::range(Kind::Soil, relative_to).is_none() {
        return unknown("relative_to", relative_to);
    }
    if !row.belief.when.is_empty() && !row.belief.when.contains('=') {
        return Err(("when", Problem::Conflict("a condition is written key=word")));
    }
    let has_median = !row.belief.median.is_nan();
    if is_missing && row.has_no_mean() && !has_median {
        return Err(("key", Problem::MissingKey { key: "median".to_owned() }));
    }
    if has_median && !row.has_no_mean() {
        let problem = Problem::Conflict("a row has a mean or a median, not both");
        return Err(("median", problem));
    }
    if !relative_to.is_empty() || (row.has_no_mean() && !has_median) {
        return Ok(());
    }
    let inside = row.scaled(None, 1.0, &(f64::NEG_INFINITY..=f64::INFINITY));
    let inside = inside.map_or(0.0, |marginal| marginal.share_within(&range));
    if inside >= 1.0 - MOST_OUTSIDE {
        return Ok(());
    }
    let problem =
        "more than 1 % of this distribution is outside the range of its key, or it is none";
    Err(("key", Problem::Conflict(problem)))
}

/// Checks that every row of a document of priors gives a reason.
pub(crate) fn check_reasons(tree: &Node) -> Result<(), DocumentError> {
    for list in ["missing", "keyword", "stated", "correlation"] {
        let Some(Value::List(rows)) = tree.entry(list).map(|entry| &entry.node.value) else {
            continue;
        };
        for (place, row) in rows.iter().enumerate() {
            let reason = row.entry("reason").map(|entry| &entry.node.value);
            if !matches!(reason, Some(Value::String(reason)) if !reason.trim().is_empty()) {
                let key = format!("{list}.{place}.reason");
                let hint = "a prior says why it is so".to_owned();
                return Err(
                    DocumentError::at(&row.origin, Problem::MissingKey { key }).with_hint(hint)
                );
            }
        }
    }
    Ok(())
}
