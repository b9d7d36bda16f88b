//! The keys of a question, each taken once; one that is left over is an error.

use std::cell::RefCell;
use std::ops::RangeInclusive;

use grouser::document::nearest;
use http::StatusCode;
use serde_json::{Map, Value};

use crate::refusal::Refusal;

/// The keys of a question.
pub(super) struct AskedFields {
    given: RefCell<Map<String, Value>>,
    /// The keys that it may have.
    known: RefCell<Vec<&'static str>>,
}

/// Numbers in a list at the most.
const MOST: usize = 2000;

impl AskedFields {
    /// The keys of a body.
    pub(super) fn of(body: &[u8]) -> Result<Self, Refusal> {
        let malformed = |message: String| Refusal::new(StatusCode::BAD_REQUEST, message);
        let given: Value = serde_json::from_slice(body)
            .map_err(|error| malformed(format!("the body is not JSON: {error}")))?;
        let Value::Object(given) = given else {
            return Err(malformed("the body is not a JSON object".to_owned()));
        };
        Ok(Self { given: given.into(), known: RefCell::default() })
    }

    /// What stands under a key; null is nothing.
    pub(super) fn take(&self, key: &'static str) -> Option<Value> {
        self.known.borrow_mut().push(key);
        self.given.borrow_mut().shift_remove(key).filter(|value| !value.is_null())
    }

    pub(super) fn text(&self, key: &'static str) -> Result<Option<String>, Refusal> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::String(text)) => Ok(Some(text)),
            Some(_) => Err(Refusal::of_key(key, "it must be a text")),
        }
    }

    pub(super) fn texts(&self, key: &'static str) -> Result<Vec<String>, Refusal> {
        let all = match self.take(key) {
            None => return Ok(Vec::new()),
            Some(Value::Array(all)) => all,
            Some(one) => vec![one],
        };
        let text = |value: Value| match value {
            Value::String(text) => Ok(text),
            _ => Err(Refusal::of_key(key, "it must be a text, or a list of some")),
        };
        all.into_iter().map(text).collect()
    }

    pub(super) fn truth(&self, key: &'static str) -> Result<bool, Refusal> {
        match self.take(key) {
            None => Ok(false),
            Some(Value::Bool(truth)) => Ok(truth),
            Some(_) => Err(Refusal::of_key(key, "it must be true or false")),
        }
    }

    /// A number within a range.
    pub(super) fn number(
        &self,
        key: &'static str,
        range: &RangeInclusive<f64>,
    ) -> Result<Option<f64>, Refusal> {
        self.take(key).map(|value| number(key, &value, range)).transpose()
    }

    /// A number or a list of some, within a range.
    pub(super) fn numbers(
        &self,
        key: &'static str,
        range: &RangeInclusive<f64>,
        usual: &[f64],
    ) -> Result<Vec<f64>, Refusal> {
        let all = match self.take(key) {
            None => return Ok(usual.to_vec()),
            Some(Value::Array(all)) => all,
            Some(one) => vec![one],
        };
        if all.is_empty() || all.len() > MOST {
            let message = format!("{} numbers: it must be 1 to {MOST}", all.len());
            return Err(Refusal::of_key(key, message));
        }
        all.iter().map(|value| number(key, value, range)).collect()
    }

    /// x and y of a place [m].
    pub(super) fn place(&self, key: &'static str) -> Result<Option<[f64; 2]>, Refusal> {
        match self.numbers(key, &(f64::MIN..=f64::MAX), &[])?[..] {
            [] => Ok(None),
            [x, y] => Ok(Some([x, y])),
            _ => Err(Refusal::of_key(key, "it must be two numbers, x and y in metres")),
        }
    }

    /// Whole numbers within a range.
    pub(super) fn counts(
        &self,
        key: &'static str,
        range: &RangeInclusive<u64>,
    ) -> Result<Option<Vec<u64>>, Refusal> {
        let all = match self.take(key) {
            None => return Ok(None),
            Some(Value::Array(all)) => all,
            Some(one) => vec![one],
        };
        let count = |value: &Value| {
            value.as_u64().filter(|count| range.contains(count)).ok_or_else(|| {
                let (from, to) = (range.start(), range.end());
                let message = format!("{value}: it must be a whole number from {from} to {to}");
                Refusal::of_key(key, message)
            })
        };
        all.iter().map(count).collect::<Result<_, _>>().map(Some)
    }

    /// The entries of a table.
    pub(super) fn entries(&self, key: &'static str) -> Result<Map<String, Value>, Refusal> {
        match self.take(key) {
            None => Ok(Map::new()),
            Some(Value::Object(entries)) => Ok(entries),
            Some(_) => Err(Refusal::of_key(key, "it must be an object of keys with their values")),
        }
    }

    /// Checks that no key is left over.
    pub(super) fn finish(self) -> Result<(), Refusal> {
        let (given, known) = (self.given.into_inner(), self.known.into_inner());
        let Some(key) = given.keys().next() else { return Ok(()) };
        let hint = match nearest(key, known.iter().copied()) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("the keys are {}", known.join(", ")),
        };
        Err(Refusal::of_key(key, "this question has no such key").with_hint(hint))
    }
}

fn number(key: &str, value: &Value, range: &RangeInclusive<f64>) -> Result<f64, Refusal> {
    let number = value.as_f64().filter(|number| number.is_finite());
    let number = number.ok_or_else(|| Refusal::of_key(key, "it must be a number"))?;
    if range.contains(&number) {
        return Ok(number);
    }
    let (from, to) = (range.start(), range.end());
    Err(Refusal::of_key(key, format!("{number}: it must be from {from} to {to}")))
}
