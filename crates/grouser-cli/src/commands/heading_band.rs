//! `grouser heading --uncertainty`: quantiles of the heading offset over samples of soil and model.

use grouser::document::LoadedScenario;
use grouser::document::columns::heading::{self, DRAWS, DRAWS_MOBILE};
use grouser::document::columns::{LIMIT_SLOPE, PROBABILITY_LEVEL, SLOPE, YAW};
use grouser::document::table::Table;
use grouser::studies::ensemble::samples::BandInputs;
use grouser::studies::heading::{HeadingCurve, HeadingStudy};
use grouser::studies::heading_band::{HeadingBand, SlopeBand};
use grouser_draw::chart::{Chart, Series, Style};

use super::sampling;
use crate::args::{HeadingArgs, UncertaintyArgs};
use crate::failure::Failure;
use crate::inputs;
use crate::output::rows::rounded_down;

/// Quantiles and probabilities over the sampled soils.
pub(crate) struct Bands {
    /// On each slope that was asked for.
    pub(crate) asked: Vec<SlopeBand>,
    /// Quantiles and probabilities of the steepest slope: one row.
    pub(crate) limit: Table,
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

/// Draws the samples and follows the curve of each.
///
/// * `nominal`: the curve of the soil as its document has it
/// * `charted`: whether there will be charts
pub(crate) fn bands(
    args: &HeadingArgs,
    scenario: &LoadedScenario,
    nominal: &HeadingCurve,
    charted: bool,
) -> Result<Bands, Failure> {
    let UncertaintyArgs { sampling, seed } = args.uncertainty;
    inputs::check_samples(sampling.samples, args.slope_deg.0.len())?;
    inputs::refuse_sampled_keys(&args.setting, scenario.uncertain.as_ref())?;
    let samples = sampling::draw(&BandInputs::of_scenario(scenario), sampling.samples, seed)?;
    let asked: Vec<f64> = args.slope_deg.0.iter().map(|slope| SLOPE.unit.to_si(*slope)).collect();
    let charted = if charted { chart_slopes(nominal) } else { Vec::new() };
    let slopes: Vec<f64> = asked.iter().chain(&charted).copied().collect();
    let study = HeadingStudy::of(&scenario.value);
    let band = sampling::with_bar(samples.len(), |go_on| {
        HeadingBand::of(&study, &samples, &slopes, go_on)
    });
    let band = sampling::whole(band?);
    let (asked, along) = band.slopes.split_at(asked.len());
    Ok(Bands {
        asked: asked.to_vec(),
        limit: heading::band_limit(&band),
        not_found: band.not_found,
        along: heading::bands(along),
    })
}

/// Every degree, and the points of the nominal curve, which crowd where it bends.
fn chart_slopes(nominal: &HeadingCurve) -> Vec<f64> {
    let degrees = (0..=STEEPEST_DEG).map(|degree| SLOPE.unit.to_si(f64::from(degree)));
    let points = nominal.headings().into_iter().map(|heading| heading.slope);
    let mut slopes: Vec<f64> = degrees.chain(points).collect();
    slopes.sort_by(f64::total_cmp);
    slopes
}

impl Bands {
    /// A line with the quantiles of the steepest slope.
    pub(crate) fn limit_line(&self) -> String {
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
        format!(
            "over {draws} samples: {low}° to {high}° (95 %), median {median}°{stuck}{not_found}\n"
        )
    }

    fn draws(&self) -> u64 {
        self.limit.count(DRAWS).unwrap_or_default()
    }

    /// A probability on a slope of the charts [-].
    fn probability(&self, name: &str, row: usize) -> f64 {
        self.along.numbers(name)[row].unwrap_or_default()
    }

    /// Yaw over slope, with its band.
    pub(crate) fn chart(&self, nominal: Series) -> Chart {
        let [low, median, high] = YAW.quantiles();
        let drawn: Vec<usize> = (0..self.along.rows())
            .filter(|row| self.probability(PROBABILITY_LEVEL.name, *row) >= LEAST_DRAWN)
            .collect();
        let along = self.along.rows_at(&drawn);
        let edges: Vec<_> = along
            .points(SLOPE.name, &low)
            .zip(along.points(SLOPE.name, &high))
            .map(|((slope, low), (_, high))| (slope, low, high))
            .collect();
        let medians: Vec<_> = along.points(SLOPE.name, &median).collect();
        Chart::new(
            format!("Heading offset that holds the contour, {} samples", self.draws()),
            ("slope [°]", "yaw, positive uphill [°]"),
            vec![
                Series::band("95 % of the samples", 6, edges),
                Series::new("median", Style::Dashed, 0, medians),
                nominal,
            ],
        )
    }

    /// The probability of a contour traverse over slope.
    pub(crate) fn chance_chart(&self) -> Chart {
        let [level, low, high] = PROBABILITY_LEVEL.interval();
        let rows = 0..self.along.rows();
        let is_impossible = |row: usize| self.probability(&level, row) < LEAST_CHANCE;
        let end = rows.clone().position(is_impossible).map_or(rows.end, |end| end + 1);
        let shown = self.along.rows_at(&(0..end).collect::<Vec<_>>());
        let edges: Vec<_> = shown
            .points(SLOPE.name, &low)
            .zip(shown.points(SLOPE.name, &high))
            .map(|((slope, low), (_, high))| (slope, low, high))
            .collect();
        let chances: Vec<_> = shown.points(SLOPE.name, &level).collect();
        Chart::new(
            format!("Probability of a contour traverse, {} samples", self.draws()),
            ("slope [°]", "probability"),
            vec![
                Series::band("95 % interval", 6, edges),
                Series::new("share of the samples", Style::Line, 1, chances),
            ],
        )
    }
}
