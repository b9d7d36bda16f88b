//! Numbers of a document by their keys: their ranges, and the domain's value with other numbers in
//! their place.
//!
//! Campaigns, calibrations, uncertain soils and rollouts all give keys other values here, by the
//! rows of the document's table and without a document for each.

use std::ops::RangeInclusive;

use super::check::nearest;
use super::document::Document;
use super::error::{DocumentError, Problem};
use super::given_file::NamedFiles;
use super::kind::Kind;
use super::schema::range;
use super::tree::{Node, Origin};
use super::unit::unit_of;
use super::values::{Described, Misfit};
use grouser_core::error::ParameterError;
use grouser_core::simulation::Scenario;

/// A value whose numbers are exchanged, and what its document says.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied<V> {
    /// The value, in SI units and radians.
    pub value: V,
    /// Its document, in the units of the keys.
    pub document: Document,
    /// What there is to say of files that it names.
    pub files: NamedFiles,
}

/// A number of a document, under a key.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// The key, with the tables it stands in.
    pub path: String,
    /// What the document says, in the key's unit.
    pub value: f64,
    /// What it may be under the laws that the document follows.
    pub range: RangeInclusive<f64>,
}

/// Numbers that may be given other values.
pub trait Numbers {
    /// The number under a key.
    ///
    /// # Errors
    /// [`NoNumber`] if there is none.
    fn key(&self, path: &str) -> Result<Key, NoNumber>;

    /// Checks that some keys may have these values together.
    ///
    /// # Errors
    /// [`Misfit`] if they may not.
    fn check_with(&self, keys: &[Key], values: &[f64]) -> Result<(), Misfit>;
}

impl<V> Varied<V> {
    /// A value whose files nobody is told of.
    pub fn of(value: V, document: Document) -> Self {
        Self { value, document, files: NamedFiles::default() }
    }
}

impl<V: Described> Varied<V> {
    /// What a document means.
    ///
    /// * `tree`: where it was written
    ///
    /// # Errors
    /// [`DocumentError`] for values that do not go together, with their place.
    pub fn new(document: Document, tree: &Node) -> Result<Self, DocumentError> {
        let (value, files) = V::read(&document, tree)?;
        Ok(Self { value, document, files })
    }

    /// The value with others under some keys.
    ///
    /// # Errors
    /// [`Misfit`] if the new values do not go together.
    pub fn with(&self, keys: &[Key], values: &[f64]) -> Result<V, Misfit> {
        self.value.with(keys.iter().map(|key| &*key.path).zip(values.iter().copied()))
    }
}

impl<V: Described> Numbers for Varied<V> {
    fn key(&self, path: &str) -> Result<Key, NoNumber> {
        let value = self.document.number(path);
        value
            .zip(self.value.range(path))
            .map(|(value, range)| Key { path: path.to_owned(), value, range })
            .ok_or_else(|| {
                let lacking = NoNumber::of(&self.document, path);
                // What keeps the key from being a number, where a rule between keys does.
                let hint = self.value.check_without(path, f64::NAN).err().and_then(Misfit::hint);
                NoNumber { hint: lacking.hint.or(hint), ..lacking }
            })
    }

    fn check_with(&self, keys: &[Key], values: &[f64]) -> Result<(), Misfit> {
        self.with(keys, values).map(drop)
    }
}

impl Key {
    /// A value that it must not have.
    pub(crate) fn out_of_range(&self, value: f64) -> Problem {
        Problem::OutOfRange { key: self.path.clone(), value, range: self.range_in_words() }
    }

    /// How far its number has to go for what depends on it to change by as much as it is: its size,
    /// or where that is small what is small in its unit.
    #[must_use]
    pub fn scale(&self) -> f64 {
        let small = match unit_of(&self.path).map(|unit| unit.symbol) {
            Some("°") => 5.0,
            Some("kPa") => 1.0,
            Some("m") => 0.01,
            _ => 0.1,
        };
        self.value.abs().max(small)
    }

    pub(crate) fn range_in_words(&self) -> String {
        format!("{} to {}", self.range.start(), self.range.end())
    }
}

/// The same run with other numbers under some keys of its document, in the keys' units.
///
/// # Errors
/// [`ParameterError`] if they are no run together.
pub fn scenario_with<'k>(
    scenario: &Scenario,
    numbers: impl IntoIterator<Item = (&'k str, f64)>,
) -> Result<Scenario, ParameterError> {
    scenario.with(numbers).map_err(Misfit::of_numbers)
}

/// A key without a number.
pub struct NoNumber {
    /// What is wrong.
    pub problem: Problem,
    /// How it may be mended.
    pub hint: Option<String>,
    /// Whether other documents of its kind have the key, and this one gives it no value.
    pub is_lacking: bool,
}

