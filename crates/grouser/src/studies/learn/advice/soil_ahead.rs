//! The soil on the way ahead: it begins as one of those that are believed possible, wanders, and at
//! times is another.

use rand_chacha::ChaCha8Rng;

use super::super::bank::Bank;
use super::super::settings::LearnSettings;
use super::super::unknowns::{Draw, Unknowns};
use crate::elementary::exp;
use crate::elementary::wide::ln;
use crate::studies::ensemble::samples::Sample;
use crate::studies::random;
use grouser_io::statistics::NothingAccepted;

/// How the soil differs along the way ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SoilAhead {
    /// The way on which it is another once on the mean [m], drawn from what was believed before the
    /// drive; `None` where it never is at once. Between two changes it wanders as
    /// [`Wandering`](super::super::Wandering) says.
    pub change_way: Option<f64>,
}

impl SoilAhead {
    /// Source: ours, assumed: once on the way over which soils that wander forget what they were.
    pub const USUAL: Self = Self { change_way: Some(200.0) };
}

/// One realisation of the soil along a way, which depends on the seed and its number alone.
pub(super) struct SoilWay<'a> {
    unknowns: &'a Unknowns,
    ahead: SoilAhead,
    wandering_way: f64,
    draw: Draw,
    coordinates: Vec<f64>,
    sample: Sample,
    random: ChaCha8Rng,
    /// Way to the next change [m].
    to_change: f64,
    seed: u64,
    index: u64,
    changes: u64,
}

/// Seeds of what happens ahead differ by this from those of the soil at the start, and of one
/// change from those of the next.
const AHEAD: u64 = 0x5011_A4EA_D000_0000;

impl<'a> SoilWay<'a> {
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub(super) fn new(
        (bank, settings): (&'a Bank, &LearnSettings),
        ahead: SoilAhead,
        (seed, index): (u64, u64),
    ) -> Result<Self, NothingAccepted> {
        let filter = bank.of_model(&bank.models(settings).model(seed, index));
        let unknowns = &filter.unknowns;
        let draw = unknowns.draw(seed, index)?;
        let coordinates = filter.place(&draw).as_slice().to_vec();
        let moved = unknowns.moved(&draw, &coordinates);
        let (_, sample) = moved.ok_or(NothingAccepted { index, tries: 1 })?;
        let mut random = random::generator(seed ^ AHEAD, index);
        let to_change = way_to_change(ahead, &mut random);
        let wandering_way = settings.wandering.way;
        let changes = 0;
        Ok(Self {
            unknowns,
            ahead,
            wandering_way,
            draw,
            coordinates,
            sample,
            random,
            to_change,
            seed,
            index,
            changes,
        })
    }

    /// The soil here.
    pub(super) fn sample(&self) -> &Sample {
        &self.sample
    }

    /// Goes on over the ground [m].
    ///
    /// # Errors
    /// [`NothingAccepted`] if another soil cannot be drawn.
    pub(super) fn advance(&mut self, way: f64) -> Result<(), NothingAccepted> {
        self.to_change -= way;
        if self.to_change <= 0.0 {
            self.to_change = way_to_change(self.ahead, &mut self.random);
            return self.change();
        }
        let kept = exp(-way / self.wandering_way);
        let new = (1.0 - kept * kept).sqrt();
        let of_soil = self.unknowns.of_soil();
        let mut there = self.coordinates.clone();
        for at in &mut there[..of_soil] {
            *at = kept * *at + new * random::standard_normal(&mut self.random);
        }
        // Where there is no such soil it stays what it was.
        if let Some((_, sample)) = self.unknowns.moved(&self.draw, &there) {
            (self.coordinates, self.sample) = (there, sample);
        }
        Ok(())
    }

    /// Another soil begins: as good as any that was possible before the drive.
    fn change(&mut self) -> Result<(), NothingAccepted> {
        self.changes += 1;
        let seed = self.seed ^ AHEAD.wrapping_add(self.changes);
        self.draw = self.unknowns.draw(seed, self.index)?;
        self.coordinates.clone_from(&self.draw.coordinates);
        if let Some((_, sample)) = self.unknowns.moved(&self.draw, &self.coordinates) {
            self.sample = sample;
        }
        Ok(())
    }
}

/// Changes come as often on every metre.
fn way_to_change(ahead: SoilAhead, random: &mut ChaCha8Rng) -> f64 {
    let share = 1.0 - random::uniform(random);
    ahead.change_way.map_or(f64::INFINITY, |way| -way * ln(share))
}
