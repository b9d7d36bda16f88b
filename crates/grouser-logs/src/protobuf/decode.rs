//! Messages of types that a log describes, as trees of values.

use std::collections::HashMap;

use serde_json::{Map, Value};

use crate::protobuf::message::{
    DescriptorProto, FieldDescriptorProto, FileDescriptorSet, Message as _, code,
};
use crate::protobuf::wire::{Encoded, Encoding};

/// Messages in messages, at most.
const DEEPEST: u32 = 32;

/// What a field of a kind is that a message leaves out, as the third edition has it.
fn usual(kind: i32) -> Option<Value> {
    match kind {
        code::DOUBLE | code::FLOAT => Some(0.0.into()),
        code::BOOL => Some(false.into()),
        code::STRING => Some("".into()),
        code::BYTES | code::MESSAGE => None,
        _ => Some(0.into()),
    }
}

/// Takes numbers of a kind from the packed bytes of many.
fn unpack(kind: i32, bytes: &[u8], into: &mut Vec<Value>) -> Option<()> {
    let mut rest = Encoding(bytes);
    while !rest.0.is_empty() {
        let encoded = match kind {
            code::DOUBLE | code::FIXED64 | code::SFIXED64 => Encoded::Eight(rest.array()?),
            code::FLOAT | code::FIXED32 | code::SFIXED32 => Encoded::Four(rest.array()?),
            _ => Encoded::Number(rest.varint()?),
        };
        into.push(number(kind, encoded)?);
    }
    Some(())
}

/// A number of a kind, or a truth.
fn number(kind: i32, encoded: Encoded<'_>) -> Option<Value> {
    use Encoded::{Eight, Four, Number};
    Some(match (kind, encoded) {
        (code::DOUBLE, Eight(bytes)) => float(f64::from_le_bytes(bytes)),
        (code::FLOAT, Four(bytes)) => float(f64::from(f32::from_le_bytes(bytes))),
        (code::INT64 | code::INT32 | code::ENUM, Number(value)) => value.cast_signed().into(),
        (code::UINT64 | code::UINT32, Number(value)) => value.into(),
        (code::SINT32 | code::SINT64, Number(value)) => {
            ((value >> 1).cast_signed() ^ -(value & 1).cast_signed()).into()
        }
        (code::FIXED32, Four(bytes)) => u32::from_le_bytes(bytes).into(),
        (code::SFIXED32, Four(bytes)) => i32::from_le_bytes(bytes).into(),
        (code::FIXED64, Eight(bytes)) => u64::from_le_bytes(bytes).into(),
        (code::SFIXED64, Eight(bytes)) => i64::from_le_bytes(bytes).into(),
        (code::BOOL, Number(value)) => (value != 0).into(),
        _ => return None,
    })
}

/// A number as a value: NaN is nothing, what is infinite is a word.
pub(crate) fn float(number: f64) -> Value {
    if number.is_nan() {
        return Value::Null;
    }
    serde_json::Number::from_f64(number)
        .map_or_else(|| Value::String(number.to_string()), Value::Number)
}

#[derive(Clone, Debug)]
struct Field {
    name: String,
    /// What it holds, by the code of descriptions.
    kind: i32,
    is_repeated: bool,
    /// Whether it is left out where it has its usual value.
    is_implicit: bool,
    /// Place of the message's type among the types, for a field that holds messages.
    holds: Option<usize>,
}

#[derive(Clone, Debug, Default)]
struct Type {
    fields: HashMap<u64, Field>,
}

/// A type of messages with all that it needs.
#[derive(Clone, Debug)]
pub(crate) struct Description {
    types: Vec<Type>,
    root: usize,
}

impl Description {
    /// Reads a set of files of types; nothing if they do not describe the name.
    ///
    /// * `name`: of the messages, with its package
    pub(crate) fn read(set: &[u8], name: &str) -> Option<Self> {
        // Below the types that lie in each other are the set, a file and a field.
        let set = FileDescriptorSet::of_bytes(set, DEEPEST + 3)?;
        let mut named = Vec::new();
        for file in &set.file {
            let is_third = file.syntax == "proto3";
            file.message_type.iter().for_each(|it| list(it, &file.package, is_third, &mut named));
        }
        let places = named.iter().enumerate().map(|(place, it)| (it.name.clone(), place)).collect();
        let root = *HashMap::get(&places, name)?;
        let types = named.iter().map(|it| {
            let fields = it.described.field.iter();
            let fields = fields.filter_map(|field| Field::of(field, it.is_third, &places));
            Type { fields: fields.collect() }
        });
        Some(Self { types: types.collect(), root })
    }

