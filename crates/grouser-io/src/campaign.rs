//! The settings of a campaign's document.

use super::describe::uncertainty::Stated;
use super::describe::{soil, wheel};
use grouser_core::contact::Theory;
use grouser_core::simulation::Scenario;
use grouser_core::soil::Soil;
use grouser_core::wheel::Wheel;

/// The settings of a campaign.
#[derive(Clone, Debug)]
pub struct Settings {
    pub study: Study,
    /// How many runs; with `sensitivity`, how many points.
    pub runs: u64,
    pub seed: u64,
    pub shard_runs: u64,
    pub sampling: Sampling,
    pub sensitivity: bool,
    /// Whether the soil's own uncertainty is sampled, too.
    pub soil_uncertainty: bool,
    /// The other uncertain inputs.
    pub uncertain: Stated,
    /// The base that is varied: a scenario, or a stand.
    pub scenario: Option<Box<Scenario>>,
    pub stand: Option<Stand>,
}

impl Settings {
    /// Before the document's are put in.
    pub const BLANK: Self = Self {
        study: Study::Traverse,
        runs: 0,
        seed: 0,
        shard_runs: 1,
        sampling: Sampling::MonteCarlo,
        sensitivity: false,
        soil_uncertainty: false,
        uncertain: Stated { samples: None, parameters: Vec::new(), correlations: Vec::new() },
        scenario: None,
        stand: None,
    };
}

/// How points are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// Independent points.
    #[default]
    MonteCarlo,
    /// One point in each of N equal parts of every dimension.
    LatinHypercube,
    /// The Sobol sequence, scrambled; from a length points on, one after another, each
    /// scrambled anew.
    Sobol,
}

/// What every run of a campaign computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    /// A run of the scenario, and where it ends.
    Traverse,
    /// The heading offset that holds the contour of the scenario's slope.
    Heading,
    /// A wheel on a test stand.
    WheelTest,
}

impl Study {
    /// Its name in documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Traverse => "traverse",
            Self::Heading => "heading",
            Self::WheelTest => "wheel-test",
        }
    }
}

/// A wheel on a test stand.
#[derive(Clone, Debug)]
pub struct Stand {
    pub soil: Soil,
    pub wheel: Wheel,
    pub theory: Theory,
    /// *g* [m/s²].
    pub gravity: f64,
    /// *W* [N].
    pub load: f64,
    /// *s* [-].
    pub slip_ratio: f64,
    /// *β* [rad].
    pub slip_angle: f64,
}

impl Stand {
    /// Before its numbers are put in.
    pub const BLANK: Self = Self {
        soil: soil::BLANK,
        wheel: wheel::BLANK,
        theory: Theory::Ishigami,
        gravity: 0.0,
        load: 0.0,
        slip_ratio: 0.0,
        slip_angle: 0.0,
    };
}
