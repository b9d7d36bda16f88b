//! How probably a drive is completed, and how it ends otherwise.

use super::ensemble::Probability;
use crate::mission::Limited;

/// What a drive risks: how it ends on other soils and models.
#[derive(Clone, Debug, PartialEq)]
pub struct Completion {
    /// Samples that complete all legs, of those that can be computed.
    pub completed: Probability,
    /// Samples that cannot be computed.
    pub not_computed: usize,
    /// The commonest end of the others.
    pub commonest: Option<CommonEnd>,
}

/// How a drive ends that is not completed.
#[derive(Clone, Debug, PartialEq)]
pub struct CommonEnd {
    /// In this leg, counted from 1.
    pub leg: usize,
    /// The outcome, by its name.
    pub outcome: &'static str,
    /// The number whose limit the rover passed, if one made it stop.
    pub limit: Option<Limited>,
    /// So many samples end so.
    pub count: usize,
}

/// What becomes of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SampleEnd {
    /// It completes all legs.
    Completed,
    /// It ends in a leg, counted from 1, by an outcome; at the limit of a number, if one made it
    /// stop.
    In(usize, &'static str, Option<Limited>),
    /// It cannot be computed.
    NotComputed,
}

impl Completion {
    /// * `ends`: of each sample
    pub(super) fn of(ends: &[SampleEnd]) -> Self {
        let count = |end: SampleEnd| ends.iter().filter(|it| **it == end).count();
        let not_computed = count(SampleEnd::NotComputed);
        // Of those that are as common the one that comes first on the way.
        let failed = ends.iter().filter_map(|end| match *end {
            SampleEnd::In(leg, outcome, limit) => {
                Some(CommonEnd { leg, outcome, limit, count: count(*end) })
            }
            _ => None,
        });
        let commonest = failed.max_by_key(|end| (end.count, std::cmp::Reverse(end.leg)));
        let (successes, trials) = (count(SampleEnd::Completed), ends.len() - not_computed);
        Self { completed: Probability { successes, trials }, not_computed, commonest }
    }
}
