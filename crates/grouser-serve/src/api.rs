//! What the page, and other programs, may ask. Each question is JSON in the words of documents and
//! columns; its answer is lines of JSON.

mod campaign;
mod command;
mod design;
mod document;
mod drawing;
mod drive_step;
mod fields;
mod fit;
mod fit_task;
mod ground;
mod heading;
mod heading_map;
mod lists;
mod map;
mod mission;
mod parts;
mod place;
mod replay;
mod route;
mod rule;
mod staged;
mod traverse;
mod wheel_test;

use crate::asked::Read;
use crate::console::Console;

/// Lists what there is, as a line.
pub(crate) type List = fn(&Console) -> String;

/// The questions, by their paths below `/api/`: those of answers have the names of the program's
/// commands.
pub(crate) static QUESTIONS: [(&str, Read); 21] = [
    ("heading", heading::read),
    ("heading-map", heading_map::read),
    ("wheel-test", wheel_test::read),
    ("map", map::read),
    ("map-place", place::read),
    ("route", route::read),
    ("traverse", traverse::read),
    ("drive-step", drive_step::read),
    ("design", design::read),
    ("design-task", design::task),
    ("campaign", campaign::read),
    ("campaign-task", campaign::task),
    ("campaign-summary", campaign::summary),
    ("fit", fit::read),
    ("fit-task", fit_task::task),
    ("replay", replay::read),
    ("mission", mission::read),
    ("mission-task", mission::task),
    ("wheel-drawing", drawing::read),
    ("scenario", document::scenario),
    ("stand", document::stand),
];

/// What there is to choose from, by their paths below `/api/`.
pub(crate) static LISTS: [(&str, List); 5] = [
    ("presets", lists::presets),
    ("documents", lists::documents),
    ("files", lists::files),
    ("campaigns", campaign::list),
    ("data-sets", fit_task::data_sets),
];
