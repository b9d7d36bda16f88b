//! Line charts with measured points, as SVG: the one place that knows the plotting library.

use std::sync::Arc;

use grouser::document::escape;
use kuva::backend::svg::SvgBackend;
use kuva::plot::BarPlot;
use kuva::plot::band::BandPlot;
use kuva::plot::scatter::MarkerShape;
use kuva::plot::{ColorMap, Heatmap};
use kuva::plot::{LinePlot, LineStyle, ScatterPlot};
use kuva::render::annotations::ReferenceLine;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use crate::output::rows::four_digits;

/// A chart: axes and series.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    /// The chart's title.
    pub(crate) title: String,
    /// Horizontal quantity and unit.
    pub(crate) x_label: String,
    /// Vertical quantity and unit.
    pub(crate) y_label: String,
    /// Curves and points, drawn in this order.
    pub(crate) series: Vec<Series>,
}

/// A named curve or set of points.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    /// Its name in the legend.
    pub(crate) name: String,
    /// Its points; of a band those of its lower edge.
    pub(crate) points: Vec<(f64, f64)>,
    /// Heights of a band's upper edge, one for each point.
    upper: Vec<f64>,
    /// Its colour, by its place in [`COLOURS`].
    pub(crate) colour: usize,
    /// How it is drawn.
    pub(crate) style: Style,
    /// Half the height of each point's error bar; none if empty. Lines have none.
    pub(crate) error_bars: Vec<f64>,
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
    /// Filled circles.
    Dots,
    /// Squares.
    Squares,
    /// Triangles.
    Triangles,
    /// A shaded area between two edges.
    Band,
}

