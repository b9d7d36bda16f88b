//! The rover, the soil and the settings that a question is about, as the program's options name
//! them.

use grouser::answers::EVERY_MODEL;
use grouser::contact::Model;
use grouser::document::{
    self, DocumentError, Kind, LoadedScenario, LoadedSoil, LoadedWheel, Overrides, Source,
    UncertainSoil,
};
use http::StatusCode;
use serde_json::{Value, json};

use super::command::CommandLine;
use super::fields::AskedFields;
use crate::folder::ServedFolder;
use crate::refusal::Refusal;

/// CommonSettings of a question, beside its numbers.
#[derive(Clone, Debug, Default)]
pub(super) struct CommonSettings {
    model: Option<String>,
    /// [m/s²].
    gravity: Option<f64>,
    load_transfer: Option<String>,
    wheel_moments: Option<String>,
    /// Keys of documents, each with its value as TOML.
    set: Vec<(String, String)>,
}

/// A scenario by its parts.
#[derive(Clone, Debug)]
pub(super) struct ScenarioParts {
    scenario: Option<String>,
    rover: Option<String>,
    soil: Option<String>,
    settings: CommonSettings,
}

/// What a question says of a run, beside its scenario.
#[derive(Clone, Debug)]
pub(super) struct RunSettings {
    /// Keys of scenarios by those of the question, each with its numbers.
    numbers: Vec<(&'static str, &'static str, Vec<f64>)>,
}

/// A wheel on a test stand by its parts.
#[derive(Clone, Debug)]
pub(super) struct StandParts {
    soil: String,
    wheel: String,
    settings: CommonSettings,
}

/// A wheel on a test stand.
pub(super) struct Stand {
    pub(super) soil: LoadedSoil,
    pub(super) wheel: LoadedWheel,
    /// Gravity [m/s²].
    pub(super) gravity: f64,
    /// The model that is asked for by its name, if one is.
    pub(super) asked_model: Option<Model>,
}

/// A study's document, with what is set in it.
#[derive(Clone, Debug)]
pub(super) struct StudyParts {
    kind: Kind,
    name: String,
    settings: CommonSettings,
}

impl StudyParts {
    /// * `key`: of the document in the question
    pub(super) fn of(
        fields: &AskedFields,
        (kind, key): (Kind, &'static str),
    ) -> Result<Self, Refusal> {
        let name = fields.text(key)?;
        let name = name.ok_or_else(|| {
            Refusal::of_key(key, "it must be a preset, or the path of a document in the folder")
        })?;
        Self::named(fields, kind, name)
    }

    /// Those of a document of that name.
    pub(super) fn named(fields: &AskedFields, kind: Kind, name: String) -> Result<Self, Refusal> {
        let settings = CommonSettings { set: set_of(fields)?, ..CommonSettings::default() };
        Ok(Self { kind, name, settings })
    }

    /// The document, read by what reads its kind.
    pub(super) fn read<T>(
        &self,
        folder: &ServedFolder,
        read: fn(&Source, &Overrides) -> Result<T, DocumentError>,
    ) -> Result<T, Refusal> {
        let kinds = [self.kind, Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel, Kind::Motor];
        let overrides = self.settings.overrides(folder, &kinds)?;
        let source = find(self.kind.name(), folder, self.kind, &self.name)?;
        read(&source, &overrides).map_err(|error| self.settings.blamed(&error))
    }

    pub(super) fn add_words(&self, line: &mut CommandLine) {
        line.word(&self.name);
        self.settings.add_words(line);
    }
}

impl CommonSettings {
    fn of(fields: &AskedFields) -> Result<Self, Refusal> {
        let set = set_of(fields)?;
        Ok(Self {
            model: fields.text("model")?,
            gravity: gravity(fields)?,
            load_transfer: fields.text("load_transfer")?,
            wheel_moments: fields.text("wheel_moments")?,
            set,
        })
    }

    /// Whether every model is asked for.
    pub(super) fn has_every_model(&self) -> bool {
        self.model.as_deref() == Some(EVERY_MODEL)
    }

    /// Whether a model is asked for by its name.
    pub(super) fn names_model(&self) -> bool {
        self.model.is_some()
    }

    /// The same for each model that is asked for.
    fn each_model(&self) -> Vec<Self> {
        if !self.has_every_model() {
            return vec![self.clone()];
        }
        let named = |model: Model| Self { model: Some(model.name().to_owned()), ..self.clone() };
        Model::ALL.map(named).into()
    }

