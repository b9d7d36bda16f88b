//! Arguments of commands that read telemetry.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use grouser::document::measurements::telemetry::Odometry;

/// How telemetry is read, with the way of the rover.
#[derive(Clone, Debug, Args)]
pub(crate) struct TelemetryArgs {
    #[command(flatten)]
    pub(crate) log: LogArgs,
    /// What measured ways and rotations of the log, in place of what its mapping says: `visual`,
    /// `wheels` (which shows no slip, and is left out), `fused` with wheels, or `motion-capture`.
    #[arg(long, value_name = "KIND", value_parser = odometry_names())]
    pub(crate) odometry: Option<String>,
}

/// How a log of messages is read.
#[derive(Clone, Debug, Args)]
pub(crate) struct LogArgs {
    /// Which topics and fields of a log of messages (MCAP), or columns of a table (CSV), are which
    /// columns of telemetry: a file or one of `grouser`, `ros`, `foxglove`, `mines`, `enav`,
    /// `baseprod`; without it the one of these that fits, for messages, and the names of a table's
    /// columns.
    #[arg(long, value_name = "FILE|NAME")]
    pub(crate) mapping: Option<PathBuf>,
    /// The topic that is meant where several have what a mapping reads; can be repeated.
    #[arg(long = "topic", value_name = "TYPE=TOPIC", value_parser = choice)]
    pub(crate) topics: Vec<(String, String)>,
    /// The most that is unpacked of a packed log [MiB], in place of 256 and 64 for each of its own.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1 << 20))]
    pub(crate) max_unpacked_mib: Option<u64>,
    /// End with exit code 0 even where less than half of the log could be used, which is 3
    /// otherwise.
    #[arg(long)]
    pub(crate) accept_loss: bool,
}

impl TelemetryArgs {
    /// What measured ways and rotations, if that is stated.
    pub(crate) fn odometry(&self) -> Option<Odometry> {
        self.odometry.as_deref().and_then(Odometry::named)
    }

    /// The option as it was given, for a command that repeats this one.
    pub(crate) fn odometry_option(&self) -> String {
        self.odometry.as_ref().map_or_else(String::new, |kind| format!(" --odometry {kind}"))
    }
}

fn odometry_names() -> PossibleValuesParser {
    PossibleValuesParser::new(Odometry::ALL.map(|(name, ..)| name))
}

fn choice(text: &str) -> Result<(String, String), String> {
    let (what, topic) =
        text.split_once('=').ok_or_else(|| format!("'{text}' is not of the form TYPE=TOPIC"))?;
    Ok((what.trim().to_owned(), topic.trim().to_owned()))
}
