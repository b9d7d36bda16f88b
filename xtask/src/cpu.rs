//! What programs computed: on a busy machine the number that repeats.

use std::fs;
use std::time::Duration;

/// CPU time of all programs that this one started and that have ended, where the system is Linux.
pub(crate) fn of_children() -> Option<Duration> {
    // The name of the program, in brackets, may hold blanks; after it come the third field and the
    // next.
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<u64>().ok();
    // User's and system's time in hundredths of a second, fields 16 and 17 of proc(5).
    Some(Duration::from_millis(10 * (ticks(16)? + ticks(17)?)))
}
