//! Reads a design's document with all rovers that may be chosen, on every ground.

use serde_json::Value as Json;

use super::columns::SLOPE;
use super::describe::design::DESIGN;
use super::describe::scenario;
use super::design::{DesignAim, DesignSettings, LimitEnds, Measure, Weights};
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::field::{Inner as _, keyed};
use super::kind::Kind;
use super::loaded::Loaded;
use super::overrides::Overrides;
use super::presets::preset;
use super::priors;
use super::read::{Written, understood, written};
use super::source::Source;
use super::tree::{Companion, Entry, Node, Value};
use super::unit::DEG;
use super::values::Described as _;
use super::varied::{Key, Numbers as _, Varied};
use grouser_core::contact::Model;
use grouser_core::simulation::Scenario;
use grouser_core::vehicle::Rover;

/// Numbers of a rover that are free, what is to be least, and what is limited.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignTask {
    /// The rovers among which is chosen, one for each combination of what may be chosen.
    pub candidates: Vec<RoverChoice>,
    /// The numbers that are free, each with the least and the most that it may be in its key's unit.
    pub free: Vec<(String, [f64; 2])>,
    /// Numbers that go with free ones.
    pub tied: Vec<TiedNumber>,
    /// What is to be least: the sum of measures with these weights.
    pub weights: Weights,
    /// What is limited, in the order of [`Measure::ALL`].
    pub limits: [LimitEnds; Measure::COUNT],
    /// With which probability each limit is to be kept, where soils are uncertain [-].
    pub probability: f64,
}

/// A number of a rover that goes with a free one.
#[derive(Clone, Debug, PartialEq)]
pub struct TiedNumber {
    /// Its key.
    pub key: String,
    /// The place of the free number.
    pub free: usize,
    /// One, or minus one where it is of the other sign.
    pub sign: f64,
}

/// A rover whose numbers are free.
#[derive(Clone, Debug, PartialEq)]
pub struct RoverChoice {
    /// What was chosen for it, by its keys.
    pub chosen: Vec<(String, Json)>,
    /// Where it drives: the document's own ground, then those where limits hold as well.
    pub grounds: Vec<DesignGround>,
    /// The rover whose wheels say what a sheet of them weighs: before anything but it was chosen.
    pub base: Rover,
    /// The free numbers as its documents have them.
    pub given: Vec<f64>,
}

/// Where designs are measured.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignGround {
    /// Rover, soil, gravity and model.
    pub scenario: Loaded<Scenario>,
    /// The slope on which slip, sinkage and work are measured [rad].
    pub slope: f64,
    /// The course, *χ* [rad]: direction of travel from the contour, positive uphill.
    pub course: f64,
}

/// A design's task that was read.
pub type LoadedDesign = Loaded<DesignTask>;

impl DesignTask {
    /// The wheel–soil model of a rover that may be chosen, on its first ground.
    #[must_use]
    pub fn model(&self, candidate: usize) -> &Model {
        &self.candidates[candidate].grounds[0].scenario.value.model
    }
}

/// Reads a design's task with its rovers and soils.
///
/// # Errors
/// [`DocumentError`] for whatever is wrong first.
pub fn read_design(source: &Source, overrides: &Overrides) -> Result<LoadedDesign, DocumentError> {
    let Written { tree, document, assumptions } = written(Kind::Design, source, overrides)?;
    let settings = settings_of(&document);
    let weights = weights_of(&settings, &tree)?;
    check_limits(&settings.limits, &tree)?;
    check_slope(&settings.limits, &document, &tree)?;
    let free = free(&document, &tree)?;
    let tied = tied(&document, &tree, &free)?;
    check_choices(&free, &tied, &tree)?;
    let mut candidates = Vec::new();
    for choice in choices(&tree) {
        candidates.push(candidate(source, overrides, &tree, &choice, (&free, &tied))?);
    }
    check_motors(&settings, &candidates, &tree)?;
    let soil = document.part(Kind::Soil, "soil");
    let assumed = soil.as_ref().map_or_else(Vec::new, priors::assumed);
    let (document, companions) = with_files(&document, &tree, &candidates);
    let DesignSettings { limits, probability, .. } = settings;
    let value = DesignTask { candidates, free, tied, weights, limits, probability };
    Ok(Loaded { assumptions, assumed, companions, ..Loaded::of(document, value) })
}

