//! Types of messages, as the text of a schema has them.
//!
//! The type's own fields come first; those of each type that it needs follow below a line `===`
//! and one `MSG: package/Type`.

use std::collections::HashMap;

/// A number, or a truth, by its size and what its bits mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Primitive {
    Bool,
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

/// What types of messages call them.
const NUMBERS: [(&str, Primitive); 13] = [
    ("bool", Primitive::Bool),
    ("byte", Primitive::U8),
    ("char", Primitive::U8),
    ("int8", Primitive::I8),
    ("uint8", Primitive::U8),
    ("int16", Primitive::I16),
    ("uint16", Primitive::U16),
    ("int32", Primitive::I32),
    ("uint32", Primitive::U32),
    ("int64", Primitive::I64),
    ("uint64", Primitive::U64),
    ("float32", Primitive::F32),
    ("float64", Primitive::F64),
];

/// Types that no schema needs to describe: those of ROS 1 without a package.
const BUILT_IN: [(&str, &str); 4] = [
    ("time", "uint32 sec\nuint32 nanosec"),
    ("duration", "int32 sec\nint32 nanosec"),
    ("builtin_interfaces/Time", "int32 sec\nuint32 nanosec"),
    ("builtin_interfaces/Duration", "int32 sec\nuint32 nanosec"),
];

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Holds {
    Primitive(Primitive),
    Text,
    /// A message, by the place of its type.
    Message(usize),
}

/// How many of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Count {
    One,
    /// As many as the type says.
    Fixed(usize),
    /// As many as the message says.
    Stated,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct RosField {
    pub(super) name: String,
    pub(super) holds: Holds,
    pub(super) count: Count,
}

/// Fields of a type, in the order of their bytes.
pub(super) type Fields = Vec<RosField>;

/// The fields of all types of a schema, the messages' own first; nothing for a text that is no
/// schema or has a type that is not known.
///
/// * `name`: of the messages' type, with its package
pub(super) fn read(text: &str, name: &str) -> Option<Vec<Fields>> {
    let mut written: Vec<(String, Vec<&str>)> = vec![(plain(name), Vec::new())];
    for line in text.lines().map(str::trim).filter(|line| !line.starts_with("===")) {
        if let Some(name) = line.strip_prefix("MSG:") {
            written.push((plain(name.trim()), Vec::new()));
        } else if let Some((_, lines)) = written.last_mut() {
            lines.push(line);
        }
    }
    let built_in = BUILT_IN.iter().map(|(name, text)| ((*name).to_owned(), text.lines().collect()));
    written.extend(built_in);
    let mut places = HashMap::new();
    for (place, (name, _)) in written.iter().enumerate() {
        places.entry(name.as_str()).or_insert(place);
    }
    let fields = |(name, lines): &(String, Vec<&str>)| {
        let package = name.rsplit_once('/').map_or("", |(package, _)| package);
        let place = |kind: &str| place_of(kind, package, &places);
        let declared = lines.iter().filter_map(|line| declaration(line));
        declared.map(|(kind, name)| field(kind, name, place)).collect()
    };
    written.iter().map(fields).collect()
}

/// Whether a schema has texts of wide characters, whose size is the compiler's.
pub(crate) fn has_wide_texts(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text);
    text.lines()
        .filter_map(|line| declaration(line.trim()))
        .any(|(kind, _)| kind.starts_with("wstring"))
}

/// The name of a type as fields of other packages have it.
fn plain(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}

/// The place of the type that a field of a package means.
fn place_of(kind: &str, package: &str, places: &HashMap<&str, usize>) -> Option<usize> {
    let kind = plain(kind);
    let of_package = places.get(format!("{package}/{kind}").as_str());
    // ROS 1 writes a header without its package.
    let is_header = kind == "Header";
    of_package
        .or_else(|| places.get(kind.as_str()))
        .or_else(|| places.get("std_msgs/Header").filter(|_| is_header))
        .copied()
}

/// The type and the name of a line's field; nothing for a comment or a constant.
fn declaration(line: &str) -> Option<(&str, &str)> {
    let line = line.split('#').next().unwrap_or_default();
    let mut words = line.split_whitespace();
    let (kind, name) = (words.next()?, words.next().unwrap_or_default());
    // What follows a field's name is its value where a message sets none.
    let is_constant = name.contains('=') || words.next().is_some_and(|it| it.starts_with('='));
    (!is_constant).then_some((kind, name))
}

/// The field of a declaration; nothing for one that is invalid or of a type that is not known.
///
/// * `kind`: such as `float64[<=3]`, `string<=10` or `geometry_msgs/Point[4]`
/// * `place`: that of a type of messages
fn field(kind: &str, name: &str, place: impl Fn(&str) -> Option<usize>) -> Option<RosField> {
    if name.is_empty() || !name.chars().all(|it| it.is_ascii_alphanumeric() || it == '_') {
        return None;
    }
    let (kind, count) = match kind.strip_suffix(']') {
        None => (kind, Count::One),
        Some(list) => {
            let (kind, count) = list.rsplit_once('[')?;
            let is_stated = count.is_empty() || count.starts_with("<=");
            let count = if is_stated { Count::Stated } else { Count::Fixed(count.parse().ok()?) };
            (kind, count)
        }
    };
    let number = NUMBERS.iter().find(|(name, _)| *name == kind);
    let holds = if let Some((_, number)) = number {
        Holds::Primitive(*number)
    } else if kind == "string" || kind.starts_with("string<=") {
        Holds::Text
    } else {
        Holds::Message(place(kind)?)
    };
    Some(RosField { name: name.to_owned(), holds, count })
}
