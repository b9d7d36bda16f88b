//! Why a file is no elevation model, and what to do about it.

use std::io;
use std::path::{Path, PathBuf};

use grouser_core::terrain::zones::MOST_SOILS;
use grouser_core::terrain::{ElevationError, Extent, ZonesError};

use crate::length::metres_in;
use crate::remark::scale;
use crate::zones::key::{ZoneKey, listed};

/// A file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: {}", file.display(), of_file(fault, file))]
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

/// What is wrong, with the file's name in the command of the hint.
fn of_file(fault: &Fault, file: &Path) -> String {
    let (fault, name) = (fault.to_string(), file.display().to_string());
    // Other names would need quotes, and those of shells differ.
    let is_plain = name.chars().all(|it| it.is_ascii_alphanumeric() || "/._-".contains(it));
    if !is_plain {
        return fault;
    }
    ["IN.tif", "IN.geojson"].into_iter().fold(fault, |text, of| text.replace(of, &name))
}

impl Fault {
    /// What is wrong, in a sentence as [`of`](Self::of) has it, and what to do about it.
    ///
    /// * `what`: it is, such as `map`
    #[must_use]
    pub fn in_parts(&self, what: &str) -> (String, Option<String>) {
        let fault = self.of(what);
        match fault.split_once("\nhint: ") {
            Some((sentence, hint)) => (sentence.to_owned(), Some(hint.to_owned())),
            None => (fault, None),
        }
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

/// What is wrong with a file. Commands are those of GDAL.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The disk or its permissions.
    #[error("cannot be read: {0}")]
    Disk(#[from] io::Error),
    /// A device, or a pipe, which has no end.
    #[error("is no file, but a device or a pipe\nhint: write what comes from it to a file first")]
    NoFile,
    /// Points whose places are longitude and latitude.
    #[error(
        "has x and y that look like degrees of longitude and latitude: all points lie within a metre, and a hundred times as far from 0\nhint: places in metres are needed, as gdalwarp -t_srs EPSG:CODE makes them of a grid"
    )]
    PointsInDegrees,
    /// Nothing is in it.
    #[error("is empty\nhint: copy or download it again")]
    Empty,
    /// Text without any point.
    #[error(
        "has no points: a line of it has x, y and z in metres\nhint: gdal_translate -of GTiff IN OUT.tif writes a GeoTIFF of what GDAL reads"
    )]
    NoPoints,
    /// Another format.
    #[error(
        "is none of GeoTIFF, .npy and xyz text\nhint: gdal_translate -of GTiff IN OUT.tif writes a GeoTIFF of what GDAL reads"
    )]
    UnknownFormat,
    /// More cells than are read.
    #[error(
        "has {columns} × {rows} cells, and at most {limit} are read of it\nhint: cut out the area of the drive: gdal_translate -projwin WEST NORTH EAST SOUTH IN OUT.tif"
    )]
    TooLarge {
        /// Cells in a row.
        columns: u64,
        /// Rows.
        rows: u64,
        /// The most that are read.
        limit: u64,
    },
    /// The file ends before its content does.
    #[error(
        "its header promises {promised} bytes of heights, and the file has {found} bytes\nhint: copy or download it again"
    )]
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
    #[error(
        "is damaged, or written in a way that is not read: {problem}\nhint: copy or download it again; gdal_translate IN.tif OUT.tif writes it anew"
    )]
    Tiff {
        /// The decoder's words.
        problem: String,
    },
    /// A TIFF of a picture.
    #[error(
        "has no georeference: nothing says where it lies and how large its cells are\nhint: give cell size and place, or write them into it: gdal_edit.py -a_ullr WEST NORTH EAST SOUTH FILE.tif"
    )]
    NotReferenced,
    /// Nothing says where an array lies.
    #[error(
        "has no cell size: an array of heights needs one, and the place of its south-western point"
    )]
    NotPlaced,
    /// Longitude and latitude.
    #[error("is in degrees of longitude and latitude, and a rover needs metres\nhint: {command}")]
    Degrees {
        /// The command that projects it.
        command: String,
    },
    /// Coordinates from the centre of the body.
    #[error(
        "has geocentric coordinates, not those of a map\nhint: gdalwarp -t_srs PROJECTED IN.tif OUT.tif"
    )]
    Geocentric,
    /// Rows that are not from west to east, or columns not from north to south.
    #[error(
        "its rows are not level on the map: the grid is rotated, sheared or mirrored\nhint: gdalwarp -r cubic IN.tif OUT.tif writes it north up"
    )]
    Rotated,
    /// Coordinates in feet and the like.
    #[error(
        "its coordinates are in {unit}, and a rover needs metres\nhint: gdalwarp -r cubic -t_srs \"$(gdalsrsinfo -o proj4 IN.tif | sed 's/+units=[^ ]*/+units=m/; s/+to_meter=[^ ]*/+units=m/')\" IN.tif OUT.tif"
    )]
    Unit {
        /// The unit.
        unit: String,
    },
    /// Heights in feet and the like.
    #[error(
        "its heights are in {unit}, and a rover needs metres\nhint: gdal_calc.py -A IN.tif --outfile=OUT.tif --type=Float32 --calc=\"A*{}\"",
        metres_in(unit)
    )]
    HeightUnit {
        /// The unit.
        unit: String,
    },
    /// Heights that count downwards.
    #[error(
        "its heights are depths, which count downwards\nhint: gdal_calc.py -A IN.tif --outfile=OUT.tif --type=Float32 --calc=\"-A\""
    )]
    Depths,
    /// A map far larger or smaller than its ground.
    #[error(
        "has {} in place of a metre of the ground at its middle: slopes and ways would be wrong by as much\nhint: {command}",
        scale(*factors)
    )]
    Scale {
        /// Metres on the map of a metre on the ground, in the direction where it is least and where
        /// it is most [-].
        factors: [f64; 2],
        /// The command that projects it about its own middle.
        command: String,
    },
    /// No one band was asked for.
    #[error(
        "has {bands} bands, and one of them has the heights\nhint: name it, or gdal_translate -b 1 IN.tif OUT.tif"
    )]
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
    #[error(
        "its cells are {samples}, not heights\nhint: gdal_translate -ot Float32 IN.tif OUT.tif, if they are heights all the same"
    )]
    Samples {
        /// What they are.
        samples: String,
    },
    /// An invalid header of `.npy`.
    #[error(
        "its header is not one of .npy: {problem}\nhint: numpy.save(FILE, heights.astype(\"float32\")) writes it anew"
    )]
    NpyHeader {
        /// What is wrong with it.
        problem: String,
    },
    /// A line of text that is no point of the grid.
    #[error("line {line}: {problem}")]
    Line {
        /// Its number, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// Points that do not make a grid.
    #[error(
        "{points} points fill less than a thousandth of the grid of {columns} × {rows} that they lie on\nhint: gdal_grid makes a grid of scattered points"
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
    #[error(
        "has {zones} classes or more, and zones have at most {MOST_SOILS} soils\nhint: class numbers are wanted, not heights; gdal_calc.py groups them"
    )]
    TooManyZones {
        /// How many.
        zones: usize,
    },
    /// A cell that is no class.
    #[error(
        "has a cell of {number} at x = {x} m, y = {y} m, and class numbers are whole\nhint: gdalwarp -r near IN.tif OUT.tif keeps them whole where it projects"
    )]
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
        "is larger than {} MiB\nhint: ogr2ogr -simplify TOLERANCE -spat WEST SOUTH EAST NORTH OUT.geojson IN.geojson",
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
    #[error("has no zone in feature {number}, counted from 1: {problem}")]
    Feature {
        /// Which.
        number: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// A feature that is no area.
    #[error("has no area in feature {number}, counted from 1: {problem}")]
    Area {
        /// Which.
        number: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// A geometry by itself where areas are expected, or something else.
    #[error("is of type {kind}, and areas are polygons of a Feature or a FeatureCollection")]
    NoAreaFeatures {
        /// The type in the file.
        kind: String,
    },
    /// A file without areas.
    #[error(
        "has no polygon\nhint: areas are features with a Polygon or a MultiPolygon, in metres of the map"
    )]
    NoAreas,
    /// A file without a line, or with several.
    #[error("has no line to drive along: {problem}")]
    NoLine {
        /// What is wrong with it.
        problem: String,
    },
    /// A coordinate system of longitude and latitude.
    #[error(
        "has coordinates in degrees of longitude and latitude (its system is {name}), and a rover needs metres\nhint: ogr2ogr -t_srs EPSG:CODE OUT.geojson IN.geojson, with the code of the map's system, or of the place's UTM zone where there is no map"
    )]
    SystemInDegrees {
        /// The system's name.
        name: String,
    },
    /// Another system than that of the map.
    #[error(
        "has coordinates of the system {name}, and the map those of {map}\nhint: ogr2ogr -t_srs {map} OUT.geojson IN.geojson"
    )]
    OtherSystem {
        /// The system's name in the file.
        name: String,
        /// The system of the map.
        map: String,
    },
    /// Numbers that are longitude and latitude.
    #[error(
        "has coordinates that look like degrees of longitude and latitude: all are within ±360 and ±90, and none is where the rover drives\nhint: ogr2ogr -t_srs EPSG:CODE OUT.geojson IN.geojson, with the code of the map's system, or of the place's UTM zone where there is no map; places in metres so near to each other have the name of their system as `crs`"
    )]
    ZonesInDegrees,
    /// Zones of another place.
    #[error(
        "has no zone on the ground: all are within x = {} to {} m, y = {} to {} m, and the heights within x = {} to {} m, y = {} to {} m\nhint: both need the same projection; gdalsrsinfo FILE shows it",
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
