//! A problem of design over the numbers of one rover: what a point of the unit cube measures, by how
//! much it misses the limits, and their derivatives.

use grouser_io::design::Measure;
use grouser_io::design_task::{DesignTask, RoverChoice};
use grouser_io::statistics::NothingAccepted;
use grouser_io::statistics::normal::normal_score;
use rayon::prelude::*;

use super::answer::BestDesign;
use super::limits::{DesignLimit, LimitSide, size};
use super::measured::{self, MeasuredGround, Measures};
use super::slsqp::{Effort, Smooth};
use crate::difference::{Derivative, StepLengths, Variable, derivatives};
use crate::soil::Span;

/// Asked before each design that is measured, from any thread, whether to go on.
pub type GoOn<'a> = &'a (dyn Fn() -> bool + Sync);

/// What a search is for.
#[derive(Clone, Copy)]
pub(super) struct Sought<'a> {
    /// The weights of the aim, each over one in its unit.
    pub(super) weights: &'a [f64],
    /// A limit beside those that are stated.
    pub(super) extra: Option<DesignLimit>,
    /// A design that may lie near the least.
    pub(super) near: Option<&'a BestDesign>,
    pub(super) go_on: GoOn<'a>,
}

/// What a rover measures with other numbers, what is to be least of it, and its limits.
pub(super) struct DesignProblem<'a> {
    pub(super) task: &'a DesignTask,
    pub(super) seed: u64,
    pub(super) place: usize,
    pub(super) candidate: &'a RoverChoice,
    pub(super) sought: &'a Sought<'a>,
    /// What the aim is counted in.
    pub(super) aim_size: f64,
    pub(super) limits: Vec<DesignLimit>,
    /// How many of them the task has.
    pub(super) stated: usize,
    /// How many standard deviations each limit keeps off its bound.
    pub(super) scores: Vec<f64>,
    pub(super) grounds: Vec<MeasuredGround>,
}

/// The mean of a measure over samples, and its standard deviation.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    pub(super) mean: f64,
    pub(super) deviation: f64,
}

/// A measure of each sample of a ground.
pub(super) fn each(samples: &[Measures], measure: Measure) -> impl Iterator<Item = f64> + Clone {
    samples.iter().map(move |it| it[measure.place()])
}

impl Moments {
    pub(super) fn of(samples: &[Measures], measure: Measure) -> Self {
        let values = each(samples, measure);
        let count = values.clone().count() as f64;
        let mean = values.clone().sum::<f64>() / count;
        let variance = values.map(|it| (it - mean).powi(2)).sum::<f64>() / count;
        Self { mean, deviation: variance.sqrt() }
    }
}

impl<'a> DesignProblem<'a> {
    /// How many soils are drawn for a search.
    pub(super) const SAMPLES: u32 = 40;
    /// How many are drawn in the end.
    pub(super) const FRESH_SAMPLES: u32 = 200;

    /// * `is_nominal`: whether soils are taken as their documents have them
    pub(super) fn of(
        task: &'a DesignTask,
        seed: u64,
        place: usize,
        sought: &'a Sought<'a>,
        is_nominal: bool,
    ) -> Result<Self, NothingAccepted> {
        let candidate = &task.candidates[place];
        let grounds = candidate.grounds.iter().map(|there| {
            if is_nominal {
                return Ok(MeasuredGround::nominal(there));
            }
            MeasuredGround::drawn(there, seed, Self::SAMPLES)
        });
        let grounds = grounds.collect::<Result<Vec<MeasuredGround>, NothingAccepted>>()?;
        let sizes = Measure::ALL.into_iter().zip(sought.weights);
        let aim_size = sizes.map(|(measure, weight)| weight.abs() * size(measure)).sum();
        let own = limits_of(task, candidate);
        let stated = own.len();
        let limits: Vec<DesignLimit> = own.into_iter().chain(sought.extra).collect();
        let score = |limit: &DesignLimit| {
            let is_uncertain = grounds[limit.ground].is_uncertain();
            if is_uncertain { normal_score(task.probability) } else { 0.0 }
        };
        // What is traded is bounded by its mean.
        let scores = limits[..stated].iter().map(score).chain(sought.extra.map(|_| 0.0)).collect();
        Ok(Self { task, seed, place, candidate, sought, aim_size, limits, stated, scores, grounds })
    }

    /// Whether each design is measured by samples.
    pub(super) fn is_sampled(&self) -> bool {
        self.grounds.iter().any(MeasuredGround::is_uncertain)
    }

    pub(super) fn effort(&self) -> Effort {
        if self.is_sampled() { Effort::SAMPLED } else { Effort::SMOOTH }
    }

    /// The point of the unit cube that has some free numbers, or the next to them.
    pub(super) fn point(&self, values: &[f64]) -> Vec<f64> {
        let ends = self.task.free.iter().map(|(_, ends)| ends);
        let share = |(value, [least, most]): (&f64, &[f64; 2])| (value - least) / (most - least);
        values.iter().zip(ends).map(share).map(|share| share.clamp(0.0, 1.0)).collect()
    }

    /// The free numbers at a point of the unit cube, in their keys' units.
    pub(super) fn values(&self, point: &[f64]) -> Vec<f64> {
        let pairs = self.task.free.iter().zip(point);
        pairs.map(|((_, [least, most]), share)| least + share * (most - least)).collect()
    }

