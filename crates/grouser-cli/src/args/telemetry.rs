//! Arguments of commands that read telemetry.

use std::path::PathBuf;

use clap::Args;

/// How a log of messages is read.
#[derive(Clone, Debug, Args)]
pub(crate) struct TelemetryArgs {
    /// Which topics and fields of a log of messages (MCAP), or columns of a table (CSV), are which
    /// columns of telemetry: a file or one of `grouser`, `ros`, `foxglove`; without it the one of
    /// these that fits, for messages, and the names of a table's columns.
    #[arg(long, value_name = "FILE|NAME")]
    pub(crate) mapping: Option<PathBuf>,
    /// The topic that is meant where several have what a mapping reads; can be repeated.
    #[arg(long = "topic", value_name = "TYPE=TOPIC", value_parser = choice)]
    pub(crate) topics: Vec<(String, String)>,
    /// End with exit code 0 even where less than half of the log could be used, which is 3
    /// otherwise.
    #[arg(long)]
    pub(crate) accept_loss: bool,
}

fn choice(text: &str) -> Result<(String, String), String> {
    let (what, topic) =
        text.split_once('=').ok_or_else(|| format!("'{text}' is not of the form TYPE=TOPIC"))?;
    Ok((what.trim().to_owned(), topic.trim().to_owned()))
}
