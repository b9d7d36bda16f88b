//! Floor 3: a run, from its [`Scenario`] to its [`Trajectory`].
//!
//! [`equations`] is one evaluation of the motion, `integrate` carries it through time, and
//! [`run`] puts both together, watches what becomes of the rover and keeps the samples.
//! [`power`] does the books of the energy.

pub mod equations;
mod integrate;
pub mod power;
pub mod run;
pub mod scenario;
pub mod trajectory;

pub use power::EnergyBalance;
pub use run::{Simulation, SimulationError};
pub use scenario::{Integrator, Motion, Numerics, Scenario, Start};
pub use trajectory::{Outcome, Sample, StuckBecause, Trajectory, WheelSample};
