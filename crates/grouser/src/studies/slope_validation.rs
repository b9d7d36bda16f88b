//! Errors of a wheel–soil model against a rover's measured slip and yaw on slopes.
//!
//! Every slope is predicted by the heading offset that holds the measured course there, with the
//! same load transfer, model and soil as the heading study. Where no heading holds a course along
//! or up the slope, the rover digs in: its slip counts as 1, and it has no yaw. Repeated rows are
//! averaged first, and every slope has the same weight.

use rayon::prelude::*;

use super::heading::{HeadingCurve, HeadingStudy};
use super::validation::{Aim, Comparison, Errors, Placed, Yardstick, mean_score};
use crate::contact::validity::Finding;
use crate::error::ParameterError;
use crate::studies::slope_tests::{Mean, SlopePoint, SlopeTests};

/// Slip on slopes up to this one has an aim [rad]: 15°. Source: ours.
const AIM_UP_TO: f64 = std::f64::consts::PI / 12.0;
/// The largest error of slip there that is within the aim [-]. Source: ours.
const AIM: f64 = 0.1;

/// A rover's measured motion on slopes, and the model to compare with it.
///
/// By how much does the slip of a rover straight up slopes differ from that of particle
/// simulations?
///
/// ```
/// use grouser::document::measurements::{Choice, Source as Rows};
/// use grouser::document::{self, Overrides, Source};
/// use grouser::studies::heading::HeadingStudy;
/// use grouser::studies::slope_validation::SlopeValidationStudy;
///
/// let overrides = Overrides::parse(["scenario.rover=mgru3", "scenario.soil=grc-1-second-hand"])?;
/// let scenario = document::read_scenario(&Source::default_scenario(), &overrides)?.value;
/// let rows = Rows::preset("viper-slip-slope").expect("it comes with the library");
/// let tests = rows.read_slopes(&Choice::default(), &scenario.rover)?;
///
/// let study = SlopeValidationStudy { tests: &tests, heading: &HeadingStudy::of(&scenario) };
/// let slip = study.run()?.slip_ratio.expect("it was measured");
/// assert_eq!(slip.cells, 7);
/// assert!(slip.bias < 0.0, "less slip than the particle simulations have");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SlopeValidationStudy<'a> {
    /// The measured slopes.
    pub tests: &'a SlopeTests,
    /// The rover, its soil and the model.
    pub heading: &'a HeadingStudy,
}

/// Predictions beside measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeValidation {
    /// Each slope and course, in the order of the tests.
    pub points: Vec<SlopeComparison>,
    /// Errors of the slip ratio; `None` where it was not measured.
    pub slip_ratio: Option<Errors>,
    /// Errors of the yaw; `None` where it was not measured, or is predicted on no slope.
    pub yaw: Option<Errors>,
    /// Number of slopes on which no heading holds the course, by the model.
    pub not_held: usize,
    /// Errors of predictions without physics.
    pub references: Vec<SlopeReference>,
}

/// A slope and course, measured and predicted.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeComparison {
    /// What was measured.
    pub point: SlopePoint,
    /// Predicted slip ratio [-].
    pub slip_ratio: Option<f64>,
    /// Predicted yaw, *γ* [rad].
    pub yaw: Option<f64>,
    /// Why no heading holds the course; `None` where one does.
    pub not_held: Option<String>,
    /// Why the prediction is an extrapolation.
    pub findings: Vec<Finding>,
}

/// The errors of predictions without physics.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeReference {
    /// How they were predicted.
    pub yardstick: Yardstick,
    /// Errors of the slip ratio.
    pub slip_ratio: Option<Errors>,
    /// Errors of the yaw.
    pub yaw: Option<Errors>,
}

