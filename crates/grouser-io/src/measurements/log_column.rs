//! A column of a log over time.

use std::ops::RangeInclusive;

use super::super::columns::Quantity;
use super::super::unit::Unit;
use super::dimension::Dimension;

/// A column that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct LogColumn {
    /// Its name in the header; of a wheel's column, without the wheel's.
    pub name: &'static str,
    /// Whether each wheel has one.
    pub is_of_wheel: bool,
    /// What it is.
    pub doc: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// What its values may be, in its own unit.
    pub range: RangeInclusive<f64>,
}

impl LogColumn {
    /// What the column's unit measures; text where no sensor measures it.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        match self.unit.symbol {
            "m" | "mm" => Dimension::Length,
            "°" => Dimension::Angle,
            "rad/s" => Dimension::AngularSpeed,
            "N·m" => Dimension::Moment,
            "A" => Dimension::Current,
            _ => Dimension::Text,
        }
    }

    /// Its name without the unit.
    pub(super) fn base(&self) -> &'static str {
        let units = ["_rad_s", "_deg", "_mm", "_nm", "_m", "_a"];
        units.iter().find_map(|unit| self.name.strip_suffix(unit)).unwrap_or(self.name)
    }
}

pub(super) const fn column(
    quantity: Quantity,
    is_of_wheel: bool,
    doc: &'static str,
    range: RangeInclusive<f64>,
) -> LogColumn {
    LogColumn { name: quantity.name, is_of_wheel, doc, unit: quantity.unit, range }
}
