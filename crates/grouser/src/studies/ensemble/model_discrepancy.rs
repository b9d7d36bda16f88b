//! How far off a wheel–soil model may be under a wheel that nobody tested on a soil: a discrepancy drawn for
//! each sample of a band.
//!
//! The spread of a model's constants, and of models, is not all: measured wheels scatter about every model, and
//! what a model misses at one slip it misses at the next. Each sample therefore has one smooth function of slip
//! and slip angle for each quantity ([`Discrepancy`]), from a Gaussian process with the deviations and lengths
//! below. A soil whose samples bring a discrepancy of their own, from a calibration, keeps that.
//!
//! Source: ours. The deviations are about those of the residuals that are left, on the published wheel tests,
//! beside the spread of soils and models (`docs/validation.md`); slips 0.5 apart, and slip angles 30° apart, are
//! correlated by e^(−1/2), as the residuals of the CMU wheels are.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::soil::discrepancy::{Blend, LARGEST, SIDE_VALUES, SLIP_ANGLES, SLIPS, VALUES};
use crate::soil::{Discrepancy, Soil};
use crate::studies::random;

/// Of the drawbar pull, and of the side force [shares of the load].
const FORCE: f64 = 0.05;

/// Of the logarithm of the sinkage [-].
const SINKAGE: f64 = 0.25;

/// Of the torque [shares of load times shearing radius].
const TORQUE: f64 = 0.05;

/// Over which slips a model errs alike [-].
const SLIP_LENGTH: f64 = 0.5;

/// Over which slip angles it does [rad].
const ANGLE_LENGTH: f64 = std::f64::consts::FRAC_PI_6;

/// A soil with the discrepancy of sample number `index`, which depends on the seed and that number alone; one that
/// has a discrepancy keeps it.
#[must_use]
pub fn with_discrepancy(soil: Soil, seed: u64, index: u64) -> Soil {
    let discrepancy = soil.discrepancy.or_else(|| Some(drawn(seed, index)));
    Soil { discrepancy, ..soil }
}

/// Streams of random numbers that no sample of a soil has.
const STREAMS: u64 = 0xFD << 56;

