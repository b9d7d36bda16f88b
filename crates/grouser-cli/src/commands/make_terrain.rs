//! `grouser terrain`: elevation models made by chance.

use std::ffi::OsStr;
use std::path::Path;

use grouser::document::columns::roughness;
use grouser::document::escape;
use grouser::document::table::Table;
use grouser::terrain::lunar::{LunarModel, LunarSite};
use grouser::terrain::roughness::deviations;
use grouser_map::elevation_model;
use grouser_raster::{Raster, xyz};
use serde::Serialize;
use serde_json::json;

use super::Answer;
use crate::args::{MakeTerrainArgs, MakeTerrainCommand, MoonArgs};
use crate::failure::Failure;
use crate::output::rows::Rows;
use crate::output::{self, Format, file};

#[derive(Serialize)]
struct Results<'a> {
    points: [usize; 2],
    craters: usize,
    expected_craters: f64,
    smallest_crater_m: f64,
    coordinate_system: String,
    roughness: &'a Table,
    path: String,
}

pub(crate) fn run(args: &MakeTerrainArgs) -> Result<(), Failure> {
    match &args.command {
        MakeTerrainCommand::Moon(args) => moon(args),
    }
}

fn moon(args: &MoonArgs) -> Result<(), Failure> {
    let encoding = Encoding::of(&args.out)?;
    file::check_new(&args.out, args.force)?;
    let site = LunarSite {
        size: args.size_m,
        cell_size: args.cell_size_m,
        ground: args.ground.into(),
        crater_share: args.crater_share,
        largest_crater: args.largest_crater_m,
        seed: args.seed,
    };
    let model = site.model().map_err(|error| Failure::Usage(error.to_string()))?;
    let raster = Raster::of_moon(&model);
    file::write(&args.out, &encoding.encode(&args.out, &raster)?)?;
    report(args, &site, &model, &raster)
}

/// What the ground is like.
fn report(
    args: &MoonArgs,
    site: &LunarSite,
    model: &LunarModel,
    raster: &Raster,
) -> Result<(), Failure> {
    let deviations = roughness::table(&deviations(&model.grid, &model.heights));
    let rows = Rows::of_table(&deviations);
    let results = Results {
        points: [model.grid.columns, model.grid.rows],
        craters: model.craters.len(),
        expected_craters: site.expected_craters(),
        smallest_crater_m: site.smallest_crater(),
        coordinate_system: raster.coordinates.name(),
        roughness: &deviations,
        path: args.out.display().to_string(),
    };
    match args.format {
        Format::Table => output::show(
            rows.to_table(&roughness::names()) + &sentence(args, &results, &raster.spans()),
        ),
        Format::Csv => output::print(&rows.to_csv()?),
        Format::Json => {
            let inputs = json!({
                "size_m": site.size,
                "cell_size_m": site.cell_size,
                "ground": site.ground.name(),
                "crater_share": site.crater_share,
                "largest_crater_m": site.largest_crater,
                "seed": site.seed,
            });
            output::print_json(&Answer::new("terrain-moon", inputs, results))
        }
    }
}

/// * `spans`: the ground, in words
fn sentence(args: &MoonArgs, results: &Results<'_>, spans: &str) -> String {
    format!(
        "{} craters of {} to {} m ({:.0} by the law) in {}\n{spans}\n",
        results.craters,
        results.smallest_crater_m,
        args.largest_crater_m,
        results.expected_craters,
        escape::path(&args.out),
    )
}

/// What a file is made of.
#[derive(Clone, Copy)]
enum Encoding {
    GeoTiff,
    Xyz,
}

impl Encoding {
    /// By the end of the file's name.
    fn of(out: &Path) -> Result<Self, Failure> {
        let end = out.extension().map(OsStr::to_ascii_lowercase);
        match end.as_ref().and_then(|end| end.to_str()) {
            Some("tif" | "tiff") => Ok(Self::GeoTiff),
            Some("xyz") => Ok(Self::Xyz),
            _ => Err(Failure::Usage(format!(
                "--out {}: its name must end with .tif for a GeoTIFF, or with .xyz for text",
                escape::path(out)
            ))),
        }
    }

    fn encode(self, out: &Path, raster: &Raster) -> Result<Vec<u8>, Failure> {
        match self {
            Self::GeoTiff => Ok(elevation_model(out, raster)?),
            Self::Xyz => {
                let mut text = Vec::new();
                xyz::write(&mut text, raster).map_err(Failure::at("cannot write", out))?;
                Ok(text)
            }
        }
    }
}
