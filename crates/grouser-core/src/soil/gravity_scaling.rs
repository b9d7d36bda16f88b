//! A soil's constants under another gravity than the one they were measured under.
//!
//! Nobody measured how the ground's stiffness under a wheel changes with gravity on another body.
//! [`GravityScaling`] names what may be assumed of it; a forecast takes each as possible. With *q*
//! = g/g₀, the gravity there over the gravity of the measurement, the parts of the pressure σ =
//! (K_c + K_φ) zⁿ under a rim of one width become
//!
//! | choice | cohesive part K_c | frictional part K_φ | cohesion c | stiffness ξ of `rft` |
//! |---|---|---|---|---|
//! | `reece` | 1 | q | 1 | q |
//! | `bekker` | 1 | 1 | 1 | 1 |
//! | `granular-scaling` | q | q | q | q |
//!
//! times what they were. Friction angle, density, exponent *n* and all lengths, the shear moduli
//! among them, stay, and the weight of soil that is pushed aside is ρ g in all of them. At one
//! width Bekker's constants and Reece's are two ways to write K_c and K_φ (k_c/b and k_φ, or c
//! k'_c/bⁿ and ρ g k'_φ b^(1−n)), so that a soil keeps the form that its document has.

use super::{PressureSinkage, Soil};
use crate::error::{ParameterError, positive};

/// How the ground's moduli change with gravity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GravityScaling {
    /// The frictional part grows with the soil's weight, γ = ρ g; cohesion and what comes of it
    /// stay (Reece 1965).
    Reece,
    /// The constants of the pressure–sinkage law stay as they were measured, as Bekker's are used:
    /// the ground is as stiff as before under a lighter rover. No measurement supports it; it obeys
    /// no scaling law.
    Bekker,
    /// Every stress grows with gravity, cohesion too: what was measured as cohesion is taken for
    /// friction at small stress. Then a rover of the same mass does on both bodies the same
    /// (granular scaling laws, Slonaker et al. 2017): the forecast is the test of that rover where
    /// the soil was measured.
    Granular,
}

impl GravityScaling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Reece, Self::Bekker, Self::Granular];

    /// The keyword: `reece`, `bekker`, `granular-scaling`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reece => "reece",
            Self::Bekker => "bekker",
            Self::Granular => "granular-scaling",
        }
    }
}

impl Soil {
    /// The soil under another gravity than the one under which its constants were measured.
    ///
    /// What bears a plate of 8 cm width that has sunk 2 cm into Toyoura sand on the Moon?
    ///
    /// ```
    /// use grouser_core::paper;
    /// use grouser_core::soil::GravityScaling;
    /// use grouser_core::units::{EARTH_GRAVITY, MOON_GRAVITY};
    ///
    /// let pressure = |scaling: GravityScaling| {
    ///     let sand = paper::toyoura().under(MOON_GRAVITY, EARTH_GRAVITY, scaling)?;
    ///     let unit_weight = sand.unit_weight(MOON_GRAVITY);
    ///     let stiffness = sand.pressure_sinkage.stiffness(0.08, sand.cohesion, unit_weight, 0.0);
    ///     Ok(format!("{:.1} kPa", 1e-3 * stiffness.pressure(0.02)))
    /// };
    /// assert_eq!(pressure(GravityScaling::Reece)?, "2.2 kPa");
    /// assert_eq!(pressure(GravityScaling::Bekker)?, "13.5 kPa");
    /// assert_eq!(pressure(GravityScaling::Granular)?, "2.2 kPa");
    /// # Ok::<(), grouser_core::error::ParameterError>(())
    /// ```
    ///
    /// * `gravity`: *g* [m/s²]
    /// * `measured_under`: *g₀* [m/s²]
    ///
    /// # Errors
    /// [`ParameterError`] if a gravity is not above zero.
    pub fn under(
        self,
        gravity: f64,
        measured_under: f64,
        scaling: GravityScaling,
    ) -> Result<Self, ParameterError> {
        positive("gravity [m/s²]", gravity)?;
        positive("gravity of the measurement [m/s²]", measured_under)?;
        let q = gravity / measured_under;
        let mut soil = self;
        match (scaling, &mut soil.pressure_sinkage) {
            // Reece's law has the unit weight in it.
            (GravityScaling::Reece, PressureSinkage::Reece { .. })
            | (GravityScaling::Bekker, PressureSinkage::Bekker { .. }) => {}
            (GravityScaling::Reece, PressureSinkage::Bekker { k_phi, .. }) => *k_phi *= q,
            (GravityScaling::Bekker, PressureSinkage::Reece { k_phi, .. }) => *k_phi /= q,
            (GravityScaling::Granular, PressureSinkage::Reece { .. }) => soil.cohesion *= q,
            (GravityScaling::Granular, PressureSinkage::Bekker { k_c, k_phi, .. }) => {
                soil.cohesion *= q;
                *k_c *= q;
                *k_phi *= q;
            }
        }
        if scaling == GravityScaling::Bekker {
            soil.rft.scale /= q;
        }
        Ok(soil)
    }
}
