//! A document that was read: its keys in their own units, and the domain's value in SI.

use serde::Serialize;
use serde_json::{Map, Value as Json};

use super::describe;
use super::{Kind, UncertainSoil};
use grouser_core::contact::Theory;

/// The keys of a document in their own units: every named part in its place, every default filled in, keys
/// in the order of its kind. Serialised it is the document.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Document {
    keys: Json,
    #[serde(skip)]
    kind: Kind,
}

/// A document that was read: its keys, and the domain's value.
///
/// How wide is the wheel of HAKUTO, and what is assumed about it?
///
/// ```
/// use grouser_io::{Kind, Overrides, Source, read_wheel};
///
/// let wheel = read_wheel(&Source::find(Kind::Wheel, "hakuto")?, &Overrides::none())?;
/// assert_eq!(format!("{:.3} m", wheel.value.width), "0.080 m");
/// assert_eq!(wheel.document.number("width_m"), Some(0.08));
/// assert!(wheel.assumptions[2].contains("width_m: not printed"), "{:?}", wheel.assumptions);
/// assert!(wheel.to_toml().contains("width_m = 0.08"));
/// # Ok::<(), grouser_io::DocumentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded<V> {
    /// The document with every named part in its place and every default filled in.
    pub document: Document,
    /// Its meaning, in SI units and radians.
    pub value: V,
    /// The soils that it, or its soil, may be, if it says how well its numbers are known.
    pub uncertain: Option<UncertainSoil>,
    /// What was assumed, each with the name of the document that says so.
    pub assumptions: Vec<String>,
    /// Files that the resolved document names, to be written beside it.
    pub companions: Vec<Companion>,
}

/// A file that a resolved document names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Companion {
    /// Its name, from the folder of the document.
    pub name: String,
    /// What is in it.
    pub content: String,
}

impl<V> Loaded<V> {
    /// The resolved document as TOML: read again, with its [`companions`](Self::companions) beside
    /// it, it gives the same value.
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.document.to_toml()
    }

    /// A number by which the resolved document, with its companions, is known again: FNV-1a (Fowler,
    /// Noll, Vo) of 64 bits. It distinguishes documents that differ by chance, not by intent.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        let toml = self.to_toml();
        let companions = self.companions.iter().flat_map(|companion| companion.content.bytes());
        fnv_1a(toml.bytes().chain(companions))
    }
}

impl Document {
    /// The document of a kind with checked keys.
    pub fn of(kind: Kind, given: &Json) -> Self {
        let keys = describe::rows(kind).complete(given);
        Self { keys, kind }
    }

    /// The same with other keys, in their places.
    pub fn changed(&self, change: impl FnOnce(&mut Map<String, Json>)) -> Self {
        let mut keys = self.keys.clone();
        if let Json::Object(keys) = &mut keys {
            change(keys);
        }
        Self::of(self.kind, &keys)
    }

    /// The same with other values of some keys.
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
    pub fn keys(&self) -> &Json {
        &self.keys
    }

    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The document inside it at a dotted path.
    pub fn part(&self, kind: Kind, path: &str) -> Option<Self> {
        self.get(path).map(|given| Self::of(kind, given))
    }

    /// A table of it on its own.
    pub fn table(&self, key: &str) -> Self {
        Self { keys: self.keys.get(key).cloned().unwrap_or_default(), kind: self.kind }
    }

    /// What stands under a dotted key, entries of lists by their place. Keys may have the names of
    /// earlier versions.
    #[must_use]
    pub fn get(&self, path: &str) -> Option<&Json> {
        let under = |path: &str| {
            path.split('.').try_fold(&self.keys, |given, step| match given {
                Json::Array(all) => all.get(step.parse::<usize>().ok()?),
                given => given.get(step),
            })
        };
        under(path).or_else(|| under(&self.todays_key(path)))
    }

    /// A dotted key by the names of today.
    pub fn todays_key(&self, path: &str) -> String {
        let mut steps: Vec<String> = path.split('.').map(str::to_owned).collect();
        describe::rows(self.kind).rename_path(&mut steps, Some(&self.keys));
        steps.join(".")
    }

    /// The text under a dotted key.
    #[must_use]
    pub fn text(&self, path: &str) -> Option<&str> {
        self.get(path)?.as_str()
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
    pub fn theory(&self) -> Option<Theory> {
        self.theory_at("model")
    }

    pub fn theory_at(&self, path: &str) -> Option<Theory> {
        let name = self.text(path)?;
        Theory::ALL.into_iter().find(|theory| theory.name() == name)
    }

    /// The document as TOML.
    #[must_use]
    pub fn to_toml(&self) -> String {
        super::to_toml(self)
    }

    /// The dotted keys of all its numbers, entries of lists by their place.
    pub fn number_keys(&self) -> Vec<String> {
        number_keys(&self.keys)
    }
}

fn number_keys(given: &Json) -> Vec<String> {
    let mut children: Vec<(String, &Json)> = match given {
        Json::Object(keys) => keys.iter().map(|(key, given)| (key.clone(), given)).collect(),
        Json::Array(all) => {
            all.iter().enumerate().map(|(place, given)| (place.to_string(), given)).collect()
        }
        _ => Vec::new(),
    };
    if given.is_object() {
        children.sort_by(|one, other| one.0.cmp(&other.0));
    }
    let keys = children.into_iter().flat_map(|(key, given)| {
        if given.is_f64() {
            return vec![key];
        }
        number_keys(given).into_iter().map(|inner| format!("{key}.{inner}")).collect()
    });
    keys.collect()
}

/// FNV-1a with 64 bits (Fowler, Noll and Vo): tells bytes apart that differ by accident, not by
/// intent, and is the same for every compiler.
pub fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u64 {
    const BASIS: u64 = 0xCBF2_9CE4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01B3;
    bytes.fold(BASIS, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(PRIME))
}
