//! How far a computation is, as lines among those of its answer.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use grouser::document::json;
use serde_json::json;

use crate::asked::Send;

/// The least time between two lines.
const BETWEEN: Duration = Duration::from_millis(200);

/// Counts what is done, from any thread, and sends it now and then.
pub(crate) struct Progress<'s> {
    send: Send<'s>,
    /// What is counted.
    what: &'static str,
    /// How many there are, where that is known.
    all: Option<u64>,
    done: AtomicU64,
    since: Instant,
    /// When the next line is due [ms].
    next: AtomicU64,
}

impl<'s> Progress<'s> {
    /// * `done`, `all`: how many were done before, and how many there are
    pub(crate) fn new(send: Send<'s>, what: &'static str, done: u64, all: Option<u64>) -> Self {
        let (since, next) = (Instant::now(), AtomicU64::new(0));
        Self { send, what, all, done: done.into(), since, next }
    }

    /// One more is done.
    pub(crate) fn count(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        let now = millis(self.since.elapsed());
        let due = self.next.load(Ordering::Relaxed);
        let next = now + millis(BETWEEN);
        let is_mine =
            || self.next.compare_exchange(due, next, Ordering::Relaxed, Ordering::Relaxed).is_ok();
        if now >= due && is_mine() {
            // Where nobody reads it, the computation is stopped.
            let _ = (self.send)(json::line(&json!({
                "schema": "grouser.progress.v1",
                "what": self.what,
                "done": done,
                "all": self.all,
                "time_s": self.since.elapsed().as_secs_f64(),
            })));
        }
    }
}

fn millis(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}
