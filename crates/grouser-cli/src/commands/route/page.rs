//! The page of a route.

use grouser::document::reading::four_digits;
use grouser::document::route::RouteRecord;
use grouser_draw::map::{Track, ways_over_ground};

use super::record::{self, Brief};
use super::way::Way;
use crate::args::RouteArgs;
use crate::inputs::{Asked, RouteInputs};
use crate::output::rows::Rows;
use crate::report::answer::{self, Basis};
use crate::report::page::Page;

pub(super) fn html(
    args: &RouteArgs,
    inputs: &RouteInputs,
    ways: &[Way],
    records: &[RouteRecord],
    rows: &Rows,
) -> String {
    let is_given = args.along.is_some();
    let mut page = Page::new(if is_given { "What a way takes" } else { "The cheapest way" });
    page.answer(&sentence(&records[0]));
    page.drawing(
        &picture(inputs, ways),
        "The ground as a Sun in the north-west lights it, 30° above the horizon. Rings: where the \
         way turns.",
    );
    page.heading("What each way takes");
    page.text(&rows.to_table(&Brief::COLUMNS));
    for line in records
        .iter()
        .map(record::lines)
        .flat_map(|it| it.lines().map(str::to_owned).collect::<Vec<_>>())
    {
        page.paragraph(&line);
    }
    page.paragraph(if is_given { OF_A_LINE } else { OF_THE_LATTICE });
    page.paragraph(
        "What the way cannot know: steps and stones between the points of the map, and soil that \
         differs from place to place.",
    );
    let repeat = format!(
        "{} --samples {} --seed {}",
        question(inputs, &records[0]),
        args.samples,
        args.seed
    );
    let basis = Basis::new(repeat).with("scenario.toml", &inputs.scenario);
    answer::close(page, [], &[], &basis)
}

/// The ground and the ways.
pub(super) fn picture(inputs: &RouteInputs, ways: &[Way]) -> String {
    let tracks: Vec<Track<'_>> = ways
        .iter()
        .filter(|way| !way.places.is_empty())
        .map(|way| Track { name: record::name(&way.record), places: &way.places })
        .collect();
    let raster = &inputs.raster;
    let gradient = |column: usize, row: usize| raster.gradient(column, row, [1, 1]);
    ways_over_ground("Ways over the ground", &raster.grid, &gradient, &tracks)
}

/// How the numbers of ways that were sought come about.
const OF_THE_LATTICE: &str = "Predicted by tables of the steady motion on each slope and course, \
                              with turns on the spot as on level ground. The lattice's sixteen \
                              directions make a way up to 2.8 % longer than it need be.";

/// How the numbers of a given line come about.
const OF_A_LINE: &str = "Predicted by tables of the steady motion on each slope and course, piece \
                         by piece as long as the map's points are apart, with turns on the spot as \
                         on level ground.";

/// The command that asks the same.
fn question(inputs: &RouteInputs, best: &RouteRecord) -> String {
    match &inputs.asked {
        Asked::Along(_) => "grouser route DEM scenario.toml --along LINE.geojson".to_owned(),
        Asked::Between(ends) => format!(
            "grouser route DEM scenario.toml --from {},{} --to {},{} --minimise {}",
            ends.from.x,
            ends.from.y,
            ends.to.x,
            ends.to.y,
            best.minimise.unwrap_or_default()
        ),
    }
}

fn sentence(record: &RouteRecord) -> String {
    let taken = match (record.length_m, record.time_s, record.energy_j) {
        (Some(length), Some(time), Some(energy)) => Some(format!(
            "{} m in {} s with {} J",
            four_digits(length),
            four_digits(time),
            four_digits(energy)
        )),
        _ => None,
    };
    match (record.minimise, &record.reason, taken) {
        (Some(least), None, Some(taken)) => format!("{taken}: the way with the least {least}."),
        (Some(_), reason, _) => {
            format!("No safe route: {}.", reason.as_deref().unwrap_or_default())
        }
        (None, None, Some(taken)) => format!("{taken}: the given way is safe."),
        (None, reason, taken) => {
            let but = taken.map_or_else(String::new, |taken| format!("{taken}, but "));
            let why = reason.as_deref().unwrap_or_default();
            format!("{but}the given way is not safe: {why}.")
        }
    }
}
