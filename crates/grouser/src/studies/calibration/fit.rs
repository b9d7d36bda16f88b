//! The best fit: bounded least squares from several starts, with weights that are estimated from
//! the residuals.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::errors::Whitener;
use super::least_squares::{Evaluated, Minimum, Residuals, minimise};
use super::parameter::{ParameterSpace, coordinate_of};
use super::{Calibration, CalibrationError};
use crate::elementary::wide::{ln, powi};
use crate::elementary::{exp, pow};
use crate::root;

/// Settings of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FitSettings {
    /// Searches: one from the parameters' own starts, the others from the best of the points tried.
    pub starts: usize,
    /// Points tried, spread evenly over the bounds.
    pub tried: usize,
    /// A search ends after this many evaluations for each parameter.
    pub patience: usize,
}

impl Default for FitSettings {
    /// Found on the sixteen parameters of the small-wheel model: more starts find nothing better.
    fn default() -> Self {
        Self { starts: 8, tried: 64, patience: 4 }
    }
}

/// The best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Their values.
    pub values: Vec<f64>,
    /// Their coordinates.
    pub coordinates: Vec<f64>,
    /// Standard deviation of each channel's model discrepancy, δ, in the channel's unit; then the
    /// correlation lengths, where there are any.
    pub discrepancies: Vec<f64>,
    /// Predictions of the observations.
    pub predictions: Vec<f64>,
    /// Half the weighted sum of squares, ½ Σ (y − f)²/(s² + δ²).
    pub cost: f64,
    /// Covariance of the coordinates: inverse of JᵀJ with correlated errors, the prior's own
    /// information included, so that it exists where the data determine nothing.
    pub covariance: DMatrix<f64>,
    /// The result of each search, the given start's first.
    pub searches: Vec<Search>,
    /// Whether the best search has converged.
    pub converged: bool,
}

/// One search of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// Values at its start.
    pub start: Vec<f64>,
    /// Values at its end.
    pub end: Vec<f64>,
    /// Half the weighted sum of squares there, with the weights of the first round.
    pub cost: f64,
    /// Whether its cost agrees with that of the best one.
    pub agrees: bool,
}

/// Searches whose cost exceeds the best one's by less than this agree with it: by half a unit,
/// their parameters are as likely to within a factor of 1.6. Where the weights make the errors too
/// small, as the cost over the half of the number of observations says, by as much more.
const AS_LOW: f64 = 0.5;

/// Rounds of weights: each δ changes by less than a percent after four.
const ROUNDS: usize = 4;

/// Patience of the last searches, which start near their end.
const POLISHING_PATIENCE: usize = 6;

impl Fit {
    /// Standard deviations of the values, to first order. They are not valid at a bound, where they
    /// come out near 0: use posterior samples there.
    #[must_use]
    pub fn deviations(&self, space: &ParameterSpace) -> Vec<f64> {
        let slopes = space.slopes(&self.coordinates);
        let each = slopes.iter().enumerate();
        each.map(|(i, slope)| slope.abs() * self.covariance[(i, i)].sqrt()).collect()
    }
}

