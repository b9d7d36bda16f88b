//! The names of curves beside them, in the right margin: each at the height where its curve ends,
//! as far as others leave room, with a sample of how it is drawn.

use super::axis::is_drawn;
use super::frame::{LINE, MIDDLE, lines, text, thin};
use super::panel::{BAND, Panel, Weight, ink, mark, stroke_of};
use super::{Series, Style};
use crate::labels::spread;
use crate::sheet::{Face, Place, Shape, Sheet, width};
use crate::style::Role;

/// From the frame to the sample [mm].
const GAP: f64 = 4.0;
/// Length of the sample [mm].
const SAMPLE: f64 = 5.4;
/// From the sample to the name [mm].
const BESIDE: f64 = 1.6;
/// From name to name, besides their lines [mm].
const APART: f64 = 0.8;
/// The widest name that is not broken into lines [mm].
const WIDEST: f64 = 45.0;
/// The margin on the right of a chart: past the last letter, and where nothing is named [mm].
const EDGE: f64 = 2.0;
const EMPTY: f64 = 7.0;

/// Width of the margin that the names of series need [mm].
pub(super) fn margin(series: &[Series], size: f64) -> f64 {
    let lines = series.iter().flat_map(|series| lines(&series.name, size, WIDEST));
    let widths = lines.map(|line| width(&line, Face::Regular, size));
    widths.map(|width| GAP + SAMPLE + BESIDE + width + EDGE).fold(EMPTY, f64::max)
}

/// Height of all names [mm].
pub(super) fn height(series: &[Series], size: f64) -> f64 {
    let heights = series.iter().map(|series| lines(&series.name, size, WIDEST).len());
    heights.filter(|count| *count > 0).map(|count| height_of(count, size)).sum()
}

fn height_of(lines: usize, size: f64) -> f64 {
    LINE * size * lines as f64 + APART
}

/// Writes the names beside a panel.
pub(super) fn write(sheet: &mut Sheet, panel: &Panel, size: f64) {
    let frame = panel.frame;
    let mut named: Vec<(&Series, Vec<String>, Place)> = panel
        .chart
        .series
        .iter()
        .filter(|series| !series.name.is_empty())
        .filter_map(|series| Some((series, lines(&series.name, size, WIDEST), end(series, panel)?)))
        .collect();
    named.sort_by(|one, other| one.2[1].total_cmp(&other.2[1]));
    let heights: Vec<f64> =
        named.iter().map(|(_, lines, _)| height_of(lines.len(), size)).collect();
    let wanted: Vec<f64> = named.iter().map(|(_, _, [_, y])| *y).collect();
    let spread = spread(&wanted, &heights, [frame.top, frame.bottom()]);
    let left = frame.right() + GAP;
    for ((series, lines, [x, y]), middle) in named.iter().zip(spread) {
        // A leader from a curve that ends near the margin; it would cross others from further away.
        let is_near = frame.right() - x < 0.2 * frame.width;
        if is_near && !series.style.is_marks() {
            sheet.draw(Shape::line([[x + 0.5, *y], [left - 0.5, middle]], thin(Role::Faint)));
        }
        sample(sheet, series, [left, middle]);
        let first = middle - 0.5 * LINE * size * (lines.len() as f64 - 1.0) + MIDDLE * size;
        for (line, name) in lines.iter().enumerate() {
            let place = [left + SAMPLE + BESIDE, first + LINE * size * line as f64];
            sheet.text(text(name, size, Role::Ink), place);
        }
    }
}

/// Where a series ends on the right; of a band the middle.
fn end(series: &Series, panel: &Panel) -> Option<Place> {
    let drawn = series.points.iter().enumerate().filter(|(_, (x, y))| is_drawn(*x) && is_drawn(*y));
    let (place, (x, y)) = drawn.max_by(|one, other| one.1.0.total_cmp(&other.1.0))?;
    let upper = series.upper.get(place).copied().filter(|upper| is_drawn(*upper)).unwrap_or(*y);
    panel.at((*x, y.midpoint(upper)))
}

/// How a series is drawn, left of its name.
fn sample(sheet: &mut Sheet, series: &Series, [left, y]: Place) {
    let ends = [[left, y], [left + SAMPLE, y]];
    sheet.draw(match series.style {
        Style::Band => Shape::rectangle([left, y - 1.3], [SAMPLE, 2.6], ink(series).opacity(BAND)),
        style if style.is_marks() => mark(series, [left + 0.5 * SAMPLE, y], 1.1, 0.7),
        _ => Shape::line(ends, stroke_of(series, Weight::Full)),
    });
}
