//! Messages of Protocol Buffers, by the descriptions that a log has of them, as trees of values.
//!
//! Source: "Protocol Buffers: Encoding" and `descriptor.proto`, developers.google.com/protocol-buffers.

use std::collections::HashMap;

use serde_json::{Map, Value};

/// Messages in messages, at most.
const DEEPEST: u32 = 32;

/// A field as it is encoded: its number, and its bytes.
enum Encoded<'a> {
    Number(u64),
    Four([u8; 4]),
    Eight([u8; 8]),
    Bytes(&'a [u8]),
}

/// Fields one after the other.
struct Encoding<'a>(&'a [u8]);

impl<'a> Encoding<'a> {
    fn varint(&mut self) -> Option<u64> {
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let (&byte, rest) = self.0.split_first()?;
            self.0 = rest;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Some(value);
            }
        }
        None
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*bytes)
    }

    /// The next field; nothing at the end.
    ///
    /// # Errors
    /// `()` for bytes that are no field.
    fn next(&mut self) -> Result<Option<(u64, Encoded<'a>)>, ()> {
        if self.0.is_empty() {
            return Ok(None);
        }
        let tag = self.varint().ok_or(())?;
        let encoded = match tag & 7 {
            0 => self.varint().map(Encoded::Number),
            1 => self.array().map(Encoded::Eight),
            2 => self.varint().and_then(|count| {
                let (bytes, rest) = self.0.split_at_checked(usize::try_from(count).ok()?)?;
                self.0 = rest;
                Some(Encoded::Bytes(bytes))
            }),
            5 => self.array().map(Encoded::Four),
            _ => None,
        };
        encoded.map(|encoded| Some((tag >> 3, encoded))).ok_or(())
    }
}

/// What a field holds; its codes are those of descriptions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Double,
    Float,
    Signed,
    Unsigned,
    ZigZag,
    Fixed32,
    Fixed64,
    SignedFixed32,
    SignedFixed64,
    Bool,
    Text,
    Bytes,
    Message,
}

impl Kind {
    fn of_code(code: u64) -> Option<Self> {
        Some(match code {
            1 => Self::Double,
            2 => Self::Float,
            3 | 5 | 14 => Self::Signed,
            4 | 13 => Self::Unsigned,
            6 => Self::Fixed64,
            7 => Self::Fixed32,
            8 => Self::Bool,
            9 => Self::Text,
            11 => Self::Message,
            12 => Self::Bytes,
            15 => Self::SignedFixed32,
            16 => Self::SignedFixed64,
            17 | 18 => Self::ZigZag,
            _ => return None,
        })
    }

    /// What a field is that a message leaves out, as the third edition has it.
    fn usual(self) -> Option<Value> {
        match self {
            Self::Double | Self::Float => Some(0.0.into()),
            Self::Bool => Some(false.into()),
            Self::Text => Some("".into()),
            Self::Bytes | Self::Message => None,
            _ => Some(0.into()),
        }
    }

    /// Takes numbers from the packed bytes of many.
    fn unpack(self, bytes: &[u8], into: &mut Vec<Value>) -> Option<()> {
        let mut rest = Encoding(bytes);
        while !rest.0.is_empty() {
            let encoded = match self {
                Self::Double | Self::Fixed64 | Self::SignedFixed64 => Encoded::Eight(rest.array()?),
                Self::Float | Self::Fixed32 | Self::SignedFixed32 => Encoded::Four(rest.array()?),
                _ => Encoded::Number(rest.varint()?),
            };
            into.push(self.number(&encoded)?);
        }
        Some(())
    }

    /// A number or a truth.
    fn number(self, encoded: &Encoded<'_>) -> Option<Value> {
        Some(match (self, encoded) {
            (Self::Double, Encoded::Eight(bytes)) => float(f64::from_le_bytes(*bytes)),
            (Self::Float, Encoded::Four(bytes)) => float(f64::from(f32::from_le_bytes(*bytes))),
            (Self::Signed, Encoded::Number(value)) => value.cast_signed().into(),
            (Self::Unsigned, Encoded::Number(value)) => (*value).into(),
            (Self::ZigZag, Encoded::Number(value)) => {
                ((value >> 1).cast_signed() ^ -(value & 1).cast_signed()).into()
            }
            (Self::Fixed32, Encoded::Four(bytes)) => u32::from_le_bytes(*bytes).into(),
            (Self::SignedFixed32, Encoded::Four(bytes)) => i32::from_le_bytes(*bytes).into(),
            (Self::Fixed64, Encoded::Eight(bytes)) => u64::from_le_bytes(*bytes).into(),
            (Self::SignedFixed64, Encoded::Eight(bytes)) => i64::from_le_bytes(*bytes).into(),
            (Self::Bool, Encoded::Number(value)) => (*value != 0).into(),
            _ => return None,
        })
    }
}

/// A number as a value: NaN is nothing, what is infinite is a word.
fn float(number: f64) -> Value {
    if number.is_nan() {
        return Value::Null;
    }
    serde_json::Number::from_f64(number)
        .map_or_else(|| Value::String(number.to_string()), Value::Number)
}

