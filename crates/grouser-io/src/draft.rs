//! Drafts: documents made from answers to questions, for which a data sheet is enough.
//!
//! A question is a row of a document, or of a rover's data sheet: its key, unit, range and meaning
//! are declared there. What is not answered has a usual value, which may follow from earlier
//! answers; the document lists it under `assumed`, with the reason.
//!
//! ```
//! use grouser_io::draft::Draft;
//! use grouser_io::{Kind, Overrides, Source, read_rover};
//!
//! let mut draft = Draft::new(Kind::Rover).expect("rovers have drafts");
//! draft.answer("name", "Grasshopper")?;
//! draft.answer("total_mass_kg", "12.5")?;
//! draft.answer("track_m", "0.48")?;
//! let text = draft.finish()?;
//!
//! assert!(text.contains("assumed = ["));
//! let rover = read_rover(&Source::text("grasshopper", text), &Overrides::none())?.value;
//! assert!((rover.mass() - 12.5).abs() < 1e-3);
//! # Ok::<(), grouser_io::DocumentError>(())
//! ```

mod answers;
mod lines;
mod mission;
mod rover;
mod scenario;
mod soil;
mod wheel;

#[cfg(test)]
mod tests;

use std::sync::OnceLock;

use serde_json::{Map, Value as Json, json};

use super::check;
use super::describe::data_sheet::DATA_SHEET;
use super::error::{DocumentError, Problem};
use super::field::Rows as _;
use super::gravity::gravity;
use super::kind::Kind;
use super::overrides::{Overrides, answer_of};
use super::read::{read_rover, read_soil};
use super::schema::{root, under};
use super::source::Source;
use answers::{Answers, Usual};

/// The key under which words stand for numbers.
const GRAVITY: &str = "gravity_m_s2";

/// A question, as an application asks it.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The key that it is of, with the tables it stands in.
    pub key: &'static str,
    /// What is asked for, with its unit in brackets.
    pub doc: String,
    /// What a number may be, such as `0.1 to 50`.
    pub range: Option<String>,
    /// The value without an answer; none if the key is left out then.
    pub usual: Option<Json>,
    /// Why that.
    pub why: String,
}

/// Questions that are of no document: those of the data sheet, and the preset that a soil is like.
fn beside() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(|| {
        let mut schema = DATA_SHEET.schema(&mut Map::new());
        schema["properties"][soil::LIKE] = json!({
            "type": "string",
            "minLength": 1,
            "description": "The preset of a soil that it is like: from this one come the values \
                            without an answer.",
        });
        schema["properties"][soil::KNOWN] = json!({
            "type": "string",
            "enum": ["this-bed", "this-soil", "copied"],
            "description": "How well the constants that are given are known: measured on the bed that is driven \
                            on (`this-bed`), on this soil elsewhere (`this-soil`), or taken from a \
                            table or a guess (`copied`).",
        });
        schema
    })
}

/// What people write for a value, as the document has it.
fn translated(key: &str, answer: &str) -> String {
    let named = if key == GRAVITY { gravity(answer) } else { None };
    named.map_or_else(|| answer.to_owned(), |value| value.to_string())
}

/// Whether a key takes a text, or the name of a document.
fn is_text(schema: &Json) -> bool {
    let is_string = |schema: &Json| schema["type"] == "string";
    let choices = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema[key].as_array());
    is_string(schema) || choices.flatten().any(is_string)
}

/// A document in the making.
#[derive(Clone, Debug)]
pub struct Draft {
    answers: Answers,
}

impl Draft {
    /// A draft without answers; none of a kind that has no questions.
    #[must_use]
    pub fn new(kind: Kind) -> Option<Self> {
        let usual = match kind {
            Kind::Rover => rover::usual,
            Kind::Wheel => wheel::usual,
            Kind::Soil => soil::usual,
            Kind::Scenario => scenario::usual,
            Kind::Mission => mission::usual,
            Kind::Motor
            | Kind::DataSet
            | Kind::Campaign
            | Kind::Design
            | Kind::Prior
            | Kind::TelemetryMapping => {
                return None;
            }
        };
        Some(Self { answers: Answers { kind, given: Map::new(), usual } })
    }

