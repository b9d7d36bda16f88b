//! The JSON Schema of each kind of document, made from the tables that [`describe`](super::describe) it.
//!
//! Editors read schemas from `schema/`; the reader itself checks documents against them
//! ([`check`](super::check)), so that what is said and what is allowed cannot differ.

use std::sync::OnceLock;

use serde_json::{Map, Value as Json, json};

use super::Kind;
use super::describe;
use super::field::{Field, Form, Laws, Number, Presence, Shape, Table, Text, Whole};

/// The JSON Schema (draft 2020-12) of a kind of document, as text.
#[must_use]
pub fn schema(kind: Kind) -> String {
    let mut text = format!("{:#}", root(kind));
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

/// A table, under a law if its keys depend on one.
pub(crate) fn of_table<T>(
    table: &Table<T>,
    law: Option<(&str, Json, bool)>,
    defs: &mut Map<String, Json>,
) -> Json {
    let mut properties = Map::new();
    let mut needed: Vec<&str> = Vec::new();
    if let Some((key, word, may_be_left_out)) = law {
        properties.insert(key.to_owned(), word);
        needed.extend((!may_be_left_out).then_some(key));
    }
    for field in table.fields {
        properties.insert(field.key.to_owned(), of_field(field, defs));
        needed.extend(matches!(field.presence, Presence::Needed).then_some(field.key));
    }
    let mut schema = json!({
        "type": "object",
        "description": table.doc,
        "additionalProperties": false,
        "properties": properties,
    });
    if !needed.is_empty() {
        schema["required"] = needed.into();
    }
    schema
}

/// A table for each law.
pub(crate) fn of_laws<T>(laws: &Laws<T>, defs: &mut Map<String, Json>) -> Json {
    let all = laws.all.iter().enumerate().map(|(place, law)| {
        let is_default = laws.may_be_left_out && place == 0;
        let mut word = json!({ "type": "string", "const": law.name });
        if let Some(doc) = law.word {
            word["description"] = doc.into();
            let about = if is_default { "The law; may be left out." } else { "The law." };
            word = json!({ "description": about, "oneOf": [word] });
        }
        if is_default {
            word["default"] = law.name.into();
        }
        of_table(&law.table, Some((laws.key, word, is_default)), defs)
    });
    let choice = if laws.may_be_left_out { "anyOf" } else { "oneOf" };
    json!({ choice: all.collect::<Vec<_>>(), "description": laws.doc })
}

fn of_field<T>(field: &Field<T>, defs: &mut Map<String, Json>) -> Json {
    let mut schema = match &field.shape {
        Shape::Tag => {
            let tag = Table::implied(field);
            json!({ "oneOf": [{ "type": "string", "const": tag, "description": "This version." }] })
        }
        Shape::Text(Text { least, format, .. }) => {
            let mut text = json!({ "type": "string" });
            if *least > 0 {
                text["minLength"] = (*least).into();
            }
            if let Some(format) = format {
                text["format"] = (*format).into();
            }
            text
        }
        Shape::Texts(texts) => list_of(&json!({ "type": "string" }), texts.least, texts.most),
        Shape::Flag(_) => json!({ "type": "boolean" }),
        Shape::Whole(Whole { least, most, format, .. }) => {
            json!({ "type": "integer", "format": format, "minimum": least, "maximum": most })
        }
        Shape::Words(words) => {
            let word = |word: &super::field::Keyword<T>| json!({ "type": "string", "const": word.name, "description": word.doc });
            json!({ "oneOf": words.iter().map(word).collect::<Vec<_>>() })
        }
        Shape::Number(number, _) => of_number(number),
        Shape::Numbers(numbers) => match numbers.form {
            Form::Exactly(count) => list_of(&of_number(&numbers.number), count, Some(count)),
            Form::OneOrEach(one, each) => {
                let described = |mut schema: Json, doc: &str| {
                    schema["description"] = with_unit(doc, numbers.number.unit.symbol).into();
                    schema
                };
                let number = of_number(&numbers.number);
                let list = list_of(&number, 0, None);
                json!({ "anyOf": [described(number, one), described(list, each)] })
            }
        },
        Shape::Inner(inner) => inner.schema(defs),
        Shape::List(each, least) => list_of(&each.schema(defs), *least, None),
        Shape::Part(kind, _) => {
            if !defs.contains_key(kind.name()) {
                // The place is taken before the parts of the part are described, for their order.
                defs.insert(kind.name().to_owned(), Json::Null);
                let schema = describe::rows(*kind).schema(defs);
                defs.insert(kind.name().to_owned(), schema);
            }
            let named = "The name of a preset, or a path from the folder of this document.";
            json!({ "anyOf": [
                { "type": "string", "description": named },
                {
                    "$ref": format!("#/$defs/{}", kind.name()),
                    "description": "The document's keys, as a table.",
                },
            ]})
        }
        Shape::TextOr(doc, _, inner) => {
            json!({ "anyOf": [{ "type": "string", "description": doc }, inner.schema(defs)] })
        }
    };
    schema["description"] = match &field.shape {
        Shape::Number(number, _) => with_unit(field.doc, number.unit.symbol).into(),
        Shape::Numbers(numbers) => with_unit(field.doc, numbers.number.unit.symbol).into(),
        _ => field.doc.into(),
    };
    if let Some(default) = Table::implied(field) {
        schema["default"] = default;
    }
    schema
}

fn of_number(number: &Number) -> Json {
    let least = if number.is_open { "exclusiveMinimum" } else { "minimum" };
    json!({ "type": "number", "format": "double", least: number.least, "maximum": number.most })
}

fn list_of(items: &Json, least: u64, most: Option<u64>) -> Json {
    let mut list = json!({ "type": "array", "items": items });
    if least > 0 {
        list["minItems"] = least.into();
    }
    if let Some(most) = most {
        list["maxItems"] = most.into();
    }
    list
}

/// A number's sentence: its unit goes where the brackets are, or to the end.
fn with_unit(doc: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
    if doc.contains(" []") { doc.replace(" []", &unit) + "." } else { format!("{doc}{unit}.") }
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

/// Tables and keys in which a key of this name exists, as paths.
pub(crate) fn paths_of(root: &Json, name: &str) -> Vec<String> {
    let mut found = Vec::new();
    collect(root, root, "", &mut |path, key| {
        if key == name && !found.iter().any(|other| other == path) {
            found.push(path.to_owned());
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
