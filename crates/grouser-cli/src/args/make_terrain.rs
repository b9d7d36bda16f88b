//! Arguments of `terrain`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};
use grouser::terrain::lunar::LunarGround;

use crate::output::Format;

#[derive(Debug, Args)]
pub(crate) struct MakeTerrainArgs {
    #[command(subcommand)]
    pub(crate) command: MakeTerrainCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum MakeTerrainCommand {
    /// Lunar ground: craters by published counts, from fresh to worn, on fractal relief.
    Moon(MoonArgs),
}

#[derive(Debug, Args)]
#[command(
    after_help = "The ground is made by chance and is no place of the Moon. The origin is in its \
                  middle. With smaller cells the same seed and size give the same craters, and \
                  smaller ones as well. `map` and `route` read the file; docs/guide/terrain.md has \
                  the sources."
)]
pub(crate) struct MoonArgs {
    /// Length of a side [m], up to 20000, and 8 to 4096 cells.
    #[arg(long, value_name = "M", default_value_t = 500.0, allow_negative_numbers = true)]
    pub(crate) size_m: f64,
    /// Distance between neighbouring points [m]. The smallest craters have a diameter of four
    /// cells.
    #[arg(long, value_name = "M", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) cell_size_m: f64,
    /// What ground it is.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) ground: GroundChoice,
    /// Number of craters, over that of ground where as many form as wear away, 0 to 1.
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) crater_share: f64,
    /// Upper limit of the craters' diameters [m], up to 300.
    #[arg(long, value_name = "M", default_value_t = 100.0, allow_negative_numbers = true)]
    pub(crate) largest_crater_m: f64,
    /// Seed: the same one gives the same ground.
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Form of what is printed.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// The file to write: `.tif` for a GeoTIFF, or `.xyz` for text with x, y and z in each line.
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// Replace the file if it is there.
    #[arg(long)]
    pub(crate) force: bool,
}

/// The kinds of lunar ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum GroundChoice {
    /// A plain of lava, smooth between its craters.
    #[default]
    Mare,
    /// The older and steeper ground about the plains.
    Highlands,
}

impl From<GroundChoice> for LunarGround {
    fn from(choice: GroundChoice) -> Self {
        match choice {
            GroundChoice::Mare => Self::Mare,
            GroundChoice::Highlands => Self::Highlands,
        }
    }
}
