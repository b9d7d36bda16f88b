//! Floor 3: a run, from its [`Scenario`] to its [`Trajectory`].
//!
//! [`equations`] is one evaluation of the motion. Two ways lead through time: `integrate` carries
//! pose and velocities (dynamic), [`quasi_steady`] the pose alone, with velocities in [`balance`].
//! [`run`] takes one of them and keeps the samples, [`watch`] sees what becomes of the rover.
//! [`power`] does the books of the energy.

pub mod balance;
pub mod equations;
mod integrate;
pub mod power;
pub mod quasi_steady;
pub mod run;
pub mod scenario;
mod times;
pub mod trajectory;
pub mod watch;

pub use balance::Unsteady;
pub use power::EnergyBalance;
pub use run::{Simulation, SimulationError};
pub use scenario::{Approach, Integrator, Motion, Numerics, Scenario, Start};
pub use trajectory::{Method, Outcome, Sample, StuckBecause, Trajectory, WheelSample, Work};
