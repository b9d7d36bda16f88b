//! How the samples of a band ended early.

use crate::simulation::{InBand, OutcomeKind};

/// Samples of a band that ended early, counted by how they did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ends {
    /// All samples.
    samples: usize,
    /// Those that ended so, in the order of [`OutcomeKind::ALL`]; 0 for those that count to the
    /// end.
    early: [usize; OutcomeKind::ALL.len()],
}

impl Ends {
    /// Counts of samples.
    ///
    /// * `samples`: how many there are
    /// * `ended`: the kinds of their ends, of those that ended
    pub(super) fn of(samples: usize, ended: impl Iterator<Item = OutcomeKind>) -> Self {
        let mut early = [0; OutcomeKind::ALL.len()];
        for kind in ended.filter(|kind| kind.row().in_band != InBand::Counts) {
            early[kind as usize] += 1;
        }
        Self { samples, early }
    }

    /// All samples.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Number of samples that ended early in one way.
    #[must_use]
    pub fn count(&self, kind: OutcomeKind) -> usize {
        self.early[kind as usize]
    }

    /// Number of samples that ended early, whatever ended them.
    #[must_use]
    pub fn early(&self) -> usize {
        self.early.iter().sum()
    }

    /// Share of the samples that ended early [-].
    #[must_use]
    pub fn share_early(&self) -> f64 {
        self.share(self.early())
    }

    /// Number of samples that the band is over: all that have not left it.
    #[must_use]
    pub fn in_band(&self) -> usize {
        let left = |(kind, _): &(OutcomeKind, usize)| kind.row().in_band == InBand::Leaves;
        self.samples - self.each().filter(left).map(|(_, count)| count).sum::<usize>()
    }

    /// Ways in which some samples ended early, with their numbers.
    pub fn each(&self) -> impl Iterator<Item = (OutcomeKind, usize)> + '_ {
        let counts = OutcomeKind::ALL.into_iter().zip(self.early);
        counts.filter(|(_, count)| *count > 0)
    }

    /// Which share ended early, and how: `immobilised 12.5 %, off_map 4.2 %`; nothing where none
    /// did.
    #[must_use]
    pub fn in_words(&self) -> Option<String> {
        let percent = |count| 100.0 * self.share(count);
        let each =
            self.each().map(|(kind, count)| format!("{} {:.1} %", kind.name(), percent(count)));
        let each: Vec<String> = each.collect();
        (!each.is_empty()).then(|| each.join(", "))
    }

    /// What becomes of those samples in the band, a sentence for each way; nothing where none ended
    /// early.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let all = self.samples;
        let sentence = |(kind, count): (OutcomeKind, usize)| {
            let (share, name) = (100.0 * self.share(count), kind.in_words());
            let then = kind.row().in_band.meaning();
            format!(
                "{count} of {all} samples ({share:.1} %) ended early, {name}: such a sample {then}"
            )
        };
        self.each().map(sentence).collect()
    }

    fn share(&self, count: usize) -> f64 {
        count as f64 / self.samples as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stuck_samples_stay_in_the_band_and_others_leave() {
        let ended = [
            OutcomeKind::Completed,
            OutcomeKind::Immobilised,
            OutcomeKind::OffTheMap,
            OutcomeKind::OffTheMap,
        ];
        let ends = Ends::of(8, ended.into_iter());
        assert_eq!((ends.early(), ends.in_band(), ends.share_early()), (3, 6, 0.375));
        assert_eq!(ends.in_words().as_deref(), Some("immobilised 12.5 %, off_map 25.0 %"));
        assert_eq!(ends.sentences().len(), 2);
        assert_eq!(Ends::of(8, std::iter::empty()).in_words(), None);
    }
}
