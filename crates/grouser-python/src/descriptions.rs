//! Documents for Python: read from presets, files, texts and tables, changed, and written back.

use std::path::PathBuf;
use std::sync::OnceLock;

use grouser::document::LoadedDesign;
use grouser::document::varied::{Key, NoNumber, Numbers as _, Varied};
use grouser::document::{
    self, Beside, Companion, DocumentError, HeldMap, Kind, LoadedMission, LoadedRover,
    LoadedScenario, LoadedSoil, LoadedWheel, Overrides, Problem, Source, map_of, mark_of,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use toml::{Table, Value};

use crate::campaign::LoadedCampaign;
use crate::terrain::Terrain;
use crate::threads::released;
use crate::values::Change;
use crate::{errors, values};

/// A document that was read: its keys, and the library's value made of them.
#[pyclass(frozen, module = "grouser._core")]
pub(crate) struct Document {
    read: Read,
    mark: OnceLock<u64>,
}

impl From<Read> for Document {
    fn from(read: Read) -> Self {
        Self { read, mark: OnceLock::new() }
    }
}

/// By its kind.
enum Read {
    Soil(Box<LoadedSoil>),
    Wheel(Box<LoadedWheel>),
    Rover(Box<LoadedRover>),
    Scenario(Box<LoadedScenario>),
    Mission(Box<LoadedMission>),
    Campaign(Box<LoadedCampaign>),
    Design(Box<LoadedDesign>),
}

impl Read {
    fn new(kind: Kind, source: &Source, overrides: &Overrides) -> Result<Self, DocumentError> {
        Ok(match kind {
            Kind::Soil => Self::Soil(document::read_soil(source, overrides)?.into()),
            Kind::Wheel => Self::Wheel(document::read_wheel(source, overrides)?.into()),
            Kind::Rover => Self::Rover(document::read_rover(source, overrides)?.into()),
            Kind::Campaign => Self::Campaign(LoadedCampaign::read(source, overrides)?.into()),
            Kind::Mission => Self::Mission(document::read_mission(source, overrides)?.into()),
            Kind::Design => Self::Design(document::read_design(source, overrides)?.into()),
            Kind::Scenario | Kind::Motor | Kind::DataSet | Kind::Prior | Kind::TelemetryMapping => {
                Self::Scenario(document::read_scenario(source, overrides)?.into())
            }
        })
    }
}

impl Read {
    /// What is odd about files that it names.
    fn notes(&self) -> &[String] {
        match self {
            Self::Scenario(it) => &it.notes,
            Self::Mission(it) => &it.notes,
            Self::Campaign(it) => &it.campaign().files().notes,
            Self::Soil(_) | Self::Wheel(_) | Self::Rover(_) | Self::Design(_) => &[],
        }
    }
}

impl Document {
    /// The keys and values of the document.
    fn resolved(&self) -> &document::Document {
        match &self.read {
            Read::Soil(it) => &it.document,
            Read::Wheel(it) => &it.document,
            Read::Rover(it) => &it.document,
            Read::Scenario(it) => &it.document,
            Read::Mission(it) => &it.document,
            Read::Campaign(it) => it.campaign().document(),
            Read::Design(it) => &it.document,
        }
    }

    /// The document as a table.
    pub(crate) fn table(&self) -> Table {
        // A document that was read has text keys and finite numbers only.
        Table::try_from(self.resolved()).unwrap_or_default()
    }

    /// Files that the document names.
    pub(crate) fn companions(&self) -> &[Companion] {
        match &self.read {
            Read::Soil(it) => &it.companions,
            Read::Wheel(it) => &it.companions,
            Read::Rover(it) => &it.companions,
            Read::Scenario(it) => &it.companions,
            Read::Mission(it) => &it.companions,
            // A campaign holds all that it needs, and so does a design.
            Read::Campaign(_) | Read::Design(_) => &[],
        }
    }

    /// The map of heights that a scenario or mission names.
    pub(crate) fn map(&self) -> Option<HeldMap> {
        let (scenario, document) = match &self.read {
            Read::Scenario(it) => (&it.value, &it.document),
            Read::Mission(it) => (&it.value.scenario, &it.document),
            _ => return None,
        };
        map_of(scenario, document)
    }

    /// A number of it, under its key.
    pub(crate) fn number(&self, key: &str) -> PyResult<Result<Key, NoNumber>> {
        Ok(match &self.read {
            Read::Soil(it) => Varied::of(it.value, it.document.clone()).key(key),
            Read::Wheel(it) => Varied::of(it.value, it.document.clone()).key(key),
            Read::Rover(it) => Varied::of(it.value.clone(), it.document.clone()).key(key),
            Read::Scenario(it) => Varied::of(it.value.clone(), it.document.clone()).key(key),
            Read::Mission(_) | Read::Campaign(_) | Read::Design(_) => {
                return Err(self.is_no("soil, wheel, rover or scenario"));
            }
        })
    }

    /// A number by which the document, with the files that it names, is told from others.
    pub(crate) fn mark(&self) -> u64 {
        *self.mark.get_or_init(|| {
            let map = self.map();
            mark_of(self.resolved(), self.companions(), map.as_ref().map(|map| &*map.model))
        })
    }

    /// A soil that was made here, with the file of its samples.
    pub(crate) fn of_soil(toml: String, companions: Vec<Companion>) -> PyResult<Self> {
        let source = Source::text_with("a calibrated soil", toml, companions);
        let read = Read::new(Kind::Soil, &source, &Overrides::none());
        read.map(Self::from).map_err(|error| errors::of_document(&error, &[]))
    }

    /// A scenario that was read here.
    pub(crate) fn of_scenario(scenario: LoadedScenario) -> Self {
        Read::Scenario(scenario.into()).into()
    }

    pub(crate) fn soil(&self) -> PyResult<&LoadedSoil> {
        match &self.read {
            Read::Soil(soil) => Ok(soil),
            _ => Err(self.is_no("soil")),
        }
    }

    pub(crate) fn wheel(&self) -> PyResult<&LoadedWheel> {
        match &self.read {
            Read::Wheel(wheel) => Ok(wheel),
            _ => Err(self.is_no("wheel")),
        }
    }

    pub(crate) fn scenario(&self) -> PyResult<&LoadedScenario> {
        match &self.read {
            Read::Scenario(scenario) => Ok(scenario),
            _ => Err(self.is_no("scenario")),
        }
    }

    /// The scenario, for an answer about planes: a warning says that its terrain is not used.
    pub(crate) fn scenario_on_planes(&self, py: Python<'_>) -> PyResult<&LoadedScenario> {
        let scenario = self.scenario()?;
        let line = scenario.document.plane_line();
        errors::warn(py, (!line.is_empty()).then_some(line.trim_end()))?;
        Ok(scenario)
    }

    pub(crate) fn mission(&self) -> PyResult<&LoadedMission> {
        match &self.read {
            Read::Mission(mission) => Ok(mission),
            _ => Err(self.is_no("mission")),
        }
    }

    pub(crate) fn design(&self) -> PyResult<&LoadedDesign> {
        match &self.read {
            Read::Design(design) => Ok(design),
            _ => Err(self.is_no("design")),
        }
    }

    pub(crate) fn campaign(&self) -> PyResult<&LoadedCampaign> {
        match &self.read {
            Read::Campaign(campaign) => Ok(campaign),
            _ => Err(self.is_no("campaign")),
        }
    }

    pub(crate) fn of_rover(rover: LoadedRover) -> Self {
        Read::Rover(rover.into()).into()
    }

    pub(crate) fn of_campaign(campaign: LoadedCampaign) -> Self {
        Read::Campaign(campaign.into()).into()
    }

    fn is_no(&self, expected: &str) -> PyErr {
        PyValueError::new_err(format!("this is a {}, not a {expected}", self.kind()))
    }
}

#[pymethods]
impl Document {
    /// `soil`, `wheel`, `rover`, `scenario`, `mission`, `design` or `campaign`.
    #[getter]
    fn kind(&self) -> &'static str {
        match &self.read {
            Read::Soil(_) => Kind::Soil.name(),
            Read::Wheel(_) => Kind::Wheel.name(),
            Read::Rover(_) => Kind::Rover.name(),
            Read::Scenario(_) => Kind::Scenario.name(),
            Read::Mission(_) => Kind::Mission.name(),
            Read::Campaign(_) => Kind::Campaign.name(),
            Read::Design(_) => Kind::Design.name(),
        }
    }

    /// What was assumed, each with the name of the document that says so.
    #[getter]
    fn assumptions(&self) -> Vec<String> {
        match &self.read {
            Read::Soil(it) => it.assumptions.clone(),
            Read::Wheel(it) => it.assumptions.clone(),
            Read::Rover(it) => it.assumptions.clone(),
            Read::Scenario(it) => it.assumptions.clone(),
            Read::Mission(it) => it.assumptions.clone(),
            Read::Campaign(it) => it.campaign().assumptions().to_vec(),
            Read::Design(it) => it.assumptions.clone(),
        }
    }

    /// The keys that it, or its soil, takes from priors because they are not stated.
    #[getter]
    fn assumed(&self) -> Vec<String> {
        let all = match &self.read {
            Read::Soil(it) => it.assumed.clone(),
            Read::Wheel(it) => it.assumed.clone(),
            Read::Rover(it) => it.assumed.clone(),
            Read::Scenario(it) => it.assumed.clone(),
            Read::Mission(it) => it.assumed.clone(),
            Read::Campaign(it) => it.campaign().assumed(),
            Read::Design(it) => it.assumed.clone(),
        };
        all.into_iter().map(|one| one.key).collect()
    }

    /// The files that the resolved document names: their names, and what is in them, a text or a
    /// map.
    #[getter]
    fn files<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        for Companion { name, content } in self.companions() {
            dict.set_item(name, content)?;
        }
        if let Some(map) = self.map() {
            dict.set_item(map.name.clone(), Terrain::of_map(map).into_pyobject(py)?)?;
        }
        Ok(dict)
    }

    /// Samples of an uncertain soil, each an exact soil: those of the studies over samples.
    fn samples(&self, py: Python<'_>, count: u32, seed: u64) -> PyResult<Vec<Self>> {
        let Some(soils) = &self.soil()?.uncertain else {
            let message = "the soil is exact: it states no uncertainty to sample".to_owned();
            return Err(errors::parameter(message, "soil", None, "a soil with uncertainty"));
        };
        let sample = |index: u64| {
            let drawn = errors::caught(|| soils.draw_document(seed, index))?;
            let document = drawn.map_err(|error| {
                let expected = "smaller standard deviations";
                errors::parameter(error.to_string(), "uncertainty", None, expected)
            })?;
            py.check_signals()?;
            Self::of_soil(document.to_toml(), Vec::new())
        };
        (0..u64::from(count)).map(sample).collect()
    }

    /// The resolved document as TOML.
    fn to_toml(&self) -> String {
        self.resolved().to_toml()
    }

    /// The resolved document as a dictionary of its own.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let items = serde_json::to_value(self.resolved()).unwrap_or_default();
        values::to_python(py, &items)
    }
}

