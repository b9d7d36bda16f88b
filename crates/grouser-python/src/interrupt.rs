//! Long computations that Ctrl-C interrupts: Python handles its signals in its main thread only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;

use crate::{errors, threads};

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
/// [`threads`], and a panic is an `InternalError`. On a signal that Python turns into an exception, such as Ctrl-C, that exception is
/// returned. `work` is then cancelled: it finishes the part it is computing, and its result is
/// dropped.
pub(crate) fn listening<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Cancelled) -> T + Send + 'static,
) -> PyResult<T> {
    let cancelled = Cancelled::default();
    let (sender, receiver) = channel();
    let (flag, pool) = (cancelled.clone(), threads::pool(py)?);
    let answer = move || errors::caught(|| pool.install(|| work(&flag)));
    thread::spawn(move || drop(sender.send(answer())));
    let mut waiting = receiver;
    loop {
        let (answer, again) = py.detach(move || (waiting.recv_timeout(PATIENCE), waiting));
        waiting = again;
        match answer {
            Ok(result) => return result,
            Err(RecvTimeoutError::Timeout) => {
                if let Err(signal) = py.check_signals() {
                    cancelled.0.store(true, Ordering::Relaxed);
                    return Err(signal);
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return errors::caught(|| unreachable!("a computation ended without an answer"));
            }
        }
    }
}

/// Panics where computations do: tests see by it what Python gets.
///
/// * `is_listening`: whether in a thread of its own, which Ctrl-C interrupts
#[pyfunction]
pub(crate) fn panic(py: Python<'_>, is_listening: bool) -> PyResult<()> {
    let fault = || panic!("as a test asked for");
    if is_listening { listening(py, move |_| fault()) } else { threads::released(py, fault) }
}
