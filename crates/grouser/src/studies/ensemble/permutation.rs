//! A random permutation of which each place is computed on its own.
//!
//! Latin hypercubes need a random order of N strata for each dimension. To keep such an order in
//! memory costs N words, and to make it costs all runs before one; here place *i* is computed from
//! a key and *i* alone. A Feistel network (Luby and Rackoff 1988) permutes the numbers of an even
//! number of bits, a power of four that is less than four times N; where it leads beyond N it is
//! applied again until it does not (cycle walking, Black and Rogaway 2002), which leaves a
//! permutation of what is below N.

/// A keyed permutation of the numbers below some N.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Permutation {
    count: u64,
    half_bits: u32,
    key: u64,
}

/// Rounds of the network. Four make it a good one (Luby and Rackoff); a few more cost nothing
/// beside a run, and few bits need them.
const ROUNDS: u64 = 8;

impl Permutation {
    /// * `count`: N, at least 1 and at most 2⁶²
    pub(super) fn new(count: u64, key: u64) -> Self {
        let bits = u64::BITS - (count - 1).leading_zeros();
        Self { count, half_bits: bits.div_ceil(2).max(1), key }
    }

    /// Where a place goes.
    ///
    /// * `place`: below N
    pub(super) fn at(&self, place: u64) -> u64 {
        let mut here = self.network(place);
        while here >= self.count {
            here = self.network(here);
        }
        here
    }

    fn network(&self, word: u64) -> u64 {
        let mask = (1 << self.half_bits) - 1;
        let (mut left, mut right) = (word >> self.half_bits, word & mask);
        for round in 0..ROUNDS {
            let mixed = mix(self.key ^ mix(right ^ (round << 32)));
            (left, right) = (right, left ^ (mixed & mask));
        }
        (left << self.half_bits) | right
    }
}

/// A word that depends on every bit of another (splitmix64, Steele, Lea and Flood 2014).
pub(super) fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_reached_once() {
        for count in [1, 2, 3, 4, 5, 16, 17, 100, 1000, 1025] {
            let permutation = Permutation::new(count, 7 + count);
            let mut places: Vec<u64> = (0..count).map(|place| permutation.at(place)).collect();
            places.sort_unstable();
            assert_eq!(places, (0..count).collect::<Vec<_>>(), "{count}");
        }
    }

    /// Over keys every place goes everywhere alike: χ² with (n − 1)² degrees of freedom is above
    /// its mean by more than five of its deviations, √2 (n − 1), once in a million.
    #[test]
    fn no_place_is_preferred() {
        const KEYS: u64 = 20_000;
        for count in [3_usize, 7, 10] {
            let mut hits = vec![0_u32; count * count];
            for key in 0..KEYS {
                let permutation = Permutation::new(count as u64, mix(key));
                for place in 0..count {
                    let to = permutation.at(place as u64);
                    hits[place * count + usize::try_from(to).expect("it is small")] += 1;
                }
            }
            let expected = KEYS as f64 / count as f64;
            let chi: f64 =
                hits.iter().map(|hit| (f64::from(*hit) - expected).powi(2) / expected).sum();
            let free = (count - 1) as f64;
            assert!(chi < free * free + 5.0 * 2_f64.sqrt() * free, "{count}: {chi}");
        }
    }
}