/// A preset by its name, or else a file by its path.
#[pyfunction]
pub(crate) fn find_document(
    kind: &str,
    name: &str,
    changes: &Bound<'_, PyDict>,
) -> PyResult<Document> {
    let kind = kind_of(kind)?;
    let source = Source::find(kind, name).map_err(|error| errors::of_document(&error, &[]))?;
    changed(kind, &source, changes)
}

/// A file.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "how a path comes from Python")]
pub(crate) fn read_document_file(
    kind: &str,
    path: PathBuf,
    changes: &Bound<'_, PyDict>,
) -> PyResult<Document> {
    changed(kind_of(kind)?, &Source::file(path), changes)
}

/// A text, under a label for messages, and the files that it names.
#[pyfunction]
pub(crate) fn read_document_text(
    kind: &str,
    label: &str,
    text: &str,
    changes: &Bound<'_, PyDict>,
    files: &Bound<'_, PyDict>,
) -> PyResult<Document> {
    let source = Source::text_with(label, text, beside(files)?);
    changed(kind_of(kind)?, &source, changes)
}

/// Files as [`Document::files`] gives them.
fn beside(files: &Bound<'_, PyDict>) -> PyResult<Beside> {
    let mut beside = Beside::default();
    for (name, content) in files {
        let name: String = name.extract()?;
        match content.cast::<Terrain>() {
            Ok(terrain) => {
                beside.maps.push(HeldMap { name, ..terrain.get().map.clone() });
            }
            Err(_) => beside.files.push(Companion { name, content: content.extract()? }),
        }
    }
    Ok(beside)
}

