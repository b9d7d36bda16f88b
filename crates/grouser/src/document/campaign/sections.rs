//! The settings of a campaign's document.

use super::super::describe::uncertainty::Stated;
use super::super::describe::{soil, wheel};
use crate::contact::Theory;
use crate::simulation::Scenario;
use crate::soil::Soil;
use crate::studies::ensemble::design::Sampling;
use crate::wheel::Wheel;

/// The settings of a campaign.
#[derive(Clone, Debug)]
pub(in crate::document) struct Settings {
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
    pub(super) const BLANK: Self = Self {
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

/// The study that every run of a campaign computes.
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
pub(in crate::document) struct Stand {
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
    pub(in crate::document) const BLANK: Self = Self {
        soil: soil::BLANK,
        wheel: wheel::BLANK,
        theory: Theory::Ishigami,
        gravity: 0.0,
        load: 0.0,
        slip_ratio: 0.0,
        slip_angle: 0.0,
    };
}
