//! The tables of each kind of document: the one place where a number of a document is declared.

mod about;
pub(crate) mod campaign;
pub(crate) mod data_set;
pub(crate) mod data_sheet;
pub(crate) mod design;
mod differences;
pub(crate) mod mission;
pub(crate) mod power;
pub(crate) mod prior;
pub(crate) mod rover;
pub(crate) mod run;
pub(crate) mod scenario;
pub(crate) mod soil;
pub(crate) mod telemetry_mapping;
pub(crate) mod terrain;
pub(crate) mod uncertainty;
pub(crate) mod wheel;
pub(crate) mod zones;

use super::field::Rows;
use super::kind::Kind;

/// The table of a kind of document.
pub(crate) fn rows(kind: Kind) -> &'static dyn Rows {
    match kind {
        Kind::Soil => &soil::SOIL,
        Kind::Wheel => &wheel::WHEEL,
        Kind::Motor => &power::MOTOR,
        Kind::Rover => &rover::ROVER,
        Kind::Scenario => &scenario::SCENARIO,
        Kind::Mission => &mission::MISSION,
        Kind::DataSet => &data_set::DATA_SET,
        Kind::Campaign => &campaign::CAMPAIGN,
        Kind::Design => &design::DESIGN,
        Kind::Prior => &prior::PRIORS,
        Kind::TelemetryMapping => &telemetry_mapping::TELEMETRY_MAPPING,
    }
}
