//! The settings of a design's document: what is free, what is to be least, what is limited.

use super::describe::design::DESIGN;
use super::describe::scenario;
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::Inner as _;
use super::kind::Kind;
use super::loaded::Loaded;
use super::overrides::Overrides;
use super::priors;
use super::read::{Written, written};
use super::source::Source;
use super::tree::Node;
use super::unit::{DEG, J_PER_M, KG, NM, ONE, Unit};
use super::varied::{Key, Numbers as _, Varied};
use grouser_core::simulation::Scenario;

/// What is measured of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The steepest slope on which a heading holds the contour.
    LimitSlope,
    /// The deepest wheel's sinkage over its shearing radius, h/r_s.
    SinkageRatio,
    /// Slip ratio of the wheels.
    SlipRatio,
    /// Work of the wheels per metre of way.
    EnergyPerMetre,
    /// Yaw that holds the contour.
    Yaw,
    /// The largest torque of a wheel.
    Torque,
    /// Mass of all wheels.
    WheelMass,
}

/// The ends between which something may be, in SI; infinite where there is none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// The least that it may be.
    pub least: f64,
    /// The most that it may be.
    pub most: f64,
}

/// What a document says.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub(crate) scenario: Scenario,
    pub(crate) free: Vec<(String, [f64; 2])>,
    pub(crate) minimise: Measure,
    pub(crate) limits: [Ends; Measure::ALL.len()],
}

/// Numbers of a rover that are free, what is to be least, and what is limited.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignTask {
    /// The scenario whose numbers are free: of its slope, rover, soil, gravity and model.
    pub scenario: Varied<Scenario>,
    /// The numbers, each with the least and the most that it may be in its key's unit.
    pub free: Vec<(Key, [f64; 2])>,
    /// What is to be least.
    pub minimise: Measure,
    /// What is limited, in the order of [`Measure::ALL`].
    pub limits: [Ends; Measure::ALL.len()],
}

/// A design's task that was read.
pub type LoadedDesign = Loaded<DesignTask>;

impl Ends {
    /// No limit.
    pub const NONE: Self = Self { least: f64::NEG_INFINITY, most: f64::INFINITY };
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::LimitSlope,
        Self::SinkageRatio,
        Self::SlipRatio,
        Self::EnergyPerMetre,
        Self::Yaw,
        Self::Torque,
        Self::WheelMass,
    ];

    /// Its name in documents and answers.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LimitSlope => "limit_slope_deg",
            Self::SinkageRatio => "sinkage_ratio",
            Self::SlipRatio => "slip_ratio",
            Self::EnergyPerMetre => "energy_j_per_m",
            Self::Yaw => "yaw_deg",
            Self::Torque => "torque_nm",
            Self::WheelMass => "wheel_mass_kg",
        }
    }

    /// The unit that its name ends with.
    #[must_use]
    pub const fn unit(self) -> Unit {
        match self {
            Self::LimitSlope | Self::Yaw => DEG,
            Self::SinkageRatio | Self::SlipRatio => ONE,
            Self::EnergyPerMetre => J_PER_M,
            Self::Torque => NM,
            Self::WheelMass => KG,
        }
    }
}

impl Settings {
    fn of(document: &Document) -> Self {
        let mut settings = Self {
            scenario: scenario::blank(),
            free: Vec::new(),
            minimise: Measure::WheelMass,
            limits: [Ends::NONE; Measure::ALL.len()],
        };
        DESIGN.put(&mut settings, document.keys());
        settings
    }
}

/// Reads a design's task with its rover and soil.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_design(source: &Source, overrides: &Overrides) -> Result<LoadedDesign, DocumentError> {
    let Written { tree, document, assumptions } = written(Kind::Design, source, overrides)?;
    let Settings { free, minimise, limits, .. } = Settings::of(&document);
    let scenario = Varied::new(scenario_of(&document), &tree)?;
    let free = free.into_iter().map(|(path, ends)| {
        let key = free_key(&scenario, &path, ends, &tree)?;
        Ok((key, ends))
    });
    let free: Vec<(Key, [f64; 2])> = free.collect::<Result<_, DocumentError>>()?;
    check_limits(&limits, &tree)?;
    let soil = document.part(Kind::Soil, "soil");
    let assumed = soil.as_ref().map_or_else(Vec::new, priors::assumed);
    let value = DesignTask { scenario, free, minimise, limits };
    let (companions, notes) = (Vec::new(), Vec::new());
    Ok(Loaded { document, value, uncertain: None, assumptions, assumed, companions, notes })
}

/// The scenario that a design says its numbers of.
fn scenario_of(document: &Document) -> Document {
    const OWN: [&str; 8] =
        ["schema", "name", "source", "notes", "assumed", "minimise", "free", "subject_to"];
    let keys = document.keys().as_object().into_iter().flatten();
    let keys = keys.filter(|(key, _)| !OWN.contains(&key.as_str()));
    let given = keys.map(|(key, given)| (key.clone(), given.clone())).collect();
    Document::of(Kind::Scenario, &given)
}

/// The number under a key that is free, between ends that it may have.
fn free_key(
    scenario: &Varied<Scenario>,
    path: &str,
    [least, most]: [f64; 2],
    tree: &Node,
) -> Result<Key, DocumentError> {
    let origin = tree.entry("free").map_or(tree, |entry| &entry.node);
    let origin = origin.entry(path).map_or_else(|| origin.origin_of(path), |it| &it.node.origin);
    let key = scenario.key(path).map_err(|none| none.at(origin))?;
    for end in [least, most] {
        if !key.range.contains(&end) {
            return Err(DocumentError::at(origin, key.out_of_range(end)));
        }
    }
    if least >= most {
        let problem = Problem::Conflict("the first end of what is free is to be below the second");
        return Err(DocumentError::at(origin, problem));
    }
    Ok(key)
}

/// Checks that limits leave room.
fn check_limits(limits: &[Ends; Measure::ALL.len()], tree: &Node) -> Result<(), DocumentError> {
    for (measure, Ends { least, most }) in Measure::ALL.into_iter().zip(limits) {
        if least > most {
            let problem = Problem::Conflict("`at_least` is above `at_most`: nothing can be both");
            let path = format!("subject_to.{}", measure.name());
            return Err(DocumentError::at(tree.origin_of(&path), problem));
        }
    }
    Ok(())
}
