//! What a campaign's document says, and what its numbers go into.

use serde::{Deserialize, Serialize};

use super::super::describe::{soil, wheel};
use super::super::uncertainty::CorrelationSection;
use super::super::{Document, Kind};
use crate::contact::Theory;
use crate::simulation::Scenario;
use crate::soil::Soil;
use crate::studies::campaign::design::Sampling;
use crate::wheel::Wheel;

/// What a campaign is to do.
#[derive(Clone, Debug)]
pub(in crate::document) struct Settings {
    pub study: Study,
    /// How many runs; with `sensitivity`, how many points.
    pub runs: u64,
    pub seed: u64,
    pub shard_runs: u64,
    pub sampling: Sampling,
    pub sensitivity: bool,
    /// Whether the soil's own uncertainty is drawn from, too.
    pub soil_uncertainty: bool,
    /// What is varied: a scenario, or a stand.
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
        scenario: None,
        stand: None,
    };
}

/// What every run of a campaign computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Study {
    /// A run of the scenario, and where it ends.
    Traverse,
    /// The heading offset that holds the contour of the scenario's slope.
    Attitude,
    /// A wheel on a test stand.
    WheelTest,
}

impl Study {
    /// Its name in documents.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Traverse => "traverse",
            Self::Attitude => "heading",
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

/// What a campaign says of numbers that are not known exactly.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Uncertain {
    pub samples: Option<SamplesSection>,
    pub parameter: Vec<ParameterSection>,
    pub correlation: Vec<CorrelationSection>,
}

/// A number that is not known exactly. Its distribution is cut off at the ends of the key's range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "distribution", rename_all = "kebab-case")]
pub(super) enum ParameterSection {
    Normal { key: String, mean: Option<f64>, standard_deviation: f64 },
    Lognormal { key: String, mean: Option<f64>, standard_deviation: f64 },
    Uniform { key: String, low: f64, high: f64 },
    Triangular { key: String, low: f64, mode: f64, high: f64 },
}

impl ParameterSection {
    /// The key that it is about.
    pub(super) fn key(&self) -> &str {
        match self {
            Self::Normal { key, .. }
            | Self::Lognormal { key, .. }
            | Self::Uniform { key, .. }
            | Self::Triangular { key, .. } => key,
        }
    }
}

/// Where samples are.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub(super) enum SamplesSection {
    /// A CSV file, from the folder of the document: columns are keys, rows are samples.
    File(String),
    /// The table itself.
    Inline { csv: String },
}

/// The soil of what is varied.
///
/// * `place`: the key of the base
pub(super) fn soil_of(document: &Document, place: &str) -> Option<Document> {
    document.part(Kind::Soil, &format!("{place}.soil"))
}
