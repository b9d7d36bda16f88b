//! Reading TOML into a tree whose values know where they were written.

use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};
use toml_parser::lexer::TokenKind;

use super::error::{DocumentError, Problem};
use super::tree::{Entry, Node, Origin, Text, Value};

/// Tables and lists may be nested this deep. Ours are five deep: a mount's position in a rover
/// in a scenario.
pub(crate) const DEEPEST: usize = 16;
/// Brackets that may be open at a place. The parser counts them and gives up at 80, but where one
/// opens in place of a key it loses count, and follows the text until the stack has no room.
const MOST_OPEN: usize = 64;

/// Whether brackets of a TOML text are open so deep that the parser must not be given it.
#[must_use]
pub fn nests_too_deep(toml: &str) -> bool {
    too_deep(toml).is_some()
}

/// The first bracket that is open too deep.
fn too_deep(toml: &str) -> Option<Range<usize>> {
    use TokenKind::{LeftCurlyBracket, LeftSquareBracket, RightCurlyBracket, RightSquareBracket};
    let mut open = Vec::new();
    for token in toml_parser::Source::new(toml).lex() {
        let kind = token.kind();
        match kind {
            LeftSquareBracket | LeftCurlyBracket => open.push(kind),
            // What closes another bracket closes nothing.
            RightSquareBracket => drop(open.pop_if(|it| *it == LeftSquareBracket)),
            RightCurlyBracket => drop(open.pop_if(|it| *it == LeftCurlyBracket)),
            _ => {}
        }
        if open.len() > MOST_OPEN {
            return Some(token.span().start()..token.span().end());
        }
    }
    None
}

/// The tree of a TOML text.
///
/// Beside brackets, dots nest tables: the parser gives up at 80, which together can nest a few
/// thousand, little enough for any stack. Our own limit is far below.
pub(crate) fn parse(text: &Arc<Text>) -> Result<Node, DocumentError> {
    let whole = Origin { text: text.clone(), span: 0..0 };
    if let Some(span) = too_deep(&text.content) {
        let origin = Origin { text: text.clone(), span };
        return Err(DocumentError::at(&origin, Problem::TooDeep { limit: DEEPEST }));
    }
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

    /// Nested, not closed, and closed by the wrong bracket; in texts and notes brackets mean nothing.
    #[test]
    fn a_text_cannot_nest_until_the_stack_is_full() {
        for line in ["a = {{b = 1}\n", "{", "a = [", "[{=", "a = {]b = [}", "a.b = {\n"] {
            let content = format!("a = {}", line.repeat(60_000));
            let text = Arc::new(Text { content, ..Text::default() });
            let error = parse(&text).expect_err(line);
            assert!(matches!(error.problem(), Problem::TooDeep { .. }), "{line:?}: {error}");
        }
        let brackets = "[{".repeat(1_000);
        let texts = format!("a = \"{brackets}\" # {brackets}\nb = '''{brackets}'''\n");
        assert_eq!(tree(&texts).entries().len(), 2);
    }
}
