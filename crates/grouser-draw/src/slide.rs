//! An answer for a slide: one sentence, one picture, and in small print what it is of.

use grouser_io::answer::{Answer, PageBlock};
use grouser_io::escape;
use grouser_io::reading;

use crate::chart::Drawable;
use crate::sheet::{Face, Sheet, Text, wrap};
use crate::style::{Ground, Role};

/// Width and height [mm]: 16 to 9.
const SIZE: [f64; 2] = [320.0, 180.0];
/// Around all [mm].
const EDGE: f64 = 12.0;
/// Heights of letters of the sentence [mm]: the largest with which it has no more than [`LINES`].
const SENTENCE: [f64; 4] = [11.0, 9.0, 7.5, 6.0];
const LINES: usize = 3;
/// Height of letters of the small print [mm].
const SMALL: f64 = 3.6;
/// From line to line, over the height of the font.
const LINE: f64 = 1.3;

/// A slide.
#[derive(Clone, Copy, Debug)]
pub struct Slide<'s> {
    /// What it says.
    pub sentence: &'s str,
    /// What shows it.
    pub picture: &'s Sheet,
    /// What it is of and how to have it again: a line each, or several where it is long.
    pub small_print: &'s [String],
}

impl Slide<'_> {
    /// The slide of an answer on a sheet.
    ///
    /// * `says`: of it the first sentence is taken
    /// * `whose`: rover and soil
    /// * `command`: gives the answer again
    #[must_use]
    pub fn of_answer(says: &str, picture: &Sheet, whose: &str, command: String) -> Sheet {
        let small_print = [format!("{whose}; grouser {}", env!("CARGO_PKG_VERSION")), command];
        let sentence = reading::sentence(first_sentence(says));
        Slide { sentence: &sentence, picture, small_print: &small_print }.sheet()
    }

    /// What an answer that has a page says first.
    #[must_use]
    pub fn sentence_of(answer: &Answer) -> &str {
        let verdict = answer.blocks().find_map(|block| match block {
            PageBlock::Verdict(text) => Some(text.as_str()),
            _ => None,
        });
        verdict.unwrap_or(&answer.title)
    }

    /// The first figure of an answer that has a page.
    #[must_use]
    pub fn picture_of(answer: &Answer) -> Option<Sheet> {
        answer.blocks().find_map(|block| match block {
            PageBlock::Figure { figure, .. } => Some(figure.sheet()),
            PageBlock::Charts(charts) => charts.first().map(Drawable::sheet),
            _ => None,
        })
    }

    /// The slide on a sheet.
    #[must_use]
    pub fn sheet(&self) -> Sheet {
        let sentence = escape::line(self.sentence);
        let across = SIZE[0] - 2.0 * EDGE;
        let (size, lines) = fitted(&sentence, across);
        let mut sheet = Sheet::new(&sentence, SIZE[0], SIZE[1]).on(Role::Paper.on(Ground::Light));
        let mut top = EDGE;
        for line in &lines {
            let text = Text::new(line, size).face(Face::Bold).colour(Role::Ink.on(Ground::Light));
            sheet.text(text, [EDGE, top + 0.8 * size]);
            top += LINE * size;
        }
        let small: Vec<String> = self
            .small_print
            .iter()
            .flat_map(|line| wrap(&escape::line(line), Face::Regular, SMALL, across))
            .collect();
        let foot = SIZE[1] - EDGE - small.len() as f64 * LINE * SMALL;
        for (place, line) in small.iter().enumerate() {
            let text = Text::new(line, SMALL).colour(Role::Faint.on(Ground::Light));
            sheet.text(text, [EDGE, foot + (place as f64 + 0.8) * LINE * SMALL]);
        }
        let room = [across, (foot - top - 7.0).max(10.0)];
        let [width, height] = self.picture.size();
        let scale = (room[0] / width).min(room[1] / height);
        let left = EDGE + 0.5 * (room[0] - scale * width);
        sheet.place(self.picture, [left, top + 3.0], scale);
        sheet
    }
}

/// The first of several sentences: a full stop before a space and a capital ends it.
fn first_sentence(text: &str) -> &str {
    let begins = |rest: &str| rest.chars().next().is_some_and(char::is_uppercase);
    let end = text.match_indices(". ").find(|(at, stop)| begins(&text[at + stop.len()..]));
    end.map_or(text, |(at, _)| &text[..at])
}

/// The sentence in lines, with the height of their letters.
fn fitted(sentence: &str, across: f64) -> (f64, Vec<String>) {
    let of = |size: f64| (size, wrap(sentence, Face::Bold, size, across));
    let smallest = of(SENTENCE[SENTENCE.len() - 1]);
    SENTENCE.into_iter().map(of).find(|(_, lines)| lines.len() <= LINES).unwrap_or(smallest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::{BLACK, Cells, Shape, Stroke, WHITE};

    fn picture() -> Sheet {
        let mut sheet = Sheet::new("a picture", 100.0, 50.0);
        sheet.draw(Shape::rectangle([0.0; 2], [100.0, 50.0], BLACK).outlined(Stroke::black(1.0)));
        sheet.cells(Cells::new([10.0, 10.0], [20.0, 10.0], 2, [Some(WHITE), None]));
        sheet.text(Text::new("inside", 5.0), [50.0, 25.0]);
        sheet
    }

    /// A picture of 2 to 1 is as high as the room between the sentence and the small print.
    #[test]
    fn the_picture_is_between_the_sentence_and_the_small_print() {
        let small = ["a rover on sand".to_owned(), "grouser heading".to_owned()];
        let slide = Slide { sentence: "Go.", picture: &picture(), small_print: &small };
        let sheet = slide.sheet();
        assert_eq!(sheet.size(), [320.0, 180.0]);
        let picture = sheet.to_picture(1.0);
        let is_black = |x: u32, y: u32| picture.pixels[(y * 320 + x) as usize] == [0; 3];
        assert!(is_black(160, 100) && !is_black(20, 100) && !is_black(300, 100));
        let svg = sheet.to_svg();
        for text in ["Go.", "inside", "a rover on sand", "grouser heading"] {
            assert!(svg.contains(&format!(">{text}</text>")), "{text}");
        }
    }

    #[test]
    fn the_first_sentence_ends_before_a_capital() {
        assert_eq!(first_sentence("go 4.2 % of 9 cells. A heading holds."), "go 4.2 % of 9 cells");
        assert_eq!(first_sentence("at x 2. m after 3 s."), "at x 2. m after 3 s.");
    }

    #[test]
    fn a_long_sentence_has_smaller_letters() {
        let of = |words: usize| fitted(&"heading ".repeat(words), 296.0);
        assert_eq!(of(3).0, SENTENCE[0]);
        assert!(of(30).0 < SENTENCE[0] && of(30).1.len() <= LINES);
        assert_eq!(of(300).0, SENTENCE[3]);
    }
}
