//! Types of messages: each is declared once, and how it is written, how it is read and its
//! description follow from that.
//!
//! Numbers are always written, zeros too; empty texts, false and zero counts are left out, as the
//! third edition asks.

use std::iter;

use crate::protobuf::wire::{Encoded, Encoding};

/// A type of message.
pub(crate) trait Message: Default {
    /// With its package: `foxglove.Pose`.
    const NAME: &'static str;

    /// What it consists of.
    fn fields() -> Vec<FieldOf>;

    /// Writes its fields.
    fn put_fields(&self, out: &mut Vec<u8>);

    /// Takes in a field; numbers that it does not have are passed over.
    ///
    /// * `depth`: how many messages in messages may follow
    fn take_field(&mut self, number: u64, encoded: Encoded<'_>, depth: u32) -> Option<()>;

    /// The message as bytes.
    fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        self.put_fields(&mut out);
        out
    }

    /// The message of some bytes; nothing where they are damaged, or messages in it lie deeper than
    /// `depth`.
    fn of_bytes(bytes: &[u8], depth: u32) -> Option<Self> {
        let depth = depth.checked_sub(1)?;
        let mut message = Self::default();
        let mut rest = Encoding(bytes);
        while let Some((number, encoded)) = rest.next().ok()? {
            message.take_field(number, encoded, depth)?;
        }
        Some(message)
    }
}

/// What can be a field of a message.
pub(crate) trait Field {
    /// What a description says of it, without name and number.
    fn described() -> FieldOf;

    /// Writes it with its number.
    fn put(&self, number: u32, out: &mut Vec<u8>);

    /// Takes in a value; one that is encoded as another type is passed over. Nothing where it is
    /// damaged.
    fn take(&mut self, encoded: Encoded<'_>, depth: u32) -> Option<()>;
}

/// A field of a type of message.
#[derive(Clone, Debug, Default)]
pub(crate) struct FieldOf {
    pub(crate) description: FieldDescriptorProto,
    /// Adds the type of the messages that it holds.
    pub(crate) holds: Option<fn(&mut Types)>,
    /// The type of its keywords, declared inside the message's.
    pub(crate) keywords: Option<EnumDescriptorProto>,
}

/// What a field holds, and whether it holds several, by the codes of descriptions.
pub(crate) mod code {
    pub(crate) const DOUBLE: i32 = 1;
    pub(crate) const FLOAT: i32 = 2;
    pub(crate) const INT64: i32 = 3;
    pub(crate) const UINT64: i32 = 4;
    pub(crate) const INT32: i32 = 5;
    pub(crate) const FIXED64: i32 = 6;
    pub(crate) const FIXED32: i32 = 7;
    pub(crate) const BOOL: i32 = 8;
    pub(crate) const STRING: i32 = 9;
    pub(crate) const GROUP: i32 = 10;
    pub(crate) const MESSAGE: i32 = 11;
    pub(crate) const BYTES: i32 = 12;
    pub(crate) const UINT32: i32 = 13;
    pub(crate) const ENUM: i32 = 14;
    pub(crate) const SFIXED32: i32 = 15;
    pub(crate) const SFIXED64: i32 = 16;
    pub(crate) const SINT32: i32 = 17;
    pub(crate) const SINT64: i32 = 18;
    pub(crate) const OPTIONAL: i32 = 1;
    pub(crate) const REPEATED: i32 = 3;
}

/// Writes a number that is not a count.
pub(crate) fn put_double(value: f64, number: u32, out: &mut Vec<u8>) {
    Encoded::Eight(value.to_le_bytes()).put(number, out);
}

/// A whole number, which is left out where it is 0.
fn whole(value: impl Into<i64>) -> Option<Encoded<'static>> {
    let value = value.into();
    (value != 0).then(|| Encoded::Number(value.cast_unsigned()))
}

/// Bytes, which are left out where there are none.
fn some(bytes: &[u8]) -> Option<Encoded<'_>> {
    (!bytes.is_empty()).then_some(Encoded::Bytes(bytes))
}

/// The 32 bits of a whole number that count.
#[expect(clippy::cast_possible_truncation)]
fn low(value: u64) -> i32 {
    value.cast_signed() as i32
}

