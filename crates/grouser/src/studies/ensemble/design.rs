//! Designs: the points of the unit cube at which a campaign samples its inputs.
//!
//! | sampling | points | error of a mean of N |
//! |---|---|---|
//! | Monte Carlo | independent | σ/√N |
//! | Latin hypercube (McKay, Beckman and Conover 1979) | one in each of N strata of every dimension | that of what is not additive in the inputs, /√N |
//! | Sobol | a digital net with Owen's scrambling (Burley 2020), whole at powers of two | down to about N^(−3/2) for smooth results of few inputs |
//!
//! Every point is uniform in the cube and depends on the design and its own number alone.

use rand_chacha::ChaCha8Rng;

use super::permutation::{Permutation, mix};
use crate::studies::random;
pub use grouser_io::campaign::Sampling;

/// A set of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Design {
    /// The method.
    pub sampling: Sampling,
    /// Number of points, *N*; at least 1.
    pub points: u64,
    /// Number of dimensions.
    pub dimensions: usize,
    /// Seed of the set.
    pub seed: u64,
}

/// Points of one scrambled Sobol sequence: the direction numbers have 16 bits.
pub const SOBOL_LENGTH: u64 = 1 << 16;
/// Dimensions of the Sobol sequence for which there are direction numbers.
pub const SOBOL_DIMENSIONS: usize = sobol_burley::NUM_DIMENSIONS as usize;

impl Design {
    /// Point number `index`: a number above 0 and below 1 for each dimension.
    ///
    /// # Panics
    /// If a Sobol design has more than [`SOBOL_DIMENSIONS`].
    #[must_use]
    pub fn point(&self, index: u64) -> Vec<f64> {
        let mut random = random::generator(self.seed, index);
        (0..self.dimensions)
            .map(|dimension| {
                let within = random::uniform(&mut random);
                match self.sampling {
                    Sampling::MonteCarlo => within,
                    Sampling::LatinHypercube => self.in_stratum(index, dimension, within),
                    Sampling::Sobol => self.in_net(index, dimension, within),
                }
            })
            .map(inside)
            .collect()
    }

    /// * `within`: the place in the stratum
    fn in_stratum(&self, index: u64, dimension: usize, within: f64) -> f64 {
        let key = mix(self.seed ^ mix(dimension as u64));
        let stratum = Permutation::new(self.points, key).at(index);
        (stratum as f64 + within) / self.points as f64
    }

    /// * `within`: the place in the finest part that the net knows
    fn in_net(&self, index: u64, dimension: usize, within: f64) -> f64 {
        /// Single precision has 2²³ numbers from 1 to 2, and as many points has the net's axis.
        const FINEST: f64 = 1.0 / (1_u64 << 23) as f64;
        let (sequence, place) = (index / SOBOL_LENGTH, index % SOBOL_LENGTH);
        let seed = mix(self.seed ^ mix(sequence));
        // The lower half of a well mixed word is as good as the whole; place and dimension are
        // small.
        #[expect(clippy::cast_possible_truncation)]
        let (place, dimension, seed) = (place as u32, dimension as u32, seed as u32);
        f64::from(sobol_burley::sample(place, dimension, seed)) + within * FINEST
    }
}

/// Rounding may lead to an end, where no quantile is.
fn inside(share: f64) -> f64 {
    share.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0)
}

/// An independent stream for what is drawn about a finished campaign, such as resampling.
pub(super) fn resampling(seed: u64, stream: u64) -> ChaCha8Rng {
    random::generator(seed, stream)
}