    /// Decodes a message as a tree; `None` if it is invalid.
    pub(crate) fn decode(&self, message: &[u8]) -> Option<Value> {
        self.tree(self.root, message, DEEPEST)
    }

    fn tree(&self, kind: usize, message: &[u8], depth: u32) -> Option<Value> {
        let depth = depth.checked_sub(1)?;
        let kind = self.types.get(kind)?;
        let mut tree = Map::new();
        let mut rest = Encoding(message);
        while let Some((number, encoded)) = rest.next().ok()? {
            let Some(field) = kind.fields.get(&number) else { continue };
            if field.is_repeated {
                let all = tree.entry(field.name.as_str()).or_insert_with(|| Value::Array(vec![]));
                let Value::Array(all) = all else { return None };
                match (encoded, field.kind) {
                    (Encoded::Bytes(_), code::STRING | code::BYTES | code::MESSAGE)
                    | (Encoded::Number(_) | Encoded::Four(_) | Encoded::Eight(_), _) => {
                        all.push(self.value(field, encoded, depth)?);
                    }
                    (Encoded::Bytes(bytes), _) => unpack(field.kind, bytes, all)?,
                }
            } else {
                tree.insert(field.name.clone(), self.value(field, encoded, depth)?);
            }
        }
        for field in kind.fields.values().filter(|field| field.is_implicit) {
            if let Some(usual) = usual(field.kind) {
                tree.entry(field.name.as_str()).or_insert(usual);
            }
        }
        Some(Value::Object(tree))
    }

    fn value(&self, field: &Field, encoded: Encoded<'_>, depth: u32) -> Option<Value> {
        match (field.kind, encoded) {
            (code::STRING, Encoded::Bytes(bytes)) => {
                Some(String::from_utf8_lossy(bytes).into_owned().into())
            }
            // No telemetry is in bytes: pictures are.
            (code::BYTES, Encoded::Bytes(_)) => Some(Value::Null),
            (code::MESSAGE, Encoded::Bytes(bytes)) => match field.holds {
                Some(kind) => self.tree(kind, bytes, depth),
                None => Some(Value::Null),
            },
            (kind, encoded) => number(kind, encoded),
        }
    }
}

/// A type by its name, with its package.
struct Named<'d> {
    name: String,
    described: &'d DescriptorProto,
    /// Whether it is of the third edition.
    is_third: bool,
}

/// Lists a type, and those that are declared in it.
fn list<'d>(
    described: &'d DescriptorProto,
    within: &str,
    is_third: bool,
    into: &mut Vec<Named<'d>>,
) {
    let own = &described.name;
    let name = if within.is_empty() { own.clone() } else { format!("{within}.{own}") };
    into.push(Named { name: name.clone(), described, is_third });
    described.nested_type.iter().for_each(|it| list(it, &name, is_third, into));
}

impl Field {
    /// A field with its number; nothing for a kind that is not known.
    fn of(
        described: &FieldDescriptorProto,
        is_third: bool,
        places: &HashMap<String, usize>,
    ) -> Option<(u64, Self)> {
        // Groups, which have no bytes of their own, are of the first edition.
        let is_known = (code::DOUBLE..=code::SINT64).contains(&described.code);
        if !is_known || described.code == code::GROUP {
            return None;
        }
        let is_repeated = described.label == code::REPEATED;
        // Of one of several, or marked as optional: what is left out is not there.
        let is_explicit = !is_third || described.proto3_optional || described.oneof_index.is_some();
        let field = Self {
            name: described.name.clone(),
            kind: described.code,
            is_repeated,
            is_implicit: !is_repeated && !is_explicit,
            holds: places.get(described.type_name.trim_start_matches('.')).copied(),
        };
        Some((u64::try_from(described.number).ok()?, field))
    }
}
