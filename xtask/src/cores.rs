//! Work on all cores.

use std::thread;

use anyhow::{Result, bail};

/// Does the work on each core at the same time, until all have done it.
///
/// # Errors
/// The first of the work's, and that it panicked.
pub(crate) fn on_each(work: impl Fn() -> Result<()> + Sync) -> Result<()> {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let handles: Vec<_> = (0..cores).map(|_| scope.spawn(&work)).collect();
        handles.into_iter().try_for_each(|handle| match handle.join() {
            Ok(done) => done,
            Err(_) => bail!("a worker panicked"),
        })
    })
}
