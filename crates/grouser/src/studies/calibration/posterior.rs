//! Samples of the posterior distribution of the parameters.
//!
//! Several ensembles of walkers sample the posterior, each on its own, so that their agreement can
//! be asked for. They walk in blocks of steps. A walker's random numbers of a block come from a
//! stream of their own, (seed; ensemble, block, walker), and nothing else is remembered: a
//! [`PosteriorState`] that was kept after some blocks goes on as if it had never stopped, to the
//! last bit.

use std::ops::ControlFlow;

use nalgebra::{Cholesky, DVector};
use rayon::prelude::*;

use super::fit::Fit;
use super::{Calibration, CalibrationError, ensemble};

/// Settings of the sampler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerSettings {
    /// Seed of all random numbers.
    pub seed: u64,
    /// Independent ensembles.
    pub ensembles: usize,
    /// Walkers of each; at least twice the number of parameters and discrepancies, and even.
    /// Too small a number is raised to that.
    pub walkers: usize,
    /// Blocks in all.
    pub blocks: u64,
    /// Steps of a block.
    pub steps_per_block: usize,
    /// Number of steps of which one is kept, the last of each such group.
    pub keep_every: usize,
}

impl Default for SamplerSettings {
    /// Enough for about twenty parameters.
    fn default() -> Self {
        Self { seed: 0, ensembles: 4, walkers: 48, blocks: 40, steps_per_block: 25, keep_every: 5 }
    }
}

impl SamplerSettings {
    /// Walkers of each ensemble for a number of coordinates.
    #[must_use]
    pub fn walkers_for(&self, dimension: usize) -> usize {
        self.walkers.max(2 * dimension + 2).next_multiple_of(2)
    }

    /// Steps kept of each block.
    fn kept_per_block(&self) -> usize {
        self.steps_per_block / self.keep_every.max(1)
    }
}

/// The state of a sampler between two blocks: plain numbers, which `document` can write to a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PosteriorState {
    /// Blocks that were walked.
    pub blocks: u64,
    /// The ensembles.
    pub ensembles: Vec<Ensemble>,
}

/// One ensemble of walkers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ensemble {
    /// Where the walkers are, in coordinates: the parameters', then the discrepancies'.
    pub walkers: Vec<Vec<f64>>,
    /// Where they were at the steps that were kept: step by step, walker by walker.
    pub chain: Vec<Vec<f64>>,
    /// Moves that were made.
    pub accepted: u64,
    /// Moves that were proposed.
    pub proposed: u64,
}

/// The end of a number of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Advanced {
    /// All blocks were walked.
    Done,
    /// The observer stopped after one of them.
    Stopped,
}

/// Streams of an ensemble, a block and a walker: 8, 36 and 20 bits. Block 0 is the start.
fn stream(ensemble: usize, block: u64, walker: usize) -> u64 {
    (ensemble as u64) << 56 | (block & 0xF_FFFF_FFFF) << 20 | (walker as u64 & 0xF_FFFF)
}