fn plain(code: i32) -> FieldOf {
    let description =
        FieldDescriptorProto { label: code::OPTIONAL, code, ..FieldDescriptorProto::default() };
    FieldOf { description, ..FieldOf::default() }
}

fn repeated(mut of: FieldOf) -> FieldOf {
    of.description.label = code::REPEATED;
    of
}

/// A field that holds one message.
pub(crate) fn one<M: Message>() -> FieldOf {
    let mut of = plain(code::MESSAGE);
    of.description.type_name = format!(".{}", M::NAME);
    of.holds = Some(Types::add::<M>);
    of
}

/// Writes a message as a field of another.
pub(crate) fn put_message<M: Message>(message: &M, number: u32, out: &mut Vec<u8>) {
    Encoded::Bytes(&message.to_bytes()).put(number, out);
}

/// Whole numbers of four bytes each.
pub(crate) type Fixed32 = u32;

/// Types of fields of one value: the code, what is written where it is not left out, and what is
/// read.
macro_rules! scalars {
    ($($kind:ty: $code:ident, |$it:ident| $written:expr, $encoded:pat => $read:expr;)*) => {$(
        impl Field for $kind {
            fn described() -> FieldOf {
                plain(code::$code)
            }

            fn put(&self, number: u32, out: &mut Vec<u8>) {
                let $it = self;
                let written: Option<Encoded<'_>> = $written;
                if let Some(encoded) = written {
                    encoded.put(number, out);
                }
            }

            fn take(&mut self, encoded: Encoded<'_>, _: u32) -> Option<()> {
                if let $encoded = encoded {
                    *self = $read;
                }
                Some(())
            }
        }
    )*};
}

scalars! {
    f64: DOUBLE, |it| Some(Encoded::Eight(it.to_le_bytes())),
        Encoded::Eight(bytes) => Self::from_le_bytes(bytes);
    i64: INT64, |it| whole(*it), Encoded::Number(value) => value.cast_signed();
    i32: INT32, |it| whole(*it), Encoded::Number(value) => low(value);
    // A number that may not be there is written wherever it is.
    Option<i32>: INT32, |it| it.map(|it| Encoded::Number(i64::from(it).cast_unsigned())),
        Encoded::Number(value) => Some(low(value));
    Fixed32: FIXED32, |it| (*it != 0).then(|| Encoded::Four(it.to_le_bytes())),
        Encoded::Four(bytes) => Self::from_le_bytes(bytes);
    bool: BOOL, |it| whole(*it), Encoded::Number(value) => value != 0;
    String: STRING, |it| some(it.as_bytes()),
        Encoded::Bytes(bytes) => Self::from_utf8_lossy(bytes).into_owned();
    Vec<u8>: BYTES, |it| some(it), Encoded::Bytes(bytes) => bytes.to_vec();
}

impl Field for Vec<Fixed32> {
    fn described() -> FieldOf {
        repeated(plain(code::FIXED32))
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            let bytes: Vec<u8> = self.iter().flat_map(|value| value.to_le_bytes()).collect();
            Encoded::Bytes(&bytes).put(number, out);
        }
    }

    fn take(&mut self, encoded: Encoded<'_>, _: u32) -> Option<()> {
        if let Encoded::Bytes(bytes) = encoded {
            let mut rest = Encoding(bytes);
            self.extend(iter::from_fn(|| rest.array().map(Fixed32::from_le_bytes)));
        }
        Some(())
    }
}

impl Field for Vec<String> {
    fn described() -> FieldOf {
        repeated(plain(code::STRING))
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        for text in self {
            Encoded::Bytes(text.as_bytes()).put(number, out);
        }
    }

    fn take(&mut self, encoded: Encoded<'_>, depth: u32) -> Option<()> {
        let mut text = String::new();
        text.take(encoded, depth)?;
        self.push(text);
        Some(())
    }
}

impl<M: Message> Field for Vec<M> {
    fn described() -> FieldOf {
        repeated(one::<M>())
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        for message in self {
            put_message(message, number, out);
        }
    }

    fn take(&mut self, encoded: Encoded<'_>, depth: u32) -> Option<()> {
        if let Encoded::Bytes(bytes) = encoded {
            self.push(M::of_bytes(bytes, depth)?);
        }
        Some(())
    }
}

