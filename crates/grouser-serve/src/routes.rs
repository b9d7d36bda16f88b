//! From a request to its response: the checks in their order, and the paths.

use std::sync::Arc;

use bytes::Bytes;
use grouser::document::json;
use http_body_util::{BodyExt as _, LengthLimitError, Limited};
use hyper::body::{Body as _, Incoming};
use hyper::header::{
    ACCEPT, ALLOW, CACHE_CONTROL, CONNECTION, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName,
    HeaderValue, REFERRER_POLICY, RETRY_AFTER, SET_COOKIE, X_CONTENT_TYPE_OPTIONS, X_FRAME_OPTIONS,
};
use hyper::{Method, Request, Response, StatusCode};

use crate::answering;
use crate::api::{self, List};
use crate::asked::Read;
use crate::assets::{ASSETS, Asset, LOCKED, PAGE};
use crate::body::ReplyBody;
use crate::refusal::Refusal;
use crate::shared::Shared;

/// The type of JSON.
const JSON: HeaderValue = HeaderValue::from_static("application/json");

/// What a path leads to.
enum PathTarget {
    File(&'static Asset),
    /// What is there to choose from.
    List(List),
    /// A question, as the body has it.
    Question(Read),
}

/// The response to a request.
pub(crate) async fn respond(
    shared: &Arc<Shared>,
    request: Request<Incoming>,
) -> Response<ReplyBody> {
    let is_visit = is_visit(&request);
    let mut response = match answer(shared, request).await {
        Ok(response) => response,
        Err(refusal) if is_visit && refusal.status == StatusCode::UNAUTHORIZED => locked(),
        Err(refusal) => refused(&refusal),
    };
    for (name, value) in PROTECTION {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Nothing is loaded but from here, nothing runs but the page's scripts, no other page frames or
/// reads it, and nothing is kept. Of what is written in the page itself only the map of names of
/// scripts is let through, by its hash.
pub(crate) const PROTECTION: [(HeaderName, &str); 8] = [
    (
        CONTENT_SECURITY_POLICY,
        "default-src 'none'; script-src 'self' \
         'sha256-pI6yMuh3IsSSxuMnraW4aTUTCbxe55mxE2S8r6TRM1c='; style-src 'self'; img-src 'self' \
         data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors \
         'none'",
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
    shared: &Arc<Shared>,
    request: Request<Incoming>,
) -> Result<Response<ReplyBody>, Refusal> {
    shared.access.check_host(&request)?;
    shared.access.check_token(&request)?;
    let route = find(request.uri().path()).ok_or_else(|| {
        let message = format!("there is nothing at {}", request.uri().path());
        Refusal::new(StatusCode::NOT_FOUND, message)
    })?;
    let is_question = matches!(route, PathTarget::Question(_));
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
        PathTarget::File(asset) => Ok(file(shared, asset)),
        PathTarget::List(list) => {
            // Files are read for it, which others need not wait for.
            let failed = || Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no list");
            let place = Arc::clone(&shared.lists).acquire_owned().await.map_err(|_| failed())?;
            let shared = Arc::clone(shared);
            let made = move || {
                let list = list(&shared.console);
                drop(place);
                list
            };
            let listed = tokio::task::spawn_blocking(made).await.map_err(|_| failed());
            Ok(whole(JSON, listed?))
        }
        PathTarget::Question(read) => {
            shared.access.check_origin(request.headers())?;
            let body = json_of(shared, request).await?;
            answering::answer(shared, read, body).await
        }
    }
}

fn find(path: &str) -> Option<PathTarget> {
    if path == PAGE.path {
        return Some(PathTarget::File(&PAGE));
    }
    if let Some(asset) = ASSETS.iter().find(|asset| asset.path == path) {
        return Some(PathTarget::File(asset));
    }
    let name = path.strip_prefix("/api/")?;
    if let Some((_, list)) = api::LISTS.iter().find(|(own, _)| *own == name) {
        return Some(PathTarget::List(*list));
    }
    let mut questions = api::QUESTIONS.iter().chain(api::OF_FOLDERS);
    let (_, read) = questions.find(|(own, _)| *own == name)?;
    Some(PathTarget::Question(*read))
}

fn file(shared: &Shared, asset: &Asset) -> Response<ReplyBody> {
    let mut response = whole(HeaderValue::from_static(asset.kind), asset.content);
    if asset.path == PAGE.path {
        // Whoever gets here has the token.
        let cookie = HeaderValue::from_str(&shared.access.set_cookie());
        response.headers_mut().extend(cookie.ok().map(|cookie| (SET_COOKIE, cookie)));
    }
    response
}

fn whole(kind: HeaderValue, content: impl Into<Bytes>) -> Response<ReplyBody> {
    let mut response = Response::new(ReplyBody::whole(content));
    response.headers_mut().insert(CONTENT_TYPE, kind);
    response
}

/// Whether somebody opens the page in a browser.
fn is_visit(request: &Request<Incoming>) -> bool {
    let accepted = request.headers().get(ACCEPT).and_then(|accepted| accepted.to_str().ok());
    request.uri().path() == PAGE.path && accepted.is_some_and(|it| it.contains("text/html"))
}

/// The page that a browser without the token gets, which loads nothing.
fn locked() -> Response<ReplyBody> {
    let mut response = whole(HeaderValue::from_static(PAGE.kind), LOCKED);
    *response.status_mut() = StatusCode::UNAUTHORIZED;
    response
}

/// A refusal as a response. Where the request's body was not read, the connection ends with it.
fn refused(refusal: &Refusal) -> Response<ReplyBody> {
    let mut response = whole(JSON, json::line(&refusal.to_json()) + "\n");
    *response.status_mut() = refusal.status;
    let headers = response.headers_mut();
    match refusal.status {
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

/// The body of a question, if it is small and quick.
async fn json_of(shared: &Shared, request: Request<Incoming>) -> Result<Bytes, Refusal> {
    let limits = &shared.limits;
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

#[cfg(test)]
mod tests {
    use grouser_draw::base64;
    use sha2::{Digest as _, Sha256};

    use super::*;

    #[test]
    fn the_map_of_scripts_has_the_hash_that_is_let_through() {
        let page = std::str::from_utf8(PAGE.content).unwrap();
        let (_, rest) = page.split_once("<script type=\"importmap\">").unwrap();
        let (map, _) = rest.split_once("</script>").unwrap();
        let hash = format!("'sha256-{}'", base64(&Sha256::digest(map)));
        assert!(PROTECTION[0].1.contains(&hash), "{hash}");
        // Each name leads to a file that is there.
        let named: serde_json::Value = serde_json::from_str(map).unwrap();
        let three = named["imports"]["three"].as_str().unwrap().trim_start_matches('.');
        assert!(find(three).is_some() && !page.contains("<script>"));
        for (_, policy) in PROTECTION {
            assert!(!policy.contains("unsafe"), "{policy}");
        }
    }
}
