//! What is believed of a soil under one wheel–soil model, stretch by stretch.

use nalgebra::DVector;

use super::archive::Archive;
use super::gaussian::{Gaussian, Line, Surprise};
use super::information;
use super::motion::{Expected, NotUsed, SeenMotion, halves};
use super::noise::ModelNoise;
use super::unknowns::{Draw, LearntSample, Unknowns};
use crate::elementary::exp;
use crate::elementary::wide::ln;
use crate::studies::heading::HeadingStudy;
use grouser_io::statistics::NothingAccepted;

/// The belief under one model.
#[derive(Clone, Debug)]
pub(super) struct Filter {
    pub(super) unknowns: Unknowns,
    pub(super) belief: Gaussian,
}

/// How soils differ along the way, and what an observation may do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wandering {
    /// The way over which the soil forgets what it was [m]: 5 % for the root of a metre, of what is known to 50 %.
    pub way: f64,
}

impl Wandering {
    /// Source: ours, after 5 % a metre.
    pub const USUAL: Self = Self { way: 200.0 };
}

/// Lines that are fitted at most: the first over what was believed beforehand.
const ROUNDS: usize = 4;
/// A step this short ends them, in standard deviations of what is believed afterwards [-].
const CLOSE: f64 = 0.3;
/// What is farther from what was expected than this pulls no more than from there, in standard deviations [-] (Huber
/// 1964): an outlier that got through.
const FARTHEST: f64 = 3.0;

impl Filter {
    pub(super) fn new(unknowns: Unknowns) -> Self {
        let belief = Gaussian::standard(unknowns.count());
        Self { unknowns, belief }
    }

    /// Forgets all that was learnt.
    pub(super) fn forget(&mut self) {
        self.belief = Gaussian::standard(self.unknowns.count());
    }

    /// That the rover went on over soil that changes.
    ///
    /// * `way`: of the rims [m]
    pub(super) fn wander(&mut self, way: f64, wandering: Wandering) {
        let kept = exp(-way / wandering.way);
        let of_soil = self.unknowns.of_soil();
        let kept =
            DVector::from_fn(
                self.unknowns.count(),
                |place, _| {
                    if place < of_soil { kept } else { 1.0 }
                },
            );
        self.belief.forget(&kept);
    }

    /// The line of a motion over the width of a belief.
    pub(super) fn line(
        &self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        noise: &ModelNoise,
        over: &Gaussian,
    ) -> Option<Line> {
        let expected = |at: &DVector<f64>, near: Option<&Expected>| {
            motion.expected(study, &self.unknowns.sample(at.as_slice())?, near)
        };
        let here = expected(&over.mean, None)?;
        let numbers = |at: &DVector<f64>| Some(expected(at, Some(&here))?.numbers);
        let mut line = Line::over(over, &here.numbers, numbers);
        line.noise += motion.noise(study, &here, noise);
        Some(line)
    }

    /// The mean slip ratio that is expected of a motion on another slope [rad], with the soil that is believed most.
    pub(super) fn expected_slip(
        &self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        slope: f64,
    ) -> Option<f64> {
        let sample = self.unknowns.sample(self.belief.mean.as_slice())?;
        let there = motion.on_slope(slope);
        there.expected(study, &sample, None).map(|it| there.slip_of(&it))
    }

    /// How much is known, but for a constant [nat]: −½ ln det P.
    pub(super) fn knowledge(&self) -> f64 {
        -self.belief.root().diagonal().iter().map(|it| ln(*it)).sum::<f64>()
    }

    /// Learns from a motion; how surprising it was, and how much each of its numbers taught [nat].
    pub(super) fn learn(
        &mut self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        noise: &ModelNoise,
    ) -> Result<(Surprise, Vec<f64>), NotUsed> {
        let (seen, belief) = (motion.seen(study), &self.belief);
        let first = self.line(study, motion, noise, belief).ok_or(NotUsed::NotCarried)?;
        let surprise = belief.surprise(&first, &seen).ok_or(NotUsed::NotCarried)?;
        let robust = |line| robust(line, &surprise);
        let mut used = robust(first);
        let mut after = belief.after(&used, &seen).ok_or(NotUsed::NotCarried)?;
        let mut before = belief.mean.clone();
        for _ in 1..ROUNDS {
            if after.distance(&before) < CLOSE {
                break;
            }
            before = after.mean.clone();
            let line = self.line(study, motion, noise, &after).map(robust);
            let next = line.and_then(|line| Some((belief.after(&line, &seen)?, line)));
            let Some(next) = next else { break };
            (after, used) = next;
        }
        let taught = information::by_number(&self.belief, &used);
        self.belief = after;
        Ok((surprise, taught))
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { unknowns: _, belief } = self;
        belief.walk(archive);
    }

    /// Whether its belief is of as many numbers as there are unknowns.
    pub(super) fn is_whole(&self) -> bool {
        self.belief.is_of(self.unknowns.count())
    }

    /// The values of the soil's uncertain keys in sample number `index` of what was believed beforehand.
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub(super) fn values_before(&self, seed: u64, index: u64) -> Result<Vec<f64>, NothingAccepted> {
        let draw = self.unknowns.draw(seed, index)?;
        let own = self.unknowns.moved(&draw, &draw.coordinates);
        own.map(|(values, _)| values).ok_or(NothingAccepted { index, tries: 1 })
    }

    /// Sample number `index` of what is believed: that of what was believed beforehand, moved as mean and covariance
    /// moved. A soil that cannot be is moved half as far, and so on.
    pub(super) fn sample(&self, seed: u64, index: u64) -> Result<LearntSample, NothingAccepted> {
        let draw = self.unknowns.draw(seed, index)?;
        let moved = self.unknowns.moved(&draw, self.place(&draw).as_slice());
        let (values, sample) = moved.ok_or(NothingAccepted { index, tries: 1 })?;
        Ok(LearntSample { sample, values })
    }

    /// Where a sample of what was believed beforehand lies in what is believed now.
    pub(super) fn place(&self, draw: &Draw) -> DVector<f64> {
        const HALVINGS: usize = 8;
        let before = DVector::from_column_slice(&draw.coordinates);
        let after = &self.belief.mean + self.belief.root() * &before;
        let mut places = halves(HALVINGS).map(|share| &before + (&after - &before) * share);
        places.find(|at| self.unknowns.moved(draw, at.as_slice()).is_some()).unwrap_or(before)
    }
}

/// A line each of whose numbers pulls no more than one that is [`FARTHEST`] off.
fn robust(mut line: Line, surprise: &Surprise) -> Line {
    for (place, score) in surprise.scores.iter().enumerate() {
        let beyond = (score.abs() / FARTHEST).max(1.0);
        line.noise.row_mut(place).scale_mut(beyond);
        line.noise.column_mut(place).scale_mut(beyond);
    }
    line
}
