//! The geometry of a rigid wheel.

use crate::error::{ParameterError, not_negative, positive};

/// A rigid wheel with a flat rim.
///
/// At which rotation does a wheel with grousers of 1 cm have a rim speed of 6 cm/s?
///
/// ```
/// use grouser_core::wheel::{Grousers, Wheel};
///
/// let grousers = Grousers { height: 0.010, count: 24 };
/// let wheel = Wheel { radius: 0.10, width: 0.08, grousers: Some(grousers) };
/// wheel.check()?;
/// let turns_per_minute = 0.06 / wheel.shearing_radius() * 60.0 / std::f64::consts::TAU;
/// assert_eq!(format!("{turns_per_minute:.2} rpm"), "5.21 rpm");
/// # Ok::<(), grouser_core::error::ParameterError>(())
/// ```
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

    /// Checks that a wheel can have these lengths.
    ///
    /// # Errors
    /// [`ParameterError`] for the first that it cannot have.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("wheel radius [m]", self.radius)?;
        positive("wheel width [m]", self.width)?;
        self.grousers.map_or(Ok(()), |grousers| not_negative("grouser height [m]", grousers.height))
    }
}
