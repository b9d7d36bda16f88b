//! Series within their axes.

use super::axis::{Axis, is_drawn, range};
use super::envelope::{Part, parts};
use super::frame::{Frame, colour, text};
use super::{Chart, Series, Style};
use crate::sheet::{Anchor, Colour, Place, Shape, Sheet, Stroke};
use crate::style::{Ground, Role};

/// From as many points on, marks are small.
const MANY: usize = 60;
/// Room for a mark between a frame and the datum at its edge, and how much longer lines are [mm].
const ROOM: f64 = 1.6;

/// How heavy lines and marks are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weight {
    /// In a chart by itself.
    Full,
    /// In a chart among many: thin.
    Thin,
}

/// A chart's axes in their frame.
pub(super) struct Panel<'c> {
    pub(super) chart: &'c Chart,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) frame: Frame,
    pub(super) weight: Weight,
}

impl Panel<'_> {
    /// The vertical axis of a chart in a frame.
    ///
    /// * `height`: of the frame [mm]
    /// * `size`: height of letters [mm]
    pub(super) fn y_axis(chart: &Chart, height: f64, size: f64) -> Axis {
        /// From number to number, over the height of letters.
        const APART: f64 = 2.6;
        let numbers = range(chart.extent().map(|(_, y)| y));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
        let most = (height / (APART * size)).clamp(2.0, 8.0) as usize;
        Axis::linear(numbers, most).with_room(marked(chart, |(_, y)| y), ROOM / height)
    }

    /// The horizontal axis of a chart in a frame.
    ///
    /// * `most`: intervals between numbers
    /// * `width`: of the frame [mm]
    /// * `size`: height of letters [mm]
    pub(super) fn x_axis(chart: &Chart, most: usize, width: f64, size: f64) -> Axis {
        let numbers = range(chart.extent().map(|(x, _)| x));
        let is_log = chart.log_x && numbers.is_none_or(|[low, _]| low > 0.0);
        let kind = if is_log { Axis::log } else { Axis::linear };
        let marked = marked(chart, |(x, _)| x);
        let make = |most| kind(numbers, most).with_room(marked, ROOM / width);
        Axis::fitting(most, make, width, size)
    }

    /// Where a point is; `None` for one that is missing.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Option<Place> {
        let is_there = is_drawn(x) && is_drawn(y);
        is_there.then(|| [self.frame.x(&self.x, x), self.frame.y(&self.y, y)])
    }

    /// The grid, the series, and the axes over them.
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        self.frame.upright_lines(sheet, &self.x);
        self.frame.level_lines(sheet, &self.y);
        let heights = range(self.chart.extent().map(|(_, y)| y));
        if heights.is_some_and(|[low, high]| low < 0.0 && high > 0.0) {
            let y = self.frame.y(&self.y, 0.0);
            let dashed = Stroke::new(0.25, colour(Role::Faint)).dashed(1.2, 1.0);
            sheet.draw(Shape::line([[self.frame.left, y], [self.frame.right(), y]], dashed));
        }
        // Areas lie below lines, and lines below marks.
        let depth = |series: &&Series| match series.style {
            Style::Band => 0,
            style if style.is_marks() => 2,
            _ => 1,
        };
        let mut series: Vec<&Series> = self.chart.series.iter().collect();
        series.sort_by_key(depth);
        for series in series {
            match series.style {
                Style::Band => self.band(sheet, series),
                style if style.is_marks() => self.marks(sheet, series),
                _ => self.line(sheet, series),
            }
        }
        self.frame.edges(sheet);
        if heights.is_none() {
            let Frame { left, top, width, height } = self.frame;
            let text = text("no data", 3.2, Role::Faint).anchor(Anchor::Middle);
            sheet.text(text, [left + 0.5 * width, top + 0.5 * height]);
        }
    }

    fn line(&self, sheet: &mut Sheet, series: &Series) {
        let stroke = stroke_of(series, self.weight);
        let places: Vec<Option<Place>> = series.points.iter().map(|at| self.at(*at)).collect();
        for piece in places.split(Option::is_none) {
            let piece: Vec<Place> = piece.iter().flatten().copied().collect();
            if let [only] = piece[..] {
                sheet.draw(Shape::circle(only, stroke.width, ink(series)));
            }
            for part in parts(&piece) {
                match part {
                    Part::Line(places) => sheet.draw(Shape::line(places, stroke)),
                    Part::Envelope { low, high, mean } => {
                        let around = low.into_iter().chain(high.into_iter().rev());
                        sheet.draw(Shape::area(around, ink(series).opacity(BAND)));
                        sheet.draw(Shape::line(mean, stroke));
                    }
                }
            }
        }
    }

    fn band(&self, sheet: &mut Sheet, series: &Series) {
        let edge = |(&(x, low), high): (&(f64, f64), &f64)| {
            Some((self.at((x, low))?, self.at((x, *high))?))
        };
        let edges: Vec<Option<(Place, Place)>> =
            series.points.iter().zip(&series.upper).map(edge).collect();
        for piece in edges.split(Option::is_none) {
            let (low, high): (Vec<Place>, Vec<Place>) = piece.iter().flatten().copied().unzip();
            if let ([low], [high]) = (&low[..], &high[..]) {
                let stroke = Stroke::new(1.0, ink(series).opacity(BAND));
                sheet.draw(Shape::line([*low, *high], stroke));
            } else {
                let around = low.into_iter().chain(high.into_iter().rev());
                sheet.draw(Shape::area(around, ink(series).opacity(BAND)));
            }
        }
    }

    fn marks(&self, sheet: &mut Sheet, series: &Series) {
        for [from, to] in series.bars() {
            let (Some(from), Some(to)) = (self.at(from), self.at(to)) else { continue };
            let stroke = Stroke::new(0.3, ink(series));
            sheet.draw(Shape::line([from, to], stroke));
            // Caps across the bar.
            let is_level = from[1] == to[1];
            for [x, y] in [from, to] {
                let [right, down] = if is_level { [0.0, 0.8] } else { [0.8, 0.0] };
                sheet.draw(Shape::line([[x - right, y - down], [x + right, y + down]], stroke));
            }
        }
        let many = series.points.len() > MANY;
        let (radius, hides) = match self.weight {
            Weight::Thin => (0.3, 0.5),
            Weight::Full if many => (0.75, 0.35),
            Weight::Full => (1.1, 0.6),
        };
        for place in series.points.iter().filter_map(|point| self.at(*point)) {
            let mark = mark(series, place, radius, hides);
            let edge = Stroke::new(0.25, ink(series));
            sheet.draw(if self.weight == Weight::Thin { mark } else { mark.outlined(edge) });
        }
    }
}

