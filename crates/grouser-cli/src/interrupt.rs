//! Signals: Ctrl-C ends the program with exit code 130 and no file half-way to its place, and a
//! limit on the size of files is an error like a full disk.

use std::io::Write as _;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held while there are files that are not in their place.
static MOVING_FILES: Mutex<()> = Mutex::new(());

/// The exit code of an interrupted program: 128 and the number of SIGINT.
const INTERRUPTED: i32 = 130;

/// From now on, Ctrl-C ends the program as soon as no files are being moved.
pub(crate) fn exit_on_ctrl_c() {
    let handler = || {
        let _files_are_whole = not_now();
        // Whoever cannot hear it still gets the exit code.
        let _ = writeln!(std::io::stderr(), "interrupted");
        std::process::exit(INTERRUPTED);
    };
    // Without a handler the system's own ends the program: no reason not to start.
    drop(ctrlc::set_handler(handler));
}

/// As long as the result lives, Ctrl-C waits.
pub(crate) fn not_now() -> MutexGuard<'static, ()> {
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
