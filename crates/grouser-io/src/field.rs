//! The rows that declare the keys of documents: key, unit, range, description and domain field of a number are
//! declared in one row of a [`Table`] and nowhere else.
//!
//! Reading, checks, messages, JSON Schema, conversion to SI, `--set`, the keys of campaigns and
//! calibrations are made from these rows. The tables themselves are in [`describe`](super::describe).

use std::ops::RangeInclusive;

use serde_json::Value as Json;

use super::Kind;
use super::text::{Node, Value};
pub use super::unit::{
    DEG, KG, KG_M2, KG_M3, KPA, M, M_PER_RAD, M_PER_RAD2, M_S, M_S2, N, OF_KEY, ONE, S, Unit,
};

/// The keys of a document, or of a table in it, in the order in which they are written.
///
/// `T` is the domain's value that the numbers go to.
pub struct Table<T: 'static> {
    /// What it describes.
    pub doc: &'static str,
    pub fields: &'static [Field<T>],
}

/// A key.
pub struct Field<T: 'static> {
    pub key: &'static str,
    /// What documents of earlier versions call it.
    pub formerly: Option<&'static str>,
    /// What it is: a sentence; of a number without its unit and full stop.
    pub doc: &'static str,
    pub presence: Presence,
    pub shape: Shape<T>,
}

/// What a document that does not have a key means.
#[derive(Clone, Copy, Debug)]
pub enum Presence {
    /// That something is missing.
    Needed,
    /// Nothing; a resolved document does not have it either, nor an empty text or list.
    Optional,
    /// This value.
    Otherwise(Fill),
}

/// A value that stands for one that a document does not have.
#[derive(Clone, Copy, Debug)]
pub enum Fill {
    Number(f64),
    Whole(u64),
    Flag(bool),
    Keyword(&'static str),
    /// A table with these keys, and what they imply.
    Keys(&'static [(&'static str, Fill)]),
}

/// The type of a key's value, and its domain field.
pub enum Shape<T: 'static> {
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
    /// A table.
    Inner(&'static dyn Inner<T>),
    /// At least so many tables.
    List(&'static dyn Inner<T>, u64),
    /// Another document, or its name.
    Part(Kind, &'static dyn Inner<T>),
    /// A text that is what the sentence says and goes somewhere, or a table.
    TextOr(&'static str, fn(&mut T, &str), &'static dyn Inner<T>),
}

/// Where a number goes; nowhere if the value follows another law.
pub type Reach<T> = fn(&mut T) -> Option<&mut f64>;

/// What a number may be.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    pub unit: Unit,
    pub least: f64,
    pub most: f64,
    /// Whether the lower end itself is excluded.
    pub is_open: bool,
}

/// A text, at least so many characters long.
pub struct Text<T: 'static> {
    pub least: u64,
    pub format: Option<&'static str>,
    put: fn(&mut T, &str),
}

/// Texts, at least as many and at most as many, and where each goes by its place.
pub struct Texts<T: 'static> {
    pub least: u64,
    pub most: Option<u64>,
    pub put: fn(&mut T, usize, &str),
}

/// A whole number.
pub struct Whole<T: 'static> {
    pub least: u64,
    pub most: u64,
    pub format: &'static str,
    put: fn(&mut T, u64),
}

/// A keyword of a closed set, and its effect on the domain's value.
pub struct Keyword<T: 'static> {
    pub name: &'static str,
    /// What documents of earlier versions call it.
    pub formerly: Option<&'static str>,
    pub doc: &'static str,
    put: fn(&mut T),
}

/// A list of numbers.
pub struct Numbers<T: 'static> {
    pub number: Number,
    pub form: Form,
    /// Makes room for as many, or for one alone.
    begin: fn(&mut T, Option<usize>),
    reach: fn(&mut T, usize) -> Option<&mut f64>,
}

/// How numbers are written.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// A list of as many.
    Exactly(u64),
    /// One alone, or a list: what either is.
    OneOrEach(&'static str, &'static str),
}

/// Which names keys get.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// Those of this version.
    Today,
    /// Those of earlier versions, where they had others.
    Former,
}

/// The keys of a document, or of a table in it, whatever the type of the domain's value.
pub trait Rows: Sync {
    /// Its JSON Schema.
    ///
    /// * `defs`: of the documents inside it, to be added to
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json;

    /// The same in the table's order, with all that it leaves out; of one that was checked.
    fn complete(&self, given: &Json) -> Json;

