//! The constants of resistive force theory ([`contact::rft`](crate::contact::rft)) beside the
//! soil's own density and friction.

use std::f64::consts::FRAC_PI_2;

use crate::error::{ParameterError, positive};

/// What resistive force theory needs of a soil; the other models leave it aside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rft {
    /// Factor on the stiffness ξ that the model computes from density and friction [-].
    pub scale: f64,
    /// Friction angle between the wheel and the soil [rad]; without it the soil's own, a rough
    /// wheel.
    pub surface_friction_angle: Option<f64>,
}

impl Rft {
    /// The published model on a rough wheel.
    pub const PUBLISHED: Self = Self { scale: 1.0, surface_friction_angle: None };

    /// Checks that scale and surface friction angle are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is not.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("scale of resistive force theory", self.scale)?;
        let Some(angle) = self.surface_friction_angle else { return Ok(()) };
        positive("surface friction angle [rad]", angle)?;
        if angle < FRAC_PI_2 {
            Ok(())
        } else {
            Err(ParameterError::new("surface friction angle [rad]", angle, "below π/2"))
        }
    }
}

impl Default for Rft {
    fn default() -> Self {
        Self::PUBLISHED
    }
}
