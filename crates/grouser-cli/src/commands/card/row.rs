//! A row of the card, as the page reads it.

use grouser::document::columns::card::VERDICT;
use grouser::document::columns::{Quantity, SLOPE};
use grouser::document::table::Table;

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

    fn named(self, name: &str) -> Option<f64> {
        self.table.numbers(name).get(self.place).copied().flatten()
    }

    /// Its slope, as the card writes it.
    pub(super) fn slope(self) -> f64 {
        self.number(SLOPE).unwrap_or_default()
    }

    /// `go`, `caution` or `no-go`.
    pub(super) fn verdict(self) -> &'a str {
        self.table.texts(VERDICT)[self.place].as_deref().unwrap_or_default()
    }

    /// Whether it is not to be driven.
    pub(super) fn is_no_go(self) -> bool {
        self.verdict() == "no-go"
    }

    /// The median; without samples the soil as written.
    pub(super) fn middle(self, quantity: Quantity) -> Option<f64> {
        let [_, median, _] = quantity.quantiles();
        self.named(&median).or_else(|| self.number(quantity))
    }

    /// That between the ends of its band, times a factor.
    pub(super) fn band(self, quantity: Quantity, factor: f64) -> [Option<f64>; 3] {
        let [low, _, high] = quantity.quantiles();
        [self.named(&low), self.middle(quantity), self.named(&high)]
            .map(|value| value.map(|value| value * factor))
    }
}
