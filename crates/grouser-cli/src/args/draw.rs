//! Arguments of `draw`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::{BalanceArgs, PartArgs, SettingArgs};

#[derive(Debug, Args)]
#[command(
    after_help = "Stresses are drawn as the model `ishigami` has them; the heading is that of the \
                        model of the soil or of --model. A drawing is an SVG that fits a light and \
                        a dark page."
)]
pub(crate) struct DrawArgs {
    /// A scenario's file or preset, for its rover, soil and gravity; without it the default
    /// scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Slope that the rover crosses [°].
    #[arg(long, value_name = "DEG", default_value_t = 15.0, allow_negative_numbers = true)]
    pub(crate) slope_deg: f64,
    /// Load on the drawn wheel [N]; without it an equal share of the rover's weight.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub(crate) load_n: Option<f64>,
    /// Slip ratio of the drawn wheel.
    #[arg(long, value_name = "S", default_value_t = 0.2, allow_negative_numbers = true)]
    pub(crate) slip_ratio: f64,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    /// Folder for the drawings and a page that shows them.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Replace files of the same names in DIR.
    #[arg(long)]
    pub(crate) force: bool,
}
