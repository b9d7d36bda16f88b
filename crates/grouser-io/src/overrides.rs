//! Overrides of single values from outside the documents: `soil.cohesion_kpa=0.5`.

use std::sync::Arc;

use super::check::{did_you_mean, keys_at, nearest, places};
use super::error::{DocumentError, Problem};
use super::kind::{Kind, without_parts};
use super::schema::{names_in, root};
use super::text::parse;
use super::tree::{Beside, Entry, Node, Origin, Text, Value};

/// Values that replace those of documents, applied in order before anything is checked.
///
/// What if the sand under a scenario's rover had 35° of friction, and the slope were one of 12°?
///
/// ```
/// use grouser_io::{Overrides, Source, read_scenario};
///
/// let overrides = Overrides::parse(["soil.friction_angle_deg=35", "scenario.slope_deg=12"])?;
/// let scenario = read_scenario(&Source::default_scenario(), &overrides)?.value;
/// let ground = scenario.ground;
/// assert_eq!(format!("{:.3} rad", ground.soil.friction_angle), "0.611 rad");
/// assert_eq!(format!("{:.3} rad", ground.plane_slope().unwrap()), "0.209 rad");
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Overrides {
    all: Vec<Override>,
    /// Keys that documents are read without.
    left_out: Vec<(Kind, &'static [&'static str])>,
}

#[derive(Clone, Debug)]
struct Override {
    kind: Kind,
    path: Vec<String>,
    key_origin: Origin,
    value: Node,
    changes_a_source: bool,
}

/// Steps of a key at the most: documents have about ten.
const DEEPEST: usize = 64;

impl Overrides {
    /// None.
    #[must_use]
    pub fn none() -> Self {
        Self::default()
    }

    /// Values of keys, each written `document.key=value`: the document is `soil`, `wheel`, `rover`
    /// or `scenario`, the key has its tables before it, and the value is TOML. A bare word needs no
    /// quotes.
    ///
    /// # Errors
    /// [`DocumentError`] for an argument that is not written so.
    pub fn parse<S: AsRef<str>>(
        settings: impl IntoIterator<Item = S>,
    ) -> Result<Self, DocumentError> {
        Self::parse_flags("", settings)
    }

    /// The same, as a command line has them: messages quote each with the flag before it.
    ///
    /// # Errors
    /// The same as [`parse`](Self::parse).
    pub fn parse_flags<S: AsRef<str>>(
        flag: &str,
        settings: impl IntoIterator<Item = S>,
    ) -> Result<Self, DocumentError> {
        let mut overrides = Self::none();
        for setting in settings {
            let setting = setting.as_ref();
            let content = if flag.is_empty() { String::new() } else { format!("{flag} ") };
            overrides.set(setting, &argument(content + setting))?;
        }
        Ok(overrides)
    }

    /// Adds one `document.key=value`, with which a text ends.
    fn set(&mut self, setting: &str, text: &Arc<Text>) -> Result<(), DocumentError> {
        let Some((key, value)) = setting.split_once('=') else {
            let problem = Problem::Malformed("not of the form document.key=value");
            return Err(DocumentError::whole(&text.label, problem)
                .with_hint("for instance soil.cohesion_kpa=0.5".to_owned()));
        };
        let start = text.content.len() - value.len();
        let value = parse_value(text, start)?;
        self.add(text, key.trim(), value, true)
    }

    /// Adds one `key = value` of a caller that is no command line. Messages quote the whole of it
    /// as [`change_label`](Self::change_label) writes it.
    ///
    /// * `value`: as TOML
    /// * `beside`: files and maps that it names
    ///
    /// # Errors
    /// [`DocumentError`] if there is no such document, or the value is not TOML.
    pub fn change(
        &mut self,
        key: &str,
        value: &str,
        beside: impl Into<Beside>,
    ) -> Result<(), DocumentError> {
        let text = argument_with(Self::change_label(key, value), beside.into());
        let value = parse_value(&text, text.content.len() - value.len())?;
        self.add(&text, key, value, true)
    }

    /// What messages call a [`change`](Self::change).
    #[must_use]
    pub fn change_label(key: &str, value: &str) -> String {
        format!("{key} = {value}")
    }