impl NoNumber {
    fn of(document: &Document, path: &str) -> Self {
        let key = path.escape_debug().to_string();
        if document.get(path).is_some() {
            let whole = if document.kind() == Kind::Soil { "this soil" } else { "what is varied" };
            let problem = Problem::NotANumber { key, whole };
            return Self { problem, hint: None, is_lacking: false };
        }
        let is_lacking = range(document.kind(), path).is_some();
        let hint = if is_lacking {
            "the document gives this key no value: give it one first, if its law has the key"
                .to_owned()
        } else {
            meant_number(document, path)
        };
        Self { problem: Problem::UnknownKey { key }, hint: Some(hint), is_lacking }
    }

    pub(crate) fn at(self, origin: &Origin) -> DocumentError {
        DocumentError::at(origin, self.problem).with_hint(self.hint)
    }
}

/// What a misspelt key was meant to be, or all that it could have been.
#[must_use]
pub fn meant(name: &str, known: &[&str]) -> String {
    let last = |key: &str| key.rsplit('.').next().unwrap_or_default().to_owned();
    let same_end = known.iter().copied().find(|key| last(key) == last(name));
    match same_end.or_else(|| nearest(name, known.iter().copied())) {
        Some(key) => format!("did you mean `{key}`?"),
        None => format!("there are {}", known.join(", ")),
    }
}

/// The same among the numbers of a document.
pub fn meant_number(document: &Document, name: &str) -> String {
    let known = document.number_keys();
    meant(name, &known.iter().map(String::as_str).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::super::{Overrides, Source, read_scenario};
    use super::*;

    fn with(settings: &[&str]) -> Scenario {
        let overrides = Overrides::parse(settings).unwrap();
        read_scenario(&Source::default_scenario(), &overrides).unwrap().value
    }

    /// The key in a document and the number put in its place mean the same, for each drive.
    #[test]
    fn what_is_put_is_what_a_document_says() {
        let numbers = [
            ("slope_deg", 21.5),
            ("start.yaw_deg", -7.25),
            ("gravity_m_s2", 1.62),
            ("duration_s", 12.5),
            ("soil.cohesion_kpa", 0.25),
        ];
        for (law, speed) in [("constant", "rim_speed_m_s"), ("eq18", "ground_speed_m_s")] {
            let (law, speed) = (format!("scenario.drive.law={law}"), format!("drive.{speed}"));
            for (key, value) in numbers.into_iter().chain([(&*speed, 0.045)]) {
                let put = scenario_with(&with(&[&law]), [(key, value)]).unwrap();
                assert_eq!(put, with(&[&law, &format!("scenario.{key}={value}")]));
            }
        }
        let each = with(&["scenario.drive.rim_speed_m_s=[0.01, 0.02, 0.03, 0.04]"]);
        let one = scenario_with(&each, [("drive.rim_speed_m_s", 0.045)]).unwrap();
        assert_eq!(one, with(&["scenario.drive.rim_speed_m_s=0.045"]));
    }

    #[test]
    fn numbers_that_do_not_go_together_are_refused() {
        let eq18 = with(&["scenario.drive.law=eq18"]);
        for (key, value) in
            [("duration_s", 1e6), ("drive.ground_speed_m_s", -1.0), ("slope_deg", f64::NAN)]
        {
            assert!(scenario_with(&eq18, [(key, value)]).is_err(), "{key}");
        }
    }

    /// A slope beside ground with heights, which inclines it: also where no number is given.
    #[test]
    fn rules_between_keys_are_those_of_documents() {
        let terrain = ["scenario.terrain.surface=incline", "scenario.terrain.slope_deg=5"];
        let read = |slope: &str| {
            let settings = [terrain[0], terrain[1], slope];
            let overrides = Overrides::parse(settings).unwrap();
            read_scenario(&Source::default_scenario(), &overrides)
        };
        let level = read("scenario.slope_deg=0").unwrap();
        let put = scenario_with(&level.value, [("slope_deg", 8.0)]).unwrap_err().to_string();
        let in_document = read("scenario.slope_deg=8").unwrap_err().to_string();
        assert!(in_document.contains(&put) && put.contains("[terrain]"), "{put}: {in_document}");
        assert_eq!(scenario_with(&level.value, [("slope_deg", 0.0)]).unwrap(), level.value);
        let (value, document) = (level.value.clone(), level.document.clone());
        let varied = Varied::of(value, document);
        let hint = varied.key("slope_deg").err().and_then(|lacking| lacking.hint);
        assert!(hint.unwrap().contains("[terrain]"));
    }
}
