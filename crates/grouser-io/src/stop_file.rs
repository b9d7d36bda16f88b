//! Limits of a mission that stand in a file of their own: a table `[stop]`, as `grouser card
//! --stops` writes it.

use std::sync::Arc;

use serde_json::Value as Json;

use super::error::{DocumentError, Problem};
use super::given_file::{FileContent, GivenFile};
use super::legs_file;
use super::mission::STOP_FROM;
use super::text::parse;
use super::tree::{Entry, Node, Value};

/// The key of a mission under which its limits stand, and the only one of the file.
const STOP: &str = "stop";

/// Puts the limits of the file that a mission names beside its own, which stand in place of the
/// file's for the same numbers, so that it names none any more.
pub(crate) fn put_in(mission: &mut Node) -> Result<(), DocumentError> {
    let Some(entry) = mission.entry(STOP_FROM) else { return Ok(()) };
    // What is no text is for the check to report.
    let Value::String(name) = &entry.node.value else { return Ok(()) };
    let origin = entry.node.origin.clone();
    let read = read(name, &entry.node).map_err(|error| error.named_by(&origin))?;
    let Value::Table(entries) = &mut mission.value else { return Ok(()) };
    entries.retain(|entry| entry.key != STOP_FROM);
    match entries.iter_mut().find(|entry| entry.key == STOP).map(|entry| &mut entry.node.value) {
        Some(Value::Table(own)) => {
            let Value::Table(mut limits) = read.node.value else { return Ok(()) };
            limits.retain(|limit| own.iter().all(|own| own.key != limit.key));
            own.append(&mut limits);
        }
        Some(_) => {}
        None => entries.push(read),
    }
    Ok(())
}

/// The table of a file.
fn read(name: &str, named: &Node) -> Result<Entry, DocumentError> {
    let tree = parse(&legs_file::text_of(name, &named.origin)?)?;
    if let Some(other) = tree.entries().iter().find(|entry| entry.key != STOP) {
        let problem = Problem::UnknownKey { key: other.key.clone() };
        return Err(DocumentError::at(&other.key_origin, problem)
            .with_hint("a file of limits has one table, [stop]".to_owned()));
    }
    tree.entry(STOP).cloned().ok_or_else(|| {
        let problem = Problem::MissingKey { key: STOP.to_owned() };
        DocumentError::at(&tree.origin, problem)
            .with_hint("a file of limits has one table, [stop]".to_owned())
    })
}

/// What the file of a mission's limits gave; nothing where none of them counts, or there is no file.
pub(crate) fn given(mission: &Node) -> Option<GivenFile> {
    let limits = mission.entry(STOP)?.node.entries();
    let of_file = |limit: &Entry| {
        let text = &limit.node.origin.text;
        let file: Json = toml::from_str(&text.content).ok()?;
        let all = file[STOP].as_object().filter(|all| all.contains_key(&limit.key))?.len();
        (!Arc::ptr_eq(text, &mission.origin.text)).then(|| (text.label.clone(), all as u64))
    };
    let found: Vec<(String, u64)> = limits.iter().filter_map(of_file).collect();
    let (file, there) = found.first()?.clone();
    Some(GivenFile::new(file, FileContent::Stops, there, found.len() as u64))
}

/// A limit of a file that a mission has itself, with another number.
#[derive(Clone, Debug, PartialEq)]
pub struct Overruled {
    /// Its name, as `slip_ratio`.
    pub name: String,
    /// The file's number, in the unit of its name.
    pub file: f64,
    /// The mission's, which stands.
    pub mission: f64,
}

/// The limits of a file that do not count, because the mission has its own.
///
/// * `text`: of the file
/// * `stop`: the mission's table `[stop]`
#[must_use]
pub fn overruled(text: &str, stop: &Json) -> Vec<Overruled> {
    let table: Json = toml::from_str(text).unwrap_or_default();
    let above = |limit: &Json| limit.as_f64().or_else(|| limit["above"].as_f64());
    let limits = table[STOP].as_object().into_iter().flatten();
    let both = limits.filter_map(|(name, limit)| {
        let (file, mission) = (above(limit)?, above(&stop[name.as_str()])?);
        Some(Overruled { name: name.clone(), file, mission })
    });
    both.filter(|it| it.file != it.mission).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn limits_of_the_mission_overrule_those_of_a_file() {
        let file = "[stop]\nslip_ratio = { above = 0.18, over_m = 1.0 }\nroll_deg = 17.0\n\
                    sinkage_mm = 20\n";
        let stop = json!({ "slip_ratio": 0.4, "roll_deg": { "above": 17.0 } });
        let found = overruled(file, &stop);
        let expected = Overruled { name: "slip_ratio".to_owned(), file: 0.18, mission: 0.4 };
        assert_eq!(found, [expected]);
        assert_eq!(overruled("no TOML", &stop), []);
    }
}
