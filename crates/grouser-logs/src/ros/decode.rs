//! Messages as trees of values.

use serde_json::{Map, Value};

use crate::protobuf::decode::float;
use crate::ros::types::{self, Count, Fields, Holds, Primitive, RosField};

/// Messages in messages, at most.
const DEEPEST: usize = 32;
/// Values of one message, at most; those that have no bytes count, too.
const MOST_VALUES: usize = 1 << 20;
/// Values without bytes that any message may have.
const EMPTY_VALUES: usize = 1000;
/// What may follow the last field of CDR: up to the largest alignment [bytes].
const PADDING: usize = 7;

/// How messages are encoded, and their types with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wire {
    /// ROS 1: least bytes first, one value after the other.
    First,
    /// ROS 2: CDR, whose numbers stand at multiples of their sizes.
    Cdr,
}

impl Wire {
    /// The encoding of a channel's messages, if its schema describes them as that wants it.
    pub(crate) fn of(messages: &str, schema: &str) -> Option<Self> {
        match (messages, schema) {
            ("ros1", "ros1msg") => Some(Self::First),
            ("cdr", "ros2msg") => Some(Self::Cdr),
            _ => None,
        }
    }
}

/// The kind of CDR that a message says it is in, if it is none that is read: as the header before
/// it has it. Source: "DDS-XTYPES" 1.3, table 60.
pub(crate) fn kind_not_read(message: &[u8]) -> Option<String> {
    let [0, kind, _, _, ..] = *message else { return None };
    let name = match kind {
        0 | 1 | 6 | 7 => return None,
        2 | 3 => "CDR with parameters (PL_CDR)",
        8 | 9 => "CDR with delimiters (D_CDR2)",
        10 | 11 => "CDR of the second version with parameters (PL_CDR2)",
        _ => return Some(format!("CDR of the unknown kind {kind}")),
    };
    Some(name.to_owned())
}

/// A type of messages with all that it needs.
#[derive(Clone, Debug)]
pub(crate) struct RosDescription {
    /// The messages' own type first.
    types: Vec<Fields>,
    wire: Wire,
}

impl RosDescription {
    /// Reads the text of a schema; nothing if it is none.
    ///
    /// * `name`: of the messages, with its package
    pub(crate) fn read(schema: &[u8], name: &str, wire: Wire) -> Option<Self> {
        Some(Self { types: types::read(str::from_utf8(schema).ok()?, name)?, wire })
    }

    pub(crate) fn is_cdr(&self) -> bool {
        self.wire == Wire::Cdr
    }

    /// Decodes a message as a tree; `None` if it is invalid.
    pub(crate) fn decode(&self, message: &[u8]) -> Option<Value> {
        let mut bytes = Bytes::of(message, self.wire)?;
        let tree = self.tree(0, &mut bytes, DEEPEST)?;
        let padding = if self.wire == Wire::Cdr { PADDING } else { 0 };
        (bytes.rest() <= padding).then_some(tree)
    }

    fn tree(&self, kind: usize, bytes: &mut Bytes<'_>, depth: usize) -> Option<Value> {
        let depth = depth.checked_sub(1)?;
        bytes.count_value()?;
        let fields = self.types.get(kind)?;
        if fields.is_empty() && self.wire == Wire::Cdr {
            // CDR knows no message without a member, and ROS 2 adds one.
            bytes.take::<1>()?;
        }
        let mut tree = Map::new();
        for field in fields {
            tree.insert(field.name.clone(), self.field(field, bytes, depth)?);
        }
        Some(Value::Object(tree))
    }

    fn field(&self, field: &RosField, bytes: &mut Bytes<'_>, depth: usize) -> Option<Value> {
        if field.count != Count::One && !matches!(field.holds, Holds::Primitive(_)) {
            bytes.skip_size_of_list()?;
        }
        let count = match field.count {
            Count::One => return self.value(field.holds, bytes, depth),
            Count::Fixed(count) => count,
            Count::Stated => bytes.count()?,
        };
        if field.holds == Holds::Primitive(Primitive::U8) {
            // No telemetry is in bytes: pictures are.
            return bytes.skip(count).map(|()| Value::Null);
        }
        // No memory is taken by a count that the message has no bytes for.
        let mut all = Vec::new();
        for _ in 0..count {
            all.push(self.value(field.holds, bytes, depth)?);
        }
        Some(Value::Array(all))
    }

