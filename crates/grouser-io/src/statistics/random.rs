//! Random numbers of studies, from independent streams: a stream's numbers depend on no other
//! stream and on no thread.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::normal::normal_score;

/// The generator of a stream.
#[must_use]
pub fn generator(seed: u64, stream: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    random
}

/// A number above 0 and below 1.
pub fn uniform(random: &mut ChaCha8Rng) -> f64 {
    part(random.next_u64())
}

/// A whole number below a count, of which there is at least one.
pub fn below(random: &mut ChaCha8Rng, count: usize) -> usize {
    place_below(uniform(random) * count as f64, count)
}

/// The whole part of a place in a list that is not negative; the last one for what is beyond.
#[must_use]
pub fn place_below(place: f64, length: usize) -> usize {
    // Saturating: what is beyond the largest number of all is beyond the list, too.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let whole = place as usize;
    whole.min(length - 1)
}

/// A standard normal number, by the inverse of its distribution at a uniform one.
pub fn standard_normal(random: &mut ChaCha8Rng) -> f64 {
    normal_score(uniform(random))
}

/// The middle of one of 2⁵² equal parts, by the first bits of a word. With 2⁵³ of them the last
/// middle would round to 1, where no normal number is.
fn part(word: u64) -> f64 {
    const PARTS: f64 = (1_u64 << 52) as f64;
    ((word >> 12) as f64 + 0.5) / PARTS
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ends themselves have no normal score.
    #[test]
    fn no_word_makes_an_end() {
        assert!(part(0) > 0.0 && part(u64::MAX) < 1.0);
        assert_eq!(part(0), 1.0 - part(u64::MAX));
        for word in [0, u64::MAX] {
            assert!(normal_score(part(word)).is_finite());
        }
    }

    #[test]
    fn streams_differ_and_repeat() {
        let draws = |seed, stream| {
            let mut random = generator(seed, stream);
            [(); 4].map(|()| uniform(&mut random))
        };
        assert_eq!(draws(7, 3), draws(7, 3));
        assert_ne!(draws(7, 3), draws(7, 4));
        assert_ne!(draws(7, 3), draws(8, 3));
    }
}
