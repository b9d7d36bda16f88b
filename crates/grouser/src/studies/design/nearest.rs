//! The point that comes nearest to keeping limits, where no search keeps them.

use std::cell::RefCell;

use super::answer::{Nearest, NoDesign};
use super::limits::DesignLimit;
use super::problem::DesignProblem;
use super::slsqp::{self, Smooth};

/// A point that comes near to keeping limits.
pub(super) struct NearestPoint {
    /// Where it is, in the unit cube.
    pub(super) point: Vec<f64>,
    /// By how much it misses the worst of them, over its size; 0 where it keeps them.
    pub(super) excess: f64,
    /// Which limits were looked at.
    is_meant: fn(&DesignLimit) -> bool,
}

/// The least by which the worst of some limits is missed: a last number that each may be missed by.
struct Elastic<'a> {
    problem: &'a DesignProblem<'a>,
    is_meant: fn(&DesignLimit) -> bool,
    /// What the last number is a share of.
    most: f64,
    /// The last point that was asked for, and the search's own results there.
    last: RefCell<(Vec<f64>, Vec<f64>)>,
}

impl Smooth for Elastic<'_> {
    fn free(&self) -> usize {
        self.problem.free() + 1
    }

    fn constraints(&self) -> usize {
        self.problem.constraints()
    }

    fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
        let (share, own) = point.split_last()?;
        let slack = share * self.most;
        let limits = self.problem.limits.iter();
        let mut outcome = self.problem.outcome(own)?;
        self.last.replace((own.to_vec(), outcome.clone()));
        let excesses = outcome.split_off(1).into_iter().zip(limits);
        // What is not meant is kept, whatever the point.
        let constraint = |(excess, limit): (f64, &DesignLimit)| {
            if (self.is_meant)(limit) { excess - slack } else { -1.0 }
        };
        Some(std::iter::once(slack).chain(excesses.map(constraint)).collect())
    }

    fn gradients(&self, point: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
        let own = &point[..self.problem.free()];
        let last = self.last.borrow();
        let here = if last.0 == own { last.1.clone() } else { self.problem.outcome(own)? };
        let mut gradients = self.problem.gradients(own, &here)?;
        let [aim, limits @ ..] = &mut gradients[..] else { return None };
        aim.fill(0.0);
        aim.push(self.most);
        for (limit, gradient) in self.problem.limits.iter().zip(limits) {
            let is_meant = (self.is_meant)(limit);
            if !is_meant {
                gradient.fill(0.0);
            }
            gradient.push(if is_meant { -self.most } else { 0.0 });
        }
        Some(gradients)
    }
}

impl DesignProblem<'_> {
    /// The point from a start that comes nearest to keeping all limits. Slopes are climbed first: on
    /// one that is not crossed nothing else has a meaning.
    pub(super) fn nearest(&self, start: &[f64]) -> Option<NearestPoint> {
        let climbed = self.nearest_of(start, DesignLimit::is_of_slope)?;
        if climbed.excess > 0.0 { Some(climbed) } else { self.nearest_of(&climbed.point, |_| true) }
    }

    /// The point from a start that misses the worst of some limits by the least.
    fn nearest_of(
        &self,
        start: &[f64],
        is_meant: fn(&DesignLimit) -> bool,
    ) -> Option<NearestPoint> {
        let excesses = self.outcome(start)?;
        let meant = self.limits.iter().zip(&excesses[1..]).filter(|(limit, _)| is_meant(limit));
        let worst = meant.map(|(_, excess)| *excess).fold(0.0, f64::max);
        let most = 2.0 * worst.max(1.0);
        let elastic = Elastic { problem: self, is_meant, most, last: RefCell::default() };
        let mut point = start.to_vec();
        point.push(worst / elastic.most);
        let found = slsqp::minimum(&elastic, &point, self.effort())?;
        // What is missed by less than the search is exact to is kept.
        let exact = 1000.0 * self.effort().accuracy;
        let excess = if found.objective < exact { 0.0 } else { found.objective };
        Some(NearestPoint { point: found.point[..self.free()].to_vec(), excess, is_meant })
    }

    /// Why no search found a design: which limits the nearest one misses.
    ///
    /// * `nearest`: the points that come nearest from the starts
    pub(super) fn why_none(&self, starts: &[Vec<f64>], nearest: &[NearestPoint]) -> NoDesign {
        if !(self.sought.go_on)() {
            return NoDesign::Stopped;
        }
        let crosses = |it: &&NearestPoint| self.limits.iter().all(it.is_meant);
        let by_excess =
            |one: &&NearestPoint, other: &&NearestPoint| one.excess.total_cmp(&other.excess);
        let of_all = nearest.iter().filter(crosses).min_by(by_excess);
        let Some(nearest) = of_all.or_else(|| nearest.iter().min_by(by_excess)) else {
            let moves = starts.iter().any(|start| self.measured(start).is_some());
            return if moves { NoDesign::NotFound } else { NoDesign::NothingMoves };
        };
        let Some(measured) = self.measured(&nearest.point) else { return NoDesign::NothingMoves };
        let all = self.limits.iter().enumerate().filter(|(_, limit)| (nearest.is_meant)(limit));
        let all = all.map(|(place, limit)| (*limit, self.limited(place, &measured)));
        let missed: Vec<(DesignLimit, f64)> =
            all.filter(|(limit, value)| !limit.holds(*value)).collect();
        if missed.is_empty() {
            return NoDesign::NotFound;
        }
        NoDesign::Unreachable(Box::new(Nearest {
            candidate: self.place,
            values: self.values(&nearest.point),
            missed,
        }))
    }
}
