//! Figures of headings over slope.

use super::super::Answer;
use super::of_model::OfModel;
use super::question::HeadingQuestion;
use crate::document::columns::heading::{self, held, turned};
use crate::document::columns::{Quantity, SLOPE};
use crate::document::figure::{Chart, Series, Style, axis};
use crate::document::reading::capitalised;
use crate::document::table::Table;
use crate::studies::heading::{HeadingCurve, Steering};

const CURVE: &str = "The rover crosses the slope along the contour line with its nose turned \
                     uphill by this angle. Where the curve ends no heading holds the contour.";
const BELIEVED: &str = "The heading to set is the median over all samples of soil and model; one that \
                        no heading holds needs more than every number. Where the band reaches the \
                        top, that is so in more than 2.5 % of them, and where the line ends in half.";
const CRAB: &str = "The rover crosses the slope with its body along the contour line and its \
                    wheels steered uphill by this angle. Where the curve ends no steering angle \
                    holds the contour.";
const CHANCE: &str = "The share of the samples in which some heading holds the contour. The band \
                      is what so many samples leave open of that share, with 95 % confidence.";

impl HeadingQuestion {
    /// Adds a chart of the curves of all models, or those of the bands of each.
    pub(super) fn figures(&self, answer: &mut Answer, all: &[OfModel<'_>]) {
        let name = answer.name.clone();
        if all.iter().all(|of_model| of_model.bands.is_none()) {
            let caption = match self.steering {
                Steering::None => CURVE,
                Steering::Crab => CRAB,
            };
            return answer.figure(Some(&name), chart(all), caption);
        }
        for of_model in all {
            let Some(bands) = &of_model.bands else { continue };
            let end = self.end(of_model.scenario);
            answer.figure(Some(&format!("{name}{end}")), bands.chart(), BELIEVED);
            answer.figure(Some(&format!("probability{end}")), bands.chance_chart(), CHANCE);
        }
    }
}

/// A chart for each result, with a curve for each model.
pub(super) fn of_models(all: &[OfModel<'_>]) -> Vec<Chart> {
    let tables: Vec<(&str, Table)> = all.iter().map(|it| (it.name(), it.dense())).collect();
    let chart = |quantity: Quantity| {
        let series = tables.iter().enumerate().map(|(place, (name, table))| {
            let points = table.points(SLOPE.name, quantity.name);
            Series::new(*name, Style::of_line(place), place + 1, points)
        });
        let axes = (axis(SLOPE), axis(quantity));
        Chart::new(capitalised(&quantity.label()), axes, series.collect())
    };
    let quantities = held().map(|column| Quantity { name: column.name, unit: column.unit });
    let charts = quantities.into_iter().map(chart);
    charts.filter(|chart| chart.series.iter().any(|series| !series.points.is_empty())).collect()
}

/// Yaw over slope.
fn chart(all: &[OfModel<'_>]) -> Chart {
    let series = all.iter().enumerate().map(|(place, of_model)| {
        let name = if all.len() > 1 { of_model.name() } else { "" };
        line(name, place + 1, &of_model.curve)
    });
    let (title, angle) = match all[0].curve.steering() {
        Steering::None => ("Heading offset that holds the contour", "yaw, positive uphill [°]"),
        Steering::Crab => {
            ("Steering angle that holds the contour", "steering angle, positive uphill [°]")
        }
    };
    Chart::new(title, ("slope [°]", angle), series.collect())
}

fn line(name: &str, colour: usize, curve: &HeadingCurve) -> Series {
    let points = heading::curve(curve);
    let angle = turned(curve.steering()).name;
    Series::new(name, Style::Line, colour, points.points(SLOPE.name, angle))
}
