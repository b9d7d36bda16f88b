//! Charts: axes, series and marks as data, drawn on a [`Sheet`] in one style.
//!
//! A curve has its name at its end, in the right margin, and no legend stands in a box. Colours
//! stay apart for colour-blind eyes; dashes, shapes and names distinguish in grey. A chart brings
//! its colours for a dark screen.
//!
//! ```
//! use grouser_draw::chart::{Chart, Series, Style};
//!
//! let pull = Series::new("dry sand", Style::Line, 1, [(0.0, -2.0), (0.2, 5.0), (0.4, 8.0)]);
//! let chart = Chart::new("Drawbar pull", ("slip ratio", "drawbar pull [N]"), vec![pull]);
//! assert!(chart.to_svg().contains(">dry sand</text>"));
//! ```

mod axis;
mod bars;
mod colour_bar;
mod data;
mod frame;
mod grid;
mod heat_map;
mod names;
mod panel;
mod series;

use grouser_io::escape;

pub use self::bars::Bars;
pub(crate) use self::colour_bar::colour_bar;
pub use self::data::Chart;
pub use self::grid::Grid;
pub use self::heat_map::HeatMap;
pub use self::series::{BAND_COLOUR, Series, Style};

use self::axis::{Axis, range};
use self::frame::{Frame, LINE, height_below, height_beside, lines, width_beside, write};
use self::panel::{Panel, Weight};
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

impl Chart {
    /// A chart with linear axes.
    ///
    /// * `axes`: quantity and unit of the horizontal and of the vertical axis
    pub fn new(
        title: impl Into<String>,
        axes: (impl Into<String>, impl Into<String>),
        series: Vec<Series>,
    ) -> Self {
        let (log_x, y_names) = (false, Vec::new());
        let (x_label, y_label) = (axes.0.into(), axes.1.into());
        Self { title: title.into(), x_label, y_label, series, log_x, y_names }
    }

    /// The same with a logarithmic horizontal axis, if all its numbers are above zero.
    #[must_use]
    pub fn with_log_x(self) -> Self {
        let log_x = range(self.extent().map(|(x, _)| x)).is_none_or(|[low, _]| low > 0.0);
        Self { log_x, ..self }
    }

    /// The same with names at 1, 2, … of the vertical axis, from the bottom up.
    #[must_use]
    pub fn with_y_names(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { y_names: names.into_iter().collect(), ..self }
    }

    /// The chart as a stand-alone SVG document, as wide as a page.
    #[must_use]
    pub fn to_svg(&self) -> String {
        on_both_grounds(&self.sheet(PAGE))
    }

    /// The same for one chart among many: less wide.
    #[must_use]
    pub fn to_small_svg(&self) -> String {
        on_both_grounds(&self.sheet(SMALL))
    }

    /// The chart on a sheet of a size [mm]; the sheet is higher where names need more room.
    fn sheet(&self, [width, height]: [f64; 2]) -> Sheet {
        let title = lines(&self.title, TITLE, width - 2.0 * EDGE);
        let y_label = lines(&self.y_label, LETTERS, width - 2.0 * EDGE);
        let x_label = lines(&self.x_label, LETTERS, 0.6 * width);
        let under_title = EDGE + title.len() as f64 * LINE * TITLE;
        let top = under_title + y_label.len() as f64 * LINE * LETTERS + 2.0;
        let below = height_below(x_label.len(), LETTERS) + EDGE;
        let inside = (height - top - below).max(names::height(&self.series, LETTERS));
        let y = self.y_axis(inside, 0.35 * width);
        let inside = inside.max(self.height_of_names(&y));
        let left = EDGE + width_beside(&y, LETTERS);
        let across = width - left - names::margin(&self.series, LETTERS);
        let x = Panel::x_axis(self, INTERVALS, across, LETTERS);
        let frame = Frame { left, top, width: across, height: inside };

        let mut sheet = sheet(&self.title, [width, top + inside + below]);
        write(&mut sheet, &title, [EDGE, EDGE], TITLE, Role::Ink);
        write(&mut sheet, &y_label, [EDGE, under_title], LETTERS, Role::Ink);
        let panel = Panel { chart: self, x, y, frame, weight: Weight::Full };
        panel.draw(&mut sheet);
        frame.numbers_below(&mut sheet, &panel.x, LETTERS);
        frame.numbers_beside(&mut sheet, &panel.y, LETTERS);
        frame.label_below(&mut sheet, &x_label, LETTERS);
        names::write(&mut sheet, &panel, LETTERS);
        sheet
    }

    /// Height that names along the vertical axis need [mm].
    fn height_of_names(&self, y: &Axis) -> f64 {
        if self.y_names.is_empty() { 0.0 } else { height_beside(y, LETTERS) }
    }

    /// * `height`: of the frame [mm]
    /// * `widest`: of its names [mm]
    fn y_axis(&self, height: f64, widest: f64) -> Axis {
        if self.y_names.is_empty() {
            return Panel::y_axis(self, height, LETTERS);
        }
        Axis::named(self.y_names.iter().map(|name| lines(name, LETTERS, widest).join("\n")))
    }
}

/// An empty sheet of a size [mm].
fn sheet(title: &str, [width, height]: [f64; 2]) -> Sheet {
    Sheet::new(&escape::line(title), width, height).on(Role::Paper.on(Ground::Light))
}

#[cfg(test)]
mod tests;
