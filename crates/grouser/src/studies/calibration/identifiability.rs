//! What the data cannot tell: parameters that they hardly narrow, and those that make up for each
//! other.
//!
//! Asked in positions (the prior's own scale, [`parameter`](super::parameter)), in units of the
//! prior's deviation: there a direction of size 1 is one about which nothing was learnt.

use nalgebra::{DMatrix, SymmetricEigen};

use super::Calibration;
use super::diagnostics::{Samples, correlations_of, covariance_of};
use super::fit::Fit;
use super::parameter::{PRIOR_DEVIATION, position_of};

/// What the data leave open.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Deviation of each parameter over its prior's [-]: near 1 the data say nothing of it alone.
    pub narrowing: Vec<f64>,
    /// Directions that the data hardly narrow, the widest first.
    pub loose: Vec<Combination>,
    /// Pairs that make up for each other, the most so first.
    pub pairs: Vec<Pair>,
}

/// A combination of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Parameters, by their places, and their shares: those of at least a fifth of the largest,
    /// which is positive and first.
    pub shares: Vec<(usize, f64)>,
    /// Its deviation over the prior's [-].
    pub narrowing: f64,
}

/// Two parameters that the data tell apart badly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Places of the two.
    pub parameters: [usize; 2],
    /// Their correlation [-]: near −1 their sum is known, near 1 their difference.
    pub correlation: f64,
}

/// A direction is loose if the data leave more than this of its prior's deviation [-].
pub const LOOSE: f64 = 0.5;

/// Parameters make up for each other from this correlation on [-].
pub const CORRELATED: f64 = 0.9;

/// Shares below this part of the largest are left out [-].
const WORTH_NAMING: f64 = 0.2;

impl Identifiability {
    /// As samples of the posterior tell.
    #[must_use]
    pub fn of_samples(calibration: &Calibration, samples: &Samples) -> Self {
        let parameters = calibration.space().len();
        let scaled = |row: &Vec<f64>| -> Vec<f64> {
            let positions = calibration.space().positions(&row[..parameters]);
            positions.iter().map(|position| position / PRIOR_DEVIATION).collect()
        };
        let rows: Vec<Vec<f64>> = samples.rows().map(scaled).collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        Self::of_covariance(&covariance_of(&rows))
    }

    /// As the curvature near a fit tells, to first order; the samples know better.
    ///
    /// Taken where the prior counts as well: least squares alone may slide along what the data do
    /// not tell apart until a bound ends it, and there nothing varies.
    #[must_use]
    pub fn of_fit(calibration: &Calibration, fit: &Fit) -> Self {
        let (mode, covariance) = calibration.mode_near(fit);
        // dp/du = p (1 − p).
        let slope = |u: f64| position_of(u) * position_of(-u) / PRIOR_DEVIATION;
        let slopes: Vec<f64> = mode.iter().map(|&u| slope(u)).collect();
        let scaled = |i, j| covariance[(i, j)] * slopes[i] * slopes[j];
        let size = slopes.len();
        Self::of_covariance(&DMatrix::from_fn(size, size, scaled))
    }

    /// Of a covariance of positions in units of the prior's deviation.
    #[must_use]
    pub fn of_covariance(covariance: &DMatrix<f64>) -> Self {
        let size = covariance.nrows();
        let narrowing = (0..size).map(|i| covariance[(i, i)].max(0.0).sqrt()).collect();
        let correlations = correlations_of(covariance);
        let mut pairs = Vec::new();
        for j in 0..size {
            for i in 0..j {
                let correlation = correlations[(i, j)];
                if correlation.abs() >= CORRELATED {
                    pairs.push(Pair { parameters: [i, j], correlation });
                }
            }
        }
        pairs.sort_by(|one, other| other.correlation.abs().total_cmp(&one.correlation.abs()));
        Self { narrowing, loose: loose_directions(covariance), pairs }
    }
}

fn loose_directions(covariance: &DMatrix<f64>) -> Vec<Combination> {
    let eigen = SymmetricEigen::new(covariance.clone());
    let mut loose = Vec::new();
    for (&variance, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let narrowing = variance.max(0.0).sqrt();
        if narrowing > LOOSE {
            let direction: Vec<f64> = direction.iter().copied().collect();
            loose.push(Combination { shares: worth_naming(&direction), narrowing });
        }
    }
    loose.sort_by(|one, other| other.narrowing.total_cmp(&one.narrowing));
    loose
}

fn worth_naming(direction: &[f64]) -> Vec<(usize, f64)> {
    let mut shares: Vec<(usize, f64)> = direction.iter().copied().enumerate().collect();
    shares.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
    let largest = shares.first().map_or(0.0, |share| share.1);
    let sign = 1.0_f64.copysign(largest);
    shares.retain(|(_, share)| share.abs() >= WORTH_NAMING * largest.abs());
    shares.into_iter().map(|(parameter, share)| (parameter, sign * share)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two parameters of which only the sum is known, and a third that is known.
    #[test]
    fn a_sum_that_is_known_leaves_the_difference_loose() {
        let covariance =
            DMatrix::from_row_slice(3, 3, &[0.5, -0.499, 0.0, -0.499, 0.5, 0.0, 0.0, 0.0, 0.0001]);
        let found = Identifiability::of_covariance(&covariance);
        assert_eq!(found.loose.len(), 1);
        let loose = &found.loose[0];
        // The eigenvalue of (1, −1)/√2 is 0.5 + 0.499.
        assert!((loose.narrowing - 0.999_f64.sqrt()).abs() < 1e-12);
        let [(one, share), (other, against)] = loose.shares[..] else { panic!("{loose:?}") };
        assert_eq!([one.min(other), one.max(other)], [0, 1]);
        assert!((share + against).abs() < 1e-9 && share > 0.0);
        assert_eq!(found.pairs.len(), 1);
        assert_eq!(found.pairs[0].parameters, [0, 1]);
        assert!((found.narrowing[2] - 0.01).abs() < 1e-12);
    }

    #[test]
    fn parameters_that_are_all_known_leave_nothing_open() {
        let found = Identifiability::of_covariance(&(DMatrix::identity(4, 4) * 0.01));
        assert!(found.loose.is_empty() && found.pairs.is_empty());
    }
}
