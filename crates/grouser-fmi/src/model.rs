//! A document as a model: who turns the wheels, its parameters, and its variables.

use std::path::Path;

use grouser::document::given_file::NamedFiles;
use grouser::document::varied::{Key, Numbers, Varied};
use grouser::document::{
    Described, Document, Kind, Loaded, LoadedMission, LoadedScenario, Overrides, Plan, Source,
    fnv_1a, read_mission, read_scenario,
};
use grouser::mission::Mission;
use grouser::simulation::Scenario;
use grouser::vehicle::DriveLaw;

use crate::drive::Drive;
use crate::variables::{Role, Variable, variables};

/// What the document is.
#[derive(Debug)]
enum Documented {
    Scenario(Varied<Scenario>),
    Mission(Varied<Plan>),
}

/// A document as a model.
#[derive(Debug)]
pub struct FmuModel {
    subject: Documented,
    /// Who turns the wheels.
    pub drive: Drive,
    /// Numbers of the document that an importer may change.
    pub parameters: Vec<Key>,
    /// All that the FMU says and takes.
    pub variables: Vec<Variable>,
    /// What is commanded of each wheel at the start [rad/s].
    pub starts: Vec<f64>,
}

impl FmuModel {
    /// The model of a scenario.
    ///
    /// # Errors
    /// A sentence for a scenario whose drive changes its commands on the way, if the inputs are to
    /// turn the wheels.
    pub fn of_scenario(loaded: &LoadedScenario, drive: Drive) -> Result<Self, String> {
        let scenario = &loaded.value;
        let commands = commands(scenario);
        if drive == Drive::Inputs && commands.is_none() {
            return Err(
                "the scenario's drive follows a law, which changes what it commands on the way, \
                 and inputs would take its place: give `drive.law` the value \"constant\", or let \
                 the document turn the wheels"
                    .to_owned(),
            );
        }
        let varied = varied(loaded);
        // What the inputs decide is no parameter.
        let is_open = |key: &str| {
            drive == Drive::Document || !(key.starts_with("drive.rim") || key == "duration_s")
        };
        let parameters = keys(&varied, is_open);
        Self::new(Documented::Scenario(varied), drive, parameters, commands)
    }

    /// The model of a mission, whose legs turn the wheels.
    ///
    /// # Errors
    /// A sentence for a mission with alternatives, and where inputs are to turn the wheels.
    pub fn of_mission(loaded: &LoadedMission, drive: Drive) -> Result<Self, String> {
        if drive == Drive::Inputs {
            return Err("the legs of a mission turn its wheels: it has no inputs".to_owned());
        }
        let missions = loaded.value.missions();
        if let [_, _, ..] = &missions[..] {
            let names: Vec<String> = missions.iter().map(|(name, _)| format!("{name:?}")).collect();
            return Err(format!(
                "the mission has the alternatives {}: an FMU drives one, so leave the others out",
                names.join(", ")
            ));
        }
        let varied = varied(loaded);
        let parameters = keys(&varied, |_| true);
        Self::new(Documented::Mission(varied), drive, parameters, None)
    }

    fn new(
        subject: Documented,
        drive: Drive,
        parameters: Vec<Key>,
        commands: Option<Vec<f64>>,
    ) -> Result<Self, String> {
        let (kind, scenario) = subject.seen();
        let variables = variables(kind, scenario, drive, &parameters).map_err(|name| {
            format!("two variables would have the name {name:?}: give that wheel another name")
        })?;
        let mounts = scenario.rover.mounts();
        let speeds = commands.unwrap_or_else(|| vec![0.0; mounts.len()]);
        let each = speeds.iter().zip(mounts);
        let starts = each.map(|(rim, mount)| rim / mount.shearing_radius()).collect();
        Ok(Self { subject, drive, parameters, variables, starts })
    }

