//! Random numbers of a scenario: few, from independent streams, the same on every machine.

use std::f64::consts::TAU;

use crate::elementary::wide;

/// The largest seed that JSON keeps exactly.
pub const LARGEST_SEED: u64 = (1 << 53) - 1;

/// A stream of random numbers: SplitMix64 (Steele, Lea and Flood 2014).
///
/// Studies, which need many more, have a generator of a library; a run needs some dozens, and its
/// crate stays light.
#[derive(Clone, Debug)]
pub(crate) struct Random {
    state: u64,
}

impl Random {
    /// A stream of a seed; other seeds and streams have other numbers.
    pub(crate) fn stream(seed: u64, stream: u64) -> Self {
        // One after the other, so that seed and stream do not stand for each other.
        let seeded = Self { state: seed }.next();
        Self { state: Self { state: seeded.wrapping_add(stream) }.next() }
    }

    /// The seed of a case: of (seed, case) alone, and one that documents can hold.
    pub(crate) fn of_case(seed: u64, case: u64) -> u64 {
        Self::stream(seed, case).next() & LARGEST_SEED
    }

    /// A number above 0 and below 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        const PARTS: f64 = (1_u64 << 52) as f64;
        ((self.next() >> 12) as f64 + 0.5) / PARTS
    }

    /// A standard normal number (Box and Muller 1958).
    pub(crate) fn normal(&mut self) -> f64 {
        let (size, direction) = (self.uniform(), self.uniform());
        (-2.0 * wide::ln(size)).sqrt() * wide::cos(TAU * direction)
    }

    /// A number of the exponential distribution with mean 1.
    pub(crate) fn exponential(&mut self) -> f64 {
        -wide::ln(self.uniform())
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut word = self.state;
        word = (word ^ (word >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        word ^ (word >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published outputs for seed 1234567, as reference implementations print them.
    #[test]
    fn words_are_the_published_ones() {
        let mut random = Random { state: 1_234_567 };
        let words = [(); 3].map(|()| random.next());
        assert_eq!(
            words,
            [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]
        );
    }

    #[test]
    fn normal_numbers_have_mean_0_and_deviation_1() {
        const COUNT: u32 = 20_000;
        let mut random = Random::stream(3, 1);
        let all: Vec<f64> = (0..COUNT).map(|_| random.normal()).collect();
        let mean = all.iter().sum::<f64>() / f64::from(COUNT);
        let variance = all.iter().map(|value| value * value).sum::<f64>() / f64::from(COUNT);
        assert!(mean.abs() < 0.03, "{mean}");
        assert!((variance - 1.0).abs() < 0.04, "{variance}");
    }

    #[test]
    fn cases_do_not_share_a_seed() {
        let mut all: Vec<u64> =
            (0..60).flat_map(|seed| (0..60).map(move |case| Random::of_case(seed, case))).collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), 3600);
        assert!(all.iter().all(|seed| *seed <= LARGEST_SEED));
    }

    #[test]
    fn streams_and_seeds_differ() {
        let first = |seed, stream| Random::stream(seed, stream).uniform();
        assert_eq!(first(7, 1), first(7, 1));
        assert_ne!(first(7, 1), first(7, 0));
        assert_ne!(first(7, 1), first(8, 1));
    }
}
