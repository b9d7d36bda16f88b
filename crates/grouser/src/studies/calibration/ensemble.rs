//! An ensemble of walkers that sample a density: Goodman and Weare's stretch move (2010), mixed
//! with differential evolution (Nelson et al. 2013).
//!
//! The one place that knows the sampler's library. Walkers move by each other's differences, so
//! that it does not matter how the density is stretched or turned.

use std::ops::ControlFlow;

use hammer_and_sample::{
    DifferentialEvolution, Execution, Mixture, Model, Params, Schedule, Stretch, sample,
};
use rayon::prelude::*;

use crate::studies::random::{generator, standard_normal};

/// What a block of steps leaves.
pub(super) struct Walked {
    /// All positions, step by step, walker by walker.
    pub(super) chain: Vec<Vec<f64>>,
    /// How many of the proposed moves were made.
    pub(super) accepted: usize,
}

/// Shares of the moves: differential evolution mixes well in many dimensions, stretches get walkers
/// out of corners.
const SHARES: [u32; 2] = [1, 4];

/// This share of the difference of two walkers, over √(2 d), is the best step for a normal density
/// (ter Braak 2006).
const BEST_STEP: f64 = 2.38;

/// Random part of that share [-]: it keeps walkers from moving on a lattice.
const JITTER: f64 = 0.1;

/// Moves walkers by a number of steps.
///
/// * `streams`: one for each walker; no two walks may share one
pub(super) fn walk(
    log_density: &(dyn Fn(&[f64]) -> f64 + Sync),
    walkers: &[Vec<f64>],
    steps: usize,
    seed: u64,
    streams: impl Fn(usize) -> u64,
) -> Walked {
    let dimension = walkers.first().map_or(1, Vec::len) as f64;
    let evolution = DifferentialEvolution::new(BEST_STEP / (2.0 * dimension).sqrt(), JITTER);
    let moves = Mixture::from(((Stretch::default(), SHARES[0]), (evolution, SHARES[1])));
    let each = walkers.iter().enumerate();
    let starts = each.map(|(number, walker)| (walker.clone(), generator(seed, streams(number))));
    let density = Density { log_density };
    let (chain, accepted) = sample(&density, &moves, starts, Steps { left: steps }, InOrder);
    Walked { chain, accepted }
}

/// Independent normal numbers from a stream.
pub(super) fn normal_numbers(seed: u64, stream: u64, count: usize) -> Vec<f64> {
    let mut random = generator(seed, stream);
    (0..count).map(|_| standard_normal(&mut random)).collect()
}

struct Density<'a> {
    log_density: &'a (dyn Fn(&[f64]) -> f64 + Sync),
}

impl Model for Density<'_> {
    type Params = Vec<f64>;

    fn log_prob(&self, state: &Vec<f64>) -> f64 {
        (self.log_density)(state)
    }
}

/// A number of steps.
struct Steps {
    left: usize,
}

impl<P: Params> Schedule<P> for Steps {
    fn next_step(&mut self, _chain: &[P]) -> ControlFlow<()> {
        if self.left == 0 {
            return ControlFlow::Break(());
        }
        self.left -= 1;
        ControlFlow::Continue(())
    }
}

/// All walkers of a half move at once, each with random numbers of its own, and keep their order.
struct InOrder;

impl Execution for InOrder {
    fn extend_chain<P, W, U>(&self, chain: &mut Vec<P>, walkers: &mut [W], update: U)
    where
        P: Send + Sync,
        W: Send + Sync,
        U: Fn(&mut W) -> P + Send + Sync,
    {
        chain.par_extend(walkers.par_iter_mut().map(update));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 4000 draws: the mean errs by 0.016, the variance by 0.022 (one standard deviation each).
    #[test]
    fn normal_numbers_are_normal() {
        let numbers = normal_numbers(7, 3, 4000);
        let mean = numbers.iter().sum::<f64>() / 4000.0;
        let variance = numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 3999.0;
        assert!(mean.abs() < 0.06 && (variance - 1.0).abs() < 0.09, "{mean}, {variance}");
    }
}
