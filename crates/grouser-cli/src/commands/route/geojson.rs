//! Ways as GeoJSON, in the coordinates of the map.

use grouser::studies::route::Answer as Found;
use serde_json::json;

use super::Way;

/// A line for each way that was found, the one that was asked for first.
pub(super) fn text(ways: &[Way]) -> String {
    let feature = |way: &Way| {
        let Found::Route(route) = &way.found else { return None };
        let coordinates: Vec<[f64; 2]> = route.waypoints.iter().map(|it| [it.x, it.y]).collect();
        Some(json!({
            "type": "Feature",
            "properties": {
                "minimise": way.objective.name(),
                "length_m": route.length,
                "time_s": route.time,
                "energy_j": route.energy,
            },
            "geometry": { "type": "LineString", "coordinates": coordinates },
        }))
    };
    // A mission takes all lines of a file one after the other: the first way is the route.
    let features: Vec<_> = ways.iter().take(1).filter_map(feature).collect();
    json!({ "type": "FeatureCollection", "features": features }).to_string() + "\n"
}