/// A closed set of words, of which a field holds one.
pub(crate) trait Keyword: Copy + Default + PartialEq + 'static {
    /// Name of its type, inside the message's: `foxglove.Log.Level`.
    const NAME: &'static str;
    /// All words of the type, in the order of their numbers.
    const WORDS: &'static [&'static str];
    /// Those that are used here, with their numbers.
    const ALL: &'static [(i32, Self)];
}

impl<K: Keyword> Field for K {
    fn described() -> FieldOf {
        let mut of = plain(code::ENUM);
        of.description.type_name = format!(".{}", K::NAME);
        let value = |(number, name): (i32, &&str)| EnumValueDescriptorProto {
            name: (*name).to_owned(),
            number,
        };
        of.keywords = Some(EnumDescriptorProto {
            name: K::NAME.rsplit('.').next().unwrap_or_default().to_owned(),
            value: (0..).zip(K::WORDS).map(value).collect(),
        });
        of
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        let known = K::ALL.iter().find(|(_, word)| word == self);
        known.map_or(0, |(number, _)| *number).put(number, out);
    }

    fn take(&mut self, encoded: Encoded<'_>, depth: u32) -> Option<()> {
        let mut number = 0;
        number.take(encoded, depth)?;
        if let Some((_, word)) = K::ALL.iter().find(|(known, _)| *known == number) {
            *self = *word;
        }
        Some(())
    }
}

/// A field by its name and number.
pub(crate) fn field<F: Field>(name: &str, number: i32) -> FieldOf {
    let mut of = F::described();
    // A name that Rust has a use for itself is written with a mark.
    name.trim_start_matches("r#").clone_into(&mut of.description.name);
    of.description.number = number;
    of
}

/// Declares types of messages: each field with its number, its name and its type.
macro_rules! messages {
    ($($(#[$doc:meta])* $name:ident = $full:literal { $($number:literal $field:ident: $kind:ty),* $(,)? })*) => {$(
        $(#[$doc])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub(crate) struct $name {
            $(pub(crate) $field: $kind,)*
        }

        impl $crate::protobuf::message::Message for $name {
            const NAME: &'static str = $full;

            fn fields() -> Vec<$crate::protobuf::message::FieldOf> {
                vec![$($crate::protobuf::message::field::<$kind>(stringify!($field), $number),)*]
            }

            fn put_fields(&self, out: &mut Vec<u8>) {
                $($crate::protobuf::message::Field::put(&self.$field, $number, out);)*
            }

            fn take_field(
                &mut self,
                number: u64,
                encoded: $crate::protobuf::wire::Encoded<'_>,
                depth: u32,
            ) -> Option<()> {
                match number {
                    $($number => $crate::protobuf::message::Field::take(
                        &mut self.$field, encoded, depth,
                    ),)*
                    _ => Some(()),
                }
            }
        }

        impl $crate::protobuf::message::Field for $name {
            fn described() -> $crate::protobuf::message::FieldOf {
                $crate::protobuf::message::one::<Self>()
            }

            fn put(&self, number: u32, out: &mut Vec<u8>) {
                $crate::protobuf::message::put_message(self, number, out);
            }

            fn take(
                &mut self,
                encoded: $crate::protobuf::wire::Encoded<'_>,
                depth: u32,
            ) -> Option<()> {
                if let $crate::protobuf::wire::Encoded::Bytes(bytes) = encoded {
                    *self = $crate::protobuf::message::Message::of_bytes(bytes, depth)?;
                }
                Some(())
            }
        }
    )*};
}
pub(crate) use messages;

messages! {
    /// Files of types, each after those that it needs.
    FileDescriptorSet = "google.protobuf.FileDescriptorSet" {
        1 file: Vec<FileDescriptorProto>,
    }

    /// A file of types.
    FileDescriptorProto = "google.protobuf.FileDescriptorProto" {
        1 name: String,
        2 package: String,
        3 dependency: Vec<String>,
        4 message_type: Vec<DescriptorProto>,
        12 syntax: String,
    }

    /// A type of messages.
    DescriptorProto = "google.protobuf.DescriptorProto" {
        1 name: String,
        2 field: Vec<FieldDescriptorProto>,
        3 nested_type: Vec<DescriptorProto>,
        4 enum_type: Vec<EnumDescriptorProto>,
    }

    /// A field.
    FieldDescriptorProto = "google.protobuf.FieldDescriptorProto" {
        1 name: String,
        3 number: i32,
        4 label: i32,
        5 code: i32,
        6 type_name: String,
        9 oneof_index: Option<i32>,
        17 proto3_optional: bool,
    }

    /// A type of keywords.
    EnumDescriptorProto = "google.protobuf.EnumDescriptorProto" {
        1 name: String,
        2 value: Vec<EnumValueDescriptorProto>,
    }

    /// A keyword.
    EnumValueDescriptorProto = "google.protobuf.EnumValueDescriptorProto" {
        1 name: String,
        2 number: i32,
    }
}

/// The types that a message needs, a file for each.
#[derive(Debug, Default)]
pub(crate) struct Types {
    set: FileDescriptorSet,
}

impl Types {
    /// The description of a type with all that it needs, as readers take it.
    pub(crate) fn of<M: Message>() -> Vec<u8> {
        let mut types = Self::default();
        types.add::<M>();
        types.set.to_bytes()
    }

    /// The description of a type whose fields are known at run time only: numbers, one after the
    /// other.
    ///
    /// * `name`: with its package
    pub(crate) fn of_numbers<'a>(name: &str, fields: impl Iterator<Item = &'a str>) -> Vec<u8> {
        let fields = (1..).zip(fields).map(|(number, name)| field::<f64>(name, number)).collect();
        let mut types = Self::default();
        types.put(name, fields);
        types.set.to_bytes()
    }

    fn add<M: Message>(&mut self) {
        let file = file_of(M::NAME);
        if self.set.file.iter().all(|known| known.name != file) {
            self.put(M::NAME, M::fields());
        }
    }

    fn put(&mut self, name: &str, fields: Vec<FieldOf>) {
        let mut file = FileDescriptorProto {
            name: file_of(name),
            syntax: "proto3".into(),
            ..FileDescriptorProto::default()
        };
        let (package, own) = name.rsplit_once('.').unwrap_or(("", name));
        package.clone_into(&mut file.package);
        let mut message = DescriptorProto { name: own.to_owned(), ..DescriptorProto::default() };
        for FieldOf { description, holds, keywords } in fields {
            if let Some(holds) = holds {
                holds(self);
                let needed = file_of(description.type_name.trim_start_matches('.'));
                if !file.dependency.contains(&needed) {
                    file.dependency.push(needed);
                }
            }
            message.enum_type.extend(keywords);
            message.field.push(description);
        }
        file.message_type.push(message);
        self.set.file.push(file);
    }
}

