//! A document after it was read: its keys in their own words and units, completed and checked.

use serde::Serialize;
use serde_json::{Map, Value as Json};

use super::describe;
use super::describe::run::TERRAIN;
use super::kind::{Kind, PRIORS_KEY};
use grouser_core::contact::Model;

/// The keys of a document in their own units: every named part in its place, every default filled
/// in, keys in the order of its kind. Serialised it is the document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Document {
    keys: Json,
    #[serde(skip)]
    kind: Kind,
}

impl Document {
    /// The document of a kind with checked keys.
    #[must_use]
    pub fn of(kind: Kind, given: &Json) -> Self {
        let keys = describe::rows(kind).complete(given);
        Self { keys, kind }
    }

    /// The same with other keys, in their places.
    #[must_use]
    pub fn changed(&self, change: impl FnOnce(&mut Map<String, Json>)) -> Self {
        let mut keys = self.keys.clone();
        if let Json::Object(keys) = &mut keys {
            change(keys);
        }
        Self::of(self.kind, &keys)
    }

    /// The same with other values of some keys.
    #[must_use]
    pub fn with<'k>(&self, values: impl IntoIterator<Item = (&'k str, f64)>) -> Self {
        let mut changed = self.clone();
        for (path, value) in values {
            let pointer = format!("/{}", path.replace('.', "/"));
            if let Some(number) = changed.keys.pointer_mut(&pointer) {
                *number = Json::from(value);
            }
        }
        changed
    }

    /// All keys.
    pub(crate) fn keys(&self) -> &Json {
        &self.keys
    }

    /// What kind of document it is.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The document inside it at a dotted path.
    #[must_use]
    pub fn part(&self, kind: Kind, path: &str) -> Option<Self> {
        self.get(path).map(|given| Self::of(kind, given))
    }

    /// A table of it on its own.
    #[must_use]
    pub fn table(&self, key: &str) -> Self {
        Self { keys: self.keys.get(key).cloned().unwrap_or_default(), kind: self.kind }
    }

    /// What stands under a dotted key, entries of lists by their place.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&Json> {
        path.split('.').try_fold(&self.keys, |given, step| match given {
            Json::Array(all) => all.get(step.parse::<usize>().ok()?),
            given => given.get(step),
        })
    }

    /// The text under a dotted key.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<&str> {
        self.get(path)?.as_str()
    }

    /// The name of a part of it, such as `rover`; `unnamed` where it has none.
    #[must_use]
    pub fn name_of(&self, part: &str) -> &str {
        let name = self.get(part).and_then(|part| part.get("name"));
        name.and_then(Json::as_str).unwrap_or("unnamed")
    }

    /// The number under a dotted key, in the unit of the key. Counts are no numbers here.
    #[must_use]
    pub fn number(&self, path: &str) -> Option<f64> {
        self.get(path).filter(|given| given.is_f64())?.as_f64()
    }

    /// Its name.
    #[must_use]
    pub fn name(&self) -> &str {
        self.text("name").unwrap_or_default()
    }

    /// The stated source of its values.
    #[must_use]
    pub fn source(&self) -> &str {
        self.text("source").unwrap_or_default()
    }

    /// The wheel–soil model that a soil was made for, or a scenario asks for, if stated.
    #[must_use]
    pub fn model(&self) -> Option<Model> {
        self.model_at("model")
    }

    /// The wheel–soil model that a scenario's soil was made for, if stated.
    #[must_use]
    pub fn model_of_soil(&self) -> Option<Model> {
        self.model_at("soil.model")
    }

    /// The wheel–soil model that a soil is computed with where nobody asks for another: that which
    /// it was made for; without one `ishigami`, but `small-wheel` for a soil that leaves its wheel
    /// sinkage ratio to priors: of the models it misses published wheel tests least where nothing
    /// is fitted.
    ///
    /// * `place`: the key of the soil, or nothing if the document is one
    #[must_use]
    pub fn usual_model(&self, place: &str) -> Model {
        let key =
            |key: &str| if place.is_empty() { key.to_owned() } else { format!("{place}.{key}") };
        let left_to_priors = || self.leaves_sinkage_ratio_to_priors(place);
        let usual = || if left_to_priors() { Model::SmallWheel } else { Model::Ishigami };
        self.model_at(&key("model")).unwrap_or_else(usual)
    }

    /// Whether a soil leaves its wheel sinkage ratio to priors.
    ///
    /// * `place`: the key of the soil, or nothing if the document is one
    #[must_use]
    pub fn leaves_sinkage_ratio_to_priors(&self, place: &str) -> bool {
        let key = if place.is_empty() {
            "priors.missing".to_owned()
        } else {
            format!("{place}.priors.missing")
        };
        let rows = self.get(&key).and_then(Json::as_array);
        rows.is_some_and(|rows| rows.iter().any(|row| row["key"] == "exit.ratio"))
    }

    /// The wheel–soil model that stands under a dotted key, if there is one.
    #[must_use]
    pub fn model_at(&self, path: &str) -> Option<Model> {
        let name = self.text(path)?;
        Model::ALL.into_iter().find(|model| model.name() == name)
    }

    /// A line that says which model a single answer has, where nobody names one and it is not the
    /// usual one; empty elsewhere.
    ///
    /// * `soil`: the key of the soil, or nothing if the document is one
    #[must_use]
    pub fn usual_model_line(&self, soil: &str) -> String {
        let of_soil = if soil.is_empty() { None } else { self.model_of_soil() };
        let is_named = self.model().or(of_soil).is_some();
        if is_named || !self.leaves_sinkage_ratio_to_priors(soil) {
            return String::new();
        }
        let model = self.usual_model(soil);
        let model = model.name();
        format!("model: {model}, as the soil leaves its wheel sinkage ratio to priors\n")
    }

    /// A line on ground with heights that an answer leaves aside, as it is about planes of the slopes
    /// that are asked for; empty for a document without.
    #[must_use]
    pub fn plane_line(&self) -> String {
        let has_heights = self.get(TERRAIN).is_some();
        let line = "ground: planes of the slopes that are asked for; the [terrain] is not used\n";
        if has_heights { line.to_owned() } else { String::new() }
    }

    /// The document as TOML.
    #[must_use]
    pub fn to_toml(&self) -> String {
        to_toml(self)
    }

    /// The dotted keys of all its numbers, entries of lists by their place; those of priors are no
    /// numbers of a soil.
    #[must_use]
    pub fn number_keys(&self) -> Vec<String> {
        number_keys(&self.keys)
    }
}

fn number_keys(given: &Json) -> Vec<String> {
    let mut children: Vec<(String, &Json)> = match given {
        Json::Object(keys) => {
            let own = keys.iter().filter(|(key, _)| *key != PRIORS_KEY);
            own.map(|(key, given)| (key.clone(), given)).collect()
        }
        Json::Array(all) => {
            all.iter().enumerate().map(|(place, given)| (place.to_string(), given)).collect()
        }
        _ => Vec::new(),
    };
    if given.is_object() {
        children.sort_by(|one, other| one.0.cmp(&other.0));
    }
    // The ends of a domain's ranges are no numbers of what is described: nothing is computed from
    // them.
    children.retain(|(key, _)| key != "domain");
    let keys = children.into_iter().flat_map(|(key, given)| {
        if given.is_f64() {
            return vec![key];
        }
        number_keys(given).into_iter().map(|inner| format!("{key}.{inner}")).collect()
    });
    keys.collect()
}

/// A document as TOML.
///
/// # Panics
/// Never: documents have text keys and finite numbers only.
#[must_use]
pub fn to_toml<D: Serialize>(document: &D) -> String {
    toml::to_string_pretty(document).expect("text keys and finite numbers")
}
