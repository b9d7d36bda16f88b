//! The tables of a forecast, and what is printed of them.

use grouser::document::columns::forecast::{self as columns, DEVIATION, FACTOR, QUANTITY, WHOLE};
use grouser::document::columns::{LIMIT_SLOPE, SLIP_RATIO, SLOPE};
use grouser::document::reading::rounded_down;
use grouser::document::table::Table;
use grouser::studies::forecast::Forecast;

use crate::output::rows::Rows;
use crate::output::text::Text;

/// The tables of a forecast.
pub(super) struct Tables {
    pub(super) rows: Table,
    pub(super) limit: Table,
    pub(super) budget: Table,
    pub(super) choices: Table,
    pub(super) tests: Table,
}

impl Tables {
    pub(super) fn of(forecast: &Forecast) -> Self {
        Self {
            rows: columns::table(forecast),
            limit: columns::steepest(forecast),
            budget: columns::budget(forecast),
            choices: columns::choices(forecast),
            tests: columns::tests(forecast),
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

    /// For reading.
    pub(super) fn text(&self, notes: &[String]) -> Text {
        let budget = self.budget_of(&[SLIP_RATIO.name, LIMIT_SLOPE.name]);
        let budget = Rows::of_table(&budget).to_table(&columns::budget_brief());
        let tests = if self.tests.rows() == 0 {
            Text::default()
        } else {
            let names: Vec<&String> = self.tests.columns.iter().map(|(name, _)| name).collect();
            let tests = Rows::of_table(&self.tests).to_table(&names);
            Text::from("\ntests where the soil was measured\n") + tests
        };
        let notes: String = notes.iter().map(|note| format!("note: {note}\n")).collect();
        let title = "\nerror budget of the slip ratio and of the steepest slope\n";
        let rows = Rows::of_table(&self.rows).to_table(&columns::brief());
        rows + self.limit_line() + title + budget + tests + format!("\n{notes}")
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
