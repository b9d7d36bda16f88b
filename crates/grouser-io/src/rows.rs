//! What tables do with a document: complete it, read numbers in thousands, put its numbers into the
//! domain's value, and reach a number of that under a key.

use serde_json::Value as Json;

use super::field::{
    At, Beside, Each, Field, Inner, Law, Laws, Numbers, Pairs, Presence, Reached, Rows, Shape,
    Table, Text, Texts, Whole,
};
use super::json_schema;
use super::tree::{Node, Value};

impl<T> Field<T> {
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
            (Shape::Pairs(Pairs { begin, .. }), Json::Array(all)) => {
                begin(value, all.len());
                for (place, pair) in all.iter().enumerate() {
                    for (which, given) in pair.as_array().into_iter().flatten().enumerate() {
                        self.set(value, &format!("{place}.{which}"), given);
                    }
                }
            }
            (
                Shape::Inner(inner)
                | Shape::List(inner, _)
                | Shape::Part(_, inner)
                | Shape::NumberOr(_, inner)
                | Shape::TextOr(_, _, inner),
                given,
            ) => inner.put(value, given),
            _ => {}
        }
    }

    /// Numbers in thousands inside what the key takes. Documents inside documents are read on their
    /// own.
    fn read_thousands(&self, node: &mut Node) {
        match (&self.shape, &mut node.value) {
            (Shape::Inner(inner) | Shape::TextOr(_, _, inner), Value::Table(_)) => {
                inner.read_thousands(node);
            }
            (Shape::List(inner, _), Value::List(nodes)) => {
                for node in nodes {
                    inner.read_thousands(node);
                }
            }
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
            Shape::Pairs(Pairs { numbers, reach, .. }) => {
                let (place, which) = path.split_once('.')?;
                let which: usize = which.parse().ok()?;
                let value = reach(value, place.parse().ok()?)?.into_iter().nth(which)?;
                Some(Reached { value, number: *numbers.get(which)? })
            }
            Shape::Inner(inner)
            | Shape::List(inner, _)
            | Shape::Part(_, inner)
            | Shape::NumberOr(_, inner) => inner.reach(value, path),
            _ => None,
        }
    }
}

impl<T> Table<T> {
    /// What a table that does not have a key means by another key.
    fn followed(&self, field: &Field<T>, given: &Json) -> Option<Json> {
        let (key, words) = match field.presence {
            Presence::Follows(key, words) => (key, words),
            Presence::WithKey(key, [with, without]) => {
                return Some(Json::from(if given.get(key).is_some() { with } else { without }));
            }
            _ => return None,
        };
        let leader = self.field(key)?;
        let word = given.get(key).cloned().or_else(|| Self::implied(leader))?;
        words.iter().find(|(of_leader, _)| word == *of_leader).map(|(_, word)| Json::from(*word))
    }

    /// The row of a key.
    fn field(&self, key: &str) -> Option<&Field<T>> {
        self.fields.iter().find(|field| field.key == key)
    }
}

impl<T> Rows for Table<T> {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        json_schema::of_table(self, None, defs)
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
                // What means nothing without another key is not filled in without it.
                None if field.only_with.is_some_and(|other| given.get(other).is_none()) => {
                    return None;
                }
                None => Self::implied(field).or_else(|| self.followed(field, given))?,
            };
            let is_left_out = matches!(field.presence, Presence::Optional) && is_empty(&given);
            (!is_left_out).then(|| (field.key.to_owned(), given))
        });
        keys.collect()
    }

    fn read_thousands(&self, table: &mut Node) {
        for field in self.fields {
            if let Some(key) = field.in_thousands
                && table.entry(field.key).is_none()
                && let Some(entry) = table.entry_mut(key)
            {
                match &mut entry.node.value {
                    Value::Float(number) => *number *= 1e3,
                    Value::Integer(number) => entry.node.value = Value::Float(*number as f64 * 1e3),
                    _ => {}
                }
                field.key.clone_into(&mut entry.key);
            }
            if let Some(entry) = table.entry_mut(field.key) {
                field.read_thousands(&mut entry.node);
            }
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

/// What allows the same keys as a table inside it.
trait Around: Sync {
    fn inner(&self) -> &dyn Rows;
}

impl<A: Around> Rows for A {
    fn schema(&self, defs: &mut serde_json::Map<String, Json>) -> Json {
        self.inner().schema(defs)
    }

    fn complete(&self, given: &Json) -> Json {
        self.inner().complete(given)
    }

    fn read_thousands(&self, table: &mut Node) {
        self.inner().read_thousands(table);
    }
}

impl<T, P> Around for At<T, P> {
    fn inner(&self) -> &dyn Rows {
        self.inner
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

impl<T, P> Around for Each<T, P> {
    fn inner(&self) -> &dyn Rows {
        self.inner
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

impl<P> Around for Beside<P> {
    fn inner(&self) -> &dyn Rows {
        self.0
    }
}

impl<T, P> Inner<T> for Beside<P> {
    fn put(&self, _: &mut T, _: &Json) {}

    fn reach<'t>(&self, _: &'t mut T, _: &str) -> Option<Reached<'t>> {
        None
    }
}

// ---- Laws ----

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
        json_schema::of_laws(self, defs)
    }

    fn complete(&self, given: &Json) -> Json {
        let law = self.named(given);
        let word = (self.key.to_owned(), Json::from(law.name));
        let Json::Object(mut keys) = law.table.complete(given) else { return Json::Null };
        keys.shift_insert(if self.is_written_last { keys.len() } else { 0 }, word.0, word.1);
        Json::Object(keys)
    }

    fn read_thousands(&self, table: &mut Node) {
        let word = table.entry(self.key).map(|entry| entry.node.to_json());
        self.by_word(word.as_ref()).table.read_thousands(table);
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
