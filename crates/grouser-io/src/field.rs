//! The rows that declare the keys of documents: key, unit, range, description and domain field of a
//! number are declared in one row of a [`Table`] and nowhere else.
//!
//! Reading, checks, messages, JSON Schema, conversion to SI, `--set`, the keys of campaigns and
//! calibrations are made from these rows. The tables themselves are in
//! [`describe`](super::describe).

use std::ops::RangeInclusive;

use serde_json::Value as Json;

use super::kind::Kind;
use super::tree::Node;
pub(crate) use super::unit::{
    A, DEG, DEG_C, DEG_S, J_K, J_PER_M, K_W, KG, KG_M2, KG_M3, KPA, M, M_PER_RAD, M_PER_RAD2, M_S,
    M_S2, N, NM, NM_A, OF_KEY, OHM, ONE, RAD, S, Unit, V, V_RAD, V_S_RAD, W, WH,
};
use super::unit::{DIRECTION_DEG, less_whole_turns};

/// The keys of a document, or of a table in it, in the order in which they are written.
///
/// `T` is the domain's value that the numbers go to.
pub(crate) struct Table<T: 'static> {
    /// What it describes.
    pub doc: &'static str,
    pub fields: &'static [Field<T>],
}

/// A key.
pub(crate) struct Field<T: 'static> {
    pub key: &'static str,
    /// The key under which its number may stand in thousands of its unit.
    pub in_thousands: Option<&'static str>,
    /// What it is: a sentence; of a number without its unit and full stop.
    pub doc: &'static str,
    pub presence: Presence,
    /// The key without which it means nothing.
    pub only_with: Option<&'static str>,
    pub shape: Shape<T>,
}

/// What a document that does not have a key means.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Presence {
    /// Something is missing.
    Needed,
    /// Nothing; a resolved document does not have it either, nor an empty text or list.
    Optional,
    /// Another one of these keys is there. The table has at least one of them.
    AnyOf(&'static [&'static str]),
    /// The same, where the table has no more than one of them.
    OneOf(&'static [&'static str]),
    /// This value.
    Otherwise(Fill),
    /// The keyword that goes with the one of another key of the table.
    Follows(&'static str, &'static [(&'static str, &'static str)]),
    /// The first keyword in a table that has this key, the second in one that has not.
    WithKey(&'static str, [&'static str; 2]),
    /// What the soil's priors say; without one this value, or else that something is missing.
    Prior(Option<f64>),
}

/// A value that stands for one that a document does not have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fill {
    Number(f64),
    Whole(u64),
    Flag(bool),
    Keyword(&'static str),
    /// A table with these keys, and what they imply.
    Keys(&'static [(&'static str, Fill)]),
}

/// The type of a key's value, and its domain field.
pub(crate) enum Shape<T: 'static> {
    /// Kind and version of a document.
    Tag,
    Text(Text<T>),
    Texts(Texts<T>),
    Flag(fn(&mut T, bool)),
    Whole(Whole<T>),
    /// One of some keywords.
    Words(&'static [Keyword<T>]),
    Number(Number, Reach<T>),
    Numbers(Numbers<T>),
    Pairs(Pairs<T>),
    /// Keys of another document.
    Keyed(Keyed),
    /// A table.
    Inner(&'static dyn Inner<T>),
    /// At least so many tables.
    List(&'static dyn Inner<T>, u64),
    /// Another document, or its name.
    Part(Kind, &'static dyn Inner<T>),
    /// A table, or a number that stands for the table with this key alone.
    NumberOr(&'static str, &'static dyn Inner<T>),
    /// A text that is what the sentence says and goes somewhere, or a table.
    TextOr(&'static str, fn(&mut T, &str), &'static dyn Inner<T>),
}

/// What stands under the keys of another document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Keyed {
    /// The least and the most that its number may be.
    Bounds,
    /// What it may be: numbers or names.
    Choices,
    /// The key of another number that it is as large as, with a minus before it where it is of the
    /// other sign.
    Tie,
}

/// Where a number goes; nowhere if the value follows another law.
pub(crate) type Reach<T> = fn(&mut T) -> Option<&mut f64>;

/// What a number may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub unit: Unit,
    pub least: f64,
    pub most: f64,
    /// Whether the lower end itself is excluded.
    pub is_open: bool,
    /// Whether it is a direction in degrees, of which whole turns do not count.
    pub is_direction: bool,
}

/// What a text may be.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Allowed {
    All,
    /// A format of JSON Schema, such as `date`.
    Format(&'static str),
    /// One of these, which mean what they say.
    Words(fn() -> Vec<&'static str>),
    /// What a regular expression fits, for editors; the reader checks it where it understands the
    /// text.
    Pattern(fn() -> String),
}

/// A text, at least so many characters long.
pub(crate) struct Text<T: 'static> {
    pub least: u64,
    pub allowed: Allowed,
    pub(crate) put: fn(&mut T, &str),
}

/// Texts, at least as many and at most as many, and where each goes by its place.
pub(crate) struct Texts<T: 'static> {
    pub least: u64,
    pub most: Option<u64>,
    pub allowed: Allowed,
    pub put: fn(&mut T, usize, &str),
}

