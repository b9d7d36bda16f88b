//! What each number of an observation taught: how much of the information came from forces, torques
//! and sinkages.
//!
//! The information of an observation of normal unknowns is *½ ln (det S / det R)*, with the
//! covariance *S* of what is expected and *R* of that once the unknowns are known. By the roots of
//! both (*L Lᵀ*) it is a sum over the numbers,
//!
//! ```text
//! I = Σ_i (ln L_S,ii − ln L_R,ii)
//! ```
//!
//! in which each number counts for what it adds to those before it.

use nalgebra::Cholesky;

use super::gaussian::{Gaussian, Line};
use super::stretch::Stretch;
use crate::elementary::wide::ln;

/// How much each kind of observation narrowed what is believed of the soil [nat], each for what it
/// adds to those before it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InformationByKind {
    /// The force along the body, by the velocity along it.
    pub along: f64,
    /// The force across the body, by the velocity to its left.
    pub across: f64,
    /// The yaw moment, by the yaw rate.
    pub turning: f64,
    /// The wheels' torques.
    pub torque: f64,
    /// The wheels' sinkages.
    pub sinkage: f64,
}

impl InformationByKind {
    /// Adds up the information of a stretch's numbers by kind. The numbers are in the order of
    /// observations: along, across, turning, torques, sinkages.
    pub(super) fn of(stretch: &Stretch, by_number: &[f64]) -> Self {
        let [along, across, turning] =
            [0, 1, 2].map(|place| by_number.get(place).copied().unwrap_or(0.0));
        let torques = stretch.torques.iter().flatten().count();
        let rest = by_number.get(3..).unwrap_or(&[]);
        let (torques, sinkages) = rest.split_at(torques.min(rest.len()));
        let (torque, sinkage) = (torques.iter().sum(), sinkages.iter().sum());
        Self { along, across, turning, torque, sinkage }
    }
}

/// How much each number of an observation narrowed what is believed [nat]. Nothing where a
/// covariance is not positive definite.
///
/// * `belief`: before the observation
pub(super) fn by_number(belief: &Gaussian, line: &Line) -> Vec<f64> {
    let known = line.noise.clone();
    let expected = &line.jacobian * &belief.covariance * line.jacobian.transpose() + &known;
    let roots = Cholesky::new(expected).zip(Cholesky::new(known));
    let Some((expected, known)) = roots else { return vec![0.0; line.value.len()] };
    let (expected, known) = (expected.l().diagonal(), known.l().diagonal());
    expected.iter().zip(known.iter()).map(|(one, other)| ln(*one) - ln(*other)).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    /// The parts add up to what the belief narrows by.
    #[test]
    fn parts_add_up_to_what_the_belief_narrows_by() {
        let line = Line {
            at: DVector::zeros(2),
            value: DVector::zeros(3),
            jacobian: DMatrix::from_row_slice(3, 2, &[1.0, 0.4, -0.3, 0.8, 0.2, -0.1]),
            noise: DMatrix::from_diagonal(&DVector::from_row_slice(&[0.3, 0.5, 0.2])),
        };
        let belief = Gaussian::standard(2);
        let after = belief.after(&line, &DVector::from_row_slice(&[0.1, 0.2, 0.3])).unwrap();
        let parts = by_number(&belief, &line);
        let narrowed = -0.5 * ln(after.covariance.determinant());
        assert!((parts.iter().sum::<f64>() - narrowed).abs() < 1e-12);
        assert!(parts.iter().all(|it| *it > 0.0), "{parts:?}");
    }
}
