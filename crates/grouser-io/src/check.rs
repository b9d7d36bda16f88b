//! Checks a tree of values against the schema of its kind, before anything is made of it.
//!
//! All checks of a JSON Schema are here: keys, their types, keywords, ranges and lengths.
//! Contradictions between values are checked where the domain's values are made.

use serde_json::Value as Json;

use super::error::{DocumentError, Problem};
use super::json_schema::{self, ANY_KEY, FROM_PRIOR};
use super::kind::Kind;
use super::schema::{alternatives, keys, paths_of, root, under, words};
use super::tree::{Entry, Node, Origin, Value, number};
use super::unit::UNITS;
use super::withdrawn::{is_now, present_names};

/// Checks that a tree is a document of its kind.
///
/// * `prefix`: where the document stands in a larger one, such as `wheel_unit.wheel`, or nothing
pub(crate) fn check(kind: Kind, tree: &Node, prefix: &str) -> Result<(), DocumentError> {
    let root = root(kind);
    Checker { root, prefix }.value(root, tree, prefix, &tree.origin)
}

/// Checks that an answer to a question is what one of some schemas allows.
///
/// * `schemas`: of the key, one for each law that has it
pub(crate) fn answer(
    root: &'static Json,
    schemas: &[&'static Json],
    node: &Node,
    key: &str,
) -> Result<(), DocumentError> {
    let checker = Checker { root, prefix: "" };
    let mut found = Ok(());
    for schema in schemas {
        found = checker.value(schema, node, key, &node.origin);
        if found.is_ok() {
            break;
        }
    }
    found
}

/// What a number may be, such as `0.1 to 50`; none of what is no number.
pub(crate) fn range_in_words(root: &Json, schema: &Json) -> Option<String> {
    alternatives(root, schema).into_iter().find_map(range_of)
}

/// The keys that a table of a document may have, given what it says already.
pub(crate) fn keys_at(kind: Kind, tree: &Node, path: &[String]) -> Option<Vec<&'static str>> {
    let table = table_at(kind, tree, path.iter().map(String::as_str))?;
    Some(keys(table).map(|(key, _)| key).collect())
}

/// The schema of a table of a document, given the laws that it names.
fn table_at<'s>(
    kind: Kind,
    tree: &Node,
    path: impl Iterator<Item = &'s str>,
) -> Option<&'static Json> {
    let root = root(kind);
    let checker = Checker { root, prefix: "" };
    let (mut schema, mut node) = (root, tree);
    for step in path {
        let table = checker.choose(schema, node, "", &node.origin).ok()?;
        schema = table.get("properties")?.get(step)?;
        node = &node.entry(step)?.node;
    }
    checker.choose(schema, node, "", &node.origin).ok()
}

/// The keyword or key that was probably meant: the present name of a withdrawn one, or the most
/// alike.
#[must_use]
pub fn nearest<'w>(word: &str, words: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    /// Likeness (Jaro and Winkler) above which a word counts as a misspelling [-]. Source: ours;
    /// `cohesion` finds `cohesion_kpa`, `sand` does not find `sine`.
    const ALIKE: f64 = 0.8;
    /// A longer word is none of ours; comparing takes a time of its length [bytes].
    const LONGEST: usize = 100;
    let words: Vec<_> = words.into_iter().collect();
    if let Some(present) = words.iter().find(|known| is_now(word, known)) {
        return Some(present);
    }
    if word.len() > LONGEST {
        return None;
    }
    let word = word.to_lowercase();
    words
        .into_iter()
        .map(|known| (strsim::jaro_winkler(&word, known), known))
        .filter(|(likeness, _)| *likeness > ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, known)| known)
}

/// The keys that a key which a document does not have was probably meant to be, with the tables
/// they stand in: a key of this name in another table, one at the top that is spelt alike, or one
/// whose name has a unit after it.
#[must_use]
pub fn meant_keys(kind: Kind, name: &str) -> Vec<String> {
    let root = root(kind);
    let top: Vec<_> = keys(root).map(|(key, _)| key).collect();
    meant(root, &Misplaced { name, table: "", value: None }, &top)
}

