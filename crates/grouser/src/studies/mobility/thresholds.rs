//! The steepest slopes that the samples allow.

use super::detail::Detail;
use crate::error::ParameterError;
use crate::root;
use crate::studies::card::{Rule, Verdict, best_slopes};
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::heading::{HeadingCurve, HeadingStudy, LimitedBy};
use crate::units::STEEPEST_SLOPE;

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
    /// The steepest slope of each sample that is no no-go [rad], rising; of those samples for which
    /// it is known.
    steepest: Vec<f64>,
    /// The steepest slope of each of the other samples that is known to be no no-go [rad], rising:
    /// beyond it the search for a heading gave up.
    known_to: Vec<f64>,
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
        let nominal = [Sample { soil: heading.soil, model: heading.model.clone() }];
        let samples = if samples.is_empty() { &nominal } else { samples };
        let one = |sample: &Sample| {
            let most = rule.go_slip_ratio.max(rule.no_go_slip_ratio);
            let curve = heading.of_sample(sample).curve_up_to(course, most)?;
            let slopes = [rule.go_slip_ratio, rule.no_go_slip_ratio];
            let is_known = is_known(&curve, rule.no_go_slip_ratio);
            Ok((slopes.map(|most| steepest(&curve, most, detail)), is_known))
        };
        let Some(found) = outputs_of_samples(samples, go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let found = found.into_iter().collect::<Result<Vec<([f64; 2], bool)>, ParameterError>>()?;
        let sorted = |mut slopes: Vec<f64>| {
            slopes.sort_by(f64::total_cmp);
            slopes
        };
        let of = |known: bool| found.iter().filter(move |it| it.1 == known).map(|it| it.0[1]);
        let easy = sorted(found.iter().map(|it| it.0[0]).collect());
        let (steepest, known_to) = (sorted(of(true).collect()), sorted(of(false).collect()));
        // A sample of which nothing is known makes no slope a go, and none a no-go.
        let allowed = sorted(of(true).chain(known_to.iter().map(|_| STEEPEST_SLOPE)).collect());
        let (best_go, best_caution) = best_slopes(heading, is_uncertainty_stated);
        let caution = held_by(&allowed, rule.no_go_probability).min(best_caution);
        let go = held_by(&easy, rule.go_probability).min(best_go.unwrap_or(NOWHERE)).min(caution);
        let of_samples = found.iter().map(|([_, steepest], _)| *steepest).collect();
        Ok(Some(Self { go, caution, steepest, known_to, of_samples }))
    }

    pub(super) fn verdict(&self, slope: f64) -> Verdict {
        match () {
            () if slope <= self.go => Verdict::Go,
            () if slope <= self.caution => Verdict::Caution,
            () => Verdict::NoGo,
        }
    }

    /// Over the samples for which it is known; NaN where there is none.
    pub(super) fn probability_no_go(&self, slope: f64) -> f64 {
        let below = self.steepest.partition_point(|steepest| *steepest < slope);
        let known = self.steepest.len() + self.known_to.len() - self.not_found(slope);
        below as f64 / known as f64
    }

    /// For how many samples it is not known whether a slope [rad] is a no-go.
    pub(super) fn not_found(&self, slope: f64) -> usize {
        self.known_to.partition_point(|known_to| *known_to < slope)
    }
}

/// Whether a curve was followed to a slip, or to its true end.
fn is_known(curve: &HeadingCurve, most_slip: f64) -> bool {
    match curve.limit() {
        Err(none) => !none.is_not_found(),
        Ok(_) => {
            curve.limited_by() != Some(LimitedBy::NotFound)
                || curve.points().any(|[_, slip, _]| slip > most_slip)
        }
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
