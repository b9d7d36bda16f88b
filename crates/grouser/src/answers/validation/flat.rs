//! Records as a table: their keys are its columns.

use serde::Serialize;
use serde_json::{Map, Value};

use crate::document::table::{Table, Values};

/// A record without objects inside: the keys of an inner object have its own before theirs. What is
/// null outside of them is left out, for it may be an object in another record.
pub(super) fn flattened<T: Serialize>(record: &T) -> Map<String, Value> {
    let mut flat = Map::new();
    if let Ok(Value::Object(map)) = serde_json::to_value(record) {
        flatten("", map, &mut flat);
    }
    flat
}

fn flatten(prefix: &str, map: Map<String, Value>, into: &mut Map<String, Value>) {
    for (key, value) in map {
        match value {
            Value::Object(inner) => flatten(&format!("{prefix}{key}_"), inner, into),
            Value::Null if prefix.is_empty() => {}
            value => {
                into.insert(format!("{prefix}{key}"), value);
            }
        }
    }
}

/// A table with a column for each key that any of some records has, in the order in which they
/// appear.
pub(super) fn table_of(records: &[Map<String, Value>]) -> Table {
    let mut names: Vec<&String> = Vec::new();
    for name in records.iter().flat_map(Map::keys) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let column = |name: &String| (name.clone(), values_of(records, name));
    Table { columns: names.into_iter().map(column).collect() }
}

/// The values of a key: counts, other numbers, or words.
fn values_of(records: &[Map<String, Value>], name: &str) -> Values {
    let values: Vec<&Value> =
        records.iter().map(|record| record.get(name).unwrap_or(&Value::Null)).collect();
    let are_all = |is_so: fn(&Value) -> bool| values.iter().all(|it| it.is_null() || is_so(it));
    if are_all(Value::is_u64) {
        Values::Whole(values.iter().map(|value| value.as_u64()).collect())
    } else if are_all(Value::is_number) {
        Values::Float(values.iter().map(|value| value.as_f64()).collect())
    } else {
        Values::Text(values.iter().map(|value| word_of(value)).collect())
    }
}

/// A value as a word; nothing for null.
fn word_of(value: &Value) -> Option<String> {
    match value {
        Value::Null => None,
        Value::String(text) => Some(text.clone()),
        other => Some(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn records_with_and_without_inner_objects_share_their_columns() {
        let records = [
            json!({ "model": "rft", "rank": 1, "driven": null, "overall": { "score": 0.5 } }),
            json!({ "model": "mean", "overall": { "score": null, "is_met": true } }),
        ];
        let table = table_of(&records.each_ref().map(flattened));
        assert_eq!(table.names(), ["model", "rank", "overall_score", "overall_is_met"]);
        let words =
            |words: [Option<&str>; 2]| Values::Text(words.map(|it| it.map(str::to_owned)).into());
        let expected = [
            words([Some("rft"), Some("mean")]),
            Values::Whole(vec![Some(1), None]),
            Values::Float(vec![Some(0.5), None]),
            words([None, Some("true")]),
        ];
        assert!(table.columns.iter().map(|(_, values)| values).eq(&expected));
    }
}
