//! How steep a slope of a soil stands by its own strength: the infinite slope.
//!
//! A layer of depth *z*, measured straight down, slides along a plane parallel to the surface
//! (Skempton and DeLory 1957; no water). Its weight presses on the plane with ρ g z cos²α and pulls
//! along it with ρ g z sin α cos α, so that the factor of safety is
//!
//! ```text
//! FS = (c/(ρ g z cos²α) + tan φ)/tan α
//! ```
//!
//! Without cohesion depth and gravity do not count, and sand stands up to tan α = tan φ/FS: its
//! angle of repose, where FS is 1.

use super::Soil;
use crate::elementary::wide;
use crate::error::{ParameterError, positive};
use crate::units::STEEPEST_SLOPE;

/// What is asked of the ground of a slope before a rover drives on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeStability {
    /// Least factor of safety, *FS* [-].
    pub factor_of_safety: f64,
    /// Depth of the layer that would slide, *z* [m], straight down.
    pub depth: f64,
}

impl SlopeStability {
    /// A factor of safety of 1.3 over a depth of 1 m. Source: 1.3 is the usual least factor for
    /// slopes under a temporary load; the depth is assumed, a few wheel diameters.
    pub const USUAL: Self = Self { factor_of_safety: 1.3, depth: 1.0 };

    /// Checks that factor of safety and depth are positive.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is not.
    pub fn check(&self) -> Result<(), ParameterError> {
        positive("factor of safety of the slope", self.factor_of_safety)?;
        positive("depth of the sliding layer [m]", self.depth)
    }
}

impl Default for SlopeStability {
    fn default() -> Self {
        Self::USUAL
    }
}

impl Soil {
    /// Factor of safety of a slope against sliding by its own weight, *FS* [-]: infinite on level
    /// ground.
    ///
    /// * `slope`: *α* [rad], 0 to below π/2
    /// * `gravity`: *g* [m/s²]
    /// * `depth`: of the layer, *z* [m]
    #[must_use]
    pub fn slope_safety(&self, slope: f64, gravity: f64, depth: f64) -> f64 {
        let tan = wide::tan(slope);
        let cohesion = self.cohesion / (self.unit_weight(gravity) * depth);
        // 1/cos²α = 1 + tan²α
        (cohesion * (1.0 + tan * tan) + self.friction()) / tan
    }

    /// The steepest slope that stands by the soil's own strength with a factor of safety [rad]: up
    /// to it [`slope_safety`](Self::slope_safety) is nowhere less.
    ///
    /// ```text
    /// k tan²α − FS tan α + tan φ + k = 0      k = c/(ρ g z), the smaller root
    /// ```
    ///
    /// Where there is no root the cohesion holds any slope. The answer is at most
    /// [`STEEPEST_SLOPE`]: steeper ground is a wall.
    ///
    /// How steep may dry sand of 38° be with the usual factor of safety of 1.3?
    ///
    /// ```
    /// use grouser_core::paper;
    /// use grouser_core::soil::SlopeStability;
    /// use grouser_core::units::MOON_GRAVITY;
    ///
    /// let steepest = paper::toyoura().stable_slope(MOON_GRAVITY, SlopeStability::USUAL);
    /// assert_eq!(format!("{:.1}°", steepest.to_degrees()), "31.0°");
    /// ```
    ///
    /// * `gravity`: *g* [m/s²]
    #[must_use]
    pub fn stable_slope(&self, gravity: f64, asked: SlopeStability) -> f64 {
        let SlopeStability { factor_of_safety, depth } = asked;
        let k = self.cohesion / (self.unit_weight(gravity) * depth);
        let level = self.friction() + k;
        let discriminant = factor_of_safety * factor_of_safety - 4.0 * k * level;
        if discriminant < 0.0 {
            return STEEPEST_SLOPE;
        }
        // The smaller root without the difference of near equals.
        let tan = 2.0 * level / (factor_of_safety + discriminant.sqrt());
        wide::atan2(tan, 1.0).min(STEEPEST_SLOPE)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{
        Bulldozing, Domain, Exit, PressureSinkage, Rft, Shear, ShearBound, ShearModulus,
        SinkageExponent, SmallWheel, StressPeak,
    };
    use super::*;
    use crate::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY, deg, kpa};