/// A whole number.
pub(crate) struct Whole<T: 'static> {
    pub least: u64,
    pub most: u64,
    pub format: &'static str,
    pub(crate) put: fn(&mut T, u64),
}

/// A keyword of a closed set, and its effect on the domain's value.
pub(crate) struct Keyword<T: 'static> {
    pub name: &'static str,
    pub doc: &'static str,
    pub(crate) put: fn(&mut T),
}

/// A list of numbers.
pub(crate) struct Numbers<T: 'static> {
    pub number: Number,
    pub form: Form,
    /// Makes room for as many, or for one alone.
    pub(crate) begin: fn(&mut T, Option<usize>),
    pub(crate) reach: fn(&mut T, usize) -> Option<&mut f64>,
}

/// A list of pairs of numbers, each with its own unit.
pub(crate) struct Pairs<T: 'static> {
    pub numbers: [Number; 2],
    /// Makes room for as many.
    pub(crate) begin: fn(&mut T, usize),
    pub(crate) reach: fn(&mut T, usize) -> Option<[&mut f64; 2]>,
}

impl<T> Pairs<T> {
    /// What either number may be, for those who do not tell the two apart.
    pub(crate) fn range(&self) -> Number {
        let [one, other] = self.numbers;
        Number { least: one.least.min(other.least), most: one.most.max(other.most), ..one }
    }
}

/// How numbers are written.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    /// A list of as many.
    Exactly(u64),
    /// One alone, or a list: what either is.
    OneOrEach(&'static str, &'static str),
}

/// The keys of a document, or of a table in it, whatever the type of the domain's value.
pub trait Rows: Sync {
    /// Its JSON Schema.
    ///
    /// * `defs`: of the documents inside it, to be added to
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json;

    /// The same in the table's order, with all that it leaves out; of one that was checked.
    fn complete(&self, given: &Json) -> Json;

    /// Reads numbers in thousands of a unit, under the keys that say so, as numbers in the unit.
    /// One under both its keys stays, and is reported as unknown.
    fn read_thousands(&self, table: &mut Node);
}

/// Rows whose numbers go to a value of one type.
pub trait Inner<T>: Rows {
    /// Puts the values of a complete table into the domain's value.
    fn put(&self, value: &mut T, given: &Json);

    /// A number of the value under a dotted key, entries of lists by their place.
    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>>;
}

/// A number in a domain's value, in SI, and what documents may give it.
pub struct Reached<'t> {
    pub(crate) value: &'t mut f64,
    pub(crate) number: Number,
}

impl Reached<'_> {
    /// Gives it another value, in the document's unit.
    pub fn set(self, value: f64) {
        let value = if self.number.is_direction { less_whole_turns(value) } else { value };
        *self.value = self.number.unit.to_si(value);
    }

    /// What it may be, in the document's unit; both ends included, also where the lower one is not.
    pub fn range(&self) -> RangeInclusive<f64> {
        self.number.least..=self.number.most
    }
}

// ---- Rows ----

/// A number that must be there.
pub(crate) const fn number<T>(
    key: &'static str,
    unit: Unit,
    range: RangeInclusive<f64>,
    doc: &'static str,
    reach: Reach<T>,
) -> Field<T> {
    let number = Number {
        unit,
        least: *range.start(),
        most: *range.end(),
        is_open: false,
        is_direction: false,
    };
    field(key, doc, Shape::Number(number, reach))
}

