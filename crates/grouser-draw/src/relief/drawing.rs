//! Marks and the text over them.

use crate::sheet::{Sheet, Text};

use super::labels::LETTERS;
use crate::marks::Mark;
use crate::scene::Label;
use crate::style::Ground;

/// Marks, and the text over them.
#[derive(Default)]
pub(super) struct Drawing {
    pub(super) marks: Vec<Mark>,
    pub(super) labels: Vec<Label>,
}

impl Drawing {
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        for mark in &self.marks {
            mark.draw(sheet, Ground::Light);
        }
        for Label { text, at, anchor, role } in &self.labels {
            let text = Text::new(text, LETTERS).colour(role.on(Ground::Light));
            sheet.text(text.anchor(*anchor), *at);
        }
    }
}
