//! Figures as data: axes, curves, bands and marks in their own units. What draws them gives them
//! round numbers, colours and places.
//!
//! ```
//! use grouser_io::figure::{Chart, Series, Style};
//!
//! let pull = Series::new("dry sand", Style::Line, 1, [(0.0, -2.0), (0.2, 5.0), (0.4, 8.0)]);
//! let chart = Chart::new("Drawbar pull", ("slip ratio", "drawbar pull [N]"), vec![pull]);
//! assert_eq!(chart.series[0].points.len(), 3);
//! ```

mod over;
mod series;

use grouser_core::wheel::Wheel;

pub use self::over::{axis, by_part, by_unit};
pub use self::series::{BAND_COLOUR, Series, Style};

/// A figure of any kind.
#[derive(Clone, Debug)]
pub enum Figure {
    /// Axes and series.
    Chart(Chart),
    /// A table in colours.
    HeatMap(HeatMap),
    /// Horizontal bars.
    Bars(Bars),
    /// Small charts side by side.
    Grid(Grid),
    /// Wheels side by side.
    Wheels(WheelRow),
}

/// A chart: axes and series.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The chart's title.
    pub title: String,
    /// Horizontal quantity and unit.
    pub x_label: String,
    /// Vertical quantity and unit.
    pub y_label: String,
    /// Curves and points, drawn in this order, but for points, which lie above curves.
    pub series: Vec<Series>,
    /// Whether the horizontal axis is logarithmic, if all its numbers are above zero.
    pub log_x: bool,
    /// What stands at 1, 2, … on the vertical axis instead of numbers, from the bottom up.
    pub y_names: Vec<String>,
}

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
        Self { log_x: true, ..self }
    }

    /// The same with names at 1, 2, … of the vertical axis, from the bottom up.
    #[must_use]
    pub fn with_y_names(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { y_names: names.into_iter().collect(), ..self }
    }

    /// All points that must lie within the axes.
    pub fn extent(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series.iter().flat_map(Series::extent)
    }
}

/// A table in colours: a value for each row and column, or none, which stays grey.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// What it shows, with the unit.
    pub title: String,
    /// Quantity and unit of the columns.
    pub x_label: String,
    /// What the columns are.
    pub columns: Vec<f64>,
    /// Quantity and unit of the rows.
    pub y_label: String,
    /// What the rows are, from the bottom up.
    pub rows: Vec<f64>,
    /// Row by row.
    pub values: Vec<Vec<Option<f64>>>,
}

/// Horizontal bars, each of parts that are laid end to end: those above zero to the right, others
/// to the left.
#[derive(Clone, Debug)]
pub struct Bars {
    /// What they show.
    pub title: String,
    /// Quantity and unit along them.
    pub x_label: String,
    /// The names of the parts, in their order.
    pub parts: Vec<String>,
    /// Whether the last part is what is left over: it is grey.
    pub has_rest: bool,
    /// From the top down: of each a name, and the length of each part.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// Small charts in rows and columns, some places empty, without names of curves. Below each other
/// they have their numbers once where their horizontal axes are the same.
#[derive(Clone, Debug)]
pub struct Grid {
    /// What they show.
    pub title: String,
    /// Row by row.
    pub cells: Vec<Vec<Option<Chart>>>,
}

/// Wheels in their soil beside each other, to one scale, from their sides and from behind.
#[derive(Clone, Debug)]
pub struct WheelRow {
    /// What they show.
    pub title: String,
    /// From the left.
    pub wheels: Vec<WheelShape>,
}

/// A wheel that is drawn.
#[derive(Clone, Debug)]
pub struct WheelShape {
    /// The wheel.
    pub wheel: Wheel,
    /// Its sinkage [m].
    pub sinkage: f64,
    /// What is said of it, a line each.
    pub lines: Vec<String>,
}

impl From<Chart> for Figure {
    fn from(chart: Chart) -> Self {
        Self::Chart(chart)
    }
}

impl From<HeatMap> for Figure {
    fn from(map: HeatMap) -> Self {
        Self::HeatMap(map)
    }
}

impl From<Bars> for Figure {
    fn from(bars: Bars) -> Self {
        Self::Bars(bars)
    }
}

impl From<WheelRow> for Figure {
    fn from(wheels: WheelRow) -> Self {
        Self::Wheels(wheels)
    }
}

impl From<Grid> for Figure {
    fn from(grid: Grid) -> Self {
        Self::Grid(grid)
    }
}
