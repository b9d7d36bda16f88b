//! A number of a document is declared once, as a row of a table in `document/describe`; a result
//! once, as a column in `document/columns`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use grouser::document::columns::Column;
use grouser::document::columns::heading::{BAND, held};
use grouser::document::columns::run::{RECORD, WHEEL_RECORD};
use grouser::document::columns::stand::TRIALS;
use grouser::document::columns::wheel::WHEEL;
use grouser::document::design::Measure;
use grouser::document::unit_of;
use grouser::document::{self, Kind};
use grouser::mission::Limited;
use serde_json::Value;

/// Keys that name different numbers in different places, and how many rows they have.
const DIFFERENT_NUMBERS: [(&str, usize); 11] = [
    // Of the soil in itself, and between soil and wheel.
    ("friction_angle_deg", 2),
    // Of the body, and of a wheel with its motor.
    ("mass_kg", 2),
    ("inertia_kg_m2", 2),
    // Of a wheel, a stand or a scenario, and the range that a soil's constants were fitted to; of
    // an arc.
    ("radius_m", 3),
    ("width_m", 2),
    ("load_n", 2),
    ("slip_angle_deg", 2),
    ("gravity_m_s2", 2),
    // Of the plane, and of ground by a formula.
    ("slope_deg", 2),
    // Of a layer that would slide, and of a crater.
    ("depth_m", 2),
    // At the start, over time, and before a leg.
    ("yaw_deg", 3),
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

/// The sources below a folder of the repository's crates.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    sources_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder))
}

fn sources_below(folder: &Path) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
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
    let describe = Path::new(env!("CARGO_MANIFEST_DIR")).join("../grouser-io/src/describe.rs");
    let mut texts = fs::read_to_string(describe).expect("a source is text");
    texts.extend(sources("grouser-io/src/describe").into_iter().map(|(_, text)| text));
    let keys = keys();
    assert!(keys.contains("cohesion_kpa") && keys.len() > 20, "{keys:?}");
    let rows = keys.iter().map(|key| (key.as_str(), texts.matches(&format!("\"{key}\"")).count()));
    // Limits have the names of what they limit.
    let limits = Limited::ALL.map(|limited| document::limited_quantity(limited).name);
    let limits = [&limits[..], &Measure::ALL.map(Measure::name)].concat();
    let rows = rows.filter(|(key, count)| *count != 0 || !limits.contains(key));
    let several: BTreeMap<&str, usize> = rows.filter(|(_, count)| *count != 1).collect();
    assert_eq!(several, DIFFERENT_NUMBERS.into_iter().collect());
}