/// The range of a coordinate over all marks and error bars.
fn marked(chart: &Chart, coordinate: impl Fn((f64, f64)) -> f64) -> Option<[f64; 2]> {
    let marks = chart.series.iter().filter(|series| series.style.is_marks());
    range(marks.flat_map(Series::extent).map(coordinate))
}

/// The colour of a series on light ground.
pub(super) fn ink(series: &Series) -> Colour {
    let colours = crate::style::series(Ground::Light);
    colours[series.colour % colours.len()]
}

/// How much of what is below a band hides [-].
pub(super) const BAND: f64 = 0.3;

/// A mark of a series.
///
/// * `radius`: half its width [mm]
/// * `hides`: opacity of its inside [-]
pub(super) fn mark(series: &Series, [x, y]: Place, radius: f64, hides: f64) -> Shape {
    let fill = ink(series).opacity(hides);
    match series.style {
        Style::Squares => {
            let half = 0.9 * radius;
            Shape::rectangle([x - half, y - half], [2.0 * half, 2.0 * half], fill)
        }
        Style::Triangles => {
            let [top, base] = [y - 1.15 * radius, y + 0.85 * radius];
            Shape::area([[x, top], [x + 1.1 * radius, base], [x - 1.1 * radius, base]], fill)
        }
        _ => Shape::circle([x, y], radius, fill),
    }
}

/// The line of a series.
pub(super) fn stroke_of(series: &Series, weight: Weight) -> Stroke {
    let width = if weight == Weight::Thin { 0.3 } else { 0.5 };
    let stroke = Stroke::new(width, ink(series));
    match series.style {
        Style::Dashed => stroke.dashed(1.8, 1.0),
        Style::Dotted => stroke.dashed(0.6, 0.8),
        Style::DashDot => stroke.dash_dotted(2.2, 0.8, 0.6),
        _ => Stroke { round: true, ..stroke },
    }
}
