//! Arguments of `slip-from-current`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::measurements::ReadArgs;
use super::{BalanceArgs, LogArgs, OutputArgs, PartArgs, SettingArgs, UncertaintyArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(
    after_help = "The current gives the torque on the wheel, and the soil the slip ratio that goes with \
                        it. Where torque hardly changes with slip the status is `ill-posed`. LOG may be what \
                        `traverse --format csv` prints for a rover with a [motor]: its slip stands beside the \
                        estimate then.\n\
                        Example:\n  grouser slip-from-current log.csv --rover rover.toml --soil toyoura \\\n    \
                        --slope-deg 8 --yaw-deg 90 --ignore load_n\n\
                        docs/guide/slip-from-current.md explains the columns, the equation and its limits."
)]
pub(crate) struct SlipFromCurrentArgs {
    /// The log: CSV with `time_s`, and `current_a` and `wheel_speed_rad_s` of each wheel, as
    /// `front-left.current_a` or in rows with the name in `wheel`. It may have `load_n`,
    /// `slip_angle_deg`, `steering_deg`, `slope_deg`, `yaw_deg`, `course_deg`, and `slip_ratio`
    /// measured by other means. Or telemetry as `learn` reads it (CSV, Parquet, Arrow, MCAP), with
    /// `motor_current_a_WHEEL`.
    #[arg(value_name = "LOG")]
    pub(crate) log: PathBuf,
    #[command(flatten)]
    pub(crate) log_args: LogArgs,
    /// A scenario's file or preset, for its rover, soil, load transfer and slope; without it the
    /// default scenario on level ground.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Slope where the log has none [°].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    /// Yaw where the log has none [°], positive uphill: 90 is straight up the slope; 0 without it.
    #[arg(long, value_name = "DEG", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) yaw_deg: Option<Numbers>,
    /// Direction of travel from the contour [°], positive uphill, where the log has neither it nor
    /// slip angles: 0 for a rover that holds the contour. Without it the rover goes where it
    /// points.
    #[arg(long, value_name = "DEG", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) course_deg: Option<Numbers>,
    /// Columns of the log that are left aside, separated by commas: `load_n,slip_angle_deg`.
    #[arg(long, value_name = "COLUMNS", value_delimiter = ',')]
    pub(crate) ignore: Vec<String>,
    /// Standard deviation of the torque that a current gives, as a share of it: 0.05 is 5 %.
    #[arg(long, value_name = "SHARE", value_parser = list::parse, default_value = "0.05", allow_hyphen_values = true)]
    pub(crate) relative_noise: Numbers,
    /// Its part that does not depend on the torque [N·m].
    #[arg(long, value_name = "NM", value_parser = list::parse, default_value = "0.005", allow_hyphen_values = true)]
    pub(crate) noise_nm: Numbers,
    /// The lowest and the highest slip ratio that are possible, -1 to 1.
    #[arg(long, value_name = "LOW,HIGH", value_parser = list::parse, default_value = "-0.2,1", allow_hyphen_values = true)]
    pub(crate) slip_ratio: Numbers,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}
