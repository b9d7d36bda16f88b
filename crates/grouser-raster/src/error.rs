//! Why a file is no elevation model, and what to do about it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use grouser_core::terrain::zones::MOST_SOILS;
use grouser_core::terrain::{ElevationError, Extent, ZonesError};

use crate::advice::Warp;
use crate::remark::scale;
use crate::zones::key::{ZoneKey, listed};

/// A file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {fault}{}", file.display(), advice(fault, file))]
pub struct RasterError {
    /// The file.
    pub file: PathBuf,
    /// What is wrong with it.
    #[source]
    pub fault: Fault,
}

impl RasterError {
    pub(crate) fn new(file: &Path, fault: Fault) -> Self {
        Self { file: file.to_owned(), fault }
    }
}

/// The hint of a fault, as its error ends.
fn advice(fault: &Fault, file: &Path) -> String {
    fault.hint(Some(file)).map_or_else(String::new, |hint| format!("\nhint: {hint}"))
}

/// What is wrong inside of a file, and what helps.
#[derive(Debug)]
pub struct InnerFault {
    /// What is wrong.
    pub problem: String,
    /// Makes the sentence of what to do about it from the name of the file.
    pub hint: Option<fn(&str) -> String>,
}

impl InnerFault {
    pub(crate) fn with_hint(problem: String, hint: fn(&str) -> String) -> Self {
        Self { problem, hint: Some(hint) }
    }
}

impl From<String> for InnerFault {
    fn from(problem: String) -> Self {
        Self { problem, hint: None }
    }
}

impl fmt::Display for InnerFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.problem)
    }
}

impl Fault {
    /// What is wrong, in a sentence as [`of`](Self::of) has it, and what to do about it.
    ///
    /// * `what`: it is, such as `map`
    /// * `file`: where that is, for commands
    #[must_use]
    pub fn in_parts(&self, what: &str, file: Option<&Path>) -> (String, Option<String>) {
        (self.of(what), self.hint(file))
    }

