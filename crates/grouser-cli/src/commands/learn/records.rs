//! The records of a log, read in a thread of their own: while a log is waited for, what was learnt
//! is printed and kept.

use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use grouser::document::given_file::GivenFile;
use grouser::document::measurements::telemetry::{Lost, TelemetryRecord};
use grouser_logs::TelemetryLog;

use crate::failure::Failure;
use crate::interrupt;

/// How often Ctrl-C is looked for while a log is waited for.
const PATIENCE: Duration = Duration::from_millis(50);
/// Records that are read ahead.
const AHEAD: usize = 1024;

/// What a log gives next.
pub(super) enum Event {
    /// A record.
    Record {
        record: TelemetryRecord,
        /// Whether its row has ended: the last row of a log may still be written.
        is_whole: bool,
        /// What was left out so far.
        lost: Lost,
    },
    /// Nothing for a moment.
    Nothing,
    /// The end.
    End(Ending),
    /// The log cannot be read.
    Failed(Failure),
}

/// What is known of a log at its end.
pub(super) struct Ending {
    pub(super) lost: Lost,
    /// What else there is to say of it.
    pub(super) notes: Vec<String>,
    pub(super) rows: u64,
    /// What it and its mapping gave; nothing where nobody knows.
    pub(super) given: Vec<GivenFile>,
    /// The share of the log that was used [-].
    pub(super) share_used: f64,
}

impl Ending {
    /// Where nothing is known of it.
    fn of_nothing() -> Self {
        let (notes, given) = (Vec::new(), Vec::new());
        Self { lost: Lost::default(), notes, rows: 0, given, share_used: 1.0 }
    }
}

/// Reads records ahead.
pub(super) struct Records {
    events: Receiver<Event>,
    is_followed: bool,
}

impl Records {
    /// * `open`: opens the log, in the thread that reads it
    /// * `is_followed`: whether Ctrl-C ends the log
    pub(super) fn of(
        open: impl FnOnce() -> Result<TelemetryLog, Failure> + Send + 'static,
        is_followed: bool,
    ) -> Self {
        let (sender, events) = sync_channel(AHEAD);
        thread::spawn(move || {
            let last = open().and_then(|log| read(log, &sender));
            // Nobody waits for the rest of a log that is no longer learnt from.
            drop(sender.send(last.unwrap_or_else(Event::Failed)));
        });
        Self { events, is_followed }
    }

    /// What comes next; the end, once Ctrl-C asks a log that is followed to stop.
    pub(super) fn next(&self) -> Event {
        match self.events.recv_timeout(PATIENCE) {
            Ok(event) => event,
            Err(RecvTimeoutError::Timeout) if self.is_followed && interrupt::is_asked_to_stop() => {
                Event::End(Ending::of_nothing())
            }
            Err(RecvTimeoutError::Timeout) => Event::Nothing,
            Err(RecvTimeoutError::Disconnected) => Event::End(Ending::of_nothing()),
        }
    }
}

/// Sends all records; what comes after the last.
fn read(mut log: TelemetryLog, sender: &SyncSender<Event>) -> Result<Event, Failure> {
    while let Some(record) = log.next_record()? {
        let event = Event::Record { record, is_whole: log.is_whole(), lost: log.lost() };
        if sender.send(event).is_err() {
            break;
        }
    }
    let (lost, notes) = (log.lost(), log.notes_of_source());
    let (rows, given, share_used) = (log.rows(), log.given(), log.share_used());
    Ok(Event::End(Ending { lost, notes, rows, given, share_used }))
}
