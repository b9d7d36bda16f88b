//! Why a request is not answered: a status, and a sentence as JSON.

use std::fmt::Display;

use http::StatusCode;
use serde_json::{Value, json};

/// A request that is not answered.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Refusal {
    pub(crate) status: StatusCode,
    /// What is wrong.
    pub(crate) message: String,
    /// The key of the request that is to blame, if one is.
    pub(crate) key: Option<String>,
    /// What helps, if something is known.
    pub(crate) hint: Option<String>,
}

impl Refusal {
    pub(crate) fn new(status: StatusCode, message: impl Into<String>) -> Self {
        Self { status, message: message.into(), key: None, hint: None }
    }

    /// A request that has a wrong value.
    pub(crate) fn of_key(key: &str, message: impl Into<String>) -> Self {
        let refusal = Self::new(StatusCode::UNPROCESSABLE_ENTITY, message);
        Self { key: Some(key.to_owned()), ..refusal }
    }

    /// A computation that was stopped.
    pub(crate) fn stopped() -> Self {
        let message = "it was stopped before its end: it took too long, or the server ends";
        Self::new(StatusCode::SERVICE_UNAVAILABLE, message)
            .with_hint("ask for fewer samples, or rows")
    }

    /// A panic, with its message.
    pub(crate) fn fault(panic: impl Display) -> Self {
        Self::new(StatusCode::INTERNAL_SERVER_ERROR, format!("this is a fault of ours: {panic}"))
    }

    /// The same with what helps.
    pub(crate) fn with_hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    /// It as JSON.
    pub(crate) fn to_json(&self) -> Value {
        let mut error = json!({ "schema": "grouser.error.v1", "error": self.message });
        for (name, text) in [("key", &self.key), ("hint", &self.hint)] {
            if let Some(text) = text {
                error[name] = text.as_str().into();
            }
        }
        error
    }
}
