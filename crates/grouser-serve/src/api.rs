//! What the page, and other programs, may ask. Each question is JSON in the words of documents and
//! columns; its answer is lines of JSON.

mod command;
mod document;
mod drawing;
mod fields;
mod heading;
mod heading_map;
mod lists;
mod parts;
mod rule;
mod staged;
mod wheel_test;

#[cfg(feature = "server")]
mod campaign;
#[cfg(feature = "server")]
mod card;
#[cfg(feature = "server")]
mod design;
#[cfg(feature = "server")]
mod drive_step;
#[cfg(feature = "server")]
mod fit;
#[cfg(feature = "server")]
mod fit_task;
#[cfg(feature = "server")]
mod ground;
#[cfg(feature = "server")]
mod map;
#[cfg(feature = "server")]
mod mission;
#[cfg(feature = "server")]
mod place;
#[cfg(feature = "server")]
mod replay;
#[cfg(feature = "server")]
mod route;
#[cfg(feature = "server")]
mod traverse;

use grouser::document::json;
use serde_json::json;

use crate::asked::Read;
use crate::console::Console;

/// Lists what there is, as a line.
pub(crate) type List = fn(&Console) -> String;

/// The questions, by their paths below `/api/`: those of answers have the names of the program's
/// commands.
pub(crate) static QUESTIONS: &[(&str, Read)] = &[
    ("heading", heading::read),
    ("heading-map", heading_map::read),
    ("wheel-test", wheel_test::read),
    ("wheel-drawing", drawing::read),
    ("scenario", document::scenario),
    ("stand", document::stand),
];

/// The question of the operator's card, which something else draws, if anything does.
#[cfg(feature = "server")]
pub(crate) const CARD: &str = "card";

/// Those that open files of a folder, or take long.
#[cfg(feature = "server")]
pub(crate) static OF_FOLDERS: &[(&str, Read)] = &[
    ("map", map::read),
    ("map-place", place::read),
    ("route", route::read),
    (CARD, card::read),
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
];

/// What there is to choose from, by their paths below `/api/`.
pub(crate) static LISTS: &[(&str, List)] = &[
    ("presets", lists::presets),
    ("documents", lists::documents),
    ("files", lists::files),
    ("questions", questions),
    #[cfg(feature = "server")]
    ("campaigns", campaign::list),
    #[cfg(feature = "server")]
    ("data-sets", fit_task::data_sets),
];

/// The questions that are answered here: that of the card where something draws it.
#[cfg_attr(
    not(feature = "server"),
    expect(unused_variables, reason = "without a server nothing draws cards")
)]
fn questions(console: &Console) -> String {
    let names = QUESTIONS.iter().map(|(name, _)| *name);
    #[cfg(feature = "server")]
    let names = names
        .chain(OF_FOLDERS.iter().map(|(name, _)| *name))
        .filter(|name| *name != CARD || console.card.is_some());
    let rows: Vec<_> = names.map(|name| json!({ "name": name })).collect();
    json::line(&json!({ "schema": "grouser.questions.v1", "rows": rows })) + "\n"
}