    /// Changes keys and keywords of earlier versions to those of today, or keys of today to theirs.
    fn rename(&self, table: &mut Node, to: Names);

    /// The same of a dotted key, entries of lists by their place.
    ///
    /// * `table`: the document that the key leads into, which says the laws on the way
    fn rename_path(&self, path: &mut [String], table: Option<&Json>);
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
    value: &'t mut f64,
    number: Number,
}

impl Reached<'_> {
    /// Gives it another value, in the document's unit.
    pub fn set(self, value: f64) {
        *self.value = self.number.unit.to_si(value);
    }

    /// What it may be, in the document's unit; both ends included, also where the lower one is not.
    pub fn range(&self) -> RangeInclusive<f64> {
        self.number.least..=self.number.most
    }
}

// ---- Rows ----

/// A number that must be there.
pub const fn number<T>(
    key: &'static str,
    unit: Unit,
    range: RangeInclusive<f64>,
    doc: &'static str,
    reach: Reach<T>,
) -> Field<T> {
    let number = Number { unit, least: *range.start(), most: *range.end(), is_open: false };
    field(key, doc, Shape::Number(number, reach))
}

/// A number above zero that must be there.
pub const fn positive<T>(
    key: &'static str,
    unit: Unit,
    most: f64,
    doc: &'static str,
    reach: Reach<T>,
) -> Field<T> {
    let number = Number { unit, least: 0.0, most, is_open: true };
    field(key, doc, Shape::Number(number, reach))
}

/// A list of as many numbers as the domain has there.
pub const fn numbers<T>(
    key: &'static str,
    unit: Unit,
    range: RangeInclusive<f64>,
    form: Form,
    doc: &'static str,
    begin: fn(&mut T, Option<usize>),
    reach: fn(&mut T, usize) -> Option<&mut f64>,
) -> Field<T> {
    let number = Number { unit, least: *range.start(), most: *range.end(), is_open: false };
    field(key, doc, Shape::Numbers(Numbers { number, form, begin, reach }))
}