    /// Adds the value of a flag of its own, such as `--slope-deg 15`.
    ///
    /// * `flag`: as it was written, for messages
    /// * `key`: the document's key that it stands for, such as `scenario.slope_deg`
    /// * `value`: as TOML, or a bare word
    ///
    /// # Errors
    /// [`DocumentError`] if the value is not TOML.
    pub fn flag(&mut self, flag: &str, key: &str, value: &str) -> Result<(), DocumentError> {
        let text = argument(format!("{flag} {value}"));
        let value = parse_value(&text, text.content.len() - value.len())?;
        self.add(&text, key, value, false)
    }

    /// Adds the value of a flag that is one number, or a list of several.
    ///
    /// * `written`: the value as it was written, for messages
    ///
    /// # Errors
    /// [`DocumentError`] if there is no such key.
    pub fn flag_numbers(
        &mut self,
        flag: &str,
        key: &str,
        written: &str,
        numbers: &[f64],
    ) -> Result<(), DocumentError> {
        let text = argument(format!("{flag} {written}"));
        let origin = Origin { span: flag.len() + 1..text.content.len(), text: text.clone() };
        let node = |number: &f64| Node { value: Value::Float(*number), origin: origin.clone() };
        let value = match numbers {
            [number] => node(number),
            _ => Node { value: Value::List(numbers.iter().map(node).collect()), origin },
        };
        self.add(&text, key, value, false)
    }

    /// Adds the value of a flag that is a text whatever it looks like: a name, a path.
    ///
    /// # Errors
    /// [`DocumentError`] if there is no such key.
    pub fn flag_text(&mut self, flag: &str, key: &str, value: &str) -> Result<(), DocumentError> {
        let text = argument(format!("{flag} {value}"));
        let origin = Origin { span: flag.len() + 1..text.content.len(), text: text.clone() };
        self.add(&text, key, Node { value: Value::String(value.to_owned()), origin }, false)
    }

    /// Checks that every value belongs to one of the documents that a command reads.
    ///
    /// # Errors
    /// [`DocumentError`] for the first that does not.
    pub fn check_kinds(&self, kinds: &[Kind]) -> Result<(), DocumentError> {
        // What reads a soil reads its priors, and what reads a rover its motors.
        let is_read = |kind: Kind| {
            let holder = match kind {
                Kind::Prior => Kind::Soil,
                Kind::Motor => Kind::Rover,
                _ => kind,
            };
            kinds.contains(&kind) || kinds.contains(&holder)
        };
        match self.all.iter().find(|one| !is_read(one.kind)) {
            None => Ok(()),
            Some(one) => {
                let problem = Problem::Malformed("this command reads no such document");
                let names: Vec<_> = kinds.iter().map(|kind| kind.name()).collect();
                Err(DocumentError::at(&one.key_origin, problem)
                    .with_hint(format!("it reads: {}", names.join(", "))))
            }
        }
    }

    /// Checks that no value is set at some keys of a document, or under them, for which a command
    /// has no use.
    ///
    /// * `keys`: with the tables they stand in, joined by dots
    ///
    /// # Errors
    /// [`DocumentError`] for the first that is, with a hint what to do instead.
    pub fn refuse(&self, kind: Kind, keys: &[&str], hint: &str) -> Result<(), DocumentError> {
        let is_refused = |one: &&Override| {
            let is_at = |key: &&str| one.path.iter().zip(key.split('.')).all(|(a, b)| a == b);
            one.kind == kind && keys.iter().any(is_at)
        };
        match self.all.iter().find(is_refused) {
            None => Ok(()),
            Some(one) => {
                let problem = Problem::Malformed("this command does not use the key");
                Err(DocumentError::at(&one.key_origin, problem).with_hint(hint.to_owned()))
            }
        }
    }

