//! `scenario/1`: a run. Every key has a default, and together the defaults are the source paper's
//! experiment on a slope of 10° without compensation.

use std::ops::RangeInclusive;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DocumentError, Problem};
use super::rover::RoverDocument;
use super::soil::{SoilDocument, TheoryWord};
use super::text::Node;
use super::{
    Companion, DEFAULT_ROVER, DEFAULT_SOIL, Document, Kind, Overrides, Reference, told_by, unnamed,
};
use crate::error::ParameterError;
use crate::simulation::scenario::LONGEST_DURATION;
use crate::simulation::{Approach, Motion, Numerics, Scenario, Start};
use crate::site::Site;
use crate::units::EARTH_GRAVITY;
use crate::vehicle::drive::SlipTarget;
use crate::vehicle::{DriveLaw, LoadSharing, OwnMoments};

/// The fastest rim [m/s]. The theories are quasi-static: this is far beyond what they know.
pub(super) const FASTEST: f64 = 10.0;

/// Allowed speeds of a rim, ω r_s [m/s].
pub const RIM_SPEED_M_S: RangeInclusive<f64> = -FASTEST..=FASTEST;

/// One run of one rover on one plane of soil.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScenarioDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: ScenarioSchema,
    /// What it is there to show.
    #[serde(default = "unnamed")]
    pub name: String,
    /// Where the values come from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Anything else worth knowing.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// Values that the source does not give, each as `key: why this value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// The rover: a preset's name, a path from this document's folder, or a rover's keys.
    #[serde(default = "default_rover")]
    pub rover: Reference<RoverDocument>,
    /// The soil: a preset's name, a path from this document's folder, or a soil's keys.
    #[serde(default = "default_soil")]
    pub soil: Reference<SoilDocument>,
    /// The theory; without it the soil's own, or else `ishigami`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "TheoryWord")]
    pub model: Option<TheoryWord>,
    /// Gravity, g [m/s²].
    #[serde(default = "default_gravity")]
    #[schemars(range(min = 0.01, max = 30.0))]
    pub gravity_m_s2: f64,
    /// Inclination of the plane, α [°].
    #[serde(default = "default_slope")]
    #[schemars(range(min = 0.0, max = 60.0))]
    pub slope_deg: f64,
    /// How long the run lasts [s].
    #[serde(default = "default_duration")]
    #[schemars(range(max = LONGEST_DURATION), extend("exclusiveMinimum" = 0.0))]
    pub duration_s: f64,
    /// Time between two recorded samples [s].
    #[serde(default = "default_sample_interval")]
    #[schemars(range(min = 1e-3, max = 3600.0))]
    pub sample_interval_s: f64,
    /// How the weight is shared among the wheels.
    #[serde(default)]
    pub loads: LoadsWord,
    /// Whether the wheels' own overturning and aligning moments act on the rover.
    #[serde(default)]
    pub moments: MomentsWord,
    /// Whether velocities are integrated or in balance.
    #[serde(default)]
    pub simulation: SimulationWord,
    /// What turns the wheels.
    #[serde(default)]
    pub drive: DriveSection,
    /// How the run starts.
    #[serde(default)]
    pub start: StartSection,
}

/// The `schema` of a scenario.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ScenarioSchema {
    /// This version.
    #[default]
    #[serde(rename = "scenario/1")]
    Version1,
}

/// What moves load from wheel to wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LoadsWord {
    /// The weight's pull along the slope, in pitch and roll.
    #[default]
    QuasiStatic,
    /// The same, with the wheels' torque in the pitch balance.
    QuasiStaticTorque,
    /// Equal loads.
    Uniform,
}

/// What becomes of the wheels' own moments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MomentsWord {
    /// They are reported only.
    #[default]
    Neglected,
    /// They act on the rover.
    Included,
}

/// Where velocities come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SimulationWord {
    /// They are integrated with the pose.
    #[default]
    Dynamic,
    /// They are those at which nothing accelerates: fast; where that is not valid, dynamic.
    QuasiSteady,
}

/// What turns the wheels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum DriveSection {
    /// Constant wheel speeds, as in the source's experiments.
    Constant(ConstantSection),
    /// Eq. 18 of the source as printed.
    Eq18AsPrinted(Eq18AsPrintedSection),
    /// Eq. 18 of the source, corrected.
    Eq18(Eq18Section),
}

/// Constant wheel speeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstantSection {
    /// The law; may be left out.
    #[serde(default)]
    pub law: ConstantWord,
    /// Speed of the rim, (r + h_g) ω [m/s]; a list gives one for each mount, in their order.
    #[serde(default)]
    pub speed_m_s: Speeds,
}

