//! Where the rover drives: a soil on a plane slope, under some gravity.

use std::f64::consts::FRAC_PI_2;

use crate::error::{ParameterError, positive};
use crate::soil::Soil;

/// A plane of homogeneous soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// The soil.
    pub soil: Soil,
    /// Inclination of the plane, *α* [rad], 0 to below π/2; it rises along +y.
    pub slope: f64,
    /// Gravity, *g* [m/s²].
    pub gravity: f64,
}

impl Site {
    /// That there can be such a place.
    ///
    /// # Errors
    /// [`ParameterError`] for the first value that is wrong.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.soil.check()?;
        positive("gravity [m/s²]", self.gravity)?;
        if (0.0..FRAC_PI_2).contains(&self.slope) {
            Ok(())
        } else {
            Err(ParameterError::new("slope [rad]", self.slope, "0 to below π/2"))
        }
    }
}
