//! A line that is fitted to how an observation goes with the unknowns, with what its noise is made
//! of.

use nalgebra::{DMatrix, DVector, Matrix3};

use super::gaussian::{Gaussian, Line};
use super::motion::SeenMotion;
use super::passed::Passed;

/// A line that stands for an observation, and what its noise is made of.
#[derive(Clone, Debug)]
pub(super) struct Fitted {
    pub(super) line: Line,
    /// A covariance of what no soil explains, the same over a patch of the ground.
    pub(super) of_patch: DMatrix<f64>,
    /// Variances of the stretch's own readings.
    pub(super) own: DVector<f64>,
    /// How the motion goes with forces that no soil explains.
    pub(super) motion_by_force: Matrix3<f64>,
}

impl Fitted {
    /// Standard deviation of the way along the body by what no soil explains, over that of the
    /// fastest rim [-].
    pub(super) fn deviation_along(&self) -> f64 {
        self.of_patch[(0, 0)].sqrt()
    }

    /// The stretch that it is of.
    pub(super) fn passed(
        self,
        motion: &SeenMotion,
        belief: Gaussian,
        seen: DVector<f64>,
    ) -> Passed {
        let Self { line: Line { at, value, jacobian, .. }, of_patch, own, .. } = self;
        let seen = seen - value + &jacobian * at;
        Passed {
            way: motion.way(),
            belief,
            readings: motion.readings(),
            seen,
            jacobian,
            of_patch,
            own,
        }
    }
}