    fn value(&self, holds: Holds, bytes: &mut Bytes<'_>, depth: usize) -> Option<Value> {
        match holds {
            Holds::Message(kind) => self.tree(kind, bytes, depth),
            Holds::Primitive(number) => bytes.number(number),
            Holds::Text => bytes.text(),
        }
    }
}

/// Bytes of a message on their way.
struct Bytes<'m> {
    /// Those behind the header.
    all: &'m [u8],
    at: usize,
    wire: Wire,
    is_big_endian: bool,
    /// Whether it is CDR of the second version.
    is_second: bool,
    /// Values that may follow.
    values: usize,
}

impl<'m> Bytes<'m> {
    fn of(message: &'m [u8], wire: Wire) -> Option<Self> {
        let (all, is_big_endian, is_second) = match (wire, message) {
            (Wire::First, all) => (all, false, false),
            (Wire::Cdr, [0, order @ (0 | 1), _, _, all @ ..]) => (all, *order == 0, false),
            (Wire::Cdr, [0, order @ (6 | 7), _, _, all @ ..]) => (all, *order == 6, true),
            (Wire::Cdr, _) => return None,
        };
        let values = MOST_VALUES.min(EMPTY_VALUES + DEEPEST * all.len());
        Some(Self { all, at: 0, wire, is_big_endian, is_second, values })
    }

    fn rest(&self) -> usize {
        self.all.len().saturating_sub(self.at)
    }

    fn count_value(&mut self) -> Option<()> {
        self.values = self.values.checked_sub(1)?;
        Some(())
    }

    /// The bytes of a number, the least first.
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        // The second version aligns nothing to more than four bytes.
        let alignment = if self.is_second { N.min(4) } else { N };
        let at = if self.wire == Wire::Cdr { self.at.next_multiple_of(alignment) } else { self.at };
        let mut bytes = *self.all.get(at..)?.first_chunk::<N>()?;
        self.at = at + N;
        if self.is_big_endian {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn skip(&mut self, count: usize) -> Option<()> {
        self.at = self.at.checked_add(count).filter(|at| *at <= self.all.len())?;
        Some(())
    }

    /// The bytes of a list of what is no number, which stand before it in the second version.
    fn skip_size_of_list(&mut self) -> Option<()> {
        if self.is_second { self.take::<4>().map(|_| ()) } else { Some(()) }
    }

    fn count(&mut self) -> Option<usize> {
        usize::try_from(u32::from_le_bytes(self.take()?)).ok()
    }

    fn number(&mut self, number: Primitive) -> Option<Value> {
        self.count_value()?;
        Some(match number {
            Primitive::Bool => (self.take::<1>()? != [0]).into(),
            Primitive::I8 => i8::from_le_bytes(self.take()?).into(),
            Primitive::U8 => u8::from_le_bytes(self.take()?).into(),
            Primitive::I16 => i16::from_le_bytes(self.take()?).into(),
            Primitive::U16 => u16::from_le_bytes(self.take()?).into(),
            Primitive::I32 => i32::from_le_bytes(self.take()?).into(),
            Primitive::U32 => u32::from_le_bytes(self.take()?).into(),
            Primitive::I64 => i64::from_le_bytes(self.take()?).into(),
            Primitive::U64 => u64::from_le_bytes(self.take()?).into(),
            Primitive::F32 => float(f64::from(f32::from_le_bytes(self.take()?))),
            Primitive::F64 => float(f64::from_le_bytes(self.take()?)),
        })
    }

    /// A text; that of CDR ends with a zero byte, which is counted.
    fn text(&mut self) -> Option<Value> {
        self.count_value()?;
        let count = self.count()?;
        let start = self.at;
        self.skip(count)?;
        let bytes = self.all.get(start..self.at)?;
        let is_ended = self.wire == Wire::Cdr;
        let bytes = bytes.strip_suffix(&[0]).filter(|_| is_ended).unwrap_or(bytes);
        Some(String::from_utf8_lossy(bytes).into_owned().into())
    }
}
