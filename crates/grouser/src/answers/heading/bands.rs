//! Quantiles of the heading offset over samples of soil and model.

use super::super::{AnswerError, AnswerOptions, Sampling};
use crate::document::LoadedScenario;
use crate::document::columns::heading::{self, DRAWS, DRAWS_MOBILE};
use crate::document::columns::{LIMIT_SLOPE, PROBABILITY_LEVEL, SLOPE, YAW};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style};
use crate::document::reading::rounded_down;
use crate::document::table::Table;
use crate::studies::ensemble::samples::BandInputs;
use crate::studies::heading::{HeadingCurve, HeadingStudy};
use crate::studies::heading_band::{HeadingBand, SlopeBand};

/// Quantiles and probabilities over the sampled soils.
pub(super) struct Bands {
    /// On each slope that was asked for.
    pub(super) asked: Vec<SlopeBand>,
    /// Of the steepest slope: one row.
    pub(super) limit: Table,
    /// Samples whose steepest slope was not found.
    not_found: usize,
    /// On the slopes of the charts, from level ground up; empty without charts.
    along: Table,
}

/// Steepest slope of the charts [°]: the steepest that is looked at.
const STEEPEST_DEG: u8 = 60;
/// Charts show no yaw over a smaller share of the samples than this [-]: it would show only the few
/// strong soils that are left.
const LEAST_DRAWN: f64 = 0.5;
/// The chart of the probability ends where it falls below this [-].
const LEAST_CHANCE: f64 = 0.001;

impl Bands {
    /// Draws the samples and follows the curve of each.
    ///
    /// * `nominal`: the study of the soil as its document has it, and its curve
    /// * `slopes`: those that were asked for [rad]
    pub(super) fn of(
        sampling: Sampling,
        scenario: &LoadedScenario,
        (study, nominal): (&HeadingStudy, &HeadingCurve),
        slopes: &[f64],
        options: &AnswerOptions<'_>,
    ) -> Result<Self, AnswerError> {
        let samples = sampling.draw(&BandInputs::of_scenario(scenario))?;
        let charted = if options.has_page { chart_slopes(nominal) } else { Vec::new() };
        let all: Vec<f64> = slopes.iter().chain(&charted).copied().collect();
        let band = HeadingBand::of(study, &samples, &all, options.go_on)?;
        let band = band.ok_or(AnswerError::Stopped)?;
        let (asked, along) = band.slopes.split_at(slopes.len());
        Ok(Self {
            asked: asked.to_vec(),
            limit: heading::band_limit(&band),
            not_found: band.not_found,
            along: heading::bands(along),
        })
    }

    /// A line with the quantiles of the steepest slope.
    pub(super) fn limit_line(&self) -> String {
        let ends = LIMIT_SLOPE.quantiles().map(|name| self.limit.numbers(&name)[0]);
        let [draws, draws_mobile] =
            [DRAWS, DRAWS_MOBILE].map(|name| self.limit.count(name).unwrap_or_default());
        let [Some(low), Some(median), Some(high)] = ends else {
            return format!("no heading holds the contour in any of {draws} samples\n");
        };
        let [low, median, high] = [low, median, high].map(rounded_down);
        let stuck = match draws - draws_mobile {
            0 => String::new(),
            stuck => format!("; in {stuck} of them the rover cannot move at all"),
        };
        let not_found = match self.not_found {
            0 => String::new(),
            some => format!("; the search gave up in {some} more, which count as nothing"),
        };
        let band = format!("{low}° to {high}° (95 %), median {median}°");
        format!("over {draws} samples: {band}{stuck}{not_found}\n")
    }

    fn draws(&self) -> u64 {
        self.limit.count(DRAWS).unwrap_or_default()
    }

    /// A probability on a slope of the charts [-].
    fn probability(&self, name: &str, row: usize) -> f64 {
        self.along.numbers(name)[row].unwrap_or_default()
    }

    /// Yaw over slope, with its band.
    pub(super) fn chart(&self, nominal: Series) -> Chart {
        let [low, median, high] = YAW.quantiles();
        let drawn: Vec<usize> = (0..self.along.rows())
            .filter(|row| self.probability(PROBABILITY_LEVEL.name, *row) >= LEAST_DRAWN)
            .collect();
        let along = self.along.rows_at(&drawn);
        let edges = along.edges(SLOPE, [&low, &high]);
        Chart::new(
            format!("Heading offset that holds the contour, {} samples", self.draws()),
            ("slope [°]", "yaw, positive uphill [°]"),
            vec![
                Series::band("95 % of the samples", BAND_COLOUR, edges),
                Series::new("median", Style::Dashed, 0, along.points(SLOPE.name, &median)),
                nominal,
            ],
        )
    }

    /// The probability of a contour traverse over slope.
    pub(super) fn chance_chart(&self) -> Chart {
        let [chance, low, high] = PROBABILITY_LEVEL.interval();
        let rows = 0..self.along.rows();
        let is_impossible = |row: usize| self.probability(&chance, row) < LEAST_CHANCE;
        let end = rows.clone().position(is_impossible).map_or(rows.end, |end| end + 1);
        let shown = self.along.rows_at(&(0..end).collect::<Vec<_>>());
        let chances = shown.points(SLOPE.name, &chance);
        let edges = shown.edges(SLOPE, [&low, &high]);
        Chart::new(
            format!("Probability of a contour traverse, {} samples", self.draws()),
            ("slope [°]", "probability"),
            vec![
                Series::band("95 % interval", BAND_COLOUR, edges),
                Series::new("share of the samples", Style::Line, 1, chances),
            ],
        )
    }
}

/// Every degree, and the points of the nominal curve, which crowd where it bends.
fn chart_slopes(nominal: &HeadingCurve) -> Vec<f64> {
    let degrees = (0..=STEEPEST_DEG).map(|degree| SLOPE.unit.to_si(f64::from(degree)));
    let points = nominal.headings().into_iter().map(|heading| heading.slope);
    let mut slopes: Vec<f64> = degrees.chain(points).collect();
    slopes.sort_by(f64::total_cmp);
    slopes
}