/// A direction in degrees that must be there: any angle, of which whole turns do not count.
pub(crate) const fn direction<T>(
    key: &'static str,
    doc: &'static str,
    reach: Reach<T>,
) -> Field<T> {
    let (least, most) = (*DIRECTION_DEG.start(), *DIRECTION_DEG.end());
    let number = Number { unit: DEG, least, most, is_open: false, is_direction: true };
    field(key, doc, Shape::Number(number, reach))
}

/// A number above zero that must be there.
pub(crate) const fn positive<T>(
    key: &'static str,
    unit: Unit,
    most: f64,
    doc: &'static str,
    reach: Reach<T>,
) -> Field<T> {
    let number = Number { unit, least: 0.0, most, is_open: true, is_direction: false };
    field(key, doc, Shape::Number(number, reach))
}

/// A list of as many numbers as the domain has there.
pub(crate) const fn numbers<T>(
    key: &'static str,
    unit: Unit,
    range: RangeInclusive<f64>,
    form: Form,
    doc: &'static str,
    begin: fn(&mut T, Option<usize>),
    reach: fn(&mut T, usize) -> Option<&mut f64>,
) -> Field<T> {
    let number = Number {
        unit,
        least: *range.start(),
        most: *range.end(),
        is_open: false,
        is_direction: false,
    };
    field(key, doc, Shape::Numbers(Numbers { number, form, begin, reach }))
}

/// A list of pairs of numbers.
///
/// * `units`, `ranges`: of the first and the second of each pair
pub(crate) const fn pairs<T>(
    key: &'static str,
    units: [Unit; 2],
    ranges: &[RangeInclusive<f64>; 2],
    doc: &'static str,
    begin: fn(&mut T, usize),
    reach: fn(&mut T, usize) -> Option<[&mut f64; 2]>,
) -> Field<T> {
    let [unit, other_unit] = units;
    let (least, most) = (*ranges[0].start(), *ranges[0].end());
    let one = Number { unit, least, most, is_open: false, is_direction: false };
    let (least, most) = (*ranges[1].start(), *ranges[1].end());
    let other = Number { unit: other_unit, least, most, is_open: false, is_direction: false };
    field(key, doc, Shape::Pairs(Pairs { numbers: [one, other], begin, reach }))
}

/// A whole number.
pub(crate) const fn whole<T>(
    key: &'static str,
    range: RangeInclusive<u64>,
    format: &'static str,
    doc: &'static str,
    put: fn(&mut T, u64),
) -> Field<T> {
    let (least, most) = (*range.start(), *range.end());
    field(key, doc, Shape::Whole(Whole { least, most, format, put }))
}

/// A flag; false without the key.
pub(crate) const fn flag<T>(
    key: &'static str,
    doc: &'static str,
    put: fn(&mut T, bool),
) -> Field<T> {
    field(key, doc, Shape::Flag(put)).otherwise(Fill::Flag(false))
}

/// A text that must be there.
///
/// * `least`: its length
pub(crate) const fn text<T>(
    key: &'static str,
    least: u64,
    doc: &'static str,
    put: fn(&mut T, &str),
) -> Field<T> {
    field(key, doc, Shape::Text(Text { least, allowed: Allowed::All, put }))
}

/// A text that does not go into the domain's value.
pub(crate) const fn note<T>(key: &'static str, doc: &'static str) -> Field<T> {
    text(key, 0, doc, nothing_with)
}

/// A day, as text.
pub(crate) const fn day<T>(key: &'static str, doc: &'static str) -> Field<T> {
    let text = Text { least: 0, allowed: Allowed::Format("date"), put: nothing_with };
    field(key, doc, Shape::Text(text)).optional()
}

/// Some texts; none are left out.
pub(crate) const fn texts<T>(key: &'static str, doc: &'static str) -> Field<T> {
    let texts = Texts { least: 0, most: None, allowed: Allowed::All, put: |_, _, _| {} };
    field(key, doc, Shape::Texts(texts)).optional()
}

