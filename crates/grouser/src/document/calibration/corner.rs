//! A posterior in a picture: the distribution of each fitted key, and the samples of each pair.

use super::{ParameterRecord, Solved};
use crate::document::figure::{BAND_COLOUR, Chart, Figure, Grid, Series, Style};
use crate::document::label_of;
use crate::studies::calibration::Posterior;
use crate::studies::calibration::diagnostics::Samples;

/// Points of all scatters together, and of one.
const ALL_POINTS: usize = 12_000;
const POINTS: usize = 400;
/// Bars of each histogram.
const BARS: usize = 24;
/// Colours of samples, and of the estimate.
const SAMPLES: usize = 1;
const ESTIMATE: usize = 0;
const TITLE: &str = "Posterior";

/// A corner plot: histograms of keys on the diagonal, and below it the samples of their pairs.
#[derive(Clone, Debug)]
pub struct Corner {
    /// What is drawn.
    pub figure: Figure,
    /// What it shows.
    pub caption: String,
}

impl Solved {
    /// The corner plot of the posterior, if there is one.
    ///
    /// * `most`: how many keys are drawn at the most: those with the widest posteriors
    #[must_use]
    pub fn corner(&self, most: usize) -> Option<Corner> {
        let Posterior { samples, .. } = self.solution.posterior.as_ref()?;
        let places = self.least_known(most);
        let shown: Vec<ShownKey> = places.iter().map(|place| ShownKey::of(self, *place)).collect();
        let figure = match &shown[..] {
            [only] => only.alone(samples).into(),
            all => grid(all, samples).into(),
        };
        let which = if places.len() < self.records.len() {
            " Shown are the keys with the widest posteriors."
        } else {
            ""
        };
        let caption = format!(
            "Posterior of each fitted key (outline) and of each pair (samples). Shaded is the 95 % \
             interval, dashed the least-squares estimate. A slanted cloud is a correlated pair: \
             one key compensates for the other. A cloud that fills its bounds is a key that the \
             data do not constrain.{}{which}",
            self.most_correlated().unwrap_or_default()
        );
        Some(Corner { figure, caption })
    }

    /// Places of the keys whose deviation is largest beside that of the prior, in the keys' order.
    fn least_known(&self, most: usize) -> Vec<usize> {
        let mut places: Vec<usize> = (0..self.records.len()).collect();
        let left = |place: usize| self.records[place].posterior_contraction.unwrap_or(1.0);
        places.sort_by(|&one, &other| left(other).total_cmp(&left(one)));
        places.truncate(most);
        places.sort_unstable();
        places
    }

    /// The pair with the largest correlation, as a sentence; none where there is no pair.
    fn most_correlated(&self) -> Option<String> {
        let matrix = self.correlations();
        let pairs = (0..self.records.len()).flat_map(|one| (0..one).map(move |other| (other, one)));
        let largest = pairs.max_by(|a, b| matrix[*a].abs().total_cmp(&matrix[*b].abs()))?;
        let [one, other] = [largest.0, largest.1].map(|place| label(&self.records[place]));
        Some(format!(" The most correlated are {one} and {other}: {:.2}.", matrix[largest]))
    }
}

/// A key that is drawn.
struct ShownKey {
    /// Its place among the fitted ones.
    place: usize,
    /// What it is called, with its unit.
    label: String,
    /// Least squares.
    estimate: f64,
    /// The ends of the 95 % interval.
    interval: [f64; 2],
}

impl ShownKey {
    fn of(solved: &Solved, place: usize) -> Self {
        let record @ ParameterRecord { fit, p2_5, p97_5, .. } = &solved.records[place];
        let interval = [p2_5, p97_5].map(|end| end.unwrap_or(*fit));
        Self { place, label: label(record), estimate: *fit, interval }
    }

    /// How its samples are spread, over its interval and estimate.
    fn histogram(&self, samples: &Samples) -> Vec<Series> {
        let outline = histogram(samples, self.place);
        let top = outline.iter().map(|(_, share)| *share).fold(0.0, f64::max);
        let band = self.interval.map(|at| (at, 0.0, top));
        vec![
            Series::band("", BAND_COLOUR, band),
            Series::new("", Style::Line, SAMPLES, outline),
            Series::new("", Style::Dashed, ESTIMATE, [0.0, top].map(|it| (self.estimate, it))),
        ]
    }

    /// Its histogram, as wide as a page.
    fn alone(&self, samples: &Samples) -> Chart {
        let axes = (self.label.clone(), "share of the samples");
        Chart::new(TITLE, axes, self.histogram(samples))
    }

    /// The ends of what is drawn of it: the interval, with the estimate where that is outside.
    fn ends(&self) -> [f64; 2] {
        let [low, high] = self.interval;
        [low.min(self.estimate), high.max(self.estimate)]
    }

    /// Samples of itself and another, which is drawn upwards, over both intervals and estimates.
    fn cloud(&self, upwards: &Self, rows: &[&[f64]]) -> Vec<Series> {
        let [low, high] = upwards.interval;
        let band = self.interval.map(|at| (at, low, high));
        let upright = upwards.ends().map(|at| (self.estimate, at));
        let level = self.ends().map(|at| (at, upwards.estimate));
        let points = rows.iter().map(|row| (row[self.place], row[upwards.place]));
        vec![
            Series::band("", BAND_COLOUR, band),
            Series::new("", Style::Dots, SAMPLES, points),
            Series::new("", Style::Dashed, ESTIMATE, upright),
            Series::new("", Style::Dashed, ESTIMATE, level),
        ]
    }
}

/// What a key is called, with its unit.
fn label(ParameterRecord { key, .. }: &ParameterRecord) -> String {
    label_of(key.strip_prefix("soil.").unwrap_or(key))
}

/// Histograms on the diagonal, and clouds below it.
fn grid(shown: &[ShownKey], samples: &Samples) -> Grid {
    let count = shown.len();
    let pairs = (count * count.saturating_sub(1) / 2).max(1);
    let rows = samples.thinned(POINTS.min(ALL_POINTS / pairs));
    let cell = |row: usize, column: usize| -> Option<Chart> {
        let (x, y) = (&shown[column], &shown[row]);
        let series = match row.cmp(&column) {
            std::cmp::Ordering::Less => return None,
            std::cmp::Ordering::Equal => y.histogram(samples),
            std::cmp::Ordering::Greater => x.cloud(y, &rows),
        };
        let label = |is_there: bool, of: &ShownKey| {
            if is_there { of.label.clone() } else { String::new() }
        };
        let axes = (label(row + 1 == count, x), label(column == 0 && row > 0, y));
        Some(Chart::new(String::new(), axes, series))
    };
    let cells = (0..count).map(|row| (0..count).map(|column| cell(row, column)).collect());
    Grid { title: TITLE.into(), cells: cells.collect() }
}

/// How often a value falls into each of some bins, as a stepped outline.
fn histogram(samples: &Samples, column: usize) -> Vec<(f64, f64)> {
    let values: Vec<f64> = samples.rows().map(|row| row[column]).collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = ((high - low) / BARS as f64).max(f64::MIN_POSITIVE);
    let mut outline = vec![(low, 0.0)];
    for bar in 0..BARS {
        let [left, right] = [bar, bar + 1].map(|edge| low + width * edge as f64);
        let last = bar + 1 == BARS;
        let within = |value: &&f64| **value >= left && (**value < right || last);
        let share = values.iter().filter(within).count() as f64 / values.len() as f64;
        outline.extend([(left, share), (right, share)]);
    }
    outline.push((high, 0.0));
    outline
}
