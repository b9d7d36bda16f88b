//! Go, caution, cannot tell and no-go, and the reasons for them.

use grouser_io::reading::four_digits;

/// Whether to drive on a slope; the worst is the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Drive.
    Go,
    /// Drive only after a second check: measured slip, a stop on the way, a person's decision.
    Caution,
    /// Nobody can tell: what is not known may be a no-go.
    CannotTell,
    /// Do not drive.
    NoGo,
}

/// What decides a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// All conditions of a go are met.
    AllMet,
    /// In too few of the samples a heading holds the course at an acceptable slip.
    ShareThatHolds,
    /// In half of the samples no heading holds the course.
    NoHeading,
    /// The rover gets stuck too often.
    Stuck,
    /// In a turn on the spot the wheels dig: they slip too much in too many of the samples.
    WheelsDig,
    /// The rover, or the ground by itself, slides in too much of the belief's weight.
    Slides,
    /// The nose falls so fast that nobody can hold the heading.
    HeadingFalls,
    /// The drift is too large.
    Drift,
    /// The slope is too near to the soil's friction angle.
    FrictionMargin,
    /// The ground stands with too small a factor of safety.
    FactorOfSafety,
    /// The rover tips over at rest.
    TipsOver,
    /// The soil's document states no uncertainty.
    NoStatedUncertainty,
    /// In half of the samples the result is so far outside a domain that nobody is to drive by it.
    OutsideDomain,
    /// The search for a heading, or for the motion in a turn, gave up in samples that could decide.
    SearchGaveUp,
}

impl Verdict {
    /// All of them, the best first.
    pub const ALL: [Self; 4] = [Self::Go, Self::Caution, Self::CannotTell, Self::NoGo];

    /// One word of the reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Go => "go",
            Self::Caution => "caution",
            Self::CannotTell => "cannot_tell",
            Self::NoGo => "no_go",
        }
    }

    /// The same for readers: `no-go`.
    #[must_use]
    pub const fn in_words(self) -> &'static str {
        match self {
            Self::Go => "go",
            Self::Caution => "caution",
            Self::CannotTell => "cannot tell",
            Self::NoGo => "no-go",
        }
    }
}

impl Reason {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::AllMet,
        Self::ShareThatHolds,
        Self::NoHeading,
        Self::Stuck,
        Self::WheelsDig,
        Self::Slides,
        Self::HeadingFalls,
        Self::Drift,
        Self::FrictionMargin,
        Self::FactorOfSafety,
        Self::TipsOver,
        Self::NoStatedUncertainty,
        Self::OutsideDomain,
        Self::SearchGaveUp,
    ];

    /// One word of the reports, such as `share_that_holds`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// What it means: the end of a sentence that begins with the verdict.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        self.row().1
    }

    const fn row(self) -> (&'static str, &'static str) {
        match self {
            Self::AllMet => ("all_met", "all conditions of a go are met"),
            Self::ShareThatHolds => (
                "share_that_holds",
                "in too few of the samples a heading holds the course at an acceptable slip",
            ),
            Self::NoHeading => ("no_heading", "in half of the samples no heading holds the course"),
            Self::Stuck => ("stuck", "the rover gets stuck in too many of the samples"),
            Self::WheelsDig => ("wheels_dig", "the wheels dig in too many of the samples"),
            Self::Slides => ("slides", "rover or ground slide in too many of the samples"),
            Self::HeadingFalls => {
                ("heading_falls", "the nose falls faster than anybody can set it again")
            }
            Self::Drift => ("drift", "the rover may drift downhill by more than is accepted"),
            Self::FrictionMargin => {
                ("friction_margin", "the slope is too near to the soil's friction angle")
            }
            Self::FactorOfSafety => {
                ("factor_of_safety", "the ground itself stands with too small a factor of safety")
            }
            Self::TipsOver => ("tips_over", "the rover tips over at rest"),
            Self::NoStatedUncertainty => (
                "no_stated_uncertainty",
                "the soil's document does not state how uncertain its numbers are",
            ),
            Self::OutsideDomain => (
                "outside_domain",
                "most of the samples are outside the domain that their model was tested in",
            ),
            Self::SearchGaveUp => {
                ("search_gave_up", "the search gave up in samples that could decide")
            }
        }
    }
}

