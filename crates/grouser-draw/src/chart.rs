//! Figures, which are data (`grouser_io::figure`), drawn on a [`Sheet`] in one style.
//!
//! A curve has its name at its end, in the right margin, and no legend stands in a box. Colours
//! stay apart for colour-blind eyes; dashes, shapes and names distinguish in grey. A chart brings
//! its colours for a dark screen.
//!
//! ```
//! use grouser_draw::chart::{Chart, Drawable, Series, Style};
//!
//! let pull = Series::new("dry sand", Style::Line, 1, [(0.0, -2.0), (0.2, 5.0), (0.4, 8.0)]);
//! let chart = Chart::new("Drawbar pull", ("slip ratio", "drawbar pull [N]"), vec![pull]);
//! assert!(chart.to_svg().contains(">dry sand</text>"));
//! ```

mod axis;
mod bars;
mod colour_bar;
mod envelope;
mod frame;
mod grid;
mod heat_map;
mod names;
mod panel;

use grouser_io::escape;
pub use grouser_io::figure::{BAND_COLOUR, Bars, Chart, Figure, Grid, HeatMap, Series, Style};

pub(crate) use self::colour_bar::colour_bar;

use self::axis::Axis;
use self::frame::{Frame, LINE, height_below, height_beside, lines, width_beside, write};
use self::panel::{Panel, Weight};
use crate::drawings;
use crate::sheet::Sheet;
use crate::style::{Ground, Role, on_both_grounds};

/// Width and height of a drawing as wide as a page [mm].
const PAGE: [f64; 2] = [200.0, 113.0];
/// The same of one among many.
const SMALL: [f64; 2] = [122.0, 76.0];
/// Height of letters, and of those of titles [mm].
const LETTERS: f64 = 3.2;
const TITLE: f64 = 4.2;
/// Around all [mm].
const EDGE: f64 = 2.0;
/// Intervals between numbers along a horizontal axis, at most.
const INTERVALS: usize = 10;

/// A figure that can be drawn.
pub trait Drawable {
    /// The figure on a sheet as wide as a page.
    fn sheet(&self) -> Sheet;

    /// The figure as a stand-alone SVG document, as wide as a page.
    #[must_use]
    fn to_svg(&self) -> String {
        on_both_grounds(&self.sheet())
    }
}

impl Drawable for Figure {
    fn sheet(&self) -> Sheet {
        match self {
            Self::Chart(chart) => chart.sheet(),
            Self::HeatMap(map) => map.sheet(),
            Self::Bars(bars) => bars.sheet(),
            Self::Grid(grid) => grid.sheet(),
            Self::Wheels(wheels) => drawings::wheels_in_a_row(wheels),
        }
    }
}

impl Drawable for Chart {
    fn sheet(&self) -> Sheet {
        sheet_of(self, PAGE)
    }
}

/// A chart among many as an SVG document, less wide than a page.
#[must_use]
pub fn small_svg(chart: &Chart) -> String {
    on_both_grounds(&sheet_of(chart, SMALL))
}

/// The chart on a sheet of a size [mm]; the sheet is higher where names need more room.
fn sheet_of(chart: &Chart, [width, height]: [f64; 2]) -> Sheet {
    let title = lines(&chart.title, TITLE, width - 2.0 * EDGE);
    let y_label = lines(&chart.y_label, LETTERS, width - 2.0 * EDGE);
    let x_label = lines(&chart.x_label, LETTERS, 0.6 * width);
    let under_title = EDGE + title.len() as f64 * LINE * TITLE;
    let top = under_title + y_label.len() as f64 * LINE * LETTERS + 2.0;
    let below = height_below(x_label.len(), LETTERS) + EDGE;
    let inside = (height - top - below).max(names::height(&chart.series, LETTERS));
    let y = y_axis(chart, inside, 0.35 * width);
    let inside = inside.max(height_of_names(chart, &y));
    let left = EDGE + width_beside(&y, LETTERS);
    let across = width - left - names::margin(&chart.series, LETTERS);
    let x = Panel::x_axis(chart, INTERVALS, across, LETTERS);
    let frame = Frame { left, top, width: across, height: inside };

    let mut sheet = sheet(&chart.title, [width, top + inside + below]);
    write(&mut sheet, &title, [EDGE, EDGE], TITLE, Role::Ink);
    write(&mut sheet, &y_label, [EDGE, under_title], LETTERS, Role::Ink);
    let panel = Panel { chart, x, y, frame, weight: Weight::Full };
    panel.draw(&mut sheet);
    frame.numbers_below(&mut sheet, &panel.x, LETTERS);
    frame.numbers_beside(&mut sheet, &panel.y, LETTERS);
    frame.label_below(&mut sheet, &x_label, LETTERS);
    names::write(&mut sheet, &panel, LETTERS);
    sheet
}

/// Height that names along the vertical axis need [mm].
fn height_of_names(chart: &Chart, y: &Axis) -> f64 {
    if chart.y_names.is_empty() { 0.0 } else { height_beside(y, LETTERS) }
}

/// * `height`: of the frame [mm]
/// * `widest`: of its names [mm]
fn y_axis(chart: &Chart, height: f64, widest: f64) -> Axis {
    if chart.y_names.is_empty() {
        return Panel::y_axis(chart, height, LETTERS);
    }
    Axis::named(chart.y_names.iter().map(|name| lines(name, LETTERS, widest).join("\n")))
}

/// An empty sheet of a size [mm].
fn sheet(title: &str, [width, height]: [f64; 2]) -> Sheet {
    Sheet::new(&escape::line(title), width, height).on(Role::Paper.on(Ground::Light))
}

#[cfg(test)]
mod tests;