    /// What every sample measures on every ground; nothing where the numbers are no rover, or where too
    /// few samples move.
    pub(super) fn measured(&self, point: &[f64]) -> Option<Vec<Vec<Measures>>> {
        if !(self.sought.go_on)() {
            return None;
        }
        let values = self.values(point);
        let numbers = measured::numbers(self.task, self.candidate, &values)?;
        let of_ground = |ground: &MeasuredGround| {
            let all: Vec<Measures> = ground.measures(&numbers).into_iter().flatten().collect();
            let enough = all.len() as f64 >= self.task.probability * ground.count() as f64;
            (enough && !all.is_empty()).then_some(all)
        };
        self.grounds.iter().map(of_ground).collect()
    }

    /// The aim, over its size.
    pub(super) fn aim(&self, measured: &[Vec<Measures>]) -> f64 {
        let of = |measure: Measure| measure.unit().from_si(Moments::of(&measured[0], measure).mean);
        let weights =
            Measure::ALL.into_iter().zip(self.sought.weights).filter(|(_, it)| **it != 0.0);
        weights.map(|(measure, weight)| weight * of(measure)).sum::<f64>() / self.aim_size
    }

    /// What a limit is on: a measure's mean, and so many deviations from it.
    pub(super) fn limited(&self, limit: usize, measured: &[Vec<Measures>]) -> f64 {
        let (limit, score) = (&self.limits[limit], self.scores[limit]);
        let Moments { mean, deviation } = Moments::of(&measured[limit.ground], limit.measure);
        mean + limit.side.sign() * score * deviation
    }

    pub(super) fn excesses(&self, measured: &[Vec<Measures>]) -> Vec<f64> {
        let of = |place: usize| self.limits[place].excess(self.limited(place, measured));
        (0..self.limits.len()).map(of).collect()
    }

    /// Aim and limits of a design.
    pub(super) fn outcome(&self, point: &[f64]) -> Option<Vec<f64>> {
        let measured = self.measured(point)?;
        let aim = self.aim(&measured);
        Some(std::iter::once(aim).chain(self.excesses(&measured)).collect())
    }
}

/// The limits on every ground; that the slope is crossed is one, unless a stricter one is stated.
fn limits_of(task: &DesignTask, candidate: &RoverChoice) -> Vec<DesignLimit> {
    let of_ground = |(ground, slope): (usize, f64)| {
        let both = Measure::ALL.into_iter().zip(task.limits).flat_map(move |(measure, ends)| {
            let least = match measure {
                Measure::LimitSlope if slope > 0.0 => ends.least.max(slope),
                _ => ends.least,
            };
            let of = |side, bound| DesignLimit { ground, measure, side, bound };
            [of(LimitSide::AtLeast, least), of(LimitSide::AtMost, ends.most)]
        });
        // What no ground changes is limited once.
        both.filter(move |it| it.bound.is_finite() && (ground == 0 || !it.measure.is_of_rover()))
    };
    let slopes = candidate.grounds.iter().map(|there| there.slope);
    slopes.enumerate().flat_map(of_ground).collect()
}

impl DesignProblem<'_> {
    /// Derivatives by each free number, to one side: means over samples have kinks everywhere, of
    /// which none counts for much.
    fn differences(&self, point: &[f64], here: &[f64]) -> Option<Vec<Vec<f64>>> {
        /// The step, over the bounds [-].
        const STEP: f64 = 1e-4;
        let by = |axis: usize| -> Option<Vec<f64>> {
            let step = if point[axis] + STEP > 1.0 { -STEP } else { STEP };
            let mut moved = point.to_vec();
            moved[axis] += step;
            let there = self.outcome(&moved)?;
            Some(there.iter().zip(here).map(|(there, here)| (there - here) / step).collect())
        };
        (0..self.free()).into_par_iter().map(by).collect()
    }
}

impl Smooth for DesignProblem<'_> {
    fn free(&self) -> usize {
        self.task.free.len()
    }

    fn constraints(&self) -> usize {
        self.limits.len()
    }

    fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
        self.outcome(point)
    }

    fn gradients(&self, point: &[f64], here: &[f64]) -> Option<Vec<Vec<f64>>> {
        let by = if self.is_sampled() {
            self.differences(point, here)?
        } else {
            let variable =
                |value: &f64| Variable { value: *value, scale: 1.0, range: Span::new(0.0, 1.0) };
            let variables: Vec<Variable> = point.iter().map(variable).collect();
            let sizes = vec![1.0; here.len()];
            let mut evaluate =
                |points: &[Vec<f64>]| points.par_iter().map(|it| self.outcome(it)).collect();
            let found = derivatives(&variables, here, &sizes, StepLengths::SETTLED, &mut evaluate);
            let slopes =
                |by: Vec<Derivative>| -> Vec<f64> { by.into_iter().map(|it| it.value).collect() };
            found.by_variable.into_iter().map(|by| by.map(slopes)).collect::<Option<_>>()?
        };
        let gradient = |result: usize| -> Vec<f64> { by.iter().map(|of| of[result]).collect() };
        Some((0..here.len()).map(gradient).collect())
    }
}
