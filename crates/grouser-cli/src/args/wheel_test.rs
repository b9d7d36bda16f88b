//! Arguments of `wheel-test`.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::uncertainty::DRAWN;
use super::{GradientArgs, MODEL_OR_ALL, OutputArgs, SamplingArgs, SettingArgs, StrictArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(mut_arg("model", |model| model.help(MODEL_OR_ALL)))]
pub(crate) struct WheelTestArgs {
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), default_value = "toyoura")]
    pub(crate) soil: String,
    /// The wheel: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new(), default_value = "hakuto")]
    pub(crate) wheel: String,
    /// Loads on the wheel [N]: a list (5,10) or a range (0:20:5).
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "17", allow_hyphen_values = true)]
    pub(crate) load_n: Numbers,
    /// Slip ratios, -2 to 2: driving above 0, skid down to -1 (locked); beyond ±1 rim and hub
    /// oppose each other.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0:0.9:0.1", allow_hyphen_values = true)]
    pub(crate) slip_ratio: Numbers,
    /// Slip angles [°], -90 to 90, positive where the hub moves to the left.
    #[arg(long, value_name = "LIST", value_parser = list::parse, default_value = "0", allow_hyphen_values = true)]
    pub(crate) slip_angle_deg: Numbers,
    #[command(flatten)]
    pub(crate) gradients: GradientArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    #[command(flatten)]
    pub(crate) stand: StandArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}

/// A simulated test stand with noise.
#[derive(Debug, Args)]
pub(crate) struct StandArgs {
    /// Simulate a test stand: run each setting N times, with noise on what the stand reads.
    #[arg(long, value_name = "N", group = DRAWN)]
    pub(crate) trials: Option<usize>,
    /// Standard deviation of the simulated forces [N].
    #[arg(
        long,
        value_name = "N",
        default_value_t = 0.3,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_n: f64,
    /// Standard deviation of the simulated sinkage [mm].
    #[arg(
        long,
        value_name = "MM",
        default_value_t = 0.5,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_mm: f64,
    /// Standard deviation of the simulated torque [N·m].
    #[arg(
        long,
        value_name = "NM",
        default_value_t = 0.02,
        requires = "trials",
        allow_negative_numbers = true
    )]
    pub(crate) noise_nm: f64,
    /// Seed of the noise or of the samples: the same seed gives the same test, or the same soils
    /// and models.
    #[arg(long, default_value_t = 1, requires = DRAWN)]
    pub(crate) seed: u64,
}
