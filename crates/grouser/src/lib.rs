//! Grouser predicts how a wheeled rover moves on loose soil.
pub mod contact;
pub mod document;
pub mod error;
mod root;
pub mod simulation;
pub mod site;
pub mod soil;
pub mod studies;
pub mod units;
pub mod vehicle;
pub mod wheel;
