//! The way ahead, simulated before it is driven.

use super::driven::{Driven, End};
use super::navigator::Navigator;
use super::stop::{Cause, Kind, Stopped};
use crate::simulation::{Run, RunError};

/// Looks ahead once in a while.
pub(super) struct Ahead {
    /// How far [m].
    way: f64,
    /// The way over the ground at which the next look is due [m].
    next: f64,
}

impl Ahead {
    pub(super) fn new(way: f64) -> Self {
        Self { way, next: 0.0 }
    }

    /// Looks ahead if that is due: every half of the way that is looked at. What is felt there, or
    /// what becomes of the rover there, stops it here.
    pub(super) fn look(
        &mut self,
        run: &Run,
        navigator: &Navigator,
        driven: &Driven,
    ) -> Result<Option<Stopped>, RunError> {
        let after = driven.ground();
        if after < self.next {
            return Ok(None);
        }
        self.next = after + self.way / 2.0;
        let mut copy = Run::resume(run.scenario(), run.state().clone());
        let cause = match driven.clone().drive_for(&mut copy, &mut navigator.clone(), self.way)? {
            Some(End::Stopped(Stopped { cause, kind: Kind::Reactive, .. })) => cause,
            Some(End::Ended(outcome)) => Cause::Outcome(outcome),
            _ => return Ok(None),
        };
        Ok(Some(Stopped { cause, kind: Kind::Predictive, after }))
    }
}
