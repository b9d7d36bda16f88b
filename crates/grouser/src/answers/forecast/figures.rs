//! The figures of a forecast: bands over slope, the budget, and what each choice would mean.

use crate::document::columns::card::DRIFT;
use crate::document::columns::forecast::{
    FACTOR, INTERACTIONS, QUANTITY, SHARED_SHARE, VARIANCE_SHARE, WHOLE, slips_of_choices,
};
use crate::document::columns::{LIMIT_SLOPE, Quantity, SLIP_RATIO, SLOPE, YAW};
use crate::document::figure::{BAND_COLOUR, Bars, Chart, Series, Style};
use crate::document::reading::four_digits;
use crate::document::table::Table;
use crate::studies::forecast::{FactorKind, Forecast};

use super::super::Answer;
use super::tables::Tables;

/// Adds the error budget to the page.
pub(super) fn budget_to(answer: &mut Answer, tables: &Tables) {
    let budgets = budgets(&tables.budget);
    let widest = name_of(SLIP_RATIO.name, tables.widest_slip());
    let limit = name_of(LIMIT_SLOPE.name, None);
    answer.figure(
        Some("budget"),
        budget(&budgets),
        "The error budget: which share of the variance of the slip ratio, of the drift and of the \
         steepest slope each factor has alone, and what several have only together. Parts of a bar \
         add up to 100 %.",
    );
    answer.figure(
        Some("budget-slip"),
        largest_first(&budgets, &widest),
        "The factors of the slip on the slope on which it is least known, each with an equal share \
         of its interactions: all of them add up to 100 %.",
    );
    let caption = "The same of the steepest slope.";
    answer.figure(Some("budget-limit"), largest_first(&budgets, &limit), caption);
}

/// Adds the bands over the slope to the page, and what each choice would mean.
pub(super) fn bands_to(answer: &mut Answer, forecast: &Forecast, tables: &Tables) {
    let rows = &tables.rows;
    answer.figure(
        Some("slip"),
        band(rows, SLIP_RATIO, "Slip ratio of a contour traverse", "slip ratio"),
        "Slip ratio of a contour traverse over the slope, over all cases; 1 where no heading holds \
         the contour.",
    );
    answer.figure(
        Some("drift"),
        band(rows, DRIFT, "Drift with the nose on the contour", "drift [m/m]"),
        "Drift with the nose on the contour over the slope, over all cases; 1, straight downhill, \
         where the rover slides.",
    );
    answer.figure(
        Some("yaw"),
        band(rows, YAW, "Heading that holds the contour", "yaw, positive uphill [°]"),
        "Yaw that holds the contour over the slope. The upper edge ends where in more than 2.5 % \
         of the cases no heading does so, the median where in half of them.",
    );
    for (kind, file, title) in [
        (FactorKind::GravityScaling, "scaling", "Mean slip by how moduli scale"),
        (FactorKind::Ground, "ground", "Mean slip by the ground of the site"),
        (FactorKind::RoverMass, "mass", "Mean slip by the rover's mass"),
        (FactorKind::Model, "model", "Mean slip by the wheel-soil model"),
    ] {
        let curves = slips_of_choices(forecast, kind);
        if curves.len() > 1 {
            let caption = "Mean slip ratio of the cases of each choice over the slope; 1 where no \
                           heading holds the contour.";
            answer.figure(Some(file), by_choice(title, curves), caption);
        }
    }
}

/// A part of a budget.
struct FactorShare {
    factor: String,
    /// Alone, and with an equal share of its interactions [%].
    own: f64,
    shared: f64,
}

/// Names and parts of each budget.
type Budgets = Vec<(String, Vec<FactorShare>)>;

