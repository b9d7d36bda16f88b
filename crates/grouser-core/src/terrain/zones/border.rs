//! Straight pieces of borders between zones.

use crate::units::Vec2;

/// A piece of a border: its ends.
pub(super) type Border = [Vec2; 2];

/// Where a border is across a footprint, in its coordinates.
pub(super) fn across(border: &Border, along: f64) -> f64 {
    let [from, to] = border;
    let share = (along - from.x) / (to.x - from.x);
    (from.y + share * (to.y - from.y)).clamp(-1.0, 1.0)
}

/// Where along a footprint two borders cross, if they do.
pub(super) fn crossing(one: &Border, other: &Border) -> Option<f64> {
    let (way, across) = (one[1] - one[0], other[1] - other[0]);
    let turn = way.perp(&across);
    let apart = other[0] - one[0];
    let (share, along) = (apart.perp(&across) / turn, apart.perp(&way) / turn);
    // Parallel ones have no such shares.
    let is_on_both = (0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&along);
    is_on_both.then(|| one[0].x + share * way.x)
}

/// The piece of a border within a footprint, in its coordinates (Liang and Barsky 1984).
pub(super) fn clipped([from, to]: Border) -> Option<Border> {
    let way = to - from;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        for sense in [-1.0, 1.0] {
            let (speed, room) = (sense * way[axis], 1.0 - sense * from[axis]);
            if speed == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if speed > 0.0 {
                last = last.min(room / speed);
            } else {
                first = first.max(room / speed);
            }
        }
    }
    (first < last).then(|| [from + first * way, from + last * way])
}
