//! Legs of a mission that stand in a file of their own: a table as CSV, or places as GeoJSON.

use std::path::Path;
use std::sync::Arc;

use grouser_core::terrain::Extent;
use grouser_core::units::Vec2;
use grouser_raster::zones::geojson::compare_system;
use grouser_raster::{CoordinateSystem, Fault};
use serde_json::Value as Json;

use super::describe::run::TERRAIN;
use super::describe::terrain::{FILE, START};
use super::error::{DocumentError, Problem};
use super::given_file::{FileContent, GivenFile};
use super::lines::{cells, check_count, lines};
use super::mission::LEGS_FROM;
use super::source::{LARGEST_FILE, read_file};
use super::text::DEEPEST;
use super::tree::{Entry, Node, Origin, Text, Value};

/// The key of a mission under which its legs stand.
const LEGS: &str = "leg";

/// Puts the legs of the file that a mission names before its own, so that it names none any more.
/// Over a map, a mission that has no place to start at gets that at which a line begins.
pub(crate) fn put_in(mission: &mut Node) -> Result<(), DocumentError> {
    let Some(entry) = mission.entry(LEGS_FROM) else { return Ok(()) };
    // What is no text is for the check to report.
    let Value::String(name) = &entry.node.value else { return Ok(()) };
    let (origin, key_origin) = (entry.node.origin.clone(), entry.key_origin.clone());
    let mut legs = read(name, &origin).map_err(|error| error.named_by(&origin))?;
    let Value::Table(entries) = &mut mission.value else { return Ok(()) };
    entries.retain(|entry| entry.key != LEGS_FROM);
    match entries.iter_mut().find(|entry| entry.key == LEGS).map(|entry| &mut entry.node.value) {
        Some(Value::List(own)) => {
            legs.append(own);
            *own = legs;
        }
        Some(_) => {}
        None => {
            let node = Node { value: Value::List(legs), origin };
            entries.push(Entry { key: LEGS.to_owned(), key_origin, node });
        }
    }
    let line = start_of_line(mission);
    if let Some((start, Value::Table(terrain))) =
        line.zip(mission.entry_mut(TERRAIN).map(|it| &mut it.node.value))
    {
        let has = |key: &str| terrain.iter().any(|entry| entry.key == key);
        if has(FILE) && !has(START) {
            let key_origin = start.origin.clone();
            terrain.push(Entry { key: START.to_owned(), key_origin, node: start });
        }
    }
    Ok(())
}

/// Checks that a mission has no more legs than a rover drives in its life: each takes some kilobytes.
pub(crate) fn check_legs(mission: &Node) -> Result<(), DocumentError> {
    const MOST: usize = 20_000;
    match mission.entry(LEGS) {
        Some(Entry { key_origin, node: Node { value: Value::List(legs), .. }, .. })
            if legs.len() > MOST =>
        {
            let problem = Problem::Conflict("a mission has at most 20000 legs");
            Err(DocumentError::at(key_origin, problem))
        }
        _ => Ok(()),
    }
}

/// The text of a file that a mission names.
///
/// * `origin`: where it is named
pub(crate) fn text_of(name: &str, origin: &Origin) -> Result<Arc<Text>, DocumentError> {
    let beside = origin.text.beside.files.iter().find(|beside| beside.name == name);
    let (label, content) = if let Some(beside) = beside {
        (name.to_owned(), beside.content.clone())
    } else {
        let path = origin.text.path_of(name);
        let path = path.map_err(|why| DocumentError::at(origin, why.into()))?;
        let label = path.display().to_string();
        let content = read_file(&path, origin.text.within(), LARGEST_FILE)
            .map_err(|problem| DocumentError::whole(&label, problem))?;
        (label, content)
    };
    Ok(Arc::new(Text { label, content, ..Text::default() }))
}