/// The file that declares a type, named as those are that everybody has.
fn file_of(name: &str) -> String {
    let path = name.replace('.', "/");
    let path = if path.starts_with("google/") { path.to_lowercase() } else { path };
    format!("{path}.proto")
}

#[cfg(test)]
mod tests {
    use super::*;

    messages! {
        /// The example of the encoding's own description: 150 in field 1.
        Test1 = "Test1" { 1 a: i32 }

        /// And a text in field 2.
        Test2 = "Test2" { 2 b: String }

        /// And a message in field 3.
        Test3 = "Test3" { 3 c: Test1 }
    }

    /// Source: "Protocol Buffers: Encoding", the examples `Test1`, `Test2` and `Test3`.
    #[test]
    fn the_examples_of_the_format_are_written_as_printed() {
        assert_eq!(Test1 { a: 150 }.to_bytes(), [0x08, 0x96, 0x01]);
        let text = [0x12, 0x07, b't', b'e', b's', b't', b'i', b'n', b'g'];
        assert_eq!(Test2 { b: "testing".into() }.to_bytes(), text);
        assert_eq!(Test3 { c: Test1 { a: 150 } }.to_bytes(), [0x1a, 0x03, 0x08, 0x96, 0x01]);
        // Below zero a whole number takes ten bytes.
        let below = Test1 { a: -2 }.to_bytes();
        assert_eq!(below[..2], [0x08, 0xfe]);
        assert_eq!(below.len(), 11);
    }

    #[test]
    fn a_type_comes_after_those_that_it_needs() {
        let mut types = Types::default();
        types.add::<Test3>();
        let names: Vec<&str> = types.set.file.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["Test1.proto", "Test3.proto"]);
        assert_eq!(types.set.file[1].dependency, ["Test1.proto"]);
    }
}
