//! Quantiles of the heading offset over samples of soil and model.

use super::super::{AnswerError, AnswerOptions, Sampling};
use crate::contact::Model;
use crate::document::LoadedScenario;
use crate::document::columns::heading::{self, DRAWS, DRAWS_MOBILE, ModelYaw};
use crate::document::columns::{LIMIT_SLOPE, PROBABILITY_LEVEL, SLOPE, YAW};
use crate::document::figure::{BAND_COLOUR, Chart, Series, Style};
use crate::document::reading::{four_digits, rounded_down};
use crate::document::table::Table;
use crate::studies::ensemble::samples::{BandInputs, Sample};
use crate::studies::heading::HeadingCurve;
use crate::studies::heading_band::{HeadingBand, SlopeBand};
use crate::studies::verdict::{Advice, SlopeStudy};

/// Quantiles and probabilities over the sampled soils, and the advice by them.
pub(super) struct Bands {
    /// On each slope that was asked for.
    pub(super) asked: Vec<SlopeBand>,
    /// The same.
    pub(super) advice: Vec<Advice>,
    /// Headings of the models on the soil as written, on the same slopes.
    pub(super) of_models: Vec<Vec<ModelYaw>>,
    /// Of the steepest slope: one row.
    pub(super) limit: Table,
    /// Samples whose steepest slope was not found.
    not_found: usize,
    /// On the slopes of the charts, from level ground up; empty without charts.
    along: Table,
}

/// Steepest slope of the charts [°]: the steepest that is looked at.
const STEEPEST_DEG: u8 = 60;
/// The chart of the probability ends where it falls below this [-].
const LEAST_CHANCE: f64 = 0.001;

impl Bands {
    /// Draws the samples and follows the curve of each.
    ///
    /// * `nominal`: the curve of the soil as its document has it
    /// * `slopes`: those that were asked for [rad]
    pub(super) fn of(
        sampling: Sampling,
        scenario: &LoadedScenario,
        (study, nominal): (&SlopeStudy, &HeadingCurve),
        slopes: &[f64],
        options: &AnswerOptions<'_>,
    ) -> Result<Self, AnswerError> {
        let samples = sampling.draw_if_uncertain(&BandInputs::of_scenario(scenario))?;
        let heading = &study.heading;
        let as_written = [Sample { soil: heading.soil, model: heading.model.clone() }];
        let charted = if options.has_page { chart_slopes(nominal) } else { Vec::new() };
        let all: Vec<f64> = slopes.iter().chain(&charted).copied().collect();
        let over = if samples.is_empty() { &as_written[..] } else { &samples };
        let band = HeadingBand::of(heading, over, &all, options.go_on)?;
        let band = band.ok_or(AnswerError::Stopped)?;
        let (asked, along) = band.slopes.split_at(slopes.len());
        let mut curves = study.other_models(slopes.iter().copied().fold(0.0, f64::max))?;
        curves.insert(0, (heading.model.clone(), nominal.clone()));
        let yaw = |slope: f64, (model, curve): &(Model, HeadingCurve)| {
            (model.clone(), curve.at(slope).ok().map(|it| it.yaw))
        };
        let yaws = |slope: &f64| curves.iter().map(|it| yaw(*slope, it)).collect();
        Ok(Self {
            asked: asked.to_vec(),
            advice: asked.iter().map(|it| it.advice(study, &samples)).collect(),
            of_models: slopes.iter().map(yaws).collect(),
            limit: heading::band_limit(&band),
            not_found: band.not_found,
            along: heading::bands(along),
        })
    }

    /// A line for each slope: the heading to set with its band, what the models say, and the verdict.
    pub(super) fn advice_lines(&self) -> String {
        let lines = self.advice.iter().zip(&self.of_models);
        lines.map(|(advice, of_models)| advice_line(advice, of_models) + "\n").collect()
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

    /// Yaw over slope: the median, and its band.
    pub(super) fn chart(&self) -> Chart {
        let [low, median, high] = YAW.quantiles();
        let numbers = |name: &str| self.along.numbers(name).iter();
        let set: Vec<(f64, f64)> = self.along.points(SLOPE.name, &median).collect();
        let end = set.last().map_or(0.0, |(slope, _)| *slope);
        let top = numbers(&high).chain(numbers(&median)).flatten().copied().fold(0.0, f64::max);
        let rows = numbers(SLOPE.name).zip(numbers(&low)).zip(numbers(&high));
        // An end that no number reaches is drawn at the top.
        let edge = |((slope, low), high): ((&Option<f64>, &Option<f64>), &Option<f64>)| {
            Some(((*slope)?, (*low)?, high.unwrap_or(top)))
        };
        let edges: Vec<_> = rows.filter_map(edge).filter(|(slope, ..)| *slope <= end).collect();
        Chart::new(
            format!("Heading offset that holds the contour, {} samples", self.draws()),
            ("slope [°]", "yaw, positive uphill [°]"),
            vec![
                Series::band("95 % of all samples", BAND_COLOUR, edges),
                Series::new("heading to set: their median", Style::Line, 0, set),
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

/// What to do on a slope, in a line without its end.
fn advice_line(advice: &Advice, of_models: &[ModelYaw]) -> String {
    let degrees = |yaw: f64| format!("{:.1}°", YAW.unit.from_si(yaw));
    let or_none = |yaw: f64| if yaw.is_finite() { degrees(yaw) } else { "none".to_owned() };
    let slope = four_digits(SLOPE.unit.from_si(advice.slope));
    let nose = advice.heading().map_or_else(
        || "no heading holds the contour in half of the samples".to_owned(),
        |yaw| format!("nose {} uphill", degrees(yaw)),
    );
    let band = advice.yaw.map_or_else(String::new, |band| {
        let without = advice.level.trials - advice.level.successes;
        let without = four_digits(100.0 * without as f64 / advice.level.trials.max(1) as f64);
        let (low, high) = (degrees(band.low), or_none(band.high));
        format!(
            " (95 %: {low} to {high}; no heading in {without} % of {} samples)",
            advice.level.trials
        )
    });
    let models = of_models.iter().map(|(model, yaw)| {
        format!("{} {}", model.name(), yaw.map_or_else(|| "none".to_owned(), degrees))
    });
    let models = models.collect::<Vec<_>>().join(", ");
    format!(
        "{slope}°: {nose}{band}; as written, by model: {models}; {}",
        advice.judgement.sentence()
    )
}

/// Every degree, and the points of the nominal curve, which crowd where it bends.
fn chart_slopes(nominal: &HeadingCurve) -> Vec<f64> {
    let degrees = (0..=STEEPEST_DEG).map(|degree| SLOPE.unit.to_si(f64::from(degree)));
    let points = nominal.headings().into_iter().map(|heading| heading.slope);
    let mut slopes: Vec<f64> = degrees.chain(points).collect();
    slopes.sort_by(f64::total_cmp);
    slopes
}
