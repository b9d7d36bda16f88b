//! Colours by number: of maps, of heat maps, and of the styles that other programs show maps with.
//!
//! *viridis* of matplotlib for numbers that go one way, a cyclic scale for directions.

// Colours are written as style sheets write them.
#![allow(clippy::unreadable_literal)]

use crate::sheet::Colour;

/// Colours of numbers that go one way, from the least to the largest.
const RAMP: [u32; 9] =
    [0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725];
/// Colours of directions: the ends are alike.
const CYCLE: [u32; 9] =
    [0xe2d9e2, 0x9ebbc9, 0x6276ba, 0x5e43a5, 0x2f1436, 0x7b1e50, 0xb25652, 0xcfa28a, 0xe2d9e2];

/// A number with its colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The number.
    pub at: f64,
    /// Its colour.
    pub colour: Colour,
    /// What it means, where it stands for a word.
    pub word: Option<&'static str>,
}

/// Colours by number.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// Rising; one at least.
    stops: Vec<Stop>,
    is_cycle: bool,
}

impl Scale {
    /// For numbers that go one way.
    #[must_use]
    pub fn ramp(low: f64, high: f64) -> Self {
        Self { stops: evenly(RAMP, low, high), is_cycle: false }
    }

    /// For directions, all around once.
    #[must_use]
    pub fn cycle(low: f64, high: f64) -> Self {
        Self { stops: evenly(CYCLE, low, high), is_cycle: true }
    }

    /// For numbers that stand for words: no colour is mixed.
    #[must_use]
    pub fn words(words: impl IntoIterator<Item = (f64, Colour, &'static str)>) -> Self {
        let stop = |(at, colour, word)| Stop { at, colour, word: Some(word) };
        Self { stops: words.into_iter().map(stop).collect(), is_cycle: false }
    }

    /// Numbers and their colours, rising.
    #[must_use]
    pub fn stops(&self) -> &[Stop] {
        &self.stops
    }

    /// Whether the numbers stand for words.
    #[must_use]
    pub fn is_of_words(&self) -> bool {
        self.stops.iter().any(|stop| stop.word.is_some())
    }

    /// Whether the last number is the first one again.
    #[must_use]
    pub const fn is_cycle(&self) -> bool {
        self.is_cycle
    }

    /// The first and the last number.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.stops.first(), self.stops.last()].map(|stop| stop.map_or(0.0, |stop| stop.at))
    }

    /// The colour of a number, mixed of those around it; of a word that of the nearest below.
    #[must_use]
    pub fn colour(&self, number: f64) -> Colour {
        let after = self.stops.partition_point(|stop| stop.at <= number);
        let below = self.stops[after.saturating_sub(1)];
        match self.stops.get(after) {
            Some(above) if after > 0 && below.word.is_none() => {
                below.colour.mixed(above.colour, (number - below.at) / (above.at - below.at))
            }
            _ => below.colour,
        }
    }
}

fn evenly<const N: usize>(codes: [u32; N], low: f64, high: f64) -> Vec<Stop> {
    let at = |place: usize| low + (high - low) * place as f64 / (N - 1) as f64;
    let stop = |(place, code)| Stop { at: at(place), colour: Colour::hex(code), word: None };
    codes.into_iter().enumerate().map(stop).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_mixed_between_stops_and_stay_beyond_them() {
        let scale = Scale::ramp(0.0, 8.0);
        let code = |number: f64| scale.colour(number).code();
        assert_eq!(
            [code(-1.0), code(0.0), code(8.0), code(99.0)].map(|it| it[1..].to_owned()),
            ["440154", "440154", "fde725", "fde725"]
        );
        assert_eq!(scale.colour(0.5), Colour::hex(0x440154).mixed(Colour::hex(0x472d7b), 0.5));
        let cycle = Scale::cycle(-180.0, 180.0);
        assert_eq!(cycle.colour(-180.0), cycle.colour(180.0));
    }

    #[test]
    fn words_have_their_own_colours_alone() {
        let [green, red] = [0x009e73, 0xd55e00].map(Colour::hex);
        let scale = Scale::words([(1.0, green, "go"), (2.0, red, "no-go")]);
        assert_eq!([1.0, 1.9, 2.0].map(|number| scale.colour(number)), [green, green, red]);
    }
}
