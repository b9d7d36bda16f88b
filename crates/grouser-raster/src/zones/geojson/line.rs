//! A line of GeoJSON, in metres of the map: the way of a rover.

use std::path::Path;

use grouser_core::terrain::Extent;
use grouser_core::units::Vec2;

use super::syntax::{Coordinates, Feature, Geometry, Root};
use super::{bytes_of, features_in, root_of, starts_so};
use crate::error::{Fault, InnerFault, RasterError};
use crate::remark::Remark;
use crate::zones::places::{MapFrame, PlacesSystem, check_places_on, shown};

/// Reads the line of a file: the places of its only `LineString`, which may stand by itself or in a
/// Feature or FeatureCollection. Heights in it are passed over, and so are properties. Also what is
/// to be remarked about their system.
///
/// * `map`: that the line is on
///
/// # Errors
/// [`RasterError`] with the file's name, if it has no line, several, other geometries or invalid
/// places, and for places of another system, or in degrees.
pub fn read_line_string(
    path: &Path,
    map: &MapFrame<'_>,
) -> Result<(Vec<Vec2>, Option<Remark>), RasterError> {
    let line = || {
        let (line, system) = line_in(&bytes_of(path.into())?)?;
        let remark = map.system.map_or(Ok(None), |of_map| system.compare(of_map))?;
        if let Some(places) = Extent::around(&line) {
            check_places_on(&map.extent, &places)?;
        }
        Ok((line, remark))
    };
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
    line_in(bytes).map(|(line, _)| line)
}

/// The line, and the system that its places are in.
fn line_in(bytes: &[u8]) -> Result<(Vec<Vec2>, PlacesSystem), Fault> {
    if !starts_so(bytes) {
        let problem = "it does not begin with an object".to_owned();
        return Err(Fault::GeoJson { problem });
    }
    let root = root_of(bytes)?;
    let system = PlacesSystem::of_root(&root);
    let no_line = |flaw: InnerFault| Fault::NoLine { flaw };
    let mut features = match root.kind.as_str() {
        "FeatureCollection" | "Feature" => features_in(root)?,
        _ => vec![alone(root)],
    };
    match features.len() {
        0 => Err(no_line("it has no feature".to_owned().into())),
        1 => match line_of(features.remove(0).geometry) {
            Ok(line) => Ok((line, system)),
            Err(problem) => Err(no_line(problem.into())),
        },
        count => Err(no_line(InnerFault::with_hint(
            format!("it has {count} features, and one line is one way"),
            |file| format!("ogr2ogr -where CONDITION OUT.geojson {file} keeps one of them"),
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