fn read(name: &str, origin: &Origin) -> Result<Vec<Node>, DocumentError> {
    let text = text_of(name, origin)?;
    let ends_in =
        |end: &str| Path::new(name).extension().is_some_and(|it| it.eq_ignore_ascii_case(end));
    if ends_in("csv") {
        let legs = of_csv(&text)?;
        check_places(&text, None, &legs)?;
        Ok(legs)
    } else if ends_in("geojson") || ends_in("json") {
        of_geojson(&text)
    } else {
        let what = "its name ends in neither .csv nor .geojson".to_owned();
        Err(DocumentError::whole(&text.label, Problem::NoLegs(what)))
    }
}

// ---- CSV: the first line has keys of a leg, every other line is one ----

fn of_csv(text: &Arc<Text>) -> Result<Vec<Node>, DocumentError> {
    let lines: Vec<_> = lines(&text.content).collect();
    let Some(((_, header), rows)) = lines.split_first() else {
        return Err(DocumentError::whole(&text.label, Problem::NoLegs("it is empty".to_owned())));
    };
    let keys: Vec<&str> = cells(header).map(|(_, key)| key).collect();
    if keys.iter().any(|key| key.split('.').count() > DEEPEST) {
        return Err(DocumentError::whole(&text.label, Problem::TooDeep { limit: DEEPEST }));
    }
    rows.iter().map(|(from, line)| row(text, &keys, *from, line)).collect()
}

fn row(text: &Arc<Text>, keys: &[&str], from: usize, line: &str) -> Result<Node, DocumentError> {
    let origin =
        |from: usize, length: usize| Origin { text: text.clone(), span: from..from + length };
    let whole = origin(from, line.len());
    check_count(line, (keys.len(), "keys"), &whole, Problem::NoLegs)?;
    let mut leg = Node { value: Value::Table(Vec::new()), origin: whole };
    for (key, (offset, cell)) in keys.iter().zip(cells(line)) {
        if !cell.is_empty() {
            let node = Node { value: value_of(cell), origin: origin(from + offset, cell.len()) };
            put(&mut leg, key, node);
        }
    }
    Ok(leg)
}

/// A cell: a number, a truth value, or else a text.
fn value_of(cell: &str) -> Value {
    match (cell.parse::<f64>(), cell) {
        (Ok(number), _) => Value::Float(number),
        (_, "true") => Value::Boolean(true),
        (_, "false") => Value::Boolean(false),
        _ => Value::String(cell.to_owned()),
    }
}

/// Puts a value under a dotted key.
fn put(table: &mut Node, key: &str, node: Node) {
    let Value::Table(entries) = &mut table.value else { return };
    let (first, rest) =
        key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
    let origin = node.origin.clone();
    let Some(rest) = rest else {
        entries.push(Entry { key: first.to_owned(), key_origin: origin, node });
        return;
    };
    let place = entries.iter().position(|entry| entry.key == first).unwrap_or_else(|| {
        let inner = Node { value: Value::Table(Vec::new()), origin: origin.clone() };
        entries.push(Entry { key: first.to_owned(), key_origin: origin, node: inner });
        entries.len() - 1
    });
    put(&mut entries[place].node, rest, node);
}

// ---- GeoJSON: points, and the vertices of lines, are waypoints ----

fn of_geojson(text: &Arc<Text>) -> Result<Vec<Node>, DocumentError> {
    let fault = |what: String| DocumentError::whole(&text.label, Problem::NoLegs(what));
    let json: Json =
        serde_json::from_str(&text.content).map_err(|error| fault(format!("no JSON: {error}")))?;
    let mut legs = Vec::new();
    for (geometry, properties) in features(&json) {
        let places: Vec<&Json> = match geometry["type"].as_str() {
            Some("Point") => vec![&geometry["coordinates"]],
            Some("LineString" | "MultiPoint") => {
                geometry["coordinates"].as_array().into_iter().flatten().collect()
            }
            other => {
                let found = other.unwrap_or("no geometry");
                return Err(fault(format!(
                    "it has a {found}, it may have Point, MultiPoint and LineString"
                )));
            }
        };
        for place in places {
            let [Some(x), Some(y)] = [place[0].as_f64(), place[1].as_f64()] else {
                return Err(fault(format!("{place} is no place: two numbers are, x and y")));
            };
            legs.push(waypoint(text, [x, y], properties));
        }
    }
    if legs.is_empty() {
        return Err(fault("it has no features".to_owned()));
    }
    check_places(text, json["crs"]["properties"]["name"].as_str(), &legs)?;
    Ok(legs)
}

