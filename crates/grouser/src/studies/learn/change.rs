//! Whether the soil has become another: evidence that is summed up over stretches (Page 1954).
//!
//! A stretch speaks for another soil by as much as it would be likelier if nothing had been learnt of the width of the
//! belief (`Surprise::strangeness`). The learner goes on meanwhile, and after some stretches finds another soil no
//! stranger than the first: a change that does not show in three of them or so is learnt, and not flagged. Two rules that
//! flag more were tried and left: to judge stretches by what was believed before the evidence began, and to set a second
//! learner beside the first that begins anew. Both took ground that leans for another soil, every ten metres or so.

use super::archive::Archive;

/// The evidence so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SoilChange {
    /// A logarithm of densities, 0 or more.
    evidence: f64,
}

/// Evidence at which the soil counts as another.
const CHANGED: f64 = 9.0;
/// The most that one stretch may say: three have to agree, so that no outlier is a soil.
const MOST_SAID: f64 = 3.5;

impl SoilChange {
    /// Whether the soil has just been found to be another.
    ///
    /// * `strangeness`: of a stretch
    pub(super) fn look(&mut self, strangeness: f64) -> bool {
        self.evidence = (self.evidence + strangeness.min(MOST_SAID)).max(0.0);
        let is_another = self.evidence >= CHANGED;
        if is_another {
            self.evidence = 0.0;
        }
        is_another
    }

    pub(super) fn walk(&mut self, archive: &mut dyn Archive) {
        let Self { evidence } = self;
        archive.number("evidence", evidence);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_strange_stretches_are_another_soil_and_one_is_none() {
        let mut change = SoilChange::default();
        assert!(!change.look(1e6));
        assert!(!change.look(-4.0));
        assert_eq!([3.5, 3.5, 3.5].map(|it| change.look(it)), [false, false, true]);
        assert!(!change.look(3.5), "it begins anew");
    }
}
