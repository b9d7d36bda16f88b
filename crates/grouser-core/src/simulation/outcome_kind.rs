//! The ways in which a run, or a leg of a mission, ends: a table with a row for each.
//!
//! Terminal, page, log, Python and documentation read its name, its meaning and its severity here,
//! and a band over samples reads what the end counts as. The table is made with the enum: without
//! its row, no variant compiles.

/// A way in which a run, or a leg of a mission, ends: an [`Outcome`](super::Outcome) or a
/// [`LegOutcome`](crate::mission::LegOutcome) without its numbers.
///
/// Which ends of a run count as slip 1 in a band?
///
/// ```
/// use grouser_core::simulation::{InBand, OutcomeKind};
///
/// let stuck = OutcomeKind::ALL.iter().filter(|kind| kind.row().in_band == InBand::Stuck);
/// assert_eq!(stuck.map(|kind| kind.name()).collect::<Vec<_>>(), ["immobilised"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum OutcomeKind {
    /// What was asked for was done.
    Completed,
    /// A limit was passed.
    Stopped,
    /// A turn or an arc did not reach its yaw.
    FellShort,
    /// The rover no longer gets ahead.
    Immobilised,
    /// It slides downhill.
    Sliding,
    /// It tipped over.
    TippedOver,
    /// Its battery gave out.
    BrownOut,
    /// It left its map.
    OffTheMap,
    /// Its underside came to the ground.
    HighCentred,
}

/// What is known of all ends of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutcomeRow {
    /// One word, as documents and results have it: `off_map`.
    pub name: &'static str,
    /// What it means: a sentence without its full stop.
    pub meaning: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// What it counts as in a band over samples.
    pub in_band: InBand,
    /// Whether a run can end so; otherwise only a leg of a mission can.
    pub ends_runs: bool,
}

/// How bad an end is: writers choose a colour, or a level of a log, by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// What was asked for was done.
    Good,
    /// It was not done, and the rover can drive on.
    Stopped,
    /// The rover cannot drive on by itself.
    Stuck,
    /// The rover is out of control.
    Lost,
}

/// What a sample that ends so counts as in a band.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InBand {
    /// It counts as it is, to the end.
    Counts,
    /// From then on it counts as slip 1, sunk to the axles, at the place where it ended.
    Stuck,
    /// It counts until then, and leaves the band.
    Leaves,
}

/// The row of each kind, from which the list of all kinds is made too.
macro_rules! rows {
    ($($kind:ident { $($row:tt)* })+) => {
        impl OutcomeKind {
            /// All of them; that of a run that did what was asked for is the first.
            pub const ALL: [Self; [$(Self::$kind),+].len()] = [$(Self::$kind),+];

            /// What is known of it.
            #[must_use]
            pub const fn row(self) -> &'static OutcomeRow {
                match self {
                    $(Self::$kind => &OutcomeRow { $($row)* },)+
                }
            }
        }
    };
}

rows! {
    Completed {
        name: "completed",
        meaning: "The rover did what was asked for",
        severity: Severity::Good,
        in_band: InBand::Counts,
        ends_runs: true,
    }
    Stopped {
        name: "stopped",
        meaning: "A limit stopped the rover, or would have on the way ahead",
        severity: Severity::Stopped,
        in_band: InBand::Leaves,
        ends_runs: false,
    }
    FellShort {
        name: "fell_short",
        meaning: "A turn or an arc did not reach its yaw",
        severity: Severity::Stopped,
        in_band: InBand::Leaves,
        ends_runs: false,
    }
    Immobilised {
        name: "immobilised",
        meaning: "The rover is stuck: its wheels or motors no longer get it ahead, or a wheel sank \
                  to its axle",
        severity: Severity::Stuck,
        in_band: InBand::Stuck,
        ends_runs: true,
    }
    Sliding {
        name: "sliding",
        meaning: "The rover slides downhill faster than its wheels turn",
        severity: Severity::Lost,
        in_band: InBand::Leaves,
        ends_runs: true,
    }
    TippedOver {
        name: "tipped_over",
        meaning: "The rover's weight fell outside its wheels",
        severity: Severity::Lost,
        in_band: InBand::Leaves,
        ends_runs: true,
    }
    BrownOut {
        name: "brown_out",
        meaning: "The battery no longer gave what motors and electronics drew",
        severity: Severity::Stuck,
        in_band: InBand::Leaves,
        ends_runs: true,
    }
    OffTheMap {
        name: "off_map",
        meaning: "A wheel came to where the map has no heights",
        severity: Severity::Stopped,
        in_band: InBand::Leaves,
        ends_runs: true,
    }
    HighCentred {
        name: "high_centred",
        meaning: "The rover's underside came to the ground",
        severity: Severity::Stuck,
        in_band: InBand::Leaves,
        ends_runs: true,
    }
}

impl OutcomeKind {
    /// Number of kinds.
    pub const COUNT: usize = Self::ALL.len();

    /// One word, as documents and results have it: `off_map`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// The name in words: `off map`.
    #[must_use]
    pub fn in_words(self) -> String {
        self.name().replace('_', " ")
    }

    /// Kind of this name, if there is one.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Kinds with which a run can end.
    pub fn of_runs() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|kind| kind.row().ends_runs)
    }
}

impl Severity {
    /// All of them, the best first.
    pub const ALL: [Self; 4] = [Self::Good, Self::Stopped, Self::Stuck, Self::Lost];

    /// One word: `good`, `stopped`, `stuck` or `lost`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Stopped => "stopped",
            Self::Stuck => "stuck",
            Self::Lost => "lost",
        }
    }
}

impl InBand {
    /// One word: `counts`, `stuck` or `leaves`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Counts => "counts",
            Self::Stuck => "stuck",
            Self::Leaves => "leaves",
        }
    }

    /// What becomes of the sample in a band from its end on.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Counts => "counts as it is",
            Self::Stuck => "counts from then on as slip 1, sunk to the axles, where it ended",
            Self::Leaves => "leaves the band then",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A kind that is numbered by its place in the list can be counted in an array.
    #[test]
    fn kinds_stand_in_their_order_and_have_names_of_their_own() {
        for (place, kind) in OutcomeKind::ALL.iter().enumerate() {
            assert_eq!(*kind as usize, place);
            assert_eq!(OutcomeKind::of_name(kind.name()), Some(*kind));
        }
    }
}