/// A whole number.
pub const fn whole<T>(
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
pub const fn flag<T>(key: &'static str, doc: &'static str, put: fn(&mut T, bool)) -> Field<T> {
    field(key, doc, Shape::Flag(put)).otherwise(Fill::Flag(false))
}

/// A text that must be there.
///
/// * `least`: its length
pub const fn text<T>(
    key: &'static str,
    least: u64,
    doc: &'static str,
    put: fn(&mut T, &str),
) -> Field<T> {
    field(key, doc, Shape::Text(Text { least, format: None, put }))
}

/// A text that does not go into the domain's value.
pub const fn note<T>(key: &'static str, doc: &'static str) -> Field<T> {
    text(key, 0, doc, nothing_with)
}

/// A day, as text.
pub const fn day<T>(key: &'static str, doc: &'static str) -> Field<T> {
    let text = Text { least: 0, format: Some("date"), put: nothing_with };
    field(key, doc, Shape::Text(text)).optional()
}

/// Some texts; none are left out.
pub const fn texts<T>(key: &'static str, doc: &'static str) -> Field<T> {
    field(key, doc, Shape::Texts(Texts { least: 0, most: None, put: |_, _, _| {} })).optional()
}

/// One of some keywords.
pub const fn words<T>(
    key: &'static str,
    doc: &'static str,
    words: &'static [Keyword<T>],
) -> Field<T> {
    field(key, doc, Shape::Words(words))
}

/// A keyword, and its effect on the domain's value.
pub const fn word<T>(name: &'static str, doc: &'static str, put: fn(&mut T)) -> Keyword<T> {
    Keyword { name, formerly: None, doc, put }
}

impl<T> Keyword<T> {
    /// The same, which had another name in earlier versions.
    pub const fn formerly(mut self, name: &'static str) -> Self {
        self.formerly = Some(name);
        self
    }
}

/// A table.
pub const fn table<T>(
    key: &'static str,
    doc: &'static str,
    inner: &'static dyn Inner<T>,
) -> Field<T> {
    field(key, doc, Shape::Inner(inner))
}

/// At least so many tables.
pub const fn list<T>(
    key: &'static str,
    doc: &'static str,
    each: &'static dyn Inner<T>,
    least: u64,
) -> Field<T> {
    field(key, doc, Shape::List(each, least))
}

/// Another document, or its name.
pub const fn part<T>(
    key: &'static str,
    kind: Kind,
    doc: &'static str,
    inner: &'static dyn Inner<T>,
) -> Field<T> {
    field(key, doc, Shape::Part(kind, inner))
}

pub const fn field<T>(key: &'static str, doc: &'static str, shape: Shape<T>) -> Field<T> {
    Field { key, formerly: None, doc, presence: Presence::Needed, shape }
}

/// For words that do not go into the domain's value.
pub fn nothing<T>(_: &mut T) {}

/// The same for a text.
fn nothing_with<T>(_: &mut T, _: &str) {}

impl<T> Field<T> {
    /// The same, that may be left out.
    pub const fn optional(mut self) -> Self {
        self.presence = Presence::Optional;
        self
    }

    /// The same, with a value for documents that leave it out.
    pub const fn otherwise(mut self, fill: Fill) -> Self {
        self.presence = Presence::Otherwise(fill);
        self
    }

    /// The same, which had another key in earlier versions.
    pub const fn formerly(mut self, key: &'static str) -> Self {
        self.formerly = Some(key);
        self
    }

    /// The same of a number.
    pub const fn or(self, number: f64) -> Self {
        self.otherwise(Fill::Number(number))
    }

    fn complete(&self, given: &Json) -> Json {
        let float = |given: &Json| given.as_f64().map_or(Json::Null, Json::from);
        match (&self.shape, given) {
            (Shape::Numbers(_), Json::Array(all)) => all.iter().map(float).collect(),
            (Shape::Number(..) | Shape::Numbers(_), given) => float(given),
            (Shape::List(each, _), Json::Array(all)) => {
                all.iter().map(|given| each.complete(given)).collect()
            }
            (
                Shape::Inner(inner) | Shape::Part(_, inner) | Shape::TextOr(_, _, inner),
                Json::Object(_),
            ) => inner.complete(given),
            _ => given.clone(),
        }
    }

    fn put(&self, value: &mut T, given: &Json) {
        match (&self.shape, given) {
            (Shape::Text(Text { put, .. }) | Shape::TextOr(_, put, _), Json::String(given)) => {
                put(value, given);
            }
            (Shape::Texts(Texts { put, .. }), Json::Array(all)) => {
                for (place, given) in all.iter().filter_map(Json::as_str).enumerate() {
                    put(value, place, given);
                }
            }
            (Shape::Flag(put), Json::Bool(given)) => put(value, *given),
            (Shape::Whole(Whole { put, .. }), given) => put(value, given.as_u64().unwrap_or(0)),
            (Shape::Words(words), Json::String(given)) => {
                if let Some(word) = words.iter().find(|word| word.name == given) {
                    (word.put)(value);
                }
            }
            (Shape::Number(..), given) => self.set(value, "", given),
            (Shape::Numbers(Numbers { begin, .. }), given) => {
                let Some(all) = given.as_array() else { return self.set(value, "", given) };
                begin(value, Some(all.len()));
                for (place, given) in all.iter().enumerate() {
                    self.set(value, &place.to_string(), given);
                }
            }
            (
                Shape::Inner(inner)
                | Shape::List(inner, _)
                | Shape::Part(_, inner)
                | Shape::TextOr(_, _, inner),
                given,
            ) => inner.put(value, given),
            _ => {}
        }
    }

    /// Former names inside what the key takes. Documents inside documents are renamed as they are read.
    fn rename(&self, node: &mut Node, to: Names) {
        match (&self.shape, &mut node.value) {
            (Shape::Words(words), Value::String(given)) if to == Names::Today => {
                if let Some(word) = words.iter().find(|word| word.formerly == Some(given)) {
                    word.name.clone_into(given);
                }
            }
            (Shape::Inner(inner) | Shape::TextOr(_, _, inner), Value::Table(_)) => {
                inner.rename(node, to);
            }
            (Shape::List(inner, _), Value::List(nodes)) => {
                for node in nodes {
                    inner.rename(node, to);
                }
            }
            _ => {}
        }
    }

    fn rename_path(&self, path: &mut [String], given: Option<&Json>) {
        match (&self.shape, path) {
            (Shape::Inner(inner) | Shape::Part(_, inner) | Shape::TextOr(_, _, inner), path) => {
                inner.rename_path(path, given);
            }
            // Entries of one list have one law, or no former names.
            (Shape::List(inner, _), [_, path @ ..]) => inner.rename_path(path, None),
            _ => {}
        }
    }

    fn set(&self, value: &mut T, path: &str, given: &Json) {
        if let (Some(reached), Some(given)) = (self.reach(value, path), given.as_f64()) {
            reached.set(given);
        }
    }

    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>> {
        match &self.shape {
            Shape::Number(number, reach) if path.is_empty() => {
                Some(Reached { value: reach(value)?, number: *number })
            }
            Shape::Numbers(Numbers { number, begin, reach, .. }) => {
                let place = if path.is_empty() { 0 } else { path.parse().ok()? };
                reach(value, place)?;
                if path.is_empty() {
                    // One number under the list's own key stands for all of them.
                    begin(value, None);
                }
                Some(Reached { value: reach(value, place)?, number: *number })
            }
            Shape::Inner(inner) | Shape::List(inner, _) | Shape::Part(_, inner) => {
                inner.reach(value, path)
            }
            _ => None,
        }
    }
}

impl Fill {
    pub fn to_json(self) -> Json {
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
    /// The row of a key, by its name of today or its former one.
    fn field(&self, key: &str) -> Option<&Field<T>> {
        let by_name = self.fields.iter().find(|field| field.key == key);
        by_name.or_else(|| self.fields.iter().find(|field| field.formerly == Some(key)))
    }

    /// What a table that does not have a key means by that.
    pub fn implied(field: &Field<T>) -> Option<Json> {
        match field.presence {
            Presence::Otherwise(fill) => Some(field.complete(&fill.to_json())),
            Presence::Needed | Presence::Optional => None,
        }
    }
}

impl<T> Rows for Table<T> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        super::schema::of_table(self, None, defs)
    }

    fn complete(&self, given: &Json) -> Json {
        let is_empty = |given: &Json| match given {
            Json::String(text) => text.is_empty(),
            Json::Array(all) => all.is_empty(),
            _ => false,
        };
        let keys = self.fields.iter().filter_map(|field| {
            let given = match given.get(field.key) {
                Some(given) => field.complete(given),
                None => Self::implied(field)?,
            };
            let is_left_out = matches!(field.presence, Presence::Optional) && is_empty(&given);
            (!is_left_out).then(|| (field.key.to_owned(), given))
        });
        keys.collect()
    }

    fn rename(&self, table: &mut Node, to: Names) {
        let named = |field: &Field<T>| match to {
            Names::Today => field.key,
            Names::Former => field.formerly.unwrap_or(field.key),
        };
        // A key under both its names stays unknown by the former one, and is reported so.
        let is_there = |field: &&Field<T>| table.entry(named(field)).is_some();
        let there: Vec<_> = self.fields.iter().filter(is_there).map(named).collect();
        let Value::Table(entries) = &mut table.value else { return };
        for entry in entries {
            let Some(field) = self.field(&entry.key) else { continue };
            let name = named(field);
            if entry.key == name || !there.contains(&name) {
                name.clone_into(&mut entry.key);
                field.rename(&mut entry.node, to);
            }
        }
    }

    fn rename_path(&self, path: &mut [String], table: Option<&Json>) {
        let Some((key, rest)) = path.split_first_mut() else { return };
        if let Some(field) = self.field(key) {
            field.key.clone_into(key);
            field.rename_path(rest, table.and_then(|table| table.get(field.key)));
        }
    }
}

