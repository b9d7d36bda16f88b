//! Arguments of `card`.

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{ArgGroup, Args, Command, FromArgMatches as _, ValueEnum};

use super::measurements::ReadArgs;
use super::{BalanceArgs, PartArgs, SettingArgs, StrictArgs};
use crate::list::{self, Numbers};
use crate::output::Format;

#[derive(Debug, Args)]
#[command(
    after_help = "Soil and wheel-soil model are sampled N times, and every number has a 95 % \
                        band. Where the soil's uncertainty is not stated, or one --model is asked \
                        for, it is sampled in the other alone; without the soil's, nobody can tell \
                        whether a slope is a go. docs/guide/card.md shows a card and explains how to read it."
)]
#[command(group(ArgGroup::new("written").args(["stops", "out"]).multiple(true)))]
pub(crate) struct CardArgs {
    /// A scenario's file or preset, for its rover, soil, gravity, load transfer and rim speed;
    /// without it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// The side of the rover that is uphill. On a rover that is its own mirror image it does not
    /// matter.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) uphill: SideChoice,
    /// Rim speed [m/s], for the power; without it the scenario's.
    #[arg(long, value_name = "V", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Option<Numbers>,
    /// Number of samples, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = Self::SAMPLES)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the samples: the same seed gives the same soils and models.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// The rover holds its heading by itself: its nose does not fall, and nobody sets it again.
    #[arg(long)]
    pub(crate) holds_heading: bool,
    /// Take a soil whose document says that what was learnt contradicts itself, which is refused
    /// otherwise.
    #[arg(long)]
    pub(crate) accept_contradiction: bool,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
    /// Drive this many other soils by the card, in time and with the complete loads, 1 to 100000:
    /// one driver corrects as it says, one after twice the way. The table is then of the drives.
    #[arg(long, value_name = "N", conflicts_with = "measured", allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) drives: Option<u32>,
    /// Compare with measured yaws (CSV): a column `slope_deg`, and others that end in `yaw_deg`.
    /// The table is then the comparison, and the card shows them as crosses.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) measured: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) read: ReadArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Write the card: a file that ends in .html, .pdf, .png or .svg (pictures have a second file
    /// for the second page, as in card-2.svg), or a folder for all of them with the numbers and the
    /// resolved documents.
    #[arg(long, value_name = "FILE|DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Also write the limits at which to turn back, for all slopes that are a go or a caution, as
    /// the table [stop] of a mission: `mission --stop-from` reads it.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) stops: Option<PathBuf>,
    /// The slope that the mission is on [°]: the limit of the slip is that of this slope. Without it
    /// the lowest of all slopes stands, which a rover on a steep one passes as a rule.
    #[arg(long, value_name = "DEG", requires = "stops")]
    pub(crate) stops_slope_deg: Option<f64>,
    /// Replace these files, or files of the same names in that folder.
    #[arg(long, requires = "written")]
    pub(crate) force: bool,
}

impl CardArgs {
    /// The samples of a card, and of what is shown to others.
    pub(crate) const SAMPLES: u32 = 200;

    /// Those of a command line without flags.
    pub(crate) fn usual() -> Self {
        let command = Self::augment_args(Command::new("card"));
        let matches = command.get_matches_from(["card"]);
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }
}

/// Limits of go and no-go.
#[derive(Debug, Args)]
pub(crate) struct RuleArgs {
    /// Go: a heading holds the course and slips at most this much ...
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.3", allow_hyphen_values = true)]
    pub(crate) go_slip_ratio: Numbers,
    /// ... on at least this share of the samples ...
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.95", allow_hyphen_values = true)]
    pub(crate) go_probability: Numbers,
    /// ... and in 97.5 % of them the rover drifts off its course by at most this [m/m].
    #[arg(long, value_name = "D", value_parser = list::parse, default_value = "0.1", allow_hyphen_values = true)]
    pub(crate) go_drift_m_per_m: Numbers,
    /// No-go: no heading holds the course, or it slips more than this ...
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.6", allow_hyphen_values = true)]
    pub(crate) no_go_slip_ratio: Numbers,
    /// ... on at least this share of the samples; or the rover gets stuck on as many.
    #[arg(long, value_name = "P", value_parser = list::parse, default_value = "0.2", allow_hyphen_values = true)]
    pub(crate) no_go_probability: Numbers,
}

/// A side of the rover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum SideChoice {
    /// Uphill is on the left.
    #[default]
    Left,
    /// Uphill is on the right.
    Right,
}