    /// What is set in documents of some kinds.
    fn overrides(&self, folder: &ServedFolder, kinds: &[Kind]) -> Result<Overrides, Refusal> {
        let mut overrides = Overrides::none();
        for (key, value) in &self.set {
            folder.set(&mut overrides, key, value).map_err(|error| self.blamed(&error))?;
        }
        overrides.check_kinds(kinds).map_err(|error| self.blamed(&error))?;
        Ok(overrides)
    }

    /// Adds what every run takes.
    fn add_to(&self, overrides: &mut Overrides, folder: &ServedFolder) -> Result<(), Refusal> {
        let words = [
            ("scenario.model", &self.model),
            ("scenario.load_transfer", &self.load_transfer),
            ("scenario.wheel_moments", &self.wheel_moments),
        ];
        for (key, value) in words {
            if let Some(value) = value {
                let set = folder.set(overrides, key, &text_of(value));
                set.map_err(|error| self.blamed(&error))?;
            }
        }
        if let Some(gravity) = self.gravity {
            let set = folder.set(overrides, "scenario.gravity_m_s2", &format!("{gravity:?}"));
            set.map_err(|error| self.blamed(&error))?;
        }
        Ok(())
    }

    /// Refuses settings of keys that the samples of a soil give a value.
    fn refuse_sampled(
        &self,
        folder: &ServedFolder,
        uncertain: Option<&UncertainSoil>,
    ) -> Result<(), Refusal> {
        let keys: Vec<&str> = uncertain.into_iter().flat_map(UncertainSoil::sampled_keys).collect();
        if keys.is_empty() {
            return Ok(());
        }
        let mut overrides = Overrides::none();
        for (key, value) in &self.set {
            folder.set(&mut overrides, key, value).map_err(|error| self.blamed(&error))?;
        }
        let hint = "every sample gives this key its own value";
        overrides.refuse(Kind::Soil, &keys, hint).map_err(|error| self.blamed(&error))
    }

    /// An error of documents, beside the key that caused it.
    fn blamed(&self, error: &DocumentError) -> Refusal {
        let place = &error.place().document;
        let own =
            self.set.iter().find(|(key, value)| *place == Overrides::change_label(key, value));
        let key = match own {
            Some((key, _)) => Some(key.as_str()),
            None => KEYS.into_iter().find(|key| place.starts_with(&format!("scenario.{key} = "))),
        };
        let status = if error.is_environment() {
            StatusCode::INTERNAL_SERVER_ERROR
        } else {
            StatusCode::UNPROCESSABLE_ENTITY
        };
        let Some(key) = key else { return Refusal::new(status, error.to_string()) };
        Refusal {
            status,
            message: error.problem().to_string(),
            key: Some(key.to_owned()),
            hint: error.hint().map(str::to_owned),
        }
    }

    fn add_words(&self, line: &mut CommandLine) {
        for (key, value) in &self.set {
            line.option("set", &format!("{key}={value}"));
        }
        line.maybe("model", self.model.as_deref());
        line.maybe("gravity-m-s2", self.gravity.map(|it| it.to_string()).as_deref());
        line.maybe("load-transfer", self.load_transfer.as_deref());
        line.maybe("wheel-moments", self.wheel_moments.as_deref());
    }
}

/// Keys of a question that stand for the scenario's of the same name.
const KEYS: [&str; 6] =
    ["rover", "soil", "model", "gravity_m_s2", "load_transfer", "wheel_moments"];

/// Numbers of runs: the key of a question, and that of the scenario.
const OF_RUNS: [(&str, &str); 4] = [
    ("slope_deg", "scenario.slope_deg"),
    ("yaw_deg", "scenario.start.yaw_deg"),
    ("duration_s", "scenario.duration_s"),
    ("rim_speed_m_s", "scenario.drive.rim_speed_m_s"),
];

/// What a scenario is read for.
#[derive(Clone, Copy)]
enum Use<'r> {
    /// To be shown as it is.
    AsItIs,
    /// For headings, whose slope and drive come from elsewhere: its own are refused.
    Headings,
    Run(&'r RunSettings),
}

impl RunSettings {
    pub(super) fn of(fields: &AskedFields) -> Result<Self, Refusal> {
        Self::of_keys(fields, &OF_RUNS)
    }

