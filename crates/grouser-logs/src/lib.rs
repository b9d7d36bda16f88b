//! Logs of rovers, both ways: runs and missions are written as logs, and logs of drives are read as
//! telemetry.
//!
//! | what | by |
//! |---|---|
//! | a run or a mission as MCAP, for Foxglove and Rerun | [`Log`] |
//! | a replayed drive as MCAP, measured beside predicted | [`write_replay`] |
//! | telemetry of a drive from CSV, Parquet, Arrow or MCAP, of one file or several | [`TelemetryLog`] |
//! | the drives of a folder, for [`drive_validation`](grouser::studies::drive_validation) | [`DriveFolder`] |
//! | messages that somebody else decodes, as telemetry | [`MessageRows`] |
//! | telemetry as CSV or Parquet | [`TelemetryWriter`] |
//!
//! The container MCAP and the encoding of Protocol Buffers are each one module that writes and
//! reads. The crate computes no force.
//!
//! # Logs that are written
//!
//! Records are appended as they come, and what was appended is written soon after: memory does not
//! grow with a mission. A log has
//!
//! | topic | messages | when |
//! |---|---|---|
//! | `/tf_static`, `/tf` | `foxglove.FrameTransforms`: `world` → `slope` → `body` → each wheel → its rim | once; each record |
//! | `/rover`, `/wheels/NAME` | `grouser.Rover`, `grouser.Wheel`: a field for each column of results, its unit in its name | each record |
//! | `/rover/battery` | `grouser.Battery`: voltage, current and state of charge, where the battery is known | each record |
//! | `/scene/rover`, `/scene/ground`, `/scene/path` | `foxglove.SceneUpdate`: likeness of the rover, plane with grid, path so far | once; as they grow |
//! | `/scene/forces` | `foxglove.SceneUpdate`: the soil's force on each wheel, an arrow | each record |
//! | `/events` | `foxglove.Log`: flags of validity as they are first raised, and what the caller says | then |
//! | `/robot_description` | `std_msgs/msg/String`: the rover as URDF | once |
//!
//! A replayed drive is another log, of [`write_replay`]: `/measured/…` and `/predicted/…` with the
//! numbers of both.
//!
//! Times count from the run's start, which is 0 ns. Transforms and scenes are in SI units, numbers
//! in the units of their columns. The same records make the same bytes.
//!
//! How does a mission become a log?
//!
//! ```
//! use grouser_core::paper;
//! use grouser::studies::mission::DrivenMission;
//! use grouser_core::mission::{Leg, Manoeuvre, Mission};
//! use grouser_core::units::deg;
//! use grouser_logs::Log;
//!
//! let legs = vec![
//!     Leg::new(Manoeuvre::drive(0.5)),
//!     Leg::new(Manoeuvre::Turn { angle: deg(45.0) }),
//! ];
//! let mission = Mission { scenario: paper::traverse()?, legs, stops: Vec::new(), sensors: None };
//! let driven = DrivenMission::drive("there", &mission)?;
//! let mut log = Log::begin(Vec::new(), "HAKUTO on sand", &mission.scenario)?;
//! log.mission(&driven)?;
//! let file = log.finish()?;
//! assert!(file.starts_with(b"\x89MCAP0\r\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A mission of weeks is written as it is driven, without its records in memory: a
//! [`MissionRun`](grouser_core::mission::MissionRun) hands them over some at a time, to
//! [`Log::append`].
//!
//! # Logs that are read
//!
//! [`TelemetryLog`] gives records in SI units and Grouser's signs in the order of time; a
//! [`Mapping`] says which topics and fields of a log of messages, or columns of a table, are which
//! columns of telemetry. What was damaged, late or not used is counted, and [notes](TelemetryLog::notes) say so. Memory does not
//! grow with the log.

mod drives;
mod error;
mod foxglove;
mod mapping;
mod mcap;
mod protobuf;
mod replay_log;
mod ros;
mod run_log;
mod telemetry;

pub use drives::{DriveFolder, DriveFolderError};
pub use error::{OptionNames, OtherKind, OverBudget, Problem, Remedy, TelemetryError};
pub use foxglove::Level;
pub use mapping::Mapping;
pub use mapping::messages::MessageRows;
pub use mapping::plan::TopicChoices;
pub use mapping::topic::Topic;
pub use replay_log::write_replay;
pub use run_log::Log;
pub use run_log::error::LogError;
pub use telemetry::TelemetryLog;
pub use telemetry::options::LogOptions;
pub use telemetry::writer::TelemetryWriter;
