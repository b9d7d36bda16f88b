//! What a soil is to a wheel: how it carries, how it shears, how it is pushed aside.
//!
//! A [`Soil`] is a set of constants of the wheel–soil models in [`contact`](crate::contact); it
//! does no mechanics itself beyond evaluating its own laws. All values are in SI units.

pub mod compaction;
pub mod difference;
pub mod discrepancy;
pub mod domain;
pub mod gravity_scaling;
pub mod pressure_sinkage;
pub mod rft;
pub mod slope;
pub mod small_wheel;
mod usual;

use std::f64::consts::FRAC_PI_4;

pub use compaction::Compaction;
pub use difference::SoilDifference;
pub use discrepancy::Discrepancy;
pub use domain::{AssumedValues, Domain, Span};
pub use gravity_scaling::GravityScaling;
pub use pressure_sinkage::{PressureSinkage, SinkageExponent};
pub use rft::Rft;
pub use slope::SlopeStability;
pub use small_wheel::SmallWheel;

use crate::elementary;
use crate::error::{ParameterError, finite, not_negative, positive};
use crate::units::EARTH_GRAVITY;
use crate::wheel::Wheel;

/// A homogeneous soil.
///
/// How heavy is Toyoura sand, and which pressure lets a plate of 8 cm width sink 2 cm into it?
///
/// ```
/// use grouser_core::soil::{
///     Bulldozing, Domain, Exit, SmallWheel, PressureSinkage, Rft, Shear, ShearBound, ShearModulus,
///     SinkageExponent, Soil, StressPeak,
/// };
/// use grouser_core::units::{EARTH_GRAVITY, deg};
///
/// let exponent = SinkageExponent::constant(1.703);
/// let sand = Soil {
///     cohesion: 0.0,
///     friction_angle: deg(38.0),
///     constant_volume_share: 0.0,
///     density: 1490.0,
///     pressure_sinkage: PressureSinkage::Reece { k_c: 0.0, k_phi: 122.727, exponent },
///     stress_peak: StressPeak { a0: 0.40, a1: 0.15 },
///     shear: Shear::Isotropic { modulus: ShearModulus::constant(0.036) },
///     shear_bound: ShearBound::Coulomb,
///     exit: Exit::Ratio(1.0),
///     bulldozing: Bulldozing::Sine,
///     small_wheel: SmallWheel::OFF,
///     rft: Rft::PUBLISHED,
///     domain: Domain::UNSTATED,
///     discrepancy: None,
/// };
/// let unit_weight = sand.unit_weight(EARTH_GRAVITY);
/// assert_eq!(format!("{:.1} kN/m³", 1e-3 * unit_weight), "14.6 kN/m³");
/// let stiffness = sand.pressure_sinkage.stiffness(0.08, sand.cohesion, unit_weight, 0.0);
/// assert_eq!(format!("{:.1} kPa", 1e-3 * stiffness.pressure(0.02)), "13.5 kPa");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soil {
    /// Cohesion, *c* [Pa].
    pub cohesion: f64,
    /// Angle of internal friction, *φ* [rad].
    pub friction_angle: f64,
    /// How far friction under a wheel has gone from its peak, tan φ, to that of soil which shears
    /// on at constant volume, sin φ [-]: 0 to 1 ([`mobilised_friction`](Self::mobilised_friction)).
    pub constant_volume_share: f64,
    /// Bulk density, *ρ* [kg/m³].
    pub density: f64,
    /// How pressure grows with sinkage.
    pub pressure_sinkage: PressureSinkage,
    /// Where along the arc the normal stress peaks.
    pub stress_peak: StressPeak,
    /// How shear stress is mobilised.
    pub shear: Shear,
    /// What bounds it.
    pub shear_bound: ShearBound,
    /// Where the wheel leaves the soil.
    pub exit: Exit,
    /// How soil pushed aside loads the side wall.
    pub bulldozing: Bulldozing,
    /// What the small-wheel model adds; the others leave it aside.
    pub small_wheel: SmallWheel,
    /// What resistive force theory needs; the others leave it aside.
    pub rft: Rft,
    /// For which wheels, loads and motions the constants are known to hold. No model looks at it.
    pub domain: Domain,
    /// What the model gets wrong, where a calibration has found it; nothing without it.
    pub discrepancy: Option<Discrepancy>,
}

