//! What each command does.

pub(crate) mod attitude;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod presets;
pub(crate) mod reproduce;
pub(crate) mod schema;
pub(crate) mod traverse;
pub(crate) mod wheel_test;

use serde_json::{Value, json};

/// The outer object of every JSON output: what it is, who made it, from what.
pub(crate) fn envelope(command: &str, inputs: &Value) -> serde_json::Map<String, Value> {
    let envelope = json!({
        "schema": format!("grouser.{command}.v1"),
        "version": env!("CARGO_PKG_VERSION"),
        "inputs": inputs,
    });
    match envelope {
        Value::Object(map) => map,
        _ => unreachable!("an object was written"),
    }
}

/// A JSON object as text.
pub(crate) fn json_text(map: serde_json::Map<String, Value>) -> String {
    format!("{:#}\n", Value::Object(map))
}
