//! What was answered, and what stands for the rest.

use serde_json::{Map, Value as Json};

use super::super::kind::Kind;

/// The value of a question that is not answered, and why.
pub(super) struct Usual {
    pub(super) value: Option<Json>,
    pub(super) why: String,
}

impl Usual {
    pub(super) fn of(value: impl Into<Json>, why: impl Into<String>) -> Self {
        Self { value: Some(value.into()), why: why.into() }
    }

    pub(super) fn left_out(why: impl Into<String>) -> Self {
        Self { value: None, why: why.into() }
    }

    /// A number with four significant digits.
    pub(super) fn estimate(value: f64, why: impl Into<String>) -> Self {
        Self::of(rounded(value), why)
    }
}

/// With four significant digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// The answers to the questions of a document.
#[derive(Clone, Debug)]
pub(super) struct Answers {
    pub(super) kind: Kind,
    pub(super) given: Map<String, Json>,
    /// The usual values of the kind's own questions, after the answers.
    pub(super) usual: fn(&Self, &str) -> Usual,
}

impl Answers {
    pub(super) fn is_given(&self, key: &str) -> bool {
        self.given.contains_key(key)
    }

    /// The usual value of a question.
    pub(super) fn usual(&self, key: &str) -> Usual {
        match key {
            "name" => Usual::of(format!("my {}", self.kind), "no name was given"),
            "source" => Usual::of("not stated", "no source was given"),
            _ => (self.usual)(self, key),
        }
    }

    /// The answer, or else the usual value.
    pub(super) fn value(&self, key: &str) -> Option<Json> {
        self.given.get(key).cloned().or_else(|| self.usual(key).value)
    }

    pub(super) fn number(&self, key: &str) -> f64 {
        self.value(key).and_then(|value| value.as_f64()).unwrap_or_default()
    }

    pub(super) fn text(&self, key: &str) -> String {
        self.value(key).and_then(|value| value.as_str().map(str::to_owned)).unwrap_or_default()
    }

    /// Why an unanswered question has its value, as `assumed` has it.
    ///
    /// * `of`: the key of the document that it stands in
    pub(super) fn reason(&self, key: &str, of: &str) -> Option<String> {
        if self.is_given(key) {
            return None;
        }
        let Usual { value, why } = self.usual(key);
        let value = value?;
        let what = if of == key { String::new() } else { format!("{key} ") };
        Some(format!("{of}: {what}{value}, {why}"))
    }
}
