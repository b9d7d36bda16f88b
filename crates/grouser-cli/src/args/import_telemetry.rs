//! Arguments of `import-telemetry`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::TelemetryArgs;

#[derive(Debug, Args)]
#[command(
    after_help = "MCAP logs are read by a mapping: which topics and fields are which columns, with units, signs and \
                  axes. Those of Grouser, ROS and Foxglove are built in. Bags of ROS 1, and of ROS 2 in SQLite, are \
                  converted by the Python package: python -m grouser import-telemetry BAG.\n\
                  Example:\n  grouser import-telemetry drive.mcap --rover hakuto --mapping ours.toml --out drive.csv\n\
                  docs/guide/telemetry.md has the reference of mappings."
)]
pub(crate) struct ImportTelemetryArgs {
    /// The log: MCAP, Parquet, Arrow or CSV; several files of one drive, or a folder of MCAP files.
    #[arg(value_name = "LOG", required_unless_present = "print_mapping")]
    pub(crate) logs: Vec<PathBuf>,
    /// The rover that was driven: a preset or a file. Without it the rover of the default scenario.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    #[command(flatten)]
    pub(crate) telemetry: TelemetryArgs,
    /// Print a built-in mapping, to start from: `grouser`, `ros` or `foxglove`.
    #[arg(long, value_name = "NAME", conflicts_with = "logs")]
    pub(crate) print_mapping: Option<String>,
    /// The file to write, Parquet if its name ends with `.parquet`, or else CSV; without it CSV is
    /// printed.
    #[arg(long, value_name = "FILE", value_hint = clap::ValueHint::FilePath)]
    pub(crate) out: Option<PathBuf>,
    /// Replace the file if it is there.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}
