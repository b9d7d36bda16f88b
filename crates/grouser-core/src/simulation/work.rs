//! How much was computed for a run.

use crate::stored::stored;
use std::ops::AddAssign;

/// How much was computed for a run: counts that repeat on every machine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the equations of motion, by whatever solves them.
    pub evaluations: u64,
    /// Jacobians among them: each is made of a few of those evaluations.
    pub jacobians: u64,
    /// Steps in time.
    pub steps: u64,
    /// Wheels that were settled, for the evaluations and for the samples.
    pub settled_wheels: u64,
}

stored!(struct Work { evaluations, jacobians, steps, settled_wheels });

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.evaluations += other.evaluations;
        self.jacobians += other.jacobians;
        self.steps += other.steps;
        self.settled_wheels += other.settled_wheels;
    }
}
