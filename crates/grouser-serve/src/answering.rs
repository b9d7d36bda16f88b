//! A question that is answered: read, computed on a thread of its own, and sent line by line.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use bytes::Bytes;
use grouser::document::guard::guarded;
use grouser::document::json;
use hyper::header::{CONTENT_TYPE, HeaderValue};
use hyper::{Response, StatusCode};
use tokio::sync::{mpsc, oneshot};

use crate::asked::Read;
use crate::body::ReplyBody;
use crate::console::Console;
use crate::refusal::Refusal;

/// Lines that wait for a reader.
const AHEAD: usize = 4;
/// The type of lines of JSON.
const LINES: HeaderValue = HeaderValue::from_static("application/x-ndjson");

/// The answer to a question, once its first line is there; or why there is none.
pub(crate) async fn answer(
    console: &Arc<Console>,
    read: Read,
    body: Bytes,
) -> Result<Response<ReplyBody>, Refusal> {
    // From here on whoever hangs up is not asking any more.
    let (asking, go_on) = console.runs.asking();
    let place = console.runs.place()?;
    let (send, mut rest) = mpsc::channel::<Bytes>(AHEAD);
    let (fail, failed) = oneshot::channel();
    let console = Arc::clone(console);
    drop(tokio::task::spawn_blocking(move || {
        let has_begun = AtomicBool::new(false);
        let sent = |line: String| {
            has_begun.store(true, Ordering::Relaxed);
            send.blocking_send((line + "\n").into()).is_ok()
        };
        let computed = guarded(|| read(&console, &body)?.answer(&go_on, &sent));
        let computed = computed.unwrap_or_else(|panic| {
            let message = format!("this is a fault of ours: {panic}");
            Err(Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, message))
        });
        // What fails before the first line is the answer; after some it is the last line.
        let has_begun = || has_begun.load(Ordering::Relaxed);
        match computed {
            Ok(()) => {}
            Err(refusal) if has_begun() => drop(sent(json::line(&refusal.to_json()))),
            Err(refusal) => drop(fail.send(refusal)),
        }
        drop(place);
    }));
    let Some(first) = rest.recv().await else {
        let nothing = Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no answer");
        return Err(failed.await.unwrap_or(nothing));
    };
    let mut response =
        Response::new(ReplyBody::Lines { first: Some(first), rest, _asking: asking });
    response.headers_mut().insert(CONTENT_TYPE, LINES);
    Ok(response)
}
