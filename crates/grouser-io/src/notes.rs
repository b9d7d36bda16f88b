//! The date and the assumptions of a document.

use serde_json::Value as Json;

use super::error::{DocumentError, Problem};
use super::kind::EACH;
use super::kind::Kind;
use super::overrides::Overrides;
use super::tree::{Entry, Node, Value};

/// Calls a function with each document inside one.
fn for_each_inside(
    tree: &Node,
    path: &[&str],
    act: &mut impl FnMut(&Node) -> Result<(), DocumentError>,
) -> Result<(), DocumentError> {
    match (path, &tree.value) {
        ([], _) => act(tree),
        ([EACH, rest @ ..], Value::List(nodes)) => {
            nodes.iter().try_for_each(|node| for_each_inside(node, rest, act))
        }
        ([key, rest @ ..], _) => {
            tree.entry(key).map_or(Ok(()), |entry| for_each_inside(&entry.node, rest, act))
        }
    }
}

/// The same, to change it.
fn change_each_inside(tree: &mut Node, path: &[&str], change: &mut impl FnMut(&mut Node)) {
    match path {
        [] => change(tree),
        [EACH, rest @ ..] => {
            if let Value::List(nodes) = &mut tree.value {
                for node in nodes {
                    change_each_inside(node, rest, change);
                }
            }
        }
        [key, rest @ ..] => {
            if let Some(entry) = tree.entry_mut(key) {
                change_each_inside(&mut entry.node, rest, change);
            }
        }
    }
}

/// What stands at a path, or at all of them.
fn all_at<'j>(given: &'j Json, path: &[&str]) -> Vec<&'j Json> {
    match path {
        [] => vec![given],
        [EACH, rest @ ..] => {
            given.as_array().into_iter().flatten().flat_map(|given| all_at(given, rest)).collect()
        }
        [key, rest @ ..] => given.get(key).map_or(Vec::new(), |given| all_at(given, rest)),
    }
}

/// Checks dates, in the document and in all inside it.
pub(crate) fn check_days(kind: Kind, tree: &Node) -> Result<(), DocumentError> {
    let date = tree.entry("date").map(|entry| &entry.node);
    if let Some(Node { value: Value::String(date), origin }) = date
        && kind == Kind::Soil
        && !is_day(date)
    {
        let problem = Problem::Conflict("`date` is not a day: it is written as \"2026-11-20\"");
        return Err(DocumentError::at(origin, problem));
    }
    kind.parts().iter().try_for_each(|part| {
        for_each_inside(tree, part.path, &mut |inside| check_days(part.kind, inside))
    })
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
pub(crate) fn add(kind: Kind, tree: &mut Node, overrides: &Overrides) {
    for part in kind.parts() {
        let none = Overrides::none();
        let overrides = if part.is_listed() { &none } else { overrides };
        change_each_inside(tree, part.path, &mut |inside| add(part.kind, inside, overrides));
    }
    // A scenario, a mission, a campaign or a mapping is what its author wants, and needs no source;
    // priors have one in each row.
    if matches!(
        kind,
        Kind::Scenario
            | Kind::Mission
            | Kind::Campaign
            | Kind::Design
            | Kind::Prior
            | Kind::TelemetryMapping
    ) {
        return;
    }
    let mut assumed = assumed(tree);
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

pub(crate) fn assumed(tree: &Node) -> Vec<String> {
    let Some(Value::List(nodes)) = tree.entry("assumed").map(|entry| &entry.node.value) else {
        return Vec::new();
    };
    let texts = nodes.iter().filter_map(|node| match &node.value {
        Value::String(text) => Some(text.clone()),
        _ => None,
    });
    texts.collect()
}

pub(crate) fn put(tree: &mut Node, assumed: &[String]) {
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
pub(crate) fn assumptions(kind: Kind, given: &Json) -> Vec<String> {
    if kind == Kind::Prior {
        return Vec::new();
    }
    let text = |key: &str| given.get(key).and_then(Json::as_str).unwrap_or_default();
    let (name, source) = (text("name"), text("source"));
    let says_so = source.starts_with("assumed").then(|| format!("{kind} {name}: {source}"));
    let own = given.get("assumed").and_then(Json::as_array).into_iter().flatten();
    let own = own.filter_map(Json::as_str).map(|one| format!("{kind} {name}: {one}"));
    let mut all: Vec<String> = says_so.into_iter().chain(own).collect();
    for part in kind.parts() {
        let inside = all_at(given, part.path);
        all.extend(inside.into_iter().flat_map(|inside| assumptions(part.kind, inside)));
    }
    all
}
