//! The arguments of the command line.

mod advice;
mod campaign;
mod card;
mod design;
mod documents;
mod draw;
mod export_fmu;
mod forecast;
mod groups;
mod heading;
mod import_telemetry;
mod import_urdf;
mod learn;
mod make_terrain;
mod map;
mod measurements;
mod mission;
mod new;
mod replay;
mod route;
mod serve;
mod slip_from_current;
mod telemetry;
mod terminal;
mod traverse;
mod uncertainty;
mod wheel_test;

use std::path::PathBuf;

use clap::builder::NonEmptyStringValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use grouser::answers::EVERY_MODEL;
use grouser::contact::Model;
use grouser::document::gradient::GradientKeys;

use crate::output::Format;

pub(crate) use advice::AdviceArgs;
pub(crate) use campaign::{
    CampaignArgs, CampaignCommand, CampaignCostArgs, CampaignDigestArgs, CampaignMergeArgs,
    CampaignRerunArgs, CampaignRunArgs, CampaignSummariseArgs, ExecutorChoice,
};
pub(crate) use card::{CardArgs, RuleArgs, SideChoice};
pub(crate) use design::DesignArgs;
pub(crate) use documents::{CheckArgs, CompletionsArgs, ManArgs, PresetsArgs, SchemaArgs};
pub(crate) use draw::DrawArgs;
pub(crate) use export_fmu::{DrivenBy, ExportFmuArgs};
pub(crate) use forecast::ForecastArgs;
pub(crate) use groups::grouped;
pub(crate) use heading::{HeadingArgs, HeadingMapArgs};
pub(crate) use import_telemetry::ImportTelemetryArgs;
pub(crate) use import_urdf::ImportUrdfArgs;
pub(crate) use learn::LearnArgs;
pub(crate) use make_terrain::{MakeTerrainArgs, MakeTerrainCommand, MoonArgs};
pub(crate) use map::MapArgs;
pub(crate) use measurements::{
    CalibrateArgs, ImportArgs, PlateLawChoice, SlipChoice, ValidateArgs,
};
pub(crate) use mission::MissionArgs;
pub(crate) use new::NewArgs;
pub(crate) use replay::ReplayArgs;
pub(crate) use route::RouteArgs;
pub(crate) use serve::ServeArgs;
pub(crate) use slip_from_current::SlipFromCurrentArgs;
pub(crate) use telemetry::{LogArgs, TelemetryArgs};
pub(crate) use terminal::{TerminalArgs, colours_of};
pub(crate) use traverse::TraverseArgs;
pub(crate) use uncertainty::{BeliefArgs, SamplingArgs, UncertaintyArgs};
pub(crate) use wheel_test::{StandArgs, WheelTestArgs};

