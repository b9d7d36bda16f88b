//! From a request to its response: the checks in their order, and the paths.

use std::sync::Arc;

use bytes::Bytes;
use http_body_util::{BodyExt as _, LengthLimitError, Limited};
use hyper::body::{Body as _, Incoming};
use hyper::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName, HeaderValue, REFERRER_POLICY,
    SET_COOKIE, X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use hyper::{Method, Request, Response, StatusCode};

use crate::api::{self, List, Read};
use crate::assets::{ASSETS, Asset, PAGE};
use crate::body::Body;
use crate::question;
use crate::refusal::{JSON, Refusal};
use crate::server::Console;

/// What a path leads to.
enum Route {
    File(&'static Asset),
    /// What is there to choose from.
    List(List),
    /// A question, as the body has it.
    Question(Read),
}

/// The response to a request.
pub(crate) async fn respond(console: &Arc<Console>, request: Request<Incoming>) -> Response<Body> {
    let mut response = match answer(console, request).await {
        Ok(response) => response,
        Err(refusal) => refusal.response(),
    };
    for (name, value) in PROTECTION {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Nothing is loaded but from here, nothing runs but the page's scripts, no other page frames or
/// reads it, and nothing is kept.
const PROTECTION: [(HeaderName, &str); 8] = [
    (
        CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
         connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    ),
    (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (X_FRAME_OPTIONS, "DENY"),
    (REFERRER_POLICY, "no-referrer"),
    (CACHE_CONTROL, "no-store"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (HeaderName::from_static("permissions-policy"), "camera=(), geolocation=(), microphone=()"),
];

async fn answer(
    console: &Arc<Console>,
    request: Request<Incoming>,
) -> Result<Response<Body>, Refusal> {
    console.access.check_host(&request)?;
    console.access.check_token(&request)?;
    let route = find(request.uri().path()).ok_or_else(|| {
        let message = format!("there is nothing at {}", request.uri().path());
        Refusal::new(StatusCode::NOT_FOUND, message)
    })?;
    let is_question = matches!(route, Route::Question(_));
    let is_allowed = match *request.method() {
        Method::GET | Method::HEAD => !is_question,
        Method::POST => is_question,
        _ => false,
    };
    if !is_allowed {
        let method = if is_question { "POST" } else { "GET" };
        let message = format!("{} is asked by {method}", request.uri().path());
        return Err(Refusal::new(StatusCode::METHOD_NOT_ALLOWED, message));
    }
    match route {
        Route::File(asset) => Ok(file(console, asset)),
        Route::List(list) => Ok(whole(JSON, list(console))),
        Route::Question(read) => {
            console.access.check_origin(request.headers())?;
            let body = json_of(console, request).await?;
            question::answer(console, read, body).await
        }
    }
}

fn find(path: &str) -> Option<Route> {
    if path == PAGE.path {
        return Some(Route::File(&PAGE));
    }
    if let Some(asset) = ASSETS.iter().find(|asset| asset.path == path) {
        return Some(Route::File(asset));
    }
    let name = path.strip_prefix("/api/")?;
    if let Some((_, list)) = api::LISTS.iter().find(|(own, _)| *own == name) {
        return Some(Route::List(*list));
    }
    let (_, read) = api::QUESTIONS.iter().find(|(own, _)| *own == name)?;
    Some(Route::Question(*read))
}

fn file(console: &Console, asset: &Asset) -> Response<Body> {
    let mut response = whole(HeaderValue::from_static(asset.kind), asset.content);
    if asset.path == PAGE.path {
        // Whoever gets here has the token.
        let cookie = HeaderValue::from_str(&console.access.set_cookie());
        response.headers_mut().extend(cookie.ok().map(|cookie| (SET_COOKIE, cookie)));
    }
    response
}

fn whole(kind: HeaderValue, content: impl Into<Bytes>) -> Response<Body> {
    let mut response = Response::new(Body::whole(content));
    response.headers_mut().insert(CONTENT_TYPE, kind);
    response
}

/// The body of a question, if it is small and quick.
async fn json_of(console: &Console, request: Request<Incoming>) -> Result<Bytes, Refusal> {
    let limits = &console.limits;
    let kind = request.headers().get(CONTENT_TYPE).and_then(|kind| kind.to_str().ok());
    // A form of another page cannot be of this type.
    let is_json = kind.is_some_and(|kind| {
        kind.split(';')
            .next()
            .is_some_and(|kind| kind.trim().eq_ignore_ascii_case("application/json"))
    });
    if !is_json {
        let message = "a question is JSON: content-type: application/json";
        return Err(Refusal::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, message));
    }
    let too_large = || {
        let most = limits.body_bytes;
        let message = format!("the body is larger than {most} bytes, the most that is read");
        Refusal::new(StatusCode::PAYLOAD_TOO_LARGE, message)
    };
    // What says so itself is not read at all.
    if request.body().size_hint().lower() > limits.body_bytes as u64 {
        return Err(too_large());
    }
    let collected = Limited::new(request.into_body(), limits.body_bytes).collect();
    match tokio::time::timeout(limits.body_time, collected).await {
        Ok(Ok(body)) => Ok(body.to_bytes()),
        Ok(Err(error)) if error.is::<LengthLimitError>() => Err(too_large()),
        Ok(Err(error)) => {
            Err(Refusal::new(StatusCode::BAD_REQUEST, format!("the body broke off: {error}")))
        }
        Err(_) => {
            let message = "the body did not come in time";
            Err(Refusal::new(StatusCode::REQUEST_TIMEOUT, message))
        }
    }
}
