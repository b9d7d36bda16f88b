//! What helps against a fault of a file, with the file's name in the commands.

use std::path::Path;

use crate::error::Fault;
use crate::length::metres_in;

impl Fault {
    /// What to do about it. Commands are those of GDAL.
    ///
    /// * `file`: which has it; commands without one are about `IN`
    #[must_use]
    pub fn hint(&self, file: Option<&Path>) -> Option<String> {
        match self {
            Self::Line { flaw, .. }
            | Self::Feature { flaw, .. }
            | Self::Area { flaw, .. }
            | Self::NoLine { flaw } => flaw.hint.map(|hint| hint(&named(file, "IN.geojson"))),
            _ => self.of_grid(&named(file, "IN.tif")).or_else(|| self.of_others(file)),
        }
    }

    /// What to do about a grid.
    ///
    /// * `input`: its name
    fn of_grid(&self, input: &str) -> Option<String> {
        let calculated = |sum: &str| {
            format!("gdal_calc.py -A {input} --outfile=OUT.tif --type=Float32 --calc=\"{sum}\"")
        };
        Some(match self {
            Self::NoPoints | Self::UnknownFormat => {
                format!(
                    "gdal_translate -of GTiff {input} OUT.tif writes a GeoTIFF of what GDAL reads"
                )
            }
            Self::TooLarge { .. } => format!(
                "cut out the area of the drive: gdal_translate -projwin WEST NORTH EAST SOUTH {input} \
                 OUT.tif"
            ),
            Self::Tiff { .. } => {
                format!("copy or download it again; gdal_translate {input} OUT.tif writes it anew")
            }
            Self::NotReferenced => format!(
                "give cell size and place, or write them into it: gdal_edit.py -a_ullr WEST NORTH \
                 EAST SOUTH {input}"
            ),
            Self::Degrees { warp } | Self::Scale { warp, .. } => warp.command(input),
            Self::Geocentric => format!("gdalwarp -t_srs PROJECTED {input} OUT.tif"),
            Self::Rotated => format!("gdalwarp -r cubic {input} OUT.tif writes it north up"),
            Self::Unit { .. } => format!(
                "gdalwarp -r cubic -t_srs \"$(gdalsrsinfo -o proj4 {input} | sed \
                 's/+units=[^ ]*/+units=m/; s/+to_meter=[^ ]*/+units=m/')\" {input} OUT.tif"
            ),
            Self::HeightUnit { unit } => calculated(&format!("A*{}", metres_in(unit))),
            Self::Depths => calculated("-A"),
            Self::Bands { .. } => {
                format!("name it, or gdal_translate -b 1 {input} OUT.tif")
            }
            Self::Samples { .. } => format!(
                "gdal_translate -ot Float32 {input} OUT.tif, if they are heights all the same"
            ),
            Self::NoClass { .. } => {
                format!("gdalwarp -r near {input} OUT.tif keeps them whole where it projects")
            }
            Self::OtherSystem { target, is_grid: true, .. } => {
                format!("gdalwarp -r near -t_srs {} {input} OUT.tif", quoted(target))
            }
            _ => return None,
        })
    }

    /// What to do about faults whose commands have no grid as input.
    fn of_others(&self, file: Option<&Path>) -> Option<String> {
        const AGAIN: &str = "copy or download it again";
        const CODE: &str = "with the code of the map's system, or of the place's UTM zone where there \
                            is no map";
        let input = named(file, "IN.geojson");
        let projected = || format!("ogr2ogr -t_srs EPSG:CODE OUT.geojson {input}, {CODE}");
        Some(match self {
            Self::NoFile => "write what comes from it to a file first".to_owned(),
            Self::PointsInDegrees => {
                "places in metres are needed, as gdalwarp -t_srs EPSG:CODE makes them of a grid"
                    .into()
            }
            Self::Empty | Self::Truncated { .. } => AGAIN.to_owned(),
            Self::NpyHeader { .. } => {
                "numpy.save(FILE, heights.astype(\"float32\")) writes it anew".to_owned()
            }
            Self::Sparse { .. } => "gdal_grid makes a grid of scattered points".to_owned(),
            Self::TooManyZones { .. } => {
                "class numbers are wanted, not heights; gdal_calc.py groups them".to_owned()
            }
            Self::LargeGeoJson { .. } => format!(
                "ogr2ogr -simplify TOLERANCE -spat WEST SOUTH EAST NORTH OUT.geojson {input}"
            ),
            Self::NoAreas => {
                "areas are features with a Polygon or a MultiPolygon, in metres of the map"
                    .to_owned()
            }
            Self::SystemInDegrees { .. } => projected(),
            Self::OtherSystem { target, is_grid: false, .. } => {
                format!("ogr2ogr -t_srs {} OUT.geojson {input}", quoted(target))
            }
            Self::ZonesInDegrees => format!(
                "{}; places in metres so near to each other have the name of their system as `crs`",
                projected()
            ),
            Self::Elsewhere { .. } => {
                "both need the same projection; gdalsrsinfo FILE shows it".to_owned()
            }
            _ => return None,
        })
    }
}

/// A system for a command.
fn quoted(system: &str) -> String {
    let is_plain = system.chars().all(|it| it.is_ascii_alphanumeric() || ":_".contains(it));
    if is_plain { system.to_owned() } else { format!("'{system}'") }
}

/// The name of a file for a command.
///
/// * `otherwise`: where there is none, or one that would need quotes, and those of shells differ
fn named(file: Option<&Path>, otherwise: &str) -> String {
    let name = file.map_or_else(String::new, |file| file.display().to_string());
    let is_plain = name.chars().all(|it| it.is_ascii_alphanumeric() || "/._-".contains(it));
    if is_plain && !name.is_empty() { name } else { otherwise.to_owned() }
}