/// Colours that stay apart for colour-blind eyes and in grey: Okabe and Ito (2008), darkest first.
const COLOURS: [&str; 7] =
    ["#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

/// The colour of what is left over.
const REST: &str = "#bbbbbb";

const FONTS: &str = "Helvetica, Arial, sans-serif";

impl Series {
    pub(crate) fn new(
        name: impl Into<String>,
        style: Style,
        colour: usize,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (name, points) = (name.into(), points.into_iter().collect());
        Self { name, points, upper: Vec::new(), error_bars: Vec::new(), colour, style }
    }

    /// The same with error bars, one for each point.
    pub(crate) fn with_error_bars(mut self, bars: impl IntoIterator<Item = f64>) -> Self {
        self.error_bars = bars.into_iter().collect();
        self
    }

    /// A band from its edges, (x, low, high).
    pub(crate) fn band(
        name: impl Into<String>,
        colour: usize,
        edges: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        let (points, upper): (Vec<(f64, f64)>, Vec<f64>) =
            edges.into_iter().map(|(x, low, high)| ((x, low), high)).unzip();
        Self { upper, style: Style::Band, ..Self::new(name, Style::Band, colour, points) }
    }

    /// The area between the edges of a band.
    fn area(&self) -> Option<Plot> {
        let (across, lower): (Vec<f64>, Vec<f64>) = self.points.iter().copied().unzip();
        let band = BandPlot::new(across, lower, self.upper.iter().copied())
            .with_color(COLOURS[self.colour % COLOURS.len()])
            .with_opacity(0.35);
        (self.style == Style::Band).then_some(Plot::Band(band))
    }

    /// For a chart among many: thin, and without a name.
    fn to_small_plot(&self) -> Plot {
        let colour = COLOURS[self.colour % COLOURS.len()];
        let data = self.points.iter().copied();
        if self.style == Style::Line {
            return Plot::Line(LinePlot::new().with_data(data).with_color(colour));
        }
        let plot = ScatterPlot::new().with_data(data).with_color(colour).with_size(1.2);
        Plot::Scatter(plot.with_marker_opacity(0.5))
    }

    fn to_plot(&self) -> Plot {
        let colour = COLOURS[self.colour % COLOURS.len()];
        let data = self.points.iter().copied();
        let line = |style: LineStyle| {
            Plot::Line(
                LinePlot::new()
                    .with_data(data.clone())
                    .with_color(colour)
                    .with_stroke_width(1.8)
                    .with_line_style(style)
                    .with_legend(label(&self.name)),
            )
        };
        let marks = |shape: MarkerShape| {
            let plot = ScatterPlot::new()
                .with_data(data.clone())
                .with_color(colour)
                .with_size(4.5)
                .with_marker(shape)
                .with_legend(label(&self.name));
            Plot::Scatter(if self.error_bars.is_empty() {
                plot
            } else {
                plot.with_y_err(self.error_bars.iter().copied())
            })
        };
        match self.style {
            // The library gives a band no place in the legend: its lower edge stands for it.
            Style::Line | Style::Band => line(LineStyle::Solid),
            Style::Dashed => line(LineStyle::Dashed),
            Style::Dotted => line(LineStyle::Dotted),
            Style::Dots => marks(MarkerShape::Circle),
            Style::Squares => marks(MarkerShape::Square),
            Style::Triangles => marks(MarkerShape::Triangle),
        }
    }
}

/// Horizontal bars, each of parts that are laid end to end.
#[derive(Clone, Debug)]
pub(crate) struct Bars {
    /// What they show.
    pub(crate) title: String,
    /// Quantity and unit along them.
    pub(crate) x_label: String,
    /// The names of the parts, in their order.
    pub(crate) parts: Vec<String>,
    /// Whether the last part is what is left over: it is grey.
    pub(crate) has_rest: bool,
    /// From the top down: of each a name, and the length of each part.
    pub(crate) rows: Vec<(String, Vec<f64>)>,
}

impl Bars {
    /// The bars as a stand-alone SVG document.
    pub(crate) fn to_svg(&self) -> String {
        let is_rest = |place: usize| self.has_rest && place + 1 == self.parts.len();
        let colour = |place: usize| {
            // Black is for text.
            if is_rest(place) { REST } else { COLOURS[1 + place % (COLOURS.len() - 1)] }
        };
        let mut plot = BarPlot::new().with_stacked().with_horizontal(true).with_width(0.6);
        // The library draws from the bottom up.
        for (name, lengths) in self.rows.iter().rev() {
            let pieces = lengths.iter().enumerate().map(|(place, length)| (*length, colour(place)));
            plot = plot.with_group(label(name), pieces);
        }
        let names: Vec<String> = self.parts.iter().map(|name| label(name)).collect();
        if names.len() > 1 {
            plot = plot.with_legend(names.iter().map(String::as_str).collect());
        }
        let plots = vec![Plot::Bar(plot)];
        let layout = layout_of(&plots, [&self.title, &self.x_label, ""]);
        scalable(&SvgBackend.render_scene(&render_multiple(plots, layout)))
    }
}

/// A table drawn in colours: a value for each row and column, or none, which stays grey.
#[derive(Clone, Debug)]
pub(crate) struct HeatMap {
    /// What it shows, with the unit.
    pub(crate) title: String,
    /// Quantity and unit of the columns, and what they are.
    pub(crate) x_label: String,
    pub(crate) columns: Vec<f64>,
    /// Quantity and unit of the rows, and what they are, from the bottom up.
    pub(crate) y_label: String,
    pub(crate) rows: Vec<f64>,
    /// Row by row.
    pub(crate) values: Vec<Vec<Option<f64>>>,
}

impl HeatMap {
    /// The map as a stand-alone SVG document.
    pub(crate) fn to_svg(&self) -> String {
        let colours = |share: f64| {
            if share.is_nan() { "#dddddd".to_owned() } else { ColorMap::Viridis.map(share) }
        };
        let numbers = |row: &Vec<Option<f64>>| {
            row.iter().map(|value| value.unwrap_or(f64::NAN)).collect::<Vec<f64>>()
        };
        let map = Heatmap::new()
            .with_data(self.values.iter().map(numbers).collect::<Vec<Vec<f64>>>())
            .with_color_map(ColorMap::Custom(Arc::new(colours)));
        let places = |values: &[f64]| values.iter().map(|value| four_digits(*value)).collect();
        let plots = vec![Plot::Heatmap(map)];
        let layout = layout_of(&plots, [&self.title, &self.x_label, &self.y_label])
            .with_x_categories(places(&self.columns))
            .with_y_categories(places(&self.rows));
        scalable(&SvgBackend.render_scene(&render_multiple(plots, layout)))
    }
}

/// Small charts in rows and columns, some places empty, without legends.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// Row by row.
    pub(crate) cells: Vec<Vec<Option<Chart>>>,
}

