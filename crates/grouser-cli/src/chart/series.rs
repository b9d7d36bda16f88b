//! Curves, points and bands of a chart.

use kuva::plot::band::BandPlot;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::plots::Plot;

use super::style::colours;

/// A named curve or set of points.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    /// Its name beside it; none stands there if it is empty.
    pub(crate) name: String,
    /// Its points; of a band those of its lower edge.
    pub(crate) points: Vec<(f64, f64)>,
    /// Heights of a band's upper edge, one for each point.
    pub(super) upper: Vec<f64>,
    /// Its colour, by its place among those of series.
    pub(crate) colour: usize,
    /// How it is drawn.
    pub(crate) style: Style,
    /// Half the length of each point's error bar; none if empty. Lines have none.
    error_bars: Vec<f64>,
    /// Whether the error bars lie along the horizontal axis.
    across: bool,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// A full line.
    Line,
    /// A dashed line.
    Dashed,
    /// A dotted line.
    Dotted,
    /// A line of dashes and dots.
    DashDot,
    /// Filled circles.
    Dots,
    /// Squares.
    Squares,
    /// Triangles.
    Triangles,
    /// A shaded area between two edges.
    Band,
}

impl Style {
    /// A line that differs from those before it by its dashes too: curves that coincide all stay visible.
    pub(crate) fn of_line(place: usize) -> Self {
        [Self::Line, Self::Dashed, Self::Dotted, Self::DashDot][place % 4]
    }

    /// Whether it is drawn as separate marks.
    pub(super) fn is_marks(self) -> bool {
        matches!(self, Self::Dots | Self::Squares | Self::Triangles)
    }
}

/// The place of a light colour, for a band where there is one. Others have that of their line.
pub(crate) const BAND_COLOUR: usize = 6;

impl Series {
    pub(crate) fn new(
        name: impl Into<String>,
        style: Style,
        colour: usize,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (name, points) = (name.into(), points.into_iter().collect());
        let (upper, error_bars, across) = (Vec::new(), Vec::new(), false);
        Self { name, points, upper, colour, style, error_bars, across }
    }

    /// The same with upright error bars, one for each point.
    pub(crate) fn with_error_bars(mut self, bars: impl IntoIterator<Item = f64>) -> Self {
        self.error_bars = bars.into_iter().collect();
        self
    }

    /// The same with error bars along the horizontal axis.
    pub(crate) fn with_bars_across(self, bars: impl IntoIterator<Item = f64>) -> Self {
        Self { across: true, ..self.with_error_bars(bars) }
    }

    /// A band from its edges, (x, low, high).
    pub(crate) fn band(
        name: impl Into<String>,
        colour: usize,
        edges: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        let (points, upper): (Vec<(f64, f64)>, Vec<f64>) =
            edges.into_iter().map(|(x, low, high)| ((x, low), high)).unzip();
        Self { upper, ..Self::new(name, Style::Band, colour, points) }
    }

    pub(super) fn colour(&self) -> String {
        let colours = colours();
        colours[self.colour % colours.len()].clone()
    }

    /// For a chart among many: thin.
    pub(super) fn to_small_plot(&self) -> Plot {
        let data = self.points.iter().copied();
        if self.style == Style::Line {
            return Plot::Line(LinePlot::new().with_data(data).with_color(self.colour()));
        }
        let plot = ScatterPlot::new().with_data(data).with_color(self.colour()).with_size(1.2);
        Plot::Scatter(plot.with_marker_opacity(0.5))
    }

    pub(super) fn to_plot(&self) -> Plot {
        let data = self.points.iter().copied();
        let line = |style: LineStyle| {
            let plot = LinePlot::new().with_data(data.clone()).with_color(self.colour());
            Plot::Line(plot.with_stroke_width(2.0).with_line_style(style))
        };
        match self.style {
            Style::Line => line(LineStyle::Solid),
            Style::Dashed => line(LineStyle::Dashed),
            Style::Dotted => line(LineStyle::Dotted),
            Style::DashDot => line(LineStyle::DashDot),
            Style::Dots => self.marks(MarkerShape::Circle),
            Style::Squares => self.marks(MarkerShape::Square),
            Style::Triangles => self.marks(MarkerShape::Triangle),
            Style::Band => {
                let (x, lower): (Vec<f64>, Vec<f64>) = data.unzip();
                let band = BandPlot::new(x, lower, self.upper.iter().copied());
                Plot::Band(band.with_color(self.colour()).with_opacity(0.3))
            }
        }
    }

    /// Marks with an outline, clear enough that none hides another.
    fn marks(&self, shape: MarkerShape) -> Plot {
        /// From as many points on, their marks are small.
        const MANY: usize = 60;
        let many = self.points.len() > MANY;
        let plot = ScatterPlot::new()
            .with_data(self.points.iter().copied())
            .with_color(self.colour())
            .with_size(if many { 3.0 } else { 4.5 })
            .with_marker(shape)
            .with_marker_stroke_width(1.2)
            .with_marker_opacity(if many { 0.35 } else { 0.6 });
        let bars = self.error_bars.iter().copied();
        Plot::Scatter(match (self.error_bars.is_empty(), self.across) {
            (true, _) => plot,
            (false, false) => plot.with_y_err(bars),
            (false, true) => plot.with_x_err(bars),
        })
    }
}
