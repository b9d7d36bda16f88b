//! The state of learning as a document, from which a drive goes on with the same bits.
//!
//! It is JSON of its own schema: the version of Grouser and the resolved scenario that it belongs
//! to, and the state, field by field, in SI units. Numbers are written in the shortest form that
//! reads back as the same bits. A check sum over all else finds damage.

use serde_json::{Map, Value as Json, json};

use super::super::{Companion, Kind, LoadedScenario, Overrides, Source, fnv_1a, read_scenario};
use crate::studies::learn::{Archive, Drive, LearnSettings, Learner};

/// What the document is.
const SCHEMA: &str = "grouser.learn-state.v1";
const VERSION: &str = env!("CARGO_PKG_VERSION");
const CHECK_SUM: &str = "check_sum";

/// The largest state that is read [bytes]: that of the longest drive has some ten million.
pub const LARGEST_STATE: u64 = 256 << 20;

/// Why a state cannot be gone on from.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateError {
    /// It is no state, or not all of one.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// Another version of Grouser wrote it, whose numbers may differ.
    #[error("Grouser {0} wrote it, and this is Grouser {VERSION}")]
    OtherVersion(String),
    /// It goes on from another soil.
    #[error(
        "it belongs to another prior: `{kept}`, not `{given}`, or one of that name with other \
         numbers"
    )]
    OtherPrior {
        /// The name of the soil that it belongs to.
        kept: String,
        /// The name of the soil that was given.
        given: String,
    },
    /// It is of another rover.
    #[error(
        "it belongs to another rover: `{kept}`, not `{given}`, or one of that name with other \
         numbers"
    )]
    OtherRover {
        /// The name of the rover that it belongs to.
        kept: String,
        /// The name of the rover that was given.
        given: String,
    },
    /// Gravity, model, load transfer or the slope differ.
    #[error("it was learnt with other settings: gravity, model, load transfer or slope differ")]
    OtherSettings,
}

/// The state of a drive as a text.
///
/// * `slope_is_known`: as [`Learner::new`] was given it
#[must_use]
pub fn state_text(drive: &Drive, scenario: &LoadedScenario, slope_is_known: bool) -> String {
    let mut writer = Writer { open: vec![(String::new(), Json::Object(Map::new()))] };
    drive.write_state(&mut writer);
    let state = writer.open.pop().map_or(Json::Null, |(_, whole)| whole);
    let files = scenario.companions.iter();
    let files: Map<String, Json> =
        files.map(|it| (it.name.clone(), it.content.clone().into())).collect();
    let mut document = json!({
        "schema": SCHEMA,
        "version": VERSION,
        "slope_is_known": slope_is_known,
        "scenario": scenario.to_toml(),
        "files": files,
        "state": state,
    });
    document[CHECK_SUM] = check_sum(&document).into();
    document.to_string() + "\n"
}

/// The check sum of all that a document has beside it.
fn check_sum(document: &Json) -> String {
    format!("{:016x}", fnv_1a(document.to_string().bytes()))
}

/// A state that was read.
#[derive(Clone, Debug)]
pub struct KeptDrive {
    document: Json,
}

impl KeptDrive {
    /// Reads the text of a state.
    ///
    /// # Errors
    /// [`StateError`] for a text that is damaged, or of another version.
    pub fn read(text: &str) -> Result<Self, StateError> {
        let damaged = |what: &str| StateError::Damaged(what.to_owned());
        let mut document: Json =
            serde_json::from_str(text).map_err(|error| StateError::Damaged(error.to_string()))?;
        let stated = document.as_object_mut().and_then(|it| it.remove(CHECK_SUM));
        if document["schema"] != SCHEMA {
            return Err(damaged(&format!("its `schema` is not `{SCHEMA}`")));
        }
        let version = document["version"].as_str().unwrap_or_default();
        if version != VERSION {
            return Err(StateError::OtherVersion(version.to_owned()));
        }
        if stated != Some(check_sum(&document).into()) {
            return Err(damaged("its check sum is not that of its content"));
        }
        Ok(Self { document })
    }

    /// The scenario that it belongs to.
    ///
    /// # Errors
    /// [`StateError`] if that cannot be read from the state alone.
    pub fn scenario(&self) -> Result<LoadedScenario, StateError> {
        let text = self.document["scenario"].as_str().unwrap_or_default();
        let files = self.document["files"].as_object().into_iter().flatten();
        let files = files.filter_map(|(name, content)| {
            Some(Companion { name: name.clone(), content: content.as_str()?.to_owned() })
        });
        let files: Vec<Companion> = files.collect();
        let source = Source::text_with("the scenario of a state", text, files);
        read_scenario(&source, &Overrides::none())
            .map_err(|error| StateError::Damaged(error.to_string()))
    }

    /// Whether the scenario's slope is that of the drive.
    #[must_use]
    pub fn slope_is_known(&self) -> bool {
        self.document["slope_is_known"] == true
    }