/// Where the normal stress peaks: *θ_m* = (a₀ + a₁ |s|) *θ_f* (Wong and Reece 1967).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressPeak {
    /// Share of the entry angle at zero slip, *a₀* [-].
    pub a0: f64,
    /// Its growth with the slip ratio, *a₁* [-].
    pub a1: f64,
}

impl StressPeak {
    /// The stress peak may come this near to the entry angle [-]. At 1 the model has no stress
    /// anywhere, for any sinkage: the profile's height is taken at its own edge.
    pub const LARGEST_SHARE: f64 = 0.99;

    /// Share of the entry angle at which the normal stress peaks [-], 0 to
    /// [`LARGEST_SHARE`](Self::LARGEST_SHARE).
    ///
    /// The slip ratio enters by its size, at most 1: in skid the classical model keeps a₀ and a₁.
    #[must_use]
    pub fn share(&self, slip_ratio: f64) -> f64 {
        (self.a0 + self.a1 * slip_ratio.abs().min(1.0)).clamp(0.0, Self::LARGEST_SHARE)
    }
}

/// How shear stress grows with shear displacement (Janosi and Hanamoto 1961).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shear {
    /// Each axis on its own, as in the source paper. |τ| may exceed the Mohr-Coulomb limit by √2.
    Anisotropic {
        /// Along the wheel, *K_x*.
        longitudinal: ShearModulus,
        /// Across the wheel, *K_y*.
        lateral: ShearModulus,
    },
    /// One stress, against the slip velocity; respects |τ| ≤ c + σ tan φ.
    ///
    /// Under a wheel that begins to skid the velocity is reversed straight down, so the pull falls
    /// like the root of the slip: at zero slip it has a slope from above alone
    /// (`docs/models/ishigami.md`).
    Isotropic {
        /// In every direction, *K*.
        modulus: ShearModulus,
    },
}

impl Shear {
    /// Checks that the law's constants are within their ranges.
    ///
    /// # Errors
    /// [`ParameterError`] for the first one that is not.
    pub fn check(&self) -> Result<(), ParameterError> {
        match self {
            Self::Anisotropic { longitudinal, lateral } => {
                longitudinal.check("longitudinal shear modulus [m]")?;
                lateral.check("lateral shear modulus [m]")
            }
            Self::Isotropic { modulus } => modulus.check("shear modulus [m]"),
        }
    }
}

/// Whether the shear stresses along and across a wheel, and its whole reaction, obey Coulomb's law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShearBound {
    /// Only as far as the shear law does. [`Shear::Anisotropic`] lets the resultant exceed the
    /// strength by √2, as in the source paper.
    #[default]
    None,
    /// The resultant shear stress stays within c + σ tan φ, and a wheel's horizontal force within
    /// what the soil under and ahead of it resists ([`coulomb`](crate::contact::coulomb)). Soil
    /// that a wheel hardly presses takes no tension ([`cohesion`](crate::contact::cohesion)).
    Coulomb,
}

/// Shear deformation modulus *K* [m] as a function of the slip angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShearModulus {
    /// K = K₀ + K₁ |β|, after Ishigami et al. (2007).
    Linear {
        /// *K₀* [m].
        at_zero: f64,
        /// *K₁* [m/rad].
        per_radian: f64,
    },
    /// K = K₀ + K₁ |β| + K₂ β², |β| at most the limit: the laboratory's Toyoura fit of 2007.
    Quadratic {
        /// *K₀* [m].
        at_zero: f64,
        /// *K₁* [m/rad].
        per_radian: f64,
        /// *K₂* [m/rad²].
        per_radian_squared: f64,
        /// The largest |β| that the fit knows [rad].
        angle_limit: f64,
    },
}

impl ShearModulus {
    /// A modulus that does not depend on the slip angle, [m].
    #[must_use]
    pub fn constant(modulus: f64) -> Self {
        Self::Linear { at_zero: modulus, per_radian: 0.0 }
    }

    /// The modulus *K* [m] at a slip angle [rad] of either sign.
    #[must_use]
    pub fn at(&self, slip_angle: f64) -> f64 {
        let beta = slip_angle.abs();
        match *self {
            Self::Linear { at_zero, per_radian } => at_zero + per_radian * beta,
            Self::Quadratic { at_zero, per_radian, per_radian_squared, angle_limit } => {
                let beta = beta.min(angle_limit);
                at_zero + per_radian * beta + per_radian_squared * beta * beta
            }
        }
    }

