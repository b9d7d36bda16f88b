//! The numbers of a soil's document by their dotted keys, to be given other values.

use super::check::nearest;
use super::soil::SoilDocument;

/// A soil's document without what it says in words.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SoilNumbers(toml::Value);

impl SoilNumbers {
    pub(super) fn of(soil: &SoilDocument) -> Self {
        let words = ["name", "source", "date", "notes", "assumed", "uncertainty", "model"];
        let mut tree =
            toml::Value::try_from(soil).unwrap_or(toml::Value::Table(toml::Table::new()));
        if let Some(table) = tree.as_table_mut() {
            table.retain(|key, _| !words.contains(&key));
        }
        Self(tree)
    }

    /// The number of a key, if it is one.
    pub(super) fn value(&self, path: &str) -> Option<f64> {
        lookup(&self.0, path).and_then(toml::Value::as_float)
    }

    /// What a misspelt key was meant to be.
    pub(super) fn meant(&self, path: &str) -> String {
        let known = numbers(&self.0);
        meant(path, &known.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// The document with other values of some keys, without its words; `None` if a key is not there or
    /// cannot have its value.
    pub(super) fn with<'k>(
        &self,
        values: impl IntoIterator<Item = (&'k str, f64)>,
    ) -> Option<SoilDocument> {
        let mut tree = self.0.clone();
        for (path, value) in values {
            *lookup_mut(&mut tree, path)? = toml::Value::Float(value);
        }
        tree.try_into().ok()
    }
}

/// What stands under a dotted key.
pub(super) fn lookup<'t>(tree: &'t toml::Value, path: &str) -> Option<&'t toml::Value> {
    path.split('.').try_fold(tree, |node, step| node.as_table()?.get(step))
}

fn lookup_mut<'t>(tree: &'t mut toml::Value, path: &str) -> Option<&'t mut toml::Value> {
    path.split('.').try_fold(tree, |node, step| node.as_table_mut()?.get_mut(step))
}

/// The dotted keys of all numbers of a tree.
fn numbers(tree: &toml::Value) -> Vec<String> {
    let mut found = Vec::new();
    for (key, node) in tree.as_table().into_iter().flatten() {
        match node {
            toml::Value::Float(_) => found.push(key.clone()),
            node => found.extend(numbers(node).into_iter().map(|inner| format!("{key}.{inner}"))),
        }
    }
    found
}

/// What a misspelt key was meant to be, or all that it could have been.
pub(super) fn meant(name: &str, known: &[&str]) -> String {
    let same_end = known.iter().copied().find(|key| key.rsplit('.').next() == Some(name));
    match same_end.or_else(|| nearest(name, known.iter().copied())) {
        Some(key) => format!("did you mean `{key}`?"),
        None => format!("there are {}", known.join(", ")),
    }
}