impl<T> Inner<T> for Table<T> {
    fn put(&self, value: &mut T, given: &Json) {
        for field in self.fields {
            if let Some(given) = given.get(field.key) {
                field.put(value, given);
            }
        }
    }

    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>> {
        let (key, rest) = path.split_once('.').unwrap_or((path, ""));
        self.field(key)?.reach(value, rest)
    }
}

// ---- Tables of one type in values of another ----

/// A table for a part of the value.
pub struct At<T: 'static, P: 'static> {
    pub inner: &'static dyn Inner<P>,
    pub at: fn(&mut T) -> &mut P,
}

impl<T, P> Rows for At<T, P> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        self.inner.schema(defs)
    }

    fn complete(&self, given: &Json) -> Json {
        self.inner.complete(given)
    }

    fn rename(&self, table: &mut Node, to: Names) {
        self.inner.rename(table, to);
    }

    fn rename_path(&self, path: &mut [String], table: Option<&Json>) {
        self.inner.rename_path(path, table);
    }
}

impl<T, P> Inner<T> for At<T, P> {
    fn put(&self, value: &mut T, given: &Json) {
        self.inner.put((self.at)(value), given);
    }

    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>> {
        self.inner.reach((self.at)(value), path)
    }
}

/// A table for each entry of a list.
pub struct Each<T: 'static, P: 'static> {
    pub inner: &'static dyn Inner<P>,
    pub list: fn(&mut T) -> &mut Vec<P>,
    pub blank: fn() -> P,
}

