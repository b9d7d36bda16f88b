//! Gravities that documents and flags call by name.

use grouser_core::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY};

use super::tree::{Node, Value};

/// Gravities by name, with their values [m/s²].
pub const GRAVITIES: [(&str, f64); 3] =
    [("earth", EARTH_GRAVITY), ("moon", MOON_GRAVITY), ("mars", MARS_GRAVITY)];

/// A gravity [m/s²] by its name: `earth`, `moon` or `mars`.
#[must_use]
pub fn gravity(name: &str) -> Option<f64> {
    GRAVITIES.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// Puts numbers for the words that stand for a gravity at the top of a document and in its lists.
pub(crate) fn read_words(tree: &mut Node) {
    const KEY: &str = "gravity_m_s2";
    let Value::Table(entries) = &mut tree.value else { return };
    for entry in entries {
        match &mut entry.node.value {
            Value::String(name) if entry.key == KEY => {
                if let Some(number) = gravity(name) {
                    entry.node.value = Value::Float(number);
                }
            }
            Value::List(nodes) => nodes.iter_mut().for_each(read_words),
            _ => {}
        }
    }
}
