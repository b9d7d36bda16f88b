//! Ways as GeoJSON, in the coordinates of the map.

use grouser::document::route::RouteRecord;
use grouser_raster::CoordinateSystem;
use serde_json::{Value, json};

/// The line of a way, if it may be driven. It is the only one: a mission takes all lines of a file
/// one after the other.
///
/// * `system`: of the map
#[must_use]
pub fn way_as_geojson(way: &RouteRecord, system: &CoordinateSystem) -> String {
    let may_be_driven = way.reason.is_none();
    let feature = may_be_driven.then(|| {
        json!({
            "type": "Feature",
            "properties": {
                "minimise": way.minimise,
                "length_m": way.length_m,
                "time_s": way.time_s,
                "energy_j": way.energy_j,
            },
            "geometry": { "type": "LineString", "coordinates": way.waypoints },
        })
    });
    let features: Vec<_> = feature.into_iter().collect();
    let (system, features) = (system.geojson_member(), Value::from(features));
    format!("{{\"type\":\"FeatureCollection\",{system}\"features\":{features}}}\n")
}
