//! `rover/1`: a body and its wheels.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DocumentError, Problem};
use super::text::Node;
use super::wheel::WheelDocument;
use super::{Document, Kind, Overrides, Reference, not_stated, note_birthplace, told_by, unnamed};
use crate::units::Vec3;
use crate::vehicle::{Body, Inertia, Mount, Rover, WheelUnit};

/// A body and three or more equal wheels, rigidly joined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoverDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: RoverSchema,
    /// What people call it.
    #[serde(default = "unnamed")]
    pub name: String,
    /// Where the values come from.
    #[serde(default = "not_stated")]
    pub source: String,
    /// Anything else worth knowing.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// Values that the source does not give, each as `key: why this value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// The body, without its wheels.
    pub body: BodySection,
    /// A wheel with its motor; all are the same.
    pub wheel_unit: WheelUnitSection,
    /// Where the wheels sit: three or more, hubs of one height, not in one line.
    #[schemars(length(min = 3))]
    pub mount: Vec<MountSection>,
}

/// The `schema` of a rover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum RoverSchema {
    /// This version.
    #[default]
    #[serde(rename = "rover/1")]
    Version1,
}

/// The body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodySection {
    /// Mass [kg].
    #[schemars(range(min = 0.01, max = 1e5))]
    pub mass_kg: f64,
    /// Moments of inertia about its centre of mass [kg·m²].
    pub inertia_kg_m2: InertiaSection,
}

/// A wheel with its motor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WheelUnitSection {
    /// Mass [kg].
    #[schemars(range(min = 0.01, max = 1e5))]
    pub mass_kg: f64,
    /// Moments of inertia about its hub [kg·m²].
    pub inertia_kg_m2: InertiaSection,
    /// Its geometry: a preset's name, a path from this document's folder, or a wheel's keys.
    pub wheel: Reference<WheelDocument>,
}

/// Moments of inertia about the principal axes [kg·m²].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InertiaSection {
    /// About x, forward [kg·m²].
    #[schemars(range(min = 1e-9, max = 1e9))]
    pub xx: f64,
    /// About y, to the left [kg·m²].
    #[schemars(range(min = 1e-9, max = 1e9))]
    pub yy: f64,
    /// About z, up [kg·m²].
    #[schemars(range(min = 1e-9, max = 1e9))]
    pub zz: f64,
}

/// Where a wheel sits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MountSection {
    /// The wheel's name, such as `front-left`; no two alike.
    #[schemars(length(min = 1))]
    pub name: String,
    /// The wheel's centre from the body's centre of mass: x forward, y left, z up [m].
    #[schemars(inner(range(min = -100.0, max = 100.0)))]
    pub position_m: [f64; 3],
}

impl Document for RoverDocument {
    const KIND: Kind = Kind::Rover;
    type Value = Rover;

    fn to_domain(&self, tree: &Node) -> Result<Rover, DocumentError> {
        let Some(wheel) = self.wheel_unit.wheel.inline() else {
            let key = "wheel_unit.wheel".to_owned();
            let problem = Problem::MissingKey { key };
            return Err(DocumentError::at(tree.origin_of("wheel_unit.wheel"), problem));
        };
        self.check_names(tree)?;
        let body = Body { mass: self.body.mass_kg, inertia: self.body.inertia_kg_m2.to_domain() };
        let wheel_unit = WheelUnit {
            mass: self.wheel_unit.mass_kg,
            inertia: self.wheel_unit.inertia_kg_m2.to_domain(),
            wheel: wheel.wheel(),
        };
        let mounts = self.mount.iter().map(MountSection::to_domain).collect();
        // Masses and lengths are in their ranges by now: what can still be wrong is the stance.
        Rover::new(body, wheel_unit, mounts).map_err(|error| {
            let origin = tree.origin_of(&self.uneven_mount());
            DocumentError::at(origin, Problem::Unfit(error))
        })
    }

    fn note(&mut self, tree: &Node, overrides: &Overrides) {
        note_birthplace(Self::KIND, tree, overrides, &mut self.assumed);
        let wheel = tree.entry("wheel_unit").and_then(|unit| unit.node.entry("wheel"));
        if let (Some(entry), Reference::Inline(document)) = (wheel, &mut self.wheel_unit.wheel) {
            document.note(&entry.node, overrides);
        }
    }

    fn assumptions(&self) -> Vec<String> {
        let wheel = self.wheel_unit.wheel.inline().map(Document::assumptions);
        let own = told_by(Self::KIND, &self.name, &self.assumed, &self.source);
        own.into_iter().chain(wheel.into_iter().flatten()).collect()
    }
}

impl RoverDocument {
    /// Leaves the numbers alone, and the names of the wheels.
    pub(super) fn forget_words(&mut self) {
        self.assumed.clear();
        for text in [&mut self.name, &mut self.source, &mut self.notes] {
            text.clear();
        }
        if let Reference::Inline(wheel) = &mut self.wheel_unit.wheel {
            wheel.forget_words();
        }
    }

    /// That every wheel can be told from the others: columns and messages name them.
    fn check_names(&self, tree: &Node) -> Result<(), DocumentError> {
        for (index, mount) in self.mount.iter().enumerate() {
            if self.mount[..index].iter().any(|other| other.name == mount.name) {
                let key = format!("mount.{index}.name");
                let name = mount.name.escape_debug().to_string();
                let problem = Problem::RepeatedName { key: key.clone(), name };
                return Err(DocumentError::at(tree.origin_of(&key), problem));
            }
        }
        Ok(())
    }

    /// The first wheel that hangs higher or lower than the first one, or else all of them.
    fn uneven_mount(&self) -> String {
        let height = self.mount.first().map_or(0.0, |mount| mount.position_m[2]);
        match self.mount.iter().position(|mount| mount.position_m[2] != height) {
            Some(index) => format!("mount.{index}.position_m"),
            None => "mount.0".to_owned(),
        }
    }
}

impl InertiaSection {
    fn to_domain(&self) -> Inertia {
        Inertia { xx: self.xx, yy: self.yy, zz: self.zz }
    }
}

impl MountSection {
    fn to_domain(&self) -> Mount {
        let [x, y, z] = self.position_m;
        Mount { name: self.name.clone(), position: Vec3::new(x, y, z) }
    }
}
