//! The document itself: its keys, their ranges and what they mean.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::super::scenario::ScenarioDocument;
use super::super::soil::{SoilDocument, TheoryWord};
use super::super::text::Node;
use super::super::uncertainty::CorrelationSection;
use super::super::wheel::WheelDocument;
use super::super::{Document, Overrides, Reference, unnamed};
use crate::studies::campaign::design::Sampling;
use crate::units::EARTH_GRAVITY;

/// Many runs of one study, over numbers that are not known exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CampaignDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: CampaignSchema,
    /// What it is there to show.
    #[serde(default = "unnamed")]
    pub name: String,
    /// Where the distributions come from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Anything else worth knowing.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// Values that the source does not give, each as `key: why this value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// What every run computes.
    pub study: StudyWord,
    /// How many runs; with `sensitivity`, how many points, each with two runs more than there are inputs.
    #[schemars(range(min = 1, max = MOST_RUNS))]
    pub runs: u64,
    /// Which draws of all that there could be.
    #[serde(default = "one")]
    #[schemars(range(min = 0, max = LARGEST_SEED))]
    pub seed: u64,
    /// Runs that are computed and written together.
    #[serde(default = "default_shard_runs")]
    #[schemars(range(min = 1, max = 1_000_000))]
    pub shard_runs: u64,
    /// How the draws are spread.
    #[serde(default)]
    pub sampling: SamplingWord,
    /// Whether the runs are laid out so that they tell Sobol indices.
    #[serde(default)]
    pub sensitivity: bool,
    /// Whether the soil's own `uncertainty` is drawn from, too.
    #[serde(default)]
    pub soil_uncertainty: bool,
    /// The run that is varied, for `traverse` and `attitude`: a preset's name, a path from this document's folder, or a scenario's keys.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Reference<ScenarioDocument>")]
    pub scenario: Option<Reference<ScenarioDocument>>,
    /// The stand that is varied, for `wheel-test`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "WheelTestSection")]
    pub wheel_test: Option<WheelTestSection>,
    /// Rows of numbers that belong together, such as a posterior's: each run takes one of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "SamplesSection")]
    pub samples: Option<SamplesSection>,
    /// The numbers that are not known exactly, each with its distribution.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub parameter: Vec<ParameterSection>,
    /// Correlations between them; pairs that are not named have none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub correlation: Vec<CorrelationSection>,
}

/// The most runs, or points. Source: ours; a thousand times what a machine computes in a day.
const MOST_RUNS: u64 = 1_000_000_000_000;
/// The largest seed that JSON keeps exactly.
const LARGEST_SEED: u64 = (1 << 53) - 1;

/// The `schema` of a campaign.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum CampaignSchema {
    /// This version.
    #[default]
    #[serde(rename = "campaign/1")]
    Version1,
}

/// What every run of a campaign computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StudyWord {
    /// A run of the scenario, and where it ends.
    Traverse,
    /// The yaw that keeps a traverse level on the scenario's slope.
    Attitude,
    /// A wheel on a test stand.
    WheelTest,
}

/// How draws are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SamplingWord {
    /// Independent draws.
    #[default]
    MonteCarlo,
    /// One draw in each of as many equal parts of every input's distribution as there are runs.
    LatinHypercube,
    /// The Sobol sequence, scrambled.
    Sobol,
}

impl SamplingWord {
    pub(super) fn to_domain(self) -> Sampling {
        match self {
            Self::MonteCarlo => Sampling::MonteCarlo,
            Self::LatinHypercube => Sampling::LatinHypercube,
            Self::Sobol => Sampling::Sobol,
        }
    }
}

/// A wheel on a test stand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WheelTestSection {
    /// The soil: a preset's name, a path from this document's folder, or a soil's keys.
    pub soil: Reference<SoilDocument>,
    /// The wheel: a preset's name, a path from this document's folder, or a wheel's keys.
    pub wheel: Reference<WheelDocument>,
    /// The theory; without it the soil's own, or else `ishigami`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TheoryWord")]
    pub model: Option<TheoryWord>,
    /// Gravity, g [m/s²].
    #[serde(default = "default_gravity")]
    #[schemars(range(min = 0.01, max = 30.0))]
    pub gravity_m_s2: f64,
    /// Load on the wheel, W [N].
    #[schemars(range(min = 0.0, max = 1e5))]
    pub load_n: f64,
    /// Slip ratio, s [-].
    #[schemars(range(min = -2.0, max = 2.0))]
    pub slip_ratio: f64,
    /// Slip angle, β; above 0 where the hub moves to the left [°].
    #[serde(default)]
    #[schemars(range(min = -90.0, max = 90.0))]
    pub slip_angle_deg: f64,
}