    /// Reads documents of a kind without a key, which another one that is set stands in place of.
    /// Where no document has it, nothing changes.
    ///
    /// * `path`: the key, with the tables it stands in before it
    pub fn leave_out(&mut self, kind: Kind, path: &'static [&'static str]) {
        self.left_out.push((kind, path));
    }

    fn add(
        &mut self,
        text: &Arc<Text>,
        key: &str,
        value: Node,
        changes_a_source: bool,
    ) -> Result<(), DocumentError> {
        let mut steps = key.split('.').map(|step| step.trim().to_owned());
        let first = steps.next().unwrap_or_default();
        let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.name() == first) else {
            let names = Kind::ALL.map(Kind::name);
            // A key without its document is more likely than a misspelt document.
            let mut meant = with_document(key.trim(), &value);
            if meant.is_empty() {
                meant.extend(nearest(&first, names).map(str::to_owned));
            }
            let hint = did_you_mean(&meant)
                .unwrap_or_else(|| format!("a key starts with its document: {}", names.join(", ")));
            let problem = Problem::Malformed("the key does not start with the name of a document");
            return Err(DocumentError::whole(&text.label, problem).with_hint(hint));
        };
        let path: Vec<_> = steps.collect();
        if path.is_empty() {
            let problem = Problem::Malformed("a document is not set as a whole, only its keys");
            let hint = match kind {
                Kind::Motor => "for instance motor.KEY=VALUE, or rover.motor=NAME".to_owned(),
                _ => format!("for instance {kind}.KEY=VALUE, or another {kind} by its name"),
            };
            return Err(DocumentError::whole(&text.label, problem).with_hint(hint));
        }
        if path.len() > DEEPEST {
            let problem = Problem::Malformed("no key of a document is that deep");
            return Err(DocumentError::whole(&text.label, problem));
        }
        if path.iter().any(String::is_empty) {
            let problem = Problem::Malformed("there is no key between its dots");
            return Err(DocumentError::whole(&text.label, problem));
        }
        let start = text.content.find(key).unwrap_or(0);
        let key_origin = Origin { text: text.clone(), span: start..start + key.len() };
        let (kind, path) = without_parts(kind, path);
        self.all.push(Override { kind, path, key_origin, value, changes_a_source });
        Ok(())
    }

    /// Adds a value that a document of a kind gives another of its keys.
    pub(crate) fn of_document(&mut self, kind: Kind, key: &str, key_origin: &Origin, value: Node) {
        let steps = key.split('.').map(str::to_owned).collect();
        let (kind, path) = without_parts(kind, steps);
        let key_origin = key_origin.clone();
        self.all.push(Override { kind, path, key_origin, value, changes_a_source: false });
    }

    /// Puts the values for one kind of document into its tree.
    pub(crate) fn apply(&self, kind: Kind, tree: &mut Node) -> Result<(), DocumentError> {
        for (_, path) in self.left_out.iter().filter(|(of, _)| *of == kind) {
            remove(tree, path);
        }
        self.put(kind, tree, |one| !one.is_within_a_list())
    }

    /// The same for values inside documents that the entries of a list have: these must be in their
    /// places by now.
    pub(crate) fn apply_within_lists(
        &self,
        kind: Kind,
        tree: &mut Node,
    ) -> Result<(), DocumentError> {
        self.put(kind, tree, Override::is_within_a_list)
    }

    fn put(
        &self,
        kind: Kind,
        tree: &mut Node,
        is_meant: impl Fn(&Override) -> bool,
    ) -> Result<(), DocumentError> {
        // A law first: it decides which other keys there are.
        let meant = self.all.iter().filter(|one| one.kind == kind && is_meant(one));
        let (laws, others): (Vec<_>, Vec<_>) = meant.partition(|one| one.is_a_law());
        for one in laws {
            one.put(&one.path, tree)?;
            one.drop_keys_of_the_other_law(tree);
        }
        for one in others {
            one.put(&one.path, tree)?;
        }
        Ok(())
    }

    /// Where the first key of a kind of document was set.
    pub(crate) fn first_key_of(&self, kind: Kind) -> Option<&Origin> {
        self.all.iter().find(|one| one.kind == kind).map(|one| &one.key_origin)
    }

    /// The values set in a document that states its source.
    pub(crate) fn notes(&self, kind: Kind) -> impl Iterator<Item = String> {
        let changes = move |one: &&Override| one.kind == kind && one.changes_a_source;
        self.all.iter().filter(changes).map(|one| {
            let written = &one.value.origin;
            let value = &written.text.content[written.span.clone()];
            format!(
                "{}: set to {value} for this run, not by the document's source",
                one.path.join(".")
            )
        })
    }
}