/// Checks that places to go to are metres, not degrees.
///
/// * `system`: the name of their coordinate system, if the file has one
fn check_places(text: &Text, system: Option<&str>, legs: &[Node]) -> Result<(), DocumentError> {
    let all: Vec<Vec2> = legs
        .iter()
        .filter_map(|leg| {
            let goto = &leg.entry("goto")?.node;
            let [x, y] = ["x_m", "y_m"].map(|key| match goto.entry(key)?.node.value {
                Value::Float(number) => Some(number),
                _ => None,
            });
            Some(Vec2::new(x?, y?))
        })
        .collect();
    let Some(extent) = Extent::around(&all) else { return Ok(()) };
    grouser_raster::check_places(system, &extent).map_err(|found| in_legs(text, &found))
}

/// What is wrong with a file of places.
fn in_legs(text: &Text, fault: &Fault) -> DocumentError {
    let (what, hint) = fault.in_parts("file", Some(Path::new(&text.label)));
    DocumentError::whole(&text.label, Problem::NoLegs(what)).with_hint(hint)
}

/// What the files of a mission's legs gave.
pub(crate) fn given(mission: &Node) -> Vec<GivenFile> {
    let mut files: Vec<(&Arc<Text>, u64)> = Vec::new();
    for leg in legs_of(mission) {
        let text = &leg.origin.text;
        match files.last_mut().filter(|(file, _)| Arc::ptr_eq(file, text)) {
            Some((_, legs)) => *legs += 1,
            None => files.push((text, 1)),
        }
    }
    let is_file = |(text, _): &(&Arc<Text>, u64)| !Arc::ptr_eq(text, &mission.origin.text);
    let given = |(text, legs): (&Arc<Text>, u64)| {
        GivenFile::new(text.label.clone(), FileContent::Legs, legs, legs)
    };
    files.into_iter().filter(is_file).map(given).collect()
}

/// What a mission does with the legs of a file, where that is not all that it does: it starts where
/// their line does, and has legs of its own after them.
pub(crate) fn notes(mission: &Node) -> Vec<String> {
    let legs = legs_of(mission);
    let Some(text) = legs.first().map(|leg| &leg.origin.text) else { return Vec::new() };
    if Arc::ptr_eq(text, &mission.origin.text) {
        return Vec::new();
    }
    let (name, all) = (&text.label, legs.len());
    let is_of_file = |leg: &&Node| Arc::ptr_eq(&leg.origin.text, text);
    let of_file = legs.iter().take_while(is_of_file).count();
    let own = (of_file < all).then(|| {
        let own = match all - of_file {
            1 => format!("the mission's own, {all}"),
            _ => format!("the mission's own, {} to {all}", of_file + 1),
        };
        format!("{name}: after its {of_file} legs come {own}")
    });
    let start = mission.entry(TERRAIN).and_then(|entry| entry.node.entry(START));
    let start = start.map(|entry| &entry.node).filter(is_of_file).map(|place| {
        format!("{name}: the rover starts where its line does, at {}", place.to_json())
    });
    start.into_iter().chain(own).collect()
}

/// Where a file of legs begins whose first geometry is a line; `None` of a mission whose first legs
/// are no such file's.
fn start_of_line(mission: &Node) -> Option<Node> {
    let origin = &legs_of(mission).first()?.origin;
    let json: Json = serde_json::from_str(&origin.text.content).ok()?;
    let (geometry, _) = *features(&json).first()?;
    let [x, y] = [0, 1].map(|place| geometry["coordinates"][0][place].as_f64());
    let node = |value: Value| Node { value, origin: origin.clone() };
    let place = vec![node(Value::Float(x?)), node(Value::Float(y?))];
    (geometry["type"] == "LineString").then(|| node(Value::List(place)))
}

