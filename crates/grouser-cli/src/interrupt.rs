//! Signals: Ctrl-C ends the program with exit code 130 and no file half-way to its place, and a
//! limit on the size of files is an error like a full disk.

use std::io::Write as _;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held while there are files that are not in their place.
static MOVING_FILES: Mutex<()> = Mutex::new(());

/// Whether a command handles Ctrl-C itself.
static IS_HANDLED: AtomicBool = AtomicBool::new(false);
/// Whether such a command is asked to stop.
static STOP: AtomicBool = AtomicBool::new(false);

/// The exit code of an interrupted program: 128 and the number of SIGINT.
pub(crate) const INTERRUPTED: u8 = 130;

/// From now on, Ctrl-C ends the program as soon as no files are being moved.
pub(crate) fn exit_on_ctrl_c() {
    let handler = || {
        if IS_HANDLED.load(Ordering::Relaxed) && !STOP.swap(true, Ordering::Relaxed) {
            return;
        }
        let _files_are_whole = defer_ctrl_c();
        // Without a reader of messages there is still the exit code.
        let _ = writeln!(std::io::stderr(), "interrupted");
        std::process::exit(INTERRUPTED.into());
    };
    // Without a handler the system's own ends the program: no reason not to start.
    drop(ctrlc::set_handler(handler));
}

/// From now on, the first Ctrl-C only [asks](is_asked_to_stop) to stop; the second one ends the
/// program as ever.
pub(crate) fn handle_ctrl_c() {
    IS_HANDLED.store(true, Ordering::Relaxed);
}

/// Whether a command that handles Ctrl-C itself is asked to stop.
pub(crate) fn is_asked_to_stop() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// Defers Ctrl-C as long as the result lives.
pub(crate) fn defer_ctrl_c() -> MutexGuard<'static, ()> {
    MOVING_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// From now on, a write beyond the limit on the size of files (`ulimit -f`) fails as on a full
/// disk. Without a handler, SIGXFSZ would end the program before it can clean up.
#[cfg(unix)]
pub(crate) fn fail_at_file_size_limit() {
    let nobody_asks = std::sync::Arc::default();
    drop(signal_hook::flag::register(signal_hook::consts::SIGXFSZ, nobody_asks));
}

/// There is no such signal here.
#[cfg(not(unix))]
pub(crate) fn fail_at_file_size_limit() {}
