//! The records of a log, read in a thread of their own: while a log is waited for, what was learnt is printed and kept.

use std::io::{self, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use grouser::document::measurements::MeasurementError;
use grouser::document::measurements::telemetry::{Lost, TelemetryReader, TelemetryRecord};
use grouser::vehicle::Rover;

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
    Failed(MeasurementError),
}

/// What is known of a log at its end.
#[derive(Default)]
pub(super) struct Ending {
    pub(super) lost: Lost,
    pub(super) unused: Vec<String>,
    pub(super) rows: u64,
}

/// Reads records ahead.
pub(super) struct Records {
    events: Receiver<Event>,
    is_followed: bool,
}

impl Records {
    /// * `label`: what messages call the log
    /// * `is_followed`: whether Ctrl-C ends the log
    pub(super) fn of(
        label: String,
        source: Box<dyn Read + Send>,
        rover: &Rover,
        is_followed: bool,
    ) -> Self {
        let (sender, events) = sync_channel(AHEAD);
        let rover = rover.clone();
        thread::spawn(move || {
            let last = read(&label, source, &rover, &sender);
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
                Event::End(Ending::default())
            }
            Err(RecvTimeoutError::Timeout) => Event::Nothing,
            Err(RecvTimeoutError::Disconnected) => Event::End(Ending::default()),
        }
    }
}

/// Sends all records; what comes after the last.
fn read(
    label: &str,
    source: Box<dyn Read + Send>,
    rover: &Rover,
    sender: &SyncSender<Event>,
) -> Result<Event, MeasurementError> {
    let ended_in_row = Arc::new(AtomicBool::new(false));
    let source = LastByte { source, last: b'\n', ended_in_row: ended_in_row.clone() };
    let mut reader = TelemetryReader::new(label, source, rover)?;
    while let Some(record) = reader.next_record()? {
        let is_whole = !ended_in_row.load(Ordering::Relaxed);
        let event = Event::Record { record, is_whole, lost: reader.lost().clone() };
        if sender.send(event).is_err() {
            break;
        }
    }
    let (lost, unused) = (reader.lost().clone(), reader.unused().to_vec());
    Ok(Event::End(Ending { lost, unused, rows: reader.rows() }))
}

/// Notices whether a source ends within a row.
struct LastByte {
    source: Box<dyn Read + Send>,
    last: u8,
    ended_in_row: Arc<AtomicBool>,
}

impl Read for LastByte {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(buffer)?;
        match buffer[..count].last() {
            Some(last) => self.last = *last,
            None if !buffer.is_empty() => {
                self.ended_in_row.store(!matches!(self.last, b'\n' | b'\r'), Ordering::Relaxed);
            }
            None => {}
        }
        Ok(count)
    }
}
