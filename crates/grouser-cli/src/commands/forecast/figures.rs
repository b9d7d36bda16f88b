//! The figures of a forecast: bands over slope, the budget, and what each choice would mean.

use grouser::document::columns::card::DRIFT;
use grouser::document::columns::forecast::{
    FACTOR, QUANTITY, VARIANCE_SHARE, WHOLE, slips_of_choices,
};
use grouser::document::columns::{LIMIT_SLOPE, Quantity, SLIP_RATIO, SLOPE, YAW};
use grouser::document::table::Table;
use grouser::studies::forecast::{FactorKind, Forecast};

use super::Tables;
use crate::chart::{Bars, Chart, Series, Style};
use crate::output::rows::four_digits;

/// A figure.
pub(super) struct Figure {
    /// Name of its file, without ending.
    pub(super) file: &'static str,
    pub(super) caption: &'static str,
    pub(super) svg: String,
}

/// All of them, in the order of the page.
pub(super) fn all(forecast: &Forecast, tables: &Tables) -> Vec<Figure> {
    let mut figures = vec![
        Figure {
            file: "budget",
            caption: "The error budget: which share of the variance of the slip ratio, of the drift and of the steepest \
                      slope each factor has alone, and what several have only together. Parts of a bar add up to 100 %.",
            svg: budget(&tables.budget).to_svg(),
        },
        Figure {
            file: "slip",
            caption: "Slip ratio of a contour traverse over the slope, over all cases; 1 where no heading holds the \
                      contour.",
            svg: band(&tables.rows, SLIP_RATIO, "Slip ratio of a contour traverse", "slip ratio")
                .to_svg(),
        },
        Figure {
            file: "drift",
            caption: "Drift with the nose on the contour over the slope, over all cases; 1, straight downhill, where \
                      the rover slides.",
            svg: band(&tables.rows, DRIFT, "Drift with the nose on the contour", "drift [m/m]")
                .to_svg(),
        },
        Figure {
            file: "yaw",
            caption: "Yaw that holds the contour over the slope. The upper edge ends where in more than 2.5 % of the \
                      cases no heading does so, the median where in half of them.",
            svg: band(
                &tables.rows,
                YAW,
                "Heading that holds the contour",
                "yaw, positive uphill [°]",
            )
            .to_svg(),
        },
    ];
    let of_choices = [
        (FactorKind::GravityScaling, "scaling", "Mean slip by how moduli scale"),
        (FactorKind::Ground, "ground", "Mean slip by the ground of the site"),
        (FactorKind::RoverMass, "mass", "Mean slip by the rover's mass"),
        (FactorKind::Model, "model", "Mean slip by the wheel-soil model"),
    ];
    for (kind, file, title) in of_choices {
        let curves = slips_of_choices(forecast, kind);
        if curves.len() > 1 {
            let caption = "Mean slip ratio of the cases of each choice over the slope; 1 where no heading holds the \
                           contour.";
            figures.push(Figure { file, caption, svg: by_choice(title, curves).to_svg() });
        }
    }
    figures
}

/// A bar for each quantity and slope. Factors have one order in all of them: the largest on average first.
fn budget(table: &Table) -> Bars {
    let (quantities, factors) = (table.texts(QUANTITY), table.texts(FACTOR));
    let (slopes, shares) = (table.numbers(SLOPE.name), table.numbers(VARIANCE_SHARE.name));
    let mut bars: Vec<(String, Vec<(String, f64)>)> = Vec::new();
    for row in 0..table.rows() {
        let (Some(quantity), Some(factor)) = (&quantities[row], &factors[row]) else { continue };
        if factor == WHOLE {
            continue;
        }
        let name = name_of(quantity, slopes[row]);
        if bars.last().is_none_or(|(last, _)| *last != name) {
            bars.push((name, Vec::new()));
        }
        if let Some((_, parts)) = bars.last_mut() {
            parts.push((factor.clone(), 100.0 * shares[row].unwrap_or_default()));
        }
    }
    let of = |parts: &[(String, f64)], name: &str| {
        parts.iter().find(|(factor, _)| factor == name).map_or(0.0, |(_, share)| *share)
    };
    let mut names: Vec<String> = bars
        .first()
        .map_or(Vec::new(), |(_, parts)| parts.iter().map(|(factor, _)| factor.clone()).collect());
    let sum = |name: &str| bars.iter().map(|(_, parts)| of(parts, name)).sum::<f64>();
    names.sort_by(|one, other| sum(other).total_cmp(&sum(one)));
    let lengths = |parts: &[(String, f64)]| names.iter().map(|name| of(parts, name)).collect();
    Bars {
        title: "Error budget".into(),
        x_label: "share of the variance [%]".into(),
        bars: bars.iter().map(|(name, parts)| (name.clone(), lengths(parts))).collect(),
        parts: names,
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
    let edges: Vec<(f64, f64, f64)> = table
        .numbers(SLOPE.name)
        .iter()
        .zip(table.numbers(&low).iter().zip(table.numbers(&high)))
        .filter_map(|(slope, (low, high))| Some(((*slope)?, (*low)?, (*high)?)))
        .collect();
    let points = |name: &str| table.points(SLOPE.name, name).collect::<Vec<_>>();
    Chart {
        title: title.into(),
        x_label: "slope [°]".into(),
        y_label: y_label.into(),
        series: vec![
            Series::band("95 % of the cases", 6, edges),
            Series::new("median", Style::Line, 0, points(&median)),
            Series::new("lower end", Style::Dotted, 1, points(&low)),
        ],
    }
}

fn by_choice(title: &str, curves: Vec<(String, Vec<(f64, f64)>)>) -> Chart {
    let styles = [Style::Line, Style::Dashed, Style::Dotted];
    let series = curves.into_iter().enumerate().map(|(place, (name, points))| {
        Series::new(name, styles[place % styles.len()], place + 1, points)
    });
    Chart {
        title: title.into(),
        x_label: "slope [°]".into(),
        y_label: "mean slip ratio".into(),
        series: series.collect(),
    }
}