impl SlopeValidationStudy<'_> {
    /// Follows the curve of each measured course, in parallel, and compares it on each slope.
    ///
    /// # Errors
    /// [`ParameterError`] if the soil, the gravity or a course is invalid, or a wheel is steered.
    pub fn run(&self) -> Result<SlopeValidation, ParameterError> {
        let all = &self.tests.points;
        let mut courses: Vec<f64> = all.iter().map(|point| point.course).collect();
        courses.sort_by(f64::total_cmp);
        courses.dedup();
        let curves = courses.par_iter().map(|course| self.heading.curve_on(*course));
        let curves: Vec<Result<HeadingCurve, ParameterError>> = curves.collect();
        let curves: Vec<HeadingCurve> = curves.into_iter().collect::<Result<_, _>>()?;
        let compare = |point: &SlopePoint| {
            let place = courses.partition_point(|course| *course < point.course);
            SlopeComparison::of(point, &curves[place])
        };
        let points: Vec<SlopeComparison> = all.par_iter().map(compare).collect();
        Ok(SlopeValidation::of(points))
    }
}

impl SlopeComparison {
    fn of(point: &SlopePoint, curve: &HeadingCurve) -> Self {
        /// Without progress [-].
        const DUG_IN: f64 = 1.0;
        let found = curve.at(point.slope);
        // Where the search gave up nothing is known of the slip.
        let is_known = found.as_ref().map_or_else(|none| !none.is_not_found(), |_| true);
        let dug_in = (point.course >= 0.0 && is_known).then_some(DUG_IN);
        Self {
            findings: curve.findings(point.slope, &found),
            point: point.clone(),
            slip_ratio: found.as_ref().map_or(dug_in, |heading| Some(heading.slip_ratio)),
            yaw: found.as_ref().ok().map(|heading| heading.yaw),
            not_held: found.err().map(|reason| reason.to_string()),
        }
    }
}

impl SlopeComparison {
    /// Whether something was measured that the model does not predict: it is in no error.
    #[must_use]
    pub fn has_no_prediction(&self) -> bool {
        let is_missing = |measured: Option<Mean>, predicted: Option<f64>| {
            measured.is_some() && predicted.is_none()
        };
        is_missing(self.point.yaw, self.yaw) || is_missing(self.point.slip_ratio, self.slip_ratio)
    }
}

/// A measured mean and its prediction, where there are both.
fn beside(measured: Option<Mean>, predicted: Option<f64>) -> Option<Comparison> {
    measured.zip(predicted).map(|(mean, predicted)| Comparison {
        measured: mean.value,
        predicted,
        trials: mean.rows,
        repeatability: mean.deviation,
        scatter: None,
    })
}

impl SlopeReference {
    /// The score, as of a model.
    #[must_use]
    pub fn score(&self) -> Option<f64> {
        mean_score([self.slip_ratio, self.yaw].into_iter().flatten().filter_map(|it| it.score()))
    }
}

impl SlopeValidation {
    /// Computes the errors of given comparisons.
    #[must_use]
    pub fn of(points: Vec<SlopeComparison>) -> Self {
        let slip_ratio = errors(points.iter().map(|it| (it.point.slip_ratio, it.slip_ratio)));
        Self {
            slip_ratio: slip_ratio.map(|errors| with_aim(errors, &points)),
            yaw: errors(points.iter().map(|it| (it.point.yaw, it.yaw))),
            not_held: points.iter().filter(|it| it.not_held.is_some()).count(),
            references: Yardstick::ALL
                .into_iter()
                .filter_map(|it| reference(&points, it))
                .collect(),
            points,
        }
    }

    /// The score: each quantity's error over the standard deviation of what was measured, averaged
    /// over the measured quantities [-].
    #[must_use]
    pub fn score(&self) -> Option<f64> {
        mean_score([self.slip_ratio, self.yaw].into_iter().flatten().filter_map(|it| it.score()))
    }

    /// Number of slopes on which something was measured that the model does not predict. They are
    /// in no error of the model, but in those of predictions without physics.
    #[must_use]
    pub fn no_prediction(&self) -> usize {
        self.points.iter().filter(|it| it.has_no_prediction()).count()
    }
}

fn errors(pairs: impl Iterator<Item = (Option<Mean>, Option<f64>)>) -> Option<Errors> {
    let both = pairs.filter_map(|(measured, predicted)| beside(measured, predicted));
    Errors::of(&both.collect::<Vec<_>>())
}