/// Eq. 18 as printed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Eq18AsPrintedSection {
    /// The law.
    pub law: Eq18AsPrintedWord,
    /// Desired speed along the contour, v_des [m/s].
    #[serde(default = "default_speed")]
    #[schemars(range(max = FASTEST), extend("exclusiveMinimum" = 0.0))]
    pub speed_m_s: f64,
    /// Reference slip ratio, s_ref [-].
    #[serde(default = "default_reference_slip")]
    #[schemars(range(min = 0.0, max = 0.95))]
    pub reference_slip_ratio: f64,
}

/// Eq. 18, corrected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Eq18Section {
    /// The law.
    pub law: Eq18Word,
    /// Desired speed along the contour, v_des [m/s].
    #[serde(default = "default_speed")]
    #[schemars(range(max = FASTEST), extend("exclusiveMinimum" = 0.0))]
    pub speed_m_s: f64,
    /// Reference slip ratio, s_ref [-].
    #[serde(default = "default_reference_slip")]
    #[schemars(range(min = 0.0, max = 0.95))]
    pub reference_slip_ratio: f64,
}

/// The name of the constant drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ConstantWord {
    /// Constant wheel speeds.
    #[default]
    Constant,
}

/// The name of Eq. 18 as printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Eq18AsPrintedWord {
    /// As printed.
    #[serde(rename = "eq18-as-printed")]
    Eq18AsPrinted,
}

/// The name of the corrected Eq. 18.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Eq18Word {
    /// Corrected.
    #[serde(rename = "eq18")]
    Eq18,
}

/// One speed for all wheels, or one for each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Speeds {
    /// Rim speed of every wheel [m/s].
    All(#[schemars(range(min = -FASTEST, max = FASTEST))] f64),
    /// Rim speed of each mount's wheel, in the mounts' order [m/s].
    Each(#[schemars(inner(range(min = -FASTEST, max = FASTEST)))] Vec<f64>),
}

/// How the run starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartSection {
    /// Yaw, γ; above 0 with the nose uphill [°].
    #[serde(default)]
    #[schemars(range(min = -180.0, max = 180.0))]
    pub yaw_deg: f64,
    /// Whether the rover already moves.
    #[serde(default)]
    pub motion: MotionWord,
}

/// Motion at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MotionWord {
    /// The hubs move at 0.95 of the rim speed along the body's x axis.
    #[default]
    Rolling,
    /// Nothing moves but the wheels.
    Rest,
}

impl Default for Speeds {
    fn default() -> Self {
        Self::All(default_speed())
    }
}

impl Default for DriveSection {
    fn default() -> Self {
        let law = ConstantWord::Constant;
        Self::Constant(ConstantSection { law, speed_m_s: Speeds::default() })
    }
}

fn default_rover() -> Reference<RoverDocument> {
    Reference::Named(DEFAULT_ROVER.to_owned())
}

fn default_soil() -> Reference<SoilDocument> {
    Reference::Named(DEFAULT_SOIL.to_owned())
}

fn default_gravity() -> f64 {
    EARTH_GRAVITY
}

/// The slope on which the source's Table 4 is best met [°].
fn default_slope() -> f64 {
    10.0
}

fn default_sample_interval() -> f64 {
    Numerics::default().sample_interval
}

/// About the length of the source's runs, which is not printed [s].
fn default_duration() -> f64 {
    20.0
}

/// Source: [FourWheel], section 5.2: "each wheel speed is set at 6 cm/s" [m/s].
fn default_speed() -> f64 {
    0.06
}

/// Source: [FourWheel], section 3: s_ref is chosen at 0.2 [-].
fn default_reference_slip() -> f64 {
    0.2
}

impl Document for ScenarioDocument {
    const KIND: Kind = Kind::Scenario;
    type Value = Scenario;

