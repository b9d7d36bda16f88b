//! What is believed of a soil under one wheel–soil model, stretch by stretch.

use nalgebra::{DMatrix, DVector, Vector3};

use super::archive::Archive;
use super::fitted::Fitted;
use super::gaussian::{Gaussian, Line, Surprise};
use super::information;
use super::motion::{Expected, NotUsed, SeenMotion, Variances, halves};
use super::noise::ModelNoise;
use super::passed::Passed;
use super::unexplained::Push;
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

/// What a filter made of a motion.
#[derive(Clone, Debug)]
pub(super) struct Taken {
    /// How surprising it was.
    pub(super) surprise: Surprise,
    /// How much each of its numbers taught [nat].
    pub(super) by_number: Vec<f64>,
    /// The motion beside what was believed before it.
    pub(super) passed: Passed,
    /// The force that would explain it, if the soil is as it was believed to be.
    pub(super) push: Option<Push>,
}

/// How soils differ along the way, and what an observation may do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wandering {
    /// The way over which the soil forgets what it was [m]: 5 % for the root of a metre, of what is
    /// known to 50 %.
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
/// What is farther from what was expected than this pulls no more than from there, in standard
/// deviations [-] (Huber 1964): an outlier that got through.
const FARTHEST: f64 = 3.0;

/// A force that no ground has to spare, over the weight [-].
const STRONGEST: f64 = 0.3;

impl Filter {
    pub(super) fn new(unknowns: Unknowns) -> Self {
        let belief = Gaussian::standard(unknowns.count());
        Self { unknowns, belief }
    }

    /// Forgets all that was learnt.
    pub(super) fn forget(&mut self) {
        self.belief = Gaussian::standard(self.unknowns.count());
    }

    /// Widens the belief by what the soil may have changed over a way.
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
    ) -> Option<Fitted> {
        let sample = self.unknowns.sample(over.mean.as_slice())?;
        let here = motion.expected(study, &sample, None)?;
        let numbers = |at: &DVector<f64>| {
            let sample = self.unknowns.sample(at.as_slice())?;
            Some(motion.expected(study, &sample, Some(&here))?.numbers)
        };
        let mut line = Line::over(over, &here.numbers, numbers);
        let unexplained = motion.unexplained(study, &sample, &here, noise);
        let Variances { own, of_patch } = motion.variances(study, &here, noise);
        let of_patch = unexplained.covariance + DMatrix::from_diagonal(&of_patch);
        line.value += unexplained.shift;
        line.noise += &of_patch * noise.together(motion.way());
        line.noise += DMatrix::from_diagonal(&own);
        let motion_by_force = unexplained.motion_by_force;
        Some(Fitted { line, of_patch, own, motion_by_force })
    }

    /// What is expected of a motion, with the soil that is believed most.
    pub(super) fn expected(&self, study: &HeadingStudy, motion: &SeenMotion) -> Option<Expected> {
        let sample = self.unknowns.sample(self.belief.mean.as_slice())?;
        motion.expected(study, &sample, None)
    }

    /// The mean slip ratio that is expected of a motion on another slope [rad].
    pub(super) fn expected_slip(
        &self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        slope: f64,
    ) -> Option<f64> {
        let there = motion.on_slope(slope);
        let expected = self.expected(study, &there)?;
        Some(there.expected_slip_and_drift(&expected)[0])
    }

    /// The force against the way, over the weight, under which the wheels' mean slip ratio is
    /// `deep` [-], with the soil that is believed most; nothing where it is more than
    /// [`STRONGEST`].
    pub(super) fn holds_against(
        &self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        deep: f64,
    ) -> Option<f64> {
        let sample = self.unknowns.sample(self.belief.mean.as_slice())?;
        let is_deep = |force: f64| {
            let force = Vector3::new(motion.against() * force, 0.0, 0.0);
            let found = motion.expected_under(study, &sample, None, force);
            found.is_none_or(|it| motion.expected_slip_and_drift(&it)[0] >= deep)
        };
        last_before(is_deep, 0.0, STRONGEST)
    }

    /// How much is known, but for a constant [nat]: −½ ln det P.
    pub(super) fn knowledge(&self) -> f64 {
        -self.belief.root().diagonal().iter().map(|it| ln(*it)).sum::<f64>()
    }

    /// Learns from a motion.
    pub(super) fn learn(
        &mut self,
        study: &HeadingStudy,
        motion: &SeenMotion,
        noise: &ModelNoise,
    ) -> Result<Taken, NotUsed> {
        let (seen, belief) = (motion.seen(study), &self.belief);
        let first = self.line(study, motion, noise, belief).ok_or(NotUsed::NotCarried)?;
        let surprise = belief.surprise(&first.line, &seen).ok_or(NotUsed::NotCarried)?;
        let push = Push::of(motion, &first, belief, &seen);
        let robust = |line| robust(line, &surprise);
        let mut used = robust(first.line.clone());
        let mut after = belief.after(&used, &seen).ok_or(NotUsed::NotCarried)?;
        let mut before = belief.mean.clone();
        for _ in 1..ROUNDS {
            if after.distance(&before) < CLOSE {
                break;
            }
            before = after.mean.clone();
            let line = self.line(study, motion, noise, &after).map(|it| robust(it.line));
            let next = line.and_then(|line| Some((belief.after(&line, &seen)?, line)));
            let Some(next) = next else { break };
            (after, used) = next;
        }
        let by_number = information::by_number(&self.belief, &used);
        let passed = first.passed(motion, belief.clone(), seen);
        self.belief = after;
        Ok(Taken { surprise, by_number, passed, push })
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { unknowns: _, belief } = self;
        belief.walk(archive);
    }

    /// Whether its belief is of as many numbers as there are unknowns.
    pub(super) fn is_whole(&self) -> bool {
        self.belief.is_of(self.unknowns.count())
    }

    /// The values of the soil's uncertain keys in sample number `index` of what was believed
    /// beforehand.
    ///
    /// # Errors
    /// [`NothingAccepted`] if no soil can be drawn.
    pub(super) fn values_before(&self, seed: u64, index: u64) -> Result<Vec<f64>, NothingAccepted> {
        let draw = self.unknowns.draw(seed, index)?;
        let own = self.unknowns.moved(&draw, &draw.coordinates);
        own.map(|(values, _)| values).ok_or(NothingAccepted { index, tries: 1 })
    }

    /// Sample number `index` of what is believed: that of what was believed beforehand, moved as
    /// mean and covariance moved. A soil that cannot be is moved half as far, and so on.
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

/// The last place of a range before something is so, by halving; nothing where it is not so at its
/// end.
pub(super) fn last_before(is_so: impl Fn(f64) -> bool, mut low: f64, mut high: f64) -> Option<f64> {
    const ROUNDS: usize = 6;
    if !is_so(high) {
        return None;
    }
    for _ in 0..ROUNDS {
        let middle = 0.5 * (low + high);
        if is_so(middle) { high = middle } else { low = middle }
    }
    Some(low)
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
