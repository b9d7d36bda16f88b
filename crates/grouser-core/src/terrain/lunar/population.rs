//! How many craters there are of which size, and how deep they are.

use super::degradation::SHALLOWEST;
use crate::random::Random;
use crate::terrain::Extent;
use crate::units::Vec2;

/// A crater as it is today.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgedCrater {
    /// Where its centre is [m].
    pub centre: Vec2,
    /// Diameter of its crest [m].
    pub diameter: f64,
    /// How far its centre is below the crest [m].
    pub depth: f64,
}

/// Craters in equilibrium: as many form as wear away.
///
/// ```text
/// N(≥ D) = c/D²          on each square metre, D in metres
/// ```
///
/// Source: [Dsne2021], section 3.4.1.1, after Trask: 0.079433 D⁻², which keeps its value in any
/// unit of length. Its text has the law for craters below 100 m on all of the Moon but its youngest
/// surfaces, as an upper limit.
pub const EQUILIBRIUM: f64 = 0.079_433;

/// A class of craters of one look.
struct Class {
    /// Share of all craters [-].
    share: f64,
    /// Depth over diameter, of the shallowest and of the deepest [-].
    depth: [f64; 2],
}

/// Craters by how worn they are, the freshest first. Source: [Dsne2021], table 3.4.1.2-2, after
/// Basilevsky (1976). Its first range is open above, where ours ends with a fresh crater, and its
/// last is open below.
const CLASSES: [Class; 5] = [
    Class { share: 0.005, depth: [0.12, 0.2] },
    Class { share: 0.025, depth: [0.12, 0.2] },
    Class { share: 0.17, depth: [0.10, 0.15] },
    Class { share: 0.30, depth: [0.07, 0.10] },
    Class { share: 0.50, depth: [SHALLOWEST, 0.07] },
];

/// Number of craters of at least a diameter on an area.
///
/// * `share`: of the equilibrium [-]
/// * `diameter`, `area`: [m], [m²]
#[must_use]
pub fn expected_count(share: f64, diameter: f64, area: f64) -> f64 {
    share * EQUILIBRIUM * area / (diameter * diameter)
}

/// The craters with their centres on an area, from the largest down.
///
/// The number above each diameter is a Poisson process whose mean is [`expected_count`]: the
/// diameters are those at which that mean grows by an exponential step. So more of the small ones
/// leave the large ones where they are.
#[derive(Clone, Debug)]
pub(super) struct Population {
    random: Random,
    on: Extent,
    /// Expected number of craters of at least 1 m.
    above_1_m: f64,
    /// Expected number of craters of at least the size of the last one.
    expected: f64,
    deepest: f64,
}

impl Population {
    /// * `share`: of the equilibrium [-]
    /// * `largest`: upper limit of the diameter [m]
    /// * `deepest`: upper limit of depth over diameter [-]
    pub(super) fn new(random: Random, on: Extent, share: f64, largest: f64, deepest: f64) -> Self {
        let size = on.north_east - on.south_west;
        let area = size.x * size.y;
        let expected = expected_count(share, largest, area);
        Self { random, on, above_1_m: expected_count(share, 1.0, area), expected, deepest }
    }
}

impl Iterator for Population {
    type Item = AgedCrater;

    fn next(&mut self) -> Option<AgedCrater> {
        self.expected += self.random.exponential();
        let diameter = (self.above_1_m / self.expected).sqrt();
        let size = self.on.north_east - self.on.south_west;
        let place = Vec2::new(self.random.uniform(), self.random.uniform());
        let centre = self.on.south_west + place.component_mul(&size);
        let depth = depth_over_diameter(self.random.uniform(), self.random.uniform());
        Some(AgedCrater { centre, diameter, depth: diameter * depth.min(self.deepest) })
    }
}

/// Depth over diameter of a crater [-].
///
/// * `class`, `within`: two numbers from 0 to 1
fn depth_over_diameter(class: f64, within: f64) -> f64 {
    let mut left = class;
    let found = CLASSES.iter().find(|it| {
        left -= it.share;
        left < 0.0
    });
    let [shallow, deep] = found.unwrap_or(&CLASSES[CLASSES.len() - 1]).depth;
    shallow + within * (deep - shallow)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn population(seed: u64) -> impl Iterator<Item = AgedCrater> {
        let on = Extent { south_west: Vec2::zeros(), north_east: Vec2::new(1000.0, 500.0) };
        Population::new(Random::stream(seed, 1), on, 1.0, 100.0, 0.196)
    }

    /// The law that [`EQUILIBRIUM`] states, within three standard deviations of Poisson's
    /// distribution, at five sizes.
    #[test]
    fn as_many_craters_are_made_as_the_law_says() {
        for smallest in [50.0, 20.0, 10.0, 5.0, 2.0] {
            const SEEDS: u32 = 20;
            let area = f64::from(SEEDS) * 1000.0 * 500.0;
            let law = |diameter: f64| 0.079_433 * area / (diameter * diameter);
            let expected = law(smallest) - law(100.0);
            let of_seed = |seed: u32| {
                population(seed.into()).take_while(|it| it.diameter >= smallest).count() as f64
            };
            let count: f64 = (0..SEEDS).map(of_seed).sum();
            assert!((count - expected).abs() < 3.0 * expected.sqrt(), "{count}, not {expected}");
        }
    }

    /// Source: [Dsne2021], table 3.4.1.2-2: 0.5 % and 2.5 % are deeper than 0.12, half of all is
    /// below 0.07.
    #[test]
    fn craters_are_as_deep_as_the_classes_say() {
        const COUNT: usize = 20_000;
        let all: Vec<AgedCrater> = population(3).take(COUNT).collect();
        let share = |least: f64| {
            all.iter().filter(|it| it.depth / it.diameter > least).count() as f64 / COUNT as f64
        };
        // Of the third class, from 0.10 to 0.15, three fifths are deeper than 0.12.
        for (least, expected) in [(0.12, 0.03 + 0.17 * 0.6), (0.10, 0.2), (0.07, 0.5), (0.029, 1.0)]
        {
            // Three standard deviations of a share.
            let within = 3.0 * (expected * (1.0_f64 - expected) / COUNT as f64).sqrt() + 1e-9;
            assert!((share(least) - expected).abs() <= within, "{} above {least}", share(least));
        }
        assert!(all.iter().all(|it| it.depth <= 0.196 * it.diameter));
    }

    #[test]
    fn craters_come_from_the_largest_down() {
        let diameters: Vec<f64> = population(5).take(500).map(|it| it.diameter).collect();
        assert!(diameters[0] < 100.0 && diameters.is_sorted_by(|one, other| one > other));
    }
}
