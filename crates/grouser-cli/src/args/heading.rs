//! Arguments of `heading` and `heading-map`.

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};
use grouser::studies::heading::Steering;
use grouser::studies::wheel_speeds::USUAL_RATIO;

use super::{
    BalanceArgs, BeliefArgs, GradientArgs, MODEL_OR_ALL, OutputArgs, PartArgs, RuleArgs,
    SettingArgs, SlideArgs, StrictArgs, UncertaintyArgs,
};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(
    after_help = "The heading is the median over samples of soil and model, as on the operator's \
                        card, and each slope has the card's verdict. Steered wheels and wheels at \
                        speeds of their own are answered for the soil as its document has it."
)]
#[command(mut_arg("model", |model| model.help(MODEL_OR_ALL)))]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(["out", "slide"]).multiple(true)))]
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
    /// What holds the contour: the body's yaw (`none`), or the wheels that are steered, with the
    /// body along the contour (`crab`). The rover's document says which are steered.
    #[arg(long, value_name = "WHAT", default_value = "none", conflicts_with = "wheel_speeds")]
    #[arg(value_parser = list::one_of(Steering::ALL, Steering::name))]
    pub(crate) steering: Steering,
    /// Also let wheels turn at speeds of their own: those of each side, or of each wheel, that hold
    /// the contour with the yaw moment balanced and the least work, and the steepest slopes.
    #[arg(long)]
    pub(crate) wheel_speeds: bool,
    /// With `--wheel-speeds`: the fastest wheel's speed over the mean of all, at most; above 1.
    #[arg(long, value_name = "RATIO", default_value_t = USUAL_RATIO, requires = "wheel_speeds")]
    pub(crate) most_speed_ratio: f64,
    #[command(flatten)]
    pub(crate) gradients: GradientArgs,
    #[command(flatten)]
    pub(crate) belief: BeliefArgs,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
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

#[derive(Debug, Args)]
#[command(after_help = "A course is a direction of travel, counted from the contour and positive \
                        uphill; course 0 is that of `heading`. A row without a result has the \
                        reason in its status.")]
#[command(mut_arg("model", |model| model.help(MODEL_OR_ALL)))]
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
    #[arg(long, value_name = "V", value_parser = list::parse, default_value = "0.06", allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Numbers,
    #[command(flatten)]
    pub(crate) gradients: GradientArgs,
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
