//! Figures in one style, as SVG: the one place that knows the plotting library.
//!
//! A curve has its name at its end, in the right margin, and no legend stands in a box. Colours stay apart for
//! colour-blind eyes; dashes, shapes and names distinguish in grey. A drawing brings its colours for a dark screen.

mod bars;
mod grid;
mod heat_map;
mod names;
mod series;
mod style;

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::render::annotations::ReferenceLine;
use kuva::render::layout::{ComputedLayout, Layout, TickFormat};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use crate::output::rows::four_digits;
pub(crate) use bars::Bars;
pub(crate) use grid::Grid;
pub(crate) use heat_map::HeatMap;
pub(crate) use series::{BAND_COLOUR, Series, Style};
use style::{faint, finished, label, layout_of};

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
        let plain = || TickFormat::Custom(Arc::new(four_digits));
        layout = layout.with_y_tick_format(plain());
        layout = if self.log_x { layout.with_log_x() } else { layout.with_x_tick_format(plain()) };
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
