//! What a soil has of which little is known.

use super::{
    Bulldozing, Domain, Exit, PressureSinkage, Rft, Shear, ShearBound, SmallWheel, Soil, StressPeak,
};

impl Soil {
    /// A soil of which no more is known: a stress peak like that of dry sand (Wong and Reece 1967),
    /// a rut as deep as the wheel was, side walls that push as smoothly as possible, no bound of
    /// shear, the whole of its peak friction, [`SmallWheel::GENERAL`]. A number that is known is a
    /// field with another value.
    ///
    /// * `cohesion`: *c* [Pa]
    /// * `friction_angle`: *φ* [rad]
    /// * `density`: *ρ* [kg/m³]
    ///
    /// ```
    /// use grouser_core::soil::{PressureSinkage, Shear, ShearBound, ShearModulus, SinkageExponent, Soil};
    /// use grouser_core::units::deg;
    ///
    /// let (k_c, k_phi) = (1.37e3, 8.14e5);
    /// let exponent = SinkageExponent::constant(1.0);
    /// let pressure_sinkage = PressureSinkage::Bekker { k_c, k_phi, exponent };
    /// let shear = Shear::Isotropic { modulus: ShearModulus::constant(0.02) };
    /// let sand = Soil::new(800.0, deg(37.2), 1600.0, pressure_sinkage, shear);
    /// let bounded = Soil { shear_bound: ShearBound::Coulomb, ..sand };
    /// assert_eq!(bounded.cohesion, 800.0);
    /// ```
    #[must_use]
    pub const fn new(
        cohesion: f64,
        friction_angle: f64,
        density: f64,
        pressure_sinkage: PressureSinkage,
        shear: Shear,
    ) -> Self {
        Self {
            cohesion,
            friction_angle,
            constant_volume_share: 0.0,
            density,
            pressure_sinkage,
            stress_peak: StressPeak { a0: 0.40, a1: 0.15 },
            shear,
            shear_bound: ShearBound::None,
            exit: Exit::Ratio(1.0),
            bulldozing: Bulldozing::Sine,
            small_wheel: SmallWheel::GENERAL,
            rft: Rft::PUBLISHED,
            domain: Domain::UNSTATED,
            discrepancy: None,
        }
    }
}
