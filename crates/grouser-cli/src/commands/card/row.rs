//! A row of the card, as the page reads it.

use grouser::document::columns::verdict::VERDICT;
use grouser::document::columns::{Quantity, SLOPE, YAW};
use grouser::document::table::Table;
use grouser::studies::verdict::Verdict;

/// A slope of the card.
#[derive(Clone, Copy)]
pub(super) struct CardRow<'a> {
    table: &'a Table,
    place: usize,
}

impl<'a> CardRow<'a> {
    /// The rows of a card.
    pub(super) fn all(table: &'a Table) -> impl Iterator<Item = Self> {
        (0..table.rows()).map(move |place| Self { table, place })
    }

    /// A number of the soil as written, or of all samples.
    pub(super) fn number(self, quantity: Quantity) -> Option<f64> {
        self.named(quantity.name)
    }

    pub(super) fn named(self, name: &str) -> Option<f64> {
        self.table.numbers(name).get(self.place).copied().flatten()
    }

    /// Its slope, as the card writes it.
    pub(super) fn slope(self) -> f64 {
        self.number(SLOPE).unwrap_or_default()
    }

    /// `go`, `caution`, `cannot_tell` or `no_go`.
    pub(super) fn verdict(self) -> &'a str {
        self.table.texts(VERDICT)[self.place].as_deref().unwrap_or_default()
    }

    /// Whether it is not to be driven.
    pub(super) fn is_no_go(self) -> bool {
        self.verdict() == Verdict::NoGo.name()
    }

    /// The card's heading [°].
    pub(super) fn heading(self) -> Option<f64> {
        self.number(YAW)
    }

    /// Low, median and high end of a band.
    pub(super) fn band(self, quantity: Quantity) -> [Option<f64>; 3] {
        quantity.quantiles().map(|name| self.named(&name))
    }

    /// Up to what a driver can rely on headings [°]: halves, or whole degrees where the band is
    /// wide.
    pub(super) fn heading_step(self) -> f64 {
        /// Width of a band in which halves say nothing [°]. Source: ours.
        const WIDE: f64 = 4.0;
        match self.band(YAW) {
            [Some(low), _, Some(high)] if high - low <= WIDE => 0.5,
            [None, None, None] => 0.5,
            _ => 1.0,
        }
    }

    /// The band of headings, its ends rounded outwards.
    pub(super) fn heading_range(self) -> Option<String> {
        let step = self.heading_step();
        let [low, _, high] = self.band(YAW);
        let low = (low? / step).floor() * step;
        let high = high.map_or("none".to_owned(), |it| format!("{}°", (it / step).ceil() * step));
        Some(format!("{low} to {high}"))
    }
}

/// A number rounded to steps, without decimals that it does not need.
pub(super) fn in_steps(value: f64, step: f64) -> String {
    // No sign on nothing.
    format!("{}", (value / step).round() * step + 0.0)
}

/// A positive number rounded up to so many digits, or to a whole one where it has more.
pub(super) fn upwards(value: f64, digits: usize) -> String {
    /// Nobody reads more of them.
    const MOST: usize = 6;
    let has_digits = |decimals: &usize| value * power_of_ten(decimals + 1) >= power_of_ten(digits);
    let decimals = (0..MOST).find(has_digits).unwrap_or(MOST);
    let scale = power_of_ten(decimals);
    // What is over a step by rounding alone stays on it.
    format!("{:.decimals$}", (value * scale - 1e-9).ceil() / scale)
}

fn power_of_ten(exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |power, _| power * 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_are_rounded_upwards() {
        for (value, digits, expected) in [
            (1.41, 2, "1.5"),
            (0.0312, 2, "0.032"),
            (31.0, 1, "31"),
            (31.2, 1, "32"),
            (0.3, 1, "0.3"),
        ] {
            assert_eq!(upwards(value, digits), expected, "{value}");
        }
    }

    #[test]
    fn headings_have_no_decimals_that_they_do_not_need() {
        assert_eq!(in_steps(3.3, 0.5), "3.5");
        assert_eq!(in_steps(3.9, 0.5), "4");
        assert_eq!(in_steps(-0.1, 1.0), "0");
    }
}
