//! Telemetry of a drive, record by record, from whatever recorded it: CSV, Parquet, or MCAP logs of Foxglove and ROS.
//!
//! [`TelemetryLog`] opens any of them, and gives records in SI units and Grouser's signs in the order of time; what was
//! damaged, late or not used is counted, and [notes](TelemetryLog::notes) say so. Memory does not grow with the log.

mod error;
mod field;
mod log;
mod mapping;
mod mcap;
mod merge;
mod messages;
mod parquet;
mod plan;
mod pose;
mod topic;
mod writer;

pub use error::{Problem, TelemetryError};
pub use log::TelemetryLog;
pub use mapping::Mapping;
pub use messages::MessageRows;
pub use plan::TopicChoices;
pub use topic::Topic;
pub use writer::TelemetryWriter;