    /// Those that a run starts with, where others lead it.
    pub(super) fn of_start(fields: &AskedFields) -> Result<Self, Refusal> {
        let [slope, yaw, ..] = OF_RUNS;
        Self::of_keys(fields, &[slope, yaw])
    }

    fn of_keys(
        fields: &AskedFields,
        keys: &[(&'static str, &'static str)],
    ) -> Result<Self, Refusal> {
        let mut numbers = Vec::new();
        for &(key, of_scenario) in keys {
            let given = fields.numbers(key, &(f64::MIN..=f64::MAX), &[])?;
            // Wheels may have a speed each.
            if given.len() > 1 && key != "rim_speed_m_s" {
                return Err(Refusal::of_key(key, "it must be one number"));
            }
            if !given.is_empty() {
                numbers.push((key, of_scenario, given));
            }
        }
        Ok(Self { numbers })
    }

    fn add_to(&self, overrides: &mut Overrides, folder: &ServedFolder) -> Result<(), Refusal> {
        for (key, of_scenario, numbers) in &self.numbers {
            let value = match numbers[..] {
                [one] => format!("{one:?}"),
                _ => format!("{numbers:?}"),
            };
            let set = folder.set(overrides, of_scenario, &value);
            set.map_err(|error| Refusal {
                hint: error.hint().map(str::to_owned),
                ..Refusal::of_key(key, error.problem().to_string())
            })?;
            if *key == "yaw_deg" {
                // One yaw stands in place of the other.
                overrides.leave_out(Kind::Scenario, &["drive", "yaw_deg"]);
            }
        }
        Ok(())
    }

    /// The key of the question that an error of documents is about.
    fn key_of(&self, error: &DocumentError) -> Option<&'static str> {
        let place = &error.place().document;
        let is_its = |of_scenario: &str| place.starts_with(&format!("{of_scenario} = "));
        self.numbers.iter().find(|(_, of_scenario, _)| is_its(of_scenario)).map(|(key, ..)| *key)
    }

    pub(super) fn add_words(&self, line: &mut CommandLine) {
        for (key, _, numbers) in &self.numbers {
            line.numbers(&key.replace('_', "-"), numbers);
        }
    }
}

impl ScenarioParts {
    pub(super) fn of(fields: &AskedFields) -> Result<Self, Refusal> {
        Ok(Self {
            scenario: fields.text("scenario")?,
            rover: fields.text("rover")?,
            soil: fields.text("soil")?,
            settings: CommonSettings::of(fields)?,
        })
    }

    pub(super) fn common(&self) -> &CommonSettings {
        &self.settings
    }

    /// The scenarios for each model that is asked for; their own slope does not count.
    pub(super) fn scenarios(
        &self,
        folder: &ServedFolder,
        is_sampled: bool,
    ) -> Result<Vec<LoadedScenario>, Refusal> {
        let read =
            |settings: &CommonSettings| self.read(folder, settings, Use::Headings, is_sampled);
        self.settings.each_model().iter().map(read).collect()
    }

    /// The scenario as it is.
    pub(super) fn scenario(
        &self,
        folder: &ServedFolder,
        is_sampled: bool,
    ) -> Result<LoadedScenario, Refusal> {
        self.read(folder, &self.settings, Use::AsItIs, is_sampled)
    }

    /// The scenario of a run.
    pub(super) fn run(
        &self,
        folder: &ServedFolder,
        settings: &RunSettings,
        is_sampled: bool,
    ) -> Result<LoadedScenario, Refusal> {
        self.read(folder, &self.settings, Use::Run(settings), is_sampled)
    }