/// A key where a document has none of its name.
struct Misplaced<'a> {
    name: &'a str,
    /// The path of the table in which it was given.
    table: &'a str,
    value: Option<&'a Node>,
}

/// * `beside`: the keys of its table
fn meant(root: &Json, key: &Misplaced<'_>, beside: &[&str]) -> Vec<String> {
    let here = join(key.table, key.name);
    let elsewhere = |name: &str| {
        let mut paths = places(root, name, key.value);
        paths.retain(|path| *path != here);
        paths
    };
    let same = elsewhere(key.name);
    if !same.is_empty() {
        return same;
    }
    if let Some(alike) = nearest(key.name, beside.iter().copied()) {
        return vec![join(key.table, alike)];
    }
    let present: Vec<_> = present_names(key.name).iter().flat_map(|name| elsewhere(name)).collect();
    if !present.is_empty() {
        return present;
    }
    // Spelling alone says too little of keys in all tables; a unit that was left out does.
    let with_unit = UNITS.iter().map(|(unit, _)| elsewhere(&format!("{}{unit}", key.name)));
    with_unit.into_iter().find(|paths| !paths.is_empty()).unwrap_or_default()
}

/// Where a key stands in a document, as paths; none if that is in many tables.
///
/// * `name`: the key, or the end of its path
/// * `value`: what it is given; keys that take other types do not count, unless all do
pub(crate) fn places(root: &Json, name: &str, value: Option<&Node>) -> Vec<String> {
    /// The most places that a hint can name. Source: ours.
    const MOST: usize = 3;
    let all = paths_of(root, name);
    if all.iter().any(|path| path == name) {
        return vec![name.to_owned()];
    }
    let takes = |path: &&String| {
        let mut schemas = under(root, path, None).into_iter().flat_map(|it| alternatives(root, it));
        value.is_none_or(|value| schemas.any(|schema| fits(schema, value)))
    };
    let fitting: Vec<_> = all.iter().filter(takes).cloned().collect();
    let found = if fitting.is_empty() { all } else { fitting };
    if found.len() > MOST { Vec::new() } else { found }
}

/// The hint that some keys were meant.
pub(crate) fn did_you_mean(keys: &[impl AsRef<str>]) -> Option<String> {
    let keys: Vec<_> = keys.iter().map(AsRef::as_ref).collect();
    (!keys.is_empty()).then(|| format!("did you mean {}?", quoted(&keys, '`')))
}

/// The keys that choose among tables; a table has one of them.
const LAWS: [&str; 3] = ["law", "distribution", "surface"];

/// The key that chooses among some tables.
fn law_key(tables: &[&Json]) -> &'static str {
    let has = |law: &&str| tables.iter().any(|table| keys(table).any(|(key, _)| key == *law));
    LAWS.into_iter().find(has).unwrap_or(LAWS[0])
}

struct Checker<'a> {
    root: &'static Json,
    prefix: &'a str,
}

