//! Reading a document: finding it, putting others' values and named parts into it, checking it, and
//! what it means.

use grouser_core::simulation::Scenario;
use grouser_core::soil::Soil;
use grouser_core::vehicle::{Motor, Rover};
use grouser_core::wheel::Wheel;

use super::base;
use super::check;
use super::describe;
use super::document::Document;
use super::error::{DocumentError, Place, Problem};
use super::given_file::NamedFiles;
use super::gravity;
use super::kind::{EACH, Kind, PRIORS_KEY, Part};
use super::legs_file;
use super::loaded::Loaded;
use super::mission::Plan;
use super::notes;
use super::overrides::Overrides;
use super::presets::Preset;
use super::priors;
use super::source::Source;
use super::stop_file;
use super::terrain_file;
use super::text;
use super::tree::{Entry, Node, Origin, Value};
use super::uncertain_soil;
use super::values::Described;

/// A soil that was read.
pub type LoadedSoil = Loaded<Soil>;
/// A wheel that was read.
pub type LoadedWheel = Loaded<Wheel>;
/// A motor with its gear that was read.
pub type LoadedMotor = Loaded<Motor>;
/// A rover that was read.
pub type LoadedRover = Loaded<Rover>;
/// A scenario that was read.
pub type LoadedScenario = Loaded<Scenario>;
/// A mission that was read.
pub type LoadedMission = Loaded<Plan>;

/// Reads a soil.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_soil(source: &Source, overrides: &Overrides) -> Result<LoadedSoil, DocumentError> {
    read(Kind::Soil, source, overrides)
}

/// Reads a wheel.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_wheel(source: &Source, overrides: &Overrides) -> Result<LoadedWheel, DocumentError> {
    read(Kind::Wheel, source, overrides)
}

/// Reads a motor with its gear.
///
/// At which speed does a wheel turn without load, behind a motor of a data sheet?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_motor};
///
/// let motor = Source::find(Kind::Motor, "maxon-re-25")?;
/// let slower = Overrides::parse(["motor.gear_ratio=500"])?;
/// let speed = |motor: grouser_io::LoadedMotor| motor.value.no_load_speed(12.0);
/// assert_eq!(format!("{:.2} rad/s", speed(read_motor(&motor, &Overrides::none())?)), "2.07 rad/s");
/// assert_eq!(format!("{:.2} rad/s", speed(read_motor(&motor, &slower)?)), "1.02 rad/s");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_motor(source: &Source, overrides: &Overrides) -> Result<LoadedMotor, DocumentError> {
    read(Kind::Motor, source, overrides)
}

/// Reads a rover with its wheel.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_rover(source: &Source, overrides: &Overrides) -> Result<LoadedRover, DocumentError> {
    read(Kind::Rover, source, overrides)
}

/// Reads a scenario with its rover and soil.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_scenario(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedScenario, DocumentError> {
    read(Kind::Scenario, source, overrides)
}

/// Reads a mission with its rover, its soil and its legs.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first; where it is in a leg, it says in which.
pub fn read_mission(
    source: &Source,
    overrides: &Overrides,
) -> Result<LoadedMission, DocumentError> {
    read(Kind::Mission, source, overrides).map_err(numbered)
}

/// A fault in a leg with the number that results give the leg: keys count from 0.
fn numbered(error: DocumentError) -> DocumentError {
    let problem = error.problem().to_string();
    let after = |key: &str| Some(problem.split_once(key)?.1);
    let place = after("`leg.").or_else(|| after(".leg."));
    let digits = place.and_then(|place| place.split('.').next());
    match digits.and_then(|digits| digits.parse::<usize>().ok()) {
        Some(place) => error.also(&format!("Keys count from 0: this is leg {}.", place + 1)),
        None => error,
    }
}

/// Checks a document of priors.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_priors(source: &Source, overrides: &Overrides) -> Result<Document, DocumentError> {
    Ok(written(Kind::Prior, source, overrides)?.document)
}

/// The kind that a document says it is.
///
/// # Errors
/// [`DocumentError`] if it is no document, or does not say so.
pub fn kind_of_source(source: &Source) -> Result<Kind, DocumentError> {
    kind_of(&text::parse(&source.read()?)?)
}

/// Where a document has a key, with the tables it stands in.
///
/// # Errors
/// [`DocumentError`] if the document cannot be read or is not TOML.
pub fn place_of(source: &Source, key: &str) -> Result<Place, DocumentError> {
    let tree = text::parse(&source.read()?)?;
    Ok(Place::of(tree.origin_of(key)))
}

/// Reads a document that stands for one value.
fn read<V: Described>(
    kind: Kind,
    source: &Source,
    overrides: &Overrides,
) -> Result<Loaded<V>, DocumentError> {
    understood(kind, written(kind, source, overrides)?)
}

/// What a document of a kind that stands for one value means.
pub(crate) fn understood<V: Described>(
    kind: Kind,
    written: Written,
) -> Result<Loaded<V>, DocumentError> {
    let Written { tree, mut document, assumptions } = written;
    let soil = kind.soil_key().and_then(|key| match key {
        "" => Some(document.clone()),
        key => document.part(Kind::Soil, key),
    });
    let assumed = soil.as_ref().map_or_else(Vec::new, priors::assumed);
    let (value, NamedFiles { mut given, notes }) = V::read(&document, &tree)?;
    let mut companions = Vec::new();
    let uncertain = match kind.soil_key() {
        Some(key) => {
            let soil = tree.entry(key).map_or(&tree, |entry| &entry.node);
            uncertain_soil::read(&mut document, key, soil, (&mut companions, &mut given))?
        }
        None => None,
    };
    Ok(Loaded { document, value, uncertain, assumptions, assumed, companions, given, notes })
}

