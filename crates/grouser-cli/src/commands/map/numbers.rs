//! Names of bands, and how exact their numbers are.

use grouser::document::columns::map::HEADING;
use grouser::document::columns::{POWER, SINKAGE, SLIP_RATIO, YAW};
use grouser::studies::mobility::MobilityMap;
use grouser_map::MapColumn;
use serde_json::{Value, json};

/// What a band is called in pictures and styles.
pub(super) fn label(band: &MapColumn) -> String {
    let words = grouser::document::columns::quantity(band.name, band.unit).label();
    match band.unit.symbol {
        "" | "-" => words,
        unit => format!("{words} [{unit}]"),
    }
}

/// How far numbers of the map are from those of `heading-map` on the same slope, at most.
pub(super) fn errors(map: &MobilityMap) -> Value {
    let errors = map.largest_errors();
    json!({
        (HEADING.name): YAW.unit.from_si(errors.crab),
        (SLIP_RATIO.name): errors.slip_ratio,
        (POWER.name): errors.power,
        (SINKAGE.name): SINKAGE.unit.from_si(errors.sinkage),
    })
}