/// A table of keys, under a label for messages; it need not say what it describes.
#[pyfunction]
pub(crate) fn read_document_table(
    kind: &str,
    label: &str,
    table: &Bound<'_, PyDict>,
    changes: &Bound<'_, PyDict>,
    files: &Bound<'_, PyDict>,
) -> PyResult<Document> {
    let kind = kind_of(kind)?;
    let mut beside = beside(files)?;
    let mut content = match values::to_toml(label, table.as_any(), &mut beside)? {
        Value::Table(table) => table,
        _ => Table::new(),
    };
    if !content.contains_key("schema") {
        content.insert("schema".to_owned(), Value::String(kind.tag().to_owned()));
    }
    let source = Source::text_with(label, document::to_toml(&content), beside);
    let arguments = vec![label.to_owned()];
    read_changed(kind, &source, changes, arguments, Some(table))
}

/// The keys that a name which a document of a kind does not have was probably meant to be, with the
/// tables they stand in.
#[pyfunction]
pub(crate) fn meant_keys(kind: &str, name: &str) -> PyResult<Vec<String>> {
    Ok(document::meant_keys(kind_of(kind)?, name))
}

/// The present names of a withdrawn one; none of any other.
#[pyfunction]
pub(crate) fn present_names(name: &str) -> Vec<&'static str> {
    document::present_names(name).to_vec()
}

