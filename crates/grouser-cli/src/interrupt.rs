//! Ctrl-C: exit code 130, and no file half-way to its place.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held while files are moved to their place.
static MOVING_FILES: Mutex<()> = Mutex::new(());

/// The exit code of an interrupted program: 128 and the number of SIGINT.
const INTERRUPTED: i32 = 130;

/// From now on, Ctrl-C ends the program as soon as no files are being moved.
pub(crate) fn exit_on_ctrl_c() {
    let handler = || {
        let _files_are_whole = not_now();
        eprintln!("interrupted");
        std::process::exit(INTERRUPTED);
    };
    // Without a handler the system's own ends the program: no reason not to start.
    drop(ctrlc::set_handler(handler));
}

/// As long as the result lives, Ctrl-C waits.
pub(crate) fn not_now() -> MutexGuard<'static, ()> {
    MOVING_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}
