//! Figures in one style, as SVG: the one place that knows the plotting library.
//!
//! A curve has its name at its end, in the right margin, and no legend stands in a box. Colours stay apart for
//! colour-blind eyes; dashes, shapes and names distinguish in grey. A drawing brings its colours for a dark screen.

mod bars;
mod grid;
mod heat_map;
mod names;
mod style;

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::band::BandPlot;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

pub(crate) use bars::Bars;
pub(crate) use grid::Grid;
pub(crate) use heat_map::HeatMap;
use style::{colours, faint, finished, label, layout_of};

/// A chart: axes and series.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// The chart's title.
    pub(crate) title: String,
    /// Horizontal quantity and unit.
    pub(crate) x_label: String,
    /// Vertical quantity and unit.
    pub(crate) y_label: String,
    /// Curves and points, drawn in this order, but for points, which lie above curves.
    pub(crate) series: Vec<Series>,
    /// Whether the horizontal axis is logarithmic.
    log_x: bool,
    /// What stands at 1, 2, … on the vertical axis instead of numbers, from the bottom up.
    y_names: Vec<String>,
}

/// A named curve or set of points.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    /// Its name beside it; none stands there if it is empty.
    pub(crate) name: String,
    /// Its points; of a band those of its lower edge.
    pub(crate) points: Vec<(f64, f64)>,
    /// Heights of a band's upper edge, one for each point.
    upper: Vec<f64>,
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
    fn is_marks(self) -> bool {
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

    fn colour(&self) -> String {
        let colours = colours();
        colours[self.colour % colours.len()].clone()
    }

    /// For a chart among many: thin.
    fn to_small_plot(&self) -> Plot {
        let data = self.points.iter().copied();
        if self.style == Style::Line {
            return Plot::Line(LinePlot::new().with_data(data).with_color(self.colour()));
        }
        let plot = ScatterPlot::new().with_data(data).with_color(self.colour()).with_size(1.2);
        Plot::Scatter(plot.with_marker_opacity(0.5))
    }

    fn to_plot(&self) -> Plot {
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

impl Chart {
    /// A chart with linear axes.
    ///
    /// * `axes`: quantity and unit of the horizontal and of the vertical axis
    pub(crate) fn new(
        title: impl Into<String>,
        axes: (impl Into<String>, impl Into<String>),
        series: Vec<Series>,
    ) -> Self {
        Self {
            title: title.into(),
            x_label: axes.0.into(),
            y_label: axes.1.into(),
            series,
            log_x: false,
            y_names: Vec::new(),
        }
    }

    /// The same with a logarithmic horizontal axis, if all its numbers are above zero.
    pub(crate) fn with_log_x(self) -> Self {
        let log_x = self.points().all(|(x, _)| x > 0.0);
        Self { log_x, ..self }
    }

    /// The same with names at 1, 2, … of the vertical axis, from the bottom up.
    pub(crate) fn with_y_names(self, names: impl IntoIterator<Item = String>) -> Self {
        Self { y_names: names.into_iter().collect(), ..self }
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series.iter().flat_map(|series| series.points.iter().copied())
    }

    /// The chart as a stand-alone SVG document, as wide as a page.
    pub(crate) fn to_svg(&self) -> String {
        self.drawn([760.0, 430.0])
    }

    /// The same for one chart among many: half as wide.
    pub(crate) fn to_small_svg(&self) -> String {
        self.drawn([460.0, 280.0])
    }

    /// * `size`: width and height [px]
    fn drawn(&self, [width, height]: [f64; 2]) -> String {
        // Areas lie below lines, and lines below marks.
        let depth = |series: &&Series| match series.style {
            Style::Band => 0,
            style if style.is_marks() => 2,
            _ => 1,
        };
        let mut series: Vec<&Series> = self.series.iter().collect();
        series.sort_by_key(depth);
        let plots: Vec<Plot> = series.iter().map(|series| series.to_plot()).collect();
        let layout = self.layout(&plots).with_width(width).with_height(height);
        let margin = names::margin(&self.series);
        let left = ComputedLayout::from_layout(&layout).margin_left;
        let layout = layout.with_force_margins(left, margin);
        let places = ComputedLayout::from_layout(&layout);
        let mut scene = render_multiple(plots, layout);
        names::add(&mut scene, &places, &self.series);
        finished(SvgBackend.render_scene(&scene), &self.title)
    }

    fn layout(&self, plots: &[Plot]) -> Layout {
        let mut layout = layout_of(plots, [&self.title, &self.x_label, &self.y_label]);
        if self.log_x {
            layout = layout.with_log_x();
        }
        if !self.y_names.is_empty() {
            let names: Vec<String> = self.y_names.iter().map(|name| label(name)).collect();
            let last = names.len() as f64;
            let name = move |at: f64| {
                let place = at.round();
                let is_name = (at - place).abs() < 1e-6 && (1.0..=last).contains(&place);
                // In range, as was just seen.
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                let name = is_name.then(|| names[place as usize - 1].clone());
                name.unwrap_or_default()
            };
            layout = layout
                .with_y_axis_min(0.5)
                .with_y_axis_max(last + 0.5)
                .with_y_tick_step(1.0)
                .with_y_tick_format(TickFormat::Custom(Arc::new(name)));
        }
        let has_zero = self.points().any(|(_, y)| y < 0.0) && self.points().any(|(_, y)| y > 0.0);
        if has_zero {
            layout = layout.with_reference_line(ReferenceLine::horizontal(0.0).with_color(faint()));
        }
        layout
    }
}
