//! What a run leaves behind.

use super::method::Method;
use super::outcome::Outcome;
use super::record::Record;
use super::work::Work;

/// A run: its records in the order of time, and what became of the rover.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// At the start, at every sample interval, and at the end.
    pub records: Vec<Record>,
    /// What became of the rover.
    pub outcome: Outcome,
    /// How it was computed.
    pub method: Method,
    /// Work of the solver.
    pub work: Work,
}

impl Trajectory {
    /// The last record.
    ///
    /// # Panics
    /// Never for a trajectory of a [`Run`](super::Run): it has its start.
    #[must_use]
    pub fn last(&self) -> &Record {
        self.records.last().expect("a trajectory has at least its start")
    }

    /// Energy missing from the balance [J]: motors less soil, kinetic and potential.
    #[must_use]
    pub fn energy_error(&self) -> f64 {
        let (first, last) = (&self.records[0].energy, &self.last().energy);
        let (motors, soil) = (last.motors - first.motors, last.soil - first.soil);
        let kinetic = last.kinetic - first.kinetic;
        let potential = last.potential - first.potential;
        motors - soil - kinetic - potential
    }
}
