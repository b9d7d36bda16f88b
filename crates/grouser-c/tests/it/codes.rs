//! Codes that only several threads and panics make. `tests/wrong_uses.c` has the others.

use std::sync::atomic::{AtomicBool, Ordering};

use grouser_c::run::{grouser_run_free, grouser_run_step};
use grouser_c::status::Status;

use super::run_of;

/// Both end: the one that is refused changes nothing, and the other goes on.
#[test]
fn two_threads_on_one_run_are_told_apart() {
    let run = run_of(c"");
    let seen = AtomicBool::new(false);
    let work = || {
        while !seen.load(Ordering::Relaxed) {
            // SAFETY: there is a speed for each wheel.
            match unsafe { grouser_run_step(run, 4, [0.5; 4].as_ptr(), 1.0) } {
                Status::Ok => {}
                Status::Busy => seen.store(true, Ordering::Relaxed),
                other => panic!("{other:?}"),
            }
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        scope.spawn(work);
    });
    // SAFETY: there is a speed for each wheel.
    assert_eq!(unsafe { grouser_run_step(run, 4, [0.5; 4].as_ptr(), 1.0) }, Status::Ok);
    assert_eq!(grouser_run_free(run), Status::Ok);
    assert_eq!(grouser_run_free(run), Status::BadHandle);
}