/// What is read from a document goes from its row into the domain's value, whose fields are in SI
/// and name no unit: a type with such a field that is read would declare the number again.
#[test]
fn no_type_that_is_read_repeats_a_key_with_its_unit() {
    let keys = keys();
    let mut repeated = Vec::new();
    // The paper's table of results is no document.
    let documents = [sources("grouser-io/src"), sources("grouser/src/document")];
    let documents = documents.into_iter().flatten();
    for (path, text) in documents.filter(|(path, _)| !path.ends_with("experiment.rs")) {
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

/// Results that have the name of a document's key, such as a slope: the key has its row, and
/// options and settings repeat it.
fn is_a_key_too(name: &str) -> bool {
    keys().contains(name)
}

/// Where a name that only results have stands once more, and why.
const OTHER_PLACES: [(&str, &str); 10] = [
    // Options of the program and arguments of Python's functions, which results repeat.
    ("most_slope_deg", "src/args/route.rs"),
    ("most_slope_deg", "grouser-python/src/routes.rs"),
    // Parts of a log that are asked for.
    ("from_s", "src/args/replay.rs"),
    ("to_s", "src/args/replay.rs"),
    ("to_s", "grouser-python/src/replay.rs"),
    // A direction on a path that is asked for.
    ("heading_deg", "grouser-python/src/paths.rs"),
    ("along_m", "grouser-python/src/paths.rs"),
    // A way as a record, which has lists beside the numbers of its row.
    ("turned_deg", "document/route.rs"),
    ("battery_energy_j", "document/route.rs"),
    ("most_slope_deg", "document/route.rs"),
];

/// Names in quotes, and names of fields, in a line of a source.
fn names_of(line: &str) -> Vec<&str> {
    let code = line.split("//").next().unwrap_or_default();
    let quoted = code.split('"').skip(1).step_by(2);
    let field = code.trim().trim_start_matches("pub ").trim_start_matches("pub(crate) ");
    quoted.chain(field.split_once(':').map(|(name, _)| name)).collect()
}

/// The lines of a source before its tests.
fn lines_of(text: &str) -> impl Iterator<Item = &str> {
    text.lines().take_while(|line| *line != "#[cfg(test)]")
}

#[test]
fn a_result_has_one_column() {
    let is_of_columns = |path: &Path| {
        let within = path.components().any(|part| part.as_os_str() == "columns");
        (within || path.ends_with("columns.rs")) && !path.ends_with("measurements/columns.rs")
    };
    let (columns, others): (Vec<_>, Vec<_>) =
        ["grouser-io/src", "grouser/src", "grouser-cli/src", "grouser-python/src"]
            .into_iter()
            .flat_map(sources)
            .partition(|(path, _)| {
                !path.display().to_string().contains("grouser-cli")
                    && !path.display().to_string().contains("grouser-python")
                    && is_of_columns(path)
            });
    let declared = columns.iter().flat_map(|(_, text)| lines_of(text)).flat_map(|line| {
        let quoted = names_of(line).into_iter();
        quoted.filter(|name| {
            let is_name =
                |letter: char| letter.is_ascii_lowercase() || "_0123456789".contains(letter);
            name.chars().all(is_name) && unit_of(name).is_some()
        })
    });
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    declared.for_each(|name| *counts.entry(name).or_default() += 1);
    assert!(counts.len() > 35 && counts.contains_key("sinkage_mm"), "{counts:?}");
    let several: Vec<_> = counts.iter().filter(|(_, count)| **count != 1).collect();
    assert!(several.is_empty(), "declared more than once: {several:?}");

    let mut used = BTreeSet::new();
    let mut again = Vec::new();
    for (path, text) in &others {
        for (number, line) in lines_of(text).enumerate() {
            for name in names_of(line) {
                if !counts.contains_key(name) || is_a_key_too(name) {
                    continue;
                }
                let path = path.display().to_string();
                let other =
                    OTHER_PLACES.iter().find(|(it, end)| *it == name && path.ends_with(end));
                match other {
                    Some(place) => drop(used.insert(*place)),
                    None => again.push(format!("{path}:{}: {}", number + 1, line.trim())),
                }
            }
        }
    }
    assert!(again.is_empty(), "\n{}\n", again.join("\n"));
    let idle: Vec<_> = OTHER_PLACES.iter().filter(|place| !used.contains(*place)).collect();
    assert!(idle.is_empty(), "nothing to excuse: {idle:?}");
}

/// The unit of a column is that of its name's end, so that a reader of the name converts as the
/// library does.
#[test]
fn a_column_has_the_unit_of_its_name() {
    fn check<R>(columns: &[Column<R>]) {
        for column in columns {
            let expected = unit_of(column.name).map_or("-", |unit| unit.symbol);
            assert_eq!(column.unit.symbol, expected, "{}", column.name);
            for name in column.names().iter().filter(|name| name.starts_with(column.name)) {
                assert_eq!(unit_of(name), unit_of(column.name), "{name}");
            }
            assert!(!column.doc.is_empty() && !column.doc.ends_with('.'), "{}", column.name);
        }
    }
    check(&WHEEL);
    check(&RECORD);
    check(&WHEEL_RECORD);
    check(&held());
    check(&BAND);
    check(&TRIALS);
}
