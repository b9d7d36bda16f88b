//! Horizontal bars.

use kuva::backend::svg::SvgBackend;
use kuva::plot::BarPlot;
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use super::style::{colours, finished, label, layout_of, rest};

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
            let colours = colours();
            if is_rest(place) { rest() } else { colours[1 + place % (colours.len() - 1)].clone() }
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
        finished(SvgBackend.render_scene(&render_multiple(plots, layout)), &self.title)
    }
}
