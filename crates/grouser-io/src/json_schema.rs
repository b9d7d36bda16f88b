//! The JSON Schema of one table, made from its rows.

use serde_json::{Map, Value as Json, json};

use super::field::{
    Allowed, Field, Form, Keyed, Keyword, Laws, Number, PRESET, Presence, Shape, Table, Text, Whole,
};

/// The remark on a key that the soil's priors have a value for. The reader asks for the key where
/// they have none.
pub(crate) const FROM_PRIOR: &str = "from the soil's priors where it is left out";
/// The remark on one that has a value without a prior as well.
const FROM_PRIOR_OR_DEFAULT: &str =
    "from the soil's priors where it is left out, or 0 where they have none";

/// A table, under a law if its keys depend on one.
pub(crate) fn of_table<T>(
    table: &Table<T>,
    law: Option<(&str, Json, bool)>,
    defs: &mut Map<String, Json>,
) -> Json {
    let mut properties = Map::new();
    let mut needed: Vec<&str> = Vec::new();
    let (mut thousands, mut partners, mut choices) = (Map::new(), Map::new(), Vec::new());
    if let Some((key, word, may_be_left_out)) = law {
        properties.insert(key.to_owned(), word);
        needed.extend((!may_be_left_out).then_some(key));
    }
    for field in table.fields {
        properties.insert(field.key.to_owned(), of_field(field, defs));
        needed.extend(matches!(field.presence, Presence::Needed).then_some(field.key));
        choices.extend(choice_of(field));
        partners.extend(field.only_with.map(|other| (field.key.to_owned(), json!([other]))));
        thousands.extend(field.in_thousands.map(|key| (key.to_owned(), field.key.into())));
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
    if !thousands.is_empty() {
        schema[IN_THOUSANDS] = thousands.into();
    }
    if !partners.is_empty() {
        schema["dependentRequired"] = partners.into();
    }
    choices.dedup();
    if !choices.is_empty() {
        schema["allOf"] = choices.into();
    }
    schema
}

/// The schema of a table that has one of some keys, where the key is one of them.
fn choice_of<T>(field: &Field<T>) -> Option<Json> {
    let (word, keys) = match field.presence {
        Presence::AnyOf(keys) => ("anyOf", keys),
        Presence::OneOf(keys) => ("oneOf", keys),
        _ => return None,
    };
    let required = keys.iter().map(|key| json!({ "required": [key] }));
    Some(json!({ word: required.collect::<Vec<_>>() }))
}

/// The keys of which a table has one, for each choice of keys; whether it may have several of them.
pub(crate) fn choices_of(schema: &Json) -> impl Iterator<Item = (Vec<&str>, bool)> {
    let all = schema.get("allOf").and_then(Json::as_array).into_iter().flatten();
    all.filter_map(|choice| {
        let (several, one) = (choice.get("anyOf"), choice.get("oneOf"));
        let keys = several.or(one)?.as_array()?.iter();
        let keys = keys.filter_map(|it| it.pointer("/required/0")?.as_str());
        Some((keys.collect(), several.is_some()))
    })
}

/// A text, and what it may be.
fn of_text(allowed: Allowed) -> Json {
    match allowed {
        Allowed::All => json!({ "type": "string" }),
        Allowed::Format(format) => json!({ "type": "string", "format": format }),
        Allowed::Pattern(pattern) => json!({ "type": "string", "pattern": pattern() }),
        Allowed::Words(words) => {
            let words = words().into_iter().map(|word| json!({ "type": "string", "const": word }));
            json!({ "oneOf": words.collect::<Vec<_>>() })
        }
    }
}

/// In a table of the reader's schema: keys of numbers in thousands of a unit, each with the key of
/// the number.
const IN_THOUSANDS: &str = "x-in-thousands";

/// The key of the number that another key of the same table gives in thousands of its unit.
pub(crate) fn of_thousands<'s>(table: &'s Json, key: &str) -> Option<&'s str> {
    table.get(IN_THOUSANDS)?.get(key)?.as_str()
}

