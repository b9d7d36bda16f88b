//! The JSON Schema of each kind of document, made from the tables that
//! [`describe`](super::describe) it.
//!
//! Editors read schemas from `schema/`; the reader itself checks documents against them
//! ([`check`](super::check)), so that what is given and what is allowed cannot differ.

use std::sync::OnceLock;

use serde_json::{Map, Value as Json};

use super::describe;
use super::json_schema;
use super::kind::{Kind, without_parts};

/// The JSON Schema (draft 2020-12) of a kind of document, as text.
#[must_use]
pub fn schema(kind: Kind) -> String {
    let mut root = root(kind).clone();
    json_schema::with_thousands(&mut root);
    json_schema::with_presets(&mut root);
    let mut text = format!("{root:#}");
    text.push('\n');
    text
}

/// The range that a number of a document may have, both ends included unless they are 0 and
/// excluded there. Where the keys depend on a `law`, the widest range of all laws.
///
/// * `path`: the key with its tables, such as `pressure_sinkage.n`; entries of a list have the
///   list's key
#[must_use]
pub fn range(kind: Kind, path: &str) -> Option<std::ops::RangeInclusive<f64>> {
    let root = root(kind);
    let ranges = properties(root, root, path).into_iter().filter_map(|schema| {
        let number = schema.get("items").unwrap_or(schema);
        let end = |names: [&str; 2]| names.iter().find_map(|name| number.get(*name)?.as_f64());
        Some((end(["minimum", "exclusiveMinimum"])?, end(["maximum", "exclusiveMaximum"])?))
    });
    let widest = ranges.reduce(|one, other| (one.0.min(other.0), one.1.max(other.1)));
    widest.map(|(least, most)| least..=most)
}

/// What a key of a document is: the sentence of its row, with the unit.
///
/// * `path`: the key with its tables, and the parts that it stands in: of a scenario
///   `soil.friction_angle_deg`; an entry of a list, by its place, is what its list is
#[must_use]
pub fn meaning(kind: Kind, path: &str) -> Option<&'static str> {
    let keys = path.split('.').filter(|key| key.parse::<usize>().is_err());
    let path = keys.map(str::to_owned).collect();
    let (kind, path) = without_parts(kind, path);
    let root = root(kind);
    let found = under(root, &path.join("."), None);
    found.into_iter().find_map(|schema| schema.get("description")?.as_str())
}

/// The same schema as a value, made once.
pub(crate) fn root(kind: Kind) -> &'static Json {
    static SCHEMAS: [OnceLock<Json>; Kind::ALL.len()] =
        [const { OnceLock::new() }; Kind::ALL.len()];
    SCHEMAS[kind as usize].get_or_init(|| {
        let mut defs = Map::new();
        let mut schema = describe::rows(kind).schema(&mut defs);
        schema["title"] = kind.tag().into();
        schema["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
        // Only a file must say what it is; a table inside another document is known by its place.
        let needed = schema["required"].as_array().cloned().unwrap_or_default();
        schema["required"] = std::iter::once(Json::from("schema")).chain(needed).collect();
        if !defs.is_empty() {
            schema["$defs"] = Json::Object(defs);
        }
        schema
    })
}

/// A schema behind its reference.
pub(crate) fn resolve<'s>(root: &'s Json, schema: &'s Json) -> &'s Json {
    match schema.get("$ref").and_then(Json::as_str) {
        Some("#") => root,
        Some(reference) => {
            reference.strip_prefix('#').and_then(|path| root.pointer(path)).unwrap_or(schema)
        }
        None => schema,
    }
}

/// The schemas that a value may meet: itself, or those behind `oneOf` and `anyOf`.
pub(crate) fn alternatives<'s>(root: &'s Json, schema: &'s Json) -> Vec<&'s Json> {
    let schema = resolve(root, schema);
    let choice = ["oneOf", "anyOf"].iter().find_map(|key| schema.get(*key)?.as_array());
    match choice {
        Some(schemas) => schemas.iter().flat_map(|schema| alternatives(root, schema)).collect(),
        None => vec![schema],
    }
}

/// The words that a schema allows; `None` if it is not a closed set of words.
pub(crate) fn words<'s>(root: &'s Json, schema: &'s Json) -> Option<Vec<&'s str>> {
    let mut all = Vec::new();
    for schema in alternatives(root, schema) {
        if let Some(word) = schema.get("const").and_then(Json::as_str) {
            all.push(word);
        } else {
            let words = schema.get("enum")?.as_array()?;
            all.extend(words.iter().filter_map(Json::as_str));
        }
    }
    Some(all)
}

/// The keys of a table.
pub(crate) fn keys(schema: &Json) -> impl Iterator<Item = (&str, &Json)> {
    schema
        .get("properties")
        .and_then(Json::as_object)
        .into_iter()
        .flatten()
        .map(|(key, schema)| (key.as_str(), schema))
}

/// Where a key stands, as paths.
///
/// * `name`: the key, or the end of its path
pub(crate) fn paths_of(root: &Json, name: &str) -> Vec<String> {
    let is_end_of = |path: &str| {
        let before = path.strip_suffix(name);
        before.is_some_and(|tables| tables.is_empty() || tables.ends_with('.'))
    };
    let mut found = Vec::new();
    collect(root, root, "", &mut |path, _| {
        if is_end_of(path) && !found.iter().any(|other| other == path) {
            found.push(path.to_owned());
        }
    });
    found
}

/// The names of all keys, each once, whatever table they stand in.
pub(crate) fn names_in(root: &Json) -> Vec<String> {
    let mut found = Vec::new();
    collect(root, root, "", &mut |_, key| {
        if !found.iter().any(|other| other == key) {
            found.push(key.to_owned());
        }
    });
    found
}

fn collect(root: &Json, schema: &Json, path: &str, visit: &mut dyn FnMut(&str, &str)) {
    for table in alternatives(root, schema) {
        for (key, child) in keys(table) {
            let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
            visit(&path, key);
            collect(root, child, &path, visit);
        }
    }
}

/// The schemas under a dotted key, one for each law that has it, as they stand: with their
/// sentences and defaults.
///
/// * `law`: the one of its table, if it is known
pub(crate) fn under<'s>(root: &'s Json, path: &str, law: Option<&str>) -> Vec<&'s Json> {
    let (tables, key) = path.rsplit_once('.').map_or((None, path), |(all, key)| (Some(all), key));
    let tables = match tables {
        Some(path) => properties(root, root, path),
        None => vec![root],
    };
    let entries = tables.into_iter().flat_map(|table| match table.get("items") {
        Some(items) => alternatives(root, items),
        None => vec![table],
    });
    let has_law = |table: &&Json| {
        let known = table.pointer("/properties/law").and_then(|schema| words(root, schema));
        law.is_none_or(|law| known.is_none_or(|known| known.contains(&law)))
    };
    entries.filter(has_law).filter_map(|table| table.get("properties")?.get(key)).collect()
}

/// Everything that a key may be, over all laws.
fn properties<'s>(root: &'s Json, schema: &'s Json, path: &str) -> Vec<&'s Json> {
    let (first, rest) = path.split_once('.').map_or((path, None), |(key, rest)| (key, Some(rest)));
    let tables = alternatives(root, schema).into_iter();
    let tables = tables.flat_map(|table| match table.get("items") {
        Some(items) => alternatives(root, items),
        None => vec![table],
    });
    let children = tables.filter_map(|table| table.get("properties")?.get(first));
    children
        .flat_map(|child| match rest {
            Some(rest) => properties(root, child, rest),
            None => alternatives(root, child),
        })
        .collect()
}
