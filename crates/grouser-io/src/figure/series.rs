//! Curves, points and bands of a chart.

/// A named curve or set of points.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name beside it; none stands there if it is empty.
    pub name: String,
    /// Its points; of a band those of its lower edge. Where a number is missing, a line breaks.
    pub points: Vec<(f64, f64)>,
    /// Heights of a band's upper edge, one for each point.
    pub upper: Vec<f64>,
    /// Its colour, by its place among those of series.
    pub colour: usize,
    /// How it is drawn.
    pub style: Style,
    /// Half the length of each point's error bar; none if empty. Lines have none.
    error_bars: Vec<f64>,
    /// Whether the error bars lie along the horizontal axis.
    across: bool,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
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
    /// A line that differs from those before it by its dashes too: curves that coincide all stay
    /// visible.
    #[must_use]
    pub fn of_line(place: usize) -> Self {
        [Self::Line, Self::Dashed, Self::Dotted, Self::DashDot][place % 4]
    }

    /// Whether it is drawn as separate marks.
    #[must_use]
    pub fn is_marks(self) -> bool {
        matches!(self, Self::Dots | Self::Squares | Self::Triangles)
    }
}

/// The place of a light colour, for a band where there is one. Others have that of their line.
pub const BAND_COLOUR: usize = 6;

impl Series {
    /// A curve or set of points.
    ///
    /// * `colour`: its place among the colours of series
    pub fn new(
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
    #[must_use]
    pub fn with_error_bars(mut self, bars: impl IntoIterator<Item = f64>) -> Self {
        self.error_bars = bars.into_iter().collect();
        self
    }

    /// The same with error bars along the horizontal axis.
    #[must_use]
    pub fn with_bars_across(self, bars: impl IntoIterator<Item = f64>) -> Self {
        Self { across: true, ..self.with_error_bars(bars) }
    }

    /// A band from its edges, (x, low, high).
    pub fn band(
        name: impl Into<String>,
        colour: usize,
        edges: impl IntoIterator<Item = (f64, f64, f64)>,
    ) -> Self {
        let (points, upper): (Vec<(f64, f64)>, Vec<f64>) =
            edges.into_iter().map(|(x, low, high)| ((x, low), high)).unzip();
        Self { upper, ..Self::new(name, Style::Band, colour, points) }
    }

    /// The error bars by their ends.
    pub fn bars(&self) -> impl Iterator<Item = [(f64, f64); 2]> {
        let bars = self.points.iter().zip(&self.error_bars).filter(|(_, half)| half.is_finite());
        bars.map(|(&(x, y), half)| {
            let way = if self.across { (*half, 0.0) } else { (0.0, *half) };
            [(x - way.0, y - way.1), (x + way.0, y + way.1)]
        })
    }

    /// All points that must lie within the axes.
    pub fn extent(&self) -> impl Iterator<Item = (f64, f64)> {
        let upper = self.points.iter().zip(&self.upper).map(|((x, _), upper)| (*x, *upper));
        self.points.iter().copied().chain(upper).chain(self.bars().flatten())
    }
}
