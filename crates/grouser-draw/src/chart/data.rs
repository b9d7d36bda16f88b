//! What a chart shows.

use super::axis::range;
use super::series::Series;

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
    /// Whether the horizontal axis is logarithmic.
    pub(super) log_x: bool,
    /// What stands at 1, 2, … on the vertical axis instead of numbers, from the bottom up.
    pub(super) y_names: Vec<String>,
}

impl Chart {
    /// All that must lie within the axes.
    pub(super) fn extent(&self) -> impl Iterator<Item = (f64, f64)> {
        self.series.iter().flat_map(Series::extent)
    }

    /// The range of a coordinate over all marks and error bars.
    pub(super) fn marked(&self, coordinate: impl Fn((f64, f64)) -> f64) -> Option<[f64; 2]> {
        let marks = self.series.iter().filter(|series| series.style.is_marks());
        range(marks.flat_map(Series::extent).map(coordinate))
    }
}