/// The legs of a mission.
fn legs_of(mission: &Node) -> &[Node] {
    match mission.entry(LEGS).map(|entry| &entry.node.value) {
        Some(Value::List(legs)) => legs,
        _ => &[],
    }
}

/// Compares the systems that the files of a mission's legs name with that of its map; notes where
/// that cannot be done.
pub(crate) fn compare_systems(
    mission: &Node,
    map: &CoordinateSystem,
) -> Result<Vec<String>, DocumentError> {
    let mut texts: Vec<&Arc<Text>> = legs_of(mission).iter().map(|leg| &leg.origin.text).collect();
    texts.dedup_by(|one, other| Arc::ptr_eq(one, other));
    let note = |text: &Arc<Text>| {
        let remark = compare_system(text.content.as_bytes(), map);
        let remark = remark.map_err(|fault| in_legs(text, &fault)).transpose()?;
        Some(remark.map(|remark| format!("{}: {remark}", text.label)))
    };
    texts.into_iter().filter_map(note).collect()
}

/// The geometries of a document with their properties, in order.
fn features(json: &Json) -> Vec<(&Json, &Json)> {
    match json["type"].as_str() {
        Some("FeatureCollection") => {
            json["features"].as_array().into_iter().flatten().flat_map(features).collect()
        }
        Some("Feature") => vec![(&json["geometry"], &json["properties"])],
        Some("GeometryCollection") => {
            let all = json["geometries"].as_array().into_iter().flatten();
            all.map(|geometry| (geometry, &Json::Null)).collect()
        }
        _ => vec![(json, &Json::Null)],
    }
}

/// Properties of a feature that are keys of its legs; programs add many others.
const PROPERTIES: [&str; 5] = ["speed_m_s", "yaw_deg", "reverse", "look_ahead_m", "within_m"];

fn waypoint(text: &Arc<Text>, [x, y]: [f64; 2], properties: &Json) -> Node {
    let node = |value: Value| Node { value, origin: Origin { text: text.clone(), span: 0..0 } };
    let mut leg = node(Value::Table(Vec::new()));
    put(&mut leg, "goto.x_m", node(Value::Float(x)));
    put(&mut leg, "goto.y_m", node(Value::Float(y)));
    for key in PROPERTIES {
        let value = match &properties[key] {
            Json::Bool(yes) => Value::Boolean(*yes),
            Json::Number(number) => Value::Float(number.as_f64().unwrap_or(f64::NAN)),
            Json::String(text) => Value::String(text.clone()),
            _ => continue,
        };
        let key = if key == "within_m" { "goto.within_m" } else { key };
        put(&mut leg, key, node(value));
    }
    leg
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Companion, Overrides, Source, read_mission};

    fn refusal(content: String) -> DocumentError {
        let legs = Companion { name: "legs.csv".to_owned(), content };
        let mission = "schema = \"mission/1\"\nname = \"one\"\nlegs_from = \"legs.csv\"\n";
        let source = Source::text_with("a mission", mission, vec![legs]);
        read_mission(&source, &Overrides::none()).expect_err("it is refused")
    }

    #[test]
    fn a_key_of_many_dots_cannot_nest_until_the_stack_is_full() {
        let error = refusal(format!("drive_m,stop{}\n1.0,2.0\n", ".a".repeat(200_000)));
        assert!(matches!(error.problem(), Problem::TooDeep { .. }), "{error}");
    }

    #[test]
    fn more_legs_than_a_rover_drives_are_refused() {
        let error = refusal(format!("drive_m\n{}", "1.0\n".repeat(100_000)));
        assert!(error.to_string().contains("at most 20000 legs"), "{error}");
    }
}
