//! What is believed of unknowns that are normal: a mean and a covariance, and how an observation
//! changes them.
//!
//! ```text
//! y ≈ b + J (x − x₀) + noise, R        S = J P Jᵀ + R        K = P Jᵀ S⁻¹
//! m' = m + K [y − b − J (m − x₀)]        P' = (I − K J) P (I − K J)ᵀ + K R Kᵀ
//! ```
//!
//! This is Kalman's filter (1960). Where y does not go with x along a straight line, b and J are
//! those of the line that fits it best over the width of a belief, and what is off the line is
//! noise ([`Line`]): first over what is believed beforehand, then over what is believed afterwards
//! (García-Fernández et al. 2015). A tangent would do for small widths alone; over wide ones it
//! takes the bend for a surprise, every time in the same direction.

use std::f64::consts::TAU;

use nalgebra::{Cholesky, DMatrix, DVector};

use super::archive::{Archive, matrix, vector};
use crate::elementary::wide::ln;

/// Unknowns that are normal.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Gaussian {
    /// *m*.
    pub(super) mean: DVector<f64>,
    /// *P*.
    pub(super) covariance: DMatrix<f64>,
}

/// A line that stands for how an observation goes with the unknowns.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    /// *x₀*.
    pub(super) at: DVector<f64>,
    /// *b*.
    pub(super) value: DVector<f64>,
    /// *J*.
    pub(super) jacobian: DMatrix<f64>,
    /// *R*: of what is off the line, and of the observation.
    pub(super) noise: DMatrix<f64>,
}

impl Line {
    /// The line over the width of a belief, by differences of √3 standard deviations along each
    /// axis of its root (Nørgaard et al. 2000): exact up to the third power along each axis.
    ///
    /// * `f`: the function; `None` where it has no value, which counts as that at the mean
    /// * `here`: its value at the mean
    pub(super) fn over(
        belief: &Gaussian,
        here: &DVector<f64>,
        f: impl Fn(&DVector<f64>) -> Option<DVector<f64>>,
    ) -> Self {
        const WIDTH: f64 = 3.0;
        let root = belief.root();
        let count = belief.mean.len();
        let mut value = here.clone();
        let mut noise = DMatrix::zeros(here.len(), here.len());
        let mut slopes = DMatrix::zeros(here.len(), count);
        for (place, axis) in root.column_iter().enumerate() {
            let step = axis * WIDTH.sqrt();
            let ahead = f(&(&belief.mean + &step)).unwrap_or_else(|| here.clone());
            let behind = f(&(&belief.mean - &step)).unwrap_or_else(|| here.clone());
            slopes.set_column(place, &((&ahead - &behind) / (2.0 * WIDTH.sqrt())));
            let bend = ahead + behind - here * 2.0;
            value += &bend / (2.0 * WIDTH);
            noise += &bend * bend.transpose() * ((WIDTH - 1.0) / (4.0 * WIDTH * WIDTH));
        }
        // J L = the slopes along the axes.
        let jacobian = root.transpose().lu().solve(&slopes.transpose());
        let jacobian =
            jacobian.map_or_else(|| DMatrix::zeros(here.len(), count), |it| it.transpose());
        Self { at: belief.mean.clone(), value, jacobian, noise }
    }
}

/// How far an observation was from what was expected of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surprise {
    /// Score of each number, in standard deviations [-].
    pub(super) scores: DVector<f64>,
    /// The logarithm of its density.
    pub(super) log_density: f64,
}

impl Gaussian {
    /// Mean 0, variance 1, no correlation.
    pub(super) fn standard(count: usize) -> Self {
        Self { mean: DVector::zeros(count), covariance: DMatrix::identity(count, count) }
    }

    /// What is left of it after unknowns have wandered, each by x → a x + √(1 − a²) z: standard
    /// normal stays so.
    ///
    /// * `kept`: *a* of each, 0 to 1
    pub(super) fn forget(&mut self, kept: &DVector<f64>) {
        self.mean.component_mul_assign(kept);
        for (row, of_row) in kept.iter().enumerate() {
            for (column, of_column) in kept.iter().enumerate() {
                self.covariance[(row, column)] *= of_row * of_column;
            }
            self.covariance[(row, row)] += 1.0 - of_row * of_row;
        }
    }

    /// After an observation. `None` where its covariance is not positive definite.
    pub(super) fn after(&self, line: &Line, seen: &DVector<f64>) -> Option<Self> {
        let Line { at, value, jacobian, noise } = line;
        let with_seen = &self.covariance * jacobian.transpose();
        let root = Cholesky::new(jacobian * &with_seen + noise)?;
        let gain = root.solve(&with_seen.transpose()).transpose();
        let expected = value + jacobian * (&self.mean - at);
        let mean = &self.mean + &gain * (seen - expected);
        let count = self.mean.len();
        let kept = DMatrix::identity(count, count) - &gain * jacobian;
        let covariance =
            &kept * &self.covariance * kept.transpose() + &gain * noise * gain.transpose();
        let covariance = (&covariance + covariance.transpose()) * 0.5;
        Some(Self { mean, covariance })
    }

