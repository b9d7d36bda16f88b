//! Inclines, ramps, cones and ripples.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::elementary::wide;
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::units::Vec2;

/// A plane.
///
/// ```text
/// z = tan α (x cos γ + y sin γ)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Incline {
    /// Inclination, *α* [rad], 0 to below π/2.
    pub slope: f64,
    /// Direction in which it rises, *γ* [rad].
    pub uphill: f64,
}

/// Level ground, an incline, and level ground again.
///
/// ```text
/// z = tan α (I(s) − I(s − l))        I(s) = ∫ min(1, max(0, s/b + 1/2)) ds        s: from the foot, uphill
/// ```
///
/// The slope changes evenly over a rounding of length *b*, half of it before the foot and half
/// after it, and the same at the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ramp {
    /// A place on the line where it starts [m].
    pub foot: Vec2,
    /// Direction in which it rises [rad].
    pub uphill: f64,
    /// Inclination, *α* [rad], 0 to below π/2.
    pub slope: f64,
    /// Its length on the map, *l* [m].
    pub length: f64,
    /// Length on the map over which the slope changes, *b* [m], 0 to the ramp's length.
    pub rounding: f64,
}

/// A cone about a vertical axis, rounded at its tip.
///
/// ```text
/// z = −tan α r                     r ≥ ρ: distance from the axis
/// z = −tan α (r²/ρ + ρ)/2          r < ρ
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Where its axis is [m].
    pub tip: Vec2,
    /// Inclination, *α* [rad], −π/2 to π/2: a hill above zero, a pit below.
    pub slope: f64,
    /// How far from the axis the tip is rounded, *ρ* [m].
    pub rounding: f64,
}

/// Straight waves.
///
/// ```text
/// z = a sin(2π s/λ + φ)            s = x cos γ + y sin γ
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ripple {
    /// Half of the height from trough to crest, *a* [m].
    pub amplitude: f64,
    /// Distance from crest to crest, *λ* [m].
    pub wavelength: f64,
    /// Direction from crest to crest, *γ* [rad].
    pub across: f64,
    /// Phase at the origin, *φ* [rad].
    pub phase: f64,
}

impl Incline {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        finite("direction uphill [rad]", self.uphill)?;
        inclination(self.slope)
    }

    pub(super) fn height(&self, at: Vec2) -> f64 {
        self.gradient().dot(&at)
    }

    pub(super) fn gradient(&self) -> Vec2 {
        wide::tan(self.slope) * unit(self.uphill)
    }
}

impl Ramp {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        place("foot of the ramp [m]", self.foot)?;
        finite("direction uphill [rad]", self.uphill)?;
        inclination(self.slope)?;
        positive("length of the ramp [m]", self.length)?;
        not_negative("rounding of the ramp [m]", self.rounding)?;
        if self.rounding <= self.length {
            Ok(())
        } else {
            let expected = "0 to the ramp's length";
            Err(ParameterError::new("rounding of the ramp [m]", self.rounding, expected))
        }
    }

    pub(super) fn height(&self, at: Vec2) -> f64 {
        let s = unit(self.uphill).dot(&(at - self.foot));
        wide::tan(self.slope) * (self.climbed(s) - self.climbed(s - self.length))
    }

    pub(super) fn gradient(&self, at: Vec2) -> Vec2 {
        let uphill = unit(self.uphill);
        let s = uphill.dot(&(at - self.foot));
        wide::tan(self.slope) * (self.share(s) - self.share(s - self.length)) * uphill
    }

    /// The share of the full slope that begins at 0 [-].
    fn share(&self, s: f64) -> f64 {
        if self.rounding > 0.0 {
            (s / self.rounding + 0.5).clamp(0.0, 1.0)
        } else if s > 0.0 {
            1.0
        } else {
            0.0
        }
    }

    /// The integral of that share [m].
    fn climbed(&self, s: f64) -> f64 {
        let half = 0.5 * self.rounding;
        if s <= -half {
            0.0
        } else if s >= half {
            s
        } else {
            (s + half) * (s + half) / (2.0 * self.rounding)
        }
    }
}

impl Cone {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        place("tip of the cone [m]", self.tip)?;
        not_negative("rounding of the cone [m]", self.rounding)?;
        if self.slope.abs() < FRAC_PI_2 {
            Ok(())
        } else {
            Err(ParameterError::new("slope of the cone [rad]", self.slope, "−π/2 to π/2"))
        }
    }

    pub(super) fn height(&self, at: Vec2) -> f64 {
        let from = at - self.tip;
        let r = wide::hypot(from.x, from.y);
        let fallen =
            if r < self.rounding { 0.5 * (r * r / self.rounding + self.rounding) } else { r };
        -wide::tan(self.slope) * fallen
    }

    pub(super) fn gradient(&self, at: Vec2) -> Vec2 {
        let from = at - self.tip;
        let r = wide::hypot(from.x, from.y).max(self.rounding);
        if r == 0.0 { Vec2::zeros() } else { from * (-wide::tan(self.slope) / r) }
    }
}

impl Ripple {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        not_negative("amplitude of the ripple [m]", self.amplitude)?;
        positive("wavelength of the ripple [m]", self.wavelength)?;
        finite("direction across the ripple [rad]", self.across)?;
        finite("phase of the ripple [rad]", self.phase)
    }

    /// The height at a place.
    pub(super) fn heights(&self) -> impl Fn(Vec2) -> f64 {
        let Self { amplitude, .. } = *self;
        let angle = self.angles();
        move |at| amplitude * wide::sin(angle(at))
    }

    pub(super) fn gradient(&self, at: Vec2) -> Vec2 {
        let steepness = TAU / self.wavelength * self.amplitude;
        steepness * wide::cos(self.angles()(at)) * unit(self.across)
    }

    /// The phase at a place [rad].
    fn angles(&self) -> impl Fn(Vec2) -> f64 {
        let Self { wavelength, phase, .. } = *self;
        let across = unit(self.across);
        move |at| TAU * (across.dot(&at) / wavelength) + phase
    }
}

/// The unit vector of a direction [rad].
fn unit(direction: f64) -> Vec2 {
    let (sin, cos) = wide::sin_cos(direction);
    Vec2::new(cos, sin)
}

pub(super) fn place(name: &str, at: Vec2) -> Result<(), ParameterError> {
    finite(name, at.x)?;
    finite(name, at.y)
}

fn inclination(slope: f64) -> Result<(), ParameterError> {
    if (0.0..FRAC_PI_2).contains(&slope) {
        Ok(())
    } else {
        Err(ParameterError::new("slope [rad]", slope, "0 to below π/2"))
    }
}