/// One of some keywords.
pub(crate) const fn words<T>(
    key: &'static str,
    doc: &'static str,
    words: &'static [Keyword<T>],
) -> Field<T> {
    field(key, doc, Shape::Words(words))
}

/// A keyword, and its effect on the domain's value.
pub(crate) const fn word<T>(name: &'static str, doc: &'static str, put: fn(&mut T)) -> Keyword<T> {
    Keyword { name, doc, put }
}

/// A table.
pub(crate) const fn table<T>(
    key: &'static str,
    doc: &'static str,
    inner: &'static dyn Inner<T>,
) -> Field<T> {
    field(key, doc, Shape::Inner(inner))
}

/// At least so many tables.
pub(crate) const fn list<T>(
    key: &'static str,
    doc: &'static str,
    each: &'static dyn Inner<T>,
    least: u64,
) -> Field<T> {
    field(key, doc, Shape::List(each, least))
}

/// Another document, or its name.
pub(crate) const fn part<T>(
    key: &'static str,
    kind: Kind,
    doc: &'static str,
    inner: &'static dyn Inner<T>,
) -> Field<T> {
    field(key, doc, Shape::Part(kind, inner))
}

/// The name of the document that one of its kind starts from; it is gone once that was read.
pub(crate) const fn preset<T>(doc: &'static str) -> Field<T> {
    note(PRESET, doc).optional()
}

/// The key of the document that one of its kind starts from.
pub(crate) const PRESET: &str = "preset";

pub(crate) const fn field<T>(key: &'static str, doc: &'static str, shape: Shape<T>) -> Field<T> {
    let presence = Presence::Needed;
    Field { key, in_thousands: None, doc, presence, only_with: None, shape }
}

/// For words that do not go into the domain's value.
pub(crate) fn nothing<T>(_: &mut T) {}

/// The same for a text.
fn nothing_with<T>(_: &mut T, _: &str) {}

impl<T> Field<T> {
    /// The same, that may be left out.
    pub(crate) const fn optional(mut self) -> Self {
        self.presence = Presence::Optional;
        self
    }

    /// The same, where a table has at least one of some keys.
    pub(crate) const fn any_of(mut self, keys: &'static [&'static str]) -> Self {
        self.presence = Presence::AnyOf(keys);
        self
    }

    /// The same, where a table has exactly one of some keys.
    pub(crate) const fn one_of(mut self, keys: &'static [&'static str]) -> Self {
        self.presence = Presence::OneOf(keys);
        self
    }

    /// The same, which means nothing without another key.
    pub(crate) const fn only_with(mut self, key: &'static str) -> Self {
        self.only_with = Some(key);
        self
    }

    /// The same, with a value for documents that leave it out.
    pub(crate) const fn otherwise(mut self, fill: Fill) -> Self {
        self.presence = Presence::Otherwise(fill);
        self
    }

    /// The same, with the keyword that goes with another key's for documents that leave it out.
    pub(crate) const fn following(
        mut self,
        key: &'static str,
        words: &'static [(&'static str, &'static str)],
    ) -> Self {
        self.presence = Presence::Follows(key, words);
        self
    }

    /// The same, with a keyword for documents that leave it out and have another key, and one for
    /// those that do not have that either.
    pub(crate) const fn with_key(
        mut self,
        key: &'static str,
        [with, without]: [&'static str; 2],
    ) -> Self {
        self.presence = Presence::WithKey(key, [with, without]);
        self
    }

    /// The same, which the soil's priors have a value for.
    pub(crate) const fn or_prior(mut self) -> Self {
        self.presence = Presence::Prior(None);
        self
    }

    /// The same, with a value where there is no prior.
    pub(crate) const fn or_prior_or(mut self, number: f64) -> Self {
        self.presence = Presence::Prior(Some(number));
        self
    }

    /// The same, whose number may stand under another key in thousands of its unit: newtons as kN.
    pub(crate) const fn or_in_thousands(mut self, key: &'static str) -> Self {
        self.in_thousands = Some(key);
        self
    }

    /// The same of a number.
    pub(crate) const fn or(self, number: f64) -> Self {
        self.otherwise(Fill::Number(number))
    }

    /// The same with what tables in it leave out.
    pub(crate) fn complete(&self, given: &Json) -> Json {
        let float = |given: &Json| given.as_f64().map_or(Json::Null, Json::from);
        match (&self.shape, given) {
            (Shape::Numbers(_), Json::Array(all)) => all.iter().map(float).collect(),
            (Shape::Pairs(_), Json::Array(all)) => {
                let pair = |pair: &Json| -> Json {
                    pair.as_array().into_iter().flatten().map(float).collect()
                };
                all.iter().map(pair).collect()
            }
            (Shape::Keyed(_), given) => keyed(given).map(|(key, all)| (key, all.clone())).collect(),
            (Shape::Number(..) | Shape::Numbers(_), given) => float(given),
            (Shape::List(each, _), Json::Array(all)) => {
                all.iter().map(|given| each.complete(given)).collect()
            }
            (Shape::NumberOr(key, inner), Json::Number(_)) => {
                inner.complete(&Json::from_iter([((*key).to_owned(), given.clone())]))
            }
            (
                Shape::Inner(inner)
                | Shape::Part(_, inner)
                | Shape::NumberOr(_, inner)
                | Shape::TextOr(_, _, inner),
                Json::Object(_),
            ) => inner.complete(given),
            _ => given.clone(),
        }
    }
}

