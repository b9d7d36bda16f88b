//! Limits of a mission that stand in a file of their own: a table `[stop]`, as `grouser card
//! --stops` writes it.

use super::error::{DocumentError, Problem};
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
