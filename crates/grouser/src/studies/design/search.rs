//! The search for the least of a problem: its starts, what shows that it is the least, and what is
//! found.

use grouser_io::design::Measure;
use grouser_io::statistics::NothingAccepted;
use rayon::prelude::*;

use super::answer::{BestDesign, Certificate, KeptLimit, NoDesign};
use super::limits::{DesignLimit, LimitSide, size, size_in_si};
use super::measured::{self, MeasuredGround, Measures};
use super::nearest::NearestPoint;
use super::problem::{DesignProblem, Moments, each};
use super::slsqp::{self, Minimum, Smooth as _};
use crate::studies::ensemble::design::{self as points, Sampling};

impl DesignProblem<'_> {
    pub(super) fn design(self) -> Result<BestDesign, NoDesign> {
        self.check_ground()?;
        let starts = self.starts();
        self.check_aim(&starts)?;
        if self.is_sampled() {
            return self.design_by_samples(&starts);
        }
        let (best, agreed) = self.search(&starts)?;
        let certificate = self.certificate(&best, starts.len(), agreed);
        self.found(&best, certificate)
    }

    /// The design where soils are uncertain.
    fn design_by_samples(mut self, starts: &[Vec<f64>]) -> Result<BestDesign, NoDesign> {
        /// How often what samples say of a limit is looked up again.
        const LOOKS: usize = 4;
        /// Searches that only show whether it is the least.
        const OTHERS: usize = 2;
        let (mut best, _) = self.search(&[self.without_samples(starts)?])?;
        for _ in 0..LOOKS {
            if !self.look_up_scores(&best) {
                break;
            }
            (best, _) = self.search(std::slice::from_ref(&best.point))?;
        }
        let is_alone = self.sought.near.is_none();
        let others: &[Vec<f64>] = if is_alone { &starts[starts.len() - OTHERS..] } else { &[] };
        let all = [std::slice::from_ref(&best.point), others].concat();
        let (best, agreed) = self.search(&all)?;
        let certificate = self.certificate(&best, all.len(), agreed);
        self.found(&best, certificate)
    }

    /// Where the least is without samples, or what is nearest to keeping limits there.
    fn without_samples(&self, starts: &[Vec<f64>]) -> Result<Vec<f64>, NoDesign> {
        if let Some(near) = self.near() {
            return Ok(near);
        }
        let nominal = Self::of(self.task, self.seed, self.place, self.sought, true)?;
        match nominal.search(starts) {
            Ok((best, _)) => Ok(best.point),
            Err(NoDesign::Unreachable(nearest)) => Ok(self.point(&nearest.values)),
            Err(NoDesign::Stopped) => Err(NoDesign::Stopped),
            Err(_) => Ok(starts[0].clone()),
        }
    }

    /// The least that searches come to, and how many come to it.
    fn search(&self, starts: &[Vec<f64>]) -> Result<(Minimum, usize), NoDesign> {
        let effort = self.effort();
        let from = |start: &Vec<f64>| {
            if let Some(found) = slsqp::minimum(self, start, effort) {
                return (Some(found), None);
            }
            // One that cannot keep its limits from there is led to where they are kept first.
            match self.nearest(start) {
                Some(nearest) if nearest.excess == 0.0 => {
                    (slsqp::minimum(self, &nearest.point, effort), Some(nearest))
                }
                nearest => (None, nearest),
            }
        };
        let (found, nearest): (Vec<Option<Minimum>>, Vec<Option<NearestPoint>>) =
            starts.par_iter().map(from).unzip();
        let best =
            found.iter().flatten().min_by(|one, other| one.objective.total_cmp(&other.objective));
        let Some(best) = best.cloned() else {
            let nearest: Vec<NearestPoint> = nearest.into_iter().flatten().collect();
            return Err(self.why_none(starts, &nearest));
        };
        let apart = if self.is_sampled() { AGREED_BY_SAMPLES } else { AGREED };
        let agrees = |it: &&Minimum| {
            (it.objective - best.objective).abs() <= apart * best.objective.abs().max(1.0)
        };
        let agreed = found.iter().flatten().filter(agrees).count();
        Ok((best, agreed))
    }

    /// Where searches start: a design that may be near, the rover's own numbers, then points spread
    /// over the bounds.
    fn starts(&self) -> Vec<Vec<f64>> {
        /// Searches from points that are spread.
        const SPREAD: usize = 4;
        let own = self.point(&self.candidate.given);
        self.near().into_iter().chain([own]).chain(spread(self.free()).take(SPREAD)).collect()
    }

    /// The design that may be near, if it is one of this rover.
    fn near(&self) -> Option<Vec<f64>> {
        let near = self.sought.near.filter(|it| it.candidate == self.place)?;
        Some(self.point(&near.values))
    }

    /// Looks up how many deviations each limit has to keep off for the share of samples that is
    /// asked for; whether any has changed.
    fn look_up_scores(&mut self, best: &Minimum) -> bool {
        /// What is exact enough, over a measure's size [-].
        const EXACT: f64 = 2e-3;
        let Some(measured) = self.measured(&best.point) else { return false };
        let (mut scores, mut has_changed) = (self.scores.clone(), false);
        for (place, limit) in self.limits[..self.stated].iter().enumerate() {
            let ground = &self.grounds[limit.ground];
            if !ground.is_uncertain() {
                continue;
            }
            let sign = limit.side.sign();
            let samples = &measured[limit.ground];
            let Moments { mean, deviation } = Moments::of(samples, limit.measure);
            if deviation <= 1e-9 * size_in_si(limit.measure) {
                continue;
            }
            let all = each(samples, limit.measure);
            let mut worse: Vec<f64> = all.map(|it| sign * (it - mean) / deviation).collect();
            worse.sort_by(f64::total_cmp);
            let asked = self.task.probability * ground.count() as f64;
            let kept = (1..worse.len()).find(|count| *count as f64 >= asked);
            let score = worse[kept.unwrap_or(worse.len()) - 1];
            let change = (score - self.scores[place]).abs() * deviation;
            has_changed |= change > EXACT * size_in_si(limit.measure);
            scores[place] = score;
        }
        if has_changed {
            self.scores = scores;
        }
        has_changed
    }

    fn found(&self, best: &Minimum, certificate: Certificate) -> Result<BestDesign, NoDesign> {
        let values = self.values(&best.point);
        let numbers = measured::numbers(self.task, self.candidate, &values);
        let (Some(measured), Some(numbers)) = (self.measured(&best.point), numbers) else {
            return Err(NoDesign::NothingMoves);
        };
        let mean = |measure: Measure| Moments::of(&measured[0], measure).mean;
        let fresh = self.fresh(&numbers)?;
        let kept = self.limits.iter().enumerate().map(|(place, limit)| {
            let multiplier = best.multipliers.get(place).copied().unwrap_or(0.0);
            KeptLimit {
                limit: *limit,
                value: self.limited(place, &measured),
                price: multiplier * self.aim_size / size(limit.measure),
                share: fresh[limit.ground].as_ref().map(|all| share(limit, all)),
            }
        });
        Ok(BestDesign {
            candidate: self.place,
            objective: best.objective * self.aim_size,
            measures: Measure::ALL.map(mean),
            kept: kept.collect(),
            values,
            numbers,
            certificate,
        })
    }

    /// What samples measure that took no part, on each ground that is uncertain.
    fn fresh(
        &self,
        numbers: &[(String, f64)],
    ) -> Result<Vec<Option<Vec<Option<Measures>>>>, NothingAccepted> {
        let of_ground = |(place, ground): (usize, &MeasuredGround)| {
            if !ground.is_uncertain() {
                return Ok(None);
            }
            let there = &self.candidate.grounds[place];
            let seed = self.seed.wrapping_add(1);
            let fresh = MeasuredGround::drawn(there, seed, Self::FRESH_SAMPLES)?;
            let measured = fresh.measures(numbers).into_iter();
            Ok(Some(measured.map(|it| Some(fresh.where_crossed(it?))).collect()))
        };
        self.grounds.iter().enumerate().map(of_ground).collect()
    }

    /// Looks at designs around the best, 1 % of the bounds away along each number and between.
    fn certificate(&self, best: &Minimum, starts: usize, agreed: usize) -> Certificate {
        /// How far away, over the bounds [-].
        const AWAY: f64 = 0.01;
        /// Better by less than this is rounding, over the aim's size; and where searches among samples
        /// end [-].
        const ROUNDING: [f64; 2] = [1e-6, 1e-3];
        /// Designs in all directions; fewer where each is measured by samples.
        const DIRECTIONS: [usize; 2] = [60, 20];
        let along = (0..self.free()).flat_map(|axis| {
            [0.0, 1.0].map(move |side| {
                (0..self.free()).map(move |it| if it == axis { side } else { 0.5 })
            })
        });
        let along = along.map(Iterator::collect::<Vec<f64>>);
        let cost = usize::from(self.is_sampled());
        let (directions, rounding) = (DIRECTIONS[cost], ROUNDING[cost]);
        let shares: Vec<Vec<f64>> = along.chain(spread(self.free()).take(directions)).collect();
        let is_better = |share: &&Vec<f64>| {
            let moved = best.point.iter().zip(*share);
            let moved = moved.map(|(it, share)| (it + AWAY * (2.0 * share - 1.0)).clamp(0.0, 1.0));
            let outcome = self.outcome(&moved.collect::<Vec<f64>>());
            outcome.is_some_and(|outcome| {
                outcome[0] < best.objective - rounding && outcome[1..].iter().all(|it| *it <= 0.0)
            })
        };
        let better = shares.par_iter().filter(is_better).count();
        Certificate { starts, agreed, probes: shares.len(), better }
    }

    /// Checks that every ground stands where a slope is to be crossed: whatever the rover, none
    /// crosses another.
    fn check_ground(&self) -> Result<(), NoDesign> {
        let to_cross = |it: &&DesignLimit| it.is_of_slope() && it.side == LimitSide::AtLeast;
        for limit in self.limits.iter().filter(to_cross) {
            let stands = self.grounds[limit.ground].strength();
            if limit.bound > stands {
                return Err(NoDesign::BeyondGround { limit: *limit, stands });
            }
        }
        Ok(())
    }

    /// Whether what is free acts on the aim at any start.
    fn check_aim(&self, starts: &[Vec<f64>]) -> Result<(), NoDesign> {
        let mut aims = starts.iter().filter_map(|start| Some(self.aim(&self.measured(start)?)));
        let Some(first) = aims.next() else { return Ok(()) };
        let mut others = aims.peekable();
        if others.peek().is_some() && others.all(|aim| aim == first) {
            return Err(NoDesign::Constant);
        }
        Ok(())
    }
}

/// Searches that differ by less came to one design [-].
const AGREED: f64 = 1e-4;
/// Searches among samples that differ by less came to one design: kinks end them early [-].
const AGREED_BY_SAMPLES: f64 = 1e-3;

/// The share of samples that keeps a limit; one that does not move keeps none.
fn share(limit: &DesignLimit, samples: &[Option<Measures>]) -> f64 {
    let keeps =
        |it: &&Option<Measures>| it.is_some_and(|it| limit.holds(it[limit.measure.place()]));
    samples.iter().filter(keeps).count() as f64 / samples.len() as f64
}

/// Points that fill the unit cube evenly.
fn spread(dimensions: usize) -> impl Iterator<Item = Vec<f64>> {
    /// More than are asked for.
    const POINTS: u64 = 128;
    let set = points::Design { sampling: Sampling::Sobol, points: POINTS, dimensions, seed: 1 };
    (0..POINTS).map(move |index| set.point(index))
}
