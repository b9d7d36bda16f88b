//! The tables of a forecast, and what is printed of them.

use std::sync::Arc;

use super::super::Displayed;
use crate::document::columns::forecast::{self as columns, shares_brief};
use crate::document::columns::{LIMIT_SLOPE, SLOPE};
use crate::document::table::Table;
use crate::studies::forecast::Forecast;

/// The tables of a forecast.
pub(super) struct Tables {
    pub(super) rows: Arc<Table>,
    pub(super) steepest: Arc<Table>,
    pub(super) budget: Arc<Table>,
    pub(super) choices: Arc<Table>,
    pub(super) tests: Arc<Table>,
    /// Columns for reading: the shares of the slip, and the steepest slopes with theirs.
    pub(super) shares_brief: Vec<String>,
    pub(super) steepest_brief: Vec<String>,
}

impl Tables {
    pub(super) fn of(forecast: &Forecast) -> Self {
        Self {
            rows: columns::table(forecast).into(),
            steepest: columns::steepest(forecast).into(),
            budget: columns::budget(forecast).into(),
            choices: columns::choices(forecast).into(),
            tests: columns::tests(forecast).into(),
            shares_brief: shares_brief(forecast, &[SLOPE.name.to_owned()]),
            steepest_brief: shares_brief(forecast, &LIMIT_SLOPE.quantiles()),
        }
    }

    /// What a terminal shows.
    pub(super) fn screen(&self, notes: &[String]) -> Vec<Displayed> {
        let words = |text: &str| Displayed::Words(text.to_owned());
        let mut shown = vec![
            Displayed::Rows(Arc::clone(&self.rows), columns::brief()),
            words("\nwhat the variance of the slip ratio is due to, within each ground\n"),
            Displayed::Rows(Arc::clone(&self.rows), self.shares_brief.clone()),
            words("\nsteepest slope on which a heading holds the contour, and what it is due to\n"),
            Displayed::Rows(Arc::clone(&self.steepest), self.steepest_brief.clone()),
        ];
        if self.tests.rows() > 0 {
            shown.push(words("\ntests where the soil was measured\n"));
            shown.push(Displayed::Rows(Arc::clone(&self.tests), self.tests.names()));
        }
        let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
        shown.push(Displayed::Words(format!("\n{notes}")));
        shown
    }
}
