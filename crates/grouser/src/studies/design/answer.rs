//! What a search for a design comes to.

use grouser_io::statistics::NothingAccepted;

use super::limits::DesignLimit;
use super::measured::Measures;

/// A limit, and how a design keeps it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptLimit {
    /// The limit.
    pub limit: DesignLimit,
    /// What the design has, in SI; where the soil is uncertain, what it has or does better with the
    /// probability that is asked for.
    pub value: f64,
    /// By how much the aim falls if the limit is loosened by one, each in its unit; 0 for one that does
    /// not hold the design back.
    pub price: f64,
    /// The share of fresh samples that keeps it, where the soil is uncertain.
    pub share: Option<f64>,
}

/// A design that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct BestDesign {
    /// The rover, by its place among those that may be chosen.
    pub candidate: usize,
    /// The free numbers, in their keys' units.
    pub values: Vec<f64>,
    /// All numbers of the rover that it changes, by their keys: the free ones, and what the masses
    /// of the wheels follow from.
    pub numbers: Vec<(String, f64)>,
    /// The aim.
    pub objective: f64,
    /// What is measured of it on the first ground, on average over samples where there are any.
    pub measures: Measures,
    /// Every limit.
    pub kept: Vec<KeptLimit>,
    /// What shows that it is the least.
    pub certificate: Certificate,
}

/// What shows that a design is the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Searches that were started.
    pub starts: usize,
    /// Those that came to this design.
    pub agreed: usize,
    /// Designs around it that were looked at.
    pub probes: usize,
    /// Those that keep all limits and are better; none for a minimum.
    pub better: usize,
}

/// Why no design was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoDesign {
    /// No rover within the bounds moves, or none that was looked at.
    #[error("no rover that was looked at within these bounds moves on this ground")]
    NothingMoves,
    /// No design was found that keeps all limits.
    #[error("no design was found within these bounds that keeps every limit")]
    Unreachable(Box<Nearest>),
    /// No search came to an end.
    #[error(
        "no search for a design came to an end, from any start: this is no finding about rover and soil"
    )]
    NotFound,
    /// The aim does not depend on what is free.
    #[error("the aim does not depend on any number that is free")]
    Constant,
    /// A slope is to be crossed that is steeper than the ground itself stands.
    #[error("no rover crosses a slope on which the ground itself does not stand")]
    BeyondGround {
        /// The limit.
        limit: DesignLimit,
        /// The steepest slope on which that ground stands by its own strength [rad].
        stands: f64,
    },
    /// It was stopped on the way.
    #[error("the search for a design was stopped before its end")]
    Stopped,
    /// No soil can be drawn.
    #[error(transparent)]
    NoSample(#[from] NothingAccepted),
}

/// The design that comes nearest to keeping all limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Nearest {
    /// The rover, by its place among those that may be chosen.
    pub candidate: usize,
    /// The free numbers, in their keys' units.
    pub values: Vec<f64>,
    /// Limits that it misses, and what it has, in SI.
    pub missed: Vec<(DesignLimit, f64)>,
}
