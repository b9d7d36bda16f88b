//! The steepest slopes that the samples allow.

use super::detail::Detail;
use crate::error::ParameterError;
use crate::root;
use crate::studies::card::{Rule, Verdict, best_slopes};
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::heading::{HeadingCurve, HeadingStudy};

/// By what slopes are judged.
#[derive(Clone, Copy)]
pub(super) struct Judged<'a> {
    pub(super) heading: &'a HeadingStudy,
    pub(super) rule: &'a Rule,
    pub(super) is_uncertainty_stated: bool,
}

/// Slopes at which the verdict changes, and those of the samples, sorted.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Thresholds {
    /// Up to here a go, and from there to the next a caution [rad].
    go: f64,
    caution: f64,
    /// The steepest slope of each sample that is no no-go [rad], rising.
    steepest: Vec<f64>,
    /// The same in the order of the samples.
    pub(super) of_samples: Vec<f64>,
}

/// The slope of a sample that cannot drive at all [rad]: below level ground.
const NOWHERE: f64 = -1.0;

impl Thresholds {
    /// * `samples`: with none the soil as written is judged by
    pub(super) fn of(
        judged: &Judged<'_>,
        course: f64,
        samples: &[Sample],
        detail: Detail,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        let Judged { heading, rule, is_uncertainty_stated } = *judged;
        let nominal = [Sample { soil: heading.soil, theory: heading.theory }];
        let samples = if samples.is_empty() { &nominal } else { samples };
        let one = |sample: &Sample| {
            let most = rule.go_slip_ratio.max(rule.no_go_slip_ratio);
            let curve = heading.of_sample(sample).curve_up_to(course, most)?;
            Ok([rule.go_slip_ratio, rule.no_go_slip_ratio]
                .map(|most| steepest(&curve, most, detail)))
        };
        let Some(found) = outputs_of_samples(samples, go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let found = found.into_iter().collect::<Result<Vec<[f64; 2]>, ParameterError>>()?;
        let sorted = |which: usize| {
            let mut slopes: Vec<f64> = found.iter().map(|it| it[which]).collect();
            slopes.sort_by(f64::total_cmp);
            slopes
        };
        let (easy, steepest) = (sorted(0), sorted(1));
        let (best_go, best_caution) = best_slopes(heading, is_uncertainty_stated);
        let caution = held_by(&steepest, rule.no_go_probability).min(best_caution);
        let go = held_by(&easy, rule.go_probability).min(best_go.unwrap_or(NOWHERE)).min(caution);
        let of_samples = found.iter().map(|[_, steepest]| *steepest).collect();
        Ok(Some(Self { go, caution, steepest, of_samples }))
    }

    pub(super) fn verdict(&self, slope: f64) -> Verdict {
        match () {
            () if slope <= self.go => Verdict::Go,
            () if slope <= self.caution => Verdict::Caution,
            () => Verdict::NoGo,
        }
    }

    pub(super) fn probability_no_go(&self, slope: f64) -> f64 {
        let below = self.steepest.partition_point(|steepest| *steepest < slope);
        below as f64 / self.steepest.len() as f64
    }
}

/// The steepest slope that at least this share of the samples allows [rad].
///
/// * `steepest`: of the samples, rising
fn held_by(steepest: &[f64], share: f64) -> f64 {
    let allows = |slope: &f64| {
        let count = steepest.len() - steepest.partition_point(|it| it < slope);
        count as f64 / steepest.len() as f64 >= share
    };
    steepest.iter().rev().copied().find(allows).unwrap_or(NOWHERE)
}

/// The steepest slope up to which a curve slips at most so much [rad].
fn steepest(curve: &HeadingCurve, most_slip: f64, detail: Detail) -> f64 {
    /// To so much [rad].
    const TOLERANCE: f64 = 1e-6;
    let Ok((limit, _)) = curve.limit() else { return NOWHERE };
    let points: Vec<[f64; 3]> = curve.points().collect();
    let Some(above) = points.iter().position(|[_, slip, _]| *slip > most_slip) else {
        return limit;
    };
    if above == 0 {
        return NOWHERE;
    }
    let ([low, slip_low, _], [high, slip_high, _]) = (points[above - 1], points[above]);
    let high = high.min(limit);
    match detail {
        // The slope below the root of what the slip is too large by.
        Detail::Full => {
            let excess = |slope: f64| curve.at(slope).map_or(1.0, |it| it.slip_ratio - most_slip);
            root::between(excess, low, high, TOLERANCE)
        }
        Detail::Rough => low + (high - low) * (most_slip - slip_low) / (slip_high - slip_low),
    }
}
