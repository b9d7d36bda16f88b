//! Zones as polygons of GeoJSON (RFC 7946), in metres of the map.
//!
//! Features have a geometry, `Polygon` or `MultiPolygon`, and a property `soil`: a name or a class
//! number. Later features cover earlier ones; within a polygon, a ring in a ring is a hole. By the
//! standard, coordinates are degrees of longitude and latitude; here they are those of the map that
//! a rover drives on, as GDAL writes them with `-t_srs`.

mod crossing;
mod line;
mod syntax;

pub use line::{decode_line_string, read_line_string};

use std::io::Read;

use grouser_core::units::Vec2;

use self::syntax::{Coordinates, Feature, Geometry, Root};
use super::key::ZoneKey;
use super::map::ZoneMap;
use super::places::{PlacesSystem, is_in_degrees, shown};
use crate::error::{Fault, InnerFault};
use crate::read::start_of;
use crate::remark::Remark;
use crate::{CoordinateSystem, MapPath};

/// The largest file that is read [bytes]; polygons take some times as much memory.
pub const LARGEST_FILE: u64 = 1 << 25;

/// Whether a file that starts so is JSON.
pub(super) fn starts_so(start: &[u8]) -> bool {
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start);
    start.trim_ascii_start().first() == Some(&b'{')
}

/// Reads a file.
///
/// # Errors
/// [`Fault`] if it has no polygons with soils.
pub(super) fn read(path: MapPath<'_>) -> Result<ZoneMap, Fault> {
    decode(&bytes_of(path)?)
}

/// Reads areas, whatever their properties: all are one zone, of class 0.
///
/// # Errors
/// [`Fault`] if it has no polygons, or the edge of one crosses itself.
pub(super) fn read_areas(path: MapPath<'_>) -> Result<ZoneMap, Fault> {
    decode_areas(&bytes_of(path)?)
}

/// Compares the system that GeoJSON names with that of the map that its places are for; what is no
/// GeoJSON names none, and is for its reader to report.
///
/// Do polygons of one zone of UTM fit a map that states no system?
///
/// ```
/// use grouser_raster::CoordinateSystem;
/// use grouser_raster::zones::geojson;
///
/// let file = br#"{"type": "FeatureCollection", "features": [],
///     "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}}"#;
/// let remark = geojson::compare_system(file, &CoordinateSystem::default())?;
/// assert!(remark.expect("the map names none").to_string().contains("EPSG::32633"));
/// # Ok::<(), grouser_raster::Fault>(())
/// ```
///
/// # Errors
/// [`Fault::OtherSystem`] where both name one, and not the same.
pub fn compare_system(bytes: &[u8], map: &CoordinateSystem) -> Result<Option<Remark>, Fault> {
    let Some(root) = starts_so(bytes).then(|| root_of(bytes).ok()).flatten() else {
        return Ok(None);
    };
    PlacesSystem::of_root(&root).compare(map)
}

