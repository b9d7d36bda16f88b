//! Identifiability: parameters and combinations that the data do not determine, and pairs that
//! compensate for each other.
//!
//! It is judged by the posterior contraction, in positions (the prior's own scale,
//! [`parameter`](super::parameter)) and units of the prior's deviation: a direction of size 1 is as
//! wide as the prior.

use nalgebra::{DMatrix, SymmetricEigen};

use super::Calibration;
use super::diagnostics::{Samples, correlations_of, covariance_of};
use super::fit::Fit;
use super::parameter::{PRIOR_DEVIATION, position_of};

/// Which parameters the data determine, and how well.
#[derive(Clone, Debug, PartialEq)]
pub struct Identifiability {
    /// Posterior contraction: deviation of each parameter over its prior's [-]; near 1 the data do
    /// not constrain it.
    pub contraction: Vec<f64>,
    /// Directions that the data do not determine, the widest first.
    pub unidentifiable: Vec<Combination>,
    /// Pairs that compensate for each other, the most correlated first.
    pub pairs: Vec<Pair>,
}

/// A combination of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Parameters, by their places, and their shares: those of at least a fifth of the largest,
    /// which is positive and first.
    pub shares: Vec<(usize, f64)>,
    /// Posterior contraction: its deviation over the prior's [-].
    pub contraction: f64,
}

/// Two correlated parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Places of the two.
    pub parameters: [usize; 2],
    /// Their correlation [-]: near −1 their sum is known, near 1 their difference.
    pub correlation: f64,
}

/// A direction is unidentifiable where its posterior contraction is above this [-].
pub const UNIDENTIFIABLE: f64 = 0.5;

/// Parameters compensate for each other from this correlation on [-].
pub const CORRELATED: f64 = 0.9;

/// Shares below this part of the largest are left out [-].
const WORTH_NAMING: f64 = 0.2;

impl Identifiability {
    /// The identifiability by posterior samples.
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

    /// The identifiability by the curvature near a fit, to first order; samples are more accurate.
    ///
    /// The curvature is taken with the prior included: least squares alone may slide along an
    /// unidentifiable direction until a bound ends it, and nothing varies there.
    #[must_use]
    pub fn of_fit(calibration: &Calibration, fit: &Fit) -> Self {
        let (mode, covariance) = calibration.mode_near(fit);
        Self::of_mode(&mode, &covariance)
    }

    /// The identifiability by the curvature at the mode near a fit.
    pub(super) fn of_mode(mode: &[f64], covariance: &DMatrix<f64>) -> Self {
        // dp/du = p (1 − p).
        let slope = |u: f64| position_of(u) * position_of(-u) / PRIOR_DEVIATION;
        let slopes: Vec<f64> = mode.iter().map(|&u| slope(u)).collect();
        let scaled = |i, j| covariance[(i, j)] * slopes[i] * slopes[j];
        let size = slopes.len();
        Self::of_covariance(&DMatrix::from_fn(size, size, scaled))
    }

    /// The identifiability by a covariance of positions in units of the prior's deviation.
    #[must_use]
    pub fn of_covariance(covariance: &DMatrix<f64>) -> Self {
        let size = covariance.nrows();
        let contraction = (0..size).map(|i| covariance[(i, i)].max(0.0).sqrt()).collect();
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
        Self { contraction, unidentifiable: unidentifiable_directions(covariance), pairs }
    }
}

fn unidentifiable_directions(covariance: &DMatrix<f64>) -> Vec<Combination> {
    let eigen = SymmetricEigen::new(covariance.clone());
    let mut unidentifiable = Vec::new();
    for (&variance, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        let contraction = variance.max(0.0).sqrt();
        if contraction > UNIDENTIFIABLE {
            let direction: Vec<f64> = direction.iter().copied().collect();
            unidentifiable.push(Combination { shares: worth_naming(&direction), contraction });
        }
    }
    unidentifiable.sort_by(|one, other| other.contraction.total_cmp(&one.contraction));
    unidentifiable
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
        assert_eq!(found.unidentifiable.len(), 1);
        let unidentifiable = &found.unidentifiable[0];
        // The eigenvalue of (1, −1)/√2 is 0.5 + 0.499.
        assert!((unidentifiable.contraction - 0.999_f64.sqrt()).abs() < 1e-12);
        let [(one, share), (other, against)] = unidentifiable.shares[..] else {
            panic!("{unidentifiable:?}")
        };
        assert_eq!([one.min(other), one.max(other)], [0, 1]);
        assert!((share + against).abs() < 1e-9 && share > 0.0);
        assert_eq!(found.pairs.len(), 1);
        assert_eq!(found.pairs[0].parameters, [0, 1]);
        assert!((found.contraction[2] - 0.01).abs() < 1e-12);
    }

    #[test]
    fn parameters_that_are_all_known_leave_nothing_open() {
        let found = Identifiability::of_covariance(&(DMatrix::identity(4, 4) * 0.01));
        assert!(found.unidentifiable.is_empty() && found.pairs.is_empty());
    }
}
