//! The settings of a campaign's document.

use super::mission::Plan;
use super::stated::Stated;
use grouser_core::contact::Model;
use grouser_core::simulation::Scenario;
use grouser_core::soil::Soil;
use grouser_core::wheel::Wheel;

/// The settings of a campaign.
#[derive(Clone, Debug)]
pub struct Settings {
    /// What every run computes.
    pub study: Study,
    /// How many runs; with `sensitivity`, how many points.
    pub runs: u64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Runs that are computed and written together.
    pub shard_runs: u64,
    /// How the samples are spread.
    pub sampling: Sampling,
    /// Whether the runs are laid out for Sobol indices.
    pub sensitivity: bool,
    /// Whether the soil's own uncertainty is sampled, too.
    pub soil_uncertainty: bool,
    /// Whether the wheel–soil model is drawn, too.
    pub model_uncertainty: bool,
    /// The other uncertain inputs.
    pub uncertain: Stated,
    /// The base that is varied: a scenario, a mission, or a stand.
    pub scenario: Option<Box<Scenario>>,
    /// The mission that is varied, in a study of missions.
    pub mission: Option<Box<Plan>>,
    /// The test stand that is varied, in a study of wheel tests.
    pub stand: Option<Stand>,
}

impl Settings {
    /// Before the document's are put in.
    pub(crate) const BLANK: Self = Self {
        study: Study::Traverse,
        runs: 0,
        seed: 0,
        shard_runs: 1,
        sampling: Sampling::MonteCarlo,
        sensitivity: false,
        soil_uncertainty: false,
        model_uncertainty: false,
        uncertain: Stated { samples: None, parameters: Vec::new(), correlations: Vec::new() },
        scenario: None,
        mission: None,
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
    /// A mission, and what became of each of its legs.
    Mission,
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
            Self::Mission => "mission",
            Self::WheelTest => "wheel-test",
        }
    }
}

/// A wheel on a test stand.
#[derive(Clone, Debug)]
pub struct Stand {
    /// Soil on the stand.
    pub soil: Soil,
    /// Wheel under test.
    pub wheel: Wheel,
    /// Wheel–soil model.
    pub model: Model,
    /// *g* [m/s²].
    pub gravity: f64,
    /// *W* [N].
    pub load: f64,
    /// *s* [-].
    pub slip_ratio: f64,
    /// *β* [rad].
    pub slip_angle: f64,
}