impl Grid {
    /// The charts as one stand-alone SVG document.
    pub(crate) fn to_svg(&self) -> String {
        /// Size of a chart [px].
        const SIZE: f64 = 190.0;
        let columns = self.cells.iter().map(Vec::len).max().unwrap_or(0);
        let (mut structure, mut plots, mut layouts) = (Vec::new(), Vec::new(), Vec::new());
        for (row, cells) in self.cells.iter().enumerate() {
            for (column, chart) in cells.iter().enumerate() {
                let Some(chart) = chart else { continue };
                let own: Vec<Plot> = chart.series.iter().map(Series::to_small_plot).collect();
                layouts.push(
                    Layout::auto_from_plots(&own)
                        .with_x_label(label(&chart.x_label))
                        .with_y_label(label(&chart.y_label))
                        .with_label_size(10)
                        .with_tick_size(8)
                        .with_ticks(4)
                        .with_tick_format(TickFormat::Custom(Arc::new(four_digits)))
                        .with_font_family(FONTS),
                );
                plots.push(own);
                structure.push(vec![row * columns + column]);
            }
        }
        let figure = Figure::new(self.cells.len(), columns)
            .with_structure(structure)
            .with_plots(plots)
            .with_layouts(layouts)
            .with_cell_size(SIZE, SIZE)
            .with_spacing(6.0);
        scalable(&SvgBackend.render_scene(&figure.render()))
    }
}

impl Chart {
    /// The chart as a stand-alone SVG document.
    pub(crate) fn to_svg(&self) -> String {
        let parts = |series: &Series| series.area().into_iter().chain([series.to_plot()]);
        let plots: Vec<Plot> = self.series.iter().flat_map(parts).collect();
        let mut layout = layout_of(&plots, [&self.title, &self.x_label, &self.y_label]);
        let heights = || self.series.iter().flat_map(|series| &series.points).map(|point| point.1);
        if heights().any(|y| y < 0.0) && heights().any(|y| y > 0.0) {
            layout =
                layout.with_reference_line(ReferenceLine::horizontal(0.0).with_color("#888888"));
        }
        scalable(&SvgBackend.render_scene(&render_multiple(plots, layout)))
    }
}

/// The layout of a drawing as wide as a page.
fn layout_of(plots: &[Plot], [title, x_label, y_label]: [&str; 3]) -> Layout {
    Layout::auto_from_plots(plots)
        .with_title(label(title))
        .with_x_label(label(x_label))
        .with_y_label(label(y_label))
        .with_width(760.0)
        .with_height(430.0)
        .with_title_size(15)
        .with_label_size(13)
        .with_tick_size(12)
        .with_body_size(12)
        .with_font_family(FONTS)
}

/// A text of a drawing on one line, its hidden characters written out. The library escapes what means
/// something in XML, and would take what stands between two dollar signs for mathematics.
fn label(text: &str) -> String {
    escape::line(text).replace('$', "\\$")
}

/// A drawing that a page may make larger or smaller: the library names its size, but no view box.
fn scalable(svg: &str) -> String {
    let size = |name: &str| {
        let rest = svg.split_once(&format!(" {name}=\""))?.1;
        rest.split_once('"').map(|(number, _)| number)
    };
    let (Some(width), Some(height)) = (size("width"), size("height")) else {
        return svg.to_owned();
    };
    svg.replacen("<svg ", &format!("<svg viewBox=\"0 0 {width} {height}\" "), 1)
}
