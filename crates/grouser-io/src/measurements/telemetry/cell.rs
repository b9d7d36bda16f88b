//! Cells of tables, whatever their source.

use super::super::super::escape;
use super::clock::seconds_of_date;

/// A cell of a row, whatever its source.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell {
    /// Nothing was read.
    Gap,
    /// A number in the unit of its column.
    Number(f64),
    /// Something that is no number.
    Damaged,
}

impl Cell {
    /// A cell of a table of texts; NaN stands for a gap in many logs, and a date with its time of
    /// day is one in seconds since 1970.
    #[must_use]
    pub fn of_text(text: &str) -> Self {
        let text = escape::plain(text);
        if text.is_empty() {
            return Self::Gap;
        }
        let number = text.parse().ok().or_else(|| seconds_of_date(text));
        number.map_or(Self::Damaged, Self::of_number)
    }

    /// The cell in another unit, which is so many of its own.
    pub(super) fn times(self, factor: f64) -> Self {
        match self {
            Self::Number(number) => Self::Number(factor * number),
            other => other,
        }
    }

    /// A cell of a table of numbers, where NaN is a gap.
    #[must_use]
    pub fn of_number(number: f64) -> Self {
        if number.is_nan() { Self::Gap } else { Self::Number(number) }
    }
}
