//! `data-set/1`: wheel or rover, soils and gravity of a file of measurements, so that models can be
//! compared with it.

use serde::Deserialize;

use super::describe::data_set::{Common, DATA_SET};
use super::error::{DocumentError, Problem};
use super::field::Inner;
use super::kind::Kind;
use super::loaded::Loaded;
use super::measurements::Condition;
use super::overrides::Overrides;
use super::read::{
    LoadedRover, LoadedSoil, LoadedWheel, Written, blame_name, read_rover, read_soil, read_wheel,
    written,
};
use super::source::Source;
use super::tree::{Node, Value};
use grouser_core::wheel::Wheel;

/// A file of measured wheel tests, or of a rover on slopes, and the wheels, rovers and soils in it.
///
/// With which wheels were the tests of the data set `cmu-single-wheel` made, and under which
/// gravity?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_data_set};
///
/// let source = Source::find(Kind::DataSet, "cmu-single-wheel")?;
/// let data_set = read_data_set(&source, &Overrides::none())?.value;
/// let radius = |case: &grouser_io::DataSetCase| {
///     let wheel = case.tested.wheel()?;
///     Some(format!("{}: {:.1} mm", case.name, 1e3 * wheel.value.shearing_radius()))
/// };
/// let wheels: Vec<String> = data_set.cases.iter().filter_map(radius).collect();
/// assert_eq!(wheels.join(", "), "smooth: 62.5 mm, grousers: 62.5 mm");
/// assert_eq!(format!("{:.2} m/s²", data_set.gravity), "9.81 m/s²");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DataSet {
    /// The CSV file with its rows, from the folder of this document.
    pub file: String,
    /// Gravity where it was measured, *g* [m/s²].
    pub gravity: f64,
    /// Its parts, each with one wheel or one rover.
    pub cases: Vec<DataSetCase>,
}

/// A data set that was read.
pub type LoadedDataSet = Loaded<DataSet>;

/// A part as the document names it.
#[derive(Deserialize)]
struct CaseSection {
    name: String,
    wheel: Option<String>,
    rover: Option<String>,
    #[serde(default, rename = "where")]
    conditions: Vec<String>,
    soils: Vec<String>,
    #[serde(default)]
    fitted: Vec<String>,
}

/// A part of a data set, with its documents read.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSetCase {
    /// Its name.
    pub name: String,
    /// Which rows of the file belong to it.
    pub conditions: Vec<Condition>,
    /// What was tested.
    pub tested: Tested,
    /// The name that it was found by.
    pub tested_name: String,
    /// The soils, each with the name it was found by.
    pub soils: Vec<(String, LoadedSoil)>,
    /// The names of those of the soils that were fitted to these rows.
    pub fitted: Vec<String>,
}

/// What a part of a data set is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Tested {
    /// A wheel on a test stand.
    Wheel(Box<LoadedWheel>),
    /// A rover on slopes.
    Rover(Box<LoadedRover>),
}

impl Tested {
    /// The wheel, where one was tested.
    #[must_use]
    pub fn wheel(&self) -> Option<&LoadedWheel> {
        match self {
            Self::Wheel(wheel) => Some(wheel),
            Self::Rover(_) => None,
        }
    }

    /// The rover, where one was tested.
    #[must_use]
    pub fn rover(&self) -> Option<&LoadedRover> {
        match self {
            Self::Rover(rover) => Some(rover),
            Self::Wheel(_) => None,
        }
    }
}

impl DataSetCase {
    /// Whether a soil was fitted to these rows, so that its errors are in sample.
    #[must_use]
    pub fn is_fitted(&self, soil: &str) -> bool {
        self.fitted.iter().any(|fitted| fitted == soil)
    }

    /// Checks that each soil resists the wheels that were tested on it.
    fn check_soils(&self, gravity: f64, node: &Node) -> Result<(), DocumentError> {
        let wheels: Vec<Wheel> = match &self.tested {
            Tested::Wheel(wheel) => vec![wheel.value],
            Tested::Rover(rover) => {
                rover.value.mounts().iter().map(|mount| mount.unit.wheel).collect()
            }
        };
        for (place, (_, soil)) in self.soils.iter().enumerate() {
            for wheel in &wheels {
                soil.value.check_under(wheel, gravity).map_err(|error| {
                    DocumentError::at(node.origin_of(&format!("soils.{place}")), error.into())
                })?;
            }
        }
        Ok(())
    }
}

