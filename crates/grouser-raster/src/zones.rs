//! Zones of soil as files: class numbers of a raster, or polygons of GeoJSON.
//!
//! A raster of any of the formats of [`read`](crate::read()) whose cells are whole numbers, or
//! [GeoJSON](geojson) whose polygons have a property `soil`. [`ZoneMap`] is what the file says; a
//! legend says which soil each number or name means.
//!
//! Which zone of a file lies at a place?
//!
//! ```
//! use grouser_core::paper;
//! use grouser_core::units::Vec2;
//! use grouser_raster::zones::{ZoneKey, geojson};
//!
//! let file = br#"{"type": "Feature", "properties": {"soil": "dune"}, "geometry":
//!     {"type": "Polygon", "coordinates": [[[0, 0], [900, 0], [900, 900], [0, 0]]]}}"#;
//! let map = geojson::decode(file)?;
//! assert_eq!(map.keys(), [ZoneKey::Name("dune".into())]);
//! let legend = [(ZoneKey::Name("dune".into()), Some(0))];
//! let zones = map.with_legend(&legend, vec![paper::toyoura()])?;
//! assert_eq!(zones.zone(Vec2::new(800.0, 100.0)), Some(0));
//! # Ok::<(), grouser_raster::Fault>(())
//! ```

mod classes;
pub mod geojson;
pub(crate) mod key;
mod map;
mod places;

pub use key::ZoneKey;
pub use map::{ZoneCounts, ZoneMap};
pub use places::{MapFrame, check_places, check_places_on};

use crate::error::{Fault, RasterError};
use crate::read::start_of;
use crate::{Content, MapPath, ReadOptions, Remark, read};

/// The names of a file's zones; none of a raster, whose zones have numbers.
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do.
pub fn zone_names<'p>(path: impl Into<MapPath<'p>>) -> Result<Vec<String>, RasterError> {
    let path = path.into();
    let names = || {
        if !geojson::starts_so(&start_of(path)?) {
            return Ok(Vec::new());
        }
        let name = |key: &ZoneKey| match key {
            ZoneKey::Name(name) => Some(name.clone()),
            ZoneKey::Class(_) => None,
        };
        Ok(geojson::read(path)?.keys().iter().filter_map(name).collect())
    };
    names().map_err(|fault: Fault| RasterError::new(path.path, fault))
}

/// Reads areas, such as those to keep out of, from GeoJSON: polygons with any properties, all of
/// them the zone of class 0; and what is to be remarked about their system.
///
/// * `ground`: the map that they are for
///
/// # Errors
/// [`RasterError`] with the file's name; also for a polygon whose edge crosses itself, for areas of
/// another system, and for areas none of which lies on the ground.
pub fn read_areas<'p>(
    path: impl Into<MapPath<'p>>,
    ground: &MapFrame<'_>,
) -> Result<(ZoneMap, Option<Remark>), RasterError> {
    let path = path.into();
    let areas = || {
        if !geojson::starts_so(&start_of(path)?) {
            let problem = "it does not begin with an object".to_owned();
            return Err(Fault::GeoJson { problem });
        }
        let map = geojson::read_areas(path)?;
        let remark = map.check_place(Some(ground))?;
        Ok((map, remark))
    };
    areas().map_err(|fault: Fault| RasterError::new(path.path, fault))
}

/// Reads zones from a file of any format, which its content tells; and what is to be remarked about
/// their system.
///
/// * `options`: of a raster
/// * `ground`: the map that the zones are for, if there is one
///
/// # Errors
/// [`RasterError`] with the file's name, and what to do; also for zones of another system than the
/// map's, and for zones none of which lies on it.
pub fn read_zones<'p>(
    path: impl Into<MapPath<'p>>,
    options: &ReadOptions,
    ground: Option<&MapFrame<'_>>,
) -> Result<(ZoneMap, Option<Remark>), RasterError> {
    let path = path.into();
    let zones = || {
        let map = if geojson::starts_so(&start_of(path)?) {
            geojson::read(path)?
        } else {
            let options = ReadOptions { content: Content::Classes, ..*options };
            classes::of(&read(path, &options).map_err(|error| error.fault)?)?
        };
        let remark = map.check_place(ground)?;
        Ok((map, remark))
    };
    zones().map_err(|fault: Fault| RasterError::new(path.path, fault))
}