    /// The keys of the questions, in their order.
    #[must_use]
    pub fn keys(&self) -> &'static [&'static str] {
        match self.answers.kind {
            Kind::Rover => &rover::KEYS,
            Kind::Wheel => &wheel::KEYS,
            Kind::Soil => &soil::KEYS,
            Kind::Scenario => &scenario::KEYS,
            Kind::Mission => &mission::KEYS,
            Kind::Motor
            | Kind::DataSet
            | Kind::Campaign
            | Kind::Design
            | Kind::Prior
            | Kind::TelemetryMapping => &[],
        }
    }

    /// A question, with the value that it has without an answer.
    ///
    /// # Errors
    /// [`DocumentError`] if there is no such question.
    pub fn question(&self, key: &str) -> Result<Question, DocumentError> {
        let key = self.key(key)?;
        let (root, schemas) = self.schemas(key);
        let doc = schemas.iter().find_map(|schema| schema["description"].as_str());
        let Usual { value, why } = self.answers.usual(key);
        Ok(Question {
            key,
            doc: self.context(key) + doc.and_then(|doc| doc.lines().next()).unwrap_or_default(),
            range: schemas.iter().find_map(|schema| check::range_in_words(root, schema)),
            usual: value,
            why,
        })
    }

    /// Whether a question was answered.
    #[must_use]
    pub fn is_answered(&self, key: &str) -> bool {
        self.answers.is_given(key)
    }

    /// The text that a question was answered with.
    #[must_use]
    pub fn text_of(&self, key: &str) -> Option<String> {
        self.answers.given.get(key)?.as_str().map(str::to_owned)
    }

    /// Answers a question.
    ///
    /// * `answer`: as TOML has it; a text needs no quotes
    ///
    /// # Errors
    /// [`DocumentError`] if there is no such question, or the answer is not of its type or range.
    pub fn answer(&mut self, key: &str, answer: &str) -> Result<(), DocumentError> {
        let key = self.key(key)?;
        let (root, schemas) = self.schemas(key);
        let is_text = schemas.iter().all(|schema| is_text(schema));
        let answer = translated(key, answer.trim());
        let node = answer_of(key, &answer, is_text)?;
        check::answer(root, &schemas, &node, key)?;
        self.check_name(key, &answer)?;
        let is_number = schemas.iter().any(|schema| schema["type"] == "number");
        let given = node.to_json();
        let number = given.as_f64().filter(|_| is_number);
        self.answers.given.insert(key.to_owned(), number.map_or(given, Json::from));
        Ok(())
    }

    /// What the table of a key is of, before its own sentence: `Mass [kg].` alone says too little.
    fn context(&self, key: &str) -> String {
        let Some((table, _)) = key.rsplit_once('.') else { return String::new() };
        let tables = under(root(self.answers.kind), table, None);
        let doc = tables.iter().find_map(|schema| schema["description"].as_str());
        let clause = doc.and_then(|doc| doc.split([':', ';', '.', ',']).next()).unwrap_or_default();
        // A wheel's keys say themselves that they are of the rim.
        if clause.is_empty() || table.ends_with("wheel") {
            String::new()
        } else {
            format!("{clause}: ")
        }
    }

    /// Whether a question makes no difference after the earlier answers.
    #[must_use]
    pub fn is_idle(&self, key: &str) -> bool {
        let height = key.strip_suffix("count").filter(|table| table.ends_with("grousers."));
        height.is_some_and(|table| self.answers.number(&format!("{table}height_m")) <= 0.0)
    }

    /// Checks that a document that an answer names exists and has no fault.
    fn check_name(&self, key: &str, answer: &str) -> Result<(), DocumentError> {
        match (self.answers.kind, key) {
            (Kind::Scenario | Kind::Mission, "rover") => {
                read_rover(&Source::find(Kind::Rover, answer)?, &Overrides::none()).map(drop)
            }
            (Kind::Scenario | Kind::Mission, "soil") => {
                read_soil(&Source::find(Kind::Soil, answer)?, &Overrides::none()).map(drop)
            }
            (Kind::Soil, soil::LIKE) => soil::check_preset(answer),
            _ => Ok(()),
        }
    }

    /// The tables of the preset that a soil is like which the document leaves out, as they are of
    /// the preset's own tests: its uncertainty, its domain and so on.
    #[must_use]
    pub fn not_kept(&self) -> Vec<&'static str> {
        if self.answers.kind == Kind::Soil { self.answers.not_kept() } else { Vec::new() }
    }

    /// The document as TOML, with a comment for each number; what was not answered is in it with
    /// its usual value, or left out.
    ///
    /// # Errors
    /// [`DocumentError`] if the answers do not go together.
    pub fn finish(&self) -> Result<String, DocumentError> {
        match self.answers.kind {
            Kind::Rover => self.answers.rover(),
            Kind::Wheel => Ok(self.answers.wheel()),
            Kind::Soil => Ok(self.answers.soil()),
            Kind::Scenario => Ok(self.answers.scenario()),
            Kind::Mission => Ok(self.answers.mission()),
            Kind::Motor
            | Kind::DataSet
            | Kind::Campaign
            | Kind::Design
            | Kind::Prior
            | Kind::TelemetryMapping => Ok(String::new()),
        }
    }

    fn key(&self, key: &str) -> Result<&'static str, DocumentError> {
        let keys = self.keys();
        if let Some(known) = keys.iter().find(|known| **known == key) {
            return Ok(known);
        }
        let hint = check::nearest(key, keys.iter().copied()).map_or_else(
            || format!("the questions are {}", keys.join(", ")),
            |meant| format!("did you mean `{meant}`? the questions are {}", keys.join(", ")),
        );
        let problem = Problem::Malformed("there is no such question");
        Err(DocumentError::whole(super::escape::line(key).into_owned(), problem).with_hint(hint))
    }

    /// What a key may be: of the data sheet, or of the document under each of its laws. Before it,
    /// where their references lead.
    fn schemas(&self, key: &str) -> (&'static Json, Vec<&'static Json>) {
        let beside = beside();
        let own = under(beside, key, None);
        if !own.is_empty()
            && matches!(
                (self.answers.kind, key),
                (Kind::Rover, _) | (Kind::Soil, soil::LIKE | soil::KNOWN)
            )
        {
            return (beside, own);
        }
        let root = root(self.answers.kind);
        let law =
            if self.answers.kind == Kind::Soil { self.answers.law_of_soil(key) } else { None };
        (root, under(root, key, law.as_deref()))
    }
}
