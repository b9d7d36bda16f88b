//! Shear tests of a bevameter: stress over displacement under several normal stresses, for *c*, *φ*
//! and *K*.
//!
//! ```text
//! τ = (c + σ tan φ) (1 − e^(−j/K))            Janosi and Hanamoto (1961), with Mohr and Coulomb's strength
//! ```
//!
//! With one normal stress alone cohesion and friction angle are not separately identifiable. A soil
//! that softens after a peak follows another law; the mean stress of both fits between.

use super::repeated_curves::CurvePoint;
use super::wong::straight_line;
use crate::elementary::exp;
use crate::elementary::wide::{atan2, tan};
use crate::error::{ParameterError, finite, not_negative, positive};

/// A patch of soil sheared under one normal stress.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearCurve {
    /// Normal stress, *σ* [Pa].
    pub normal_stress: f64,
    /// Shear displacement, *j* [m], and shear stress, *τ* [Pa], as they were read.
    pub points: Vec<CurvePoint>,
}

impl ShearCurve {
    /// Checks that there can be such a curve.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("normal stress [Pa]", self.normal_stress)?;
        for point in &self.points {
            not_negative("shear displacement [m]", point.at)?;
            finite("shear stress [Pa]", point.value)?;
            not_negative("scatter of a shear stress [Pa]", point.scatter)?;
        }
        Ok(())
    }

    /// The largest shear stress [Pa].
    fn strength(&self) -> f64 {
        self.points.iter().map(|point| point.value).fold(0.0, f64::max)
    }

    /// The displacement at which the stress first reaches 1 − 1/e of the strength [m].
    fn rise(&self) -> f64 {
        let share = 1.0 - exp(-1.0);
        let reached = |point: &&CurvePoint| point.value >= share * self.strength();
        self.points.iter().find(reached).map_or(0.0, |point| point.at)
    }
}

/// What shears a soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStrength {
    /// Cohesion, *c* [Pa].
    pub cohesion: f64,
    /// Angle of internal friction, *φ* [rad].
    pub friction_angle: f64,
    /// Shear deformation modulus, *K* [m].
    pub modulus: f64,
}

impl ShearStrength {
    /// Shear stress [Pa].
    ///
    /// * `normal_stress`: *σ* [Pa]
    /// * `displacement`: *j* [m]
    #[must_use]
    pub fn stress(&self, normal_stress: f64, displacement: f64) -> f64 {
        let strength = self.cohesion + normal_stress * tan(self.friction_angle);
        strength * (1.0 - exp(-displacement / self.modulus))
    }

    /// Values near some curves, to search from: the straight line of the largest stresses over the
    /// normal ones, and the displacement in which a curve rises.
    #[must_use]
    pub fn first_guess(curves: &[ShearCurve]) -> Self {
        let strengths: Vec<(f64, f64)> =
            curves.iter().map(|it| (it.normal_stress, it.strength())).collect();
        let count = (curves.len() as f64).max(1.0);
        let ratio = strengths.iter().map(|(normal, shear)| shear / normal).sum::<f64>() / count;
        // A line that falls below the origin is a soil without cohesion.
        let line = straight_line(&strengths).filter(|(_, cohesion)| *cohesion >= 0.0);
        let (friction, cohesion) = line.unwrap_or((ratio, 0.0));
        let modulus = curves.iter().map(ShearCurve::rise).sum::<f64>() / count;
        Self { cohesion, friction_angle: atan2(friction, 1.0), modulus: modulus.max(LEAST_MODULUS) }
    }
}

/// A search starts from no smaller modulus [m]. Source: ours; published ones are millimetres.
const LEAST_MODULUS: f64 = 1e-4;

/// The largest shear stress of some curves [Pa].
#[must_use]
pub fn largest_stress(curves: &[ShearCurve]) -> f64 {
    curves.iter().map(ShearCurve::strength).fold(0.0, f64::max)
}
