//! The page of a traverse: where the rover ends up, its path, and every channel over time.

use grouser::answers::{EVERY_MODEL, traverse};
use grouser::contact::validity::Finding;
use grouser::document::columns::run::{self, STANDING_BAND, TIME_BAND};
use grouser::document::columns::{
    Column, ENERGY, MODEL, Quantity, SINKAGE, SLIP_RATIO, TIME, X, Y, YAW,
};
use grouser::document::figure::axis;
use grouser::document::reading::{self, capitalised};
use grouser::document::table::Table;
use grouser::studies::traverse_band::Ends;
use grouser_draw::chart::{BAND_COLOUR, Chart, Drawable, Series, Style};

use super::of_model::{OfModel, chart, given};
use crate::args::TraverseArgs;
use crate::commands::sampling;
use crate::report::answer::{self, Basis, over_ground, over_time, run_meanings};
use crate::report::page::Page;

pub(super) fn html(args: &TraverseArgs, all: &[OfModel]) -> String {
    let mut page = Page::new("A traverse");
    for of_model in all {
        let name = if all.len() > 1 { format!("{}: ", of_model.name()) } else { String::new() };
        page.answer(&format!(
            "{name}{}",
            traverse::sentence(&of_model.scenario.value, &of_model.run)
        ));
    }
    page.list(what_was_run(&all[0]));
    let is_on_a_map = !all[0].scenario.value.ground.is_plane();
    for of_model in all {
        over_ground(&mut page, &of_model.scenario.value, &of_model.run.records);
    }
    let of_path = if is_on_a_map {
        "The path, seen from above."
    } else {
        "The path on the slope, seen from above it. The start is at the origin, the contour line \
         is y = 0."
    };
    page.drawing(&chart(all).to_svg(), of_path);
    match all {
        [one] => channels(&mut page, one),
        several => of_models(&mut page, several),
    }
    let findings: Vec<Finding> = all
        .iter()
        .flat_map(|it| run::each_findings(&it.run, &it.scenario.value).into_iter().flatten())
        .collect();
    let columns = all.first().map_or(Vec::new(), |it| run_meanings(&it.scenario.value));
    answer::close(page, Some(&findings), &columns, &basis(args, all))
}

fn what_was_run(first: &OfModel) -> Vec<String> {
    let document = &first.scenario.document;
    let mut lines = vec![
        format!("rover: {}", document.name_of("rover")),
        format!("soil: {}", document.name_of("soil")),
        answer::ground(document, &first.scenario.value),
    ];
    if let Some(band) = &first.band {
        lines.push(format!("{} samples of soil and model", band.run.completed.trials));
    }
    lines
}

/// Every channel of a run over time.
fn channels(page: &mut Page, of: &OfModel) {
    let table = of.rows();
    if let Some(bands) = &of.band {
        page.heading("What the samples say");
        page.list(early(&bands.run.ends));
        let columns = TIME_BAND[1..].iter().chain(&STANDING_BAND);
        page.charts(&columns.filter_map(|column| band(&table, column)).collect::<Vec<_>>());
    }
    derivatives(page, of);
    over_time(page, "", &table, &of.scenario.value);
}

/// What each number is worth at the end of a run.
fn derivatives(page: &mut Page, of: &OfModel) {
    let Some(gradient) = &of.gradient else { return };
    let results = [X, Y, YAW, ENERGY].map(|it| it.name);
    let table = gradient.of_the_end(&results);
    let names: Vec<String> = table.columns.iter().map(|(name, _)| name.clone()).collect();
    page.heading("What a number is worth");
    page.rows("Change of the end for one unit of each number", &table, &names);
    for line in gradient.lines().lines() {
        page.paragraph(&reading::sentence(line));
    }
}

/// What becomes of the samples that ended early, and when bands are over fewer samples from then
/// on.
fn early(ends: &Ends) -> Vec<String> {
    match ends.sentences() {
        none if none.is_empty() => vec![format!("none of {} samples ended early", ends.samples())],
        some => some,
    }
}

/// A quantity over time with its band.
fn band<R>(table: &Table, column: &Column<R>) -> Option<Chart> {
    let quantity = Quantity { name: column.name, unit: column.unit };
    let [low, median, high] = quantity.quantiles();
    let edges = table.edges(TIME, [&low, &high]);
    let medians = table.points(TIME.name, &median);
    (!edges.is_empty()).then(|| {
        let series = vec![
            Series::band("95 %", BAND_COLOUR, edges),
            Series::new("median", Style::Line, 1, medians),
        ];
        Chart::new(capitalised(&quantity.label()), (axis(TIME), axis(quantity)), series)
    })
}

/// The ends of all models, and some quantities of each over time.
fn of_models(page: &mut Page, all: &[OfModel]) {
    let mut summaries = Table::default();
    for of_model in all {
        summaries.append(of_model.summary());
    }
    let mut names = vec![MODEL.to_owned()];
    names.extend(run::summary_brief());
    page.rows("The end and the means, by model", &summaries, &names);
    let tables: Vec<(&str, Table)> = all
        .iter()
        .map(|it| (it.name(), run::brief(&it.run, &it.scenario.value, it.run.records.len() - 1)))
        .collect();
    let of = |quantity: Quantity| {
        let series = tables.iter().enumerate().map(|(place, (name, table))| {
            let points = table.points(TIME.name, quantity.name);
            Series::new(*name, Style::of_line(place), place + 1, points)
        });
        let axes = (axis(TIME), axis(quantity));
        Chart::new(capitalised(&quantity.label()), axes, series.collect())
    };
    for of_model in all.iter().filter(|it| it.gradient.is_some()) {
        page.heading(of_model.name());
        derivatives(page, of_model);
    }
    page.folded("Over time, by model", |page| {
        page.charts(&[X, Y, YAW, SLIP_RATIO, SINKAGE].map(of));
    });
}

fn basis(args: &TraverseArgs, all: &[OfModel]) -> Basis {
    let model = if all.len() > 1 { format!(" --model {EVERY_MODEL}") } else { String::new() };
    let samples = sampling::flags(args.uncertainty.sampling());
    let gradients = sampling::gradient_flag(args.gradients.keys().as_ref());
    let repeat = format!("grouser traverse scenario.toml{model}{samples}{gradients}");
    let next = [
        "grouser heading scenario.toml --slope-deg LIST --out HEADINGS",
        "grouser traverse scenario.toml --uncertainty --out WITH-BANDS",
        "grouser traverse scenario.toml --animate drive.html",
    ];
    // Bands that are there need not be asked for.
    let next =
        next.into_iter().filter(|line| samples.is_empty() || !line.contains("--uncertainty"));
    let next: Vec<&str> = next.collect();
    let basis = Basis::new(repeat).followed_by(&next).with("scenario.toml", &all[0].scenario);
    basis.with_files(given(all))
}
