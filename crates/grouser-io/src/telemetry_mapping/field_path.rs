//! Fields of messages: where a number stands in a tree of values.
//!
//! A path has names with dots between them, `pose.position.x`; `[2]` is an element of a list by its
//! place, and `[name=PATTERN]` by a name, either that of the element itself
//! (`joints[name=…].velocity`) or that at the same place of the list beside it (`velocity[name=…]`,
//! as in `sensor_msgs/JointState`).
//!
//! A tree made of the columns of a table has no lists: there `[2]` is what is called 2, and
//! `velocity[name=PATTERN]` the velocity of what has that name, `front_left/velocity`.

use serde_json::Value;

/// A path to a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldPath(Vec<Step>);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Step {
    Name(String),
    Place(usize),
    /// The element of a list that has a name.
    Named {
        list: String,
        key: String,
        patterns: Vec<String>,
    },
}

/// What stands at a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Found<'v> {
    /// A value.
    One(&'v Value),
    /// None.
    Nothing,
    /// Several elements have a name that fits.
    Several,
}

impl FieldPath {
    /// The path that a text stands for; `None` if the text is not a path.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let mut steps = Vec::new();
        let mut rest = text;
        loop {
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            let (name, after) = rest.split_at(end);
            if name.trim().is_empty() {
                return None;
            }
            steps.push(Step::Name(name.trim().to_owned()));
            rest = after;
            while let Some(inner) = rest.strip_prefix('[') {
                let (element, after) = inner.split_once(']')?;
                add_element(&mut steps, element)?;
                rest = after;
            }
            match rest.strip_prefix('.') {
                Some(after) => rest = after,
                None if rest.is_empty() => return Some(Self(steps)),
                None => return None,
            }
        }
    }

    /// What stands there.
    #[must_use]
    pub fn find<'v>(&self, tree: &'v Value) -> Found<'v> {
        let mut here = tree;
        for step in &self.0 {
            let next = match step {
                Step::Name(name) => here.get(name),
                Step::Place(place) => here.get(place).or_else(|| here.get(place.to_string())),
                Step::Named { list, key, patterns } => match named(here, list, key, patterns) {
                    Found::One(value) => Some(value),
                    other => return other,
                },
            };
            let Some(next) = next else { return Found::Nothing };
            here = next;
        }
        Found::One(here)
    }

    /// The value that the last name is a field of, and that name.
    #[must_use]
    pub fn parent<'v>(&self, tree: &'v Value) -> Option<(&'v Value, &str)> {
        let (Step::Name(last), before) = self.0.split_last()? else { return None };
        match Self(before.to_vec()).find(tree) {
            Found::One(parent) => Some((parent, last)),
            _ => None,
        }
    }
}

/// Adds what stands in brackets to the name before it.
fn add_element(steps: &mut Vec<Step>, element: &str) -> Option<()> {
    let Some((key, patterns)) = element.split_once('=') else {
        steps.push(Step::Place(element.trim().parse().ok()?));
        return Some(());
    };
    let Some(Step::Name(list)) = steps.pop() else { return None };
    let patterns: Vec<String> = patterns.split('|').map(plain).collect();
    if key.trim().is_empty() || patterns.iter().any(String::is_empty) {
        return None;
    }
    steps.push(Step::Named { list, key: key.trim().to_owned(), patterns });
    Some(())
}

/// The element with a name: that of the first pattern that fits one alone.
fn named<'v>(parent: &'v Value, list: &str, key: &str, patterns: &[String]) -> Found<'v> {
    let elements = elements(parent, list, key);
    let mut several = false;
    for pattern in patterns {
        let mut fitting = elements.iter().filter(|(name, _)| matches(pattern, name));
        match (fitting.next(), fitting.next()) {
            (Some((_, element)), None) => return Found::One(element),
            (Some(_), Some(_)) => several = true,
            (None, _) => {}
        }
    }
    if several { Found::Several } else { Found::Nothing }
}

/// What has a name of a list, each with it.
fn elements<'v>(parent: &'v Value, list: &str, key: &str) -> Vec<(String, &'v Value)> {
    let named = |(name, value): (&String, &'v Value)| (plain(name), value);
    match parent.get(list) {
        Some(Value::Array(elements)) => {
            let beside = parent.get(key).and_then(Value::as_array);
            let named = |(place, element): (usize, &'v Value)| {
                let name = element.get(key).or_else(|| beside?.get(place))?.as_str()?;
                Some((plain(name), element))
            };
            elements.iter().enumerate().filter_map(named).collect()
        }
        Some(Value::Object(elements)) => elements.iter().map(named).collect(),
        Some(_) => Vec::new(),
        None => {
            let all = parent.as_object().into_iter().flatten();
            all.filter_map(|(name, element)| Some((plain(name), element.get(list)?))).collect()
        }
    }
}

/// A name in small letters, with one mark for all that parts words.
#[must_use]
pub fn plain(name: &str) -> String {
    let letter = |c: char| match c {
        '*' | '{' | '}' | '/' => c,
        c if c.is_alphanumeric() => c.to_ascii_lowercase(),
        _ => '_',
    };
    name.trim().chars().map(letter).collect()
}

/// Whether a name is as a pattern has it, where `*` stands for any letters.
#[must_use]
pub fn matches(pattern: &str, name: &str) -> bool {
    let Some((first, mut rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut name) = name.strip_prefix(first) else { return false };
    while let Some((part, after)) = rest.split_once('*') {
        let Some(at) = name.find(part) else { return false };
        name = &name[at + part.len()..];
        rest = after;
    }
    name.ends_with(rest)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn number(path: &str, tree: &Value) -> Option<f64> {
        match FieldPath::parse(path).unwrap().find(tree) {
            Found::One(value) => value.as_f64(),
            _ => None,
        }
    }

    #[test]
    fn fields_are_found_by_name_place_and_the_name_beside() {
        let tree = json!({
            "pose": {"position": {"x": 1.5}},
            "name": ["front_left_wheel", "FL-steer"],
            "velocity": [0.5, 0.25],
            "joints": [{"name": "a", "velocity": 1.0}, {"name": "b", "velocity": 2.0}],
        });
        assert_eq!(number("pose.position.x", &tree), Some(1.5));
        assert_eq!(number("velocity[1]", &tree), Some(0.25));
        assert_eq!(number("velocity[name=Front-Left*]", &tree), Some(0.5));
        assert_eq!(number("velocity[name=none|fl_*]", &tree), Some(0.25));
        assert_eq!(number("joints[name=b].velocity", &tree), Some(2.0));
        let columns = json!({
            "front-left": {"velocity": 0.5, "position": 1.0},
            "joints": {"a": {"velocity": 1.5}},
            "samples": {"2": 2.5},
        });
        assert_eq!(number("velocity[name=front_*]", &columns), Some(0.5));
        assert_eq!(number("joints[name=a].velocity", &columns), Some(1.5));
        assert_eq!(number("samples[2]", &columns), Some(2.5));
        assert_eq!(number("velocity[name=samples]", &columns), None);
        let several = FieldPath::parse("velocity[name=*]").unwrap();
        assert_eq!(several.find(&tree), Found::Several);
        assert_eq!(number("velocity[name=rear]", &tree), None);
    }

    #[test]
    fn what_is_no_path_is_refused() {
        for text in ["", ".x", "a..b", "a[", "a[=b]", "a[name=]", "a]b[", "[0]", "a[x]", "a[0]b"] {
            assert!(FieldPath::parse(text).is_none(), "{text}");
        }
    }
}
