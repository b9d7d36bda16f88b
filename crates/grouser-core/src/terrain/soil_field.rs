//! Soil that differs from place to place: a random field over the ground.

use std::f64::consts::{PI, TAU};

use crate::elementary::{self, wide};
use crate::random::Random;
use crate::soil::SoilDifference;
use crate::units::Vec2;

/// How many waves a field is made of. Source: ours; their sum is normal to within a hundredth of
/// its spread, and costs less than the forces on a wheel.
const WAVES: usize = 32;

/// A soil's differences by place: one realisation of a homogeneous, isotropic, normal random field.
///
/// ```text
/// friction angle:  σ_φ √(2/N) Σ cos ψ_j       ln stiffness:  σ_k √(2/N) Σ sin ψ_j      ψ_j = k_j·r + ε_j
/// ```
///
/// with phases ε_j and wave vectors k_j such that both are, over all realisations, correlated by
/// exp(−d²/ℓ²) between two places at a distance d, and not with each other (the spectral
/// representation, Shinozuka and Deodatis 1991). It has no grid: a place has a value without any
/// other being computed.
///
/// By how much does the friction angle of a bed differ half a metre apart, if it scatters by 1°?
///
/// ```
/// use grouser_core::terrain::{SoilField, SoilScatter};
/// use grouser_core::units::{Vec2, deg};
///
/// let scatter = SoilScatter { friction_angle: deg(1.0), stiffness: 0.1, correlation_length: 0.3 };
/// let field = SoilField::new(scatter, 1);
/// let at = |x: f64| format!("{:+.2}°", field.at(Vec2::new(x, 0.0)).friction_angle.to_degrees());
/// assert_eq!([at(0.0), at(0.01), at(0.5)], ["-0.77°", "-0.72°", "+1.33°"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoilField {
    scatter: SoilScatter,
    waves: [Wave; WAVES],
}

/// How much a soil scatters from place to place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoilScatter {
    /// Standard deviation of the angle of internal friction [rad].
    pub friction_angle: f64,
    /// Standard deviation of the logarithm of the stiffness [-]: 0.1 is about a tenth.
    pub stiffness: f64,
    /// Distance at which the correlation has fallen to 1/e, *ℓ* [m]. What counts is the mean under
    /// a wheel, so that it is not below a footprint's length.
    pub correlation_length: f64,
}

/// One wave of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Wave {
    /// Wave vector [rad/m].
    vector: Vec2,
    /// Phase at the origin [rad].
    phase: f64,
}

/// The angle between one wave's direction and the next one's [rad]: the golden angle, by which no
/// two are alike.
const GOLDEN_ANGLE: f64 = PI * (3.0 - 2.236_067_977_499_79);

impl SoilField {
    /// A realisation.
    ///
    /// * `seed`: which one
    #[must_use]
    pub fn new(scatter: SoilScatter, seed: u64) -> Self {
        let mut random = Random::stream(seed, FIELD);
        // Equal shares of the spectrum, and all of them turned: over the seeds they are the whole
        // of it.
        let (turn, offset) = (TAU * random.uniform(), random.uniform());
        let waves = std::array::from_fn(|wave| {
            let index = wave as f64;
            let share = (index + offset) / WAVES as f64;
            let number = 2.0 * (-wide::ln(1.0 - share)).sqrt() / scatter.correlation_length;
            let (sin, cos) = wide::sin_cos(turn + GOLDEN_ANGLE * index);
            Wave { vector: number * Vec2::new(cos, sin), phase: TAU * random.uniform() }
        });
        Self { scatter, waves }
    }

    /// How the soil at a place [m] differs from the mean.
    #[must_use]
    pub fn at(&self, place: Vec2) -> SoilDifference {
        let (mut cosines, mut sines) = (0.0, 0.0);
        for wave in &self.waves {
            let (sin, cos) = wide::sin_cos(wave.vector.dot(&place) + wave.phase);
            cosines += cos;
            sines += sin;
        }
        let one = (2.0 / WAVES as f64).sqrt();
        SoilDifference {
            friction_angle: self.scatter.friction_angle * one * cosines,
            stiffness: elementary::exp(self.scatter.stiffness * one * sines),
        }
    }
}

/// The stream of random numbers that fields are made of.
const FIELD: u64 = 0;