/// The document with names of files that lie beside it, and these files: what is chosen from a list,
/// or for another ground, stands in it as a name.
fn with_files(
    document: &Document,
    tree: &Node,
    candidates: &[RoverChoice],
) -> (Document, Vec<Companion>) {
    let grounds = || candidates.iter().flat_map(|it| &it.grounds);
    // Those of uncertain soils have their names in the soils.
    let mut files: Vec<Companion> = Vec::new();
    for file in grounds().flat_map(|it| &it.scenario.companions) {
        if !files.contains(file) {
            files.push(file.clone());
        }
    }
    let mut keys = document.keys().clone();
    let chosen = tree.entry("choose").into_iter().flat_map(|it| entries_of(&it.node));
    for (key, values) in chosen {
        let Value::List(all) = &values.value else { continue };
        for (place, node) in all.iter().enumerate() {
            let is_its = |it: &&RoverChoice| it.chosen.contains(&(key.clone(), node.to_json()));
            let ground = candidates.iter().find(is_its).map(|it| &it.grounds[0]);
            if let Some(file) = ground.and_then(|it| beside(it, &key, node, place)) {
                replace(keys.get_mut("choose"), &key, Some(place), &file.name);
                files.push(file);
            }
        }
    }
    let Some(Value::List(others)) = tree.entry("also").map(|entry| &entry.node.value) else {
        return (Document::of(Kind::Design, &keys), files);
    };
    for (place, other) in others.iter().enumerate() {
        for (key, node) in entries_of(other) {
            let file = beside(&candidates[0].grounds[place + 1], &key, node, place);
            if let Some(file) = file {
                replace(
                    keys.get_mut("also").and_then(|it| it.get_mut(place)),
                    &key,
                    None,
                    &file.name,
                );
                files.push(file);
            }
        }
    }
    (Document::of(Kind::Design, &keys), files)
}

/// The file of a part of a ground's rover or soil that a text under a key names; nothing of a preset,
/// or of what is no part.
///
/// * `place`: of the text among others, which makes names of files differ
fn beside(ground: &DesignGround, key: &str, node: &Node, place: usize) -> Option<Companion> {
    let Value::String(name) = &node.value else { return None };
    let last = key.rsplit('.').next().unwrap_or(key);
    let kinds = [Kind::Rover, Kind::Wheel, Kind::Motor, Kind::Soil];
    let kind = kinds.into_iter().find(|kind| kind.name() == last)?;
    if preset(kind, name).is_some() {
        return None;
    }
    let part = ground.scenario.document.part(kind, key)?;
    let key = key.replace('.', "-");
    Some(Companion { name: format!("{key}-{}.toml", place + 1), content: part.to_toml() })
}

/// Puts a file's name under a key of a table; where that has a list, at a place of it.
fn replace(table: Option<&mut Json>, key: &str, place: Option<usize>, name: &str) {
    let named = table.and_then(|it| it.get_mut(key));
    let named = match place {
        Some(place) => named.and_then(|it| it.get_mut(place)),
        None => named,
    };
    if let Some(named) = named {
        *named = Json::from(name);
    }
}

fn settings_of(document: &Document) -> DesignSettings {
    let mut settings = DesignSettings {
        scenario: scenario::blank(),
        course: 0.0,
        aim: DesignAim::WeightedSum,
        weights: [0.0; Measure::COUNT],
        limits: [LimitEnds::NONE; Measure::COUNT],
        probability: f64::NAN,
    };
    DESIGN.put(&mut settings, document.keys());
    settings
}

/// The weights of the sum that is to be least.
fn weights_of(settings: &DesignSettings, tree: &Node) -> Result<Weights, DocumentError> {
    let is_weighted = settings.weights.iter().any(|weight| *weight != 0.0);
    let fault =
        |key: &str, what| Err(DocumentError::at(tree.origin_of(key), Problem::Conflict(what)));
    match settings.aim {
        DesignAim::WeightedSum if is_weighted => Ok(settings.weights),
        DesignAim::WeightedSum => {
            fault("minimise", "`weighted_sum` needs `weights`: a table of measures")
        }
        DesignAim::One(_) if is_weighted => {
            fault("weights", "`weights` go with `minimise = \"weighted_sum\"`")
        }
        DesignAim::One(measure) => {
            let mut weights = [0.0; Measure::COUNT];
            weights[measure.place()] = 1.0;
            Ok(weights)
        }
    }
}

/// The key of the rover, and of what begins with it.
const ROVER: &str = "rover";

/// The most combinations of what may be chosen.
const MOST_CHOICES: usize = 64;

