//! Layer 5, I/O: reads documents with units in their names into values in SI.
//!
//! A soil, a wheel, a rover, a scenario, a data set and a [`campaign`] each have a TOML document. Reading one takes these
//! steps, and this page is their order:
//!
//! 1. [`Source`]: a preset, a file or a text is [found](Source::find) and read.
//! 2. [`Overrides`]: values set on the command line replace those of the document.
//! 3. Named parts (a scenario's rover and soil, a rover's wheel) are read and put in their place.
//!    Relative paths start from the folder of the document they stand in.
//! 4. The tree is checked against the [`schema`] of its kind: keys, types, words, ranges.
//! 5. The rows of its kind's table fill in what it leaves out, and put its numbers into the domain's value, in
//!    SI units and radians; what only several values together can show is checked there.
//! 6. What is uncertain about a soil is read, with the samples that it names.
//!
//! What comes out is [`Loaded`]: the value, and the resolved document, which written back as TOML
//! repeats the run on its own. What is wrong comes out as a [`DocumentError`].
//!
//! Units and degrees are converted in this module's children and nowhere else. What a key is called, its
//! unit, its range, what it is and where its value goes: that is one row in `document/describe`.
//!
//! ```
//! use grouser::document::{self, Kind, Overrides, Source};
//!
//! let overrides = Overrides::parse(["soil.cohesion_kpa=0.5"])?;
//! let toyoura = document::read_soil(&Source::find(Kind::Soil, "toyoura")?, &overrides)?;
//! assert_eq!(toyoura.value.cohesion, 500.0);
//! # Ok::<(), document::DocumentError>(())
//! ```

pub mod calibration;
pub mod campaign;
pub mod card;
mod check;
pub mod checkpoint;
pub mod columns;
mod data_set;
mod describe;
mod error;
pub mod escape;
pub mod experiment;
mod field;
pub mod file;
mod loaded;
pub mod measurements;
mod notes;
mod overrides;
pub mod plates;
mod presets;
pub mod ranking;
mod samples;
mod schema;
pub mod simulated_test;
mod soil_family;
mod source;
pub mod study;
pub mod table;
mod text;
mod uncertain_soil;
mod uncertainty;
mod unit;
pub mod validation;
mod values;
mod varied;

use std::fmt;
use std::ops::RangeInclusive;

use serde::Serialize;

pub use campaign::{Campaign, read_campaign};
pub use check::nearest;
pub use data_set::{DataSet, DataSetCase};
pub use error::{DocumentError, Place, Problem, Spot};
pub use loaded::{Companion, Document, Loaded};
pub use overrides::Overrides;
pub use presets::{Preset, preset, presets};
pub use schema::{range, schema};
pub use soil_family::{FitKey, SoilFamily};
pub use source::{LARGEST_FILE, Source};
pub use uncertain_soil::{SAMPLES_FILE, UncertainSoil};
pub use unit::{UNITS, Unit, unit_of};
pub use varied::scenario_with;

use crate::simulation::Scenario;
use crate::soil::Soil;
use crate::units::{EARTH_GRAVITY, MARS_GRAVITY, MOON_GRAVITY};
use crate::vehicle::Rover;
use crate::wheel::Wheel;
use describe::scenario::FASTEST;
use field::Names;
use text::{Entry, Node, Origin, Value};
use values::Described;

/// Allowed speeds of a rim, ω r_s [m/s].
pub const RIM_SPEED_M_S: RangeInclusive<f64> = -FASTEST..=FASTEST;

/// A kind of document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A soil, `soil/1`.
    Soil,
    /// A wheel, `wheel/1`.
    Wheel,
    /// A rover, `rover/1`.
    Rover,
    /// A run, `scenario/1`.
    Scenario,
    /// A file of measurements, `data-set/1`.
    DataSet,
    /// A Monte Carlo campaign, `campaign/1`.
    Campaign,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Soil, Self::Wheel, Self::Rover, Self::Scenario, Self::DataSet, Self::Campaign];

    /// Its name in commands and overrides.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Soil => "soil",
            Self::Wheel => "wheel",
            Self::Rover => "rover",
            Self::Scenario => "scenario",
            Self::DataSet => "data-set",
            Self::Campaign => "campaign",
        }
    }

    /// The value of the document's `schema` key.
    #[must_use]
    pub const fn tag(self) -> &'static str {
        match self {
            Self::Soil => "soil/1",
            Self::Wheel => "wheel/1",
            Self::Rover => "rover/1",
            Self::Scenario => "scenario/1",
            Self::DataSet => "data-set/1",
            Self::Campaign => "campaign/1",
        }
    }

    /// The keys under which it names other documents, and the preset that stands there if it does
    /// not.
    const fn parts(self) -> &'static [Part] {
        match self {
            Self::Soil | Self::Wheel | Self::DataSet => &[],
            Self::Rover => {
                &[Part { kind: Self::Wheel, path: &["wheel_unit", "wheel"], default: None }]
            }
            Self::Scenario => &[
                Part { kind: Self::Rover, path: &["rover"], default: Some(DEFAULT_ROVER) },
                Part { kind: Self::Soil, path: &["soil"], default: Some(DEFAULT_SOIL) },
            ],
            Self::Campaign => &[
                Part { kind: Self::Scenario, path: &["scenario"], default: None },
                Part { kind: Self::Soil, path: &["wheel_test", "soil"], default: None },
                Part { kind: Self::Wheel, path: &["wheel_test", "wheel"], default: None },
            ],
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The rover of a scenario that names none.
pub const DEFAULT_ROVER: &str = "hakuto";
/// The soil of a scenario that names none.
pub const DEFAULT_SOIL: &str = "toyoura";

/// A document inside another.
struct Part {
    kind: Kind,
    path: &'static [&'static str],
    default: Option<&'static str>,
}

