//! `data-set/1`: what a file of measurements was measured with, so that theories can be judged by
//! it without being told.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::{DocumentError, Problem};
use super::measurements::Condition;
use super::text::{Node, Value};
use super::{
    Document, Kind, LoadedSoil, LoadedWheel, Overrides, Source, blame_name, not_stated,
    note_birthplace, read_soil, read_wheel, told_by, unnamed,
};

/// A file of measured wheel tests, and the wheels and soils in it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DataSetDocument {
    /// Kind and version of this document.
    #[serde(default)]
    pub schema: DataSetSchema,
    /// What people call it.
    #[serde(default = "unnamed")]
    pub name: String,
    /// Who measured it, and where it is public.
    #[serde(default = "not_stated")]
    pub source: String,
    /// Anything else worth knowing.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub notes: String,
    /// What is assumed, each as `key: why this value`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub assumed: Vec<String>,
    /// The CSV file with its rows, from the folder of this document.
    pub file: String,
    /// Gravity where it was measured [m/s²].
    #[serde(default = "earth")]
    #[schemars(range(min = 0.01, max = 30.0))]
    pub gravity_m_s2: f64,
    /// Its parts, each with one wheel.
    #[schemars(length(min = 1))]
    pub case: Vec<CaseSection>,
}

/// The `schema` of a data set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum DataSetSchema {
    /// This version.
    #[default]
    #[serde(rename = "data-set/1")]
    Version1,
}

/// A part of a data set: one wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseSection {
    /// What people call it.
    pub name: String,
    /// The wheel: a preset, or a path from the folder of this document.
    pub wheel: String,
    /// Which rows of the file belong to it, such as `wheel=smooth`; all conditions together.
    #[serde(default, rename = "where", skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<String>,
    /// Soils to judge: presets, or paths. A soil that names its `model` is judged with it, another
    /// with every theory.
    #[schemars(length(min = 1))]
    pub soils: Vec<String>,
}

/// A part of a data set, with its documents read.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSetCase {
    /// What people call it.
    pub name: String,
    /// Which rows of the file belong to it.
    pub conditions: Vec<Condition>,
    /// The wheel.
    pub wheel: LoadedWheel,
    /// The soils, each with the name it was found by.
    pub soils: Vec<(String, LoadedSoil)>,
}

impl Document for DataSetDocument {
    const KIND: Kind = Kind::DataSet;
    type Value = Vec<DataSetCase>;

    fn to_domain(&self, tree: &Node) -> Result<Vec<DataSetCase>, DocumentError> {
        let nodes = match tree.entry("case").map(|entry| &entry.node.value) {
            Some(Value::List(nodes)) => nodes.as_slice(),
            _ => &[],
        };
        self.case.iter().zip(nodes).map(|(case, node)| case.read(node)).collect()
    }

    fn note(&mut self, tree: &Node, overrides: &Overrides) {
        note_birthplace(Self::KIND, tree, overrides, &mut self.assumed);
    }

    fn assumptions(&self) -> Vec<String> {
        told_by(Self::KIND, &self.name, &self.assumed, &self.source)
    }
}

impl CaseSection {
    fn read(&self, node: &Node) -> Result<DataSetCase, DocumentError> {
        let none = Overrides::none();
        let find = |kind: Kind, key: &str, name: &str| {
            let origin = node.origin_of(key).clone();
            let source = Source::find_from(&origin.text.folder, kind, name)
                .map_err(|error| error.seen_from(&origin))?;
            Ok((source, origin))
        };
        let soil = |(place, name): (usize, &String)| {
            let (source, origin) = find(Kind::Soil, &format!("soils.{place}"), name)?;
            let loaded =
                read_soil(&source, &none).map_err(|error| blame_name(error, &origin, &source))?;
            Ok((name.clone(), loaded))
        };
        let wheel = || {
            let (source, origin) = find(Kind::Wheel, "wheel", &self.wheel)?;
            read_wheel(&source, &none).map_err(|error| blame_name(error, &origin, &source))
        };
        let condition = |text: &String| {
            Condition::parse(text).map_err(|_| {
                let problem = Problem::NotAllowed {
                    key: "where".to_owned(),
                    value: text.clone(),
                    allowed: "column=value,value or column!=value,value".to_owned(),
                };
                DocumentError::at(node.origin_of("where"), problem)
            })
        };
        Ok(DataSetCase {
            name: self.name.clone(),
            conditions: self.conditions.iter().map(condition).collect::<Result<_, _>>()?,
            wheel: wheel()?,
            soils: self.soils.iter().enumerate().map(soil).collect::<Result<_, DocumentError>>()?,
        })
    }
}

fn earth() -> f64 {
    crate::units::EARTH_GRAVITY
}
