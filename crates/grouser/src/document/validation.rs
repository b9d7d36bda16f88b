//! Errors of models against measurements, as records for JSON and tables.

use serde::ser::{Serialize, SerializeMap, Serializer};

use super::columns::SLIP_ANGLE;
use super::columns::fit::{GROUP, column_of, motion};
use super::unit::Unit;
use crate::studies::measurement::Quantity;
use crate::studies::validation::{Errors, Group};

/// A group of cells with its errors. As JSON an object with an object for each quantity; null for one that was
/// not measured.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupRecord(pub Group);

impl From<&Group> for GroupRecord {
    fn from(group: &Group) -> Self {
        Self(group.clone())
    }
}

impl Serialize for GroupRecord {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        GROUP.iter().try_for_each(|column| column.write(&mut map, &self.0))?;
        for quantity in Quantity::ALL {
            map.serialize_entry(column_of(quantity).name, &self.errors(quantity))?;
        }
        map.end()
    }
}

impl GroupRecord {
    /// The slip angle of the cells, in the unit of its column; none for all of them.
    #[must_use]
    pub fn slip_angle(&self) -> Option<f64> {
        self.0.slip_angle.map(|angle| SLIP_ANGLE.unit.as_given(angle))
    }

    /// `driven`, `skid`, or `all`.
    #[must_use]
    pub fn motion(&self) -> &'static str {
        motion(self.0.driven)
    }

    /// The errors of a quantity.
    #[must_use]
    pub fn errors(&self, quantity: Quantity) -> Option<ErrorsRecord> {
        let unit = column_of(quantity).unit;
        self.0.errors[quantity].as_ref().map(|errors| ErrorsRecord::new(errors, unit))
    }
}

/// Errors of one quantity, in its column's unit.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ErrorsRecord {
    /// Root mean square error over the cells.
    pub rmse: f64,
    /// Mean error, prediction minus measurement.
    pub bias: f64,
    /// Coefficient of determination [-]; null where the measured values do not differ.
    pub r2: Option<f64>,
    /// Standard deviation between repeated trials; null without repeats.
    pub repeatability: Option<f64>,
    /// How many cells have the quantity.
    pub cells: usize,
}

impl ErrorsRecord {
    fn new(errors: &Errors, unit: Unit) -> Self {
        Self {
            rmse: unit.from_si(errors.rmse),
            bias: unit.from_si(errors.bias),
            r2: errors.r2,
            repeatability: errors.repeatability.map(|deviation| unit.from_si(deviation)),
            cells: errors.cells,
        }
    }
}