/// A document as TOML.
///
/// # Panics
/// Never: documents have text keys and finite numbers only.
#[must_use]
pub fn to_toml<D: Serialize>(document: &D) -> String {
    toml::to_string_pretty(document).expect("text keys and finite numbers")
}

/// A soil that was read.
pub type LoadedSoil = Loaded<Soil>;
/// A wheel that was read.
pub type LoadedWheel = Loaded<Wheel>;
/// A rover that was read.
pub type LoadedRover = Loaded<Rover>;
/// A scenario that was read.
pub type LoadedScenario = Loaded<Scenario>;
/// A data set that was read.
pub type LoadedDataSet = Loaded<DataSet>;

/// Reads a soil.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn read_soil(source: &Source, overrides: &Overrides) -> Result<LoadedSoil, DocumentError> {
    read(Kind::Soil, source, overrides)
}

/// Reads a wheel.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn read_wheel(source: &Source, overrides: &Overrides) -> Result<LoadedWheel, DocumentError> {
    read(Kind::Wheel, source, overrides)
}

/// Reads a rover with its wheel.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn read_rover(source: &Source, overrides: &Overrides) -> Result<LoadedRover, DocumentError> {
    read(Kind::Rover, source, overrides)
}

/// Reads a scenario with its rover and soil.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn read_scenario(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedScenario, DocumentError> {
    read(Kind::Scenario, source, overrides)
}