impl Calibration<'_> {
    /// Fits the parameters by least squares.
    ///
    /// Weights and parameters depend on each other. The searches from all starts share weights with
    /// a tenth of the measurements' spread as discrepancy; from the best of them on, the
    /// discrepancies are found anew after each search (Paule and Mandel's equation, Σ r²/(s² + δ²)
    /// = n less the channel's share of the parameters). Correlated errors do not shift the weights:
    /// the fit is the point of least squares, and they tell how well it is known.
    ///
    /// * `observer`: gets each search that has ended, in any order; it can stop the fit
    ///
    /// # Errors
    /// [`CalibrationError::NoStart`] if no start gives predictions,
    /// [`CalibrationError::Interrupted`] if the observer stopped it.
    pub fn fit(
        &self,
        settings: &FitSettings,
        observer: &(dyn Fn() -> ControlFlow<()> + Sync),
    ) -> Result<Fit, CalibrationError> {
        let first_guess: Vec<f64> =
            self.discrepancies.parameters().iter().map(|parameter| parameter.start).collect();
        let weighted = Weighted::new(self, &first_guess);
        let starts = self.starts(&weighted, settings);
        let interrupted = AtomicBool::new(false);
        let search = |start: &Vec<f64>| {
            if interrupted.load(Ordering::Relaxed) {
                return None;
            }
            let minimum = minimise(&weighted, start, settings.patience);
            if observer().is_break() {
                interrupted.store(true, Ordering::Relaxed);
            }
            Some(minimum)
        };
        let minima: Vec<Option<Minimum>> = starts.par_iter().map(search).collect();
        if interrupted.into_inner() {
            return Err(CalibrationError::Interrupted);
        }
        let minima: Vec<Minimum> = minima.into_iter().flatten().collect();
        let best = minima.iter().min_by(|one, other| one.cost.total_cmp(&other.cost));
        let best =
            best.filter(|best| best.cost.is_finite()).ok_or_else(|| self.no_start(&starts))?;
        let searches = self.searches(&starts, &minima, best.cost);
        self.polished(best, searches)
    }

    /// Where to start: the given point, and the best of many spread over the bounds.
    fn starts(&self, weighted: &Weighted, settings: &FitSettings) -> Vec<Vec<f64>> {
        let points: Vec<Vec<f64>> =
            (1..=settings.tried).map(|number| spread_point(number, self.space.len())).collect();
        let costs: Vec<f64> = points.par_iter().map(|point| weighted.cost(point)).collect();
        let mut order: Vec<usize> = (0..points.len()).collect();
        // Stable: points of equal cost keep their order.
        order.sort_by(|&one, &other| costs[one].total_cmp(&costs[other]));
        let others = order.into_iter().take(settings.starts.saturating_sub(1));
        let mut starts = vec![self.space.start()];
        starts.extend(others.map(|number| points[number].clone()));
        starts
    }

    fn no_start(&self, starts: &[Vec<f64>]) -> CalibrationError {
        let mut predictions = vec![0.0; self.experiment.observations().len()];
        let values = self.space.values(&self.space.start());
        let reason = match self.experiment.predict(&values, &mut predictions) {
            Err(error) => error.to_string(),
            Ok(()) => "a prediction is not finite".into(),
        };
        CalibrationError::NoStart { starts: starts.len(), reason }
    }

    fn searches(&self, starts: &[Vec<f64>], minima: &[Minimum], lowest: f64) -> Vec<Search> {
        let expected = 0.5 * self.experiment.observations().len() as f64;
        let as_low = AS_LOW * (lowest / expected).max(1.0);
        let each = starts.iter().zip(minima);
        each.map(|(start, minimum)| Search {
            start: self.space.values(start),
            end: self.space.values(&minimum.coordinates),
            cost: minimum.cost,
            agrees: minimum.cost < lowest + as_low,
        })
        .collect()
    }

    /// The best search's end, with the weights that belong to it.
    fn polished(&self, best: &Minimum, searches: Vec<Search>) -> Result<Fit, CalibrationError> {
        let mut minimum = best.clone();
        for _ in 0..ROUNDS {
            let discrepancies = self.discrepancies_at(&minimum.coordinates);
            let weighted = Weighted::new(self, &discrepancies);
            minimum = minimise(&weighted, &minimum.coordinates, POLISHING_PATIENCE);
        }
        let Minimum { coordinates, cost, converged } = minimum;
        let values = self.space.values(&coordinates);
        let predictions = self.predictions(&values).ok_or_else(|| self.no_start(&[]))?;
        // The fit was weighed by plain differences; what is handed on counts as discrepancies do.
        let residuals = self.errors.residuals(self.experiment.observations(), &predictions);
        let mut discrepancies = self.discrepancies_of(&residuals, self.errors.weights());
        discrepancies.extend(self.errors.likely_lengths(&residuals, &discrepancies));
        let covariance = Weighted::correlated(self, &discrepancies).covariance(&coordinates);
        Ok(Fit {
            values,
            coordinates,
            discrepancies,
            predictions,
            cost,
            covariance,
            searches,
            converged,
        })
    }

    /// The most likely point with the prior counted, near a fit, and the covariance around it:
    /// where walkers start.
    pub(super) fn mode_near(&self, fit: &Fit) -> (Vec<f64>, DMatrix<f64>) {
        let weighted = Weighted::correlated(self, &fit.discrepancies);
        let mode = minimise(&weighted, &fit.coordinates, POLISHING_PATIENCE).coordinates;
        let covariance = weighted.covariance(&mode);
        (mode, covariance)
    }

    /// The discrepancies of plain differences at a point, all of a channel alike.
    fn discrepancies_at(&self, coordinates: &[f64]) -> Vec<f64> {
        let observations = self.experiment.observations();
        let predictions = self.predictions(&self.space.values(coordinates));
        let predictions = predictions.unwrap_or_else(|| vec![0.0; observations.len()]);
        let pairs = observations.iter().zip(&predictions);
        let residuals: Vec<f64> = pairs.map(|(one, prediction)| one.value - prediction).collect();
        self.discrepancies_of(&residuals, &vec![1.0; observations.len()])
    }

    /// The discrepancies of the channels by the method of moments (Paule and Mandel 1982).
    ///
    /// * `weights`: of each observation, in units of its channel's discrepancy
    fn discrepancies_of(&self, residuals: &[f64], weights: &[f64]) -> Vec<f64> {
        let observations = self.experiment.observations();
        // Each parameter takes up one observation; the channels share that evenly.
        let left = 1.0 - self.space.len() as f64 / observations.len() as f64;
        let one_channel = |(channel, bounds): (usize, &super::Parameter)| {
            let each = observations.iter().zip(residuals.iter().zip(weights));
            let own: Vec<[f64; 3]> = each
                .filter(|(one, (_, weight))| one.channel == channel && **weight != 0.0)
                .map(|(one, (residual, weight))| {
                    [*residual, one.scatter, *weight].map(|it| it * it)
                })
                .collect();
            let expected = own.len() as f64 * left;
            let excess = |log_discrepancy: f64| {
                let variance = exp(2.0 * log_discrepancy);
                let share = |[square, s2, weight]: &[f64; 3]| square / (s2 + weight * variance);
                own.iter().map(share).sum::<f64>() - expected
            };
            let (low, high) = (ln(bounds.lower), ln(bounds.upper));
            if excess(low) <= 0.0 {
                bounds.lower
            } else if excess(high) >= 0.0 {
                bounds.upper
            } else {
                exp(root::between(excess, low, high, 1e-9))
            }
        };
        let channels = self.experiment.channels().len();
        let bounds = self.discrepancies.parameters()[..channels].iter();
        bounds.enumerate().map(one_channel).collect()
    }
}

