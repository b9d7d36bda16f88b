//! Arguments of `route`.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};
use grouser::studies::route::Objective;

use super::{BalanceArgs, OutputArgs, PartArgs, RuleArgs, SettingArgs, SlideArgs};
use crate::list::{self, Numbers};

#[derive(Debug, Args)]
#[command(
    after_help = "Ways lead over the points of DEM in sixteen directions, and turns are made on \
                  the spot. The way is then driven by simulation, so that predicted and simulated \
                  time, work and slip stand side by side. With --out there is route.geojson, whose \
                  legs `mission --terrain DEM --legs-from` drives. With --along the numbers are \
                  those of a given line, and each stretch of it that is not safe is named. \
                  docs/guide/maps.md explains the numbers."
)]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(["out", "slide"]).multiple(true)))]
pub(crate) struct RouteArgs {
    /// A map of heights: a GeoTIFF in metres, or text with x, y and z in each line.
    #[arg(value_name = "DEM")]
    pub(crate) dem: PathBuf,
    /// A scenario's file or preset, for its rover, soil, gravity, load transfer and rim speed;
    /// without it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    /// The most cells that are read of DEM; without it as many as a file of its size has, 32 for
    /// each byte and 2^24 at least, 2^28 at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(4..))]
    pub(crate) max_cells: Option<u64>,
    /// A height that stands for a missing one in DEM [m], beside those that it declares.
    #[arg(long, value_name = "Z", allow_negative_numbers = true)]
    pub(crate) missing_m: Option<f64>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Where the way begins, in the map's coordinates [m].
    #[arg(long, value_name = "X,Y", value_parser = list::parse, allow_hyphen_values = true)]
    #[arg(required_unless_present = "along")]
    pub(crate) from: Option<Numbers>,
    /// Where it ends [m].
    #[arg(long, value_name = "X,Y", value_parser = list::parse, allow_hyphen_values = true)]
    #[arg(required_unless_present = "along")]
    pub(crate) to: Option<Numbers>,
    /// Check this way instead of seeking one: a LineString of GeoJSON, in metres of the map, such
    /// as a route.geojson.
    #[arg(long, value_name = "FILE.geojson")]
    #[arg(conflicts_with_all = ["from", "to", "minimise", "alternatives"])]
    pub(crate) along: Option<PathBuf>,
    /// What the way has least of: time, energy, or time in the worst tenth of the samples. Energy is
    /// what the motors draw; where none is known, the work of the wheels.
    #[arg(long, value_name = "WHAT", default_value = "time")]
    #[arg(value_parser = list::one_of(Objective::ALL, Objective::name))]
    pub(crate) minimise: Objective,
    /// Yaw at the start [°], from the map's x axis to the left; without it the first turn is free.
    #[arg(long, value_name = "DEG", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) yaw_deg: Option<Numbers>,
    /// Where nobody may go: polygons of GeoJSON, in metres of the map.
    #[arg(long, value_name = "FILE.geojson")]
    pub(crate) keep_out: Option<PathBuf>,
    /// The steepest slope of the way [°].
    #[arg(long, value_name = "DEG", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) most_slope_deg: Option<Numbers>,
    /// The largest slip ratio of the way; without it that of a no-go.
    #[arg(long, value_name = "S", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) most_slip_ratio: Option<Numbers>,
    /// In which share of the samples a place of the way may be a no-go; without it as many as a
    /// no-go allows.
    #[arg(long, value_name = "P", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) most_no_go: Option<Numbers>,
    /// Also seek the ways that have least of the other two.
    #[arg(long)]
    pub(crate) alternatives: bool,
    /// Leave out the simulation of the way.
    #[arg(long)]
    pub(crate) no_drive: bool,
    /// Rim speed [m/s]; without it the scenario's.
    #[arg(long, value_name = "V", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Option<Numbers>,
    /// Number of samples of soil and model, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 50)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the samples: the same seed gives the same soils and models.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}
