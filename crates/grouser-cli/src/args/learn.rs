//! Arguments of `learn`.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};

use super::{AdviceArgs, BalanceArgs, OutputArgs, SettingArgs, SlideArgs, TelemetryArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(
    after_help = "Forces that a soil has to give in the motion that was seen narrow what its document leaves open; \
                        what no reading bears upon stays what it was. The folder of --out has the soil that was \
                        learnt, for `card`, `heading` and all other commands; killed or interrupted, the same \
                        command goes on from the last state that it kept there.\n\
                        Example:\n  grouser learn drive.csv --prior toyoura-uncertain --rover hakuto \\\n    \
                        --predict-slope-deg 10,15 --out today\n  \
                        grouser learn drive.csv --follow --follow-s 60 --format json --out today\n\
                        docs/guide/learn.md explains the telemetry, what is learnt, and how far it is to be trusted."
)]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(["out", "slide"]).multiple(true)))]
pub(crate) struct LearnArgs {
    /// Telemetry of the drive: MCAP, or a table (`telemetry/1`) of CSV, Parquet or Arrow, `-` for CSV
    /// from standard input; several files of one drive, or a folder of MCAP files. Its columns are
    /// `time_s`, and any of `roll_deg`, `pitch_deg`, `yaw_deg`, `wheel_speed_rad_s_WHEEL`,
    /// `wheel_torque_nm_WHEEL` or `motor_current_a_WHEEL`, `steering_deg_WHEEL`, `sinkage_mm_WHEEL`,
    /// `vo_dx_m`, `vo_dy_m`, `vo_dyaw_deg`, `x_m`, `y_m`; empty cells are gaps.
    #[arg(value_name = "LOG|-", required = true)]
    pub(crate) logs: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) telemetry: TelemetryArgs,
    /// What is known of the soil before the drive: a preset or a file that says how uncertain it
    /// is.
    #[arg(long, alias = "soil", value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) prior: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// A scenario's file or preset, for its rover, soil, gravity and load transfer; without it the
    /// default scenario.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// Slope of the ground where the telemetry has neither roll nor pitch [°].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    /// Slopes for which heading and slip are predicted [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "5,10,15", allow_hyphen_values = true)]
    pub(crate) predict_slope_deg: Numbers,
    /// Number of samples of predictions, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 200)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Learn from rows as they are added to the log, and print what is learnt on the way: text, or
    /// with --format json a line of JSON for each lesson, warning and prediction; until Ctrl-C, or
    /// the end of standard input.
    #[arg(long)]
    pub(crate) follow: bool,
    /// End as if by Ctrl-C once the log has not grown for so long [s].
    #[arg(long, value_name = "SECONDS", requires = "follow", value_parser = parse_seconds, allow_negative_numbers = true)]
    pub(crate) follow_s: Option<f64>,
    /// Predict no more often than this on the way [s]; warnings are printed at once.
    #[arg(long, value_name = "SECONDS", default_value = "1", requires = "follow", value_parser = parse_seconds, allow_negative_numbers = true)]
    pub(crate) every_s: f64,
    /// Make the operator's card of today beside that of yesterday, too, in the folder of --out; it
    /// takes some minutes of one core.
    #[arg(long, requires = "out")]
    pub(crate) cards: bool,
    /// Seed of the samples.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) advice: AdviceArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}

/// A time of waiting.
fn parse_seconds(text: &str) -> Result<f64, String> {
    /// A year.
    const MOST: f64 = 3.2e7;
    let number = text.parse::<f64>().ok().filter(|it| (0.0..=MOST).contains(it));
    number.ok_or_else(|| format!("it is no number from 0 to {MOST}"))
}
