//! The names of curves beside them, in the right margin: each at the height where its curve ends, as far as
//! others leave room, with a sample of how it is drawn.

use grouser_page::{Face, width, wrap};
use grouser_pictures::labels::spread;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

use super::series::{Series, Style};
use super::style::{LETTERS, faint, ink, label};

/// From the plot to the sample [px].
const GAP: f64 = 14.0;
/// Length of the sample [px].
const SAMPLE: f64 = 20.0;
/// From line to line [px].
const LINE: f64 = 15.0;
/// From name to name, besides their lines [px].
const APART: f64 = 4.0;
/// The widest name that is not broken into lines [px].
const WIDEST: f64 = 170.0;
/// The margin where nothing is named [px].
const EMPTY: f64 = 24.0;

/// The margin that the names need [px].
pub(super) fn margin(series: &[Series]) -> f64 {
    let lines = series.iter().flat_map(lines);
    lines.map(|line| GAP + SAMPLE + 6.0 + text_width(&line) + 10.0).fold(EMPTY, f64::max)
}

/// Writes the names into a drawing.
pub(super) fn add(scene: &mut Scene, places: &ComputedLayout, series: &[Series]) {
    let right = places.width - places.margin_right;
    let [top, bottom] = [places.margin_top, places.height - places.margin_bottom];
    let mut named: Vec<(&Series, Vec<String>, [f64; 2])> = series
        .iter()
        .filter(|series| !series.name.is_empty())
        .filter_map(|series| {
            let (x, y) = end(series)?;
            Some((series, lines(series), [places.map_x(x), places.map_y(y).clamp(top, bottom)]))
        })
        .collect();
    named.sort_by(|one, other| one.2[1].total_cmp(&other.2[1]));
    let heights: Vec<f64> =
        named.iter().map(|(_, lines, _)| LINE * lines.len() as f64 + APART).collect();
    let wanted: Vec<f64> = named.iter().map(|(_, _, [_, y])| *y).collect();
    let spread = spread(&wanted, &heights, [top, bottom]);
    let left = right + GAP;
    for ((series, lines, [x, y]), middle) in named.iter().zip(spread) {
        // A leader from a curve that ends near the margin; it would cross others from further away.
        let is_near = right - x < 0.2 * (right - places.margin_left);
        if is_near && !series.style.is_marks() {
            scene.add(Primitive::Line {
                x1: *x + 2.0,
                y1: *y,
                x2: left - 2.0,
                y2: middle,
                stroke: Color::from(faint()),
                stroke_width: 0.6,
                stroke_dasharray: None,
            });
        }
        sample(scene, series, [left, middle]);
        let first = middle - LINE * (lines.len() as f64 - 1.0) / 2.0 + 4.0;
        for (line, text) in lines.iter().enumerate() {
            scene.add(Primitive::Text {
                x: left + SAMPLE + 6.0,
                y: first + LINE * line as f64,
                content: label(text),
                size: LETTERS,
                anchor: TextAnchor::Start,
                rotate: None,
                bold: false,
                color: Some(Color::from(ink())),
            });
        }
    }
}

/// Where a series ends on the right; of a band the middle.
fn end(series: &Series) -> Option<(f64, f64)> {
    let finite = series.points.iter().enumerate().filter(|(_, (x, y))| (x + y).is_finite());
    let (place, (x, y)) = finite.max_by(|one, other| one.1.0.total_cmp(&other.1.0))?;
    let upper = series.upper.get(place).copied().filter(|upper| upper.is_finite()).unwrap_or(*y);
    Some((*x, f64::midpoint(*y, upper)))
}

/// A name in lines; none for an empty one.
fn lines(series: &Series) -> Vec<String> {
    wrap(&series.name, Face::Regular, f64::from(LETTERS) * WIDER, WIDEST)
}

/// How wide a text may become [px].
fn text_width(text: &str) -> f64 {
    width(text, Face::Regular, f64::from(LETTERS)) * WIDER
}

/// The measured font is a condensed one; those of browsers are wider.
const WIDER: f64 = 1.12;

/// How a series is drawn, left of its name.
fn sample(scene: &mut Scene, series: &Series, [left, y]: [f64; 2]) {
    let colour = Color::from(series.colour());
    let middle = left + SAMPLE / 2.0;
    let line = |dashes: Option<&str>| Primitive::Line {
        x1: left,
        y1: y,
        x2: left + SAMPLE,
        y2: y,
        stroke: colour.clone(),
        stroke_width: 2.0,
        stroke_dasharray: dashes.map(str::to_owned),
    };
    let rectangle = |width: f64, height: f64, opacity: f64| Primitive::Rect {
        x: middle - width / 2.0,
        y: y - height / 2.0,
        width,
        height,
        fill: colour.clone(),
        stroke: None,
        stroke_width: None,
        opacity: Some(opacity),
    };
    scene.add(match series.style {
        Style::Line => line(None),
        Style::Dashed => line(Some("6 3")),
        Style::Dotted => line(Some("2 3")),
        Style::DashDot => line(Some("7 3 2 3")),
        Style::Band => rectangle(SAMPLE, 10.0, 0.3),
        Style::Dots => Primitive::Circle {
            cx: middle,
            cy: y,
            r: 4.5,
            fill: colour,
            fill_opacity: Some(0.7),
            stroke: None,
            stroke_width: None,
        },
        Style::Squares => rectangle(8.0, 8.0, 0.7),
        Style::Triangles => Primitive::Path(Box::new(PathData {
            d: format!("M{} {}l5 9h-10z", middle, y - 5.0),
            fill: Some(colour.clone()),
            stroke: colour,
            stroke_width: 0.0,
            opacity: Some(0.7),
            stroke_dasharray: None,
        })),
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_is_named_in_its_middle() {
        let band = Series::band("b", 1, [(0.0, 0.0, 1.0), (1.0, 2.0, 4.0), (2.0, f64::NAN, 1.0)]);
        assert_eq!(end(&band), Some((1.0, 3.0)));
    }
}
