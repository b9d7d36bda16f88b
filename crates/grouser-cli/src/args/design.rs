//! Arguments of `design`.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;
use grouser::document::design::Measure;

use super::{BalanceArgs, MODEL_OR_ALL, OutputArgs, SettingArgs, StrictArgs};
use crate::list;

#[derive(Debug, Args)]
#[command(
    after_help = "Where the soil is uncertain, limits are kept with the document's probability, by \
                        samples of soil and model. `grouser presets design-lighter-wheels` prints a \
                        design to start from."
)]
#[command(mut_arg("model", |model| model.help(MODEL_OR_ALL)))]
pub(crate) struct DesignArgs {
    /// The design's file or preset (`design/1`): what is free, what is to be least, what is limited.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) design: String,
    /// Also the designs between the best of one measure and the best of another: the least, or the
    /// steepest slope.
    #[arg(long, value_name = "MEASURE,MEASURE", value_delimiter = ',', num_args = 1)]
    #[arg(value_parser = list::one_of(Measure::ALL, Measure::name))]
    pub(crate) trade: Vec<Measure>,
    /// Take soils as their documents have them, and one model, without samples.
    #[arg(long, conflicts_with = "seed")]
    pub(crate) nominal: bool,
    /// Seed of the samples: the same seed gives the same soils and models. Without it 1.
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub(crate) seed: Option<u64>,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}
