//! The threads that all calls share: those of this process.
//!
//! A process that was forked has the memory of its parent, and of its threads only the one that
//! forked. Code that uses the parent's pool would wait for ever for threads that do not exist; and
//! `multiprocessing` forks by default on Linux, up to Python 3.13. So the pool belongs to the
//! process that made it, and another process makes its own. All work that is shared among threads
//! passes through here; nothing uses the pool that rayon keeps for a whole program.

use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::errors;

/// A pool, and the process whose threads it has.
struct Own {
    process: u32,
    pool: Arc<ThreadPool>,
}

/// Locked for moments and only under Python's lock, which a thread that forks has: no fork finds it
/// locked.
static POOL: Mutex<Option<Own>> = Mutex::new(None);

/// This process's pool: one thread for each core, or as many as `RAYON_NUM_THREADS` says.
///
/// # Errors
/// `RuntimeError` if the system gives no threads.
pub(crate) fn pool(_under_pythons_lock: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut own = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    let process = process::id();
    if let Some(own) = own.as_ref().filter(|own| own.process == process) {
        return Ok(Arc::clone(&own.pool));
    }
    let pool = ThreadPoolBuilder::new().build().map_err(|error| {
        PyRuntimeError::new_err(format!("no threads can be started to compute with: {error}"))
    })?;
    let pool = Arc::new(pool);
    // The parent's pool is left as it is: to end it would wait for its threads.
    std::mem::forget(own.replace(Own { process, pool: Arc::clone(&pool) }));
    Ok(pool)
}

/// Computes without Python's lock; parallel parts run on the threads of this process.
///
/// # Errors
/// Those of [`pool`], and `InternalError` for a panic.
pub(crate) fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let pool = pool(py)?;
    released(py, || pool.install(work))
}

/// Computes without Python's lock, in this thread.
///
/// # Errors
/// `InternalError` for a panic.
pub(crate) fn released<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| errors::caught(work))
}
