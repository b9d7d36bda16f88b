//! Arguments of `replay`.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};

use super::{
    BalanceArgs, OutputArgs, PartArgs, SettingArgs, SlideArgs, TelemetryArgs, UncertaintyArgs,
};

#[derive(Debug, Args)]
#[command(
    after_help = "Velocities, torques and sinkages are predicted at the attitude and the wheel \
                  speeds that were read; the track and the yaw by a run from the first pose with \
                  these wheel speeds. The differences point to the soil, a speed, a slope or the \
                  mounting of a sensor, or to nothing.\n\
                  Example:\n  \
                  grouser replay drive.csv --rover hakuto --soil toyoura --out replayed\n\
                  docs/guide/replay.md explains the channels, the findings, and how far they are \
                  to be trusted."
)]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(["out", "slide"]).multiple(true)))]
pub(crate) struct ReplayArgs {
    /// Telemetry of the drive (`telemetry/1` as CSV, Parquet or Arrow, or MCAP), or `-` to read CSV
    /// from standard input; several files of one drive, or a folder of MCAP files: `time_s`,
    /// `wheel_speed_rad_s_WHEEL`, and any of the other columns that `learn` reads; empty cells are
    /// gaps.
    #[arg(value_name = "LOG|-", required = true)]
    pub(crate) logs: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) telemetry: TelemetryArgs,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// A scenario's file or preset, for its rover, soil, gravity and load transfer; without it the
    /// default scenario.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// Slope of the plane of the free run, and of the ground where the telemetry has neither roll
    /// nor pitch [°]. Without it the median of the slopes that roll and pitch give.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    /// Replay the records from this time of the log on [s], as if it had no earlier ones.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) from_s: Option<f64>,
    /// Replay the records up to this time of the log [s], as if it had no later ones.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) to_s: Option<f64>,
    /// Also log both sides, measured and predicted: an MCAP file for Foxglove and Rerun. With
    /// --out, a name alone is a file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) mcap: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}