/// Reads a data set with the wheels and soils that it names; the measurements themselves are read
/// by [`measurements::read`].
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn read_data_set(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedDataSet, DocumentError> {
    data_set::read(source, overrides)
}

/// Checks a document of any kind, named by its `schema`.
///
/// # Errors
/// [`DocumentError`] for the first fault found.
pub fn check(source: &Source) -> Result<Kind, DocumentError> {
    let text = source.read()?;
    let kind = kind_of(&text::parse(&text)?)?;
    let overrides = Overrides::none();
    match kind {
        Kind::Soil => read_soil(source, &overrides).map(drop),
        Kind::Wheel => read_wheel(source, &overrides).map(drop),
        Kind::Rover => read_rover(source, &overrides).map(drop),
        Kind::Scenario => read_scenario(source, &overrides).map(drop),
        Kind::DataSet => read_data_set(source, &overrides).map(drop),
        Kind::Campaign => read_campaign(source, &overrides).map(drop),
    }?;
    Ok(kind)
}

/// Where a document has a key, with the tables it stands in.
fn place_of(source: &Source, key: &str) -> Result<Place, DocumentError> {
    let tree = text::parse(&source.read()?)?;
    Ok(Place::of(tree.origin_of(key)))
}

/// Gravities by name, with their values [m/s²].
pub const GRAVITIES: [(&str, f64); 3] =
    [("earth", EARTH_GRAVITY), ("moon", MOON_GRAVITY), ("mars", MARS_GRAVITY)];

/// A gravity [m/s²] by its name: `earth`, `moon` or `mars`.
#[must_use]
pub fn gravity(name: &str) -> Option<f64> {
    GRAVITIES.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// Reads a document that stands for one value.
fn read<V: Described>(
    kind: Kind,
    source: &Source,
    overrides: &Overrides,
) -> Result<Loaded<V>, DocumentError> {
    let Written { tree, mut document, assumptions } = written(kind, source, overrides)?;
    let value = V::of(&document).settled().map_err(|misfit| misfit.of(&tree))?;
    let mut companions = Vec::new();
    let uncertain = match kind {
        Kind::Soil => uncertain_soil::read(&mut document, "", &tree, &mut companions)?,
        Kind::Scenario => {
            let soil = tree.entry("soil").map_or(&tree, |entry| &entry.node);
            uncertain_soil::read(&mut document, "soil", soil, &mut companions)?
        }
        _ => None,
    };
    Ok(Loaded { document, value, uncertain, assumptions, companions })
}

/// A checked and completed document, not yet converted.
struct Written {
    tree: Node,
    document: Document,
    assumptions: Vec<String>,
}

fn written(kind: Kind, source: &Source, overrides: &Overrides) -> Result<Written, DocumentError> {
    let mut tree = load(kind, source, overrides, "")?;
    notes::check_days(kind, &tree)?;
    notes::add(kind, &mut tree, overrides);
    let document = Document::of(kind, &tree.to_json());
    let assumptions = notes::assumptions(kind, document.keys());
    Ok(Written { tree, document, assumptions })
}

/// The checked tree of a document with all its parts.
fn load(
    kind: Kind,
    source: &Source,
    overrides: &Overrides,
    prefix: &str,
) -> Result<Node, DocumentError> {
    let text = source.read()?;
    let mut tree = text::parse(&text)?;
    check_kind(kind, &tree)?;
    complete(kind, &mut tree, overrides, prefix)?;
    Ok(tree)
}

/// Overrides values, fetches the parts and checks the whole.
fn complete(
    kind: Kind,
    tree: &mut Node,
    overrides: &Overrides,
    prefix: &str,
) -> Result<(), DocumentError> {
    describe::rows(kind).rename(tree, Names::Today);
    overrides.apply(kind, tree)?;
    // What was set may be a keyword, or a table, of an earlier version.
    describe::rows(kind).rename(tree, Names::Today);
    for part in kind.parts() {
        let path = part.path.join(".");
        let prefix = if prefix.is_empty() { path } else { format!("{prefix}.{path}") };
        fetch(part, tree, overrides, &prefix)?;
    }
    check::check(kind, tree, prefix)
}

/// Puts a named part into its place.
fn fetch(
    part: &Part,
    tree: &mut Node,
    overrides: &Overrides,
    prefix: &str,
) -> Result<(), DocumentError> {
    let Some((key, tables)) = part.path.split_last() else { return Ok(()) };
    let mut table = tree;
    for step in tables {
        // A table that is missing, or is none, is for the check to report.
        let Some(entry) = table.entry_mut(step) else { return Ok(()) };
        table = &mut entry.node;
    }
    let origin = table.origin.clone();
    let Some(entry) = table.entry_mut(key) else {
        let (Some(default), Value::Table(entries)) = (part.default, &mut table.value) else {
            return Ok(());
        };
        let source = Source::find(part.kind, default)?;
        let node = load(part.kind, &source, overrides, prefix)?;
        entries.push(Entry { key: (*key).to_owned(), key_origin: origin, node });
        return Ok(());
    };
    match &entry.node.value {
        Value::String(name) => {
            let folder = &entry.node.origin.text.folder;
            let source = Source::find_from(folder, part.kind, name)
                .map_err(|error| error.seen_from(&entry.node.origin))?;
            entry.node = load(part.kind, &source, overrides, prefix)
                .map_err(|error| blame_name(error, &entry.node.origin, &source))?;
            Ok(())
        }
        Value::Table(_) => {
            if entry.node.entry("schema").is_some() {
                check_kind(part.kind, &entry.node)?;
            }
            complete(part.kind, &mut entry.node, overrides, prefix)
        }
        _ => Ok(()),
    }
}

/// Checks that a document is of the expected kind.
fn check_kind(expected: Kind, tree: &Node) -> Result<(), DocumentError> {
    let found = kind_of(tree).map_err(|error| match error.problem() {
        Problem::MissingKey { .. } => {
            let hint = format!("a {expected} document starts with schema = \"{}\"", expected.tag());
            error.with_hint(hint)
        }
        _ => error,
    })?;
    if found == expected {
        return Ok(());
    }
    let (found, expected) = (found.tag().to_owned(), expected.tag());
    let problem = Problem::WrongKind { found, expected };
    Err(DocumentError::at(tree.origin_of("schema"), problem))
}

/// The kind of a document, by its `schema`.
fn kind_of(tree: &Node) -> Result<Kind, DocumentError> {
    if tree.entries().is_empty() {
        return Err(DocumentError::whole(&tree.origin.text.label, Problem::Empty)
            .with_hint("a preset is a document to start from".to_owned()));
    }
    let tags = Kind::ALL.map(Kind::tag);
    let Some(entry) = tree.entry("schema") else {
        let problem = Problem::MissingKey { key: "schema".to_owned() };
        let hint = format!("it says what the document is: {}", tags.join(", "));
        return Err(DocumentError::at(&tree.origin, problem).with_hint(hint));
    };
    let word = match &entry.node.value {
        Value::String(word) => word.as_str(),
        _ => "",
    };
    Kind::ALL
        .into_iter()
        .find(|kind| kind.tag() == word)
        .ok_or_else(|| check::unknown_tag(&tags, &entry.node))
}

/// A missing file is the fault of the document that names it; of any other fault it says where the
/// file is named.
fn blame_name(error: DocumentError, origin: &Origin, source: &Source) -> DocumentError {
    match (error.problem(), source) {
        (Problem::NoSuchFile, Source::File(path))
            if error.place().spot.is_none()
                && error.place().document == path.display().to_string() =>
        {
            // Where the name is the whole path, the place shows it already.
            let is_whole = origin.text.folder.as_os_str().is_empty();
            let hint = (!is_whole).then(|| format!("looked for {}", path.display()));
            error.seen_from(origin).with_hint(hint)
        }
        _ => error.named_by(origin),
    }
}
