//! A number of a document is declared once: as a row of a table in `document/describe`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::unit_of;
use grouser::document::{self, Kind};
use serde_json::Value;

/// Keys that name different numbers in different places, and how many rows they have.
const DIFFERENT_NUMBERS: [(&str, usize); 4] = [
    // Of the soil in itself, and between soil and rim.
    ("friction_angle_deg", 2),
    // Of the body, and of a wheel with its motor.
    ("mass_kg", 2),
    ("inertia_kg_m2", 2),
    // The rim's in one law of the drive, the rover's along the contour in the others.
    ("speed_m_s", 2),
];

/// The keys of all kinds of documents that end with a unit.
fn keys() -> BTreeSet<String> {
    fn collect(schema: &Value, keys: &mut BTreeSet<String>) {
        let properties = schema.get("properties").and_then(Value::as_object);
        keys.extend(properties.into_iter().flatten().map(|(key, _)| key.clone()));
        let children: Vec<&Value> = match schema {
            Value::Object(all) => all.values().collect(),
            Value::Array(all) => all.iter().collect(),
            _ => Vec::new(),
        };
        for child in children {
            collect(child, keys);
        }
    }
    let mut keys = BTreeSet::new();
    for kind in Kind::ALL {
        collect(&serde_json::from_str(&document::schema(kind)).expect("it is JSON"), &mut keys);
    }
    keys.retain(|key| unit_of(key).is_some());
    keys
}

/// The sources below a folder of the library.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("it can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let text = fs::read_to_string(&path).expect("a source is text");
                found.push((path, text));
            }
        }
    }
    found
}

#[test]
fn a_number_of_a_document_has_one_row() {
    let describe = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/document/describe.rs");
    let mut texts = fs::read_to_string(describe).expect("a source is text");
    texts.extend(sources("document/describe").into_iter().map(|(_, text)| text));
    let keys = keys();
    assert!(keys.contains("cohesion_kpa") && keys.len() > 20, "{keys:?}");
    let rows = keys.iter().map(|key| (key.as_str(), texts.matches(&format!("\"{key}\"")).count()));
    let several: BTreeMap<&str, usize> = rows.filter(|(_, count)| *count != 1).collect();
    assert_eq!(several, DIFFERENT_NUMBERS.into_iter().collect());
}

/// What is read from a document goes from its row into the domain's value, whose fields are in SI and name
/// no unit: a type with such a field that is read would declare the number again.
#[test]
fn no_type_that_is_read_repeats_a_key_with_its_unit() {
    let keys = keys();
    let mut repeated = Vec::new();
    // The paper's table of results is no document.
    let documents =
        sources("document").into_iter().filter(|(path, _)| !path.ends_with("experiment.rs"));
    for (path, text) in documents {
        let mut is_read = false;
        for line in text.lines().map(str::trim) {
            if line.starts_with("#[derive(") {
                is_read = line.contains("Deserialize");
            }
            let field = line.trim_start_matches("pub ").trim_start_matches("pub(super) ");
            let name = field.split_once(": ").map(|(name, _)| name);
            if is_read && name.is_some_and(|name| keys.contains(name)) {
                repeated.push(format!("{}: {line}", path.display()));
            }
            if line == "}" {
                is_read = false;
            }
        }
    }
    assert!(repeated.is_empty(), "\n{}\n", repeated.join("\n"));
}
