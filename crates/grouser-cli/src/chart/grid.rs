//! Small charts side by side.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::render::figure::Figure;
use kuva::render::layout::{Layout, TickFormat};
use kuva::render::plots::Plot;

use super::style::{FONTS, finished, label, theme};
use super::{Chart, Series};
use crate::output::rows::four_digits;

/// Small charts in rows and columns, some places empty, without legends.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// What they show.
    pub(crate) title: String,
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
                        .with_theme(theme())
                        .with_x_label(label(&chart.x_label))
                        .with_y_label(label(&chart.y_label))
                        .with_label_size(10)
                        .with_tick_size(8)
                        .with_ticks(3)
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
        finished(SvgBackend.render_scene(&figure.render()), &self.title)
    }
}
