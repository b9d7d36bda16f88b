//! JSON that can be printed: hidden characters inside its strings are escaped, which any reader
//! undoes. JSON itself asks for that of the first thirty-two only.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::Serializer;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter};

use super::escape;

/// Writes indented JSON.
///
/// # Errors
/// Those of what it is written to.
pub fn write(to: impl Write, value: &impl Serialize) -> io::Result<()> {
    let shown = Shown(PrettyFormatter::new());
    value.serialize(&mut Serializer::with_formatter(to, shown)).map_err(io::Error::from)
}

/// Indented JSON as a text.
///
/// # Panics
/// For values that are no JSON: maps whose keys are no texts.
#[must_use]
pub fn text(value: &impl Serialize) -> String {
    in_memory(value, PrettyFormatter::new())
}

/// JSON on one line.
///
/// # Panics
/// The same as [`text`].
#[must_use]
pub fn line(value: &impl Serialize) -> String {
    in_memory(value, CompactFormatter)
}

fn in_memory(value: &impl Serialize, formatter: impl Formatter) -> String {
    let mut bytes = Vec::new();
    let mut serializer = Serializer::with_formatter(&mut bytes, Shown(formatter));
    value.serialize(&mut serializer).expect("text keys, and writing to memory");
    String::from_utf8(bytes).expect("JSON is text")
}

/// Another formatter, with its strings escaped further.
struct Shown<F>(F);

impl<F: Formatter> Formatter for Shown<F> {
    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        to: &mut W,
        text: &str,
    ) -> io::Result<()> {
        let mut rest = text;
        while let Some((place, hidden)) = rest.char_indices().find(|(_, c)| escape::is_hidden(*c)) {
            to.write_all(&rest.as_bytes()[..place])?;
            for unit in hidden.encode_utf16(&mut [0; 2]) {
                write!(to, "\\u{unit:04x}")?;
            }
            rest = &rest[place + hidden.len_utf8()..];
        }
        to.write_all(rest.as_bytes())
    }

    fn begin_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.begin_array(to)
    }

    fn end_array<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.end_array(to)
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_array_value(to, first)
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.end_array_value(to)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.begin_object(to)
    }

    fn end_object<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.end_object(to)
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, to: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_object_key(to, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.begin_object_value(to)
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, to: &mut W) -> io::Result<()> {
        self.0.end_object_value(to)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    #[test]
    fn strings_come_back_and_hide_nothing() {
        let value =
            json!({"a\u{202e}": ["\u{9b}31m \u{1b}\n\"\\", {}, [], "\u{e0041}φ"], "b": 1.5});
        for written in [text(&value), line(&value)] {
            assert!(!written.replace('\n', "").chars().any(escape::is_hidden), "{written:?}");
            assert_eq!(serde_json::from_str::<Value>(&written).unwrap(), value);
        }
        // Without such characters it is what serde writes.
        let plain = json!({"a": [1, {"b": null}], "c": {}});
        assert_eq!(text(&plain), serde_json::to_string_pretty(&plain).unwrap());
        assert_eq!(line(&plain), serde_json::to_string(&plain).unwrap());
    }
}
