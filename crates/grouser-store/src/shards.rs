//! Sets of shards as ranges: a campaign of 10¹² runs has 10⁹ of them, and no list of these is ever
//! made.

use std::collections::BTreeMap;

use crate::part::Part;

/// The shards of a campaign, or of one part of it: `first`, `first + step` and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Progression {
    first: u64,
    step: u64,
    count: u64,
}

impl Progression {
    /// * `shards`: of the whole campaign
    pub(crate) fn of(shards: u64, part: Option<Part>) -> Self {
        let (first, step) = part.map_or((0, 1), |part| (part.index.saturating_sub(1), part.of));
        let step = step.max(1);
        Self { first, step, count: shards.saturating_sub(first).div_ceil(step) }
    }

    pub(crate) fn count(self) -> u64 {
        self.count
    }

    /// Which shard is at a place, counted from 0.
    fn at(self, place: u64) -> u64 {
        self.first + place * self.step
    }

    /// Where a shard is; none if it does not belong here.
    fn place_of(self, shard: u64) -> Option<u64> {
        let beyond = shard.checked_sub(self.first)?;
        let place = beyond / self.step;
        (beyond % self.step == 0 && place < self.count).then_some(place)
    }

    pub(crate) fn iter(self) -> impl Iterator<Item = u64> + use<> {
        (0..self.count).map(move |place| self.at(place))
    }
}

/// Some of the shards of a campaign or part. Memory is that of its ranges: shards that are done one
/// after another leave one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShardSet {
    of: Progression,
    /// Places: the first of each range, and the one after its last.
    ranges: BTreeMap<u64, u64>,
}

impl ShardSet {
    /// All of them.
    pub(crate) fn all(of: Progression) -> Self {
        let ranges = (of.count > 0).then_some((0, of.count));
        Self { of, ranges: ranges.into_iter().collect() }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> u64 {
        self.ranges.iter().map(|(start, end)| end - start).sum()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }

    /// Whether a shard is one of them.
    #[must_use]
    pub fn contains(&self, shard: u64) -> bool {
        self.of.place_of(shard).is_some_and(|place| self.range_of(place).is_some())
    }

    fn range_of(&self, place: u64) -> Option<(u64, u64)> {
        let (start, end) = self.ranges.range(..=place).next_back()?;
        (place < *end).then_some((*start, *end))
    }

    /// Takes a shard out; whether it was in.
    pub(crate) fn remove(&mut self, shard: u64) -> bool {
        let Some(place) = self.of.place_of(shard) else { return false };
        let Some((start, end)) = self.range_of(place) else { return false };
        self.ranges.remove(&start);
        if start < place {
            self.ranges.insert(start, place);
        }
        if place + 1 < end {
            self.ranges.insert(place + 1, end);
        }
        true
    }

    /// Those of the same campaign or part that are not in this set.
    #[must_use]
    pub fn others(&self) -> Self {
        let (mut ranges, mut next) = (BTreeMap::new(), 0);
        for (start, end) in &self.ranges {
            if next < *start {
                ranges.insert(next, *start);
            }
            next = *end;
        }
        if next < self.of.count {
            ranges.insert(next, self.of.count);
        }
        Self { of: self.of, ranges }
    }

    /// Their numbers, in order.
    pub fn iter(&self) -> impl Iterator<Item = u64> + '_ {
        self.ranges.iter().flat_map(|(start, end)| *start..*end).map(|place| self.of.at(place))
    }

    /// The same as arithmetic progressions: first shard, step, how many.
    pub fn progressions(&self) -> impl Iterator<Item = (u64, u64, u64)> + '_ {
        self.ranges.iter().map(|(start, end)| (self.of.at(*start), self.of.step, end - start))
    }
}

/// The first few of them.
impl std::fmt::Display for ShardSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        const SHOWN: usize = 8;
        let mut words: Vec<String> = self.iter().take(SHOWN).map(|it| it.to_string()).collect();
        if self.len() > words.len() as u64 {
            words.push("…".into());
        }
        f.write_str(&words.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ranges agree with sets of single numbers, in whatever order shards are removed.
    #[test]
    fn ranges_are_the_sets_that_they_stand_for() {
        for part in [None, Some(Part { index: 2, of: 3 }), Some(Part { index: 30, of: 30 })] {
            let own = Progression::of(29, part);
            let mut set = ShardSet::all(own);
            let mut expected: Vec<u64> =
                (0..29).filter(|shard| part.is_none_or(|part| part.has(*shard))).collect();
            let all = expected.clone();
            for step in 0..40_u64 {
                assert_eq!(set.iter().collect::<Vec<_>>(), expected);
                assert_eq!(set.len(), expected.len() as u64);
                let others = all.iter().copied().filter(|shard| !expected.contains(shard));
                assert_eq!(set.others().iter().collect::<Vec<_>>(), others.collect::<Vec<_>>());
                let gone = step * 17 % 31;
                assert_eq!(set.contains(gone), expected.contains(&gone));
                assert_eq!(set.remove(gone), expected.contains(&gone));
                expected.retain(|shard| *shard != gone);
            }
        }
    }

    #[test]
    fn a_thousand_million_shards_are_one_range() {
        let mut set =
            ShardSet::all(Progression::of(976_562_500, Some(Part { index: 1, of: 1000 })));
        assert_eq!(set.len(), 976_563);
        set.remove(0);
        assert_eq!(set.progressions().collect::<Vec<_>>(), [(1000, 1000, 976_562)]);
        assert_eq!(set.to_string(), "1000, 2000, 3000, 4000, 5000, 6000, 7000, 8000, …");
    }
}
