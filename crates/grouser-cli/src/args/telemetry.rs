//! Arguments of commands that read telemetry.

use std::path::PathBuf;

use clap::Args;

/// How a log of messages is read.
#[derive(Debug, Args)]
pub(crate) struct TelemetryArgs {
    /// Of an MCAP log: the document that says which of its topics and fields are which columns.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) mapping: Option<PathBuf>,
}
