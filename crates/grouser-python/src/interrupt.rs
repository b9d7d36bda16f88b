//! Long work with an ear for Ctrl-C: Python hears its signals in its own thread only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::threads;

/// How often Python is asked for signals: a Ctrl-C is heard at once, as people feel it.
const PATIENCE: Duration = Duration::from_millis(50);

/// Whether nobody waits for some work any more.
#[derive(Clone, Default)]
pub(crate) struct Cancelled(Arc<AtomicBool>);

impl Cancelled {
    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Does work in a thread of its own, without Python's lock; what it shares among threads goes to
/// those of [`threads`]. On a signal that Python makes an
/// exception of, such as Ctrl-C, that exception is returned; the work is told, and what it is in the
/// middle of is left to end by itself.
pub(crate) fn listening<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Cancelled) -> T + Send + 'static,
) -> PyResult<T> {
    let cancelled = Cancelled::default();
    let (sender, receiver) = channel();
    let (told, pool) = (cancelled.clone(), threads::pool(py)?);
    thread::spawn(move || drop(sender.send(pool.install(|| work(&told)))));
    let mut waiting = receiver;
    loop {
        let (answer, again) = py.detach(move || (waiting.recv_timeout(PATIENCE), waiting));
        waiting = again;
        match answer {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(signal) = py.check_signals() {
                    cancelled.0.store(true, Ordering::Relaxed);
                    return Err(signal);
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                let message = "a computation ended without an answer: this is a fault of grouser";
                return Err(PyRuntimeError::new_err(message));
            }
        }
    }
}