/// Documents that the parts of a data set may name: each is read anew, which takes a millisecond.
const MOST_NAMED: usize = 200;

/// Reads a data set with the wheels and soils that it names; the measurements themselves are read
/// by [`measurements::read`](crate::measurements::read).
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_data_set(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedDataSet, DocumentError> {
    let Written { tree, document, assumptions } = written(Kind::DataSet, source, overrides)?;
    let mut common = Common::default();
    DATA_SET.put(&mut common, document.keys());
    let nodes = match tree.entry("case").map(|entry| &entry.node.value) {
        Some(Value::List(nodes)) => nodes.as_slice(),
        _ => &[],
    };
    let sections = document.get("case").cloned().unwrap_or_default();
    let sections: Vec<CaseSection> = serde_json::from_value(sections).unwrap_or_default();
    let named: usize = sections.iter().map(|section| section.soils.len() + 1).sum();
    if named > MOST_NAMED {
        let problem = Problem::Conflict("its parts name more than 200 soils, wheels and rovers");
        return Err(DocumentError::at(tree.origin_of("case"), problem)
            .with_hint("several data sets may have the same file".to_owned()));
    }
    let Common { file, gravity } = common;
    let cases = sections.iter().zip(nodes).map(|(section, node)| {
        let case = section.read(node)?;
        case.check_soils(gravity, node)?;
        Ok(case)
    });
    let value = DataSet { file, gravity, cases: cases.collect::<Result<_, DocumentError>>()? };
    Ok(Loaded { assumptions, ..Loaded::of(document, value) })
}

impl CaseSection {
    fn read(&self, node: &Node) -> Result<DataSetCase, DocumentError> {
        let none = Overrides::none();
        let find = |kind: Kind, key: &str, name: &str| {
            let origin = node.origin_of(key).clone();
            let source = Source::named_in(&origin.text, kind, name)
                .map_err(|error| error.seen_from(&origin))?;
            Ok((source, origin))
        };
        let soil = |(place, name): (usize, &String)| {
            let (source, origin) = find(Kind::Soil, &format!("soils.{place}"), name)?;
            let loaded =
                read_soil(&source, &none).map_err(|error| blame_name(error, &origin, &source))?;
            Ok((name.clone(), loaded))
        };
        let tested = || {
            if let Some(name) = &self.wheel {
                let (source, origin) = find(Kind::Wheel, "wheel", name)?;
                let wheel = read_wheel(&source, &none);
                let wheel = wheel.map_err(|error| blame_name(error, &origin, &source))?;
                return Ok(Tested::Wheel(Box::new(wheel)));
            }
            // A part without a wheel has a rover.
            let name = self.rover.as_deref().unwrap_or_default();
            let (source, origin) = find(Kind::Rover, "rover", name)?;
            let rover = read_rover(&source, &none);
            let rover = rover.map_err(|error| blame_name(error, &origin, &source))?;
            Ok(Tested::Rover(Box::new(rover)))
        };
        let fitted = |name: &String| {
            if self.soils.contains(name) {
                return Ok(name.clone());
            }
            let problem = Problem::NotAllowed {
                key: "fitted".to_owned(),
                value: name.clone(),
                allowed: format!("one of the soils: {}", self.soils.join(", ")),
            };
            Err(DocumentError::at(node.origin_of("fitted"), problem))
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
            tested: tested()?,
            tested_name: self.wheel.clone().or_else(|| self.rover.clone()).unwrap_or_default(),
            soils: self.soils.iter().enumerate().map(soil).collect::<Result<_, DocumentError>>()?,
            fitted: self.fitted.iter().map(fitted).collect::<Result<_, _>>()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_data_set_that_names_documents_without_end_is_refused() {
        let part = "[[case]]\nname = \"all\"\nwheel = \"hakuto\"\nsoils = [\"toyoura\"]\n";
        let text = |parts: usize| {
            let head =
                "schema = \"data-set/1\"\nname = \"one\"\nsource = \"ours\"\nfile = \"a.csv\"\n";
            Source::text("a data set", head.to_owned() + &part.repeat(parts))
        };
        let read = |parts: usize| read_data_set(&text(parts), &Overrides::none());
        assert!(read(3).is_ok());
        let error = read(1_000).expect_err("it names 2000 documents").to_string();
        assert!(error.contains("name more than 200"), "{error}");
    }
}
