//! How the soil of one place, or under one wheel, differs from what is said of the whole ground.

use std::f64::consts::PI;

use super::{PressureSinkage, Rft, Soil};

/// How a soil differs from another: in how it shears and in how it carries.
///
/// How far down does the friction of a sand go where it is 1° less, and the pressure of a plate
/// where it is softer by a tenth?
///
/// ```
/// use grouser_core::paper;
/// use grouser_core::soil::SoilDifference;
/// use grouser_core::units::{EARTH_GRAVITY, deg};
///
/// let sand = paper::toyoura();
/// let loose = sand.differing(SoilDifference { friction_angle: deg(-1.0), stiffness: 0.9 });
/// assert_eq!(format!("{:.1}°", loose.friction_angle.to_degrees()), "37.0°");
/// let pressure = |soil: &grouser_core::soil::Soil| {
///     let weight = soil.unit_weight(EARTH_GRAVITY);
///     soil.pressure_sinkage.stiffness(0.08, soil.cohesion, weight, 0.0).pressure(0.02)
/// };
/// assert!((pressure(&loose) / pressure(&sand) - 0.9).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoilDifference {
    /// Added to the angle of internal friction [rad].
    pub friction_angle: f64,
    /// Factor on the pressure at any sinkage [-], and on the stiffness of resistive force theory.
    pub stiffness: f64,
}

impl SoilDifference {
    /// None.
    pub const NONE: Self = Self { friction_angle: 0.0, stiffness: 1.0 };

    /// This one and another together.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            friction_angle: self.friction_angle + other.friction_angle,
            stiffness: self.stiffness * other.stiffness,
        }
    }
}

/// Friction angles that a difference can lead to [rad], 1° and 80°; one beyond leads to the end.
/// Source: ours, somewhat more than a soil's document may have.
const FRICTION_ANGLES: [f64; 2] = [PI / 180.0, 80.0 * PI / 180.0];

impl Soil {
    /// The same soil with a difference. Its friction angle stays within 1° and 80°.
    #[must_use]
    pub fn differing(&self, by: SoilDifference) -> Self {
        let [least, most] = FRICTION_ANGLES;
        let factor = by.stiffness;
        let pressure_sinkage = match self.pressure_sinkage {
            PressureSinkage::Bekker { k_c, k_phi, exponent } => {
                PressureSinkage::Bekker { k_c: factor * k_c, k_phi: factor * k_phi, exponent }
            }
            PressureSinkage::Reece { k_c, k_phi, exponent } => {
                PressureSinkage::Reece { k_c: factor * k_c, k_phi: factor * k_phi, exponent }
            }
        };
        Self {
            friction_angle: (self.friction_angle + by.friction_angle).clamp(least, most),
            pressure_sinkage,
            rft: Rft { scale: factor * self.rft.scale, ..self.rft },
            ..*self
        }
    }
}