/// A value that is chosen for a key.
type Chosen<'t> = (String, &'t Node);

/// Checks that what may be chosen is of the rover, is not free or tied as well, and is not too much.
fn check_choices(
    free: &[(String, [f64; 2])],
    tied: &[TiedNumber],
    tree: &Node,
) -> Result<(), DocumentError> {
    let fault = |origin, what| Err(DocumentError::at(origin, Problem::Conflict(what)));
    let mut count = 1_usize;
    for (key, values) in tree.entry("choose").into_iter().flat_map(|it| entries_of(&it.node)) {
        let Value::List(all) = &values.value else { continue };
        if key != ROVER && !key.starts_with("rover.") {
            return fault(&values.origin, "only the rover and what is of it may be chosen");
        }
        let mut moved = free.iter().map(|(key, _)| key).chain(tied.iter().map(|it| &it.key));
        if moved.any(|other| *other == key) {
            return fault(
                &values.origin,
                "what is free, or tied, is not chosen from a list as well",
            );
        }
        count = count.saturating_mul(all.len());
        if count > MOST_CHOICES {
            return fault(&values.origin, "more than 64 combinations of what may be chosen");
        }
    }
    Ok(())
}

/// Every combination of what may be chosen; one without any where nothing is.
fn choices<'t>(tree: &'t Node) -> Vec<Vec<Chosen<'t>>> {
    let mut all: Vec<Vec<Chosen<'t>>> = vec![Vec::new()];
    for (key, values) in tree.entry("choose").into_iter().flat_map(|it| entries_of(&it.node)) {
        let Value::List(values) = &values.value else { continue };
        let with = |choice: &Vec<Chosen<'t>>| {
            let one = |value| choice.iter().cloned().chain([(key.clone(), value)]).collect();
            values.iter().map(one).collect::<Vec<Vec<Chosen<'t>>>>()
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// The keys in a table and in tables in it, with the tables they stand in.
fn entries_of(table: &Node) -> Vec<(String, &Node)> {
    let Value::Table(entries) = &table.value else { return Vec::new() };
    fn of_entry(entry: &Entry) -> Vec<(String, &Node)> {
        let Value::Table(_) = entry.node.value else {
            return vec![(entry.key.clone(), &entry.node)];
        };
        let inside = entries_of(&entry.node).into_iter();
        inside.map(|(key, node)| (format!("{}.{key}", entry.key), node)).collect()
    }
    entries.iter().flat_map(of_entry).collect()
}

/// The rover that comes of a choice, wherever it drives.
fn candidate(
    source: &Source,
    overrides: &Overrides,
    tree: &Node,
    choice: &[Chosen<'_>],
    (free, tied): (&[(String, [f64; 2])], &[TiedNumber]),
) -> Result<RoverChoice, DocumentError> {
    let own = chosen_by(overrides, choice);
    let mut grounds = vec![ground(source, &own)?];
    let others = tree.entry("also").map(|entry| &entry.node.value);
    if let Some(Value::List(others)) = others {
        for other in others {
            let differs = entries_of(other);
            if differs.is_empty() {
                let problem = Problem::Conflict("a second ground differs from the first in a key");
                return Err(DocumentError::at(&other.origin, problem));
            }
            grounds.push(ground(source, &chosen_by(&own, &differs))?);
        }
    }
    let first = &grounds[0].scenario;
    let varied = Varied::of(first.value.clone(), first.document.clone());
    let of_rover = choice.iter().filter(|(key, _)| key == ROVER);
    let base = ground(source, &chosen_by(overrides, of_rover))?.scenario.value.rover;
    let given =
        free.iter().map(|(path, ends)| Ok(free_key(&varied, path, *ends, tree, "free")?.value));
    let given = given.collect::<Result<_, DocumentError>>()?;
    for TiedNumber { key, free: place, sign } in tied {
        let mut ends = free[*place].1.map(|end| sign * end);
        ends.sort_by(f64::total_cmp);
        free_key(&varied, key, ends, tree, "tied")?;
    }
    check_moves(&varied, free, tied, tree)?;
    let chosen = choice.iter().map(|(key, node)| (key.clone(), node.to_json())).collect();
    Ok(RoverChoice { chosen, grounds, base, given })
}

/// Checks that every free number leaves a rover at one of its ends at least, alone or together with the
/// others: wheels of one rover stand on one plane.
fn check_moves(
    scenario: &Varied<Scenario>,
    free: &[(String, [f64; 2])],
    tied: &[TiedNumber],
    tree: &Node,
) -> Result<(), DocumentError> {
    let at = |places: &[usize], end: usize| {
        let own = places.iter().map(|place| (&*free[*place].0, free[*place].1[end]));
        let tied = tied.iter().filter(|it| places.contains(&it.free));
        let tied = tied.map(|it| (&*it.key, it.sign * free[it.free].1[end]));
        scenario.value.with(own.chain(tied))
    };
    let all: Vec<usize> = (0..free.len()).collect();
    for (place, (key, _)) in free.iter().enumerate() {
        let alone = [0, 1].map(|end| at(&[place], end));
        let [Err(misfit), Err(_)] = alone else { continue };
        if [0, 1].iter().all(|end| at(&all, *end).is_err()) {
            let origin = tree.origin_of(&format!("free.{key}"));
            return Err(DocumentError::at(origin, *misfit.problem).with_hint(format!(
                "{key} alone leaves no rover: what has to move with it stands under [tied]"
            )));
        }
    }
    Ok(())
}

/// The overrides with the values that a design gives some of its keys.
fn chosen_by<'c, 't: 'c>(
    overrides: &Overrides,
    choice: impl IntoIterator<Item = &'c Chosen<'t>>,
) -> Overrides {
    let mut with = overrides.clone();
    for (key, node) in choice {
        with.of_document(Kind::Design, key, &node.origin, (*node).clone());
    }
    with
}

/// Where designs are measured, by a document with other values in some places.
fn ground(source: &Source, overrides: &Overrides) -> Result<DesignGround, DocumentError> {
    let written = written(Kind::Design, source, overrides)?;
    let course = settings_of(&written.document).course;
    let document = scenario_of(&written.document);
    let slope = DEG.to_si(document.number(SLOPE.name).unwrap_or_default());
    let scenario = understood(Kind::Scenario, Written { document, ..written })?;
    Ok(DesignGround { scenario, slope, course })
}

/// The scenario that a design says its numbers of.
fn scenario_of(document: &Document) -> Document {
    const SHARED: [&str; 7] =
        ["rover", "soil", "model", "gravity_m_s2", SLOPE.name, "load_transfer", "wheel_moments"];
    let keys = document.keys().as_object().into_iter().flatten();
    let keys = keys.filter(|(key, _)| SHARED.contains(&key.as_str()));
    let given = keys.map(|(key, given)| (key.clone(), given.clone())).collect();
    Document::of(Kind::Scenario, &given)
}

/// The keys that are free, with their ends.
fn free(document: &Document, tree: &Node) -> Result<Vec<(String, [f64; 2])>, DocumentError> {
    let given = document.keys().get("free").into_iter().flat_map(keyed);
    let ends = |(key, given): (String, &Json)| {
        let number = |place: usize| given.get(place).and_then(Json::as_f64).unwrap_or(f64::NAN);
        let origin = || tree.origin_of(&format!("free.{key}"));
        if !key.starts_with("rover.") {
            let problem = Problem::Conflict("only numbers of the rover are free");
            return Err(DocumentError::at(origin(), problem).with_hint(format!(
                "a ground is stated: {key} = …, or [[also]] for a second one"
            )));
        }
        Ok((key, [number(0), number(1)]))
    };
    let free: Vec<(String, [f64; 2])> = given.map(ends).collect::<Result<_, _>>()?;
    if free.is_empty() {
        let problem = Problem::Conflict("`free` names no number");
        return Err(DocumentError::at(tree.origin_of("free"), problem));
    }
    Ok(free)
}

/// The numbers that go with free ones.
fn tied(
    document: &Document,
    tree: &Node,
    free: &[(String, [f64; 2])],
) -> Result<Vec<TiedNumber>, DocumentError> {
    let given = document.keys().get("tied").into_iter().flat_map(keyed);
    let tie = |(key, to): (String, &Json)| {
        let fault = |what| {
            let keys: Vec<&str> = free.iter().map(|(key, _)| &**key).collect();
            let origin = tree.origin_of(&format!("tied.{key}"));
            DocumentError::at(origin, Problem::Conflict(what))
                .with_hint(format!("free are {}", keys.join(", ")))
        };
        let place = |wanted: &str| free.iter().position(|(key, _)| key == wanted);
        if !key.starts_with("rover.") || place(&key).is_some() {
            return Err(fault("only numbers of the rover that are not free are tied"));
        }
        let to = to.as_str().unwrap_or_default().trim();
        let (sign, wanted) = to.strip_prefix('-').map_or((1.0, to), |wanted| (-1.0, wanted.trim()));
        let place = place(wanted).ok_or_else(|| fault("what it is tied to is not free"))?;
        Ok(TiedNumber { key, free: place, sign })
    };
    given.map(tie).collect()
}

/// The number under a key that moves, between ends that it may have.
///
/// * `table`: where the key stands
fn free_key(
    scenario: &Varied<Scenario>,
    path: &str,
    [least, most]: [f64; 2],
    tree: &Node,
    table: &str,
) -> Result<Key, DocumentError> {
    let origin = tree.entry(table).map_or(tree, |entry| &entry.node);
    let origin = origin.entry(path).map_or_else(|| origin.origin_of(path), |it| &it.node.origin);
    let key = scenario.key(path).map_err(|none| none.at(origin))?;
    if let Some((mount, _)) = path.split_once(".wheel.")
        && mount.starts_with("rover.mount.")
        && scenario.document.number(&format!("{mount}.mass_kg")).is_none()
    {
        let problem = Problem::Conflict("a wheel's mass follows its size, and this mount has none");
        return Err(DocumentError::at(origin, problem)
            .with_hint(format!("give the mount a mass: {mount}.mass_kg")));
    }
    // An end that was set by itself is to blame for itself.
    let own = tree.entry(table).and_then(|entry| entry.node.entry(path)).map(|it| &it.node.value);
    let own = if let Some(Value::List(ends)) = own { &ends[..] } else { &[] };
    let origin_of = |end: usize| own.get(end).map_or(origin, |it| &it.origin);
    for (place, end) in [least, most].into_iter().enumerate() {
        if !key.range.contains(&end) {
            return Err(DocumentError::at(origin_of(place), key.out_of_range(end)));
        }
    }
    if least >= most {
        let problem = Problem::Conflict("the first end of what is free is to be below the second");
        let set = (0..own.len()).map(origin_of).find(|it| it.text.is_argument);
        return Err(DocumentError::at(set.unwrap_or(origin), problem));
    }
    Ok(key)
}

/// Checks that every slope is crossed that is measured on.
fn check_slope(
    limits: &[LimitEnds; Measure::COUNT],
    document: &Document,
    tree: &Node,
) -> Result<(), DocumentError> {
    let most = limits[Measure::LimitSlope.place()].most;
    let slope = DEG.to_si(document.number(SLOPE.name).unwrap_or_default());
    if most >= slope {
        return Ok(());
    }
    let problem = Problem::Conflict("`at_most` is below `slope_deg`, which is to be crossed");
    let path = format!("subject_to.{}", Measure::LimitSlope.name());
    Err(DocumentError::at(tree.origin_of(&path), problem)
        .with_hint("raise `at_most`, or lower `slope_deg`".to_owned()))
}

/// Checks that every rover has motors where their current is asked for.
fn check_motors(
    settings: &DesignSettings,
    candidates: &[RoverChoice],
    tree: &Node,
) -> Result<(), DocumentError> {
    let current = Measure::Current;
    let ends = settings.limits[current.place()];
    let path = if ends != LimitEnds::NONE {
        format!("subject_to.{}", current.name())
    } else if settings.aim == DesignAim::One(current) {
        "minimise".to_owned()
    } else if settings.weights[current.place()] != 0.0 {
        format!("weights.{}", current.name())
    } else {
        return Ok(());
    };
    let lacks = |it: &RoverChoice| !it.grounds[0].scenario.value.rover.has_motors();
    if !candidates.iter().any(lacks) {
        return Ok(());
    }
    let problem = Problem::Conflict("a current is asked for, and no motor of the rover is known");
    Err(DocumentError::at(tree.origin_of(&path), problem)
        .with_hint("give it one, under [choose]: rover.motor = [\"maxon-re-25\"]".to_owned()))
}

/// Checks that limits leave room.
fn check_limits(limits: &[LimitEnds; Measure::COUNT], tree: &Node) -> Result<(), DocumentError> {
    for (measure, LimitEnds { least, most }) in Measure::ALL.into_iter().zip(limits) {
        if least > most {
            let problem = Problem::Conflict("`at_least` is above `at_most`: nothing can be both");
            let path = format!("subject_to.{}", measure.name());
            return Err(DocumentError::at(tree.origin_of(&path), problem)
                .with_hint("lower `at_least`, raise `at_most`, or leave one out".to_owned()));
        }
    }
    Ok(())
}
