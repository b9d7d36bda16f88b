//! `wheel/1`: the geometry of a wheel.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DocumentError, Problem};
use super::text::Node;
use super::{Document, Kind, Overrides, not_stated, note_birthplace, told_by, unnamed};
use crate::wheel::{Grousers, Wheel};

/// A rigid wheel with a flat rim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WheelDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: WheelSchema,
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
    /// Radius of the rim, without grousers, r [m].
    #[schemars(range(min = 0.01, max = 1.0))]
    pub radius_m: f64,
    /// Width of the rim, b [m].
    #[schemars(range(min = 0.01, max = 1.0))]
    pub width_m: f64,
    /// Bars across the rim; left out for a smooth wheel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "GrousersSection")]
    pub grousers: Option<GrousersSection>,
}

/// The `schema` of a wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum WheelSchema {
    /// This version.
    #[default]
    #[serde(rename = "wheel/1")]
    Version1,
}

/// Bars across the rim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrousersSection {
    /// Height over the rim, h_g [m].
    #[schemars(range(min = 0.0, max = 0.1))]
    pub height_m: f64,
    /// How many there are.
    #[schemars(range(min = 1, max = 10_000))]
    pub count: u32,
}

impl WheelDocument {
    /// Leaves the numbers alone.
    pub(super) fn forget_words(&mut self) {
        self.assumed.clear();
        for text in [&mut self.name, &mut self.source, &mut self.notes] {
            text.clear();
        }
    }

    pub(super) fn wheel(&self) -> Wheel {
        let grousers = self.grousers.as_ref();
        Wheel {
            radius: self.radius_m,
            width: self.width_m,
            grousers: grousers.map(|bars| Grousers { height: bars.height_m, count: bars.count }),
        }
    }
}

impl Document for WheelDocument {
    const KIND: Kind = Kind::Wheel;
    type Value = Wheel;

    fn to_domain(&self, tree: &Node) -> Result<Wheel, DocumentError> {
        let wheel = self.wheel();
        wheel.check().map_err(|error| DocumentError::at(&tree.origin, Problem::Unfit(error)))?;
        Ok(wheel)
    }

    fn note(&mut self, tree: &Node, overrides: &Overrides) {
        note_birthplace(Self::KIND, tree, overrides, &mut self.assumed);
    }

    fn assumptions(&self) -> Vec<String> {
        told_by(Self::KIND, &self.name, &self.assumed, &self.source)
    }
}