impl Calibration<'_> {
    /// Walkers around a fit, spread as its covariance says.
    #[must_use]
    pub fn start_posterior(&self, fit: &Fit, settings: &SamplerSettings) -> PosteriorState {
        let (mode, covariance) = self.mode_near(fit);
        let parameters = mode.len();
        let spread = covariance.cholesky().map(Cholesky::unpack);
        let centres = self.discrepancies.parameters().iter().zip(&fit.discrepancies);
        let discrepancies: Vec<f64> = centres
            .map(|(parameter, &value)| {
                super::Parameter { start: value, ..parameter.clone() }.start_coordinate()
            })
            .collect();
        let walker = |ensemble: usize, walker: usize| {
            let stream = stream(ensemble, 0, walker);
            let numbers = ensemble::normal_numbers(settings.seed, stream, self.dimension());
            let (ours, theirs) = numbers.split_at(parameters);
            let normal = DVector::from_column_slice(ours);
            let away = spread.as_ref().map_or_else(|| normal.clone(), |factor| factor * &normal);
            let parameters = mode.iter().zip(away.iter()).map(|(mode, away)| mode + away);
            let discrepancies = discrepancies
                .iter()
                .zip(theirs)
                .map(|(&centre, number)| nearer_to_the_middle(centre) + START_SPREAD * number);
            parameters.map(nearer_to_the_middle).chain(discrepancies).collect()
        };
        let walkers = settings.walkers_for(self.dimension());
        let ensemble = |number| Ensemble {
            walkers: (0..walkers).map(|index| walker(number, index)).collect(),
            ..Ensemble::default()
        };
        PosteriorState {
            blocks: 0,
            ensembles: (0..settings.ensembles.max(1)).map(ensemble).collect(),
        }
    }

    /// Walks until [`SamplerSettings::blocks`] blocks were walked in all.
    ///
    /// * `observer`: gets the state after each block; it can stop there. A state that is kept
    ///   then, or at any other block, can be advanced later.
    ///
    /// # Errors
    /// [`CalibrationError::ForeignState`] if the state belongs to another problem.
    pub fn advance(
        &self,
        state: &mut PosteriorState,
        settings: &SamplerSettings,
        observer: &mut dyn FnMut(&PosteriorState) -> ControlFlow<()>,
    ) -> Result<Advanced, CalibrationError> {
        self.check_state(state, settings)?;
        while state.blocks < settings.blocks {
            let block = state.blocks + 1;
            let numbered = state.ensembles.par_iter_mut().enumerate();
            numbered.for_each(|(number, ensemble)| {
                self.walk_block(number, ensemble, block, settings);
            });
            state.blocks = block;
            if observer(state).is_break() {
                return Ok(Advanced::Stopped);
            }
        }
        Ok(Advanced::Done)
    }

    fn walk_block(
        &self,
        number: usize,
        ensemble: &mut Ensemble,
        block: u64,
        settings: &SamplerSettings,
    ) {
        let steps = settings.steps_per_block;
        let walkers = ensemble.walkers.len();
        let log_density = |coordinates: &[f64]| self.log_posterior(coordinates);
        let streams = |walker| stream(number, block, walker);
        let walked = ensemble::walk(&log_density, &ensemble.walkers, steps, settings.seed, streams);
        ensemble.accepted += walked.accepted as u64;
        ensemble.proposed += (steps * walkers) as u64;
        let every = settings.keep_every.max(1);
        for (step, places) in walked.chain.chunks(walkers).enumerate() {
            if (step + 1) % every == 0 {
                ensemble.chain.extend_from_slice(places);
            }
            if step + 1 == steps {
                ensemble.walkers = places.to_vec();
            }
        }
    }

    fn check_state(
        &self,
        state: &PosteriorState,
        settings: &SamplerSettings,
    ) -> Result<(), CalibrationError> {
        let foreign = |what: String| Err(CalibrationError::ForeignState { what });
        let (dimension, walkers) = (self.dimension(), settings.walkers_for(self.dimension()));
        if state.ensembles.len() != settings.ensembles.max(1) {
            let (found, asked) = (state.ensembles.len(), settings.ensembles);
            return foreign(format!("it has {found} ensembles, not {asked}"));
        }
        let per_block = (settings.kept_per_block() * walkers) as u64;
        for ensemble in &state.ensembles {
            if ensemble.walkers.len() != walkers {
                let found = ensemble.walkers.len();
                return foreign(format!("an ensemble has {found} walkers, not {walkers}"));
            }
            let (found, kept) = (ensemble.chain.len(), state.blocks.saturating_mul(per_block));
            if found as u64 != kept {
                return foreign(format!("an ensemble kept {found} places, not {kept}"));
            }
            let places = || ensemble.walkers.iter().chain(&ensemble.chain);
            if let Some(place) = places().find(|place| place.len() != dimension) {
                let found = place.len();
                return foreign(format!("a walker has {found} coordinates, not {dimension}"));
            }
            if places().flatten().any(|coordinate| !coordinate.is_finite()) {
                return foreign("a coordinate is not finite".into());
            }
        }
        Ok(())
    }

    /// The values of the parameters, and then of the discrepancies, at a place of a chain.
    #[must_use]
    pub fn values_at(&self, coordinates: &[f64]) -> Vec<f64> {
        let (parameters, discrepancies) = coordinates.split_at(self.space.len());
        let mut values = self.space.values(parameters);
        values.extend(self.discrepancies.values(discrepancies));
        values
    }
}

/// Walkers start no further out than this [-]: 98 % of the prior lie within.
const FURTHEST_START: f64 = 4.6;

/// Spread of the discrepancies' starts, in coordinates [-].
const START_SPREAD: f64 = 0.2;

/// A fit may run into a bound, where the coordinate has no end.
fn nearer_to_the_middle(coordinate: f64) -> f64 {
    // Folded, not cut off: walkers in one plane would never leave it.
    if coordinate.abs() <= FURTHEST_START {
        coordinate
    } else {
        let beyond = (coordinate.abs() - FURTHEST_START) % FURTHEST_START;
        (FURTHEST_START - beyond).copysign(coordinate)
    }
}

impl PosteriorState {
    /// The part of each chain that counts: without the first share of it, in which the walkers
    /// still knew where they had started.
    ///
    /// * `discarded`: share of the steps that does not count [-]
    #[must_use]
    pub fn settled_chains(&self, discarded: f64) -> Vec<Chain<'_>> {
        let mut chains = Vec::new();
        for ensemble in &self.ensembles {
            let walkers = ensemble.walkers.len().max(1);
            let steps = ensemble.chain.len() / walkers;
            let first = share_of(steps, discarded) * walkers;
            chains.push(Chain { places: &ensemble.chain[first..], walkers });
        }
        chains
    }

    /// Share of the proposed moves that were made [-].
    #[must_use]
    pub fn acceptance(&self) -> f64 {
        let accepted: u64 = self.ensembles.iter().map(|ensemble| ensemble.accepted).sum();
        let proposed: u64 = self.ensembles.iter().map(|ensemble| ensemble.proposed).sum();
        accepted as f64 / proposed.max(1) as f64
    }
}

/// A share of a count, its whole part.
///
/// * `share`: 0 to 1
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Clamped; the whole part is asked for.
pub(super) fn share_of(count: usize, share: f64) -> usize {
    (count as f64 * share.clamp(0.0, 1.0)) as usize
}

/// The places of an ensemble: step by step, walker by walker.
#[derive(Clone, Copy, Debug)]
pub struct Chain<'a> {
    /// The places.
    pub places: &'a [Vec<f64>],
    /// How many of them make a step.
    pub walkers: usize,
}