    fn read(
        &self,
        folder: &ServedFolder,
        settings: &CommonSettings,
        of: Use<'_>,
        is_sampled: bool,
    ) -> Result<LoadedScenario, Refusal> {
        let source = match &self.scenario {
            Some(name) => find("scenario", folder, Kind::Scenario, name)?,
            None => Source::default_scenario(),
        };
        let kinds = [Kind::Scenario, Kind::Rover, Kind::Soil, Kind::Wheel];
        let mut overrides = settings.overrides(folder, &kinds)?;
        let blamed = |error: DocumentError| {
            let refusal = settings.blamed(&error);
            match &of {
                Use::Run(run) => match run.key_of(&error) {
                    Some(key) => Refusal { key: Some(key.to_owned()), ..refusal },
                    None => refusal,
                },
                _ => refusal,
            }
        };
        if matches!(of, Use::Headings) {
            let unused =
                ["slope_deg", "duration_s", "sample_interval_s", "simulation", "drive", "start"];
            let hint = "slopes are given by `slope_deg` of the question; a heading offset has no \
                        drive, start or duration";
            overrides.refuse(Kind::Scenario, &unused, hint).map_err(blamed)?;
        }
        settings.add_to(&mut overrides, folder)?;
        if let Use::Run(run) = &of {
            run.add_to(&mut overrides, folder)?;
        }
        for (key, name) in [("rover", &self.rover), ("soil", &self.soil)] {
            if let Some(name) = name {
                let key = format!("scenario.{key}");
                folder.set(&mut overrides, &key, &text_of(name)).map_err(blamed)?;
            }
        }
        let scenario = document::read_scenario(&source, &overrides).map_err(blamed)?;
        if is_sampled {
            settings.refuse_sampled(folder, scenario.uncertain.as_ref())?;
        }
        Ok(scenario)
    }

    pub(super) fn add_words(&self, line: &mut CommandLine) {
        if let Some(scenario) = &self.scenario {
            line.word(scenario);
        }
        self.add_parts(line);
    }

    /// The words for a command that is about something else, and whose scenario is an option.
    pub(super) fn add_options(&self, line: &mut CommandLine) {
        line.maybe("scenario", self.scenario.as_deref());
        self.add_parts(line);
    }

    fn add_parts(&self, line: &mut CommandLine) {
        line.maybe("rover", self.rover.as_deref());
        line.maybe("soil", self.soil.as_deref());
        self.settings.add_words(line);
    }
}

impl StandParts {
    /// Those of a question; without a soil the program's usual one, without a wheel that of the
    /// question's rover, or the usual one.
    pub(super) fn of(fields: &AskedFields, folder: &ServedFolder) -> Result<Self, Refusal> {
        let wheel = match (fields.text("wheel")?, fields.text("rover")?) {
            (Some(wheel), _) => wheel,
            (None, Some(rover)) => wheel_of(folder, &rover)?,
            (None, None) => document::DEFAULT_ROVER.to_owned(),
        };
        Ok(Self {
            soil: fields.text("soil")?.unwrap_or_else(|| document::DEFAULT_SOIL.to_owned()),
            wheel,
            settings: CommonSettings::of(fields)?,
        })
    }

    pub(super) fn common(&self) -> &CommonSettings {
        &self.settings
    }

    /// What the question calls the wheel.
    pub(super) fn wheel(&self) -> &str {
        &self.wheel
    }

    /// The stand for each model that is asked for.
    pub(super) fn stands(
        &self,
        folder: &ServedFolder,
        is_sampled: bool,
    ) -> Result<Vec<Stand>, Refusal> {
        let read = |settings: &CommonSettings| {
            let stand = self.read(folder, settings)?;
            if is_sampled {
                settings.refuse_sampled(folder, stand.soil.uncertain.as_ref())?;
            }
            Ok(stand)
        };
        self.settings.each_model().iter().map(read).collect()
    }

    fn read(&self, folder: &ServedFolder, settings: &CommonSettings) -> Result<Stand, Refusal> {
        let blamed = |error: DocumentError| settings.blamed(&error);
        let overrides = settings.overrides(folder, &[Kind::Soil, Kind::Wheel])?;
        let soil = find("soil", folder, Kind::Soil, &self.soil)?;
        let soil = document::read_soil(&soil, &overrides).map_err(blamed)?;
        let wheel = find("wheel", folder, Kind::Wheel, &self.wheel)?;
        let wheel = document::read_wheel(&wheel, &overrides).map_err(blamed)?;
        // Gravity and model are keys of scenarios, and are checked as such.
        let mut of_run = Overrides::none();
        settings.add_to(&mut of_run, folder)?;
        let run = document::read_scenario(&Source::default_scenario(), &of_run).map_err(blamed)?;
        let gravity = run.value.gravity;
        soil.value
            .check_under(&wheel.value, gravity)
            .map_err(|error| Refusal::new(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()))?;
        let asked_model = settings.names_model().then_some(run.value.model);
        Ok(Stand { soil, wheel, gravity, asked_model })
    }

    pub(super) fn add_words(&self, line: &mut CommandLine) {
        line.option("soil", &self.soil);
        line.option("wheel", &self.wheel);
        self.settings.add_words(line);
    }
}

