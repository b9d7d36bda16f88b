//! What a thread takes: memory by an allocator that counts, and time of the processor.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::time::{Duration, Instant};

/// The system's allocator, which counts what each thread holds.
pub(crate) struct Counting;

thread_local! {
    /// What the thread holds [bytes]; it may free what another took.
    static HELD: Cell<isize> = const { Cell::new(0) };
    /// The most that it has held since the last reset [bytes].
    static MOST: Cell<isize> = const { Cell::new(0) };
}

/// Adds to what the thread holds.
fn count(more: isize) {
    let _ = HELD.try_with(|held| {
        held.set(held.get().wrapping_add(more));
        let _ = MOST.try_with(|most| most.set(most.get().max(held.get())));
    });
}

// SAFETY: all that is asked goes to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size().cast_signed());
        // SAFETY: as this function's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size().cast_signed());
        // SAFETY: as this function's.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-layout.size().cast_signed());
        // SAFETY: as this function's.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size.wrapping_sub(layout.size()).cast_signed());
        // SAFETY: as this function's.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

/// What something took.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Taken {
    /// The most memory at a time [bytes].
    pub(crate) memory: usize,
    /// Time of the processor.
    pub(crate) time: Duration,
}

/// Does something, and measures what this thread took for it.
pub(crate) fn measured<T>(act: impl FnOnce() -> T) -> (T, Taken) {
    let held = HELD.get();
    MOST.set(held);
    let (start, before) = (Instant::now(), processor());
    let done = act();
    let time = match (processor(), before) {
        (Some(after), Some(before)) => after.saturating_sub(before),
        _ => start.elapsed(),
    };
    (done, Taken { memory: usize::try_from(MOST.get() - held).unwrap_or(0), time })
}

/// Time of the processor that this thread has taken, where the system says so.
#[cfg(unix)]
fn processor() -> Option<Duration> {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the pointer is to a value of its type, for the time of the call.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &raw mut time) };
    let seconds = u64::try_from(time.tv_sec).ok().filter(|_| status == 0)?;
    Some(Duration::new(seconds, u32::try_from(time.tv_nsec).ok()?))
}

/// Not asked for here.
#[cfg(not(unix))]
fn processor() -> Option<Duration> {
    None
}
