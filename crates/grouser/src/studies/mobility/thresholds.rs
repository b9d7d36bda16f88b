//! The steepest slopes that the samples allow.

use super::detail::Detail;
use super::median_slip::{MedianSlip, slips};
use crate::error::ParameterError;
use crate::root;
use crate::studies::ensemble::samples::{Sample, outputs_of_samples};
use crate::studies::heading::{HeadingCurve, LimitedBy};
use crate::studies::verdict::SlopeStudy;

/// Slopes beyond which the course is a no-go in a sample, sorted.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Thresholds {
    /// The steepest slope of each sample that is no no-go [rad], rising; of those samples for which
    /// it is known.
    steepest: Vec<f64>,
    /// The steepest slope of each of the other samples that is known to be no no-go [rad], rising:
    /// beyond it the search for a heading gave up.
    known_to: Vec<f64>,
    /// The same in the order of the samples.
    pub(super) of_samples: Vec<f64>,
    /// What is beyond it, likewise.
    pub(super) beyond: Vec<Beyond>,
    /// The slip in the middle of them.
    pub(super) median_slip: MedianSlip,
}

/// What is beyond the steepest slope of a sample that is no no-go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::studies) enum Beyond {
    /// No heading holds the course.
    NoHeading,
    /// It slips more than a no-go.
    TooMuchSlip,
    /// The search for a heading gave up.
    NotFound,
}

impl Beyond {
    /// This one, where another course near by is known, too.
    pub(in crate::studies) fn and(self, other: Self) -> Self {
        if other == Self::NotFound { other } else { self }
    }
}

/// What the curve of one sample says.
#[derive(Clone)]
struct OfSample {
    /// The steepest slope that is no no-go [rad].
    steepest: f64,
    /// What is beyond it.
    beyond: Beyond,
    /// Slip ratios by slope.
    slips: Vec<f64>,
}

/// The slope of a sample that cannot drive at all [rad]: below level ground.
const NOWHERE: f64 = -1.0;

impl Thresholds {
    /// * `samples`: with none the soil as written is judged by
    pub(super) fn of(
        study: &SlopeStudy,
        course: f64,
        samples: &[Sample],
        detail: Detail,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Self>, ParameterError> {
        let as_written = [study.nominal()];
        let samples = if samples.is_empty() { &as_written } else { samples };
        let most = study.rule.no_go_slip_ratio;
        let one = |sample: &Sample| {
            let curve = study.heading.of_sample(sample).curve_up_to(course, most)?;
            Ok(OfSample {
                steepest: steepest(&curve, most, detail),
                beyond: beyond(&curve, most),
                slips: slips(&curve, most),
            })
        };
        let Some(found) = outputs_of_samples(samples, go_on, one) else { return Ok(None) };
        // In order, so that the error is always that of the first soil.
        let found = found.into_iter().collect::<Result<Vec<OfSample>, ParameterError>>()?;
        let of = |known: bool| {
            let is_so = |it: &&OfSample| (it.beyond != Beyond::NotFound) == known;
            let all = found.iter().filter(is_so).map(|it| it.steepest);
            let mut slopes: Vec<f64> = all.collect();
            slopes.sort_by(f64::total_cmp);
            slopes
        };
        let of_samples = found.iter().map(|it| it.steepest).collect();
        let slips: Vec<&[f64]> = found.iter().map(|it| &*it.slips).collect();
        let median_slip = MedianSlip::of(&slips);
        let beyond = found.iter().map(|it| it.beyond).collect();
        let (steepest, known_to) = (of(true), of(false));
        Ok(Some(Self { steepest, known_to, of_samples, beyond, median_slip }))
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

/// What is beyond the steepest slope of a curve up to which it slips at most so much.
fn beyond(curve: &HeadingCurve, most_slip: f64) -> Beyond {
    let slips = || curve.points().any(|[_, slip, _]| slip.abs() > most_slip);
    match curve.limit() {
        Err(none) if none.is_not_found() => Beyond::NotFound,
        Ok(_) if slips() => Beyond::TooMuchSlip,
        Ok(_) if curve.limited_by() == Some(LimitedBy::NotFound) => Beyond::NotFound,
        Ok(_) | Err(_) => Beyond::NoHeading,
    }
}

/// The steepest slope up to which a curve slips at most so much [rad].
fn steepest(curve: &HeadingCurve, most_slip: f64, detail: Detail) -> f64 {
    /// To so much [rad].
    const TOLERANCE: f64 = 1e-6;
    let Ok((limit, _)) = curve.limit() else { return NOWHERE };
    let points: Vec<[f64; 3]> = curve.points().collect();
    let Some(above) = points.iter().position(|[_, slip, _]| slip.abs() > most_slip) else {
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
            let excess =
                |slope: f64| curve.at(slope).map_or(1.0, |it| it.slip_ratio.abs() - most_slip);
            root::between(excess, low, high, TOLERANCE)
        }
        Detail::Rough => {
            let [slip_low, slip_high] = [slip_low, slip_high].map(f64::abs);
            low + (high - low) * (most_slip - slip_low) / (slip_high - slip_low)
        }
    }
}
