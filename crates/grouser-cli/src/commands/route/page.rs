//! The page of a route.

use grouser::document::route::RouteRecord;
use grouser::studies::route::Answer as Found;
use grouser_map::{Track, relief};

use super::Way;
use super::record::{self, Brief};
use crate::args::RouteArgs;
use crate::inputs::RouteInputs;
use crate::output::rows::{Rows, four_digits};
use crate::report::answer::{self, Basis};
use crate::report::page::Page;

pub(super) fn html(
    args: &RouteArgs,
    inputs: &RouteInputs,
    ways: &[Way],
    records: &[RouteRecord],
    rows: &Rows,
) -> String {
    let mut page = Page::new("The cheapest way");
    page.answer(&sentence(&records[0]));
    page.drawing(
        &picture(inputs, ways),
        "The ground as a Sun in the north-west lights it, 30° above the horizon. Rings: where the way turns.",
    );
    page.heading("What each way takes");
    page.text(&rows.to_table(&Brief::COLUMNS));
    for record in records {
        let line = record::line(record);
        if !line.is_empty() {
            page.paragraph(line.trim_end());
        }
    }
    page.paragraph(
        "Predicted by tables of the steady motion on each slope and course, with turns on the spot as on level ground. The \
         lattice's sixteen directions make a way up to 2.8 % longer than it need be. What the way cannot know: steps and \
         stones between the points of the map, and soil that differs from place to place.",
    );
    let ends = inputs.ends;
    let repeat = format!(
        "grouser route DEM scenario.toml --from {},{} --to {},{} --minimise {} --samples {} --seed {}",
        ends.from.x,
        ends.from.y,
        ends.to.x,
        ends.to.y,
        records[0].minimise,
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
        .filter_map(|way| match &way.found {
            Found::Route(route) => Some(Track {
                name: format!("least {}", way.objective.name()),
                places: &route.waypoints,
            }),
            Found::NoSafeRoute(_) => None,
        })
        .collect();
    relief(&inputs.raster, &tracks, "Ways over the ground")
}

fn sentence(record: &RouteRecord) -> String {
    match (&record.reason, record.length_m, record.time_s, record.energy_j) {
        (None, Some(length), Some(time), Some(energy)) => format!(
            "{} m in {} s with {} J: the way with the least {}.",
            four_digits(length),
            four_digits(time),
            four_digits(energy),
            record.minimise
        ),
        (reason, ..) => format!("No safe route: {}.", reason.as_deref().unwrap_or_default()),
    }
}