    /// The model in a folder of resources, which a token belongs to.
    ///
    /// # Errors
    /// A sentence for a folder without the document, for one that was changed, and for an FMU of
    /// another version.
    pub fn in_resources(folder: &Path, token: &str) -> Result<Self, String> {
        let kinds = [Kind::Scenario, Kind::Mission];
        let there = kinds.map(|kind| (kind, folder.join(file_name(kind))));
        let Some((kind, path)) = there.into_iter().find(|(_, path)| path.is_file()) else {
            return Err(format!("there is no document in {}", folder.display()));
        };
        let text = std::fs::read_to_string(&path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let drive = Drive::ALL.into_iter().find(|(_, it)| self::token(*it, &text) == token);
        let Some((_, drive)) = drive else {
            return Err(format!(
                "the instantiation token {token:?} does not belong to the document in the FMU, or \
                 is of another version than {}",
                env!("CARGO_PKG_VERSION")
            ));
        };
        let (source, none) = (Source::file(&path), Overrides::none());
        let in_words = |error: grouser::document::DocumentError| error.to_string();
        match kind {
            Kind::Mission => {
                Self::of_mission(&read_mission(&source, &none).map_err(in_words)?, drive)
            }
            _ => Self::of_scenario(&read_scenario(&source, &none).map_err(in_words)?, drive),
        }
    }

    /// The document's kind.
    pub(crate) fn kind(&self) -> Kind {
        self.subject.seen().0
    }

    /// The document.
    pub(crate) fn document(&self) -> &Document {
        match &self.subject {
            Documented::Scenario(varied) => &varied.document,
            Documented::Mission(varied) => &varied.document,
        }
    }

    /// Its scenario with the document's numbers; of a mission what its legs share.
    pub(crate) fn nominal(&self) -> &Scenario {
        self.subject.seen().1
    }

    /// The scenario with other values of the parameters.
    ///
    /// # Errors
    /// A sentence for values that do not go together.
    pub(crate) fn scenario(&self, values: &[f64]) -> Result<Scenario, String> {
        match &self.subject {
            Documented::Scenario(varied) => self.with(varied, values),
            Documented::Mission(varied) => Ok(self.with(varied, values)?.scenario),
        }
    }

    /// The mission with other values of the parameters, if it is one.
    ///
    /// # Errors
    /// The same as [`scenario`](Self::scenario).
    pub(crate) fn mission(&self, values: &[f64]) -> Result<Option<Mission>, String> {
        let Documented::Mission(varied) = &self.subject else { return Ok(None) };
        let first = self.with(varied, values)?.missions().into_iter().next();
        Ok(first.map(|(_, mission)| mission))
    }

    fn with<V: Described>(&self, varied: &Varied<V>, values: &[f64]) -> Result<V, String> {
        let changed = self.parameters.iter().zip(values);
        let changed = changed.filter(|(key, value)| key.value.to_bits() != value.to_bits());
        let (keys, values): (Vec<Key>, Vec<f64>) =
            changed.map(|(key, value)| (key.clone(), *value)).unzip();
        varied.with(&keys, &values).map_err(|misfit| misfit.of_numbers().to_string())
    }

    /// What each parameter is in the document.
    pub(crate) fn usual(&self) -> Vec<f64> {
        self.parameters.iter().map(|key| key.value).collect()
    }

    /// The value that a variable has at the start, of those that an importer may set.
    pub(crate) fn start_of(&self, variable: &Variable) -> Option<f64> {
        match variable.role {
            Role::Input { wheel } => Some(self.starts[wheel]),
            Role::Parameter { place } => Some(self.parameters[place].value),
            _ => None,
        }
    }
}

impl Documented {
    fn seen(&self) -> (Kind, &Scenario) {
        match self {
            Self::Scenario(varied) => (Kind::Scenario, &varied.value),
            Self::Mission(varied) => (Kind::Mission, &varied.value.scenario),
        }
    }
}

/// The name of the document in an FMU's resources.
pub(crate) fn file_name(kind: Kind) -> String {
    format!("{kind}.toml")
}

/// What an FMU's description and its document have in common, so that the library knows both: its
/// version, who turns the wheels, and a sum over the document.
pub(crate) fn token(drive: Drive, document: &str) -> String {
    let sum = fnv_1a(document.bytes());
    format!("grouser-{}-{}-{sum:016x}", env!("CARGO_PKG_VERSION"), drive.word())
}

fn varied<V: Clone>(loaded: &Loaded<V>) -> Varied<V> {
    let Loaded { document, value, given, notes, .. } = loaded;
    let files = NamedFiles { given: given.clone(), notes: notes.clone() };
    Varied { value: value.clone(), document: document.clone(), files }
}

/// The numbers of a document that may be given other values.
fn keys<V: Described>(varied: &Varied<V>, is_open: impl Fn(&str) -> bool) -> Vec<Key> {
    let all = varied.document.number_keys().into_iter().filter(|key| is_open(key));
    all.filter_map(|key| varied.key(&key).ok()).collect()
}

/// What a drive commands of each rim [m/s], if that stays as it is.
fn commands(scenario: &Scenario) -> Option<Vec<f64>> {
    match &scenario.drive {
        DriveLaw::Constant(speed) => Some(vec![*speed; scenario.rover.wheel_count()]),
        DriveLaw::ConstantEach(speeds) => Some(speeds.clone()),
        DriveLaw::Eq18AsPrinted(_) | DriveLaw::Eq18(_) | DriveLaw::SlipLimiting(_) => None,
    }
}
