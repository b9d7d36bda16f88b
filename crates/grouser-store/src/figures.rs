//! The figures of a summary: distributions, convergence, sensitivities.

use grouser::document::figure::{Chart, Series, Style};

use crate::statistics::{ConvergenceRecord, Curve, SensitivityRecord, Statistics};

/// A figure of a summary.
#[derive(Debug)]
pub struct Figure {
    /// Name of its file, without ending.
    pub file: String,
    /// What it shows.
    pub caption: String,
    /// What is drawn.
    pub chart: Chart,
}

/// All of them, those of a quantity after each other.
#[must_use]
pub fn figures(statistics: &Statistics) -> Vec<Figure> {
    let of_quantity = |curve: &Curve| {
        let of = |quantity: &String| *quantity == curve.quantity;
        let steps = statistics.convergence.iter().filter(|it| of(&it.quantity));
        let shares = statistics.sensitivities.iter().filter(|it| of(&it.quantity));
        let figures = [
            Some(distribution(curve)),
            convergence(curve, &steps.collect::<Vec<_>>()),
            sensitivity(curve, &shares.collect::<Vec<_>>()),
        ];
        figures.into_iter().flatten().collect::<Vec<_>>()
    };
    statistics.curves.iter().flat_map(of_quantity).collect()
}

fn label(curve: &Curve) -> String {
    let unit = curve.unit.map_or(String::new(), |unit| format!(" [{unit}]"));
    format!("{}{unit}", curve.quantity)
}

fn distribution(curve: &Curve) -> Figure {
    let quantity = &curve.quantity;
    Figure {
        file: format!("{quantity}-distribution"),
        caption: format!(
            "Cumulative distribution of {quantity} over the runs with a result. A steep curve is a \
             quantity with little uncertainty."
        ),
        chart: Chart::new(
            format!("{quantity}: distribution"),
            (label(curve), "share of the runs below"),
            vec![Series::new("", Style::Line, 1, curve.points.iter().copied())],
        ),
    }
}

/// The median over the number of runs; none for fewer than two steps.
fn convergence(curve: &Curve, steps: &[&ConvergenceRecord]) -> Option<Figure> {
    let known = steps.iter().filter_map(|it| {
        let runs = it.runs as f64;
        Some((runs, it.p50?, it.p50_low?, it.p50_high?))
    });
    let known: Vec<(f64, f64, f64, f64)> = known.collect();
    if known.len() < 2 {
        return None;
    }
    let quantity = &curve.quantity;
    let band = known.iter().map(|(runs, _, low, high)| (*runs, *low, *high));
    let line = known.iter().map(|(runs, median, ..)| (*runs, *median));
    Some(Figure {
        file: format!("{quantity}-convergence"),
        caption: format!(
            "The median of {quantity} after the first runs, with its 95 % interval: more runs \
             narrow it with the square root of their number."
        ),
        chart: Chart::new(
            format!("{quantity}: convergence"),
            ("runs", label(curve)),
            vec![
                Series::band("95 % interval of the median", 6, band),
                Series::new("median", Style::Line, 1, line),
            ],
        )
        .with_log_x(),
    })
}

fn sensitivity(curve: &Curve, shares: &[&SensitivityRecord]) -> Option<Figure> {
    /// How far the marks of an input stand apart.
    const APART: f64 = 0.14;
    if shares.is_empty() {
        return None;
    }
    // The first input stands on top.
    let count = shares.len();
    let places = || shares.iter().enumerate().map(|(place, it)| ((count - place) as f64, *it));
    let half = |low: f64, high: f64| (high - low) / 2.0;
    let first = places().map(|(place, it)| (it.first, place + APART));
    let total = places().map(|(place, it)| (it.total, place - APART));
    let quantity = &curve.quantity;
    let chart = Chart::new(
        format!("{quantity}: Sobol indices"),
        ("share of the variance", ""),
        vec![
            Series::new("first order", Style::Dots, 1, first)
                .with_bars_across(shares.iter().map(|it| half(it.first_low, it.first_high))),
            Series::new("total", Style::Squares, 2, total)
                .with_bars_across(shares.iter().map(|it| half(it.total_low, it.total_high))),
        ],
    );
    Some(Figure {
        file: format!("{quantity}-sensitivity"),
        caption: format!(
            "Share of the variance of {quantity} that each input causes, alone (first order) and \
             with its interactions with others (total)."
        ),
        chart: chart.with_y_names(shares.iter().rev().map(|it| it.input.clone())),
    })
}