#[derive(Clone, Debug)]
struct Field {
    name: String,
    kind: Kind,
    is_repeated: bool,
    /// Whether it is left out where it has its usual value.
    is_implicit: bool,
    /// Of a message, its place among the types.
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

/// A type as its description has it, before names are places.
#[derive(Default)]
struct Raw {
    name: String,
    fields: Vec<(u64, Field, String)>,
}

impl Description {
    /// Reads a set of files of types; nothing if they do not describe the name.
    ///
    /// * `name`: of the messages, with its package
    pub(crate) fn read(set: &[u8], name: &str) -> Option<Self> {
        let mut raw = Vec::new();
        let mut files = Encoding(set);
        while let Some((number, encoded)) = files.next().ok()? {
            if let (1, Encoded::Bytes(file)) = (number, encoded) {
                read_file(file, &mut raw)?;
            }
        }
        let places: HashMap<String, usize> =
            raw.iter().enumerate().map(|(place, it)| (it.name.clone(), place)).collect();
        let types = raw.into_iter().map(|raw| {
            let with_place = |(number, mut field, holds): (u64, Field, String)| {
                field.holds = places.get(holds.trim_start_matches('.')).copied();
                (number, field)
            };
            Type { fields: raw.fields.into_iter().map(with_place).collect() }
        });
        let types = types.collect();
        let root = *places.get(name)?;
        Some(Self { types, root })
    }

    /// A message as a tree; nothing if it is none.
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
                match (&encoded, field.kind) {
                    (Encoded::Bytes(_), Kind::Text | Kind::Bytes | Kind::Message)
                    | (Encoded::Number(_) | Encoded::Four(_) | Encoded::Eight(_), _) => {
                        all.push(self.value(field, &encoded, depth)?);
                    }
                    (Encoded::Bytes(bytes), _) => field.kind.unpack(bytes, all)?,
                }
            } else {
                tree.insert(field.name.clone(), self.value(field, &encoded, depth)?);
            }
        }
        for field in kind.fields.values().filter(|field| field.is_implicit) {
            if let Some(usual) = field.kind.usual() {
                tree.entry(field.name.as_str()).or_insert(usual);
            }
        }
        Some(Value::Object(tree))
    }

    fn value(&self, field: &Field, encoded: &Encoded<'_>, depth: u32) -> Option<Value> {
        match (field.kind, encoded) {
            (Kind::Text, Encoded::Bytes(bytes)) => {
                Some(String::from_utf8_lossy(bytes).into_owned().into())
            }
            // No telemetry is in bytes: pictures are.
            (Kind::Bytes, Encoded::Bytes(_)) => Some(Value::Null),
            (Kind::Message, Encoded::Bytes(bytes)) => match field.holds {
                Some(kind) => self.tree(kind, bytes, depth),
                None => Some(Value::Null),
            },
            (kind, encoded) => kind.number(encoded),
        }
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Reads a file of types.
fn read_file(file: &[u8], into: &mut Vec<Raw>) -> Option<()> {
    let (mut package, mut syntax, mut messages) = (String::new(), String::new(), Vec::new());
    let mut fields = Encoding(file);
    while let Some((number, encoded)) = fields.next().ok()? {
        match (number, encoded) {
            (2, Encoded::Bytes(bytes)) => package = text(bytes),
            (4, Encoded::Bytes(bytes)) => messages.push(bytes),
            (12, Encoded::Bytes(bytes)) => syntax = text(bytes),
            _ => {}
        }
    }
    let is_third = syntax == "proto3";
    messages.into_iter().try_for_each(|it| read_type(it, &package, is_third, DEEPEST, into))
}

/// Reads a type, and those that are declared in it.
fn read_type(
    message: &[u8],
    within: &str,
    is_third: bool,
    depth: u32,
    into: &mut Vec<Raw>,
) -> Option<()> {
    let depth = depth.checked_sub(1)?;
    let (mut raw, mut inner) = (Raw::default(), Vec::new());
    let mut own = String::new();
    let mut fields = Encoding(message);
    while let Some((number, encoded)) = fields.next().ok()? {
        match (number, encoded) {
            (1, Encoded::Bytes(bytes)) => own = text(bytes),
            (2, Encoded::Bytes(bytes)) => raw.fields.extend(read_field(bytes, is_third)?),
            (3, Encoded::Bytes(bytes)) => inner.push(bytes),
            _ => {}
        }
    }
    raw.name = if within.is_empty() { own } else { format!("{within}.{own}") };
    let name = raw.name.clone();
    into.push(raw);
    inner.into_iter().try_for_each(|it| read_type(it, &name, is_third, depth, into))
}

/// A field with its number and the name of the type that it holds; a kind that is not known is left out.
fn read_field(field: &[u8], is_third: bool) -> Option<Vec<(u64, Field, String)>> {
    const REPEATED: u64 = 3;
    let (mut name, mut holds) = (String::new(), String::new());
    let (mut number, mut label, mut code, mut is_explicit) = (0, 0, 0, !is_third);
    let mut parts = Encoding(field);
    while let Some((part, encoded)) = parts.next().ok()? {
        match (part, encoded) {
            (1, Encoded::Bytes(bytes)) => name = text(bytes),
            (3, Encoded::Number(value)) => number = value,
            (4, Encoded::Number(value)) => label = value,
            (5, Encoded::Number(value)) => code = value,
            (6, Encoded::Bytes(bytes)) => holds = text(bytes),
            // Of one of several, or marked as optional: what is left out is not there.
            (9 | 17, Encoded::Number(_)) => is_explicit = true,
            _ => {}
        }
    }
    let is_repeated = label == REPEATED;
    let field = |kind| Field {
        name,
        kind,
        is_repeated,
        is_implicit: !is_repeated && !is_explicit,
        holds: None,
    };
    Some(Kind::of_code(code).map(|kind| (number, field(kind), holds)).into_iter().collect())
}