/// A document that was found, checked and completed, but not yet understood.
pub struct Written {
    /// Its values, each with the place where it was written.
    pub tree: Node,
    /// The document with every named part in its place and every default filled in.
    pub document: Document,
    /// What was assumed, each with the name of the document that states it.
    pub assumptions: Vec<String>,
}

/// Finds a document, reads it with the parts that it names, checks it and fills in its defaults.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn written(
    kind: Kind,
    source: &Source,
    overrides: &Overrides,
) -> Result<Written, DocumentError> {
    let mut tree = load(kind, source, overrides, "")?;
    notes::check_days(kind, &tree)?;
    notes::add(kind, &mut tree, overrides);
    let document = Document::of(kind, &tree.to_json());
    let assumptions = notes::assumptions(kind, document.keys());
    Ok(Written { tree, document, assumptions })
}

impl Preset {
    /// The document's name and source.
    ///
    /// # Panics
    /// Never: every preset is read by a test.
    #[must_use]
    pub fn title_and_source(&'static self) -> (String, String) {
        let document = written(self.kind, &Source::Preset(self), &Overrides::none())
            .expect("every preset is read by a test")
            .document;
        (document.name().to_owned(), document.source().to_owned())
    }
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
    if kind == Kind::Prior {
        priors::check_reasons(&tree)?;
    }
    Ok(tree)
}

/// Overrides values, fetches the parts and checks the whole.
fn complete(
    kind: Kind,
    tree: &mut Node,
    overrides: &Overrides,
    prefix: &str,
) -> Result<(), DocumentError> {
    describe::rows(kind).read_thousands(tree);
    overrides.apply(kind, tree)?;
    // What was set may be in thousands as well.
    describe::rows(kind).read_thousands(tree);
    gravity::read_words(tree);
    if kind == Kind::Motor {
        base::take(tree)?;
    }
    if kind == Kind::Mission {
        legs_file::put_in(tree)?;
        legs_file::check_legs(tree)?;
        stop_file::put_in(tree)?;
    }
    if matches!(kind, Kind::Scenario | Kind::Mission) {
        terrain_file::locate(tree)?;
    }
    let has = |key: &str| tree.entry(key).map(|entry| &entry.node.value);
    let has_rows = matches!(has(PRIORS_KEY), Some(Value::Table(_)));
    for part in kind.parts() {
        let none = Overrides::none();
        let overrides = if part.is_listed() { &none } else { overrides };
        fetch(part, part.path, tree, overrides, prefix)?;
    }
    overrides.apply_within_lists(kind, tree)?;
    if kind == Kind::Soil {
        priors::fill(tree, has_rows);
    }
    check::check(kind, tree, prefix)?;
    if kind == Kind::Prior { priors::check(tree) } else { Ok(()) }
}

/// Puts a named part into its place, or each of those in a list.
///
/// * `path`: from the table to the part
/// * `prefix`: where the table stands in a larger document
fn fetch(
    part: &Part,
    path: &[&str],
    table: &mut Node,
    overrides: &Overrides,
    prefix: &str,
) -> Result<(), DocumentError> {
    let Some((key, further)) = path.split_first() else { return Ok(()) };
    let within = |step: &str| {
        if prefix.is_empty() { step.to_owned() } else { format!("{prefix}.{step}") }
    };
    if *key == EACH {
        let Value::List(nodes) = &mut table.value else { return Ok(()) };
        let mut each = nodes.iter_mut().enumerate();
        return each.try_for_each(|(place, node)| {
            fetch(part, further, node, overrides, &within(&place.to_string()))
        });
    }
    if !further.is_empty() {
        // A missing or invalid table is for the check to report.
        let Some(entry) = table.entry_mut(key) else { return Ok(()) };
        return fetch(part, further, &mut entry.node, overrides, &within(key));
    }
    let prefix = &within(key);
    let origin = table.origin.clone();
    let Some(entry) = table.entry_mut(key) else {
        let Value::Table(entries) = &mut table.value else { return Ok(()) };
        let Some(default) = part.default else {
            // A motor of which keys are set, but not all, is not to be left out in silence.
            if part.kind == Kind::Motor
                && let Some(origin) = overrides.first_key_of(part.kind)
            {
                let mut node = Node { value: Value::Table(Vec::new()), origin: origin.clone() };
                complete(part.kind, &mut node, overrides, prefix)?;
                entries.push(Entry { key: (*key).to_owned(), key_origin: origin.clone(), node });
            }
            return Ok(());
        };
        let source = Source::find(part.kind, default)?;
        let node = load(part.kind, &source, overrides, prefix)?;
        entries.push(Entry { key: (*key).to_owned(), key_origin: origin, node });
        return Ok(());
    };
    match &entry.node.value {
        Value::String(name) => {
            let source = Source::named_in(&entry.node.origin.text, part.kind, name)
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

/// Checks that a document states the kind that is needed.
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

/// The kind that a document says it is.
pub(super) fn kind_of(tree: &Node) -> Result<Kind, DocumentError> {
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
pub(super) fn blame_name(error: DocumentError, origin: &Origin, source: &Source) -> DocumentError {
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