/// A number that is not known exactly. Its distribution is cut off at the ends of the key's range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "distribution", rename_all = "kebab-case", deny_unknown_fields)]
pub enum ParameterSection {
    /// Symmetric about its mean.
    Normal {
        /// A number of the base, with the tables it stands in: `soil.cohesion_kpa`.
        key: String,
        /// Its mean, in the unit of the key; without it, the base's value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(with = "f64", range(min = -1e12, max = 1e12))]
        mean: Option<f64>,
        /// Its standard deviation, in the unit of the key.
        #[schemars(range(min = 0.0, max = 1e12))]
        standard_deviation: f64,
    },
    /// Of a number above zero whose logarithm is normal.
    Lognormal {
        /// A number of the base, with the tables it stands in: `soil.cohesion_kpa`.
        key: String,
        /// Its mean, in the unit of the key; without it, the base's value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(with = "f64", range(max = 1e12), extend("exclusiveMinimum" = 0.0))]
        mean: Option<f64>,
        /// Its standard deviation, in the unit of the key.
        #[schemars(range(min = 0.0, max = 1e12))]
        standard_deviation: f64,
    },
    /// Every value between two alike.
    Uniform {
        /// A number of the base, with the tables it stands in: `soil.cohesion_kpa`.
        key: String,
        /// The lower end, in the unit of the key.
        #[schemars(range(min = -1e12, max = 1e12))]
        low: f64,
        /// The upper end, in the unit of the key.
        #[schemars(range(min = -1e12, max = 1e12))]
        high: f64,
    },
    /// Most likely at a value, less and less towards two ends.
    Triangular {
        /// A number of the base, with the tables it stands in: `soil.cohesion_kpa`.
        key: String,
        /// The lower end, in the unit of the key.
        #[schemars(range(min = -1e12, max = 1e12))]
        low: f64,
        /// The most likely value, in the unit of the key.
        #[schemars(range(min = -1e12, max = 1e12))]
        mode: f64,
        /// The upper end, in the unit of the key.
        #[schemars(range(min = -1e12, max = 1e12))]
        high: f64,
    },
}

impl ParameterSection {
    /// The key that it is about.
    #[must_use]
    pub fn key(&self) -> &str {
        match self {
            Self::Normal { key, .. }
            | Self::Lognormal { key, .. }
            | Self::Uniform { key, .. }
            | Self::Triangular { key, .. } => key,
        }
    }
}

/// Where samples are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum SamplesSection {
    /// A CSV file, from the folder of this document: columns are keys, rows are samples.
    File(String),
    /// The table itself.
    Inline(SampleRows),
}

/// A table of samples within a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SampleRows {
    /// What a CSV file would say: keys in the first line, a sample in every other.
    pub csv: String,
}

fn one() -> u64 {
    1
}

/// Seconds of work for a traverse, a fraction of one for an attitude; some hundred kilobytes.
fn default_shard_runs() -> u64 {
    1024
}

fn default_gravity() -> f64 {
    EARTH_GRAVITY
}

impl CampaignDocument {
    /// Adds what was assumed in the documents that it names without their saying so.
    pub(super) fn note_parts(&mut self, tree: &Node, overrides: &Overrides) {
        if let (Some(entry), Some(Reference::Inline(scenario))) =
            (tree.entry("scenario"), &mut self.scenario)
        {
            scenario.note(&entry.node, overrides);
        }
        let (Some(stand), Some(entry)) = (&mut self.wheel_test, tree.entry("wheel_test")) else {
            return;
        };
        if let (Some(entry), Reference::Inline(soil)) = (entry.node.entry("soil"), &mut stand.soil)
        {
            soil.note(&entry.node, overrides);
        }
        if let (Some(entry), Reference::Inline(wheel)) =
            (entry.node.entry("wheel"), &mut stand.wheel)
        {
            wheel.note(&entry.node, overrides);
        }
    }

    /// What is assumed in the documents that it names.
    pub(super) fn assumptions_of_parts(&self) -> Vec<String> {
        let scenario = self.scenario.as_ref().and_then(Reference::inline);
        let stand = self.wheel_test.as_ref();
        let soil = stand.and_then(|stand| stand.soil.inline());
        let wheel = stand.and_then(|stand| stand.wheel.inline());
        let all = [
            scenario.map(Document::assumptions),
            soil.map(Document::assumptions),
            wheel.map(Document::assumptions),
        ];
        all.into_iter().flatten().flatten().collect()
    }

    /// The soil that is varied.
    pub(super) fn soil(&self) -> Option<&SoilDocument> {
        match (&self.scenario, &self.wheel_test) {
            (Some(scenario), _) => scenario.inline()?.soil.inline(),
            (None, Some(stand)) => stand.soil.inline(),
            (None, None) => None,
        }
    }

    /// The same, to be changed.
    pub(super) fn soil_mut(&mut self) -> Option<&mut SoilDocument> {
        let reference = match (&mut self.scenario, &mut self.wheel_test) {
            (Some(Reference::Inline(scenario)), _) => &mut scenario.soil,
            (None, Some(stand)) => &mut stand.soil,
            _ => return None,
        };
        match reference {
            Reference::Inline(soil) => Some(soil),
            Reference::Named(_) => None,
        }
    }
}
