//! Rasters that the terrain of scenarios and missions names: how they are to be read, and what is
//! wrong with them.

use std::path::Path;

use super::describe::run::TERRAIN;
use super::describe::terrain::{BAND, CELL_SIZE, MISSING, SOUTH_WEST};
use super::document::Document;
use super::error::Problem;
use super::file::CONFINED_CELLS;
use grouser_core::units::Vec2;
use grouser_raster::{Fault, Placement, ReadOptions, RowOrder};

/// A key of the terrain, from the document.
pub(crate) fn key(of_terrain: &str) -> String {
    format!("{TERRAIN}.{of_terrain}")
}

/// What is wrong with a file, and what to do about it.
pub(crate) type Found = (Problem, Option<String>);

/// How the file is to be read.
///
/// * `within`: the folder that it has to be in
pub(crate) fn options(document: &Document, within: Option<&Path>) -> ReadOptions {
    let number = |of: &str| document.number(&key(of));
    let cell_size = number(CELL_SIZE);
    let corner = |axis: usize| number(&format!("{SOUTH_WEST}.{axis}")).unwrap_or(0.0);
    let placement = cell_size.map(|size| Placement {
        south_west: Vec2::new(corner(0), corner(1)),
        spacing: Vec2::new(size, size),
        rows: RowOrder::NorthFirst,
    });
    let band = document.get(&key(BAND)).and_then(serde_json::Value::as_u64);
    ReadOptions {
        placement,
        band: band.and_then(|band| usize::try_from(band).ok()),
        missing: number(MISSING),
        cells: within.map(|_| CONFINED_CELLS),
        ..ReadOptions::default()
    }
}

/// A fault of a file, with the keys that help.
///
/// * `what`: the file has
pub(crate) fn found(what: &str, file: &Path, fault: &Fault) -> Found {
    let own_hint = match fault {
        Fault::NotPlaced | Fault::NotReferenced => Some(
            "give `terrain.cell_size_m`, and `terrain.south_west_m` if its south-western point is \
             not the origin",
        ),
        Fault::Bands { .. } => Some("`terrain.band` says which has the heights, from 1"),
        _ => None,
    };
    if let Fault::Disk(error) = fault {
        let problem = Problem::Unreadable { kind: error.kind(), message: error.to_string() };
        return (problem, None);
    }
    let (problem, hint) = fault.in_parts(what, Some(file));
    (Problem::NoTerrain(problem), own_hint.map(str::to_owned).or(hint))
}