    /// The drive, to be gone on with.
    ///
    /// * `scenario`, `slope_is_known`: of the learner that is to go on, which have to be those of
    ///   the state
    ///
    /// # Errors
    /// [`StateError`] where they are others, or the state does not fit them.
    pub fn drive(
        &self,
        scenario: &LoadedScenario,
        slope_is_known: bool,
    ) -> Result<Drive, StateError> {
        self.check_same(scenario, slope_is_known)?;
        let learner = Learner::new(scenario, slope_is_known, LearnSettings::USUAL)
            .map_err(|error| StateError::Damaged(error.to_string()))?;
        let mut drive = Drive::new(learner);
        let mut reader = Reader { open: vec![(&self.document["state"], 0)], fault: None };
        let is_whole = drive.read_state(&mut reader);
        match reader.fault {
            Some(fault) => Err(StateError::Damaged(fault)),
            None if is_whole => Ok(drive),
            None => Err(StateError::Damaged("it does not fit its scenario".to_owned())),
        }
    }

    fn check_same(&self, given: &LoadedScenario, slope_is_known: bool) -> Result<(), StateError> {
        let same_files = given.companions.len()
            == self.document["files"].as_object().map_or(0, Map::len)
            && given.companions.iter().all(|it| self.document["files"][&it.name] == it.content);
        if self.document["scenario"] == given.to_toml()
            && same_files
            && self.slope_is_known() == slope_is_known
        {
            return Ok(());
        }
        let kept = self.scenario()?;
        let part = |it: &LoadedScenario, kind, key| it.document.part(kind, key);
        let names = |key: &str| {
            let name = |it: &LoadedScenario| it.document.text(key).unwrap_or("unnamed").to_owned();
            (name(&kept), name(given))
        };
        if !same_files || part(&kept, Kind::Soil, "soil") != part(given, Kind::Soil, "soil") {
            let (kept, given) = names("soil.name");
            return Err(StateError::OtherPrior { kept, given });
        }
        if part(&kept, Kind::Rover, "rover") != part(given, Kind::Rover, "rover") {
            let (kept, given) = names("rover.name");
            return Err(StateError::OtherRover { kept, given });
        }
        Err(StateError::OtherSettings)
    }
}

/// Writes a state as JSON: the lists and groups that are open, each with its name.
struct Writer {
    open: Vec<(String, Json)>,
}

impl Writer {
    fn put(&mut self, name: &str, value: Json) {
        match self.open.last_mut() {
            Some((_, Json::Object(fields))) => {
                fields.insert(name.to_owned(), value);
            }
            Some((_, Json::Array(items))) => items.push(value),
            _ => {}
        }
    }
}

impl Archive for Writer {
    fn number(&mut self, name: &str, value: &mut f64) {
        // JSON has no infinity.
        let number = if value.is_finite() { json!(*value) } else { value.to_string().into() };
        self.put(name, number);
    }

    fn maybe(&mut self, name: &str, value: &mut Option<f64>) {
        self.put(name, json!(*value));
    }

    fn count(&mut self, name: &str, value: &mut u64) {
        self.put(name, json!(*value));
    }

    fn word(&mut self, name: &str, value: &mut String) {
        self.put(name, json!(*value));
    }

    fn list(&mut self, name: &str, length: usize) -> usize {
        self.open.push((name.to_owned(), Json::Array(Vec::with_capacity(length))));
        length
    }

    fn group(&mut self, name: &str) {
        self.open.push((name.to_owned(), Json::Object(Map::new())));
    }

    fn end(&mut self) {
        if let Some((name, value)) = self.open.pop() {
            self.put(&name, value);
        }
    }

    fn refuse(&mut self, _: &str) {}
}

/// Reads a state from JSON: the lists and groups that are open, each with the item that is next.
struct Reader<'a> {
    open: Vec<(&'a Json, usize)>,
    /// The first thing that is not as it has to be.
    fault: Option<String>,
}

impl<'a> Reader<'a> {
    fn next(&mut self, name: &str) -> &'a Json {
        const NOTHING: &Json = &Json::Null;
        let Some((value, place)) = self.open.last_mut() else { return NOTHING };
        let found = match value {
            Json::Array(items) => {
                *place += 1;
                items.get(*place - 1)
            }
            other => other.get(name),
        };
        if found.is_none() {
            self.refuse(name);
        }
        found.unwrap_or(NOTHING)
    }

    /// Puts a value in its place, or refuses it if it is not valid.
    fn take<T>(&mut self, name: &str, value: &mut T, read: impl Fn(&'a Json) -> Option<T>) {
        match read(self.next(name)) {
            Some(read) => *value = read,
            None => self.refuse(name),
        }
    }
}

impl Archive for Reader<'_> {
    fn number(&mut self, name: &str, value: &mut f64) {
        self.take(name, value, |it| it.as_f64().or_else(|| it.as_str()?.parse().ok()));
    }

    fn maybe(&mut self, name: &str, value: &mut Option<f64>) {
        self.take(name, value, |it| if it.is_null() { Some(None) } else { it.as_f64().map(Some) });
    }

    fn count(&mut self, name: &str, value: &mut u64) {
        self.take(name, value, Json::as_u64);
    }

    fn word(&mut self, name: &str, value: &mut String) {
        self.take(name, value, |it| it.as_str().map(str::to_owned));
    }

    fn list(&mut self, name: &str, _: usize) -> usize {
        let list = self.next(name);
        self.open.push((list, 0));
        if !list.is_array() {
            self.refuse(name);
        }
        list.as_array().map_or(0, Vec::len)
    }

    fn group(&mut self, name: &str) {
        let group = self.next(name);
        self.open.push((group, 0));
    }

    fn end(&mut self) {
        self.open.pop();
    }

    fn refuse(&mut self, name: &str) {
        self.fault.get_or_insert_with(|| format!("`{name}` is missing, or not what it has to be"));
    }
}
