//! Arguments of `mission`.

use std::path::PathBuf;

use clap::builder::{NonEmptyStringValueParser, Resettable};
use clap::{ArgGroup, Args};

use super::{OutputArgs, PartArgs, SettingArgs, StrictArgs};

#[derive(Debug, Args)]
#[command(mut_arg("force", |force| force.requires(Resettable::Reset).requires("written")))]
#[command(group(ArgGroup::new("written").args(["out", "animate", "mcap"]).multiple(true)))]
pub(crate) struct MissionArgs {
    /// A mission's file or preset: `there-and-back`.
    #[arg(value_name = "FILE|NAME", value_parser = NonEmptyStringValueParser::new())]
    pub(crate) mission: String,
    #[command(flatten)]
    pub(crate) parts: PartArgs,
    /// Inclination of the slope [°].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true)]
    pub(crate) slope_deg: Option<String>,
    /// A file with legs, which come before those of the mission: CSV or GeoJSON.
    #[arg(long, value_name = "FILE")]
    pub(crate) legs_from: Option<String>,
    /// `dynamic`, or `quasi-steady`: a steady state at every instant, many times faster.
    #[arg(long, value_name = "WORD")]
    pub(crate) simulation: Option<String>,
    /// Also draw the mission: `.gif`, `.mp4` (needs ffmpeg), `.html` (with a player) or `.glb` (for
    /// Blender) for all of it, `.svg` or `.png` for its end. With --out, a name alone is a file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) animate: Option<PathBuf>,
    /// Also log the mission: `.mcap` for Foxglove and Rerun, with what became of each leg. With --out, a
    /// name alone is a file in DIR.
    #[arg(long, value_name = "FILE")]
    pub(crate) mcap: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) setting: SettingArgs,
    #[command(flatten)]
    pub(crate) strict: StrictArgs,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
}
