//! What a wheel–soil model gets wrong in one soil under one wheel: its discrepancy, as a smooth
//! function of slip and slip angle.
//!
//! No model is exact. A calibration that says so finds, beside the soil's constants, by how much
//! the model may still be off at each motion (Kennedy and O'Hagan 2001), and a prediction with its
//! samples has that too. A [`Discrepancy`] is one such function for each quantity: values at
//! [`SLIPS`] and [`SLIP_ANGLES`], blended in between. It is zero by default; it comes from a
//! calibration's samples and is not to be set by hand.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use crate::error::{ParameterError, finite};

/// Slips by the total speed, *S* [-], at which a discrepancy has values.
pub const SLIPS: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

/// Slip angles, |*β*| [rad], at which a discrepancy has values, closer where rovers drive: 0, 15,
/// 45 and 90°.
pub const SLIP_ANGLES: [f64; 4] = [0.0, PI / 12.0, FRAC_PI_4, FRAC_PI_2];

/// How many values a quantity has.
pub const VALUES: usize = SLIPS.len() * SLIP_ANGLES.len();

/// How many values the side force has: by symmetry it has none at a slip angle of 0°.
pub const SIDE_VALUES: usize = VALUES - SLIPS.len();

/// A discrepancy has this size at most [-], whatever its values: in shares of the load, or as a
/// logarithm. Source: ours; no model is off by ten times the load.
pub const LARGEST: f64 = 10.0;

/// What a model gets wrong in one soil under one wheel.
///
/// Every list has the values at [`SLIPS`] for the first of the [`SLIP_ANGLES`], then for the next.
/// The quantities are those of a wheel that moves forward and to the left: others are mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discrepancy {
    /// Added to the drawbar pull, in shares of the load [-].
    pub drawbar_pull: [f64; VALUES],
    /// Added to the side force, in shares of the load [-]; it begins with the second slip angle,
    /// since by symmetry there is none at the first.
    pub side_force: [f64; SIDE_VALUES],
    /// Added to the logarithm of the sinkage [-].
    pub sinkage: [f64; VALUES],
    /// Added to the torque, in shares of load times shearing radius [-].
    pub torque: [f64; VALUES],
}

impl Discrepancy {
    /// A model that gets nothing wrong.
    pub const NONE: Self = Self {
        drawbar_pull: [0.0; VALUES],
        side_force: [0.0; SIDE_VALUES],
        sinkage: [0.0; VALUES],
        torque: [0.0; VALUES],
    };

    /// Checks that all values are finite.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is not.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Self { drawbar_pull, side_force, sinkage, torque } = self;
        let mut values = drawbar_pull.iter().chain(side_force).chain(sinkage).chain(torque);
        values.try_for_each(|&value| finite("discrepancy [-]", value))
    }
}

impl Default for Discrepancy {
    fn default() -> Self {
        Self::NONE
    }
}

/// Where a motion lies among [`SLIPS`] and [`SLIP_ANGLES`]: which values count, and how much.
///
/// Between two neighbours the value passes from one to the other by 3t² − 2t³, so that the function
/// is smooth, never outside of its values, and even in the slip angle. Beyond the ends it is
/// constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    slip: (usize, f64),
    angle: (usize, f64),
}

impl Blend {
    /// * `slip`: by the total speed, *S* [-]
    /// * `slip_angle`: *β* [rad], of either sign
    #[must_use]
    pub fn at(slip: f64, slip_angle: f64) -> Self {
        Self { slip: place(&SLIPS, slip), angle: place(&SLIP_ANGLES, slip_angle.abs()) }
    }

    /// The value there of a quantity.
    #[must_use]
    pub fn of(&self, values: &[f64; VALUES]) -> f64 {
        self.blended(|angle, slip| values[SLIPS.len() * angle + slip])
    }

    /// The value there of the side force, for a motion to the left.
    #[must_use]
    pub fn of_side_force(&self, values: &[f64; SIDE_VALUES]) -> f64 {
        self.blended(|angle, slip| match angle {
            0 => 0.0,
            angle => values[SLIPS.len() * (angle - 1) + slip],
        })
    }

