//! A plane: ground whose coordinates lie in it, x along the contour and y uphill.

use std::f64::consts::FRAC_PI_2;

use super::{Footprint, Patch, Terrain};
use crate::elementary::wide;
use crate::error::ParameterError;
use crate::units::{Vec2, Vec3};

/// A plane that rises along +y. Its coordinates are measured along it.
///
/// How high does a rover get that drives 2 m straight up a slope of 10°?
///
/// ```
/// use grouser_core::terrain::{Footprint, Plane, Terrain};
/// use grouser_core::units::{Vec2, deg};
///
/// let plane = Plane { slope: deg(10.0) };
/// let footprint = Footprint { forward: Vec2::y(), half_length: 0.05, half_width: 0.04 };
/// let patch = plane.patch(Vec2::new(0.0, 2.0), footprint);
/// assert_eq!(format!("{:.0} mm", 1e3 * patch.height), "347 mm");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Inclination, *α* [rad], 0 to below π/2; the plane rises along +y.
    pub slope: f64,
}

impl Plane {
    /// Checks that there can be such a plane.
    ///
    /// # Errors
    /// [`ParameterError`] for a slope out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        if (0.0..FRAC_PI_2).contains(&self.slope) {
            Ok(())
        } else {
            Err(ParameterError::new("slope [rad]", self.slope, "0 to below π/2"))
        }
    }
}

impl Terrain for Plane {
    fn patch(&self, at: Vec2, _: Footprint) -> Patch {
        let (sin, cos) = wide::sin_cos(self.slope);
        Patch { height: at.y * sin, normal: Vec3::new(0.0, -sin, cos) }
    }
}
