//! The page of the heading offset over slope.

use grouser::contact::validity::Finding;
use grouser::document::columns::heading::{self, held, steered};
use grouser::document::columns::{Quantity, SLOPE};
use grouser::document::table::Table;
use grouser::studies::heading::Steering;
use grouser_draw::chart::{Chart, Draw, Series, Style};

use super::of_model::{OfModel, brief, figures};
use crate::args::HeadingArgs;
use crate::commands::sampling;
use crate::output::text::capitalised;
use crate::report::answer::{self, Basis, axis, by_unit, meanings};
use crate::report::page::Page;

/// * `table`: the rows of all models
pub(super) fn html(command: &str, args: &HeadingArgs, all: &[OfModel], table: &Table) -> String {
    let mut page = Page::new("Heading offset that holds the contour");
    for of_model in all {
        page.answer(&sentences(&of_model.lines(all.len())));
    }
    page.list(what_was_asked(&all[0]));
    for (_, chart, caption) in figures(command, all) {
        page.drawing(&chart.to_svg(), caption);
    }
    page.rows("On each slope", table, &brief(args, &all[0]));
    page.heading("Everything over the slope");
    match all {
        [one] => page.charts(&by_unit(&dense(one), SLOPE, &held())),
        several => page.charts(&of_models(several)),
    }
    let slopes: Vec<f64> = args.slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let findings: Vec<Finding> = all
        .iter()
        .flat_map(|it| heading::findings(&it.curve, &slopes).into_iter().flatten())
        .collect();
    let mut explained = meanings(&held());
    if Steering::from(args.steering) == Steering::Crab {
        explained.splice(0..0, meanings(&steered()));
    }
    answer::close(page, &findings, &explained, &basis(command, args, all))
}

/// Lines as sentences of one paragraph.
fn sentences(lines: &str) -> String {
    let sentence = |line: &str| format!("{}.", capitalised(line.trim_end_matches('.')));
    lines.lines().map(sentence).collect::<Vec<_>>().join(" ")
}

fn what_was_asked(first: &OfModel) -> Vec<String> {
    let document = &first.scenario.document;
    let name = |key: &str| document.text(key).unwrap_or("unnamed").to_owned();
    vec![format!("rover: {}", name("rover.name")), format!("soil: {}", name("soil.name"))]
}

/// The results at the points of the curve, which crowd where it bends.
fn dense(of: &OfModel) -> Table {
    let slopes: Vec<f64> = of.curve.headings().into_iter().map(|it| it.slope).collect();
    heading::table(&of.curve, &of.scenario.value.rover, &slopes)
}

/// A chart for each result, with a curve for each model.
fn of_models(all: &[OfModel]) -> Vec<Chart> {
    let tables: Vec<(&str, Table)> = all.iter().map(|it| (it.name(), dense(it))).collect();
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

fn basis(command: &str, args: &HeadingArgs, all: &[OfModel]) -> Basis {
    let slopes: Vec<String> = args.slope_deg.0.iter().map(ToString::to_string).collect();
    let steering = Steering::from(args.steering);
    let samples = if steering != Steering::None {
        format!(" --steering {}", steering.name())
    } else if args.wheel_speeds {
        format!(" --wheel-speeds --most-speed-ratio {}", args.most_speed_ratio)
    } else {
        sampling::flags(&args.uncertainty)
    };
    let file = |it: &OfModel| format!("scenario{}.toml", it.end(all.len()));
    let line =
        |it| format!("grouser {command} {} --slope-deg {}{samples}", file(it), slopes.join(","));
    let basis = Basis::new(all.iter().map(line).collect::<Vec<_>>().join("\n"));
    all.iter().fold(basis, |basis, it| basis.with(file(it), &it.scenario))
}
