//! How probably a way is completed, and where it ends otherwise.

use super::hazard::Danger;
use crate::studies::completion::{Completion, SampleEnd};
use crate::units::Vec2;

/// What a way risks. A sample of soil and model ends where the way first is a no-go for it: it holds
/// the course by no heading, slips more than a no-go, or gets stuck in a turn on the spot. Each sample
/// is the same soil all the way, so that all of them are compared over the same ground.
#[derive(Clone, Debug, PartialEq)]
pub struct RouteRisk {
    /// How probably it is completed; ends are named as [dangers](Danger).
    pub completion: Completion,
    /// Where the commonest end is: of the samples that end so, where half of them have ended.
    pub end: Option<EndPlace>,
}

/// A place on a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndPlace {
    /// Length on the map from the start of the way [m].
    pub along: f64,
    /// The place [m].
    pub place: Vec2,
}

/// Where a sample ends, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    /// In this leg, counted from 1.
    pub(super) leg: usize,
    /// Length on the map from the start of the way [m].
    pub(super) along: f64,
    /// The place [m].
    pub(super) place: Vec2,
    /// Why; nothing where the search for a heading gave up.
    pub(super) danger: Option<Danger>,
}

impl RouteRisk {
    /// * `ends`: of each sample, nothing of one that completes the way
    pub(super) fn of(ends: &[Option<End>]) -> Self {
        let named = |end: &Option<End>| end.as_ref().map_or(SampleEnd::Completed, End::named);
        let each: Vec<SampleEnd> = ends.iter().map(named).collect();
        let completion = Completion::of(&each);
        let end = completion.commonest.as_ref().and_then(|commonest| {
            let common = SampleEnd::In(commonest.leg, commonest.outcome, commonest.limit);
            let is_so = |end: &&End| end.named() == common;
            let mut same: Vec<&End> = ends.iter().flatten().filter(is_so).collect();
            same.sort_by(|one, other| one.along.total_cmp(&other.along));
            let middle = same.get((same.len().max(1) - 1) / 2)?;
            Some(EndPlace { along: middle.along, place: middle.place })
        });
        Self { completion, end }
    }
}

impl End {
    /// By its leg and danger; not computed where the search for a heading gave up.
    fn named(&self) -> SampleEnd {
        let of = |danger: Danger| SampleEnd::In(self.leg, danger.name(), None);
        self.danger.map_or(SampleEnd::NotComputed, of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_commonest_end_is_where_half_of_its_samples_have_ended() {
        let end =
            |leg, along, danger| Some(End { leg, along, place: Vec2::new(along, 0.0), danger });
        let found = RouteRisk::of(&[
            None,
            end(1, 2.0, Some(Danger::NoHeading)),
            end(2, 9.0, Some(Danger::TooMuchSlip)),
            end(2, 7.0, Some(Danger::TooMuchSlip)),
            end(2, 8.0, Some(Danger::TooMuchSlip)),
            end(2, 8.0, None),
            None,
        ]);
        let completed = found.completion.completed;
        assert_eq!((completed.successes, completed.trials), (2, 6));
        assert_eq!(found.completion.not_computed, 1);
        let commonest = found.completion.commonest.expect("some end");
        assert_eq!((commonest.leg, commonest.outcome, commonest.count), (2, "too-much-slip", 3));
        assert_eq!(found.end.expect("a place").along, 8.0);
        let all = RouteRisk::of(&[None, None]);
        assert_eq!((all.completion.completed.estimate(), all.end), (1.0, None));
    }
}
