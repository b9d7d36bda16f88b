//! Arguments of `mission`.

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};

use super::{
    BeliefArgs, OutputArgs, RuleArgs, RunArgs, SettingArgs, SlideArgs, SlopeArgs, StrictArgs,
    WRITTEN,
};

/// The help of `--mcap`.
const LOG_OF_A_MISSION: &str = "Also log the mission: `.mcap` for Foxglove and Rerun, with what \
    became of each leg. With --out, a name alone is a file in DIR";

#[derive(Debug, Args)]
#[command(
    after_help = "The mission is driven as it is written, and quasi-steadily on samples of soil \
                        and model: how many of them complete it is what it risks. Each leg has the \
                        operator's card's advice for its course and slope."
)]
#[command(mut_arg("mcap", |mcap| mcap.help(LOG_OF_A_MISSION)))]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(WRITTEN).multiple(true)))]
pub(crate) struct MissionArgs {
    /// A mission's file or preset: `there-and-back`.
    #[arg(value_name = "FILE|NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) mission: String,
    #[command(flatten)]
    pub(crate) slope: SlopeArgs,
    /// A file with legs, which come before those of the mission: CSV or GeoJSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) legs_from: Option<String>,
    /// A file with a table [stop], as `card --stops` writes it: limits for every leg, in place of
    /// which the mission's own stand for the same numbers.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) stop_from: Option<String>,
    #[command(flatten)]
    pub(crate) run: RunArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) belief: BeliefArgs,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}
