//! Numbers that are computed side by side: those of many wheels, or of many facets of one.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

/// How many are computed side by side: two of the widest vectors, four of the usual ones, so that
/// none waits for the result before.
pub(super) const WIDE: usize = 16;

/// One number of each.
pub(super) type Each = [f64; WIDE];

/// A number of each, from its place.
#[inline(always)]
pub(super) fn each(value: impl Fn(usize) -> f64) -> Each {
    let mut each = [0.0; WIDE];
    for (lane, number) in each.iter_mut().enumerate() {
        *number = value(lane);
    }
    each
}

/// Σ over the lanes, always in this order: halves onto halves.
#[inline(always)]
pub(super) fn sum(x: &Each) -> f64 {
    let mut x = *x;
    let mut left = WIDE / 2;
    while left > 0 {
        for lane in 0..left {
            x[lane] += x[lane + left];
        }
        left /= 2;
    }
    x[0]
}