/// Predicts how a wheeled rover moves on loose soil: sinkage, slip, drift, the heading that holds
/// the contour of a slope, energy.
#[derive(Debug, Parser)]
#[command(name = "grouser", version, max_term_width = groups::WIDEST, arg_required_else_help = true)]
#[command(after_help = "Start with `grouser reproduce`: the source paper's study, as a page to \
                        open in a browser. Exit codes: 0 done, 1 the run or the disk failed, 2 \
                        wrong use or a bad document, 3 some runs of a campaign failed, 130 \
                        interrupted.")]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) terminal: TerminalArgs,
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run the source paper's study and write its report.
    Reproduce(ReproduceArgs),
    /// Open the console: a page in the browser with sliders, headings, wheels and verdicts.
    Serve(ServeArgs),
    /// Drive a rover across a slope and report where it ends up.
    Traverse(TraverseArgs),
    /// Drive a rover through legs: drives, turns, arcs, waypoints, with limits at which it stops.
    Mission(MissionArgs),
    /// Forces, torque and sinkage of one wheel over load, slip ratio and slip angle.
    WheelTest(WheelTestArgs),
    /// The heading offset that holds the contour line on a slope, and the steepest slope on which
    /// one does.
    Heading(HeadingArgs),
    /// The heading offset that holds a course on a slope, over slope, course and soil.
    HeadingMap(HeadingMapArgs),
    /// Where a rover can go on a map of heights: heading, slip, power, probability of a no-go, as
    /// GeoTIFF.
    Map(MapArgs),
    /// The way over a map of heights with the least time, work or risk, driven by simulation to
    /// check it.
    Route(RouteArgs),
    /// Make an elevation model by chance: lunar ground with its craters.
    Terrain(MakeTerrainArgs),
    /// `heading`, by the name of earlier versions: the word of the source paper.
    #[command(hide = true)]
    Attitude(HeadingArgs),
    /// `heading-map`, by the name of earlier versions.
    #[command(hide = true)]
    AttitudeMap(HeadingMapArgs),
    /// The operator's card: heading, slip, drift, power and go or no-go for each slope, on one
    /// page.
    Card(CardArgs),
    /// A rover on the Moon or Mars, from a soil measured on Earth: slip, drift, heading, power,
    /// with one error budget.
    Forecast(ForecastArgs),
    /// Each wheel's slip from a log of its motor's current and speed, with its uncertainty.
    SlipFromCurrent(SlipFromCurrentArgs),
    /// What the telemetry of a drive tells of the soil: heading and slip of the next slopes, and
    /// warnings.
    Learn(LearnArgs),
    /// The telemetry of a drive beside what is predicted for it, and what the differences point to.
    Replay(ReplayArgs),
    /// Compare a wheel-soil model with measured wheel tests, or rank all models.
    Validate(ValidateArgs),
    /// Estimate soil parameters, with confidence intervals, from wheel or plate tests.
    Calibrate(CalibrateArgs),
    /// Numbers of a rover that are the best under limits: wheels, places, masses.
    Design(DesignArgs),
    /// Monte Carlo campaigns: sample uncertain inputs, run, summarise.
    Campaign(CampaignArgs),
    /// Draw the theory from the numbers of a rover: a wheel in its soil, frames, slope, loads,
    /// bulldozing.
    Draw(DrawArgs),
    /// Convert another laboratory's CSV file to the layout that `validate` reads.
    Import(ImportArgs),
    /// Convert a log of a drive, of Foxglove or ROS (MCAP) or in Parquet, to the telemetry that
    /// `learn` reads.
    ImportTelemetry(ImportTelemetryArgs),
    /// Make a rover of URDF, the format in which robots are described to ROS.
    ImportUrdf(ImportUrdfArgs),
    /// Make an FMU of a scenario or a mission, which other simulation tools load (FMI 3.0).
    ExportFmu(ExportFmuArgs),
    /// Make a rover, a wheel, a soil, a scenario or a mission of your own: asks, or takes answers by
    /// flags.
    New(NewArgs),
    /// Check documents: soils, wheels, motors, rovers, scenarios, missions, data sets, campaigns,
    /// priors, mappings.
    Check(CheckArgs),
    /// List the presets with their sources, or print one as TOML.
    Presets(PresetsArgs),
    /// Print the JSON Schema of a kind of document.
    Schema(SchemaArgs),
    /// Print a completion script for a shell.
    Completions(CompletionsArgs),
    /// Print a manual page: `grouser man heading | man -l -`.
    Man(ManArgs),
}

#[derive(Debug, Args)]
pub(crate) struct ReproduceArgs {
    /// Folder for the report; without it `reproduction/`, where an earlier report is replaced.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files of the same names in DIR.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
    /// Samples of bands, and runs for each cause of lost yaw on each slope, 2 to 10000.
    #[arg(long, value_name = "N", default_value_t = 100)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=10_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
}

/// Destination and format of the results.
#[derive(Debug, Args)]
pub(crate) struct OutputArgs {
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Also write results, figure and the resolved documents to a folder.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files of the same names in DIR.
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}

/// The answer as a slide.
#[derive(Debug, Default, Args)]
pub(crate) struct SlideArgs {
    /// Also write the answer as a slide of 16 to 9, one sentence and one picture: `.svg`, `.png` or
    /// `.pdf`.
    #[arg(long, value_name = "FILE")]
    pub(crate) slide: Option<PathBuf>,
}

/// The numbers that results are differentiated by.
#[derive(Debug, Default, Args)]
pub(crate) struct GradientArgs {
    /// Also the derivatives of all results by numbers of the documents, of the answer as they are
    /// written: `soil.friction_angle_deg,rover.wheel_unit.wheel.radius_m`, or `all`.
    #[arg(long, value_name = "KEYS", value_delimiter = ',', value_parser = NonEmptyStringValueParser::new())]
    pub(crate) gradients: Vec<String>,
}

impl GradientArgs {
    /// The keys, if any are asked for.
    pub(crate) fn keys(&self) -> Option<GradientKeys> {
        (!self.gradients.is_empty()).then(|| GradientKeys::of(&self.gradients))
    }
}

/// Whether extrapolations are accepted.
#[derive(Debug, Args)]
pub(crate) struct StrictArgs {
    /// Accept no extrapolation: a result that carries a flag of validity is an error, exit code 2.
    #[arg(long)]
    pub(crate) strict: bool,
}

/// Overrides that most commands take.
#[derive(Clone, Debug, Args)]
pub(crate) struct SettingArgs {
    /// Override a key of a document, such as `soil.cohesion_kpa=0.5`; can be repeated.
    #[arg(long = "set", value_name = "DOCUMENT.KEY=VALUE")]
    pub(crate) settings: Vec<String>,
    /// The wheel-soil model: `ishigami`, `bekker`, `small-wheel` or `rft`. Without it that of the
    /// scenario or of its soil, or else `small-wheel` where the soil leaves its wheel sinkage ratio
    /// to priors, and `ishigami` where it does not.
    #[arg(long, value_name = "NAME")]
    pub(crate) model: Option<String>,
    /// Gravity [m/s²], or `earth`, `moon`, `mars`.
    #[arg(long = "gravity-m-s2", value_name = "G", allow_hyphen_values = true)]
    pub(crate) gravity: Option<String>,
}

