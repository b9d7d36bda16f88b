//! A fixed piece of work, whose time says how fast this machine computes now.

use std::fs;
use std::hint::black_box;

/// Steps of the piece of work: about a second.
const STEPS: u64 = 150_000_000;
/// Its CPU time where the budgets of steps were found [s].
const USUAL: f64 = 1.0;

/// How many times longer this machine takes now than the one of the budgets; 1 where the system
/// does not say how long it took.
pub(crate) fn slowness() -> f64 {
    let Some(before) = own_seconds() else { return 1.0 };
    let mut state = 1_u64;
    for step in 0..STEPS {
        // A generator of Lehmer's kind: each step waits for the one before.
        state = black_box(state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(step));
    }
    black_box(state);
    own_seconds().map_or(1.0, |after| (after - before) / USUAL)
}

/// CPU time of this thread, where the system is Linux [s].
fn own_seconds() -> Option<f64> {
    let stat = fs::read_to_string("/proc/thread-self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    // User's and system's time in hundredths of a second, fields 14 and 15 of proc(5); the third is
    // the first after the name.
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(14)? + ticks(15)?) / 100.0)
}
