//! Charts of what is met along a way.

use crate::document::columns::map::PROBABILITY_NO_GO;
use crate::document::columns::route::ALONG;
use crate::document::columns::{Quantity, SLIP_RATIO, SLOPE, Z};
use crate::document::figure::{Chart, Series, Style};
use crate::document::table::Table;
use crate::document::unit::ONE;

/// What is drawn, by its title.
const DRAWN: [(&str, Quantity); 4] = [
    ("Height of the map", Z),
    ("Slope", SLOPE),
    ("Slip ratio, median over the samples", SLIP_RATIO),
    ("Probability of a no-go", PROBABILITY_NO_GO),
];

/// What is across.
const ALONG_THE_WAY: &str = "along the way [m]";

/// A chart for each, over the way; lines break where the ground is not known.
pub(super) fn charts(profile: &Table) -> Vec<Chart> {
    let number = |value: &Option<f64>| value.unwrap_or(f64::NAN);
    let chart = |(title, quantity): (&str, Quantity)| {
        let way = profile.numbers(ALONG.name).iter().map(number);
        let points = way.zip(profile.numbers(quantity.name).iter().map(number));
        let unit = quantity.unit.symbol;
        let unit = if unit == ONE.symbol { String::new() } else { format!("[{unit}]") };
        let series = vec![Series::new("", Style::Line, 1, points)];
        Chart::new(title, (ALONG_THE_WAY, unit), series)
    };
    DRAWN.into_iter().map(chart).collect()
}
