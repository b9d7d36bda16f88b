//! What decides the reaction on one wheel.

use super::slip::Slip;
use crate::soil::Soil;
use crate::wheel::Wheel;

/// One wheel on one soil, in one motion: all that decides the reaction, but for the sinkage.
///
/// How much less deep does a wheel that carries 1.7 kg sink on the Moon than on the Earth? By
/// Reece's law for cohesionless sand not at all: load and soil lose weight alike.
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::contact::{Contact, Ishigami, SettleError, Slip, settle};
/// use grouser_core::units::{EARTH_GRAVITY, MOON_GRAVITY};
///
/// let (wheel, soil, slip) = (paper::hakuto_wheel(), paper::toyoura(), Slip::on_test_stand(0.2, 0.0));
/// let sinkage_mm = |gravity: f64| -> Result<String, SettleError> {
///     let contact = Contact { wheel, soil, slip, gravity };
///     let settled = settle(&Ishigami::DEFAULT, &contact, 1.7 * gravity)?;
///     Ok(format!("{:.1} mm", 1e3 * settled.sinkage))
/// };
/// assert_eq!(sinkage_mm(EARTH_GRAVITY)?, "12.9 mm");
/// assert_eq!(sinkage_mm(MOON_GRAVITY)?, "12.9 mm");
/// # Ok::<(), SettleError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The wheel.
    pub wheel: Wheel,
    /// The soil under it.
    pub soil: Soil,
    /// How the rim moves against the soil.
    pub slip: Slip,
    /// Gravity, *g* [m/s²]; it gives the soil its weight.
    pub gravity: f64,
}

impl Contact {
    /// The same contact seen in a mirror that swaps front and back.
    #[must_use]
    pub fn front_to_back(&self) -> Self {
        Self { slip: self.slip.front_to_back(), ..*self }
    }
}
