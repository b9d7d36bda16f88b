//! A line of GeoJSON, in metres of the map: the way of a rover.

use std::path::Path;

use grouser_core::units::Vec2;

use super::syntax::{Coordinates, Feature, Geometry, Root};
use super::{bytes_of, features_in, root_of, starts_so};
use crate::error::{Fault, RasterError};
use crate::zones::places::shown;

/// Reads the line of a file: the places of its only `LineString`, which may stand by itself or in a
/// Feature or FeatureCollection. Heights in it are passed over, and so are properties.
///
/// # Errors
/// [`RasterError`] with the file's name, if it has no line, several, other geometries or invalid
/// places.
pub fn read_line_string(path: &Path) -> Result<Vec<Vec2>, RasterError> {
    let line = || decode_line_string(&bytes_of(path)?);
    line().map_err(|fault: Fault| RasterError::new(path, fault))
}

/// Reads a line as a file of GeoJSON holds it.
///
/// ```
/// use grouser_raster::zones::geojson;
///
/// let line = geojson::decode_line_string(br#"{"type": "LineString", "coordinates": [[7002, -298], [7010.5, -298]]}"#)?;
/// assert_eq!(line[1].x, 7010.5);
/// # Ok::<(), grouser_raster::Fault>(())
/// ```
///
/// # Errors
/// [`Fault`] if there is no line, several, other geometries or invalid places.
pub fn decode_line_string(bytes: &[u8]) -> Result<Vec<Vec2>, Fault> {
    if !starts_so(bytes) {
        let problem = "it does not begin with an object".to_owned();
        return Err(Fault::GeoJson { problem });
    }
    let root = root_of(bytes)?;
    let no_line = |problem: String| Fault::NoLine { problem };
    let mut features = match root.kind.as_str() {
        "FeatureCollection" | "Feature" => features_in(root)?,
        _ => vec![alone(root)],
    };
    match features.len() {
        0 => Err(no_line("it has no feature".to_owned())),
        1 => line_of(features.remove(0).geometry).map_err(no_line),
        count => Err(no_line(format!(
            "it has {count} features, and one line is one way\nhint: ogr2ogr -where CONDITION OUT.geojson IN.geojson keeps \
             one of them"
        ))),
    }
}

/// A geometry that stands by itself.
fn alone(root: Root) -> Feature {
    let geometry = Geometry { kind: root.kind, coordinates: root.coordinates };
    Feature { geometry: Some(geometry), properties: None }
}

fn line_of(geometry: Option<Geometry>) -> Result<Vec<Vec2>, String> {
    let Some(Geometry { kind, coordinates }) = geometry else {
        return Err("its feature has no geometry".to_owned());
    };
    if kind != "LineString" {
        let kind = shown(&kind);
        return Err(format!("its geometry is a {kind}: a LineString is a way"));
    }
    coordinates.list("places")?.into_iter().map(Coordinates::place).collect()
}
