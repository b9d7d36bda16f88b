//! Arguments of `traverse`.

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};

use super::{
    BalanceArgs, GradientArgs, MODEL_OR_ALL, OutputArgs, RunArgs, SettingArgs, SlideArgs,
    SlopeArgs, StrictArgs, UncertaintyArgs, WRITTEN,
};

#[derive(Debug, Args)]
#[command(mut_arg("model", |model| model.help(MODEL_OR_ALL)))]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(WRITTEN).multiple(true)))]
pub(crate) struct TraverseArgs {
    /// A scenario's file or preset; without it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) slope: SlopeArgs,
    /// Yaw at the start [°], positive uphill, on a map from its x axis to the left; or over the
    /// whole run, as pairs of time [s] and yaw: `[[0, 5.51], [20, 3.10]]`. A yaw of the scenario,
    /// of either kind, is then not used.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) yaw_deg: Option<String>,
    /// Length of the run [s].
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) duration_s: Option<String>,
    /// Rim speed [m/s], (r + h_g) ω, or one for each wheel: `-0.06,-0.06,0.06,0.06`.
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Option<String>,
    /// Desired speed along the contour [m/s], for the Eq. 18 drives.
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    pub(crate) ground_speed_m_s: Option<String>,
    /// What turns the wheels: `constant`, `eq18-as-printed`, `eq18` or `slip-limiting`.
    #[arg(long, value_name = "LAW")]
    pub(crate) drive: Option<String>,
    /// Reference slip ratio of the Eq. 18 drives.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) reference_slip_ratio: Option<String>,
    /// Motion at the start: `rolling` or `rest`.
    #[arg(long, value_name = "WORD")]
    pub(crate) start: Option<String>,
    #[command(flatten)]
    pub(crate) run: RunArgs,
    /// Beside it in the picture, the same rover with another yaw, as --yaw-deg takes it.
    #[arg(long, value_name = "DEG", requires = "animate", allow_hyphen_values = true)]
    pub(crate) beside_yaw_deg: Option<String>,
    #[command(flatten)]
    pub(crate) uncertainty: UncertaintyArgs,
    #[command(flatten)]
    pub(crate) gradients: GradientArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}
