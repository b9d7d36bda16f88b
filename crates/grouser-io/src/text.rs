//! Reading TOML into a tree whose values know where they were written.

use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{DocumentError, Problem};
use super::tree::{Entry, Node, Origin, Text, Value};

/// Tables and lists may be nested this deep. Ours are five deep: a mount's position in a rover
/// in a scenario.
const DEEPEST: usize = 16;

/// The tree of a TOML text.
///
/// The parser gives up at 80 brackets and at 80 dots, which together can nest a few thousand
/// tables: little enough for any stack. Our own limit is far below.
pub(crate) fn parse(text: &Arc<Text>) -> Result<Node, DocumentError> {
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
        // The parser sorts by name; what is wrong first is reported first.
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
