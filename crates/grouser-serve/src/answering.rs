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
use crate::body::{AnswerLines, ReplyBody, SentLine};
use crate::refusal::Refusal;
use crate::shared::Shared;

/// Lines that wait for a reader.
const AHEAD: usize = 4;
/// The type of lines of JSON.
const LINES: HeaderValue = HeaderValue::from_static("application/x-ndjson");

/// The answer to a question, once its first line is there; or why there is none.
pub(crate) async fn answer(
    shared: &Arc<Shared>,
    read: Read,
    body: Bytes,
) -> Result<Response<ReplyBody>, Refusal> {
    // From here on whoever hangs up is not asking any more.
    let (asking, go_on) = shared.runs.asking();
    let place = Arc::new(shared.runs.place()?);
    let (send, mut rest) = mpsc::channel::<SentLine>(AHEAD);
    let (fail, failed) = oneshot::channel();
    let shared = Arc::clone(shared);
    let held = Arc::clone(&place);
    drop(tokio::task::spawn_blocking(move || {
        let (has_begun, is_full) = (AtomicBool::new(false), AtomicBool::new(false));
        let sent = |line: String| {
            let has_room = line.len() <= shared.limits.answer_bytes as usize;
            let room = if has_room { go_on.room(line.len()) } else { None };
            is_full.store(room.is_none(), Ordering::Relaxed);
            room.is_some() && {
                has_begun.store(true, Ordering::Relaxed);
                send.blocking_send(((line + "\n").into(), room)).is_ok()
            }
        };
        let computed = guarded(|| {
            let turn = go_on.reading_turn().ok_or_else(Refusal::stopped)?;
            let question = read(&shared.console, &body)?;
            drop(turn);
            question.answer(&go_on, &sent)
        });
        let computed = computed.unwrap_or_else(|panic| Err(Refusal::fault(panic)));
        let full = || {
            let message = "the answer has no room beside those that wait for slow readers";
            Err(Refusal::new(StatusCode::SERVICE_UNAVAILABLE, message))
        };
        // What fails before the first line is the answer; after some it is the last line.
        match if is_full.load(Ordering::Relaxed) { full() } else { computed } {
            Ok(()) => {}
            Err(refusal) if has_begun.load(Ordering::Relaxed) => {
                let line = json::line(&refusal.to_json()) + "\n";
                drop(send.blocking_send((line.into(), None)));
            }
            Err(refusal) => drop(fail.send(refusal)),
        }
        drop(held);
    }));
    let Some(first) = rest.recv().await else {
        let nothing = Refusal::new(StatusCode::INTERNAL_SERVER_ERROR, "there is no answer");
        return Err(failed.await.unwrap_or(nothing));
    };
    let lines =
        AnswerLines { first: Some(first), rest, taken: None, _asking: asking, _place: place };
    let mut response = Response::new(ReplyBody::Lines(lines));
    response.headers_mut().insert(CONTENT_TYPE, LINES);
    Ok(response)
}
