//! One step, whichever method took it: where it led, all points on its way, and its error.

use crate::stored::stored;
use std::ops::Range;

/// A point, or its rates.
pub(super) type Numbers<const N: usize> = [f64; N];

/// Which components the rates depend on where the ground is the same everywhere: yaw and the
/// velocities, and whatever motors have right after them. Energies act on nothing.
pub(super) const COUPLED: Range<usize> = 2..6;
/// The same where it differs from place to place.
pub(super) const COUPLED_BY_PLACE: Range<usize> = 0..6;

/// A step that was taken, with all points between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step<const N: usize> {
    pub(super) from: Numbers<N>,
    pub(super) to: Numbers<N>,
    /// How its points leave the straight line between its ends.
    pub(super) bends: [Numbers<N>; 3],
    /// Estimate of its error, at least at its end: the difference to the embedded step of order 4.
    pub(super) error: Numbers<N>,
}

stored!(struct Step<const N> { from, to, bends, error });

impl<const N: usize> Step<N> {
    /// The point at a share of the step, 0 to 1.
    pub(super) fn at(&self, share: f64) -> Numbers<N> {
        let [one, two, three] = &self.bends;
        let rest = 1.0 - share;
        std::array::from_fn(|i| {
            let bend = one[i] + share * (two[i] + share * three[i]);
            rest * self.from[i] + share * (self.to[i] + rest * bend)
        })
    }

    /// How fast its points move halfway [1 over the step].
    pub(super) fn slope_halfway(&self) -> Numbers<N> {
        let [_, two, three] = &self.bends;
        std::array::from_fn(|i| self.to[i] - self.from[i] + 0.25 * (two[i] + three[i]))
    }
}

/// A point moved by weighted stages.
pub(super) fn sum<const N: usize>(
    from: &Numbers<N>,
    weights: &[f64],
    stages: &[Numbers<N>],
) -> Numbers<N> {
    let mut sum = *from;
    for (weight, stage) in weights.iter().zip(stages).filter(|(weight, _)| **weight != 0.0) {
        for (sum, part) in sum.iter_mut().zip(stage) {
            *sum += weight * part;
        }
    }
    sum
}

/// The length of a direction's components that count.
pub(super) fn length(direction: &[f64]) -> f64 {
    direction.iter().map(|part| part * part).sum::<f64>().sqrt()
}
