//! Times of a run at which something is due.

/// A day: no run lasts longer [s].
pub const LONGEST_DURATION: f64 = 86_400.0;

/// Times that differ by less are one, but for rounding [s]. Source: ours; a thousandth of the
/// shortest step, and far above the rounding of a day in seconds.
pub const SAME_TIME: f64 = 1e-9;

/// Multiples of an interval after one time and before another.
pub(super) fn multiples_between(after: f64, until: f64, interval: f64) -> Vec<f64> {
    let mut times = Vec::new();
    let mut count = (after / interval).floor();
    while count * interval < until {
        let time = count * interval;
        if time > after && !is_same_time(time, after) && !is_same_time(time, until) {
            times.push(time);
        }
        count += 1.0;
    }
    times
}

/// The first multiple of an interval after a time, which it is not but for rounding.
pub(super) fn multiple_after(time: f64, interval: f64) -> f64 {
    let next = ((time / interval).floor() + 1.0) * interval;
    if is_same_time(next, time) { next + interval } else { next }
}

/// A time, or the multiple of an interval that it is but for rounding: so that many steps do not
/// add up their rounding.
pub(super) fn snapped(time: f64, interval: f64) -> f64 {
    if is_multiple(time, interval) { (time / interval).round() * interval } else { time }
}

/// Whether two times are one, but for rounding.
pub(super) fn is_same_time(one: f64, other: f64) -> bool {
    (one - other).abs() < SAME_TIME
}

/// Whether a sample belongs at a time: at the start, the end and the intervals between.
///
/// * `interval`, `duration`: of samples and of the run [s]
pub(super) fn is_sample_due(time: f64, interval: f64, duration: f64) -> bool {
    is_multiple(time, interval) || is_same_time(time, duration)
}

/// Whether a time is a multiple of an interval, but for rounding.
pub(super) fn is_multiple(time: f64, interval: f64) -> bool {
    is_same_time(time, (time / interval).round() * interval)
}
