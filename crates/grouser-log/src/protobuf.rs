//! Messages in Protocol Buffers: a type is declared once, and its encoding and its description follow from that.
//!
//! Source: "Protocol Buffers: Encoding" and `descriptor.proto`, developers.google.com/protocol-buffers. Numbers
//! are always written, zeros too; empty texts, false and zero counts are left out, as the third edition asks.

/// A type of message.
pub(crate) trait Message: Default {
    /// With its package: `foxglove.Pose`.
    const NAME: &'static str;

    /// What it consists of.
    fn fields() -> Vec<FieldOf>;

    /// Writes its fields.
    fn put_fields(&self, out: &mut Vec<u8>);

    /// The message as bytes.
    fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        self.put_fields(&mut out);
        out
    }
}

/// What can be a field of a message.
pub(crate) trait Field {
    /// What a description says of it, without name and number.
    fn described() -> FieldOf;

    /// Writes it with its number.
    fn put(&self, number: u32, out: &mut Vec<u8>);
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

/// Codes of types in descriptions.
mod code {
    pub(super) const DOUBLE: i32 = 1;
    pub(super) const INT64: i32 = 3;
    pub(super) const INT32: i32 = 5;
    pub(super) const FIXED32: i32 = 7;
    pub(super) const BOOL: i32 = 8;
    pub(super) const STRING: i32 = 9;
    pub(super) const MESSAGE: i32 = 11;
    pub(super) const BYTES: i32 = 12;
    pub(super) const ENUM: i32 = 14;
    pub(super) const OPTIONAL: i32 = 1;
    pub(super) const REPEATED: i32 = 3;
}

/// How a field's bytes end.
mod wire {
    pub(super) const VARINT: u32 = 0;
    pub(super) const EIGHT_BYTES: u32 = 1;
    pub(super) const COUNTED: u32 = 2;
}

fn varint(mut value: u64, out: &mut Vec<u8>) {
    while value >= 0x80 {
        out.push(value.to_le_bytes()[0] | 0x80);
        value >>= 7;
    }
    out.push(value.to_le_bytes()[0]);
}

fn tag(number: u32, wire: u32, out: &mut Vec<u8>) {
    varint(u64::from(number << 3 | wire), out);
}

fn counted(number: u32, bytes: &[u8], out: &mut Vec<u8>) {
    tag(number, wire::COUNTED, out);
    varint(bytes.len() as u64, out);
    out.extend_from_slice(bytes);
}

/// Writes a number that is not a count.
pub(crate) fn put_double(value: f64, number: u32, out: &mut Vec<u8>) {
    tag(number, wire::EIGHT_BYTES, out);
    out.extend(value.to_le_bytes());
}

fn put_whole(value: i64, number: u32, out: &mut Vec<u8>) {
    if value != 0 {
        tag(number, wire::VARINT, out);
        varint(value.cast_unsigned(), out);
    }
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

/// A field that holds a keyword.
///
/// * `name`: of its type, inside the message's: `foxglove.Log.Level`
pub(crate) fn keyword(name: &str, values: &[&str]) -> FieldOf {
    let mut of = plain(code::ENUM);
    of.description.type_name = format!(".{name}");
    let value = |(number, name): (i32, &&str)| EnumValueDescriptorProto {
        name: (*name).to_owned(),
        number,
    };
    of.keywords = Some(EnumDescriptorProto {
        name: name.rsplit('.').next().unwrap_or_default().to_owned(),
        value: (0..).zip(values).map(value).collect(),
    });
    of
}

/// Writes the place of a keyword in its list.
pub(crate) fn put_keyword(place: i32, number: u32, out: &mut Vec<u8>) {
    put_whole(i64::from(place), number, out);
}

/// Writes a message as a field of another.
pub(crate) fn put_message<M: Message>(message: &M, number: u32, out: &mut Vec<u8>) {
    counted(number, &message.to_bytes(), out);
}

impl Field for f64 {
    fn described() -> FieldOf {
        plain(code::DOUBLE)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_double(*self, number, out);
    }
}

impl Field for i64 {
    fn described() -> FieldOf {
        plain(code::INT64)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_whole(*self, number, out);
    }
}

impl Field for i32 {
    fn described() -> FieldOf {
        plain(code::INT32)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_whole(i64::from(*self), number, out);
    }
}

impl Field for bool {
    fn described() -> FieldOf {
        plain(code::BOOL)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        put_whole(i64::from(*self), number, out);
    }
}

impl Field for String {
    fn described() -> FieldOf {
        plain(code::STRING)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            counted(number, self.as_bytes(), out);
        }
    }
}

impl Field for Vec<String> {
    fn described() -> FieldOf {
        repeated(plain(code::STRING))
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        for text in self {
            counted(number, text.as_bytes(), out);
        }
    }
}

impl Field for Vec<u8> {
    fn described() -> FieldOf {
        plain(code::BYTES)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            counted(number, self, out);
        }
    }
}

/// Whole numbers of four bytes each.
pub(crate) type Fixed32 = u32;

impl Field for Fixed32 {
    fn described() -> FieldOf {
        plain(code::FIXED32)
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        const FOUR_BYTES: u32 = 5;
        if *self != 0 {
            tag(number, FOUR_BYTES, out);
            out.extend(self.to_le_bytes());
        }
    }
}

impl Field for Vec<Fixed32> {
    fn described() -> FieldOf {
        repeated(plain(code::FIXED32))
    }

    fn put(&self, number: u32, out: &mut Vec<u8>) {
        if !self.is_empty() {
            let bytes: Vec<u8> = self.iter().flat_map(|value| value.to_le_bytes()).collect();
            counted(number, &bytes, out);
        }
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
        #[derive(Clone, Debug, Default)]
        pub(crate) struct $name {
            $(pub(crate) $field: $kind,)*
        }

        impl $crate::protobuf::Message for $name {
            const NAME: &'static str = $full;

            fn fields() -> Vec<$crate::protobuf::FieldOf> {
                vec![$($crate::protobuf::field::<$kind>(stringify!($field), $number),)*]
            }

            fn put_fields(&self, out: &mut Vec<u8>) {
                $($crate::protobuf::Field::put(&self.$field, $number, out);)*
            }
        }

        impl $crate::protobuf::Field for $name {
            fn described() -> $crate::protobuf::FieldOf {
                $crate::protobuf::one::<Self>()
            }

            fn put(&self, number: u32, out: &mut Vec<u8>) {
                $crate::protobuf::put_message(self, number, out);
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
        4 enum_type: Vec<EnumDescriptorProto>,
    }

    /// A field.
    FieldDescriptorProto = "google.protobuf.FieldDescriptorProto" {
        1 name: String,
        3 number: i32,
        4 label: i32,
        5 code: i32,
        6 type_name: String,
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

    /// The description of a type whose fields are known at run time only: numbers, one after the other.
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