    fn check(&self, name: &str) -> Result<(), ParameterError> {
        /// Slip angles at which a modulus is tried, from 0 to 90°.
        const TRIALS: u32 = 90;
        for trial in 0..=TRIALS {
            let slip_angle = 2.0 * FRAC_PI_4 * f64::from(trial) / f64::from(TRIALS);
            let modulus = self.at(slip_angle);
            if !(modulus.is_finite() && modulus > 0.0) {
                let name = format!("{name} at a slip angle of {slip_angle:.2} rad");
                return Err(ParameterError::new(name, modulus, "above zero"));
            }
        }
        Ok(())
    }
}

/// Exit-angle ratio λ: the share of the sinkage that the soil recovers behind the wheel [-].
///
/// Below 1 the wheel leaves a rut; above 1 soil is piled up behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exit {
    /// The same for every slip.
    Ratio(f64),
    /// λ = λ₀ + λ₁ s + λ₂ s², with skid counted as s = 0: the laboratory's fit of 2012.
    QuadraticInSlip {
        /// *λ₀* [-].
        at_zero: f64,
        /// *λ₁* [-].
        per_slip: f64,
        /// *λ₂* [-].
        per_slip_squared: f64,
    },
}

impl Exit {
    /// The ratio λ [-] at a slip ratio, never negative.
    #[must_use]
    pub fn ratio(&self, slip_ratio: f64) -> f64 {
        match *self {
            Self::Ratio(ratio) => ratio,
            Self::QuadraticInSlip { at_zero, per_slip, per_slip_squared } => {
                let s = slip_ratio.clamp(0.0, 1.0);
                (at_zero + per_slip * s + per_slip_squared * s * s).max(0.0)
            }
        }
    }
}

/// How the force of the soil pushed aside by the side wall depends on the slip angle β.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bulldozing {
    /// No such force.
    None,
    /// Full force whatever the size of β (Ishigami et al. 2007). It jumps at β = 0; in a run it
    /// reverses within a lateral speed of a micrometre per second.
    Sign,
    /// In proportion to sin β (Jia 2012): smooth.
    Sine,
    /// In proportion to sin² β, with its part along the wheel, −F_s sin|β| cos β, and with the
    /// surcharge of the soil already piled up: the laboratory's code of 2007.
    SineSquared,
}

impl Soil {
    /// Weight of a cubic metre, *γ* = ρ g [N/m³].
    #[must_use]
    pub fn unit_weight(&self, gravity: f64) -> f64 {
        self.density * gravity
    }

    /// Destructive angle of the soil ahead of a passive wall, *X_c* = 45° − φ/2 [rad].
    #[must_use]
    pub fn destructive_angle(&self) -> f64 {
        FRAC_PI_4 - self.friction_angle / 2.0
    }

    /// cot X_c = (1 + sin φ)/cos φ [-].
    #[inline]
    pub(crate) fn destructive_cot(&self) -> f64 {
        let (sin, cos) = elementary::sin_cos(self.friction_angle);
        (1.0 + sin) / cos
    }

    /// Coefficient of internal friction, tan φ [-].
    #[inline]
    pub(crate) fn friction(&self) -> f64 {
        let (sin, cos) = elementary::sin_cos(self.friction_angle);
        sin / cos
    }

    /// Coefficient of friction in the soil that a wheel shears, tan *φ_m* [-].
    ///
    /// ```text
    /// tan φ_m = (1 − w) tan φ + w sin φ
    /// ```
    ///
    /// with w the [`constant_volume_share`](Self::constant_volume_share). On a surface along which
    /// soil slips with a dilation ψ, φ gives tan φ_m = sin φ cos ψ/(1 − sin φ sin ψ) (Davis 1968):
    /// tan φ with ψ = φ, and sin φ where the volume does not change any more, as in soil that a
    /// wheel shears by centimetres. A peak found in triaxial or plane-strain tests is φ; a shear
    /// box measures tan φ_m itself, on its own surface of slip.
    ///
    /// Wedges that break out of the ground, and the ground's own stability, are at their peak and
    /// have tan φ.
    #[inline]
    #[must_use]
    pub fn mobilised_friction(&self) -> f64 {
        let (sin, cos) = elementary::sin_cos(self.friction_angle);
        let share = self.constant_volume_share;
        (1.0 - share) * (sin / cos) + share * sin
    }

