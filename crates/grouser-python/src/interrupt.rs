//! Long computations that Ctrl-C interrupts: Python handles its signals in its main thread only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::threads;

/// How often Python is asked for signals: short enough that Ctrl-C seems to act at once.
const PATIENCE: Duration = Duration::from_millis(50);

/// Whether a computation is no longer waited for.
#[derive(Clone, Default)]
pub(crate) struct Cancelled(Arc<AtomicBool>);

impl Cancelled {
    pub(crate) fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Computes in a thread of its own, without Python's lock; parallel parts run on the threads of
/// [`threads`]. On a signal that Python turns into an exception, such as Ctrl-C, that exception is
/// returned. `work` is then cancelled: it finishes the part it is computing, and its result is
/// dropped.
pub(crate) fn listening<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Cancelled) -> T + Send + 'static,
) -> PyResult<T> {
    let cancelled = Cancelled::default();
    let (sender, receiver) = channel();
    let (flag, pool) = (cancelled.clone(), threads::pool(py)?);
    thread::spawn(move || drop(sender.send(pool.install(|| work(&flag)))));
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