/// Reads a document with changes; errors in those are the caller's.
fn changed(kind: Kind, source: &Source, changes: &Bound<'_, PyDict>) -> PyResult<Document> {
    read_changed(kind, source, changes, Vec::new(), None)
}

/// * `arguments`: labels of texts whose errors are the caller's too
/// * `table`: the caller's keys that the document is made of
fn read_changed(
    kind: Kind,
    source: &Source,
    changes: &Bound<'_, PyDict>,
    mut arguments: Vec<String>,
    table: Option<&Bound<'_, PyDict>>,
) -> PyResult<Document> {
    let mut overrides = Overrides::none();
    if changes.contains("terrain")? && !changes.contains("slope_deg")? {
        // Ground with heights takes the place of the plane.
        overrides.leave_out(kind, &["slope_deg"]);
    }
    for Change { key, value, beside } in values::changes(kind.name(), changes)? {
        arguments.push(Overrides::change_label(&key, &value));
        overrides
            .change(&key, &value, beside)
            .map_err(|error| errors::of_document(&error, &arguments))?;
    }
    let read = released(changes.py(), || Read::new(kind, source, &overrides))?;
    let read = read.map_err(|error| {
        let given = [Some(changes), table].into_iter().flatten();
        errors::of_document(&as_keywords(error, given), &arguments)
    })?;
    errors::warn(changes.py(), read.notes())?;
    Ok(read.into())
}