    fn blended(&self, value: impl Fn(usize, usize) -> f64) -> f64 {
        let ((slip, slip_share), (angle, angle_share)) = (self.slip, self.angle);
        let at = |angle| between(value(angle, slip), value(angle, slip + 1), slip_share);
        between(at(angle), at(angle + 1), angle_share).clamp(-LARGEST, LARGEST)
    }
}

/// The place before a number, and the share of the place after it.
fn place(places: &[f64], at: f64) -> (usize, f64) {
    let after = places.iter().position(|&one| at < one).unwrap_or(places.len());
    let before = after.saturating_sub(1).min(places.len() - 2);
    let (low, high) = (places[before], places[before + 1]);
    let t = ((at - low) / (high - low)).clamp(0.0, 1.0);
    (before, t * t * (3.0 - 2.0 * t))
}

/// From one value to another by a share.
fn between(one: f64, other: f64, share: f64) -> f64 {
    one + share * (other - one)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    fn numbered() -> [f64; VALUES] {
        std::array::from_fn(|place| place as f64 * 0.1)
    }

    #[test]
    fn a_discrepancy_has_its_values_at_their_places() {
        for (angle, &slip_angle) in SLIP_ANGLES.iter().enumerate() {
            for (slip, &at) in SLIPS.iter().enumerate() {
                let place = SLIPS.len() * angle + slip;
                for slip_angle in [slip_angle, -slip_angle] {
                    let found = Blend::at(at, slip_angle).of(&numbered());
                    assert!((found - 0.1 * place as f64).abs() < 1e-12, "{place}: {found}");
                }
            }
        }
    }

    /// The half-way value is the mean of the neighbours, and the value beyond the ends is that
    /// there.
    #[test]
    fn a_discrepancy_passes_from_value_to_value_and_ends_level() {
        let at = |slip, angle| Blend::at(slip, angle).of(&numbered());
        assert!((at(-0.75, 0.0) - 0.05).abs() < 1e-12);
        assert!((at(0.0, deg(30.0)) - 0.95).abs() < 1e-12);
        assert_eq!(at(1.5, deg(100.0)), at(1.0, deg(90.0)));
        assert_eq!(at(-3.0, 0.0), 0.0);
    }

    /// A step of a millionth changes it by no more than the steepest slope says: 1.5 times the
    /// difference of neighbours over their distance.
    #[test]
    fn a_discrepancy_has_no_jumps_and_no_kinks() {
        const STEP: f64 = 1e-6;
        let value = |slip: f64| Blend::at(slip, 0.1).of(&numbered());
        let mut slope = 0.0;
        for number in 0..4000 {
            let slip = -1.0 + 5e-4 * f64::from(number);
            let next = (value(slip + STEP) - value(slip)) / STEP;
            assert!(next.abs() < 1.5 * 0.1 / 0.5 + 1e-6, "{slip}: {next}");
            // The second derivative is 6 times the difference over the distance squared at most.
            assert!(
                (next - slope).abs() < 2.0 * 5e-4 * 6.0 * 0.1 / 0.25,
                "{slip}: {next}, {slope}"
            );
            slope = next;
        }
    }

    #[test]
    fn a_side_force_has_none_straight_ahead() {
        let values = [0.3; SIDE_VALUES];
        assert_eq!(Blend::at(0.2, 0.0).of_side_force(&values), 0.0);
        assert!((Blend::at(0.2, deg(7.5)).of_side_force(&values) - 0.15).abs() < 1e-12);
        assert!((Blend::at(0.2, deg(-60.0)).of_side_force(&values) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn values_that_are_no_numbers_are_refused() {
        assert!(Discrepancy::NONE.check().is_ok());
        let mut broken = Discrepancy::NONE;
        broken.torque[3] = f64::NAN;
        assert!(broken.check().is_err());
    }
}
