//! Texts and the values in them, each with the spot it came from.
//!
//! A run's values come from several texts: a scenario names a rover, the rover a wheel, the command
//! line overrides a key. They are brought together in one tree of [`Node`]s, each of which knows
//! its own text, so that whatever is found wrong later is reported where its author wrote it.

use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;

use serde_json::Value as Json;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::Companion;
use super::error::{DocumentError, Problem, number};

/// A text that values come from.
#[derive(Debug, Default)]
pub struct Text {
    /// Its name in messages.
    pub label: String,
    /// What it says.
    pub content: String,
    /// Where its relative paths start.
    pub folder: PathBuf,
    /// Whether it is an argument: short, without lines, and quoted whole by its label.
    pub is_argument: bool,
    /// Files beside it that it may name, before those of its folder.
    pub companions: Vec<Companion>,
}

impl Text {
    /// The bytes of the line around a byte, without its end.
    pub fn line_around(&self, byte: usize) -> Range<usize> {
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
    pub text: Arc<Text>,
    pub span: Range<usize>,
}

/// A value and where it was written.
#[derive(Clone, Debug)]
pub struct Node {
    pub value: Value,
    pub origin: Origin,
}

/// A value as TOML knows it.
#[derive(Clone, Debug)]
pub enum Value {
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
    pub key: String,
    pub key_origin: Origin,
    pub node: Node,
}

/// Tables and lists may be nested this deep. Ours are five deep: a mount's position in a rover
/// in a scenario.
const DEEPEST: usize = 16;

/// The tree of a TOML text.
///
/// The parser gives up at 80 brackets and at 80 dots, which together can nest a few thousand
/// tables: little enough for any stack. Our own limit is far below.
pub fn parse(text: &Arc<Text>) -> Result<Node, DocumentError> {
    let whole = Origin { text: text.clone(), span: 0..0 };
    let document = DeTable::parse(&text.content).map_err(|error| {
        let span = error.span().unwrap_or(0..0);
        let line = text.line_around(span.start);
        let part = |range: Range<usize>| text.content.get(range).unwrap_or_default().trim();
        let (before, after) = (part(line.start..span.start), part(span.start..line.end));
        let says = if before.ends_with('=') && after.is_empty() {
            "there is no value after `=`".to_owned()
        } else {
            error.message().trim().replace('\n', ", ")
        };
        DocumentError::at(&Origin { text: text.clone(), span }, Problem::Syntax(says))
    })?;
    Reader { text }.table(document.get_ref(), whole, 0)
}

/// Takes the parser's tables over into ours.
struct Reader<'a> {
    text: &'a Arc<Text>,
}

impl Reader<'_> {
    fn origin(&self, span: Range<usize>) -> Origin {
        Origin { text: self.text.clone(), span }
    }

    /// Whether a value was written with this at its start.
    fn starts_with(&self, value: &Spanned<DeValue<'_>>, start: char) -> bool {
        self.text.content[value.span().start..].starts_with(start)
    }

    fn table(
        &self,
        table: &DeTable<'_>,
        origin: Origin,
        depth: usize,
    ) -> Result<Node, DocumentError> {
        if depth > DEEPEST {
            return Err(DocumentError::at(&origin, Problem::TooDeep { limit: DEEPEST }));
        }
        // The parser sorts by name; whatever is wrong first is to be told first.
        let mut written: Vec<_> = table.iter().collect();
        written.sort_by_key(|(key, _)| key.span().start);
        let mut entries = Vec::new();
        for (key, value) in written {
            let key_origin = self.origin(key.span());
            let node = self.value(value, &key_origin, depth + 1)?;
            entries.push(Entry { key: key.get_ref().to_string(), key_origin, node });
        }
        Ok(Node { value: Value::Table(entries), origin })
    }

    /// * `key`: where a table under a header has its name
    fn value(
        &self,
        value: &Spanned<DeValue<'_>>,
        key: &Origin,
        depth: usize,
    ) -> Result<Node, DocumentError> {
        let origin = self.origin(value.span());
        let value = match value.get_ref() {
            DeValue::String(string) => Value::String(string.to_string()),
            DeValue::Integer(integer) => {
                let parsed = i64::from_str_radix(integer.as_str(), integer.radix());
                Value::Integer(parsed.map_err(|_| overflow(&origin, "integer"))?)
            }
            DeValue::Float(float) => match float.as_str().parse::<f64>() {
                Ok(parsed) if !parsed.is_infinite() || float.as_str().contains("inf") => {
                    Value::Float(parsed)
                }
                _ => return Err(overflow(&origin, "floating-point")),
            },
            DeValue::Boolean(boolean) => Value::Boolean(*boolean),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Table(table) => {
                let is_inline = self.starts_with(value, '{');
                return self.table(table, if is_inline { origin } else { key.clone() }, depth);
            }
            DeValue::Array(_) if depth > DEEPEST => {
                return Err(DocumentError::at(&origin, Problem::TooDeep { limit: DEEPEST }));
            }
            DeValue::Array(array) => return self.list(array, origin, key, depth),
        };
        Ok(Node { value, origin })
    }

    /// A list in brackets, or tables under headers of one name.
    fn list(
        &self,
        array: &DeArray<'_>,
        origin: Origin,
        key: &Origin,
        depth: usize,
    ) -> Result<Node, DocumentError> {
        let has_headers =
            array.iter().any(|one| one.get_ref().is_table() && self.starts_with(one, '['));
        let nodes = array.iter().map(|one| match one.get_ref() {
            DeValue::Table(table) if has_headers => {
                self.table(table, self.origin(one.span()), depth)
            }
            _ => self.value(one, &origin, depth + 1),
        });
        let value = Value::List(nodes.collect::<Result<_, _>>()?);
        Ok(Node { value, origin: if has_headers { key.clone() } else { origin } })
    }
}

fn overflow(origin: &Origin, kind: &str) -> DocumentError {
    DocumentError::at(origin, Problem::Syntax(format!("{kind} number overflowed")))
}

impl Node {
    /// A table's entry of a name.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.key == key)
    }

    /// The same, to be changed.
    pub fn entry_mut(&mut self, key: &str) -> Option<&mut Entry> {
        match &mut self.value {
            Value::Table(entries) => entries.iter_mut().find(|entry| entry.key == key),
            _ => None,
        }
    }

    /// A table's entries; none of anything else.
    pub fn entries(&self) -> &[Entry] {
        match &self.value {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    /// Where a key further down was written, or the nearest table above it that was.
    ///
    /// * `path`: keys and, for lists, indices, joined by dots
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
    pub fn to_json(&self) -> Json {
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
    pub fn describe(&self) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(content: &str) -> Node {
        let text =
            Text { label: "test".to_owned(), content: content.to_owned(), ..Text::default() };
        parse(&Arc::new(text)).expect("it is TOML")
    }

    #[test]
    fn every_value_knows_where_it_was_written() {
        let content = "a = 1\n[t]\nb = [2, 33]\n[[m]]\nc = 4\n[[m]]\nc = 5\n";
        let tree = tree(content);
        for (path, written) in [
            ("a", "1"),
            ("t", "t"),
            ("t.b", "[2, 33]"),
            ("t.b.1", "33"),
            ("m.1", "[[m]]"),
            ("m.1.c", "5"),
            ("t.none", "t"),
            ("t.b.1.none", "33"),
        ] {
            let span = tree.origin_of(path).span.clone();
            assert_eq!(&content[span], written, "{path}");
        }
    }
}