/// Point `number` of a sequence that fills the cube of positions evenly, as coordinates.
///
/// Roberts' R-sequence (2018): the multiples of 1/g, 1/g², … with g^(d+1) = g + 1, less their
/// whole parts.
fn spread_point(number: usize, dimension: usize) -> Vec<f64> {
    /// Room left at each bound, where searches would stall [-].
    const MARGIN: f64 = 0.02;
    let mut g = 1.5_f64;
    for _ in 0..60 {
        g = pow(1.0 + g, 1.0 / (dimension as f64 + 1.0));
    }
    let position = |axis: i32| (0.5 + number as f64 * powi(g, -axis)).fract();
    (1..)
        .take(dimension)
        .map(|axis| coordinate_of(MARGIN + (1.0 - 2.0 * MARGIN) * position(axis)))
        .collect()
}

/// What the residuals add up to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// Differences, weighted.
    LeastSquares,
    /// Discrepancies as they are counted, and the prior.
    Posterior,
}

/// The residuals under given discrepancies, independent and of deviation 1.
struct Weighted<'a> {
    calibration: &'a Calibration<'a>,
    whitener: Whitener,
    purpose: Purpose,
}

/// Step of the difference quotients in a coordinate [-], in which parameters change by about their
/// own range. Predictions beside a point repeat to 1e-12 or better: the quotient errs by about 1e-6
/// of itself, by its length as much as by roundings.
const STEP: f64 = 1e-6;

impl<'a> Weighted<'a> {
    fn new(calibration: &'a Calibration<'a>, discrepancies: &[f64]) -> Self {
        let variances = calibration.errors.variances_alike(discrepancies);
        let deviations = variances.into_iter().map(f64::sqrt).collect();
        Self {
            calibration,
            whitener: Whitener::independent(deviations),
            purpose: Purpose::LeastSquares,
        }
    }

    /// With correlated errors, and the prior.
    fn correlated(calibration: &'a Calibration<'a>, discrepancies: &[f64]) -> Self {
        let whitener = calibration.errors.whitener(discrepancies);
        Self { calibration, whitener, purpose: Purpose::Posterior }
    }

    /// Half the sum of squares; infinite where there are no predictions.
    fn cost(&self, coordinates: &[f64]) -> f64 {
        let half_squares =
            |found: Evaluated| 0.5 * found.residuals.iter().map(|r| r * r).sum::<f64>();
        self.at(coordinates).map_or(f64::INFINITY, half_squares)
    }

    /// (JᵀJ)⁻¹ at a point. With the prior counted it always exists.
    fn covariance(&self, coordinates: &[f64]) -> DMatrix<f64> {
        let dimension = coordinates.len();
        let prior_alone =
            || DMatrix::identity(dimension, dimension) * super::parameter::COORDINATE_VARIANCE;
        let Some(columns) = self.jacobian_at(coordinates, &[]) else { return prior_alone() };
        let rows = columns.first().map_or(0, Vec::len);
        let jacobian = DMatrix::from_iterator(rows, dimension, columns.into_iter().flatten());
        let precision = jacobian.transpose() * jacobian;
        precision.cholesky().map_or_else(prior_alone, |factor| factor.inverse())
    }
}

