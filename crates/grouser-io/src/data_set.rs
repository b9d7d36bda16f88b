//! `data-set/1`: wheel, soils and gravity of a file of measurements, so that models can be compared with it.

use serde::Deserialize;

use super::describe::data_set::{Common, DATA_SET};
use super::error::{DocumentError, Problem};
use super::field::Inner;
use super::kind::Kind;
use super::loaded::Loaded;
use super::measurements::Condition;
use super::overrides::Overrides;
use super::read::{LoadedSoil, LoadedWheel, Written, blame_name, read_soil, read_wheel, written};
use super::source::Source;
use super::tree::{Node, Value};

/// A file of measured wheel tests, and the wheels and soils in it.
///
/// With which wheels were the tests of the data set `cmu-single-wheel` made, and under which gravity?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_data_set};
///
/// let source = Source::find(Kind::DataSet, "cmu-single-wheel")?;
/// let data_set = read_data_set(&source, &Overrides::none())?.value;
/// let radius = |case: &grouser_io::DataSetCase| {
///     format!("{}: {:.1} mm", case.name, 1e3 * case.wheel.value.shearing_radius())
/// };
/// let wheels: Vec<String> = data_set.cases.iter().map(radius).collect();
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
    /// Its parts, each with one wheel.
    pub cases: Vec<DataSetCase>,
}

/// A data set that was read.
pub type LoadedDataSet = Loaded<DataSet>;

/// A part as the document names it.
#[derive(Deserialize)]
struct CaseSection {
    name: String,
    wheel: String,
    #[serde(default, rename = "where")]
    conditions: Vec<String>,
    soils: Vec<String>,
}

/// A part of a data set, with its documents read.
#[derive(Clone, Debug, PartialEq)]
pub struct DataSetCase {
    /// Its name.
    pub name: String,
    /// Which rows of the file belong to it.
    pub conditions: Vec<Condition>,
    /// The wheel.
    pub wheel: LoadedWheel,
    /// The soils, each with the name it was found by.
    pub soils: Vec<(String, LoadedSoil)>,
}

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
    let cases = sections.iter().zip(nodes).map(|(case, node)| case.read(node));
    let Common { file, gravity } = common;
    let value = DataSet { file, gravity, cases: cases.collect::<Result<_, _>>()? };
    let (assumed, companions) = (Vec::new(), Vec::new());
    Ok(Loaded { document, value, uncertain: None, assumptions, assumed, companions })
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
