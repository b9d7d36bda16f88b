//! The lines of a document: keys with a comment of their row.

use std::fmt::Write as _;

use serde_json::Value as Json;

use super::super::kind::Kind;
use super::super::schema::{root, under};

/// TOML in the making.
pub(super) struct Lines {
    kind: Kind,
    text: String,
    /// The table of the next keys, as rows know it.
    table: String,
    /// Its law, if it has one.
    law: Option<String>,
}

impl Lines {
    /// Begins with the head of a document.
    ///
    /// * `about`: what it is, in a comment
    pub(super) fn new(kind: Kind, about: &str) -> Self {
        let mut lines = Self::rest(kind);
        lines.comment(about);
        lines.plain("schema", &Json::from(kind.tag()));
        lines
    }

    /// Goes on with a document.
    pub(super) fn rest(kind: Kind) -> Self {
        Self { kind, text: String::new(), table: String::new(), law: None }
    }

    pub(super) fn comment(&mut self, comment: &str) {
        // Writing to a string does not fail.
        let _ = writeln!(self.text, "# {comment}");
    }

    /// A key as it is.
    pub(super) fn plain(&mut self, key: &str, value: &Json) {
        let _ = writeln!(self.text, "{key} = {}", toml_of(value));
    }

    /// An empty line.
    pub(super) fn blank(&mut self) {
        self.text.push('\n');
    }

    /// Texts, one on a line; nothing if there are none.
    pub(super) fn texts(&mut self, key: &str, texts: &[String]) {
        if texts.is_empty() {
            return;
        }
        let lines: String = texts
            .iter()
            .map(|text| format!("    {},\n", toml_of(&Json::from(text.as_str()))))
            .collect();
        let _ = write!(self.text, "{key} = [\n{lines}]\n");
    }

    /// Begins a table.
    ///
    /// * `header`: as it is written, such as `[[mount]]`
    /// * `path`: as rows know it, such as `mount`
    pub(super) fn table(&mut self, header: &str, path: &str) {
        let _ = writeln!(self.text, "\n{header}");
        path.clone_into(&mut self.table);
        self.law = None;
    }

    /// The law that the next keys are of.
    pub(super) fn law(&mut self, law: Option<&str>) {
        self.law = law.map(str::to_owned);
    }

    /// A key with what it is before it; nothing without a value.
    ///
    /// * `remark`: behind it, if there is anything to say
    pub(super) fn key(&mut self, key: &str, value: Option<&Json>, remark: &str) {
        let Some(value) = value else { return };
        let path =
            if self.table.is_empty() { key.to_owned() } else { format!("{}.{key}", self.table) };
        let docs = under(root(self.kind), &path, self.law.as_deref());
        let doc = docs.iter().find_map(|schema| schema["description"].as_str());
        if let Some(doc) = doc {
            self.comment(doc.lines().next().unwrap_or_default());
        }
        let remark = if remark.is_empty() { String::new() } else { format!("   # {remark}") };
        let _ = writeln!(self.text, "{key} = {}{remark}", toml_of(value));
    }

    pub(super) fn end(self) -> String {
        self.text
    }
}

/// A value as TOML, on one line.
pub(super) fn toml_of(value: &Json) -> String {
    match value {
        Json::String(text) => toml::Value::String(text.clone()).to_string(),
        Json::Number(number) if number.is_f64() => {
            // TOML tells 1.0 from 1.
            format!("{:?}", number.as_f64().unwrap_or_default())
        }
        Json::Array(all) => {
            let all: Vec<String> = all.iter().map(toml_of).collect();
            format!("[{}]", all.join(", "))
        }
        Json::Object(all) => {
            let all: Vec<String> =
                all.iter().map(|(key, value)| format!("{key} = {}", toml_of(value))).collect();
            format!("{{ {} }}", all.join(", "))
        }
        other => other.to_string(),
    }
}
