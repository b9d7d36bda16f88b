//! Floor 3: a run, from its scenario to its trajectory.

pub mod scenario;

pub use scenario::{Motion, Scenario, Start};
