//! The figures of a forecast: the bands of each ground over slope, and what they are due to.

use crate::document::columns::card::DRIFT;
use crate::document::columns::forecast::{self as columns, open_shares};
use crate::document::columns::{Quantity, SLIP_RATIO, SLOPE, YAW};
use crate::document::figure::{Bars, Chart, Series, Style};
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::studies::forecast::Forecast;

use super::super::Answer;
use super::tables::Tables;

/// Adds the error budgets to the page.
pub(super) fn budget_to(answer: &mut Answer, forecast: &Forecast, tables: &Tables) {
    let title = "What is not known of the slip";
    answer.figure(
        Some("budget"),
        budget(forecast, &tables.rows, title),
        "The error budget of the slip ratio on each ground and slope: which share of its variance \
         within the ground each factor has, with an equal share of its interactions. A bar is \
         missing where nothing varies.",
    );
    let title = "What is not known of the steepest slope";
    let caption = "The same of the steepest slope.";
    answer.figure(Some("budget-limit"), budget(forecast, &tables.steepest, title), caption);
}

/// Adds the bands of each ground over the slope to the page.
pub(super) fn bands_to(answer: &mut Answer, forecast: &Forecast, tables: &Tables) {
    let beside = "A band has 95 % of the cases of one ground, the line in it is their median. A \
                  line without a band stands beside them: no measurement supports how moduli scale \
                  in its cases.";
    for (file, quantity, title, y_label, meaning) in [
        (
            "slip",
            SLIP_RATIO,
            "Slip ratio of a contour traverse",
            "slip ratio",
            "Slip ratio of a contour traverse over the slope; 1 where no heading holds the contour.",
        ),
        (
            "drift",
            DRIFT,
            "Drift with the nose on the contour",
            "drift [m/m]",
            "Drift with the nose on the contour over the slope; 1, straight downhill, where the \
             rover slides.",
        ),
        (
            "yaw",
            YAW,
            "Heading that holds the contour",
            "yaw, positive uphill [°]",
            "Yaw that holds the contour over the slope. An upper edge ends where in more than 2.5 % \
             of the cases no heading does so, a median where in half of them.",
        ),
    ] {
        let chart = bands(forecast, &tables.rows, quantity, (title, y_label));
        answer.figure(Some(file), chart, format!("{meaning} {beside}"));
    }
}

/// A bar for each row of the grounds that are answered first.
fn budget(forecast: &Forecast, table: &Table, title: &str) -> Bars {
    let open = open_shares(forecast);
    let share = |row: usize, quantity: Quantity| {
        // Below zero by round-off only.
        table.numbers(quantity.name)[row].map_or(0.0, |share| 100.0 * share.max(0.0))
    };
    let per_ground = table.rows() / forecast.grounds.len().max(1);
    let bar = |row: usize| {
        let ground = columns::name(&forecast.grounds[row / per_ground]);
        let slope = table.numbers(SLOPE.name).get(row).copied().flatten();
        let slope = slope.map_or(String::new(), |slope| format!(", {}°", four_digits(slope)));
        (ground + &slope, open.iter().map(|(_, it)| share(row, *it)).collect())
    };
    let is_first = |row: &usize| forecast.is_first(&forecast.grounds[row / per_ground]);
    Bars {
        title: title.into(),
        x_label: "share of the variance [%]".into(),
        parts: open.iter().map(|(kind, _)| kind.name().to_owned()).collect(),
        has_rest: false,
        rows: (0..table.rows()).filter(is_first).map(bar).collect(),
    }
}

/// The bands of a quantity over the slope: one for each ground that is answered first; of others
/// their medians.
fn bands(
    forecast: &Forecast,
    table: &Table,
    quantity: Quantity,
    (title, y_label): (&str, &str),
) -> Chart {
    let [low, median, high] = quantity.quantiles();
    let mut series = Vec::new();
    for (place, ground) in forecast.grounds.iter().enumerate() {
        let slopes = ground.slopes.len();
        let rows = table.rows_at(&(place * slopes..(place + 1) * slopes).collect::<Vec<_>>());
        let name = columns::name(ground);
        if forecast.is_first(ground) {
            series.push(Series::band(
                format!("95 %, {name}"),
                place,
                rows.edges(SLOPE, [&low, &high]),
            ));
        }
        let points = rows.points(SLOPE.name, &median);
        series.push(Series::new(name, Style::of_line(place), place, points));
    }
    Chart::new(title, ("slope [°]", y_label), series)
}