/// The help of `--model` in commands that take [`EVERY_MODEL`].
const MODEL_OR_ALL: &str = "The wheel-soil model: `ishigami`, `bekker`, `small-wheel` or `rft`, or \
    `all` for the results of each. Without it that of the scenario or of its soil, or else \
    `small-wheel` where the soil leaves its wheel sinkage ratio to priors, and `ishigami` where it \
    does not";

impl SettingArgs {
    /// Whether every model is asked for.
    pub(crate) fn has_every_model(&self) -> bool {
        self.model.as_deref() == Some(EVERY_MODEL)
    }

    /// The settings of each model that is asked for: these alone, or those of every model by its
    /// name.
    pub(crate) fn each_model(&self) -> Vec<Self> {
        if !self.has_every_model() {
            return vec![self.clone()];
        }
        let named = |model: Model| Self { model: Some(model.name().to_owned()), ..self.clone() };
        Model::ALL.map(named).into()
    }
}

/// The rover and the soil of a scenario.
#[derive(Debug, Args)]
pub(crate) struct PartArgs {
    /// The rover: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) rover: Option<String>,
    /// The soil: a preset or a file.
    #[arg(long, value_name = "NAME|FILE", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) soil: Option<String>,
}

/// Rover, soil and ground of a run.
#[derive(Debug, Args)]
pub(crate) struct SlopeArgs {
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Inclination of the slope [°].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    #[command(flatten)]
    pub(crate) terrain: TerrainArgs,
}

/// Ground with heights, in place of a slope.
#[derive(Debug, Args)]
pub(crate) struct TerrainArgs {
    /// A map of heights to drive on: a GeoTIFF in metres, `.npy`, or text with x, y and z in each
    /// line. Places and the yaw are then the map's: x east, y north, yaw from east to the left.
    #[arg(long, value_name = "FILE", conflicts_with = "slope_deg")]
    pub(crate) terrain: Option<String>,
    /// Where the body's centre of mass is at the start, on the map [m]; without it the map's
    /// middle.
    #[arg(long, value_name = "X", requires = "start_y_m", allow_negative_numbers = true)]
    pub(crate) start_x_m: Option<f64>,
    /// The same, to the north [m].
    #[arg(long, value_name = "Y", requires = "start_x_m", allow_negative_numbers = true)]
    pub(crate) start_y_m: Option<f64>,
}

/// The options of a run that name what is written, any of which `--force` may replace.
const WRITTEN: [&str; 5] = ["out", "animate", "mcap", "telemetry", "slide"];

/// How a run is computed, and what else is made of it.
#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// `dynamic`, or `quasi-steady`: a steady state at every instant, many times faster. Where
    /// neither is asked for it is quasi-steady over ground with heights.
    #[arg(long, value_name = "WORD")]
    pub(crate) simulation: Option<String>,
    /// Also draw what is driven: `.gif`, `.mp4` (needs ffmpeg), `.html` (with a player) or `.glb`
    /// (for Blender) for all of it, `.svg` or `.png` for its end. With --out, a name alone is a
    /// file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) animate: Option<PathBuf>,
    /// Also log the run: an MCAP file for Foxglove and Rerun, with transforms, scene, model of the
    /// rover and every number over time. With --out, a name alone is a file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) mcap: Option<PathBuf>,
    /// Also write what the rover's instruments would say of the run, with their noise and gaps: CSV
    /// that `learn` reads. With --out, a name alone is a file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) telemetry: Option<PathBuf>,
    /// A setting of these instruments, such as `roll_pitch_noise_deg=0.2`, `outliers=0.05` or
    /// `rate_hz=2`; `perfect` for none of their faults; can be repeated. docs/guide/learn.md lists
    /// the keys.
    #[arg(long = "sensor", value_name = "KEY=VALUE", requires = "telemetry")]
    pub(crate) sensors: Vec<String>,
    /// Seed of their noise.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 1,
        requires = "telemetry",
        allow_negative_numbers = true
    )]
    pub(crate) sensor_seed: u64,
}

/// How the weight acts on the wheels.
#[derive(Debug, Args)]
pub(crate) struct BalanceArgs {
    /// Load transfer between the wheels: `complete` (the default), `quasi-static` (the paper's),
    /// `quasi-static-torque` or `uniform`.
    #[arg(long, value_name = "LAW")]
    pub(crate) load_transfer: Option<String>,
    /// The wheels' own overturning and aligning moments: `neglected` or `included`; a complete load
    /// transfer includes them.
    #[arg(long, value_name = "WORD")]
    pub(crate) wheel_moments: Option<String>,
}

/// Form of results that are not rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum TableOrJson {
    /// For reading.
    #[default]
    Table,
    /// For programs: every digit.
    Json,
}
