//! Arguments of `heading` and `heading-map`.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::{BalanceArgs, OutputArgs, PartArgs, SettingArgs, StrictArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
pub(crate) struct HeadingArgs {
    /// A scenario's file or preset, for its rover, soil, gravity and load transfer; without it the
    /// default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Slopes [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "5,10,15,20", allow_hyphen_values = true)]
    pub(crate) slope_deg: Numbers,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

#[derive(Debug, Args)]
#[command(after_help = "A course is a direction of travel, counted from the contour and positive \
                        uphill; course 0 is that of `heading`. A row without a result has the \
                        reason in its status.")]
pub(crate) struct HeadingMapArgs {
    /// A scenario's file or preset, for its rover, soil, gravity and load transfer; without it the
    /// default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soils, separated by commas: presets or files.
    #[arg(long, value_name = "NAMES|FILES", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Vec<String>,
    /// Slopes [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0:24:2", allow_hyphen_values = true)]
    pub(crate) slope_deg: Numbers,
    /// Courses [°], -90 to 90: 0 along the contour, positive uphill.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "-60:60:15", allow_hyphen_values = true)]
    pub(crate) course_deg: Numbers,
    /// Rim speed [m/s], for the power.
    #[arg(long, alias = "speed-m-s", value_name = "V", value_parser = list::parse, default_value = "0.06", allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Numbers,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// Sampling of an uncertain soil.
#[derive(Debug, Args)]
pub(crate) struct UncertaintyArgs {
    /// Sample soils from the soil's `[uncertainty]`, and add 95 % bands and the probability that a
    /// heading holds the contour.
    #[arg(long)]
    pub(crate) uncertainty: bool,
    /// Number of samples, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 500, requires = "uncertainty")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the samples: the same seed gives the same soils.
    #[arg(long, value_name = "S", default_value_t = 1, requires = "uncertainty")]
    #[arg(allow_negative_numbers = true)]
    pub(crate) seed: u64,
}
