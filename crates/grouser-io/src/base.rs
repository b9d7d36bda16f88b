//! A document that starts from a preset: `preset = "NAME"` brings the preset's keys, those that the
//! document has itself stand in their place.

use super::error::{DocumentError, Problem};
use super::field::PRESET;
use super::kind::Kind;
use super::notes;
use super::source::Source;
use super::text;
use super::tree::{Entry, Node, Value};

/// Puts the keys of the preset that a motor names beside its own, and takes the name away.
///
/// Where the name was set from outside, as by `--set motor.preset=NAME`, it stands for another
/// motor: of the document's own keys only those stay that were set so, too. Keys that stay are
/// assumptions, unless the document has a source of its own: that of the preset has others.
///
/// # Errors
/// [`DocumentError`] if there is no such preset.
pub(crate) fn take(tree: &mut Node) -> Result<(), DocumentError> {
    let Value::Table(entries) = &mut tree.value else { return Ok(()) };
    let Some(place) = entries.iter().position(|entry| entry.key == PRESET) else { return Ok(()) };
    // What is no text is for the check to report.
    let Value::String(name) = entries[place].node.value.clone() else { return Ok(()) };
    let origin = entries[place].node.origin.clone();
    let source = Source::find(Kind::Motor, &name).map_err(|error| error.seen_from(&origin))?;
    if !matches!(source, Source::Preset(_)) {
        let problem = Problem::Conflict("`preset` is the name of a preset, not a path");
        return Err(DocumentError::at(&origin, problem)
            .with_hint("the motor of a file is named in the rover: motor = \"FILE\"".to_owned()));
    }
    let mut base = text::parse(&source.read()?)?;
    entries.remove(place);
    if origin.text.is_argument {
        entries.retain(|entry| entry.key_origin.text.is_argument);
    }
    let mut assumed = notes::assumed(&base);
    let mut own = std::mem::take(entries);
    let has_source = own.iter().any(|entry| entry.key == "source");
    let owned = Node { value: Value::Table(own.clone()), origin };
    own.retain(|entry| entry.key != "assumed");
    let mut changed = Vec::new();
    for entry in own {
        put(&mut base, entry, "", &mut changed);
    }
    for key in changed {
        assumed.retain(|one| one.split(':').next() != Some(&key));
        if !has_source {
            let by = format!("{key}: set by the document, not by the source of {name}");
            assumed.push(by);
        }
    }
    assumed.extend(notes::assumed(&owned));
    notes::put(&mut base, &assumed);
    tree.value = base.value;
    Ok(())
}

/// Puts an entry into a table, key by key where both are tables.
///
/// * `path`: of the table, with a dot at its end, or nothing
/// * `changed`: gets the keys of the numbers, words and flags that are put in
fn put(table: &mut Node, entry: Entry, path: &str, changed: &mut Vec<String>) {
    const ABOUT: [&str; 5] = ["schema", "name", "source", "notes", "assumed"];
    let key = format!("{path}{}", entry.key);
    if matches!(entry.node.value, Value::Table(_)) {
        let Value::Table(entries) = &mut table.value else { return };
        let place = entries.iter().position(|it| it.key == entry.key).unwrap_or(entries.len());
        if place == entries.len() {
            let node = Node { value: Value::Table(Vec::new()), origin: entry.node.origin.clone() };
            entries.push(Entry { node, ..entry.clone() });
        }
        let Value::Table(inner) = entry.node.value else { return };
        for entry in inner {
            put(&mut entries[place].node, entry, &format!("{key}."), changed);
        }
        return;
    }
    if !ABOUT.contains(&key.as_str()) {
        changed.push(key);
    }
    match table.entry_mut(&entry.key) {
        Some(there) => *there = entry,
        None => {
            if let Value::Table(entries) = &mut table.value {
                entries.push(entry);
            }
        }
    }
}