/// A verdict with what decides it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Judgement {
    /// The verdict.
    pub verdict: Verdict,
    /// The first condition that makes it so.
    pub reason: Reason,
    /// The limit that decides, of [`Reason::ShareThatHolds`].
    pub shortfall: Option<Shortfall>,
}

/// Too few samples in which a heading holds the course at an acceptable slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortfall {
    /// The slip ratio that is acceptable [-].
    pub slip_ratio: f64,
    /// Share of the samples that decides [-]: the least that must hold for a go, and from which on
    /// those that do not hold make a no-go.
    pub limit: f64,
    /// Share that there is [-]; `None` where the sentence is about several places.
    pub share: Option<f64>,
}

impl Judgement {
    /// Nothing speaks against it.
    pub(in super::super) const GO: Self = Self::new(Verdict::Go, Reason::AllMet);

    const fn new(verdict: Verdict, reason: Reason) -> Self {
        Self { verdict, reason, shortfall: None }
    }

    /// Takes a condition into account, if it is met.
    pub(in super::super) fn add(&mut self, is_met: bool, verdict: Verdict, reason: Reason) {
        if is_met && verdict > self.verdict {
            *self = Self::new(verdict, reason);
        }
    }

    /// Takes into account that too few samples hold, if so.
    pub(super) fn add_shortfall(&mut self, is_met: bool, verdict: Verdict, shortfall: Shortfall) {
        if is_met && verdict > self.verdict {
            let shortfall = Some(shortfall);
            *self = Self { shortfall, ..Self::new(verdict, Reason::ShareThatHolds) };
        }
    }

    /// The worse of two.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        if other.verdict > self.verdict { other } else { self }
    }

    /// This judgement for several places, such as all steeper slopes: without the share of one of
    /// them.
    #[must_use]
    pub fn of_several(self) -> Self {
        let shortfall = self.shortfall.map(|it| Shortfall { share: None, ..it });
        Self { shortfall, ..self }
    }

    /// What decides it, with the limit: the end of a sentence that begins with the verdict.
    #[must_use]
    pub fn meaning(self) -> String {
        let Some(Shortfall { slip_ratio, limit, share }) = self.shortfall else {
            return self.reason.meaning().to_owned();
        };
        let percent = |share: f64| format!("{} %", four_digits(100.0 * share));
        let (limit, at) = (percent(limit), four_digits(slip_ratio));
        let heading =
            |which| format!("{which} heading holds the course with a slip ratio up to {at}");
        match (self.verdict, share.map(percent)) {
            (Verdict::NoGo, Some(share)) => {
                format!("in {share} of the samples {}, and {limit} make a no-go", heading("no"))
            }
            (Verdict::NoGo, None) => {
                format!("in {limit} of the samples or more {}", heading("no"))
            }
            (_, Some(share)) => {
                format!("in {share} of the samples {}, and a go takes {limit}", heading("a"))
            }
            (_, None) => format!("in less than {limit} of the samples {}", heading("a")),
        }
    }

    /// Verdict and reason in a sentence without its full stop: `no-go: the rover tips over …`.
    #[must_use]
    pub fn sentence(self) -> String {
        format!("{}: {}", self.verdict.in_words(), self.meaning())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_verdict_wins_and_the_first_reason_for_it() {
        let mut found = Judgement::GO;
        found.add(false, Verdict::NoGo, Reason::TipsOver);
        assert_eq!(found, Judgement::GO);
        found.add(true, Verdict::Caution, Reason::Drift);
        found.add(true, Verdict::Caution, Reason::Stuck);
        assert_eq!(found, Judgement::new(Verdict::Caution, Reason::Drift));
        found.add(true, Verdict::CannotTell, Reason::OutsideDomain);
        let no_go = Judgement::new(Verdict::NoGo, Reason::Slides);
        assert_eq!((found.or(no_go), no_go.or(found)), (no_go, no_go));
        assert!(Verdict::ALL.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