/// An error whose hint writes the keys that were meant as Python's keywords, where the unknown one
/// was among those given.
fn as_keywords<'py>(
    error: DocumentError,
    mut given: impl Iterator<Item = &'py Bound<'py, PyDict>>,
) -> DocumentError {
    let Problem::UnknownKey { key } = error.problem() else { return error };
    let value = given.find_map(|keys| value_at(keys, key));
    let (Some(value), false) = (value, error.meant().is_empty()) else { return error };
    let written: Vec<_> = error.meant().iter().map(|path| keyword(path, &value)).collect();
    error.with_hint(format!("did you mean {}?", written.join(" or ")))
}

/// A value under a path, as Python writes it; shortened if it is long.
fn value_at(keys: &Bound<'_, PyDict>, path: &str) -> Option<String> {
    /// Characters of a value that a hint repeats. Source: ours.
    const LONGEST: usize = 40;
    let start = keys.clone().into_any();
    let found = path.split('.').try_fold(start, |table, step| table.get_item(step).ok())?;
    let text = found.repr().ok()?.to_string();
    Some(if text.chars().count() > LONGEST { "…".to_owned() } else { text })
}

/// `start={"yaw_deg": 5}` for `start.yaw_deg`; `soil=Soil(…, cohesion_kpa=1)` for a key of a part,
/// because a mapping has to give all keys of a part that is made anew.
fn keyword(path: &str, value: &str) -> String {
    let Some((first, rest)) = path.split_once('.') else { return format!("{path}={value}") };
    match first {
        "soil" => format!("soil=Soil(…, {})", keyword(rest, value)),
        "rover" => format!("rover=Rover(…, {})", keyword(rest, value)),
        _ => {
            let table = rest
                .rsplit('.')
                .fold(value.to_owned(), |inner, key| format!("{{\"{key}\": {inner}}}"));
            format!("{first}={table}")
        }
    }
}

fn kind_of(name: &str) -> PyResult<Kind> {
    const KNOWN: [Kind; 7] = [
        Kind::Soil,
        Kind::Wheel,
        Kind::Rover,
        Kind::Scenario,
        Kind::Mission,
        Kind::Campaign,
        Kind::Design,
    ];
    KNOWN
        .into_iter()
        .find(|kind| kind.name() == name)
        .ok_or_else(|| PyValueError::new_err(format!("there are no documents of kind {name:?}")))
}

/// Kind, keys that are taken from priors, each with its value and the priors' name, and notes.
type Checked = (&'static str, Vec<(String, Option<f64>, String)>, Vec<String>);

/// Checks a document of any kind: a file, or a text under a label for messages.
///
/// * `text`: the content; without it `name` is a path
#[pyfunction]
pub(crate) fn check_document(
    py: Python<'_>,
    name: PathBuf,
    text: Option<String>,
) -> PyResult<Checked> {
    let source = match text {
        Some(text) => Source::text(name.display().to_string(), text),
        None => Source::file(name),
    };
    let found = released(py, || Ok((document::checked(&source)?, document::doubts(&source)?)))?;
    let (checked, notes) = found.map_err(|error| errors::of_document(&error, &[]))?;
    let assumed = checked.assumed.into_iter().map(|it| (it.key, it.value, it.prior));
    Ok((checked.kind.name(), assumed.collect(), notes))
}

/// The presets of a kind: name, title and source of each.
#[pyfunction]
pub(crate) fn presets(kind: &str) -> PyResult<Vec<(&'static str, String, String)>> {
    let described = |preset: &'static document::Preset| {
        let (title, source) = preset.title_and_source();
        (preset.name, title, source)
    };
    Ok(document::presets(kind_of(kind)?).map(described).collect())
}

/// A dictionary as TOML.
#[pyfunction]
pub(crate) fn to_toml(label: &str, table: &Bound<'_, PyDict>) -> PyResult<String> {
    Ok(document::to_toml(&values::to_toml(label, table.as_any(), &mut Beside::default())?))
}