    fn soil(cohesion: f64, friction_angle: f64) -> Soil {
        let exponent = SinkageExponent::constant(1.0);
        Soil {
            cohesion,
            friction_angle,
            constant_volume_share: 0.0,
            density: 1500.0,
            pressure_sinkage: PressureSinkage::Reece { k_c: 0.0, k_phi: 100.0, exponent },
            stress_peak: StressPeak { a0: 0.4, a1: 0.15 },
            shear: Shear::Isotropic { modulus: ShearModulus::constant(0.02) },
            shear_bound: ShearBound::Coulomb,
            exit: Exit::Ratio(0.0),
            bulldozing: Bulldozing::None,
            small_wheel: SmallWheel::OFF,
            rft: Rft::PUBLISHED,
            domain: Domain::UNSTATED,
            discrepancy: None,
        }
    }

    fn asked(factor_of_safety: f64) -> SlopeStability {
        SlopeStability { factor_of_safety, ..SlopeStability::USUAL }
    }

    /// Closed form: tan α = tan φ/FS for every gravity and depth.
    #[test]
    fn sand_stands_up_to_its_friction_over_the_factor_of_safety() {
        for phi in [10.0, 28.0, 38.0, 45.0] {
            for factor in [1.0, 1.3, 2.0] {
                for gravity in [MOON_GRAVITY, EARTH_GRAVITY] {
                    let expected = (deg(phi).tan() / factor).atan();
                    let found = soil(0.0, deg(phi)).stable_slope(gravity, asked(factor));
                    assert!((found - expected).abs() < 1e-14, "{phi}° over {factor}");
                }
            }
        }
    }

    /// Closed form: the factor of safety at the answer is the one that was asked for.
    #[test]
    fn the_steepest_slope_has_the_factor_of_safety_that_was_asked_for() {
        for (cohesion, factor, depth) in [(0.17, 1.3, 1.0), (1.0, 1.0, 2.0), (0.5, 1.5, 0.5)] {
            let soil = soil(kpa(cohesion), deg(33.0));
            let asked = SlopeStability { factor_of_safety: factor, depth };
            for gravity in [MARS_GRAVITY, EARTH_GRAVITY] {
                let slope = soil.stable_slope(gravity, asked);
                if slope < STEEPEST_SLOPE {
                    let found = soil.slope_safety(slope, gravity, depth);
                    assert!((found - factor).abs() < 1e-12, "{cohesion} kPa: {found}");
                }
            }
        }
    }

    #[test]
    fn cohesion_holds_steeper_slopes_where_gravity_is_less() {
        let cohesive = soil(kpa(0.17), deg(33.0));
        let on = |gravity: f64| cohesive.stable_slope(gravity, SlopeStability::USUAL);
        assert!(on(MOON_GRAVITY) > on(MARS_GRAVITY) && on(MARS_GRAVITY) > on(EARTH_GRAVITY));
        let same_weight = Soil { density: cohesive.density * 2.0, ..cohesive };
        let halved = same_weight.stable_slope(MARS_GRAVITY / 2.0, SlopeStability::USUAL);
        assert!((halved - on(MARS_GRAVITY)).abs() < 1e-14, "ρ g alone counts");
    }

    #[test]
    fn the_steepest_slope_grows_with_strength_and_falls_with_what_is_asked() {
        let slope = |cohesion: f64, phi: f64, factor: f64, depth: f64| {
            let asked = SlopeStability { factor_of_safety: factor, depth };
            soil(kpa(cohesion), deg(phi)).stable_slope(MARS_GRAVITY, asked)
        };
        let mut last = [0.0, 0.0, f64::INFINITY, f64::INFINITY];
        for step in 0..200 {
            let t = f64::from(step) / 199.0;
            let next = [
                slope(10.0 * t, 30.0, 1.3, 1.0),
                slope(0.3, 5.0 + 55.0 * t, 1.3, 1.0),
                slope(0.3, 30.0, 1.0 + 2.0 * t, 1.0),
                slope(0.3, 30.0, 1.3, 0.05 + 5.0 * t),
            ];
            assert!(next[0] >= last[0] && next[1] >= last[1], "{step}");
            assert!(next[2] <= last[2] && next[3] <= last[3], "{step}");
            assert!(next.iter().all(|slope| *slope > 0.0 && *slope <= STEEPEST_SLOPE));
            last = next;
        }
    }

    #[test]
    fn every_gentler_slope_is_safer_than_was_asked() {
        let soil = soil(kpa(0.5), deg(35.0));
        let limit = soil.stable_slope(EARTH_GRAVITY, SlopeStability::USUAL);
        for percent in 1..100 {
            let slope = limit * f64::from(percent) / 100.0;
            assert!(soil.slope_safety(slope, EARTH_GRAVITY, 1.0) > 1.3, "{percent} %");
        }
        assert!(soil.slope_safety(0.0, EARTH_GRAVITY, 1.0).is_infinite());
    }
}