/// The budgets of a table, those of one quantity after each other.
fn budgets(table: &Table) -> Budgets {
    let (quantities, factors) = (table.texts(QUANTITY), table.texts(FACTOR));
    let slopes = table.numbers(SLOPE.name);
    let percent = |quantity: Quantity, row: usize| {
        100.0 * table.numbers(quantity.name)[row].unwrap_or_default()
    };
    let mut budgets: Vec<(&str, String, Vec<FactorShare>)> = Vec::new();
    for row in 0..table.rows() {
        let (Some(quantity), Some(factor)) = (&quantities[row], &factors[row]) else { continue };
        let name = name_of(quantity, slopes[row]);
        if budgets.last().is_none_or(|(_, last, _)| *last != name) {
            budgets.push((quantity, name, Vec::new()));
        }
        if let Some((.., parts)) = budgets.last_mut().filter(|_| factor != WHOLE) {
            let (own, shared) = (percent(VARIANCE_SHARE, row), percent(SHARED_SHARE, row));
            parts.push(FactorShare { factor: factor.clone(), own, shared });
        }
    }
    let order = [SLIP_RATIO, DRIFT, LIMIT_SLOPE].map(|it| it.name);
    budgets.sort_by_key(|(quantity, ..)| order.iter().position(|it| it == quantity));
    budgets.into_iter().map(|(_, name, parts)| (name, parts)).collect()
}

/// The factors of one budget with their shares of interactions, largest first.
fn largest_first(budgets: &Budgets, name: &str) -> Bars {
    let parts = budgets.iter().find(|(it, _)| it == name).map(|(_, parts)| parts);
    let factors = parts.into_iter().flatten().filter(|part| part.factor != INTERACTIONS);
    let mut factors: Vec<&FactorShare> = factors.collect();
    factors.sort_by(|one, other| other.shared.total_cmp(&one.shared));
    let bar = |part: &&FactorShare| {
        // Below zero by round-off only.
        let interactions = (part.shared - part.own).max(0.0);
        (part.factor.clone(), vec![part.own, interactions])
    };
    Bars {
        title: format!("What is not known of the {name}"),
        x_label: "share of the variance [%]".into(),
        parts: ["alone", "of interactions"].map(String::from).into(),
        has_rest: true,
        rows: factors.iter().map(bar).collect(),
    }
}

/// A bar for each budget. Factors have one order in all of them: the largest on average first, and
/// last what several have together.
fn budget(budgets: &Budgets) -> Bars {
    let of = |parts: &[FactorShare], name: &str| {
        parts.iter().find(|part| part.factor == name).map_or(0.0, |part| part.own)
    };
    let names_of =
        |parts: &Vec<FactorShare>| parts.iter().map(|part| part.factor.clone()).collect();
    let mut names: Vec<String> = budgets.first().map_or(Vec::new(), |(_, parts)| names_of(parts));
    let sum = |name: &str| budgets.iter().map(|(_, parts)| of(parts, name)).sum::<f64>();
    let order = |name: &String| (name == INTERACTIONS, -sum(name));
    names.sort_by(|one, other| {
        let (one, other) = (order(one), order(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    });
    let lengths = |parts: &[FactorShare]| names.iter().map(|name| of(parts, name)).collect();
    Bars {
        title: "Error budget".into(),
        x_label: "share of the variance [%]".into(),
        rows: budgets.iter().map(|(name, parts)| (name.clone(), lengths(parts))).collect(),
        parts: names,
        has_rest: true,
    }
}

/// What a bar is of: `slip, 10°`.
fn name_of(quantity: &str, slope: Option<f64>) -> String {
    let word = match quantity {
        _ if quantity == SLIP_RATIO.name => "slip",
        _ if quantity == DRIFT.name => "drift",
        _ if quantity == LIMIT_SLOPE.name => "steepest slope",
        other => other,
    };
    slope.map_or(word.to_owned(), |slope| format!("{word}, {}°", four_digits(slope)))
}

/// A band over the slope.
fn band(table: &Table, quantity: Quantity, title: &str, y_label: &str) -> Chart {
    let [low, median, high] = quantity.quantiles();
    let edges = table.edges(SLOPE, [&low, &high]);
    let medians = table.points(SLOPE.name, &median);
    Chart::new(
        title,
        ("slope [°]", y_label),
        vec![
            Series::band("95 % of the cases", BAND_COLOUR, edges),
            Series::new("median", Style::Line, 0, medians),
        ],
    )
}

fn by_choice(title: &str, curves: Vec<(String, Vec<(f64, f64)>)>) -> Chart {
    let styles = [Style::Line, Style::Dashed, Style::Dotted];
    let series = curves.into_iter().enumerate().map(|(place, (name, points))| {
        Series::new(name, styles[place % styles.len()], place + 1, points)
    });
    Chart::new(title, ("slope [°]", "mean slip ratio"), series.collect())
}
