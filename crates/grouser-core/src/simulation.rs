//! Layer 3, simulation: a run, from its [`Scenario`] to its [`Trajectory`].
//!
//! [`equations`] is one evaluation of the motion. Two ways lead through time: `integrate` carries
//! pose and velocities (dynamic), [`quasi_steady`] the pose alone, with velocities in [`balance`].
//! `progress` takes one of them and keeps samples, and [`watch`] sees what becomes of the rover;
//! [`run`] leads a whole scenario, `simulator` goes step by step for a controller.
//! [`power`] does the books of the energy.

pub mod balance;
pub mod equations;
mod integrate;
pub mod power;
mod progress;
pub mod quasi_steady;
pub mod run;
pub mod scenario;
mod simulator;
mod times;
pub mod trajectory;
pub mod watch;

pub use balance::Unsteady;
pub use power::EnergyBalance;
pub use run::{Simulation, SimulationError};
pub use scenario::{Approach, Integrator, Motion, Numerics, Scenario, Start};
pub use simulator::{LEAST_STEP, Simulator};
pub use trajectory::{Method, Outcome, Sample, StuckBecause, Trajectory, WheelSample, Work};
