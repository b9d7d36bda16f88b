//! The Gaussian process that discrepancies are drawn from.

use nalgebra::{Cholesky, DMatrix};

use crate::soil::Discrepancy;
use crate::soil::discrepancy::{LARGEST, SLIP_ANGLES, SLIPS};
use crate::studies::random;

/// Standard deviation of the drawbar pull, and of the side force [shares of the load].
pub(super) const FORCE: f64 = 0.03;

/// Standard deviation of the logarithm of the sinkage [-].
pub(super) const SINKAGE: f64 = 0.25;

/// Standard deviation of the torque [shares of load times shearing radius].
pub(super) const TORQUE: f64 = 0.05;

/// Over which slips a model errs alike [-].
pub(super) const SLIP_LENGTH: f64 = 0.5;

/// Over which slip angles it does [rad].
pub(super) const ANGLE_LENGTH: f64 = std::f64::consts::FRAC_PI_6;

/// Streams of random numbers that no sample of a soil has.
const STREAMS: u64 = 0xFD << 56;

/// The discrepancy of sample number `index`.
#[must_use]
pub fn drawn(seed: u64, index: u64) -> Discrepancy {
    let mut random = random::generator(seed, STREAMS | index);
    let along = root(&SLIPS, SLIP_LENGTH);
    let mut values = |angles: &[f64], deviation: f64| -> Vec<f64> {
        let across = root(angles, ANGLE_LENGTH);
        let numbers = DMatrix::from_fn(SLIPS.len(), angles.len(), |_, _| {
            random::standard_normal(&mut random)
        });
        // Slips run down a column: the order of a discrepancy's values.
        let smooth = deviation * (&along * numbers * across.transpose());
        smooth.iter().map(|value| value.clamp(-LARGEST, LARGEST)).collect()
    };
    let mut discrepancy = Discrepancy::NONE;
    discrepancy.drawbar_pull.copy_from_slice(&values(&SLIP_ANGLES, FORCE));
    discrepancy.side_force.copy_from_slice(&values(&SLIP_ANGLES[1..], FORCE));
    discrepancy.sinkage.copy_from_slice(&values(&SLIP_ANGLES, SINKAGE));
    discrepancy.torque.copy_from_slice(&values(&SLIP_ANGLES, TORQUE));
    discrepancy
}

/// A triangular root of the correlations exp(−(x − x')²/2ℓ²) between places.
fn root(places: &[f64], length: f64) -> DMatrix<f64> {
    let correlations = correlations(places, length);
    // Places that differ have independent values: the matrix is positive definite.
    Cholesky::new(correlations.clone()).map_or(correlations, |root| root.l())
}

/// Correlations exp(−(x − x')²/2ℓ²) between places.
pub(super) fn correlations(places: &[f64], length: f64) -> DMatrix<f64> {
    DMatrix::from_fn(places.len(), places.len(), |one, other| {
        let apart = (places[one] - places[other]) / length;
        crate::elementary::exp(-0.5 * apart * apart)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn many() -> Vec<Discrepancy> {
        (0..4000).map(|index| drawn(3, index)).collect()
    }

    /// 4000 samples: a deviation is known to 1.1 %, a correlation to 0.016.
    #[test]
    fn samples_have_the_stated_deviations_and_correlations() {
        let all = many();
        let mean =
            |of: &dyn Fn(&Discrepancy) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        for place in 0..SLIPS.len() * SLIP_ANGLES.len() {
            let variance = mean(&|it| it.drawbar_pull[place].powi(2));
            assert!((variance.sqrt() / FORCE - 1.0).abs() < 0.06, "{place}: {variance}");
        }
        let pair = mean(&|it| it.sinkage[1] * it.sinkage[2]) / SINKAGE.powi(2);
        assert!((pair - (-0.5_f64).exp()).abs() < 0.08, "{pair}");
        let apart = mean(&|it| it.torque[0] * it.torque[4]) / TORQUE.powi(2);
        assert!(apart.abs() < 0.08, "{apart}");
        let crossed = mean(&|it| it.torque[2] * it.drawbar_pull[2]) / TORQUE / FORCE;
        assert!(crossed.abs() < 0.08, "quantities err independently: {crossed}");
    }

    #[test]
    fn a_sample_depends_on_seed_and_number_alone() {
        assert_eq!(drawn(7, 5), drawn(7, 5));
        assert_ne!(drawn(7, 5), drawn(7, 6));
        assert_ne!(drawn(7, 5), drawn(8, 5));
    }
}