impl Checker<'_> {
    /// * `path`: the value's key, with the tables it stands in
    /// * `key`: where that key was written
    fn value(
        &self,
        schema: &'static Json,
        node: &Node,
        path: &str,
        key: &Origin,
    ) -> Result<(), DocumentError> {
        if let Some(words) = words(self.root, schema) {
            return check_word(&words, node, path);
        }
        let all = alternatives(self.root, schema);
        let schema = self.choose(schema, node, path, key)?;
        match &node.value {
            Value::Table(entries) => self.table(schema, node, entries, path, key, &all),
            Value::List(nodes) => self.list(schema, node, nodes, path),
            Value::Integer(integer) => check_range(schema, node, *integer as f64, path),
            Value::Float(float) => check_range(schema, node, *float, path),
            Value::String(text) => check_characters(schema, node, text, path),
            Value::Boolean(_) | Value::Date(_) => Ok(()),
        }
    }

    /// The alternative of a schema that a value means to meet.
    fn choose(
        &self,
        schema: &'static Json,
        node: &Node,
        path: &str,
        key: &Origin,
    ) -> Result<&'static Json, DocumentError> {
        let all = alternatives(self.root, schema);
        let fitting: Vec<_> = all.iter().copied().filter(|one| fits(one, node)).collect();
        match fitting[..] {
            [] => Err(wrong_type(&all, node, path, schema)),
            [one] => Ok(one),
            _ => self.choose_law(&fitting, node, path, key),
        }
    }

    /// Chooses the one of several tables whose `law` the value names.
    fn choose_law(
        &self,
        tables: &[&'static Json],
        node: &Node,
        path: &str,
        key: &Origin,
    ) -> Result<&'static Json, DocumentError> {
        let law = law_key(tables);
        let words_of = |table: &'static Json| self.laws_of(table);
        let Some(entry) = node.entry(law) else {
            let without = tables.iter().copied().find(|table| !requires(table, law));
            let all: Vec<_> = tables.iter().copied().filter_map(words_of).flatten().collect();
            return without.ok_or_else(|| {
                DocumentError::at(key, Problem::MissingKey { key: join(path, law) })
                    .with_hint(format!("it names the {law}: {}", listed(&all)))
            });
        };
        let all: Vec<_> = tables.iter().copied().filter_map(words_of).flatten().collect();
        check_word(&all, &entry.node, &join(path, law))?;
        let named = tables.iter().copied().find(|table| {
            matches!((&entry.node.value, words_of(table)),
                (Value::String(law), Some(words)) if words.contains(&law.as_str()))
        });
        named.ok_or_else(|| wrong_type(tables, node, path, &Json::Null))
    }

    /// The laws that a table's keys belong to.
    fn laws_of(&self, table: &'static Json) -> Option<Vec<&'static str>> {
        words(self.root, table.get("properties")?.get(law_key(&[table]))?)
    }

    /// * `all`: the schemas among which `schema` was chosen
    fn table(
        &self,
        schema: &'static Json,
        node: &Node,
        entries: &[Entry],
        path: &str,
        key: &Origin,
        all: &[&'static Json],
    ) -> Result<(), DocumentError> {
        if let Some(of_any) = schema.get(ANY_KEY).filter(|it| it.is_object()) {
            return self.any_keys(of_any, entries, path);
        }
        for entry in entries {
            let path = join(path, &entry.key);
            match keys(schema).find(|(key, _)| *key == entry.key) {
                Some((_, schema)) => {
                    self.value(schema, &entry.node, &path, &entry.key_origin)?;
                }
                None => return Err(self.unknown_key(schema, all, node, entry, path)),
            }
        }
        check_partners(schema, entries, path)?;
        check_choices(schema, node, path, key)?;
        let missing = keys(schema).find(|(key, key_schema)| {
            // A file's own `schema` is asked for where the file is read.
            let is_needed = requires(schema, key) || waits_for_prior(key_schema);
            *key != "schema" && is_needed && node.entry(key).is_none()
        });
        match missing {
            None => Ok(()),
            Some((name, schema)) => {
                let about = schema.get("description").and_then(Json::as_str).map(first_line);
                let about = about.map(|about| {
                    let prior =
                        if waits_for_prior(schema) { "; the soil's priors have none" } else { "" };
                    about + prior
                });
                Err(DocumentError::at(key, Problem::MissingKey { key: join(path, name) })
                    .with_hint(about))
            }
        }
    }

    /// A table whose keys are those of another document: tables in it hold the ends of keys.
    fn any_keys(
        &self,
        schema: &'static Json,
        entries: &[Entry],
        path: &str,
    ) -> Result<(), DocumentError> {
        for entry in entries {
            let path = join(path, &entry.key);
            match &entry.node.value {
                Value::Table(inside) => self.any_keys(schema, inside, &path)?,
                _ => self.value(schema, &entry.node, &path, &entry.key_origin)?,
            }
        }
        Ok(())
    }

    fn unknown_key(
        &self,
        schema: &'static Json,
        all: &[&'static Json],
        table: &Node,
        entry: &Entry,
        path: String,
    ) -> DocumentError {
        if let Some(other) = json_schema::of_thousands(schema, &entry.key) {
            let hint = if entry.key_origin.text.is_argument {
                format!("the document has `{other}`: that is the key to set")
            } else {
                "remove one of them".to_owned()
            };
            let problem = Problem::GivenInThousands { key: path, other: other.to_owned() };
            return DocumentError::at(&entry.key_origin, problem).with_hint(hint);
        }
        let key = law_key(all);
        let law = match table.entry(key).map(|entry| &entry.node.value) {
            Some(Value::String(law)) => format!(" with {key} = \"{law}\""),
            _ => String::new(),
        };
        let known: Vec<_> = keys(schema).map(|(key, _)| key).collect();
        let knowing = all.iter().filter(|table| keys(table).any(|(key, _)| key == entry.key));
        let laws: Vec<_> = knowing.filter_map(|table| self.laws_of(table)).flatten().collect();
        let fault = |key| DocumentError::at(&entry.key_origin, Problem::UnknownKey { key });
        if !laws.is_empty() {
            return fault(path).with_hint(format!("it goes with {key} = {}", listed(&laws)));
        }
        let parent = path.strip_suffix(&entry.key).unwrap_or_default().trim_end_matches('.');
        let inside = parent.strip_prefix(self.prefix).unwrap_or(parent).trim_start_matches('.');
        let misplaced = Misplaced { name: &entry.key, table: inside, value: Some(&entry.node) };
        let meant = meant(self.root, &misplaced, &known);
        let meant: Vec<_> = meant.iter().map(|path| join(self.prefix, path)).collect();
        // A key of the same table needs no path.
        let beside = |path: &str| known.iter().copied().find(|key| join(parent, key) == path);
        let shown: Vec<_> = meant.iter().map(|path| beside(path).unwrap_or(path)).collect();
        let hint = did_you_mean(&shown)
            .unwrap_or_else(|| format!("the keys here{law} are {}", quoted(&known, '`')));
        fault(path).with_hint(hint).with_meant(meant)
    }

    fn list(
        &self,
        schema: &'static Json,
        node: &Node,
        nodes: &[Node],
        path: &str,
    ) -> Result<(), DocumentError> {
        check_length(schema, node, nodes.len(), path)?;
        let Some(items) = schema.get("items") else { return Ok(()) };
        for (index, item) in nodes.iter().enumerate() {
            self.value(items, item, &join(path, &index.to_string()), &item.origin)?;
        }
        Ok(())
    }
}

/// Checks that no key is there without one that it goes with.
fn check_partners(schema: &Json, entries: &[Entry], path: &str) -> Result<(), DocumentError> {
    let has = |key: &str| entries.iter().any(|entry| entry.key == key);
    for entry in entries {
        let partners = schema.pointer(&format!("/dependentRequired/{}", entry.key));
        let mut partners = partners.and_then(Json::as_array).into_iter().flatten();
        let Some(other) = partners.find_map(|it| it.as_str().filter(|it| !has(it))) else {
            continue;
        };
        let about = schema.pointer(&format!("/properties/{other}/description"));
        let key = join(path, &entry.key);
        let problem = Problem::GoesWith { key, other: other.to_owned() };
        return Err(DocumentError::at(&entry.key_origin, problem)
            .with_hint(about.and_then(Json::as_str).map(first_line)));
    }
    Ok(())
}

/// Checks that a table has one of the keys of every choice, and no two that exclude each other.
fn check_choices(
    schema: &Json,
    node: &Node,
    path: &str,
    key: &Origin,
) -> Result<(), DocumentError> {
    for (keys, may_be_several) in json_schema::choices_of(schema) {
        let there: Vec<_> = keys.iter().copied().filter(|key| node.entry(key).is_some()).collect();
        let table = if path.is_empty() { "the document".to_owned() } else { format!("`{path}`") };
        let problem = match there[..] {
            [] => Problem::NoneOf(table, quoted(&keys, '`')),
            [one, other, ..] if !may_be_several => {
                Problem::SeveralOf(table, format!("`{one}` and `{other}`"))
            }
            _ => continue,
        };
        return Err(DocumentError::at(key, problem));
    }
    Ok(())
}

/// Checks that a text has as many characters as it must have.
fn check_characters(
    schema: &Json,
    node: &Node,
    text: &str,
    path: &str,
) -> Result<(), DocumentError> {
    let least = schema.get("minLength").and_then(Json::as_u64).unwrap_or(0);
    if text.chars().count() as u64 >= least {
        return Ok(());
    }
    Err(DocumentError::at(&node.origin, Problem::TooShort { key: path.to_owned(), least }))
}

fn check_word(allowed: &[&str], node: &Node, path: &str) -> Result<(), DocumentError> {
    let Value::String(word) = &node.value else {
        let (found, expected) = (node.describe(), listed(allowed));
        let problem = Problem::WrongType { key: path.to_owned(), found, expected };
        return Err(DocumentError::at(&node.origin, problem));
    };
    if allowed.contains(&word.as_str()) {
        return Ok(());
    }
    let hint =
        nearest(word, allowed.iter().copied()).map(|word| format!("did you mean \"{word}\"?"));
    let value = word.escape_debug().to_string();
    let problem = Problem::NotAllowed { key: path.to_owned(), value, allowed: listed(allowed) };
    Err(DocumentError::at(&node.origin, problem).with_hint(hint))
}

/// The range of a number, in words.
fn range_of(schema: &Json) -> Option<String> {
    let end = |name: &str| schema.get(name).and_then(Json::as_f64).map(number);
    match (end("minimum"), end("exclusiveMinimum"), end("maximum")) {
        (Some(least), _, Some(most)) => Some(format!("{least} to {most}")),
        (None, Some(above), Some(most)) => Some(format!("above {above} and at most {most}")),
        (Some(least), _, None) => Some(format!("at least {least}")),
        (None, Some(above), None) => Some(format!("above {above}")),
        (None, None, Some(most)) => Some(format!("at most {most}")),
        (None, None, None) => None,
    }
}

fn check_range(schema: &Json, node: &Node, value: f64, path: &str) -> Result<(), DocumentError> {
    let end = |name: &str| schema.get(name).and_then(Json::as_f64);
    let (least, most) = (end("minimum"), end("maximum"));
    let above = end("exclusiveMinimum");
    let range = range_of(schema);
    let key = path.to_owned();
    if !value.is_finite() {
        let range = range.map_or_else(String::new, |range| format!(", {range}"));
        let problem = Problem::NotFinite { key, value, range };
        return Err(DocumentError::at(&node.origin, problem));
    }
    let outside = least.is_some_and(|least| value < least)
        || above.is_some_and(|above| value <= above)
        || most.is_some_and(|most| value > most);
    match range {
        Some(range) if outside => {
            Err(DocumentError::at(&node.origin, Problem::OutOfRange { key, value, range })
                .with_hint(schema.get("description").and_then(Json::as_str).map(first_line)))
        }
        _ => Ok(()),
    }
}

fn check_length(schema: &Json, node: &Node, count: usize, path: &str) -> Result<(), DocumentError> {
    let bound = |name: &str| schema.get(name).and_then(Json::as_u64);
    let (least, most) = (bound("minItems"), bound("maxItems"));
    let length = count as u64;
    if least.is_none_or(|least| length >= least) && most.is_none_or(|most| length <= most) {
        return Ok(());
    }
    let allowed = match (least, most) {
        (Some(least), Some(most)) if least == most => format!("{least}"),
        (Some(least), Some(most)) => format!("{least} to {most}"),
        (Some(least), None) => format!("{least} or more"),
        (None, Some(most)) => format!("at most {most}"),
        (None, None) => String::new(),
    };
    let problem = Problem::WrongLength { key: path.to_owned(), count, allowed };
    Err(DocumentError::at(&node.origin, problem))
}

/// * `key`: the schema of the key, for what it says of it
fn wrong_type(schemas: &[&Json], node: &Node, path: &str, key: &Json) -> DocumentError {
    let mut expected: Vec<_> = schemas.iter().map(|schema| type_in_words(schema)).collect();
    expected.dedup();
    let problem = Problem::WrongType {
        key: path.to_owned(),
        found: node.describe(),
        expected: expected.join(" or "),
    };
    let hint = match &node.value {
        Value::String(text) if text.trim().parse::<f64>().is_ok() => {
            Some("a number is written without quotes".to_owned())
        }
        Value::String(text) if starts_with_number(text) => {
            Some("a number is written without its unit, which the key's name ends with".to_owned())
        }
        _ => key.get("description").and_then(Json::as_str).map(first_line),
    };
    DocumentError::at(&node.origin, problem).with_hint(hint)
}

/// Whether a text is a number with something after it, such as its unit.
fn starts_with_number(text: &str) -> bool {
    let end = text.find(|letter: char| !letter.is_ascii_digit() && !"+-.".contains(letter));
    end.is_some_and(|end| text[..end].parse::<f64>().is_ok())
}

/// Whether a value is of the schema's type. A whole number is a number, too.
fn fits(schema: &Json, node: &Node) -> bool {
    let wanted = schema.get("type").and_then(Json::as_str).unwrap_or_default();
    match &node.value {
        Value::String(_) => wanted == "string",
        Value::Integer(_) => wanted == "integer" || wanted == "number",
        Value::Float(_) => wanted == "number",
        Value::Boolean(_) => wanted == "boolean",
        Value::Date(_) => false,
        Value::List(_) => wanted == "array",
        Value::Table(_) => wanted == "object",
    }
}

fn type_in_words(schema: &Json) -> &'static str {
    match schema.get("type").and_then(Json::as_str) {
        Some("string") => "a text in quotes",
        Some("integer") => "a whole number",
        Some("number") => "a number",
        Some("boolean") => "true or false",
        Some("array") => "a list",
        _ => "a table",
    }
}

fn requires(schema: &Json, key: &str) -> bool {
    let required = schema.get("required").and_then(Json::as_array);
    required.is_some_and(|keys| keys.iter().any(|required| required == key))
}

/// Whether the soil's priors have to have put a value there, if the document has none.
fn waits_for_prior(schema: &Json) -> bool {
    schema.get("$comment").and_then(Json::as_str) == Some(FROM_PRIOR)
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

fn listed(words: &[&str]) -> String {
    quoted(words, '"')
}

/// `a`, `b` or `c`.
fn quoted(words: &[&str], quote: char) -> String {
    let quoted: Vec<_> = words.iter().map(|word| format!("{quote}{word}{quote}")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} or {last}", others.join(", ")),
        None => String::new(),
    }
}

fn first_line(description: &str) -> String {
    description.split("\n\n").next().unwrap_or_default().replace('\n', " ")
}

/// A `schema` that names no kind of document.
pub(crate) fn unknown_tag(tags: &[&str], node: &Node) -> DocumentError {
    match check_word(tags, node, "schema") {
        Err(error) => error,
        Ok(()) => DocumentError::at(&node.origin, Problem::Empty),
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, meant_keys, nearest};

    #[test]
    fn a_key_is_found_in_the_tables_that_have_it_and_without_its_unit() {
        for (kind, name, meant) in [
            (Kind::Rover, "mass_kg", &["body.mass_kg", "wheel_unit.mass_kg"][..]),
            (Kind::Rover, "radius", &["wheel_unit.wheel.radius_m"]),
            (Kind::Soil, "friction_angle", &["friction_angle_deg"]),
            (Kind::Scenario, "cohesion_kpa", &["soil.cohesion_kpa"]),
            (Kind::Scenario, "slope_deg", &["slope_deg"]),
            (Kind::Rover, "x", &[]),
        ] {
            assert_eq!(meant_keys(kind, name), meant, "{name}");
        }
    }

    #[test]
    fn a_misspelling_finds_what_was_meant_and_nothing_else() {
        let keys = ["cohesion_kpa", "friction_angle_deg", "density_kg_m3", "shear", "exit"];
        for (word, meant) in [
            ("cohesion", Some("cohesion_kpa")),
            ("Cohesion_kPa", Some("cohesion_kpa")),
            ("friction_angel_deg", Some("friction_angle_deg")),
            ("shaer", Some("shear")),
            ("radius_m", None),
            ("x", None),
        ] {
            assert_eq!(nearest(word, keys), meant, "{word}");
        }
    }

    #[test]
    fn a_word_longer_than_any_of_ours_is_none_of_them() {
        let names = ["cohesion_kpa", "friction_angle_deg"];
        assert_eq!(nearest("cohesion", names), Some("cohesion_kpa"));
        assert_eq!(nearest(&format!("cohesion_kp{}", "a".repeat(1 << 20)), names), None);
    }
}