impl Stand {
    /// The model that it is computed with.
    pub(super) fn model(&self) -> Model {
        self.asked_model.clone().unwrap_or_else(|| self.soil.document.usual_model(""))
    }
}

/// Keys of documents that a question sets, each with its value as TOML.
fn set_of(fields: &AskedFields) -> Result<Vec<(String, String)>, Refusal> {
    let entries = fields.entries("set")?.into_iter();
    let each = entries.map(|(key, value)| {
        let toml = toml_of(&key, &value)?;
        Ok((key, toml))
    });
    each.collect()
}

/// The wheel of a rover, by the name of its preset: commands take a wheel by a name.
pub(super) fn wheel_of(folder: &ServedFolder, name: &str) -> Result<String, Refusal> {
    let refused = |message: String| Refusal::of_key("rover", message);
    let source = find("rover", folder, Kind::Rover, name)?;
    let rover = document::read_rover(&source, &Overrides::none());
    let rover = rover.map_err(|error| refused(error.to_string()))?;
    let wheels = || rover.value.mounts().iter().map(|mount| mount.unit.wheel);
    let own = wheels().next();
    if wheels().any(|wheel| Some(wheel) != own) {
        return Err(refused("this rover has different wheels".to_owned())
            .with_hint("name a wheel by `wheel`"));
    }
    let is_own = |preset: &&'static document::Preset| {
        let wheel = document::read_wheel(&Source::Preset(preset), &Overrides::none());
        wheel.is_ok_and(|wheel| Some(wheel.value) == own)
    };
    let title = rover.document.name_of("wheel_unit.wheel");
    let mut known = document::presets(Kind::Wheel).filter(|it| it.record().title == title);
    known.find(is_own).map(|it| it.name.to_owned()).ok_or_else(|| {
        refused(format!("{title}, the wheel of this rover, is no preset"))
            .with_hint("name a wheel by `wheel`")
    })
}

/// A document that a question names.
fn find(
    key: &'static str,
    folder: &ServedFolder,
    kind: Kind,
    name: &str,
) -> Result<Source, Refusal> {
    folder.find(kind, name).map_err(|error| {
        let refusal = Refusal::of_key(key, error.problem().to_string());
        Refusal { hint: error.hint().map(str::to_owned), ..refusal }
    })
}

/// A number, or what a name stands for [m/s²].
fn gravity(fields: &AskedFields) -> Result<Option<f64>, Refusal> {
    const KEY: &str = "gravity_m_s2";
    let name = match fields.take(KEY) {
        None => return Ok(None),
        Some(Value::String(name)) => name,
        Some(value) => match value.as_f64() {
            Some(number) => return Ok(Some(number)),
            None => return Err(Refusal::of_key(KEY, "it must be a number, or a name")),
        },
    };
    let names = document::GRAVITIES.map(|(name, _)| name);
    let known = document::gravity(&name).map(Some);
    known.ok_or_else(|| {
        let hint = match document::nearest(&name, names) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!("in m/s², such as 9.80665, or one of {}", names.join(", ")),
        };
        Refusal::of_key(KEY, "this is neither a number nor the name of a gravity").with_hint(hint)
    })
}

/// A text as TOML. What JSON escapes in texts TOML reads.
fn text_of(text: &str) -> String {
    json!(text).to_string()
}

/// An entry of a list as TOML, which may be a table, such as the leg of a mission.
fn entry_of(key: &str, value: &Value) -> Result<String, Refusal> {
    let Value::Object(entries) = value else { return toml_of(key, value) };
    let each = entries.iter().map(|(name, value)| {
        let value = entry_of(key, value)?;
        Ok(format!("{} = {value}", text_of(name)))
    });
    Ok(format!("{{ {} }}", each.collect::<Result<Vec<_>, Refusal>>()?.join(", ")))
}

/// A value as TOML.
fn toml_of(key: &str, value: &Value) -> Result<String, Refusal> {
    match value {
        Value::Bool(_) | Value::Number(_) | Value::String(_) => Ok(value.to_string()),
        Value::Array(all) => {
            let all: Vec<String> =
                all.iter().map(|value| entry_of(key, value)).collect::<Result<_, _>>()?;
            Ok(format!("[{}]", all.join(", ")))
        }
        Value::Object(_) | Value::Null => {
            Err(Refusal::of_key(key, "it must be a number, a text, true, false, or a list of them")
                .with_hint("a table is set key by key"))
        }
    }
}
