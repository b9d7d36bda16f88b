//! Coordinates of a discrepancy: what an estimator moves in.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::process::{ANGLE_LENGTH, FORCE, SINKAGE, SLIP_LENGTH, TORQUE, correlations};
use crate::soil::Discrepancy;
use crate::soil::discrepancy::{Blend, LARGEST, SIDE_VALUES, SLIP_ANGLES, SLIPS, VALUES};

/// Coordinates of a discrepancy: what it is at a few motions in which rovers drive, standard normal
/// and uncorrelated under the deviations and lengths of this file. What is left of it beyond them
/// is not theirs to tell.
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

    /// Slips and slip angles at which it is known: about where rovers drive on level ground and on
    /// slopes. The side force, none straight ahead, is so at an angle that it has a value of its
    /// own at.
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
        // Places that differ are not the same function of the values: the matrix is positive
        // definite.
        let factor = Cholesky::new(between.clone()).map_or(between, |root| root.l());
        let inverse =
            factor.try_inverse().unwrap_or_else(|| DMatrix::zeros(weights.len(), weights.len()));
        Self { quantity, into: &inverse * rows, from: with_values * inverse.transpose() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::process::drawn;
    use super::*;

    /// Coordinates of 4000 samples are standard normal and uncorrelated, and what is left beyond
    /// them is independent.
    #[test]
    fn coordinates_are_standard_normal() {
        let axes = DiscrepancyCoordinates::new();
        let all: Vec<_> = (0..4000).map(|it| drawn(3, it)).map(|it| (axes.of(&it), it)).collect();
        let count = all.len() as f64;
        for one in 0..axes.count() {
            for other in 0..axes.count() {
                let expected = if one == other { 1.0 } else { 0.0 };
                let found = all.iter().map(|it| it.0[one] * it.0[other]).sum::<f64>() / count;
                assert!((found - expected).abs() < 0.1, "{one}, {other}: {found}");
            }
        }
        let left = |(at, discrepancy): &(Vec<f64>, Discrepancy)| {
            let back: Vec<f64> = at.iter().map(|it| -it).collect();
            axes.moved(discrepancy, &back)
        };
        let variance = all.iter().map(|it| it.1.drawbar_pull[2].powi(2)).sum::<f64>() / count;
        for place in [2, 3, 7, 8] {
            let crossed = all.iter().map(|it| it.0[0] * left(it).drawbar_pull[place]).sum::<f64>();
            let crossed = crossed / count / FORCE;
            assert!(crossed.abs() < 0.08, "{place}: {crossed}");
            let rest =
                all.iter().map(|it| left(it).drawbar_pull[place].powi(2)).sum::<f64>() / count;
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
}
