//! Arguments of `design`.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::{OutputArgs, SettingArgs};

#[derive(Debug, Args)]
#[command(
    after_help = "The free numbers that make the aim the least, by the soil as its document has \
                        it and one model. `grouser presets design-lighter-wheels` prints a design to \
                        start from."
)]
pub(crate) struct DesignArgs {
    /// The design's file or preset (`design/1`): what is free, what is to be least, what is limited.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) design: String,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}
