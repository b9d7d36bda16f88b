//! A column of a log over time.

use std::ops::RangeInclusive;

use super::super::columns::Quantity;
use super::super::unit::Unit;

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

pub(super) const fn column(
    quantity: Quantity,
    is_of_wheel: bool,
    doc: &'static str,
    range: RangeInclusive<f64>,
) -> LogColumn {
    LogColumn { name: quantity.name, is_of_wheel, doc, unit: quantity.unit, range }
}
