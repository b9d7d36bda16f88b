//! Layer 3, simulation: a run, from its [`Scenario`] to its [`Trajectory`].
//!
//! [`Run`] leads a rover from the start of a scenario to its end, or step by step: a
//! [`Controller`], such as the scenario's drive, turns the wheels, a [`State`] is all that changes,
//! and what is looked at becomes a [`Record`].
//!
//! [`equations`] is one evaluation of the motion. Two ways lead through time: `integrate` carries
//! pose and velocities (dynamic), [`quasi_steady`] the pose alone, with velocities of a
//! [`steady_state`]. [`SteadyMotion`] is one such state by itself. A `leg` takes one of them and
//! keeps records, and [`watch`] sees what becomes of the rover; [`power`] computes the energy
//! balance.

pub mod allowance;
mod along_ground;
pub mod controller;
pub mod equations;
mod error;
mod integrate;
mod leg;
mod linearise;
mod method;
mod most_taken;
mod outcome;
mod outcome_kind;
mod point;
pub mod power;
pub mod quasi_steady;
mod record;
mod recorded;
pub mod run;
pub mod scatter;
pub mod scenario;
mod state;
mod steady_motion;
mod steady_run;
pub mod steady_state;
mod supply;
mod times;
pub mod trajectory;
mod turning;
pub mod watch;
mod work;
mod yaw;

pub use controller::{CONTROL_PERIOD, Controller, Observation};
pub use error::RunError;
pub use linearise::{LinearStep, NoLinearStep, POSE_AND_VELOCITIES, STEP_LENGTHS};
pub use method::Method;
pub use outcome::{Outcome, PowerLost, StuckBecause};
pub use outcome_kind::{InBand, OutcomeKind, OutcomeRow, Severity};
pub use power::EnergyBalance;
pub use record::{Record, WheelRecord};
pub use run::{LEAST_STEP, Run};
pub use scatter::Scatter;
pub use scenario::{Approach, Integrator, Motion, Numerics, Scenario, Start};
pub use state::{BadState, State};
pub use steady_motion::{Seeking, SteadyMotion};
pub use steady_state::{MOST_SLIP, NotSteady};
pub use supply::Charge;
pub use times::SAME_TIME;
pub use trajectory::Trajectory;
pub use turning::MOST_WHEELS;
pub use work::Work;
pub use yaw::{FASTEST_TURN, PrescribedYaw, TooFast};
