//! Horizontal bars.

use super::axis::{Axis, range};
use super::frame::{
    Frame, LINE, MIDDLE, colour, height_below, height_beside, lines, text, width_beside, write,
};
use super::{Bars, Drawable, EDGE, INTERVALS, LETTERS, PAGE, TITLE, sheet};
use crate::sheet::{Colour, Face, Shape, Sheet, width};
use crate::style::{Ground, Role, series};

/// From bar to bar, and the height of one [mm].
const APART: f64 = 9.5;
const THICK: f64 = 6.0;
/// The widest name of a bar or a part that is not broken into lines [mm].
const WIDEST: f64 = 50.0;
/// Side of the sample beside a part's name [mm].
const SAMPLE: f64 = 3.4;

impl Drawable for Bars {
    fn sheet(&self) -> Sheet {
        let title = lines(&self.title, TITLE, PAGE[0] - 2.0 * EDGE);
        let x_label = lines(&self.x_label, LETTERS, 0.6 * PAGE[0]);
        let top = EDGE + title.len() as f64 * LINE * TITLE + 2.0;
        let names = self.rows.iter().rev().map(|(name, _)| lines(name, LETTERS, WIDEST).join("\n"));
        let names = Axis::named(names);
        let left = EDGE + width_beside(&names, LETTERS);
        let legend = legend_of(self);
        let across = PAGE[0] - left - legend_width(&legend);
        let height = APART * self.rows.len().max(1) as f64;
        let height = height.max(height_beside(&names, LETTERS)).max(legend_height(&legend));
        let frame = Frame { left, top, width: across, height };
        let ends = range(pieces(self).flat_map(|piece| [piece.from, piece.to]).chain([0.0]));
        let ends = ends.filter(|[low, high]| low < high).or(Some([0.0, 1.0]));
        let x = Axis::fitting(INTERVALS, |most| Axis::linear(ends, most), across, LETTERS);

        let below = height_below(x_label.len(), LETTERS) + EDGE;
        let mut sheet = sheet(&self.title, [PAGE[0], top + height + below]);
        write(&mut sheet, &title, [EDGE, EDGE], TITLE, Role::Ink);
        frame.upright_lines(&mut sheet, &x);
        for piece in pieces(self) {
            let middle = frame.y(&names, (self.rows.len() - piece.row) as f64);
            let [from, to] = [piece.from, piece.to].map(|end| frame.x(&x, end));
            let (place, size) = ([from.min(to), middle - 0.5 * THICK], [(to - from).abs(), THICK]);
            sheet.draw(Shape::rectangle(place, size, colour_of(self, piece.part)));
        }
        frame.edges(&mut sheet);
        frame.numbers_below(&mut sheet, &x, LETTERS);
        frame.numbers_beside(&mut sheet, &names, LETTERS);
        frame.label_below(&mut sheet, &x_label, LETTERS);
        write_legend(&mut sheet, &legend, [frame.right() + 4.0, top]);
        sheet
    }
}

/// All parts of all bars that have a length.
fn pieces(bars: &Bars) -> impl Iterator<Item = Piece> {
    bars.rows.iter().enumerate().flat_map(|(row, (_, lengths))| {
        // Where the parts above zero, and those below, have come to.
        let mut ends = [0.0, 0.0];
        let piece = move |(part, length): (usize, &f64)| {
            let end = &mut ends[usize::from(*length < 0.0)];
            let from = *end;
            *end += length;
            Piece { row, part, from, to: *end }
        };
        let lengths = lengths.iter().enumerate();
        lengths.filter(|(_, length)| length.is_finite() && **length != 0.0).map(piece)
    })
}

fn colour_of(bars: &Bars, part: usize) -> Colour {
    if bars.has_rest && part + 1 == bars.parts.len() {
        return colour(Role::Grid);
    }
    // Black is for text.
    let colours = series(Ground::Light);
    colours[1 + part % (colours.len() - 1)]
}

/// The parts' names in lines with their colours; none where there is one part.
fn legend_of(bars: &Bars) -> Vec<(Vec<String>, Colour)> {
    let named = bars.parts.iter().enumerate().filter(|_| bars.parts.len() > 1);
    named.map(|(part, name)| (lines(name, LETTERS, WIDEST), colour_of(bars, part))).collect()
}
/// A part of a bar.
struct Piece {
    row: usize,
    part: usize,
    from: f64,
    to: f64,
}

fn legend_width(legend: &[(Vec<String>, Colour)]) -> f64 {
    let lines = legend.iter().flat_map(|(lines, _)| lines);
    let widths = lines.map(|line| width(line, Face::Regular, LETTERS));
    widths.map(|width| 4.0 + SAMPLE + 1.6 + width + EDGE).fold(7.0, f64::max)
}

fn legend_height(legend: &[(Vec<String>, Colour)]) -> f64 {
    legend.iter().map(|(lines, _)| height_of(lines)).sum()
}

fn height_of(lines: &[String]) -> f64 {
    lines.len().max(1) as f64 * LINE * LETTERS + 1.2
}

/// * `at`: upper left corner
fn write_legend(sheet: &mut Sheet, legend: &[(Vec<String>, Colour)], [left, mut top]: [f64; 2]) {
    for (lines, colour) in legend {
        let middle = top + 0.5 * LINE * LETTERS;
        let corner = [left, middle - 0.5 * SAMPLE];
        sheet.draw(Shape::rectangle(corner, [SAMPLE, SAMPLE], *colour));
        for (place, line) in lines.iter().enumerate() {
            let y = middle + (MIDDLE + LINE * place as f64) * LETTERS;
            sheet.text(text(line, LETTERS, Role::Ink), [left + SAMPLE + 1.6, y]);
        }
        top += height_of(lines);
    }
}
