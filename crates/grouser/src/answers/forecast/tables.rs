//! The tables of a forecast, and what is printed of them.

use std::sync::Arc;

use super::super::Displayed;
use crate::document::columns::forecast::{self as columns, DEVIATION, FACTOR, QUANTITY, WHOLE};
use crate::document::columns::{LIMIT_SLOPE, SLIP_RATIO, SLOPE};
use crate::document::reading::rounded_down;
use crate::document::table::Table;
use crate::studies::forecast::Forecast;

/// The tables of a forecast.
pub(super) struct Tables {
    pub(super) rows: Arc<Table>,
    pub(super) limit: Table,
    pub(super) budget: Arc<Table>,
    pub(super) choices: Arc<Table>,
    pub(super) tests: Arc<Table>,
}

impl Tables {
    pub(super) fn of(forecast: &Forecast) -> Self {
        Self {
            rows: columns::table(forecast).into(),
            limit: columns::steepest(forecast),
            budget: columns::budget(forecast).into(),
            choices: columns::choices(forecast).into(),
            tests: columns::tests(forecast).into(),
        }
    }

    /// The budget of a quantity.
    pub(super) fn budget_of(&self, names: &[&str]) -> Table {
        let quantities = self.budget.texts(QUANTITY).iter().enumerate();
        let is_asked =
            |name: &Option<String>| name.as_deref().is_some_and(|it| names.contains(&it));
        let places = quantities.filter(|(_, name)| is_asked(name)).map(|(place, _)| place);
        self.budget.rows_at(&places.collect::<Vec<_>>())
    }

    /// The slope on which the slip is least known [°].
    pub(super) fn widest_slip(&self) -> Option<f64> {
        let slip = self.budget_of(&[SLIP_RATIO.name]);
        let factors = slip.texts(FACTOR);
        let deviation = |row: &usize| slip.numbers(DEVIATION.name)[*row].unwrap_or_default();
        let whole = (0..slip.rows()).filter(|row| factors[*row].as_deref() == Some(WHOLE));
        let widest = whole.max_by(|one, other| deviation(one).total_cmp(&deviation(other)));
        widest.and_then(|row| slip.numbers(SLOPE.name)[row])
    }

    /// What a terminal shows.
    pub(super) fn screen(&self, notes: &[String]) -> Vec<Displayed> {
        let budget = self.budget_of(&[SLIP_RATIO.name, LIMIT_SLOPE.name]);
        let title = "\nerror budget of the slip ratio and of the steepest slope\n";
        let mut shown = vec![
            Displayed::Rows(Arc::clone(&self.rows), columns::brief()),
            Displayed::Words(self.limit_line() + title),
            Displayed::Rows(budget.into(), columns::budget_brief()),
        ];
        if self.tests.rows() > 0 {
            shown.push(Displayed::Words("\ntests where the soil was measured\n".into()));
            shown.push(Displayed::Rows(Arc::clone(&self.tests), self.tests.names()));
        }
        let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
        shown.push(Displayed::Words(format!("\n{notes}")));
        shown
    }

    /// The steepest slope, in a line.
    pub(super) fn limit_line(&self) -> String {
        let ends = LIMIT_SLOPE.quantiles().map(|name| self.limit.numbers(&name)[0]);
        let [low, median, high] = ends.map(|end| rounded_down(end.unwrap_or_default()));
        format!(
            "steepest slope on which a heading holds the contour: {low}° to {high}° (95 %), median \
             {median}°\n"
        )
    }
}
