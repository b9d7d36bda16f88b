//! Arguments of `map`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::NonEmptyStringValueParser;

use super::{BalanceArgs, PartArgs, RuleArgs, SettingArgs, SlideArgs};
use crate::list::{self, Numbers};
use crate::output::Format;

#[derive(Debug, Args)]
#[command(
    after_help = "Writes a cloud-optimised GeoTIFF for each number, in the coordinates of DEM, a \
                  style for QGIS beside each, map.html to look at, and map.json. Stopped half-way, \
                  the same command goes on where it was. docs/guide/maps.md shows a map and \
                  explains how to read it."
)]
pub(crate) struct MapArgs {
    /// A map of heights: a GeoTIFF in metres, or text with x, y and z in each line.
    #[arg(value_name = "DEM")]
    pub(crate) dem: PathBuf,
    /// The most cells that are read of DEM; without it as many as a file of its size has, 32 for
    /// each byte and 2^24 at least, 2^28 at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(4..))]
    pub(crate) max_cells: Option<u64>,
    /// A height that stands for a missing one in DEM [m], beside those that it declares.
    #[arg(long, value_name = "Z", allow_negative_numbers = true)]
    pub(crate) missing_m: Option<f64>,
    /// A scenario's file or preset, for its rover, soil, gravity, load transfer and rim speed;
    /// without it the default scenario.
    #[arg(value_parser = NonEmptyStringValueParser::new())]
    pub(crate) scenario: Option<String>,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Direction of travel [°], -90 to 90: 0 along the contour with the hill on the left, positive
    /// uphill; or `best` or `worst`, place by place: the course that is least or most often a
    /// no-go, then the one with the least or most slip.
    #[arg(long, value_name = "DEG|best|worst", default_value = "0", allow_hyphen_values = true)]
    pub(crate) course_deg: String,
    /// Rim speed [m/s], for the power; without it the scenario's.
    #[arg(long, value_name = "V", value_parser = list::parse, allow_hyphen_values = true)]
    pub(crate) rim_speed_m_s: Option<Numbers>,
    /// Number of samples of soil and model, for the probability of a no-go, 2 to 100000.
    #[arg(long, value_name = "N", default_value_t = 200)]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=100_000), allow_negative_numbers = true)]
    pub(crate) samples: u32,
    /// Seed of the samples: the same seed gives the same soils and models.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Also write gazebo_slip.png and gazebo_slip.sdf: the slip of the soil as written, for
    /// Gazebo's LookupWheelSlip.
    #[arg(long)]
    pub(crate) gazebo: bool,
    #[command(flatten)]
    pub(crate) rule: RuleArgs,
    #[command(flatten)]
    pub(crate) balance: BalanceArgs,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// The folder for the map.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Replace files of the same names in DIR, and those of another map that was stopped there.
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) slide: SlideArgs,
}
