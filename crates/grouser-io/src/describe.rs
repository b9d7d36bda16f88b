//! The tables of each kind of document: the one place where a number of a document is declared.

mod about;
pub mod campaign;
pub mod data_set;
pub mod rover;
pub mod scenario;
pub mod soil;
pub mod uncertainty;
pub mod wheel;

use super::field::Rows;
use super::kind::Kind;

/// What a kind of document may say.
pub fn rows(kind: Kind) -> &'static dyn Rows {
    match kind {
        Kind::Soil => &soil::SOIL,
        Kind::Wheel => &wheel::WHEEL,
        Kind::Rover => &rover::ROVER,
        Kind::Scenario => &scenario::SCENARIO,
        Kind::DataSet => &data_set::DATA_SET,
        Kind::Campaign => &campaign::CAMPAIGN,
    }
}
