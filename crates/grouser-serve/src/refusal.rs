//! Why a request is not answered: a status, and a sentence as JSON.

use grouser::document::json;
use hyper::header::{ALLOW, CONNECTION, CONTENT_TYPE, HeaderValue, RETRY_AFTER};
use hyper::{Response, StatusCode};
use serde_json::{Value, json};

use crate::body::Body;

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

/// The type of JSON.
pub(crate) const JSON: HeaderValue = HeaderValue::from_static("application/json");

impl Refusal {
    pub(crate) fn new(status: StatusCode, message: impl Into<String>) -> Self {
        Self { status, message: message.into(), key: None, hint: None }
    }

    /// A request that has a wrong value.
    pub(crate) fn of_key(key: &str, message: impl Into<String>) -> Self {
        let refusal = Self::new(StatusCode::UNPROCESSABLE_ENTITY, message);
        Self { key: Some(key.to_owned()), ..refusal }
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

    /// It as an answer. Where the request's body was not read, the connection ends with it.
    pub(crate) fn response(&self) -> Response<Body> {
        let mut response = Response::new(Body::whole(json::line(&self.to_json()) + "\n"));
        *response.status_mut() = self.status;
        let headers = response.headers_mut();
        headers.insert(CONTENT_TYPE, JSON);
        match self.status {
            StatusCode::SERVICE_UNAVAILABLE => {
                headers.insert(RETRY_AFTER, HeaderValue::from_static("1"));
            }
            StatusCode::METHOD_NOT_ALLOWED => {
                headers.insert(ALLOW, HeaderValue::from_static("GET, HEAD, POST"));
            }
            StatusCode::PAYLOAD_TOO_LARGE | StatusCode::REQUEST_TIMEOUT => {
                headers.insert(CONNECTION, HeaderValue::from_static("close"));
            }
            _ => {}
        }
        response
    }
}
