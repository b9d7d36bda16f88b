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
mod staged;
mod wheel_test;

use crate::folder::Folder;
use crate::refusal::Refusal;
use crate::runs::GoOn;
use crate::server::Console;

/// Reads a question.
pub(crate) type Read = fn(&Folder, &[u8]) -> Result<Question, Refusal>;

/// Lists what there is, as a line.
pub(crate) type List = fn(&Console) -> String;

/// Takes a line; whether somebody reads it.
pub(crate) type Send<'a> = &'a dyn Fn(String) -> bool;

/// A question.
pub(crate) struct Question(Box<Answering>);

/// What answers a question.
type Answering = dyn FnOnce(&GoOn, Send<'_>) -> Result<(), Refusal>;

impl Question {
    fn new(answer: impl FnOnce(&GoOn, Send<'_>) -> Result<(), Refusal> + 'static) -> Self {
        Self(Box::new(answer))
    }

    /// Computes the answer, and sends it line by line.
    pub(crate) fn answer(self, go_on: &GoOn, send: Send<'_>) -> Result<(), Refusal> {
        (self.0)(go_on, send)
    }
}

/// The questions, by their paths below `/api/`: those of answers have the names of the program's
/// commands.
pub(crate) static QUESTIONS: [(&str, Read); 6] = [
    ("heading", heading::read),
    ("heading-map", heading_map::read),
    ("wheel-test", wheel_test::read),
    ("wheel-drawing", drawing::read),
    ("scenario", document::scenario),
    ("stand", document::stand),
];

/// What there is to choose from, by their paths below `/api/`.
pub(crate) static LISTS: [(&str, List); 2] =
    [("presets", lists::presets), ("documents", lists::documents)];