    fn to_domain(&self, tree: &Node) -> Result<Scenario, DocumentError> {
        let rover = part(tree, "rover", &self.rover)?;
        let soil = part(tree, "soil", &self.soil)?;
        let theory = self.model.map(TheoryWord::theory).or(soil.document.theory());
        let scenario = Scenario {
            rover: rover.document.to_domain(rover.tree)?,
            site: Site {
                soil: soil.document.to_domain(soil.tree)?,
                slope: self.slope_deg.to_radians(),
                gravity: self.gravity_m_s2,
            },
            theory: theory.unwrap_or_default(),
            sharing: self.loads.to_domain(),
            own_moments: self.moments.to_domain(),
            drive: self.drive.to_domain(),
            start: Start {
                yaw: self.start.yaw_deg.to_radians(),
                motion: self.start.motion.to_domain(),
            },
            duration: self.duration_s,
            numerics: Numerics {
                approach: self.simulation.to_domain(),
                sample_interval: self.sample_interval_s,
                ..Numerics::default()
            },
        };
        let at = |path: &'static str| {
            move |error: ParameterError| {
                DocumentError::at(tree.origin_of(path), Problem::Unfit(error))
            }
        };
        check_sample_count(self.duration_s, self.sample_interval_s)
            .map_err(at("sample_interval_s"))?;
        scenario.drive.check(&scenario.rover).map_err(|error| {
            let names: Vec<_> =
                scenario.rover.mounts().iter().map(|mount| mount.name.as_str()).collect();
            at("drive.speed_m_s")(error)
                .with_hint(format!("the wheels are {}, in this order", names.join(", ")))
        })?;
        scenario.check().map_err(at("schema"))?;
        Ok(scenario)
    }

    fn prepare(&mut self, tree: &Node) -> Result<(), DocumentError> {
        match (tree.entry("soil"), &mut self.soil) {
            (Some(entry), Reference::Inline(soil)) => soil.prepare(&entry.node),
            _ => Ok(()),
        }
    }

    fn companions(&self) -> Vec<Companion> {
        self.soil.inline().map_or(Vec::new(), Document::companions)
    }

    fn note(&mut self, tree: &Node, overrides: &Overrides) {
        if let (Some(entry), Reference::Inline(rover)) = (tree.entry("rover"), &mut self.rover) {
            rover.note(&entry.node, overrides);
        }
        if let (Some(entry), Reference::Inline(soil)) = (tree.entry("soil"), &mut self.soil) {
            soil.note(&entry.node, overrides);
        }
    }

    fn assumptions(&self) -> Vec<String> {
        let own = told_by(Self::KIND, &self.name, &self.assumed, &self.source);
        let rover = self.rover.inline().map(Document::assumptions);
        let soil = self.soil.inline().map(Document::assumptions);
        own.into_iter()
            .chain(rover.into_iter().flatten())
            .chain(soil.into_iter().flatten())
            .collect()
    }
}

/// The most samples that a run records: with those of a rover's wheels, about a gigabyte.
const MOST_SAMPLES: f64 = 1e6;

pub(super) fn check_sample_count(duration: f64, interval: f64) -> Result<(), ParameterError> {
    let count = (duration / interval).ceil();
    if count <= MOST_SAMPLES {
        return Ok(());
    }
    let name = "the number of samples, duration_s / sample_interval_s,";
    Err(ParameterError::new(name, count, "at most 1000000"))
}

/// A document inside the scenario, and the part of the tree it was made from.
struct FoundPart<'a, D> {
    document: &'a D,
    tree: &'a Node,
}

fn part<'a, D>(
    tree: &'a Node,
    key: &str,
    reference: &'a Reference<D>,
) -> Result<FoundPart<'a, D>, DocumentError> {
    if let (Some(entry), Some(document)) = (tree.entry(key), reference.inline()) {
        return Ok(FoundPart { document, tree: &entry.node });
    }
    let problem = Problem::MissingKey { key: key.to_owned() };
    Err(DocumentError::at(tree.origin_of(key), problem))
}

impl LoadsWord {
    /// The domain's word.
    #[must_use]
    pub fn to_domain(self) -> LoadSharing {
        match self {
            Self::QuasiStatic => LoadSharing::QuasiStatic,
            Self::QuasiStaticTorque => LoadSharing::QuasiStaticTorque,
            Self::Uniform => LoadSharing::Uniform,
        }
    }
}

impl MomentsWord {
    /// The domain's word.
    #[must_use]
    pub fn to_domain(self) -> OwnMoments {
        match self {
            Self::Neglected => OwnMoments::Neglected,
            Self::Included => OwnMoments::Included,
        }
    }
}

impl SimulationWord {
    fn to_domain(self) -> Approach {
        match self {
            Self::Dynamic => Approach::Dynamic,
            Self::QuasiSteady => Approach::QuasiSteady,
        }
    }
}

impl MotionWord {
    fn to_domain(self) -> Motion {
        match self {
            Self::Rolling => Motion::Rolling,
            Self::Rest => Motion::Rest,
        }
    }
}

impl DriveSection {
    fn to_domain(&self) -> DriveLaw {
        match self {
            Self::Constant(ConstantSection { speed_m_s: Speeds::All(speed), .. }) => {
                DriveLaw::Constant(*speed)
            }
            Self::Constant(ConstantSection { speed_m_s: Speeds::Each(speeds), .. }) => {
                DriveLaw::ConstantEach(speeds.clone())
            }
            Self::Eq18AsPrinted(section) => DriveLaw::Eq18AsPrinted(SlipTarget {
                speed: section.speed_m_s,
                slip_ratio: section.reference_slip_ratio,
            }),
            Self::Eq18(section) => DriveLaw::Eq18(SlipTarget {
                speed: section.speed_m_s,
                slip_ratio: section.reference_slip_ratio,
            }),
        }
    }
}
