//! Values of documents, each with the spot it came from.
//!
//! A run's values come from several texts: a scenario names a rover, the rover a wheel, the command
//! line overrides a key. They are brought together in one tree of [`Node`]s, each of which knows
//! its own text, so that whatever is found wrong later is reported where its author wrote it.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::file::{self, FileProblem};
use grouser_core::terrain::ElevationModel;
use grouser_raster::{CoordinateSystem, ReadOptions};
use serde_json::Value as Json;

/// A text that values come from.
#[derive(Debug, Default)]
pub(crate) struct Text {
    /// Its name in messages.
    pub label: String,
    /// What it says.
    pub content: String,
    /// Where its relative paths start.
    pub folder: PathBuf,
    /// Whether it is an argument: short, without lines, and quoted whole by its label.
    pub is_argument: bool,
    /// What it may name, before the files of its folder.
    pub beside: Beside,
}

impl Text {
    /// The path of a file that it names.
    ///
    /// # Errors
    /// [`FileProblem`] where it may name files of one folder only, and this is none.
    pub(crate) fn path_of(&self, name: &str) -> Result<PathBuf, FileProblem> {
        let path = self.folder.join(name);
        match &self.beside.within {
            Some(within) => file::confined(&path, within),
            None => Ok(path),
        }
    }

    /// The folder that files which it names have to be in.
    pub(crate) fn within(&self) -> Option<&Path> {
        self.beside.within.as_deref()
    }

    /// The bytes of the line around a byte, without its end.
    pub(crate) fn line_around(&self, byte: usize) -> Range<usize> {
        let mut byte = byte.min(self.content.len());
        while !self.content.is_char_boundary(byte) {
            byte -= 1;
        }
        let start = self.content[..byte].rfind('\n').map_or(0, |at| at + 1);
        let end = self.content[byte..].find('\n').map_or(self.content.len(), |at| byte + at);
        start..end
    }
}

/// Where a key or a value was written.
#[derive(Clone, Debug)]
pub struct Origin {
    pub(crate) text: Arc<Text>,
    pub(crate) span: Range<usize>,
}

/// A value and where it was written.
#[derive(Clone, Debug)]
pub struct Node {
    pub(crate) value: Value,
    /// Where it was written.
    pub origin: Origin,
}

/// A value as TOML knows it.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    String(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    Date(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Clone, Debug)]
pub struct Entry {
    pub(crate) key: String,
    /// Where the key was written.
    pub key_origin: Origin,
    /// Its value.
    pub node: Node,
}

impl Node {
    /// A table's entry of a name.
    #[must_use]
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.key == key)
    }

    /// The same, to be changed.
    pub(crate) fn entry_mut(&mut self, key: &str) -> Option<&mut Entry> {
        match &mut self.value {
            Value::Table(entries) => entries.iter_mut().find(|entry| entry.key == key),
            _ => None,
        }
    }

    /// A table's entries; none of anything else.
    pub(crate) fn entries(&self) -> &[Entry] {
        match &self.value {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    /// Where a key further down was written, or the nearest table above it that was.
    ///
    /// * `path`: keys and, for lists, indices, joined by dots
    #[must_use]
    pub fn origin_of(&self, path: &str) -> &Origin {
        let mut origin = &self.origin;
        let mut node = self;
        for step in path.split('.') {
            if let Some(entry) = node.entry(step) {
                node = &entry.node;
                origin = if matches!(node.value, Value::Table(_)) {
                    &entry.key_origin
                } else {
                    &node.origin
                };
            } else if let (Value::List(nodes), Ok(index)) = (&node.value, step.parse::<usize>())
                && let Some(child) = nodes.get(index)
            {
                node = child;
                origin = &child.origin;
            } else {
                break;
            }
        }
        origin
    }

    /// The tree without its origins.
    pub(crate) fn to_json(&self) -> Json {
        match &self.value {
            Value::String(string) | Value::Date(string) => Json::from(string.as_str()),
            Value::Integer(integer) => Json::from(*integer),
            Value::Float(float) => Json::from(*float),
            Value::Boolean(boolean) => Json::from(*boolean),
            Value::List(nodes) => nodes.iter().map(Self::to_json).collect(),
            Value::Table(entries) => {
                entries.iter().map(|entry| (entry.key.clone(), entry.node.to_json())).collect()
            }
        }
    }

    /// The value in a few words, as messages quote it.
    pub(crate) fn describe(&self) -> String {
        /// Characters of a string that a message quotes.
        const QUOTED: usize = 40;
        match &self.value {
            Value::String(string) if string.chars().count() > QUOTED => {
                let start: String = string.chars().take(QUOTED).collect();
                format!("the text \"{}…\"", start.escape_debug())
            }
            Value::String(string) => format!("the text \"{}\"", string.escape_debug()),
            Value::Integer(integer) => format!("the integer {integer}"),
            Value::Float(float) => format!("the number {}", number(*float)),
            Value::Boolean(boolean) => format!("the truth value {boolean}"),
            Value::Date(date) => format!("the date {date}"),
            Value::List(_) => "a list".to_owned(),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

/// A file that a resolved document names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Companion {
    /// Its name, from the folder of the document.
    pub name: String,
    /// What is in it.
    pub content: String,
}

/// A map of heights in memory, which a document names in `terrain.file`.
#[derive(Clone, Debug)]
pub struct HeldMap {
    /// Its name in documents: the whole path of its file; for a map without a file any other text.
    pub name: String,
    /// The map; its soil is not asked for.
    pub model: Arc<ElevationModel>,
    /// How its file was read. A document that asks for something else reads the file anew. Without
    /// a file the document has to leave all of that out.
    pub options: Option<ReadOptions>,
    /// The system of its coordinates; nothing where that was compared before, or is for others to
    /// know.
    pub system: Option<CoordinateSystem>,
}

/// What a text in memory may name, before the files of the current folder.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// Files.
    pub files: Vec<Companion>,
    /// Maps of heights.
    pub maps: Vec<HeldMap>,
    /// The folder, without links, that every other file has to be in, and where relative paths then
    /// start; any file may be named without one.
    pub within: Option<PathBuf>,
}

impl From<Vec<Companion>> for Beside {
    fn from(files: Vec<Companion>) -> Self {
        Self { files, ..Self::default() }
    }
}

/// A number as messages write it: without hundreds of zeros, and without what rounding left.
pub(crate) fn number(value: f64) -> String {
    let value: f64 = format!("{value:.8e}").parse().unwrap_or(value);
    let size = value.abs();
    let is_short = size == 0.0 || (1e-5..1e9).contains(&size) || !size.is_finite();
    if is_short { format!("{value}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn huge_numbers_stay_short() {
        assert_eq!(number(1e300), "1e300");
        assert_eq!(number(-0.06), "-0.06");
        assert_eq!(number(0.1 + 0.2), "0.3");
        assert_eq!(number(f64::NAN), "NaN");
        assert_eq!(number(f64::INFINITY), "inf");
        assert_eq!(number(86_400.0), "86400");
    }
}