/// What stands under the keys of another document, lists all of them; a table in it holds keys that
/// begin with its own.
pub(crate) fn keyed(given: &Json) -> impl Iterator<Item = (String, &Json)> {
    fn add<'g>(given: &'g Json, path: &str, found: &mut Vec<(String, &'g Json)>) {
        for (key, given) in given.as_object().into_iter().flatten() {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            if given.is_object() { add(given, &path, found) } else { found.push((path, given)) }
        }
    }
    let mut found = Vec::new();
    add(given, "", &mut found);
    found.into_iter()
}

impl Fill {
    pub(crate) fn to_json(self) -> Json {
        match self {
            Self::Number(number) => Json::from(number),
            Self::Whole(number) => Json::from(number),
            Self::Flag(flag) => Json::from(flag),
            Self::Keyword(word) => Json::from(word),
            Self::Keys(keys) => {
                keys.iter().map(|(key, fill)| ((*key).to_owned(), fill.to_json())).collect()
            }
        }
    }
}

impl<T> Table<T> {
    /// What a table that does not have a key means by that.
    pub(crate) fn implied(field: &Field<T>) -> Option<Json> {
        match field.presence {
            Presence::Otherwise(fill) => Some(field.complete(&fill.to_json())),
            Presence::Prior(Some(number)) => Some(Json::from(number)),
            Presence::Needed
            | Presence::Optional
            | Presence::AnyOf(_)
            | Presence::OneOf(_)
            | Presence::Follows(..)
            | Presence::WithKey(..)
            | Presence::Prior(None) => None,
        }
    }
}

// ---- Tables of one type in values of another ----

/// A table for a part of the value.
pub(crate) struct At<T: 'static, P: 'static> {
    pub inner: &'static dyn Inner<P>,
    pub at: fn(&mut T) -> &mut P,
}

/// A table for each entry of a list.
pub(crate) struct Each<T: 'static, P: 'static> {
    pub inner: &'static dyn Inner<P>,
    pub list: fn(&mut T) -> &mut Vec<P>,
    pub blank: fn() -> P,
}

/// A table that does not go into the value, but is read on its own.
pub(crate) struct Beside<P: 'static>(pub &'static dyn Inner<P>);

// ---- Laws ----

/// A table whose keys depend on a keyword in it.
pub(crate) struct Laws<T: 'static> {
    /// What it describes.
    pub doc: &'static str,
    /// The key of that keyword.
    pub key: &'static str,
    pub all: &'static [Law<T>],
    /// Whether a table without the keyword follows the first law.
    pub may_be_left_out: bool,
    /// Whether a resolved document has the keyword after the law's keys.
    pub is_written_last: bool,
}

/// One of several laws.
pub(crate) struct Law<T: 'static> {
    pub name: &'static str,
    /// Description of the keyword itself, where tables may leave it out.
    pub word: Option<&'static str>,
    /// Makes the value follow the law, with numbers that wait to be put in.
    pub choose: fn(&mut T),
    pub table: Table<T>,
}