impl Override {
    /// Whether it leads into a document that an entry of a list has.
    fn is_within_a_list(&self) -> bool {
        self.kind.parts().iter().any(|part| part.is_listed() && part.holds(&self.path))
    }

    /// The value at the end of its path; tables on the way are made.
    fn put(&self, path: &[String], tree: &mut Node) -> Result<(), DocumentError> {
        let not_a_table = || {
            let problem = Problem::Malformed("the key leads through a value that is not a table");
            DocumentError::at(&self.key_origin, problem)
        };
        let (mut node, mut rest) = (tree, path);
        while let Some((step, after)) = rest.split_first() {
            let entries = match &mut node.value {
                Value::Table(entries) => entries,
                Value::List(nodes) => {
                    let index = step.parse::<usize>().ok();
                    let count = nodes.len();
                    node = index
                        .and_then(|index| nodes.get_mut(index))
                        .ok_or_else(|| self.no_such_entry(count))?;
                    rest = after;
                    continue;
                }
                _ => return Err(not_a_table()),
            };
            // A key may have dots of its own, as those of free numbers have.
            let found = entries.iter().enumerate();
            let found = found.filter_map(|(at, entry)| Some((at, behind(&entry.key, rest)?)));
            let (position, after) =
                found.min_by_key(|(_, after)| after.len()).unwrap_or_else(|| {
                    let key_origin = self.key_origin.clone();
                    let empty =
                        Node { value: Value::Table(Vec::new()), origin: key_origin.clone() };
                    entries.push(Entry { key: step.clone(), key_origin, node: empty });
                    (entries.len() - 1, after)
                });
            (node, rest) = (&mut entries[position].node, after);
        }
        *node = self.value.clone();
        Ok(())
    }

    fn is_a_law(&self) -> bool {
        self.path.last().is_some_and(|key| key == "law" || key == "surface")
    }

    fn no_such_entry(&self, count: usize) -> DocumentError {
        let problem = Problem::Malformed("the key leads to an entry that the list does not have");
        DocumentError::at(&self.key_origin, problem)
            .with_hint(format!("it has {count}, counted from 0"))
    }

    /// A new law has keys of its own: what only the old one knew would be an error nobody made. The
    /// speed of a drive stays, under the key that it has there.
    fn drop_keys_of_the_other_law(&self, tree: &mut Node) {
        let Some((_, table)) = self.path.split_last() else { return };
        let Some(known) = keys_at(self.kind, tree, table) else { return };
        if let Some(speed) = SPEEDS.into_iter().find(|speed| known.contains(speed)) {
            rename(tree, table, SPEEDS, speed);
        }
        keep_entries(tree, table, |entry| {
            known.contains(&entry.key.as_str()) || entry.node.origin.text.is_argument
        });
    }
}

/// The steps of a path behind a key, if it begins with that.
fn behind<'p>(key: &str, path: &'p [String]) -> Option<&'p [String]> {
    key.split('.').try_fold(path, |rest, step| {
        let (first, rest) = rest.split_first()?;
        (first == step).then_some(rest)
    })
}

/// The keys of a drive's speed, of which each law has one.
const SPEEDS: [&str; 2] = ["rim_speed_m_s", "ground_speed_m_s"];

/// Gives one key in place of some to an entry of the table under some keys, if there is one.
fn rename(mut node: &mut Node, tables: &[String], keys: [&str; 2], to: &str) {
    for step in tables {
        match node.entry_mut(step) {
            Some(entry) => node = &mut entry.node,
            None => return,
        }
    }
    if let Some(key) = keys.into_iter().find(|key| node.entry(key).is_some())
        && let Some(entry) = node.entry_mut(key)
    {
        to.clone_into(&mut entry.key);
    }
}