    /// How far an observation is from what is expected of it.
    pub(super) fn surprise(&self, line: &Line, seen: &DVector<f64>) -> Option<Surprise> {
        let Line { at, value, jacobian, noise } = line;
        let off = seen - (value + jacobian * (&self.mean - at));
        let covariance = jacobian * &self.covariance * jacobian.transpose() + noise;
        let deviations = covariance.diagonal().map(f64::sqrt);
        let log_density = log_density(&off, covariance)?;
        Some(Surprise { scores: off.component_div(&deviations), log_density })
    }

    /// A triangular root of its covariance.
    pub(super) fn root(&self) -> DMatrix<f64> {
        let count = self.mean.len();
        let root = Cholesky::new(self.covariance.clone());
        root.map_or_else(|| DMatrix::zeros(count, count), |root| root.l())
    }

    /// How far a place is from its mean, in standard deviations [-].
    pub(super) fn distance(&self, at: &DVector<f64>) -> f64 {
        let from_mean = at - &self.mean;
        let root = Cholesky::new(self.covariance.clone());
        root.map_or(0.0, |root| from_mean.dot(&root.solve(&from_mean)).sqrt())
    }
}

impl Gaussian {
    /// Writes or reads it.
    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { mean, covariance } = self;
        vector(archive, "mean", mean);
        matrix(archive, "covariance", covariance);
    }

    /// Whether it is of so many unknowns.
    pub(super) fn is_of(&self, count: usize) -> bool {
        self.mean.len() == count && self.covariance.shape() == (count, count)
    }
}