/// The discrepancy of sample number `index`.
pub(in crate::studies) fn drawn(seed: u64, index: u64) -> Discrepancy {
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

/// Coordinates of a discrepancy: what it is at a few motions in which rovers drive, standard normal and uncorrelated
/// under the deviations and lengths of this file. What is left of it beyond them is not theirs to tell.
#[derive(Clone, Debug)]
pub struct DiscrepancyCoordinates {
    parts: Vec<Part>,
}

/// The coordinates of one quantity.
#[derive(Clone, Debug)]
struct Part {
    quantity: Quantity,
    /// Coordinates from the values.
    into: DMatrix<f64>,
    /// Values that go with coordinates on the mean.
    from: DMatrix<f64>,
}

/// A quantity with a discrepancy.
#[derive(Clone, Copy, Debug)]
enum Quantity {
    DrawbarPull,
    SideForce,
    Sinkage,
    Torque,
}

impl Quantity {
    fn values(self, discrepancy: &Discrepancy) -> &[f64] {
        match self {
            Self::DrawbarPull => &discrepancy.drawbar_pull,
            Self::SideForce => &discrepancy.side_force,
            Self::Sinkage => &discrepancy.sinkage,
            Self::Torque => &discrepancy.torque,
        }
    }

    fn values_mut(self, discrepancy: &mut Discrepancy) -> &mut [f64] {
        match self {
            Self::DrawbarPull => &mut discrepancy.drawbar_pull,
            Self::SideForce => &mut discrepancy.side_force,
            Self::Sinkage => &mut discrepancy.sinkage,
            Self::Torque => &mut discrepancy.torque,
        }
    }

    /// Its standard deviation.
    fn deviation(self) -> f64 {
        match self {
            Self::DrawbarPull | Self::SideForce => FORCE,
            Self::Sinkage => SINKAGE,
            Self::Torque => TORQUE,
        }
    }

    /// Slips and slip angles at which it is known: about where rovers drive on level ground and on slopes. The side
    /// force, none straight ahead, is so at an angle that it has a value of its own at.
    fn places(self) -> [(f64, f64); 2] {
        let angle =
            if matches!(self, Self::SideForce) { SLIP_ANGLES[1] } else { 0.5 * SLIP_ANGLES[1] };
        [(0.1, angle), (0.6, angle)]
    }

    /// How much each value counts at a slip and slip angle.
    fn weights(self, (slip, angle): (f64, f64)) -> Vec<f64> {
        let blend = Blend::at(slip, angle);
        let unit =
            |count: usize, place: usize| (0..count).map(move |it| f64::from(u8::from(it == place)));
        if matches!(self, Self::SideForce) {
            let value = |place| blend.of_side_force(&collected(unit(SIDE_VALUES, place)));
            (0..SIDE_VALUES).map(value).collect()
        } else {
            (0..VALUES).map(|place| blend.of(&collected(unit(VALUES, place)))).collect()
        }
    }

    /// The covariance of its values.
    fn covariance(self) -> DMatrix<f64> {
        let angles =
            if matches!(self, Self::SideForce) { &SLIP_ANGLES[1..] } else { &SLIP_ANGLES[..] };
        let variance = self.deviation().powi(2);
        correlations(angles, ANGLE_LENGTH).kronecker(&correlations(&SLIPS, SLIP_LENGTH)) * variance
    }
}

fn collected<const N: usize>(values: impl Iterator<Item = f64>) -> [f64; N] {
    let mut all = [0.0; N];
    all.iter_mut().zip(values).for_each(|(place, value)| *place = value);
    all
}

impl Default for DiscrepancyCoordinates {
    fn default() -> Self {
        Self::new()
    }
}

impl DiscrepancyCoordinates {
    /// Those of drawbar pull, side force, sinkage and torque.
    #[must_use]
    pub fn new() -> Self {
        let all = [Quantity::DrawbarPull, Quantity::SideForce, Quantity::Sinkage, Quantity::Torque];
        Self { parts: all.into_iter().map(Part::of).collect() }
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.parts.iter().map(|part| part.into.nrows()).sum()
    }

    /// The coordinates of a discrepancy.
    #[must_use]
    pub fn of(&self, discrepancy: &Discrepancy) -> Vec<f64> {
        let part = |part: &Part| {
            let values = DVector::from_column_slice(part.quantity.values(discrepancy));
            (&part.into * values).data.into()
        };
        self.parts.iter().map(part).collect::<Vec<Vec<f64>>>().concat()
    }

    /// A discrepancy moved by a step in coordinates; what is beyond them stays.
    ///
    /// * `step`: as many as [`count`](Self::count) says
    #[must_use]
    pub fn moved(&self, discrepancy: &Discrepancy, mut step: &[f64]) -> Discrepancy {
        let mut moved = *discrepancy;
        for part in &self.parts {
            let (own, others) = step.split_at(part.from.ncols());
            let change = &part.from * DVector::from_column_slice(own);
            for (value, change) in part.quantity.values_mut(&mut moved).iter_mut().zip(&change) {
                *value = (*value + change).clamp(-LARGEST, LARGEST);
            }
            step = others;
        }
        moved
    }
}

impl Part {
    fn of(quantity: Quantity) -> Self {
        let weights = quantity.places().map(|place| quantity.weights(place));
        let rows =
            DMatrix::from_fn(weights.len(), weights[0].len(), |row, column| weights[row][column]);
        let covariance = quantity.covariance();
        let with_values = &covariance * rows.transpose();
        let between = &rows * &with_values;
        // Places that differ are not the same function of the values: the matrix is positive definite.
        let factor = Cholesky::new(between.clone()).map_or(between, |root| root.l());
        let inverse =
            factor.try_inverse().unwrap_or_else(|| DMatrix::zeros(weights.len(), weights.len()));
        Self { quantity, into: &inverse * rows, from: with_values * inverse.transpose() }
    }
}

/// A triangular root of the correlations exp(−(x − x')²/2ℓ²) between places.
fn root(places: &[f64], length: f64) -> DMatrix<f64> {
    let correlations = correlations(places, length);
    // Places that differ have independent values: the matrix is positive definite.
    Cholesky::new(correlations.clone()).map_or(correlations, |root| root.l())
}

fn correlations(places: &[f64], length: f64) -> DMatrix<f64> {
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

    /// Coordinates of 4000 samples are standard normal and uncorrelated, and what is left beyond them is independent.
    #[test]
    fn coordinates_are_standard_normal() {
        let axes = DiscrepancyCoordinates::new();
        let all: Vec<_> = many().iter().map(|it| (axes.of(it), *it)).collect();
        let mean = |of: &dyn Fn(&(Vec<f64>, Discrepancy)) -> f64| {
            all.iter().map(of).sum::<f64>() / all.len() as f64
        };
        for one in 0..axes.count() {
            for other in 0..axes.count() {
                let expected = if one == other { 1.0 } else { 0.0 };
                let found = mean(&|it| it.0[one] * it.0[other]);
                assert!((found - expected).abs() < 0.1, "{one}, {other}: {found}");
            }
        }
        let left = |(at, discrepancy): &(Vec<f64>, Discrepancy)| {
            let back: Vec<f64> = at.iter().map(|it| -it).collect();
            axes.moved(discrepancy, &back)
        };
        let variance = mean(&|it| it.1.drawbar_pull[2].powi(2));
        for place in [2, 3, 7, 8] {
            let crossed = mean(&|it| it.0[0] * left(it).drawbar_pull[place]) / FORCE;
            assert!(crossed.abs() < 0.08, "{place}: {crossed}");
            let rest = mean(&|it| left(it).drawbar_pull[place].powi(2));
            assert!(rest < 0.35 * variance, "where rovers drive little is left: {place} {rest}");
        }
    }

    #[test]
    fn a_step_back_and_forth_changes_nothing() {
        let axes = DiscrepancyCoordinates::new();
        let discrepancy = drawn(3, 4);
        let step: Vec<f64> = (0..axes.count()).map(|it| 0.3 * it as f64 - 1.0).collect();
        let back: Vec<f64> = step.iter().map(|it| -it).collect();
        let moved = axes.moved(&discrepancy, &step);
        for (one, (before, step)) in
            axes.of(&moved).iter().zip(axes.of(&discrepancy).iter().zip(&step))
        {
            assert!((one - before - step).abs() < 1e-9, "{one} {before} {step}");
        }
        let again = axes.moved(&moved, &back);
        let differ =
            |one: &[f64], other: &[f64]| one.iter().zip(other).any(|(a, b)| (a - b).abs() > 1e-12);
        assert!(!differ(&again.side_force, &discrepancy.side_force));
        assert!(differ(&moved.side_force, &discrepancy.side_force));
    }

    #[test]
    fn a_sample_depends_on_seed_and_number_alone() {
        assert_eq!(drawn(7, 5), drawn(7, 5));
        assert_ne!(drawn(7, 5), drawn(7, 6));
        assert_ne!(drawn(7, 5), drawn(8, 5));
    }
}