/// The schema for editors: a table that may start from a preset needs no key if it does. (The
/// reader has put the preset's keys into it before it checks.)
pub(crate) fn with_presets(schema: &mut Json) {
    match schema {
        Json::Array(all) => all.iter_mut().for_each(with_presets),
        Json::Object(keys) => {
            keys.values_mut().for_each(with_presets);
            let has_preset = keys.get("properties").is_some_and(|of| of.get(PRESET).is_some());
            if has_preset && let Some(Json::Array(needed)) = keys.get_mut("required") {
                let (tag, others): (Vec<_>, Vec<_>) =
                    std::mem::take(needed).into_iter().partition(|key| key == "schema");
                *needed = tag;
                if needed.is_empty() {
                    keys.shift_remove("required");
                }
                keys.insert("if".to_owned(), json!({ "not": { "required": [PRESET] } }));
                keys.insert("then".to_owned(), json!({ "required": others }));
            }
        }
        _ => {}
    }
}

/// The schema for editors: where numbers may stand in thousands of a unit, with those keys too.
/// (The reader has turned them into the others before it checks.)
pub(crate) fn with_thousands(schema: &mut Json) {
    match schema {
        Json::Array(all) => all.iter_mut().for_each(with_thousands),
        Json::Object(keys) => {
            keys.values_mut().for_each(with_thousands);
            let Some(Json::Object(thousands)) = keys.shift_remove(IN_THOUSANDS) else { return };
            for (key, of) in thousands {
                let Some(of) = of.as_str() else { continue };
                add_thousands(keys, &key, of);
            }
        }
        _ => {}
    }
}

fn add_thousands(table: &mut Map<String, Json>, key: &str, of: &str) {
    let mut number = table["properties"][of].clone();
    for end in ["minimum", "exclusiveMinimum", "maximum"] {
        if let Some(value) = number.get(end).and_then(Json::as_f64) {
            number[end] = (value / 1e3).into();
        }
    }
    let doc = number["description"].as_str().unwrap_or_default().replace("[N", "[kN");
    number["description"] = doc.into();
    table["properties"][key] = number;
    if let Some(Json::Array(needed)) = table.get_mut("required") {
        needed.retain(|needed| needed != of);
    }
    let one_of_both = json!({
        "if": { "required": [key] },
        "then": { "not": { "required": [of] } },
        "else": { "required": [of] },
    });
    match table.get_mut("allOf") {
        Some(Json::Array(all)) => all.push(one_of_both),
        _ => drop(table.insert("allOf".to_owned(), json!([one_of_both]))),
    }
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
        Shape::Text(Text { least, allowed, .. }) => {
            let mut text = of_text(*allowed);
            if *least > 0 {
                text["minLength"] = (*least).into();
            }
            text
        }
        Shape::Texts(texts) => list_of(&of_text(texts.allowed), texts.least, texts.most),
        Shape::Flag(_) => json!({ "type": "boolean" }),
        Shape::Whole(Whole { least, most, format, .. }) => {
            json!({ "type": "integer", "format": format, "minimum": least, "maximum": most })
        }
        Shape::Words(words) => {
            let word = |word: &Keyword<T>| json!({ "type": "string", "const": word.name, "description": word.doc });
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
        Shape::Pairs(pairs) => {
            let pair = list_of(&of_number(&pairs.range()), 2, Some(2));
            list_of(&pair, 1, None)
        }
        Shape::Keyed(keyed) => {
            // The key has the range that counts.
            let number =
                json!({ "type": "number", "format": "double", "minimum": -1e12, "maximum": 1e12 });
            let each = match keyed {
                Keyed::Bounds => list_of(&number, 2, Some(2)),
                Keyed::Choices => {
                    let either = json!({ "anyOf": [number, { "type": "string", "minLength": 1 }] });
                    list_of(&either, 1, None)
                }
                Keyed::Tie => json!({ "type": "string", "minLength": 1 }),
            };
            json!({ "type": "object", ANY_KEY: each, "minProperties": 1 })
        }
        Shape::Inner(inner) => inner.schema(defs),
        Shape::List(each, least) => list_of(&each.schema(defs), *least, None),
        Shape::Part(kind, inner) => {
            if !defs.contains_key(kind.name()) {
                // The place is taken before the parts of the part are described, for their order.
                defs.insert(kind.name().to_owned(), Json::Null);
                let schema = inner.schema(defs);
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
        Shape::NumberOr(key, inner) => {
            let table = inner.schema(defs);
            json!({ "anyOf": [table["properties"][*key], table] })
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
    if let Presence::Prior(without) = field.presence {
        let comment = if without.is_some() { FROM_PRIOR_OR_DEFAULT } else { FROM_PRIOR };
        schema["$comment"] = comment.into();
    } else if let Some(default) = Table::implied(field) {
        schema["default"] = default;
    }
    schema
}

/// The schema of what stands under keys that are not known beforehand.
pub(crate) const ANY_KEY: &str = "additionalProperties";

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
