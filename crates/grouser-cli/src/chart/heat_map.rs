//! Tables in colours.

use std::sync::Arc;

use kuva::backend::svg::SvgBackend;
use kuva::plot::{ColorMap, Heatmap};
use kuva::render::plots::Plot;
use kuva::render::render::render_multiple;

use super::style::{finished, layout_of, rest};
use crate::output::rows::four_digits;

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
            if share.is_nan() { rest() } else { ColorMap::Viridis.map(share) }
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
        finished(SvgBackend.render_scene(&render_multiple(plots, layout)), &self.title)
    }
}