/// The errors of slip with their aim: the largest on slopes up to 15° is at most 0.1.
fn with_aim(errors: Errors, points: &[SlopeComparison]) -> Errors {
    let gentle = points.iter().filter(|it| it.point.slope <= AIM_UP_TO * (1.0 + 1e-12));
    let slips = gentle.filter_map(|it| beside(it.point.slip_ratio, it.slip_ratio));
    let all: Vec<f64> = slips.map(|slip| (slip.predicted - slip.measured).abs()).collect();
    let is_met = all.iter().all(|error| *error <= AIM + 1e-12);
    let aim = (!all.is_empty()).then_some(Aim { limit: AIM, is_met });
    Errors { aim, ..errors }
}

/// The errors of a prediction without physics; `None` if it predicts nothing.
fn reference(points: &[SlopeComparison], yardstick: Yardstick) -> Option<SlopeReference> {
    let of = |quantity: fn(&SlopePoint) -> Option<Mean>| {
        let all = points.iter().filter_map(|it| {
            let mean = quantity(&it.point)?;
            Some((Placed { series: it.point.course, x: it.point.slope, value: mean.value }, mean))
        });
        let (placed, means): (Vec<Placed>, Vec<Mean>) = all.unzip();
        errors(means.into_iter().map(Some).zip(yardstick.predict(&placed)))
    };
    let (slip_ratio, yaw) = (of(|point| point.slip_ratio), of(|point| point.yaw));
    let is_there = slip_ratio.is_some() || yaw.is_some();
    is_there.then_some(SlopeReference { yardstick, slip_ratio, yaw })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    fn point(slope: f64, measured: f64, predicted: f64) -> SlopeComparison {
        let slip_ratio = Some(Mean { value: measured, rows: 1, deviation: None });
        let (slope, course) = (deg(slope), deg(90.0));
        let point = SlopePoint { line: 2, slope, course, slip_ratio, yaw: None };
        SlopeComparison {
            point,
            slip_ratio: Some(predicted),
            yaw: None,
            not_held: None,
            findings: Vec::new(),
        }
    }

    /// Errors beyond 15° are in the root mean square, and not in the aim.
    #[test]
    fn the_aim_is_about_slopes_up_to_15_degrees() {
        let gentle = [point(0.0, 0.1, 0.1), point(15.0, 0.4, 0.3), point(20.0, 0.6, 0.2)];
        let found = SlopeValidation::of(gentle.to_vec()).slip_ratio.expect("it was measured");
        assert!((found.rmse - (0.17_f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(found.aim, Some(Aim { limit: 0.1, is_met: true }));
        let far = SlopeValidation::of(vec![point(10.0, 0.4, 0.29), point(20.0, 0.6, 0.6)]);
        assert_eq!(far.slip_ratio.and_then(|it| it.aim).map(|aim| aim.is_met), Some(false));
        let steep = SlopeValidation::of(vec![point(20.0, 0.6, 0.6)]);
        assert_eq!(steep.slip_ratio.expect("it was measured").aim, None);
    }

    /// Slips lie on a parabola of the slope at 0, 10 and 20°: the chord meets the middle one to
    /// half a step squared, and the ends take their neighbour's.
    #[test]
    fn the_yardsticks_interpolate_over_the_slope() {
        let points = [point(0.0, 0.0, 0.0), point(10.0, 0.1, 0.1), point(20.0, 0.4, 0.4)];
        let found = SlopeValidation::of(points.to_vec());
        let rmse = |yardstick| {
            let reference = found.references.iter().find(|it| it.yardstick == yardstick);
            reference.and_then(|it| it.slip_ratio).map(|it| it.rmse)
        };
        let interpolated = ((0.01 + 0.01 + 0.09) / 3.0_f64).sqrt();
        assert!(
            (rmse(Yardstick::Interpolation).expect("three slopes") - interpolated).abs() < 1e-12
        );
        let mean = 0.5 / 3.0;
        let deviation: f64 = [0.0, 0.1, 0.4].iter().map(|it: &f64| (it - mean).powi(2)).sum();
        assert!((rmse(Yardstick::Mean).expect("three") - (deviation / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(rmse(Yardstick::AngleLeftOut), None);
    }
}
