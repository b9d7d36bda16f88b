//! The page of a map.

use grouser::answers::meanings;
use grouser::document::columns::map::{HEADING, bands};
use grouser::document::columns::{POWER, SINKAGE, SLIP_RATIO};
use grouser::document::reading::four_digits;
use grouser::studies::mobility::{Ground, MobilityMap};
use grouser_draw::map::map_picture;
use grouser_map::{BandSummary, Look, MapColumn};

use super::numbers::{errors, label};
use crate::args::MapArgs;
use crate::inputs::MapInputs;
use crate::report::answer::{self, Basis};
use crate::report::page::Page;

/// The name of the page.
pub(super) const NAME: &str = "map.html";

/// * `bands`: each with its numbers in all
pub(super) fn html(
    args: &MapArgs,
    inputs: &MapInputs,
    (ground, map): (Ground<'_>, &MobilityMap),
    all: &[(&MapColumn, &BandSummary)],
    sentence: &str,
) -> String {
    let mut page = Page::new("Where the rover can go");
    page.answer(sentence.trim_end());
    page.paragraph(&course(&args.course_deg));
    for (band, of) in all {
        let drawing = picture((ground, map), band, of);
        page.drawing(&drawing, &format!("{}. Empty: no number.", band.doc));
    }
    page.heading("How exact the map is");
    let error = |name: &str| {
        let errors = errors(map);
        errors.get(name).and_then(serde_json::Value::as_f64).map_or_else(String::new, four_digits)
    };
    let [east, north] = ground.slope_length();
    page.paragraph(&format!(
        "Slopes are taken over {} m to the east and {} m to the north. Numbers are read from a \
         table over slope, which is within {}° of the heading, {} of the slip ratio, {} W and {} \
         mm of what `heading-map` computes on the same slope. What a map cannot know: steps and \
         stones between its points, and soil that differs from place to place.",
        four_digits(east),
        four_digits(north),
        error(HEADING.name),
        error(SLIP_RATIO.name),
        error(POWER.name),
        error(SINKAGE.name),
    ));
    let repeat = format!(
        "grouser map DEM scenario.toml --course-deg {} --samples {} --seed {} --rim-speed-m-s {} \
         --out OTHER",
        args.course_deg, args.samples, args.seed, inputs.study.rim_speed
    );
    let basis = Basis::new(repeat).with("scenario.toml", &inputs.scenario);
    answer::close(page, [], &meanings(&bands()), &basis)
}

/// A band in colours, north up.
pub(super) fn picture(
    (ground, map): (Ground<'_>, &MobilityMap),
    band: &MapColumn,
    of: &BandSummary,
) -> String {
    let number = |column: usize, row: usize| Some(band.number(&ground.at(map, column, row)?));
    let scale = Look::of(band.name).scale(of);
    map_picture(&label(band), &ground.raster().grid, &number, &scale)
}

fn course(asked: &str) -> String {
    match asked {
        "best" => {
            "Each place has the course that is least often a no-go there, and of several the \
                   one with the least slip."
                .to_owned()
        }
        "worst" => {
            "Each place has the course that is most often a no-go there, and of several the \
                    one with the most slip."
                .to_owned()
        }
        degrees => format!(
            "The course is {degrees}°, counted from the contour with the hill on the left, \
             positive uphill. On a rover that is its own mirror image it is the same with the hill \
             on the right."
        ),
    }
}
