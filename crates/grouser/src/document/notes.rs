//! The date and the assumptions of a document.

use serde_json::Value as Json;

use super::error::{DocumentError, Problem};
use super::text::{Entry, Node, Value};
use super::{Kind, Overrides};

/// The documents inside one of a kind: their kinds, and the keys that lead there.
fn parts(kind: Kind) -> impl Iterator<Item = (Kind, &'static [&'static str])> {
    kind.parts().iter().map(|part| (part.kind, part.path))
}

fn node<'n>(tree: &'n Node, path: &[&str]) -> Option<&'n Node> {
    path.iter().try_fold(tree, |node, step| Some(&node.entry(step)?.node))
}

fn node_mut<'n>(tree: &'n mut Node, path: &[&str]) -> Option<&'n mut Node> {
    path.iter().try_fold(tree, |node, step| Some(&mut node.entry_mut(step)?.node))
}

/// Checks dates, in the document and in all inside it.
pub(super) fn check_days(kind: Kind, tree: &Node) -> Result<(), DocumentError> {
    let date = tree.entry("date").map(|entry| &entry.node);
    if let Some(Node { value: Value::String(date), origin }) = date
        && kind == Kind::Soil
        && !is_day(date)
    {
        let problem = Problem::Conflict("`date` is not a day: it is written as \"2026-11-20\"");
        return Err(DocumentError::at(origin, problem));
    }
    let inside = parts(kind).filter_map(|(kind, path)| Some((kind, node(tree, path)?)));
    inside.into_iter().try_for_each(|(kind, tree)| check_days(kind, tree))
}

/// Whether a text is a day of the calendar, year-month-day (ISO 8601).
fn is_day(text: &str) -> bool {
    let fields: Vec<&str> = text.split('-').collect();
    let all_digits = |field: &&str| field.bytes().all(|byte| byte.is_ascii_digit());
    let lengths: Vec<usize> = fields.iter().map(|field| field.len()).collect();
    if lengths != [4, 2, 2] || !fields.iter().all(all_digits) {
        return false;
    }
    let numbers: Vec<u32> = fields.iter().filter_map(|field| field.parse().ok()).collect();
    let [year, month, day] = numbers[..] else { return false };
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = match month {
        1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
        4 | 6 | 9 | 11 => 30,
        2 if is_leap => 29,
        2 => 28,
        _ => 0,
    };
    (1..=days).contains(&day)
}

/// Adds assumptions that the author of a document did not state, to it and to all inside it.
pub(super) fn add(kind: Kind, tree: &mut Node, overrides: &Overrides) {
    for (kind, path) in parts(kind) {
        if let Some(inside) = node_mut(tree, path) {
            add(kind, inside, overrides);
        }
    }
    // A scenario or a campaign is what its author wants, and needs no source.
    if matches!(kind, Kind::Scenario | Kind::Campaign) {
        return;
    }
    let mut assumed = assumed(tree);
    if kind == Kind::Soil && tree.entry("exit").is_none() {
        assumed.push("exit.ratio: not given; 1.0, as for Toyoura sand".to_owned());
    }
    if kind == Kind::Soil && tree.entry("bulldozing").is_none() {
        assumed.push("bulldozing.law: not given; \"sine\", the smooth one".to_owned());
    }
    if tree.entry("source").is_none() {
        assumed.push("source: not stated by the document".to_owned());
    }
    for note in overrides.notes(kind) {
        // What was assumed of this key is no longer in force.
        assumed.retain(|one| one.split(':').next() != note.split(':').next());
        assumed.push(note);
    }
    put(tree, &assumed);
}

fn assumed(tree: &Node) -> Vec<String> {
    let Some(Value::List(nodes)) = tree.entry("assumed").map(|entry| &entry.node.value) else {
        return Vec::new();
    };
    let texts = nodes.iter().filter_map(|node| match &node.value {
        Value::String(text) => Some(text.clone()),
        _ => None,
    });
    texts.collect()
}

fn put(tree: &mut Node, assumed: &[String]) {
    let origin = tree.origin.clone();
    let text = |text: &String| Node { value: Value::String(text.clone()), origin: origin.clone() };
    let node =
        Node { value: Value::List(assumed.iter().map(text).collect()), origin: origin.clone() };
    if let Some(entry) = tree.entry_mut("assumed") {
        entry.node = node;
    } else if let Value::Table(entries) = &mut tree.value {
        entries.push(Entry { key: "assumed".to_owned(), key_origin: origin, node });
    }
}

/// All assumptions, of a document and then by those inside it, each with its name before it.
pub(super) fn assumptions(kind: Kind, given: &Json) -> Vec<String> {
    let text = |key: &str| given.get(key).and_then(Json::as_str).unwrap_or_default();
    let (name, source) = (text("name"), text("source"));
    let says_so = source.starts_with("assumed").then(|| format!("{kind} {name}: {source}"));
    let own = given.get("assumed").and_then(Json::as_array).into_iter().flatten();
    let own = own.filter_map(Json::as_str).map(|one| format!("{kind} {name}: {one}"));
    let mut all: Vec<String> = says_so.into_iter().chain(own).collect();
    for (kind, path) in parts(kind) {
        let inside = path.iter().try_fold(given, |given, step| given.get(step));
        all.extend(inside.map(|inside| assumptions(kind, inside)).unwrap_or_default());
    }
    all
}
