//! The constants of the small-wheel model ([`contact::small_wheel`](crate::contact::small_wheel)):
//! what the soil under a small wheel does beyond the classical law. They belong to one soil under
//! one wheel.
//!
//! Every term is off in [`SmallWheel::OFF`], and then the model is the classical one within what
//! the ground resists. [`SmallWheel::GENERAL`] has values for a soil that states none.

use std::f64::consts::FRAC_PI_2;

use super::Soil;
use crate::elementary::{pow, wide};
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::wheel::Wheel;

/// The terms of the small-wheel model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallWheel {
    /// How a moving wheel sinks deeper than a plate.
    pub sinkage: SinkageGrowth,
    /// How the exit moves with the motion.
    pub exit: ExitShift,
    /// Friction between wheel and soil.
    pub interface: Interface,
    /// The soil's load on the side wall.
    pub side_wall: SideWall,
    /// The bow wave in front of the wheel and the rear mound behind it.
    pub mounds: Mounds,
    /// What a slope leaves of the weight with which wedges of soil resist the wheel [-]: 1 on level
    /// ground, 0 where the slope is as steep as the angle of friction. No constant of the soil: a
    /// rover that stands on a slope sets it ([`Soil::on_slope`]).
    pub wedge_share: f64,
}

/// Sinkage growth, *ζ* [-]: the moving wheel meets at depth z what a plate meets at z/ζ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinkageGrowth {
    /// Growth with the slip angle, *ζ_β* [-].
    pub with_slip_angle: f64,
    /// Growth with slip, *ζ_s* [-], at its start.
    pub with_slip: f64,
    /// How that growth bends [-]: above 0 it speeds up with slip, below 0 it slows down.
    pub bend: f64,
    /// Growth of a locked wheel, *ζ_locked* − 1 [-].
    pub locked: f64,
    /// How much the larger of two growths hides the smaller, *q* [-]: at 1 they add up.
    pub sharpness: f64,
}

/// How the wheel sinkage ratio *λ* moves with the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExitShift {
    /// Share of λ that a wheel spinning on the spot has lost [-].
    pub fading: f64,
    /// Growth with slip [-].
    pub with_slip: f64,
    /// Growth with |sin β| [-].
    pub with_slip_angle: f64,
}

/// Friction of the wheel–soil interface, where it is below the soil's own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interface {
    /// Friction angle between this wheel and the soil, *δ* [rad], if it is known.
    pub friction_angle: Option<f64>,
    /// Without it: the friction angle of a rim without grousers as a share of the soil's, *δ*/*φ*
    /// [-]. Between grousers soil slides on soil, so that δ is φ there.
    pub friction_share: f64,
}

/// The soil's load on the side wall of a small wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideWall {
    /// Factor on the passive pressure *R_b* [-], for the soil piled up at the wall and for its
    /// ends.
    pub pressure_factor: f64,
    /// How fast the load fades with slip or skid, *ζ_b* [-].
    pub fading: f64,
    /// Coefficient of friction of the side face, *μ_f* [-].
    pub friction: f64,
}

/// Soil pushed by the width of the rim, as factors on b R_b(h) [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mounds {
    /// Bow wave, in front of a wheel that skids, *f_front* [-].
    pub bow_wave: f64,
    /// Rear mound, behind a wheel that spins, *f_behind* [-].
    pub rear_mound: f64,
}

/// The side motion at which a wheel's sinkage no longer grows in proportion to tan β [-].
///
/// Source: notes on the CMU wheels (sin β/(cos β + 0.3)); fitted values scatter from 0.25
/// to 0.3.
const ROLLING_SHARE: f64 = 0.3;

impl SmallWheel {
    /// No term at all: the classical model, as far as the ground's resistance goes.
    pub const OFF: Self = Self {
        sinkage: SinkageGrowth {
            with_slip_angle: 0.0,
            with_slip: 0.0,
            bend: 0.0,
            locked: 0.0,
            sharpness: 1.0,
        },
        exit: ExitShift { fading: 0.0, with_slip: 0.0, with_slip_angle: 0.0 },
        interface: Interface { friction_angle: None, friction_share: 1.0 },
        side_wall: SideWall { pressure_factor: 1.0, fading: 0.0, friction: 0.0 },
        mounds: Mounds { bow_wave: 0.0, rear_mound: 0.0 },
        wedge_share: 1.0,
    };

