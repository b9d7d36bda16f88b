//! The geometry of a rigid wheel.

use crate::error::{ParameterError, not_negative, positive};

/// A rigid wheel with a flat rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Radius of the rim, without grousers, *r* [m].
    pub radius: f64,
    /// Width of the rim, *b* [m].
    pub width: f64,
    /// Bars across the rim; `None` for a smooth wheel.
    pub grousers: Option<Grousers>,
}

/// Bars across a rim that carry soil with them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grousers {
    /// Height over the rim, *h_g* [m].
    pub height: f64,
    /// How many there are, *N*. Reported; the models here take them as dense.
    pub count: u32,
}

impl Wheel {
    /// Shearing radius, *r_s* = r + h_g [m]: soil between dense grousers turns with the wheel, so
    /// that slip, sinkage and stresses are taken at their tips ([FourWheel], Eq. 16).
    #[must_use]
    pub fn shearing_radius(&self) -> f64 {
        self.radius + self.grousers.map_or(0.0, |grousers| grousers.height)
    }

    /// That the lengths belong to a wheel.
    ///
    /// # Errors
    /// [`ParameterError`] for the first that does not.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("wheel radius [m]", self.radius)?;
        positive("wheel width [m]", self.width)?;
        self.grousers.map_or(Ok(()), |grousers| not_negative("grouser height [m]", grousers.height))
    }
}
