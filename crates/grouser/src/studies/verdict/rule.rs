//! The limits of the verdicts, and what no rule may allow.

use std::f64::consts::PI;

use serde::Serialize;

use super::held::Holding;
use super::reason::{Judgement, Reason, Shortfall, Verdict};
use crate::error::{ParameterError, positive};

/// The limits of the verdicts. Source of all numbers: ours; a mission has its own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rule {
    /// Go: a heading holds the course and slips at most this much [-] …
    pub go_slip_ratio: f64,
    /// … in at least this share of the samples [-] …
    pub go_probability: f64,
    /// … and in 97.5 % of them the rover drifts at most this much downhill of its course [m/m].
    pub go_drift_m_per_m: f64,
    /// No-go: no heading holds the course, or it slips more than this [-] …
    pub no_go_slip_ratio: f64,
    /// … in at least this share of the samples [-]; or the rover gets stuck in as many.
    pub no_go_probability: f64,
}

/// No slope is to be driven that is not this much flatter than the soil's friction angle [rad],
/// whatever its cohesion: 5°. Source: ours.
pub const BELOW_FRICTION_ANGLE: f64 = 5.0 * PI / 180.0;

/// No slope is a go on which the rover is stuck by the card's heading in more than this share of
/// the samples [-]: 5 of 1000. Source: ours.
pub const STUCK_ON_GO: f64 = 0.005;

/// No slope is to be driven on which rover or ground slide in this share of the samples [-]: 1 of
/// 100. Source: ours; a rover that slides is not got back.
pub const SLIDES_ON_NO_GO: f64 = 0.01;

/// Shares as 19 of 20 are no rounder than this [-].
const ROUND_OFF: f64 = 1e-12;

impl Rule {
    /// Slip 0.3: rims go 1.4 times the way, and thrust still grows with slip. 0.95: the share of a
    /// 95 % band. Drift 0.1: a metre lower after ten.
    /// Slip 0.6: rims go 2.5 times the way, and thrust hardly grows any more: nothing is left to
    /// get out with. 0.2: one soil in five.
    pub const DEFAULT: Self = Self {
        go_slip_ratio: 0.3,
        go_probability: 0.95,
        go_drift_m_per_m: 0.1,
        no_go_slip_ratio: 0.6,
        no_go_probability: 0.2,
    };

    /// Checks that no slope can be both a go and a no-go.
    ///
    /// # Errors
    /// [`ParameterError`] for shares and slip ratios outside 0 to 1, a drift that is not positive,
    /// and a go that asks for less than a no-go.
    pub fn check(&self) -> Result<(), ParameterError> {
        let within = |name: &str, value: f64, most: f64, expected: &'static str| {
            let inside = (0.0..=most).contains(&value);
            inside.then_some(()).ok_or_else(|| ParameterError::new(name, value, expected))
        };
        let (slip, share) = (self.no_go_slip_ratio, self.go_probability);
        within("the no-go slip ratio", slip, 1.0, "0 to 1")?;
        within("the go slip ratio", self.go_slip_ratio, slip, "0 to the no-go slip ratio")?;
        within("the go probability", share, 1.0, "0 to 1")?;
        positive("the go drift [m/m]", self.go_drift_m_per_m)?;
        let no_go = self.no_go_probability;
        within("the no-go probability", no_go, 1.0, "0 to 1")?;
        if no_go < 1.0 - share - ROUND_OFF || no_go == 0.0 {
            let expected = "above 0, and 1 less the go probability at least";
            return Err(ParameterError::new("the no-go probability", no_go, expected));
        }
        Ok(())
    }

    /// What the slips of all samples say of a slope. A sample of which nothing is known makes it no
    /// go and no no-go.
    pub(in super::super) fn on_slips(&self, held: &[Holding]) -> Judgement {
        let unknown = held.iter().filter(|it| **it == Holding::Unknown).count();
        let within = |most: f64| {
            let keeps = |it: &&Holding| matches!(it, Holding::At { slip_ratio, .. } if slip_ratio.abs() <= most);
            held.iter().filter(keeps).count()
        };
        let [go, holding] = [self.go_slip_ratio, self.no_go_slip_ratio].map(within);
        self.on_counts([go, holding, unknown], held.len())
    }

    /// The same by how many samples keep to the slip of a go, and to that of a no-go, and of how
    /// many of all nothing is known.
    fn on_counts(&self, [go, holding, unknown]: [usize; 3], all: usize) -> Judgement {
        let share = |count: usize| count as f64 / all as f64;
        let failing = share(all - holding - unknown);
        let (most, least) = (self.no_go_probability - ROUND_OFF, self.go_probability - ROUND_OFF);
        let mut found = Judgement::GO;
        let shortfall =
            |slip_ratio, limit, share| Shortfall { slip_ratio, limit, share: Some(share) };
        let no_go = shortfall(self.no_go_slip_ratio, self.no_go_probability, failing);
        found.add_shortfall(failing >= most, Verdict::NoGo, no_go);
        let could_decide =
            share(all - holding) >= most || (share(go) < least && share(go + unknown) >= least);
        found.add(unknown > 0 && could_decide, Verdict::CannotTell, Reason::SearchGaveUp);
        let caution = shortfall(self.go_slip_ratio, self.go_probability, share(go));
        found.add_shortfall(share(go) < least, Verdict::Caution, caution);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a hundred samples: how many keep to the slip of a go, to that of a no-go, and are not
    /// known.
    #[test]
    fn the_share_that_holds_decides_and_what_is_not_known_leaves_it_open() {
        use Reason::{AllMet, SearchGaveUp, ShareThatHolds};
        use Verdict::{CannotTell, Caution, Go, NoGo};
        for (counts, verdict, reason) in [
            ([100, 100, 0], Go, AllMet),
            ([95, 95, 0], Go, AllMet),
            ([94, 99, 0], Caution, ShareThatHolds),
            ([94, 94, 1], CannotTell, SearchGaveUp),
            ([95, 95, 5], Go, AllMet),
            ([10, 81, 0], Caution, ShareThatHolds),
            ([10, 80, 0], NoGo, ShareThatHolds),
            ([10, 80, 1], CannotTell, SearchGaveUp),
            ([10, 70, 10], NoGo, ShareThatHolds),
            ([0, 0, 100], CannotTell, SearchGaveUp),
        ] {
            let found = Rule::DEFAULT.on_counts(counts, 100);
            assert_eq!((found.verdict, found.reason), (verdict, reason), "{counts:?}");
            assert_eq!(found.shortfall.is_some(), reason == ShareThatHolds, "{counts:?}");
        }
    }

    /// The sentence names the limit that decides, by the rule's own numbers.
    #[test]
    fn caution_and_no_go_each_name_their_own_limit() {
        let rule = Rule { go_probability: 0.9, no_go_slip_ratio: 0.5, ..Rule::DEFAULT };
        let [caution, no_go] = [[62, 81, 0], [10, 72, 3]].map(|it| rule.on_counts(it, 100));
        for (found, said) in [
            (
                caution,
                "in 62 % of the samples a heading holds the course with a slip ratio up to \
                       0.3, and a go takes 90 %",
            ),
            (
                no_go,
                "in 25 % of the samples no heading holds the course with a slip ratio up to 0.5, \
                     and 20 % make a no-go",
            ),
            (
                caution.of_several(),
                "in less than 90 % of the samples a heading holds the course with \
                                    a slip ratio up to 0.3",
            ),
            (
                no_go.of_several(),
                "in 20 % of the samples or more no heading holds the course with a \
                                  slip ratio up to 0.5",
            ),
        ] {
            assert_eq!(found.meaning(), said);
        }
    }
}
