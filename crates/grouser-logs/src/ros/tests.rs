//! Messages that are encoded here by hand, and bytes that are no messages.

use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::{Value, json};

use super::decode::{RosDescription, Wire, kind_not_read};
use super::types::has_wide_texts;

/// A state of joints as ROS 2 describes it, with what else a type may have.
const SCHEMA: &str = "\
# What stands behind a mark is a comment.
int32 MOST=5  # a constant
string MARK = \"a # in a text\"
std_msgs/Header header
bool is_on
string[] name
float64[<=8] position   # at most eight
float32[2] pair
uint8[] picture
string<=12 word \"as usual\"
Turn turn
Turn[] turns
int64 last 7
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
================================================================================
MSG: ours/Turn\r
\tint16 count\r
\tfloat64 angle\r
================================================================================
MSG: ours/Unused
";

/// Writes a message: numbers stand at multiples of their sizes, behind a header.
struct Cdr {
    bytes: Vec<u8>,
    is_big_endian: bool,
    /// Whether it is CDR of the second version.
    is_second: bool,
}

impl Cdr {
    fn put(&mut self, mut number: Vec<u8>) {
        let alignment = if self.is_second { number.len().min(4) } else { number.len() };
        while !(self.bytes.len() - 4).is_multiple_of(alignment) {
            self.bytes.push(0xee);
        }
        if self.is_big_endian {
            number.reverse();
        }
        self.bytes.extend(number);
    }

    fn put_count(&mut self, count: u32) {
        self.put(count.to_le_bytes().to_vec());
    }

    /// The size of a list of what is no number, which the second version has before it [bytes].
    fn put_size(&mut self, size: u32) {
        if self.is_second {
            self.put_count(size);
        }
    }

    fn put_double(&mut self, number: f64) {
        self.put(number.to_le_bytes().to_vec());
    }

    fn put_text(&mut self, text: &str) {
        self.put_count(u32::try_from(text.len() + 1).unwrap());
        self.bytes.extend(text.as_bytes());
        self.bytes.push(0);
    }

    fn put_turn(&mut self, (count, angle): (i16, f64)) {
        self.put(count.to_le_bytes().to_vec());
        self.put_double(angle);
    }
}

fn message(is_big_endian: bool) -> Vec<u8> {
    message_of(is_big_endian, false)
}

fn message_of(is_big_endian: bool, is_second: bool) -> Vec<u8> {
    let kind = if is_second { 6 } else { 0 };
    let header = vec![0, kind + u8::from(!is_big_endian), 0, 0];
    let mut out = Cdr { bytes: header, is_big_endian, is_second };
    out.put((-3_i32).to_le_bytes().to_vec());
    out.put_count(500);
    out.put_text("odom");
    out.put(vec![1]);
    out.put_size(26);
    out.put_count(2);
    for name in ["left", "right"] {
        out.put_text(name);
    }
    out.put_count(3);
    for number in [0.5, f64::NAN, -1e300] {
        out.put_double(number);
    }
    for number in [0.25_f32, -2.0] {
        out.put(number.to_le_bytes().to_vec());
    }
    out.put_count(3);
    out.bytes.extend([1, 2, 3]);
    out.put_text("");
    out.put_turn((-7, 1.5));
    out.put_size(16);
    out.put_count(1);
    out.put_turn((8, 2.5));
    out.put(i64::MIN.to_le_bytes().to_vec());
    out.bytes
}

fn tree() -> Value {
    json!({
        "header": {"stamp": {"sec": -3, "nanosec": 500}, "frame_id": "odom"},
        "is_on": true,
        "name": ["left", "right"],
        "position": [0.5, null, -1e300],
        "pair": [0.25, -2.0],
        "picture": null,
        "word": "",
        "turn": {"count": -7, "angle": 1.5},
        "turns": [{"count": 8, "angle": 2.5}],
        "last": i64::MIN,
    })
}

fn described(schema: &str, wire: Wire) -> Option<RosDescription> {
    RosDescription::read(schema.as_bytes(), "ours/msg/State", wire)
}

#[test]
fn a_message_of_either_byte_order_is_its_tree() {
    let description = described(SCHEMA, Wire::Cdr).unwrap();
    for is_big_endian in [false, true] {
        let bytes = message(is_big_endian);
        assert_eq!(description.decode(&bytes), Some(tree()));
        // Writers fill up to a multiple of a size; more than that is of another type.
        assert_eq!(description.decode(&[&bytes[..], &[0; 7]].concat()), Some(tree()));
        assert_eq!(description.decode(&[&bytes[..], &[0; 8]].concat()), None);
    }
    // The second version of CDR aligns otherwise.
    let mut second = message(false);
    second[1] = 7;
    assert_eq!(description.decode(&second), None);
    for is_big_endian in [false, true] {
        assert_eq!(description.decode(&message_of(is_big_endian, true)), Some(tree()));
    }
}