impl<T, P> Rows for Each<T, P> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        self.inner.schema(defs)
    }

    fn complete(&self, given: &Json) -> Json {
        self.inner.complete(given)
    }

    fn rename(&self, table: &mut Node, to: Names) {
        self.inner.rename(table, to);
    }

    fn rename_path(&self, path: &mut [String], table: Option<&Json>) {
        self.inner.rename_path(path, table);
    }
}

impl<T, P> Inner<T> for Each<T, P> {
    fn put(&self, value: &mut T, given: &Json) {
        let all = given.as_array().into_iter().flatten().map(|given| {
            let mut entry = (self.blank)();
            self.inner.put(&mut entry, given);
            entry
        });
        *(self.list)(value) = all.collect();
    }

    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>> {
        let (place, rest) = path.split_once('.')?;
        self.inner.reach((self.list)(value).get_mut(place.parse::<usize>().ok()?)?, rest)
    }
}

/// A table that does not go into the value, but is read on its own.
pub struct Beside<P: 'static>(pub &'static dyn Inner<P>);

impl<P> Rows for Beside<P> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        self.0.schema(defs)
    }

    fn complete(&self, given: &Json) -> Json {
        self.0.complete(given)
    }

    fn rename(&self, table: &mut Node, to: Names) {
        self.0.rename(table, to);
    }

    fn rename_path(&self, path: &mut [String], table: Option<&Json>) {
        self.0.rename_path(path, table);
    }
}

impl<T, P> Inner<T> for Beside<P> {
    fn put(&self, _: &mut T, _: &Json) {}

    fn reach<'t>(&self, _: &'t mut T, _: &str) -> Option<Reached<'t>> {
        None
    }
}

// ---- Laws ----

/// A table whose keys depend on a keyword in it.
pub struct Laws<T: 'static> {
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
pub struct Law<T: 'static> {
    pub name: &'static str,
    /// Description of the keyword itself, where tables may leave it out.
    pub word: Option<&'static str>,
    /// Makes the value follow the law, with numbers that wait to be put in.
    pub choose: fn(&mut T),
    pub table: Table<T>,
}

impl<T> Laws<T> {
    fn named(&self, given: &Json) -> &'static Law<T> {
        self.by_word(given.get(self.key))
    }

    fn by_word(&self, word: Option<&Json>) -> &'static Law<T> {
        let name = word.and_then(Json::as_str);
        self.all.iter().find(|law| Some(law.name) == name).unwrap_or(&self.all[0])
    }
}

impl<T> Rows for Laws<T> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        super::schema::of_laws(self, defs)
    }

    fn complete(&self, given: &Json) -> Json {
        let law = self.named(given);
        let word = (self.key.to_owned(), Json::from(law.name));
        let Json::Object(mut keys) = law.table.complete(given) else { return Json::Null };
        keys.shift_insert(if self.is_written_last { keys.len() } else { 0 }, word.0, word.1);
        Json::Object(keys)
    }

    fn rename(&self, table: &mut Node, to: Names) {
        let word = table.entry(self.key).map(|entry| entry.node.to_json());
        self.by_word(word.as_ref()).table.rename(table, to);
    }

    fn rename_path(&self, path: &mut [String], table: Option<&Json>) {
        // Without the table nothing says which law it is, and laws may share a former name.
        let Some(table) = table else { return };
        self.named(table).table.rename_path(path, Some(table));
    }
}

impl<T> Inner<T> for Laws<T> {
    fn put(&self, value: &mut T, given: &Json) {
        let law = self.named(given);
        (law.choose)(value);
        law.table.put(value, given);
    }

    fn reach<'t>(&self, value: &'t mut T, path: &str) -> Option<Reached<'t>> {
        let mut tables = self.all.iter().map(|law| &law.table);
        let found = tables.find(|table| table.reach(value, path).is_some())?;
        found.reach(value, path)
    }
}
