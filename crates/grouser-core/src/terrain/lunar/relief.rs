//! The relief between craters: a surface that looks alike at every scale.
//!
//! Its heights differ over a distance Δ by
//!
//! ```text
//! v(Δ) = v₀ (Δ/Δ₀)^H          root mean square; H: Hurst exponent          [Rosenburg2011]
//! ```
//!
//! It is a sum of plane waves in all directions, in equal steps of the logarithm of their lengths
//! λ, with amplitudes ∝ λ^H: a wave of amplitude *a* and wave number *k* adds a² (1 − J₀(k Δ)) to
//! v².

use std::f64::consts::{PI, TAU};

use crate::elementary::{pow, wide};
use crate::random::Random;
use crate::terrain::ElevationGrid;
use crate::units::Vec2;

/// How rough the ground is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Hurst exponent, *H*, above 0 and below 1 [-].
    pub hurst: f64,
    /// Root mean square of the slope between points of a line that are [`BASELINE`] apart, as a
    /// tangent [-].
    pub rms_slope: f64,
}

/// Distance over which slopes are stated [m]: the least of those of [Rosenburg2011].
pub const BASELINE: f64 = 17.0;

/// The longest wave [m]. DIFFERENCE: [Rosenburg2011] finds smaller exponents for lengths above
/// about 1 km; of waves that long a site shows a tilt.
const LONGEST: f64 = 8192.0;
/// The golden section [-].
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Waves for each halving of the length.
const PER_OCTAVE: usize = 24;

/// One wave.
#[derive(Clone, Copy, Debug)]
struct Wave {
    amplitude: f64,
    /// Phase for each metre to the east and to the north [rad/m].
    number: Vec2,
    /// Phase at the origin [rad].
    phase: f64,
}

/// Adds the relief to heights at the points of a grid.
///
/// Waves come from the longest down to two cells, so that a finer grid has the same ground with
/// shorter waves.
pub(super) fn add(heights: &mut [f64], grid: &ElevationGrid, rough: Roughness, mut random: Random) {
    if rough.rms_slope == 0.0 {
        return;
    }
    let scale = scale(rough);
    let shortest = 2.0 * grid.spacing.amin();
    // Directions of neighbouring lengths are apart by the golden section of a turn, so that every
    // few of them look alike from all sides; a wave's phase is by chance.
    let start = random.uniform();
    for (place, length) in lengths().take_while(|length| *length >= shortest).enumerate() {
        let turns = start + GOLDEN * place as f64 + random.uniform() / PER_OCTAVE as f64;
        let (along, phase) = (TAU * (turns - turns.floor()), TAU * random.uniform());
        let (sin, cos) = wide::sin_cos(along);
        let number = TAU / length * Vec2::new(cos, sin);
        let amplitude = scale * pow(length, rough.hurst);
        Wave { amplitude, number, phase }.add(heights, grid);
    }
}

/// The lengths of all waves, from the longest down [m].
fn lengths() -> impl Iterator<Item = f64> {
    (0..).map(|step: u32| LONGEST * pow(0.5, f64::from(step) / PER_OCTAVE as f64))
}

/// Amplitude of a wave of 1 m [m], with which the slope over [`BASELINE`] is the one that is asked
/// for.
fn scale(rough: Roughness) -> f64 {
    /// Waves that count, in halvings: shorter ones are a thousandth of the sum.
    const OCTAVES: usize = 16;
    let squared =
        |length: f64| pow(length, 2.0 * rough.hurst) * (1.0 - bessel_j0(TAU * BASELINE / length));
    let sum: f64 = lengths().take(OCTAVES * PER_OCTAVE).map(squared).sum();
    rough.rms_slope * BASELINE / sum.sqrt()
}

/// J₀(x), as the mean of cos(x cos θ); where x is large, its mean value of zero.
fn bessel_j0(x: f64) -> f64 {
    /// Angles of a quarter turn: the mean is exact to rounding up to `LARGE`.
    const ANGLES: u32 = 64;
    /// Beyond it J₀ is at most 0.09, of either sign.
    const LARGE: f64 = 80.0;
    if x > LARGE {
        return 0.0;
    }
    let term = |step: u32| {
        wide::cos(x * wide::cos(0.5 * PI * (f64::from(step) + 0.5) / f64::from(ANGLES)))
    };
    (0..ANGLES).map(term).sum::<f64>() / f64::from(ANGLES)
}

impl Wave {
    fn add(&self, heights: &mut [f64], grid: &ElevationGrid) {
        // From point to point the phase turns by the same angle.
        let (sin, cos) = wide::sin_cos(self.number.x * grid.spacing.x);
        for (row, heights) in heights.chunks_exact_mut(grid.columns).enumerate() {
            let (s, c) = wide::sin_cos(self.phase + self.number.dot(&grid.point(0, row)));
            let (mut s, mut c) = (self.amplitude * s, self.amplitude * c);
            for height in heights {
                *height += c;
                (s, c) = (s * cos + c * sin, c * cos - s * sin);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: tables of J₀.
    #[test]
    fn bessel_function_is_that_of_tables() {
        for (x, expected) in
            [(0.0, 1.0), (1.0, 0.765_197_686_6), (2.404_825_557_7, 0.0), (50.0, 0.055_812_327_7)]
        {
            assert!((bessel_j0(x) - expected).abs() < 1e-9, "{} at {x}", bessel_j0(x));
        }
    }
}