    /// For soils that no small wheel was tested on.
    ///
    /// Slip makes a wheel sink as the published slip-sinkage law has it, ζ = (1 + s)/(1 − 0.5 s)
    /// (Lyasko 2010), and a smooth rim has two thirds of the soil's friction angle, the usual value
    /// for steel in sand. The soil behind the wheel stays as low as the wheel while that spins on
    /// the spot, λ = λ₀ (1 − S⁺): it passes no new soil. That form was chosen on the smooth wheel
    /// of Ding et al. (2011), whose pull does not rise at high slip. The rear mound is that of both
    /// fitted wheels of Pavlov and Johnson (2022). All else was chosen on both wheels of Pavlov and
    /// Johnson (2022), at slip angles of 0 to 75°, with their sand's published constants, under
    /// which a wheel lies deeper than with fitted ones: growths, side wall and bow wave are smaller
    /// than the presets' (`docs/models/small-wheel.md`).
    pub const GENERAL: Self = Self {
        sinkage: SinkageGrowth {
            with_slip_angle: 1.0,
            with_slip: 1.5,
            bend: 0.5,
            locked: 3.0,
            sharpness: 4.0,
        },
        exit: ExitShift { fading: 1.0, with_slip: 0.0, with_slip_angle: 0.0 },
        interface: Interface { friction_angle: None, friction_share: 2.0 / 3.0 },
        side_wall: SideWall { pressure_factor: 2.0, fading: 0.6, friction: 0.2 },
        mounds: Mounds { bow_wave: 1.5, rear_mound: 0.85 },
        wedge_share: 1.0,
    };

    /// Checks that the parameters are within the ranges of the small-wheel model.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is not.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Self { sinkage, exit, interface, side_wall, mounds, wedge_share } = self;
        not_negative("sinkage growth with slip angle", sinkage.with_slip_angle)?;
        not_negative("sinkage growth with slip", sinkage.with_slip)?;
        not_negative("sinkage growth of a locked wheel", sinkage.locked)?;
        if !(sinkage.bend.is_finite() && sinkage.bend < 1.0) {
            let expected = "finite and below 1";
            return Err(ParameterError::new("bend of the sinkage growth", sinkage.bend, expected));
        }
        if !(sinkage.sharpness.is_finite() && sinkage.sharpness >= 1.0) {
            let name = "sharpness of the sinkage growth";
            return Err(ParameterError::new(name, sinkage.sharpness, "finite and at least 1"));
        }
        not_negative("fading of the exit ratio", exit.fading)?;
        finite("exit ratio's growth with slip", exit.with_slip)?;
        finite("exit ratio's growth with slip angle", exit.with_slip_angle)?;
        if let Some(angle) = interface.friction_angle {
            positive("interface friction angle [rad]", angle)?;
            if angle >= FRAC_PI_2 {
                let name = "interface friction angle [rad]";
                return Err(ParameterError::new(name, angle, "below π/2"));
            }
        }
        if !(interface.friction_share > 0.0 && interface.friction_share <= 1.0) {
            let name = "interface friction share";
            return Err(ParameterError::new(name, interface.friction_share, "above 0, at most 1"));
        }
        not_negative("pressure factor of the side wall", side_wall.pressure_factor)?;
        not_negative("fading of the side wall", side_wall.fading)?;
        not_negative("friction of the side wall", side_wall.friction)?;
        not_negative("bow wave", mounds.bow_wave)?;
        not_negative("rear mound", mounds.rear_mound)?;
        not_negative("share of the wedges' resistance", *wedge_share)
    }
}

impl Default for SmallWheel {
    fn default() -> Self {
        Self::OFF
    }
}

