//! The rectangle within a chart's axes, its grid, and the texts along it.

use grouser_io::escape;

use super::axis::{Axis, Tick};
use crate::sheet::{Anchor, Colour, Face, Place, Shape, Sheet, Stroke, Text, width, wrap};
use crate::style::{Ground, Role};

/// From line to line, over the height of the font.
pub(super) const LINE: f64 = 1.3;
/// The base line under the middle of capitals, over the height of the font.
pub(super) const MIDDLE: f64 = 0.36;
/// From the frame to the numbers on its left, and to those below it [mm].
const GAP: f64 = 1.4;
const BELOW: f64 = 2.0;
/// Lines of a text, at most.
const LINES: usize = 3;

/// The rectangle within the axes [mm].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Frame {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Frame {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(super) fn x(&self, axis: &Axis, number: f64) -> f64 {
        self.left + self.width * axis.share(number)
    }

    pub(super) fn y(&self, axis: &Axis, number: f64) -> f64 {
        self.bottom() - self.height * axis.share(number)
    }

    /// Lines across the frame at ticks of its horizontal axis.
    pub(super) fn upright_lines(&self, sheet: &mut Sheet, axis: &Axis) {
        for tick in &axis.ticks {
            let x = self.x(axis, tick.at);
            sheet.draw(Shape::line([[x, self.top], [x, self.bottom()]], thin(Role::Grid)));
        }
    }

    /// Lines across the frame at ticks of its vertical axis.
    pub(super) fn level_lines(&self, sheet: &mut Sheet, axis: &Axis) {
        for tick in &axis.ticks {
            let y = self.y(axis, tick.at);
            sheet.draw(Shape::line([[self.left, y], [self.right(), y]], thin(Role::Grid)));
        }
    }

    /// The two axes themselves.
    pub(super) fn edges(&self, sheet: &mut Sheet) {
        let corner = [self.left, self.bottom()];
        let ends = [[self.left, self.top], corner, [self.right(), self.bottom()]];
        sheet.draw(Shape::line(ends, Stroke::new(0.25, colour(Role::Faint))));
    }

    /// Numbers under the frame.
    pub(super) fn numbers_below(&self, sheet: &mut Sheet, axis: &Axis, size: f64) {
        for Tick { at, label } in &axis.ticks {
            let text = text(label, size, Role::Faint).anchor(Anchor::Middle);
            sheet.text(text, [self.x(axis, *at), self.bottom() + BELOW + 0.8 * size]);
        }
    }

    /// Numbers or names on the left of the frame, some in several lines.
    pub(super) fn numbers_beside(&self, sheet: &mut Sheet, axis: &Axis, size: f64) {
        for Tick { at, label } in &axis.ticks {
            let lines: Vec<&str> = label.split('\n').collect();
            let middle = self.y(axis, *at);
            for (place, line) in lines.iter().enumerate() {
                let down = (place as f64 - 0.5 * (lines.len() - 1) as f64) * LINE * size;
                let text = text(line, size, Role::Faint).anchor(Anchor::End);
                sheet.text(text, [self.left - GAP, middle + down + MIDDLE * size]);
            }
        }
    }

    /// A text in lines in the middle under the numbers.
    pub(super) fn label_below(&self, sheet: &mut Sheet, lines: &[String], size: f64) {
        let middle = self.left + 0.5 * self.width;
        let first = self.bottom() + height_below(0, size) + 0.9 * size;
        for (place, line) in lines.iter().enumerate() {
            let text = text(line, size, Role::Ink).anchor(Anchor::Middle);
            // A line that is wider than the frame begins at the edge of the sheet.
            let middle = middle.max(GAP + 0.5 * text.width());
            sheet.text(text, [middle, first + place as f64 * LINE * size]);
        }
    }
}

/// Height of the numbers under a frame and of the lines of a label under them [mm].
pub(super) fn height_below(lines: usize, size: f64) -> f64 {
    BELOW + LINE * size + lines as f64 * LINE * size
}

/// Height that names on the left of a frame need for themselves [mm].
pub(super) fn height_beside(axis: &Axis, size: f64) -> f64 {
    let most = axis.ticks.iter().map(|tick| tick.label.split('\n').count()).max().unwrap_or(0);
    (LINE * size * most as f64 + 0.5) * axis.ticks.len() as f64
}

/// Width of the numbers on the left of a frame [mm].
pub(super) fn width_beside(axis: &Axis, size: f64) -> f64 {
    let lines = axis.ticks.iter().flat_map(|tick| tick.label.split('\n'));
    GAP + lines.map(|line| width(line, Face::Regular, size)).fold(0.0, f64::max)
}

/// Lines of text one below the other.
///
/// * `at`: upper left corner
pub(super) fn write(sheet: &mut Sheet, lines: &[String], [x, y]: Place, size: f64, role: Role) {
    for (place, line) in lines.iter().enumerate() {
        sheet.text(text(line, size, role), [x, y + size * (0.8 + place as f64 * LINE)]);
    }
}

/// A text from anywhere in lines of a width, its hidden characters written out. What would need
/// more than three lines, or is a single word wider than a line, ends in `…`.
pub(super) fn lines(content: &str, size: f64, most: f64) -> Vec<String> {
    let mut lines = wrap(&escape::line(content), Face::Regular, size, most);
    if lines.len() > LINES {
        lines.truncate(LINES);
        lines[LINES - 1].push('…');
    }
    for line in &mut lines {
        if width(line, Face::Regular, size) > most {
            while line.pop().is_some() && width(line, Face::Regular, size) + 0.9 * size > most {}
            line.push('…');
        }
    }
    lines
}

pub(super) fn text(content: &str, size: f64, role: Role) -> Text {
    Text::new(content, size).colour(colour(role))
}

pub(super) fn colour(role: Role) -> Colour {
    role.on(Ground::Light)
}

/// A hairline.
pub(super) fn thin(role: Role) -> Stroke {
    Stroke::new(0.2, colour(role))
}