fn bytes_of(path: MapPath<'_>) -> Result<Vec<u8>, Fault> {
    start_of(path)?;
    let mut bytes = Vec::new();
    path.opened()?.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads what a file holds.
///
/// # Errors
/// [`Fault`] if it has no polygons with soils.
pub fn decode(bytes: &[u8]) -> Result<ZoneMap, Fault> {
    let mut polygons = Vec::new();
    let (features, system) = features_of(bytes)?;
    for (number, feature) in (1..).zip(features) {
        let fault = |flaw: InnerFault| Fault::Feature { number, flaw };
        let key = key_of(&feature).map_err(fault)?;
        for rings in polygons_of(feature.geometry).map_err(|problem| fault(problem.into()))? {
            polygons.push((key.clone(), rings));
        }
    }
    ZoneMap::of_polygons(polygons, system)
}

/// Reads areas as a file of GeoJSON holds them, whatever their properties: all are one zone, of
/// class 0.
///
/// # Errors
/// [`Fault`] if there are no polygons, or the edge of one crosses itself.
pub fn decode_areas(bytes: &[u8]) -> Result<ZoneMap, Fault> {
    let mut polygons = Vec::new();
    let (features, system) = features_of(bytes).map_err(|fault| match fault {
        Fault::NoFeatures { kind } => Fault::NoAreaFeatures { kind },
        other => other,
    })?;
    for (number, feature) in (1..).zip(features) {
        let fault = |flaw: InnerFault| Fault::Area { number, flaw };
        for rings in polygons_of(feature.geometry).map_err(|problem| fault(problem.into()))? {
            if rings.is_empty() {
                return Err(fault("a polygon of it has no ring".to_owned().into()));
            }
            rings.iter().try_for_each(|ring| check_area(ring)).map_err(fault)?;
            polygons.push((ZoneKey::Class(0), rings));
        }
    }
    if polygons.is_empty() {
        return Err(Fault::NoAreas);
    }
    ZoneMap::of_polygons(polygons, system)
}

/// Checks that a ring has an area and that its edge does not cross itself.
fn check_area(ring: &[Vec2]) -> Result<(), InnerFault> {
    /// Farther away no map has places [m].
    const FARTHEST: f64 = 1e9;
    if let Some(far) = ring.iter().find(|at| at.x.abs().max(at.y.abs()) > FARTHEST) {
        return Err(format!(
            "its corner x {:e}, y {:e} is beyond every map in metres",
            far.x, far.y
        )
        .into());
    }
    let sides = || ring.windows(2).map(|pair| pair[1] - pair[0]);
    let first = sides().find(|side| side.norm() > 0.0).unwrap_or_default();
    if ring.iter().all(|at| first.perp(&(at - ring[0])) == 0.0) {
        let problem = format!(
            "its corners lie on a line through x {}, y {}, and a line has no inside",
            ring[0].x, ring[0].y
        );
        return Err(InnerFault::with_hint(problem, |file| {
            format!(
                "ogr2ogr -dialect SQLite -sql \"SELECT ST_Buffer(geometry, METRES) FROM LAYER\" \
                 OUT.geojson {file} makes an area of it"
            )
        }));
    }
    match crossing::crossing(ring) {
        Ok(Some(at)) => Err(format!("its edge crosses itself near x {}, y {}", at.x, at.y).into()),
        Ok(None) => Ok(()),
        Err(crossing::Tangled) => Err(InnerFault::with_hint(
            "its edge runs over the same places too often to follow".to_owned(),
            |file| format!("ogr2ogr -makevalid OUT.geojson {file} untangles it"),
        )),
    }
}

/// The features of a file, and the system of their places.
fn features_of(bytes: &[u8]) -> Result<(Vec<Feature>, PlacesSystem), Fault> {
    let root = root_of(bytes)?;
    let system = PlacesSystem::of_root(&root);
    Ok((features_in(root)?, system))
}

/// The outermost object of a file in metres.
fn root_of(bytes: &[u8]) -> Result<Root, Fault> {
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(Fault::LargeGeoJson { limit: LARGEST_FILE });
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let root: Root = serde_json::from_slice(text)
        .map_err(|error| Fault::GeoJson { problem: error.to_string() })?;
    match root.system().filter(|name| is_in_degrees(name)) {
        Some(name) => Err(Fault::SystemInDegrees { name: shown(name) }),
        None => Ok(root),
    }
}

fn features_in(root: Root) -> Result<Vec<Feature>, Fault> {
    match root.kind.as_str() {
        "FeatureCollection" => Ok(root.features),
        "Feature" => Ok(vec![Feature { geometry: root.geometry, properties: root.properties }]),
        kind => Err(Fault::NoFeatures { kind: shown(kind) }),
    }
}

impl PlacesSystem {
    /// The system that a file of GeoJSON names.
    fn of_root(root: &Root) -> Self {
        Self::Named(root.system().map(shown))
    }
}

/// What a feature calls its soil.
fn key_of(feature: &Feature) -> Result<ZoneKey, InnerFault> {
    let unnamed = |problem: &str| {
        InnerFault::with_hint(problem.to_owned(), |file| {
            format!(
                "ogr2ogr -sql \"SELECT *, UNIT AS soil FROM LAYER\" OUT.geojson {file} makes it of a \
                 property UNIT"
            )
        })
    };
    match feature.properties.as_ref().and_then(|properties| properties.soil.as_ref()) {
        Some(syntax::Soil::Key(key)) => Ok(key.clone()),
        Some(syntax::Soil::Other) => {
            Err(unnamed("its property \"soil\" is neither a text nor a whole number"))
        }
        None => Err(unnamed("it has no property \"soil\"")),
    }
}

/// The rings of each polygon of a geometry.
fn polygons_of(geometry: Option<Geometry>) -> Result<Vec<Vec<Vec<Vec2>>>, String> {
    let Some(Geometry { kind, coordinates }) = geometry else {
        return Err("it has no geometry".to_owned());
    };
    let polygons = match kind.as_str() {
        "Polygon" => vec![coordinates],
        "MultiPolygon" => coordinates.list("polygons")?,
        kind => {
            let kind = shown(kind);
            return Err(format!("its geometry is a {kind}: Polygon and MultiPolygon are zones"));
        }
    };
    let rings = |polygon: Coordinates| -> Result<Vec<Vec<Vec2>>, String> {
        (1..).zip(polygon.list("rings")?).map(|(number, ring)| ring_of(number, ring)).collect()
    };
    polygons.into_iter().map(rings).collect()
}

/// The corners of a ring, each once.
fn ring_of(number: u32, ring: Coordinates) -> Result<Vec<Vec2>, String> {
    /// Places of the smallest ring, a triangle with its first corner again.
    const FEWEST: usize = 4;
    let places = ring.list("places")?;
    let mut corners =
        places.into_iter().map(Coordinates::place).collect::<Result<Vec<Vec2>, String>>()?;
    let (Some(first), Some(last)) = (corners.first(), corners.last()) else {
        return Err(format!("its ring {number} is empty"));
    };
    if first != last {
        return Err(format!(
            "its ring {number} is not closed: it begins at {}, {} and ends at {}, {}",
            first.x, first.y, last.x, last.y
        ));
    }
    if corners.len() < FEWEST {
        let count = corners.len();
        return Err(format!("its ring {number} has {count} places, and the smallest has {FEWEST}"));
    }
    corners.pop();
    Ok(corners)
}