/// Other kinds of CDR are named, so that a log of them is not taken for a damaged one.
#[test]
fn kinds_of_cdr_that_are_not_read_are_named() {
    let kind = |kind: u8| kind_not_read(&[0, kind, 0, 0, 1]);
    assert!([0, 1, 6, 7].into_iter().all(|it| kind(it).is_none()));
    assert!(kind(3).is_some_and(|it| it.contains("PL_CDR")));
    assert!(kind(9).is_some_and(|it| it.contains("D_CDR2")));
    assert_eq!(kind_not_read(&[1, 1, 0, 0]), None, "no header");
    assert!(has_wide_texts(b"float64 a\nwstring<=4 b  # wide"));
    assert!(!has_wide_texts(b"string a # no wstring b"));
}

#[test]
fn a_message_of_ros_1_has_no_gaps() {
    let schema = "Header header\nbool is_on\ntime[] times\nduration[1] left\n===\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
    let description = described(schema, Wire::First).unwrap();
    let numbers = |all: &[u32]| all.iter().flat_map(|it| it.to_le_bytes()).collect::<Vec<u8>>();
    let start = [&numbers(&[1, 2_000_000_000, 3, 4])[..], b"odom", &[1]].concat();
    let bytes = [start, numbers(&[1, 5, 6, u32::MAX, 7])].concat();
    let expected = json!({
        "header": {"seq": 1, "stamp": {"sec": 2_000_000_000_u32, "nanosec": 3}, "frame_id": "odom"},
        "is_on": true,
        "times": [{"sec": 5, "nanosec": 6}],
        "left": [{"sec": -1, "nanosec": 7}],
    });
    assert_eq!(description.decode(&bytes), Some(expected));
    assert_eq!(description.decode(&[&bytes[..], &[0]].concat()), None);
}

#[test]
fn what_is_no_schema_is_refused() {
    for lines in [
        "float64",
        "float64 a-b",
        "float64[x] a",
        "float64] a",
        "float64[-1] a",
        "wstring a",
        "ours/Nothing a",
        "Turn a\n===\nMSG: others/Turn\nfloat64 angle",
    ] {
        assert!(described(lines, Wire::Cdr).is_none(), "{lines}");
    }
    assert!(RosDescription::read(b"float64 \xff", "ours/State", Wire::Cdr).is_none());
    assert_eq!(Wire::of("cdr", "ros2idl"), None);
}

/// A message that is cut anywhere is none.
#[test]
fn a_message_that_is_cut_is_none() {
    let description = described(SCHEMA, Wire::Cdr).unwrap();
    let bytes = message(false);
    for length in 0..bytes.len() {
        assert_eq!(description.decode(&bytes[..length]), None, "{length}");
    }
}

/// Counts that a message has no bytes for, and types that hold themselves or nothing a thousand
/// times a thousand times, end soon.
#[test]
fn no_work_is_done_for_what_is_not_there() {
    let endless = |lines: &str, bytes: &[u8]| {
        for wire in [Wire::Cdr, Wire::First] {
            assert_eq!(described(lines, wire).unwrap().decode(bytes), None, "{lines}");
        }
    };
    let most = [0, 1, 0, 0, 255, 255, 255, 255, 255, 255, 255, 255];
    endless("float64[] a", &most);
    endless("string a", &most);
    endless("uint8[] a", &most);
    endless("uint8[18446744073709551615] a", &most);
    endless("ours/State a", &most);
    endless("ours/State[] a", &most);
    let nested = (0..20).map(|it| {
        let next = it + 1;
        format!("===\nMSG: ours/N{it}\nN{next}[1000] a\n")
    });
    let nested = format!("N0 a\n{}===\nMSG: ours/N20\n", nested.collect::<String>());
    endless(&nested, &[0, 1, 0, 0]);
}

proptest! {
    /// What was damaged or invented is decoded or refused.
    #[test]
    fn damage_is_no_panic(
        flips in vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        bytes in vec(any::<u8>(), 0..200),
        lines in vec("(float64|string|int8|ours/State|Turn)(\\[(<=)?[0-9]{0,20}\\])? [a-c =#]{1,4}", 0..6),
    ) {
        let mut damaged = message(false);
        for (place, byte) in flips {
            let place = place.index(damaged.len());
            damaged[place] = byte;
        }
        let description = described(SCHEMA, Wire::Cdr).unwrap();
        // Whatever it holds has its bytes in the message.
        let size = |tree: &Value| tree["name"].as_array().unwrap().len();
        prop_assert!(description.decode(&damaged).is_none_or(|it| size(&it) <= damaged.len()));
        for wire in [Wire::Cdr, Wire::First] {
            if let Some(other) = described(&lines.join("\n"), wire) {
                prop_assert!(other.decode(&bytes).is_none_or(|it| it.is_object()));
            }
        }
    }
}
