//! What a run leaves behind.

use super::method::Method;
use super::outcome::Outcome;
use super::record::Record;
use super::work::Work;

/// A run: its records in the order of time, and what became of the rover.
///
/// How much energy did the motors spend for each metre, and does the energy balance close?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::simulation::Run;
///
/// let trajectory = Run::new(&paper::traverse()?)?.to_end()?;
/// let end = trajectory.last();
/// let per_metre = end.energy.motors / end.state.position.x;
/// assert_eq!(format!("{per_metre:.2} J/m"), "5.87 J/m");
/// assert!(trajectory.energy_error().abs() < 1e-5 * end.energy.motors);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
