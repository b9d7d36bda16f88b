//! Arguments of `forecast`.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::{BalanceArgs, OutputArgs, PartArgs, StrictArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(
    after_help = "Each ground has rows of its own, the same as if it alone were asked for, and \
                        nothing is averaged over grounds. Within a ground every choice meets every \
                        other, every wheel-soil model, every sample of the soil and every sample of \
                        what a model gets wrong; choices of one kind count alike. The error budget \
                        says which of them the spread is due to. Moduli that are kept (`bekker`) \
                        under another gravity have rows apart: no measurement supports them. \
                        docs/guide/forecast.md explains the choices and the budget."
)]
pub(crate) struct ForecastArgs {
    /// A scenario's file or preset, for its rover, soil, load transfer and rim speed; without it
    /// the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// The site: `earth`, `moon`, `mars`, or its gravity [m/s²].
    #[arg(long, value_name = "NAME|G", allow_hyphen_values = true)]
    pub(crate) site: String,
    /// Slopes [°]: a list (5,10) or a range (0:20:2.5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "5,10,15,20", allow_hyphen_values = true)]
    pub(crate) slope_deg: Numbers,
    /// How moduli scale with gravity, separated by commas: `reece` (frictional parts with the unit
    /// weight), `bekker` (constants kept), `granular-scaling` (every stress with gravity).
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "reece,bekker,granular-scaling"
    )]
    pub(crate) scaling: Vec<String>,
    /// Whose cohesion, friction angle and density the ground of the site has, separated by commas:
    /// `as-measured`, or soils by preset or file. Without it `as-measured`, and on the Moon
    /// `lunar-nominal` and `lunar-0-15-cm`.
    #[arg(long, value_name = "NAMES|FILES", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) ground: Vec<String>,
    /// The rover's mass, separated by commas: `equal-mass` (that of its document), `equal-weight`
    /// (the document is a test rover, lightened to the weight at the site), or NAME=FACTOR.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "equal-mass")]
    pub(crate) mass: Vec<String>,
    /// Gravity under which the soil was measured [m/s²], or `earth`, `moon`, `mars`; without it
    /// that of the soil's domain, or else the Earth's.
    #[arg(long = "measured-gravity-m-s2", value_name = "G", allow_hyphen_values = true)]
    pub(crate) measured_gravity: Option<String>,
    /// Rim speed [m/s], for the power; without it the scenario's.
    #[arg(long, value_name = "V", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Option<Numbers>,
    /// Slip ratio of which to say how probably it is exceeded.
    #[arg(long, value_name = "S", value_parser = list::parse, default_value = "0.6", allow_hyphen_values = true)]
    pub(crate) no_go_slip_ratio: Numbers,
    /// Number of samples of the soil, 2 to 10000.
    #[arg(long, value_name = "N", default_value_t = 12)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=10_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Number of samples of what a model gets wrong, 2 to 1000; each meets each sample of the soil.
    #[arg(long, value_name = "N", default_value_t = 4)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=1000), allow_negative_numbers = true)]
    pub(crate) discrepancies: u32,
    /// Seed of the samples: the same seed gives the same soils.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Override a key of a document, such as `soil.cohesion_kpa=0.5`; can be repeated.
    #[arg(long = "set", value_name = "DOCUMENT.KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// The wheel-soil model: `ishigami`, `bekker`, `small-wheel` or `rft`. Without it that of the
    /// scenario, or else all models by their shares.
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}
