//! Computations: few at a time, each with an end, and stopped where nobody waits for its answer.

use std::any::Any;
use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use http::StatusCode;
use tokio::runtime::Handle;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::timeout;

use crate::asked::GoOn;
use crate::limits::Limits;
use crate::refusal::Refusal;

/// The places of computations.
pub(crate) struct RunPlaces {
    /// The places of questions that are computed.
    computing: Arc<Semaphore>,
    /// The places of these and of those that wait.
    all: Arc<Semaphore>,
    /// The places of questions whose documents and maps are read.
    reading: Arc<Semaphore>,
    /// The memory for lines that wait for their readers [KiB].
    lines: Arc<Semaphore>,
    time: Duration,
    /// Whether the server ends.
    has_ended: Arc<AtomicBool>,
}

/// The place of a computation. It is free again when this is dropped.
pub(crate) struct Place(#[expect(dead_code, reason = "it is held")] OwnedSemaphorePermit);

/// Somebody waits for an answer, until this is dropped.
pub(crate) struct Waiter(Arc<AtomicBool>);

/// What a computation asks whether to go on.
#[derive(Clone)]
pub(crate) struct Awaited {
    has_gone: Arc<AtomicBool>,
    has_ended: Arc<AtomicBool>,
    until: Instant,
    computing: Arc<Semaphore>,
    reading: Arc<Semaphore>,
    lines: Arc<Semaphore>,
}

/// Time of a study, whose progress somebody watches.
const STUDY: Duration = Duration::from_secs(12 * 3600);
/// How often it is looked whether readers have taken so much that there is room.
const LOOK: Duration = Duration::from_millis(2);
/// How soon who has gone leaves the line.
const LEAVE: Duration = Duration::from_millis(20);
/// Questions that are read at a time: a map may take some dozen megabytes until it is read.
const READING: usize = 4;
/// Bytes of a permit for lines.
const KIB: usize = 1 << 10;

impl RunPlaces {
    pub(crate) fn new(limits: &Limits) -> Self {
        Self {
            computing: Arc::new(Semaphore::new(limits.runs)),
            all: Arc::new(Semaphore::new(limits.runs + limits.waiting)),
            reading: Arc::new(Semaphore::new(READING)),
            lines: Arc::new(Semaphore::new(limits.answer_bytes as usize / KIB)),
            time: limits.run_time,
            has_ended: Arc::default(),
        }
    }

    /// A place, if one is free.
    pub(crate) fn place(&self) -> Result<Place, Refusal> {
        let full = |_| {
            let message = "too many computations wait already";
            Refusal::new(StatusCode::SERVICE_UNAVAILABLE, message)
        };
        Arc::clone(&self.all).try_acquire_owned().map(Place).map_err(full)
    }

    /// Somebody who asks, and what the computation asks.
    pub(crate) fn asking(&self) -> (Waiter, Awaited) {
        let has_gone = Arc::new(AtomicBool::new(false));
        let has_ended = Arc::clone(&self.has_ended);
        let go_on = Awaited {
            has_gone: Arc::clone(&has_gone),
            has_ended,
            until: Instant::now() + self.time,
            computing: Arc::clone(&self.computing),
            reading: Arc::clone(&self.reading),
            lines: Arc::clone(&self.lines),
        };
        (Waiter(has_gone), go_on)
    }

    /// Stops all computations, and sends home who waits for a place.
    pub(crate) fn end(&self) {
        self.has_ended.store(true, Ordering::Relaxed);
        self.computing.close();
        self.reading.close();
    }
}

impl Drop for Waiter {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl GoOn for Awaited {
    fn is_on(&self) -> bool {
        !self.has_gone.load(Ordering::Relaxed)
            && !self.has_ended.load(Ordering::Relaxed)
            && Instant::now() < self.until
    }

    /// It ends with who watches it, or the server.
    fn of_study(&self) -> Box<dyn GoOn> {
        Box::new(Self { until: self.until + STUDY, ..self.clone() })
    }

    fn turn(&self) -> Option<Box<dyn Any>> {
        self.in_order(&self.computing).map(|permit| Box::new(permit) as Box<dyn Any>)
    }
}

impl Awaited {
    /// Waits for the turn of reading a question.
    pub(crate) fn reading_turn(&self) -> Option<OwnedSemaphorePermit> {
        self.in_order(&self.reading)
    }

    /// Waits until readers have taken so much that there is room for a line.
    pub(crate) fn room(&self, bytes: usize) -> Option<OwnedSemaphorePermit> {
        let count = u32::try_from(bytes.div_ceil(KIB)).ok()?;
        while self.is_on() {
            if let Ok(permits) = Arc::clone(&self.lines).try_acquire_many_owned(count) {
                return Some(permits);
            }
            std::thread::sleep(LOOK);
        }
        None
    }

    /// A place, behind those who have waited longer: in any other order some would wait very long,
    /// and places would go to those who are about to leave.
    fn in_order(&self, of: &Arc<Semaphore>) -> Option<OwnedSemaphorePermit> {
        Handle::current().block_on(async {
            let mut place = pin!(Arc::clone(of).acquire_owned());
            while self.is_on() {
                if let Ok(place) = timeout(LEAVE, place.as_mut()).await {
                    return place.ok();
                }
            }
            None
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Mutex, mpsc};

    use tokio::runtime::Builder;
    use tokio::task::spawn_blocking;
    use tokio::time::sleep;

    use super::*;

    #[test]
    fn turns_come_in_the_order_of_the_line_and_who_goes_leaves_it() {
        let places = RunPlaces::new(&Limits { runs: 1, ..Limits::default() });
        let (end_first, first_ends) = mpsc::channel();
        let mut first_ends = Some(first_ends);
        let order = Arc::new(Mutex::new(Vec::new()));
        let mut waiters = Vec::new();
        let run = async {
            let mut all = Vec::new();
            for number in 0..5 {
                let (waiter, go_on) = places.asking();
                waiters.push(waiter);
                let (order, holds) = (Arc::clone(&order), first_ends.take());
                all.push(spawn_blocking(move || {
                    let Some(_turn) = go_on.turn() else { return };
                    order.lock().unwrap().push(number);
                    if let Some(end) = holds {
                        end.recv().unwrap();
                    }
                }));
                // Until it stands in line.
                sleep(2 * LEAVE).await;
            }
            drop(waiters.remove(2));
            all.remove(2).await.unwrap();
            end_first.send(()).unwrap();
            for one in all {
                one.await.unwrap();
            }
        };
        Builder::new_current_thread().enable_time().build().unwrap().block_on(run);
        assert_eq!(*order.lock().unwrap(), [0, 1, 3, 4]);
    }
}
