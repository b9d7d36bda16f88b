//! A bound on what is computed for a stretch of a run, so that every run ends.

use std::cell::Cell;

use super::watch::WATCH_PERIOD;
use super::work::Work;

/// Evaluations of the equations of motion and steps together that may be spent between two looks of
/// the watch, [`WATCH_PERIOD`] apart [-].
///
/// A run that needs more of them ends with an error: steps in time or strides over the ground have
/// become so short that it would not end otherwise. Source: ours; of the first random rovers,
/// soils, grounds and commands the hardest took 2,100.
pub const MOST_EVALUATIONS: u64 = 100_000;

/// A failed evaluation counts as so many more [-]: it tried everything before it gave up. Source:
/// ours; on warped ground, a search for loads in vain takes some hundred searches for sinkages.
const OF_A_FAILURE: u64 = 100;

/// What may still be computed until the next look of the watch.
pub(super) struct Allowance {
    /// The count at which it is spent.
    until: Cell<u64>,
}

impl Allowance {
    /// The allowance of equations that no run asks.
    pub(super) fn unlimited() -> Self {
        Self { until: Cell::new(u64::MAX) }
    }

    /// Allows [`MOST_EVALUATIONS`] from here on.
    pub(super) fn renew(&self, so_far: Work) {
        self.until.set(count(so_far) + MOST_EVALUATIONS);
    }

    /// Takes off what a failed attempt costs.
    pub(super) fn charge_failure(&self) {
        self.until.set(self.until.get().saturating_sub(OF_A_FAILURE));
    }

    /// Whether nothing more may be computed.
    pub(super) fn is_spent(&self, so_far: Work) -> bool {
        count(so_far) >= self.until.get()
    }
}

fn count(work: Work) -> u64 {
    work.evaluations + work.steps
}

/// Why a run does not go on whose allowance is spent.
pub(super) fn reason() -> String {
    format!("{MOST_EVALUATIONS} evaluations of the motion do not lead {WATCH_PERIOD} s further")
}