    /// What is wrong, in a sentence about a thing that has no file's name.
    ///
    /// * `what`: it is, such as `map`
    #[must_use]
    pub fn of(&self, what: &str) -> String {
        let fault = self.to_string();
        match fault.split_once(' ') {
            Some(("its", rest)) => format!("the {what}'s {rest}"),
            Some(("is" | "has" | "cannot", _)) => format!("the {what} {fault}"),
            _ => format!("the {what}: {fault}"),
        }
    }
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The disk or its permissions.
    #[error("cannot be read: {0}")]
    Disk(#[from] io::Error),
    /// A device, or a pipe, which has no end.
    #[error("is no file, but a device or a pipe")]
    NoFile,
    /// Points whose places are longitude and latitude.
    #[error(
        "has x and y that look like degrees of longitude and latitude: its points are nearer to each other than ground is measured, and far from 0"
    )]
    PointsInDegrees,
    /// Nothing is in it.
    #[error("is empty")]
    Empty,
    /// Text without any point.
    #[error("has no points: a line of it has x, y and z in metres")]
    NoPoints,
    /// Another format.
    #[error("is none of GeoTIFF, .npy and xyz text")]
    UnknownFormat,
    /// More cells than are read.
    #[error("has {columns} × {rows} cells, and at most {limit} are read of it")]
    TooLarge {
        /// Cells in a row.
        columns: u64,
        /// Rows.
        rows: u64,
        /// The most that are read.
        limit: u64,
    },
    /// The file ends before its content does.
    #[error("its header promises {promised} bytes of heights, and the file has {found} bytes")]
    Truncated {
        /// Bytes of heights.
        promised: u64,
        /// Bytes of the file.
        found: u64,
    },
    /// The memory is not there.
    #[error("its {cells} cells need more memory than there is")]
    Memory {
        /// Cells of the grid.
        cells: usize,
    },
    /// What the decoder says.
    #[error("is damaged, or written in a way that is not read: {problem}")]
    Tiff {
        /// The decoder's words.
        problem: String,
    },
    /// A TIFF of a picture.
    #[error("has no georeference: nothing says where it lies and how large its cells are")]
    NotReferenced,
    /// Nothing says where an array lies.
    #[error(
        "has no cell size: an array of heights needs one, and the place of its south-western point"
    )]
    NotPlaced,
    /// Longitude and latitude.
    #[error("is in degrees of longitude and latitude, and a rover needs metres")]
    Degrees {
        /// What it is to be projected to.
        warp: Warp,
    },
    /// Coordinates from the centre of the body.
    #[error("has geocentric coordinates, not those of a map")]
    Geocentric,
    /// Rows that are not from west to east, or columns not from north to south.
    #[error("its rows are not level on the map: the grid is rotated, sheared or mirrored")]
    Rotated,
    /// Coordinates in feet and the like.
    #[error("its coordinates are in {unit}, and a rover needs metres")]
    Unit {
        /// The unit.
        unit: String,
    },
    /// Heights in feet and the like.
    #[error("its heights are in {unit}, and a rover needs metres")]
    HeightUnit {
        /// The unit.
        unit: String,
    },
    /// Heights that count downwards.
    #[error("its heights are depths, which count downwards")]
    Depths,
    /// A map far larger or smaller than its ground.
    #[error(
        "has {} in place of a metre of the ground at its middle: slopes and ways would be wrong by as much",
        scale(*factors)
    )]
    Scale {
        /// Metres on the map of a metre on the ground, in the direction where it is least and where
        /// it is most [-].
        factors: [f64; 2],
        /// What it is to be projected to: about its own middle.
        warp: Warp,
    },
    /// No one band was asked for.
    #[error("has {bands} bands, and one of them has the heights")]
    Bands {
        /// How many it has.
        bands: usize,
    },
    /// A band that was asked for.
    #[error("has no band {band}: it has {bands}, counted from 1")]
    NoBand {
        /// The band.
        band: usize,
        /// How many there are.
        bands: usize,
    },
    /// Cells that are no heights.
    #[error("its cells are {samples}, not heights")]
    Samples {
        /// What they are.
        samples: String,
    },
    /// An invalid header of `.npy`.
    #[error("its header is not one of .npy: {problem}")]
    NpyHeader {
        /// What is wrong with it.
        problem: String,
    },
    /// A line of text that is no point of the grid.
    #[error("line {line}: {flaw}")]
    Line {
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        flaw: InnerFault,
    },
    /// Points that do not make a grid.
    #[error(
        "{points} points fill less than a thousandth of the grid of {columns} × {rows} that they lie on"
    )]
    Sparse {
        /// How many there are.
        points: usize,
        /// Points in a row.
        columns: u64,
        /// Rows.
        rows: u64,
    },
    /// More classes or names than zones can have.
    #[error("has {zones} classes or more, and zones have at most {MOST_SOILS} soils")]
    TooManyZones {
        /// How many.
        zones: usize,
    },
    /// A cell that is no class.
    #[error("has a cell of {number} at x = {x} m, y = {y} m, and class numbers are whole")]
    NoClass {
        /// Its number.
        number: f64,
        /// To the east [m].
        x: f64,
        /// To the north [m].
        y: f64,
    },
    /// Classes without a soil.
    #[error("has zones that the legend has no soil for: {}", listed(keys))]
    NotInLegend {
        /// What the file calls them.
        keys: Vec<ZoneKey>,
    },
    /// Text that is no GeoJSON.
    #[error("is no GeoJSON: {problem}")]
    GeoJson {
        /// What is wrong with it, and where.
        problem: String,
    },
    /// A large text.
    #[error(
        "is larger than {} MiB",
        limit >> 20
    )]
    LargeGeoJson {
        /// The most that is read [bytes].
        limit: u64,
    },
    /// A geometry by itself, or something else.
    #[error(
        "is of type {kind}, and polygons with a property \"soil\" are a Feature or a \
         FeatureCollection"
    )]
    NoFeatures {
        /// Its type.
        kind: String,
    },
    /// A feature that is no zone.
    #[error("has no zone in feature {number}, counted from 1: {flaw}")]
    Feature {
        /// Which.
        number: usize,
        /// What is wrong with it.
        flaw: InnerFault,
    },
    /// A feature that is no area.
    #[error("has no area in feature {number}, counted from 1: {flaw}")]
    Area {
        /// Which.
        number: usize,
        /// What is wrong with it.
        flaw: InnerFault,
    },
    /// A geometry by itself where areas are expected, or something else.
    #[error("is of type {kind}, and areas are polygons of a Feature or a FeatureCollection")]
    NoAreaFeatures {
        /// The type in the file.
        kind: String,
    },
    /// A file without areas.
    #[error("has no polygon")]
    NoAreas,
    /// A file without a line, or with several.
    #[error("has no line to drive along: {flaw}")]
    NoLine {
        /// What is wrong with it.
        flaw: InnerFault,
    },
    /// A coordinate system of longitude and latitude.
    #[error(
        "has coordinates in degrees of longitude and latitude (its system is {name}), and a rover needs metres"
    )]
    SystemInDegrees {
        /// The system's name.
        name: String,
    },
    /// Another system than that of the map.
    #[error("has coordinates of the system {name}, and the map those of {map}")]
    OtherSystem {
        /// The system's name in the file.
        name: String,
        /// The system of the map.
        map: String,
        /// The map's system as PROJ reads it, for the command.
        target: String,
        /// Whether the file has a grid.
        is_grid: bool,
    },
    /// Numbers that are longitude and latitude.
    #[error(
        "has coordinates that look like degrees of longitude and latitude: all are within ±360 and ±90, and none is where the rover drives"
    )]
    ZonesInDegrees,
    /// Zones of another place.
    #[error(
        "has no zone on the ground: all are within x = {} to {} m, y = {} to {} m, and the heights within x = {} to {} m, y = {} to {} m",
        zones.south_west.x, zones.north_east.x, zones.south_west.y, zones.north_east.y,
        ground.south_west.x, ground.north_east.x, ground.south_west.y, ground.north_east.y
    )]
    Elsewhere {
        /// What the zones span.
        zones: Extent,
        /// What the heights span.
        ground: Extent,
    },
    /// No zones.
    #[error("{0}")]
    Zones(#[from] ZonesError),
    /// A grid without an elevation model.
    #[error("{0}")]
    Elevation(#[from] ElevationError),
}