impl Weighted<'_> {
    /// The residuals at a point with these predictions.
    fn of_predictions(&self, coordinates: &[f64], predictions: &[f64]) -> Option<Vec<f64>> {
        let calibration = self.calibration;
        let observations = calibration.experiment.observations();
        let beyond: Vec<f64> = match self.purpose {
            Purpose::LeastSquares => {
                let pairs = observations.iter().zip(predictions);
                pairs.map(|(observation, prediction)| prediction - observation.value).collect()
            }
            Purpose::Posterior => {
                let residuals = calibration.errors.residuals(observations, predictions);
                residuals.into_iter().map(|residual| -residual).collect()
            }
        };
        let mut residuals = self.whitener.whitened(&beyond);
        if self.purpose == Purpose::Posterior {
            residuals.extend(coordinates.iter().map(|&coordinate| prior_residual(coordinate)));
        }
        residuals.iter().all(|residual| residual.is_finite()).then_some(residuals)
    }
}

impl Residuals for Weighted<'_> {
    fn at(&self, coordinates: &[f64]) -> Option<Evaluated> {
        let Calibration { experiment, space, .. } = self.calibration;
        let mut predictions = vec![0.0; experiment.observations().len()];
        let values = space.values(coordinates);
        let kept = experiment.predict_and_keep(&values, &mut predictions).ok()?;
        Some(Evaluated { residuals: self.of_predictions(coordinates, &predictions)?, kept })
    }

    fn jacobian_at(&self, coordinates: &[f64], kept: &[f64]) -> Option<Vec<Vec<f64>>> {
        let Calibration { experiment, space, .. } = self.calibration;
        let moved = |axis: usize| {
            let mut point = coordinates.to_vec();
            point[axis] += STEP;
            point
        };
        let points: Vec<Vec<f64>> =
            std::iter::once(coordinates.to_vec()).chain((0..space.len()).map(moved)).collect();
        let values: Vec<Vec<f64>> = points.iter().map(|point| space.values(point)).collect();
        let beside = experiment.predict_beside(&values[0], kept, &values);
        let each = points.iter().zip(&beside);
        let mut residuals =
            each.map(|(point, predictions)| self.of_predictions(point, predictions.as_ref()?));
        let here = residuals.next()??;
        let column = |(axis, there): (usize, Option<Vec<f64>>)| {
            let step = points[axis + 1][axis] - coordinates[axis];
            Some(there?.iter().zip(&here).map(|(there, here)| (there - here) / step).collect())
        };
        residuals.enumerate().map(column).collect()
    }
}

/// A residual whose square, halved, is the prior's part of the cost: −ln[4 p (1 − p)].
fn prior_residual(coordinate: f64) -> f64 {
    /// ln 4: the cost is zero in the middle.
    const LN_4: f64 = 2.0 * std::f64::consts::LN_2;
    let cost = -ParameterSpace::log_prior(&[coordinate]) - LN_4;
    (2.0 * cost.max(0.0)).sqrt().copysign(coordinate)
}

#[cfg(test)]
mod tests {
    use super::super::parameter::position_of;
    use super::super::posterior::share_of;
    use super::*;

    /// Low discrepancy: the first points of the plane's sequence leave no empty quarter of a
    /// sixteenth. (g is the plastic number there: 1.3247.)
    #[test]
    fn spread_points_fill_the_plane_evenly() {
        let mut counts = [[0; 4]; 4];
        for number in 1..=64 {
            let point = spread_point(number, 2);
            let cell = |u: f64| share_of(4, position_of(u));
            counts[cell(point[0])][cell(point[1])] += 1;
        }
        // Four each, if they were perfectly even.
        for count in counts.into_iter().flatten() {
            assert!((2..=6).contains(&count), "{counts:?}");
        }
    }

    #[test]
    fn the_priors_residual_is_smooth_and_odd() {
        for coordinate in [1e-4, 0.1, 1.0, 5.0, 40.0] {
            let (above, below) = (prior_residual(coordinate), prior_residual(-coordinate));
            assert!((above + below).abs() < 1e-12);
            assert!(above > 0.0);
        }
        // −ln[4 p (1 − p)] = u²/4 + …, so that the residual starts as u/√2.
        assert!((prior_residual(1e-3) / 1e-3 - 0.5_f64.sqrt()).abs() < 1e-5);
    }
}