/// Takes a key out of a tree that has it.
fn remove(tree: &mut Node, path: &[&str]) {
    let Some((key, tables)) = path.split_last() else { return };
    keep_entries(tree, tables, |entry| entry.key != *key);
}

/// Keeps some entries of the table under some keys, if there is one.
fn keep_entries(mut node: &mut Node, tables: &[impl AsRef<str>], is_kept: impl Fn(&Entry) -> bool) {
    for step in tables {
        match node.entry_mut(step.as_ref()) {
            Some(entry) => node = &mut entry.node,
            None => return,
        }
    }
    if let Value::Table(entries) = &mut node.value {
        entries.retain(is_kept);
    }
}

/// The keys with their document that were probably meant by one without: the key itself, one of its
/// name in a table, or one that is written much like it.
fn with_document(key: &str, value: &Node) -> Vec<String> {
    let last = key.rsplit('.').next().unwrap_or_default();
    let places_of = |name: &str| {
        let in_kind = |kind: Kind| {
            let paths = places(root(kind), name, Some(value)).into_iter();
            paths.map(|path| format!("{kind}.{path}")).collect::<Vec<_>>()
        };
        Kind::ALL.into_iter().map(in_kind).find(|found| !found.is_empty())
    };
    let alike = || {
        let names: Vec<String> =
            Kind::ALL.into_iter().flat_map(|kind| names_in(root(kind))).collect();
        places_of(nearest(last, names.iter().map(String::as_str))?)
    };
    places_of(key).or_else(|| places_of(last)).or_else(alike).unwrap_or_default()
}

fn argument(content: String) -> Arc<Text> {
    argument_with(content, Beside::default())
}

fn argument_with(content: String, beside: Beside) -> Arc<Text> {
    let (label, folder) = (content.clone(), beside.within.clone().unwrap_or_default());
    Arc::new(Text { label, content, folder, is_argument: true, beside })
}

/// The answer to a question of a draft; messages quote it with its key.
///
/// * `is_text`: whether it is a text whatever it looks like
pub(crate) fn answer_of(key: &str, answer: &str, is_text: bool) -> Result<Node, DocumentError> {
    let text = argument(Overrides::change_label(key, answer));
    let start = text.content.len() - answer.len();
    if is_text {
        let origin = Origin { span: start..text.content.len(), text };
        return Ok(Node { value: Value::String(answer.to_owned()), origin });
    }
    parse_value(&text, start)
}

/// The value that a text ends with, from a byte on.
fn parse_value(text: &Arc<Text>, start: usize) -> Result<Node, DocumentError> {
    const KEY: &str = "value = ";
    let written = text.content[start..].trim();
    let origin = Origin { text: text.clone(), span: start..text.content.len() };
    if written.is_empty() {
        return Err(DocumentError::at(&origin, Problem::Malformed("there is no value")));
    }
    let assignment = Arc::new(Text {
        label: text.label.clone(),
        content: format!("{KEY}{written}"),
        is_argument: true,
        ..Text::default()
    });
    match parse(&assignment) {
        Ok(Node { value: Value::Table(mut entries), .. }) if entries.len() == 1 => {
            let mut value = entries.remove(0).node;
            replace_origins(&mut value, &origin);
            Ok(value)
        }
        Err(error) if written.starts_with(['[', '{', '"', '\'']) => Err(error),
        Err(_) if !written.contains('\n') => {
            // TOML has no `.5`, no `5.` and no overflow; people do.
            let number = written.parse().map(Value::Float);
            let value = number.unwrap_or_else(|_| Value::String(written.to_owned()));
            Ok(Node { value, origin })
        }
        _ => Err(DocumentError::at(&origin, Problem::Malformed("this is not one value"))),
    }
}

/// Every part of an argument is quoted as the whole of it.
fn replace_origins(node: &mut Node, origin: &Origin) {
    node.origin = origin.clone();
    match &mut node.value {
        Value::List(nodes) => nodes.iter_mut().for_each(|node| replace_origins(node, origin)),
        Value::Table(entries) => {
            for entry in entries {
                entry.key_origin = origin.clone();
                replace_origins(&mut entry.node, origin);
            }
        }
        _ => {}
    }
}
