//! Nodes that are computed side by side.

#![expect(clippy::inline_always, reason = "all of it is compiled once for each instruction set")]

/// Nodes of one half of a wheel: two of the widest vectors, so that one works while the other waits.
pub(super) const LANES: usize = 16;

/// One number for each node.
pub(super) type Lanes = [f64; LANES];

/// Σ over the lanes, always in this order: halves onto halves.
#[inline(always)]
pub(super) fn sum(x: &Lanes) -> f64 {
    let mut x = *x;
    let mut left = LANES / 2;
    while left > 0 {
        for lane in 0..left {
            x[lane] += x[lane + left];
        }
        left /= 2;
    }
    x[0]
}

/// A number for each lane, from its place.
#[inline(always)]
pub(super) fn lanes(value: impl Fn(usize) -> f64) -> Lanes {
    let mut lanes = [0.0; LANES];
    for (lane, number) in lanes.iter_mut().enumerate() {
        *number = value(lane);
    }
    lanes
}