impl SinkageGrowth {
    /// The growth *ζ* [-], at least 1.
    ///
    /// ```text
    /// ζ_lateral = 1 + ζ_β |sin β|/(cos β + 0.3)      ζ_driven = 1 + ζ_s S⁺/(1 − bend S⁺)
    /// ζ_rolling = (ζ_lateral^q + ζ_driven^q − 1)^(1/q)
    /// ζ = ζ_rolling + S⁻² max(1 + ζ_locked − ζ_rolling, 0)
    /// ```
    ///
    /// with the total slip S, its driving part S⁺ = max(S, 0) and its skid S⁻ = max(−S, 0). A
    /// locked wheel is a plough: it digs to its own depth, whatever its direction.
    ///
    /// The growth is the same at every depth: a wheel that digs deeper than its axle has sunk to
    /// the axle, and no term holds it up.
    ///
    /// * `total_slip`: *S* [-], −1 to 1
    /// * `slip_angle`: *β* [rad]
    #[must_use]
    pub fn at(&self, total_slip: f64, slip_angle: f64) -> f64 {
        let q = self.sharpness;
        let (driving, skid) = (total_slip.clamp(0.0, 1.0), (-total_slip).clamp(0.0, 1.0));
        let (sin, cos) = wide::sin_cos(slip_angle);
        let lateral = 1.0 + self.with_slip_angle * sin.abs() / (cos.max(0.0) + ROLLING_SHARE);
        let driven = 1.0 + self.with_slip * driving / (1.0 - self.bend * driving);
        // By the larger of the two, so that no power overflows; exactly 1 where both are.
        let (more, less) = (lateral.max(driven), lateral.min(driven));
        let rest = (pow(less / more, q) - pow(more, -q)).max(0.0);
        let rolling = more * pow(1.0 + rest, 1.0 / q);
        rolling + skid * skid * (1.0 + self.locked - rolling).max(0.0)
    }
}

impl Interface {
    /// *δ* [rad] under a wheel; `None` where soil slides on soil.
    pub(crate) fn friction_angle_of(&self, wheel: &Wheel, soil: &Soil) -> Option<f64> {
        let is_smooth = wheel.grousers.is_none_or(|grousers| grousers.height == 0.0);
        let shared = is_smooth && self.friction_share < 1.0;
        let share_of_soil = || shared.then_some(self.friction_share * soil.friction_angle);
        self.friction_angle.or_else(share_of_soil)
    }
}

impl ExitShift {
    /// The wheel sinkage ratio *λ* [-] of a moving wheel: at least 0, and above 1 only where the
    /// soil at rest already is.
    ///
    /// ```text
    /// λ = λ₀ (1 − fading S⁺) + with_slip S⁺ + with_slip_angle |sin β|
    /// ```
    ///
    /// * `at_rest`: the classical *λ₀* [-]
    /// * `total_slip`: *S* [-], −1 to 1
    /// * `slip_angle`: *β* [rad]
    #[must_use]
    pub fn ratio(&self, at_rest: f64, total_slip: f64, slip_angle: f64) -> f64 {
        let spin = total_slip.clamp(0.0, 1.0);
        let shift = self.with_slip * spin + self.with_slip_angle * wide::sin(slip_angle).abs();
        (at_rest * (1.0 - self.fading * spin) + shift).clamp(0.0, at_rest.max(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::deg;

    const SAND: SinkageGrowth = SinkageGrowth {
        with_slip_angle: 2.0,
        with_slip: 3.0,
        bend: -1.0,
        locked: 4.0,
        sharpness: 3.0,
    };

    #[test]
    fn no_growth_is_exactly_one() {
        for (total_slip, degrees) in [(-1.0, 0.0), (-0.3, 50.0), (0.0, 90.0), (1.0, 30.0)] {
            assert_eq!(SmallWheel::OFF.sinkage.at(total_slip, deg(degrees)), 1.0);
        }
    }

    #[test]
    fn growth_alone_is_its_own_term() {
        assert!((SAND.at(1.0, 0.0) - 2.5).abs() < 1e-12);
        assert!((SAND.at(0.0, deg(90.0)) - (1.0 + 2.0 / 0.3)).abs() < 1e-12);
        assert!((SAND.at(-1.0, 0.0) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn a_locked_wheel_digs_to_one_depth_at_any_moderate_angle() {
        for degrees in [0.0, 15.0, 45.0, 60.0] {
            assert!((SAND.at(-1.0, deg(degrees)) - 5.0).abs() < 1e-12);
        }
    }

    #[test]
    fn growth_rises_with_slip_angle_and_slip() {
        for percent in 0..100 {
            let (here, next) = (f64::from(percent) / 100.0, f64::from(percent + 1) / 100.0);
            assert!(SAND.at(next, 0.4) > SAND.at(here, 0.4));
            assert!(SAND.at(0.3, next) > SAND.at(0.3, here) - 1e-12);
            assert!(SAND.at(-next, 0.4) > SAND.at(-here, 0.4));
        }
    }
}