    /// The same soil on a slope, where wedges of it resist less against being pushed downhill.
    ///
    /// ```text
    /// share = cos³ α √(1 − tan² α/tan² φ)
    /// ```
    ///
    /// of the resistance on level ground, and none from the angle of friction on. It is the
    /// difference of Rankine's passive and active pressure below a surface inclined by α, over the
    /// same on level ground. At α = φ the ground itself is about to slide, and nothing lies safe in
    /// front of a wheel.
    ///
    /// * `steepness`: tan α [-], of the slope on which the wheel stands
    #[must_use]
    pub fn on_slope(&self, steepness: f64) -> Self {
        let used = steepness / self.friction();
        // cos² α = 1/(1 + tan² α)
        let cos_squared = 1.0 / (1.0 + steepness * steepness);
        let wedge_share = cos_squared * (cos_squared * (1.0 - used * used).max(0.0)).sqrt();
        Self { small_wheel: SmallWheel { wedge_share, ..self.small_wheel }, ..*self }
    }

    /// Checks that a soil can have these constants at all. (Documents have narrower ranges of their
    /// own.)
    ///
    /// # Errors
    /// [`ParameterError`] for the first constant that it cannot have.
    pub fn check(&self) -> Result<(), ParameterError> {
        not_negative("cohesion [Pa]", self.cohesion)?;
        positive("density [kg/m³]", self.density)?;
        if !(0.0..=1.0).contains(&self.constant_volume_share) {
            let name = "share of constant-volume friction";
            return Err(ParameterError::new(name, self.constant_volume_share, "0 to 1"));
        }
        if !(self.friction_angle > 0.0 && self.friction_angle < 2.0 * FRAC_PI_4) {
            let expected = "above 0 and below π/2";
            return Err(ParameterError::new("friction angle [rad]", self.friction_angle, expected));
        }
        not_negative("stress peak a0", self.stress_peak.a0)?;
        finite("stress peak a1", self.stress_peak.a1)?;
        self.domain.check()?;
        self.check_pressure_sinkage()?;
        self.shear.check()?;
        self.small_wheel.check()?;
        self.rft.check()?;
        self.discrepancy.as_ref().map_or(Ok(()), Discrepancy::check)?;
        match self.exit {
            Exit::Ratio(ratio) => not_negative("exit ratio", ratio),
            Exit::QuadraticInSlip { at_zero, per_slip, per_slip_squared } => {
                not_negative("exit ratio at zero slip", at_zero)?;
                finite("exit ratio per slip", per_slip)?;
                finite("exit ratio per slip squared", per_slip_squared)
            }
        }
    }
    /// Checks that the soil resists plates and wheels of the widths that its domain states, of
    /// every width where it states none, under the gravities that it states, or else the Earth's.
    ///
    /// # Errors
    /// [`ParameterError`] for the first number of the pressure-sinkage law that does not.
    pub fn check_pressure_sinkage(&self) -> Result<(), ParameterError> {
        let Domain { gravity, width, .. } = self.domain;
        let is_bounded = gravity.low > 0.0 && gravity.high.is_finite();
        let gravity = if is_bounded { gravity } else { Span::new(EARTH_GRAVITY, EARTH_GRAVITY) };
        let weights = Span::new(self.unit_weight(gravity.low), self.unit_weight(gravity.high));
        self.pressure_sinkage.check(self.cohesion, weights, width)
    }

    /// Checks that the soil resists a wheel: with a negative modulus of pressure-sinkage it may
    /// resist wider or narrower ones alone. No model is asked for what it cannot know.
    ///
    /// * `gravity`: *g* [m/s²]
    ///
    /// # Errors
    /// [`ParameterError`] with the wheel's width, if it does not.
    pub fn check_under(&self, wheel: &Wheel, gravity: f64) -> Result<(), ParameterError> {
        let weight = self.unit_weight(gravity);
        self.pressure_sinkage.check_width(wheel.width, self.cohesion, weight)
    }
}