/// The logarithm of the density of what is normal, of mean 0.
pub(super) fn log_density(at: &DVector<f64>, covariance: DMatrix<f64>) -> Option<f64> {
    let root = Cholesky::new(covariance)?;
    let squared = at.dot(&root.solve(at));
    let log_determinant: f64 = root.l().diagonal().iter().map(|it| 2.0 * ln(*it)).sum();
    Some(-0.5 * (squared + log_determinant + ln(TAU) * at.len() as f64))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::studies::random;

    fn linear() -> (DMatrix<f64>, DMatrix<f64>, [DVector<f64>; 4]) {
        let jacobian = DMatrix::from_row_slice(2, 3, &[1.0, 0.5, -0.3, 0.2, -1.0, 0.7]);
        let noise = DMatrix::from_row_slice(2, 2, &[0.04, 0.01, 0.01, 0.09]);
        let seen = [[0.3, -0.2], [0.7, 0.1], [-0.4, 0.9], [0.2, 0.3]];
        (jacobian, noise, seen.map(|it| DVector::from_row_slice(&it)))
    }

    /// A linear observation in noise that is normal: the posterior is the closed form of least
    /// squares, whichever place it is linearised at, and in whatever order the observations come.
    #[test]
    fn a_linear_toy_is_the_closed_form() {
        let (jacobian, noise, seen) = linear();
        let prior = Gaussian::standard(3);
        let weight = noise.clone().try_inverse().unwrap();
        let information = DMatrix::identity(3, 3)
            + (jacobian.transpose() * &weight * &jacobian) * seen.len() as f64;
        let sum: DVector<f64> = seen.iter().sum();
        let exact = information.clone().try_inverse().unwrap();
        let mean = &exact * jacobian.transpose() * &weight * sum;
        let learn = |order: &[usize]| {
            order.iter().fold(prior.clone(), |belief, place| {
                let here = &jacobian * &belief.mean;
                let mut line = Line::over(&belief, &here, |at| Some(&jacobian * at));
                line.noise += &noise;
                belief.after(&line, &seen[*place]).unwrap()
            })
        };
        for order in [[0, 1, 2, 3], [3, 1, 0, 2]] {
            let found = learn(&order);
            assert!((&found.mean - &mean).norm() < 1e-9);
            assert!((&found.covariance - &exact).norm() < 1e-9);
        }
    }

    /// A linear observation: *J*, *R* and *y*.
    type Observation = (DMatrix<f64>, DMatrix<f64>, DVector<f64>);

    /// Observations of random unknowns, each of as many numbers and with a noise of its own.
    fn observations(seed: u64, unknowns: usize, numbers: usize, count: usize) -> Vec<Observation> {
        let mut random = random::generator(seed, 0);
        let mut normals = |rows, columns| {
            DMatrix::from_fn(rows, columns, |_, _| random::standard_normal(&mut random))
        };
        let one = |_| {
            let (jacobian, root) = (normals(numbers, unknowns), normals(numbers, numbers));
            let noise = &root * root.transpose() + DMatrix::identity(numbers, numbers) * 0.1;
            (jacobian, noise, normals(numbers, 1).column(0).into())
        };
        (0..count).map(one).collect()
    }

    proptest! {
        /// One observation after the other is what generalised least squares makes of all of them
        /// at once: P = (1 + Σ Jᵀ R⁻¹ J)⁻¹, m = P Σ Jᵀ R⁻¹ y.
        #[test]
        fn a_linear_toy_is_least_squares_over_all(
            seed: u64, unknowns in 1..9_usize, numbers in 1..7_usize, count in 1..9_usize,
        ) {
            let all = observations(seed, unknowns, numbers, count);
            let mut belief = Gaussian::standard(unknowns);
            let mut information = DMatrix::identity(unknowns, unknowns);
            let mut sum = DVector::zeros(unknowns);
            for (jacobian, noise, seen) in &all {
                let here = jacobian * &belief.mean;
                let mut line = Line::over(&belief, &here, |at| Some(jacobian * at));
                line.noise += noise;
                belief = belief.after(&line, seen).unwrap();
                let weighted = jacobian.transpose() * noise.clone().try_inverse().unwrap();
                information += &weighted * jacobian;
                sum += &weighted * seen;
            }
            let exact = information.try_inverse().unwrap();
            prop_assert!((&belief.covariance - &exact).norm() < 1e-9);
            prop_assert!((&belief.mean - exact * sum).norm() < 1e-9);
        }
    }

    /// A scalar that wanders and is seen: Kalman's recursion written out.
    #[test]
    fn a_wandering_scalar_is_kalmans_recursion() {
        let (kept, noise) = (0.9_f64, 0.3_f64);
        let mut belief = Gaussian::standard(1);
        let (mut mean, mut variance) = (0.0, 1.0);
        for seen in [0.4, 1.1, -0.7, 0.2, 2.0, 1.5] {
            belief.forget(&DVector::from_element(1, kept));
            let line = Line {
                at: DVector::zeros(1),
                value: DVector::zeros(1),
                jacobian: DMatrix::identity(1, 1),
                noise: DMatrix::from_element(1, 1, noise),
            };
            belief = belief.after(&line, &DVector::from_element(1, seen)).unwrap();
            (mean, variance) = (kept * mean, kept * kept * variance + 1.0 - kept * kept);
            let gain = variance / (variance + noise);
            mean += gain * (seen - mean);
            variance *= 1.0 - gain;
            assert!((belief.mean[0] - mean).abs() < 1e-9);
            assert!((belief.covariance[(0, 0)] - variance).abs() < 1e-9);
        }
    }

    #[test]
    fn what_is_standard_normal_stays_so_while_it_wanders() {
        let mut belief = Gaussian::standard(3);
        belief.forget(&DVector::from_row_slice(&[0.2, 1.0, 0.9]));
        assert!((belief.covariance - DMatrix::identity(3, 3)).norm() < 1e-12);
    }

    /// The density of two numbers is the product of that of the first and that of the second once
    /// the first is known.
    #[test]
    fn densities_multiply() {
        let (jacobian, noise, [seen, ..]) = linear();
        let noise = DMatrix::from_diagonal(&noise.diagonal());
        let line = |rows: &[usize]| Line {
            at: DVector::zeros(3),
            value: DVector::zeros(rows.len()),
            jacobian: jacobian.select_rows(rows),
            noise: noise.select_rows(rows).select_columns(rows),
        };
        let density = |belief: &Gaussian, rows: &[usize]| {
            belief.surprise(&line(rows), &seen.select_rows(rows)).unwrap().log_density
        };
        let prior = Gaussian::standard(3);
        let (both, first) = (density(&prior, &[0, 1]), density(&prior, &[0]));
        let then = prior.after(&line(&[0]), &seen.select_rows(&[0])).unwrap();
        let second = density(&then, &[1]);
        assert!((both - first - second).abs() < 1e-9);
    }

    /// The line over a parabola has its mean and its slope there, and what is off it as noise.
    #[test]
    fn a_line_over_a_parabola_has_its_mean_and_variance() {
        let belief = Gaussian {
            mean: DVector::from_element(1, 0.5),
            covariance: DMatrix::from_element(1, 1, 0.04),
        };
        let f = |at: &DVector<f64>| Some(at.map(|x| 3.0 * x * x));
        let line = Line::over(&belief, &f(&belief.mean).unwrap(), f);
        assert!((line.value[0] - 3.0 * (0.25 + 0.04)).abs() < 1e-12);
        assert!((line.jacobian[(0, 0)] - 3.0).abs() < 1e-12);
        assert!((line.noise[(0, 0)] - 9.0 * 2.0 * 0.04 * 0.04).abs() < 1e-12);
    }
}
