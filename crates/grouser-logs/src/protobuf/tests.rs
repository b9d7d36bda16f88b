//! What is encoded is decoded, by its own type and by the description that a log has of it.

use std::fmt::Debug;

use proptest::collection::vec;
use proptest::prelude::*;
use serde_json::Value;

use super::decode::Description;
use super::message::{FileDescriptorSet, Message, Types, messages, put_double};
use crate::foxglove::{
    Level, LinePrimitive, LineType, Log, ModelPrimitive, Point3, SceneEntity, SceneUpdate,
    Timestamp,
};

/// Messages in messages, at most, in these tests.
const DEPTH: u32 = 8;

messages! {
    /// A message with words.
    Mixed = "test.Mixed" {
        1 words: Vec<String>,
        2 is_said: bool,
        70000 number: Option<i32>,
    }
}

fn finite() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("NaN is not itself", |it| it.is_finite())
}

fn line() -> impl Strategy<Value = LinePrimitive> {
    let kind = prop_oneof![Just(LineType::Strip), Just(LineType::List)];
    let points = vec([finite(), finite(), finite()].prop_map(|[x, y, z]| Point3 { x, y, z }), 0..5);
    (kind, points, vec(any::<u32>(), 0..9), finite(), any::<bool>()).prop_map(
        |(r#type, points, indices, thickness, scale_invariant)| LinePrimitive {
            r#type,
            thickness,
            scale_invariant,
            points,
            indices,
            ..LinePrimitive::default()
        },
    )
}

fn scene() -> impl Strategy<Value = SceneUpdate> {
    let model = (vec(any::<u8>(), 0..20), any::<String>()).prop_map(|(data, url)| ModelPrimitive {
        url,
        data,
        ..ModelPrimitive::default()
    });
    let entity =
        (any::<String>(), vec(line(), 0..3), vec(model, 0..2)).prop_map(|(id, lines, models)| {
            SceneEntity { id, lines, models, ..SceneEntity::default() }
        });
    vec(entity, 0..3).prop_map(|entities| SceneUpdate { entities, ..SceneUpdate::default() })
}

fn log() -> impl Strategy<Value = Log> {
    let level = prop_oneof![Just(Level::Info), Just(Level::Warning), Just(Level::Error)];
    (any::<(i64, i32)>(), level, any::<[String; 2]>(), any::<u32>()).prop_map(
        |((seconds, nanos), level, [message, name], line)| Log {
            timestamp: Timestamp { seconds, nanos },
            level,
            message,
            name,
            line,
            ..Log::default()
        },
    )
}

fn words() -> impl Strategy<Value = Mixed> {
    (vec(any::<String>(), 0..4), any::<bool>(), any::<Option<i32>>())
        .prop_map(|(words, is_said, number)| Mixed { words, is_said, number })
}

/// A message is read as it was written; no part of its bytes is, nor is it where messages may not
/// lie so deep.
fn check<M: Message + PartialEq + Debug>(message: &M) {
    let bytes = message.to_bytes();
    assert_eq!(M::of_bytes(&bytes, DEPTH).as_ref(), Some(message));
    assert_eq!(M::of_bytes(&bytes, 0), None);
    for length in 0..bytes.len() {
        assert_ne!(M::of_bytes(&bytes[..length], DEPTH).as_ref(), Some(message));
    }
}

/// The description of a type is read as it was written, and a message by it.
fn decoded<M: Message>(message: &M) -> Value {
    let set = Types::of::<M>();
    assert_eq!(FileDescriptorSet::of_bytes(&set, DEPTH).expect("a set").to_bytes(), set);
    let description = Description::read(&set, M::NAME).expect("it is described");
    description.decode(&message.to_bytes()).expect("it is one")
}

proptest! {
    #[test]
    fn messages_are_read_as_they_were_written(scene in scene(), log in log(), words in words()) {
        check(&scene);
        check(&log);
        check(&words);
    }

    #[test]
    fn messages_are_read_by_their_descriptions(scene in scene(), log in log(), words in words()) {
        let tree = decoded(&log);
        prop_assert_eq!(&tree["timestamp"]["seconds"], &Value::from(log.timestamp.seconds));
        prop_assert_eq!(&tree["timestamp"]["nanos"], &Value::from(log.timestamp.nanos));
        prop_assert_eq!(&tree["message"], &Value::from(log.message));
        prop_assert_eq!(&tree["line"], &Value::from(log.line));
        let tree = decoded(&words);
        prop_assert_eq!(&tree["is_said"], &Value::from(words.is_said));
        prop_assert_eq!(&tree["number"], &Value::from(words.number.unwrap_or(0)));
        let tree = decoded(&scene);
        for (place, entity) in scene.entities.iter().enumerate() {
            for (line_place, line) in entity.lines.iter().enumerate() {
                let tree = &tree["entities"][place]["lines"][line_place];
                prop_assert_eq!(&tree["thickness"], &Value::from(line.thickness));
                if !line.indices.is_empty() {
                    prop_assert_eq!(&tree["indices"], &Value::from(line.indices.clone()));
                }
                for (point_place, point) in line.points.iter().enumerate() {
                    let z = &tree["points"][point_place]["z"];
                    prop_assert_eq!(z, &Value::from(point.z));
                }
            }
        }
    }

    #[test]
    fn numbers_of_types_that_are_made_at_run_time_are_read(numbers in vec(finite(), 1..30)) {
        let names: Vec<String> = (0..numbers.len()).map(|place| format!("x_{place}_m")).collect();
        let set = Types::of_numbers("test.Numbers", names.iter().map(String::as_str));
        let mut bytes = Vec::new();
        (1..).zip(&numbers).for_each(|(number, value)| put_double(*value, number, &mut bytes));
        let description = Description::read(&set, "test.Numbers").expect("it is described");
        let tree = description.decode(&bytes).expect("it is one");
        for (name, number) in names.iter().zip(&numbers) {
            prop_assert_eq!(&tree[name], &Value::from(*number));
        }
    }

    /// Damaged messages and descriptions are read as something, or not at all.
    #[test]
    fn any_bytes_are_read_to_some_end(
        log in log(),
        bytes in vec(any::<u8>(), 0..200),
        at in any::<prop::sample::Index>(),
        change in 1_u8..,
    ) {
        let set = Types::of::<Log>();
        let description = Description::read(&set, Log::NAME).expect("it is described");
        description.decode(&bytes);
        Description::read(&bytes, Log::NAME);
        let (mut message, mut damaged) = (log.to_bytes(), set);
        let (of_message, of_set) = (at.index(message.len()), at.index(damaged.len()));
        message[of_message] ^= change;
        damaged[of_set] ^= change;
        description.decode(&message);
        Log::of_bytes(&message, DEPTH);
        if let Some(description) = Description::read(&damaged, Log::NAME) {
            description.decode(&log.to_bytes());
        }
    }
}

/// Types that lie in each other deeper than any program's are refused, with no more of the stack
/// than they may have.
#[test]
fn types_in_types_are_read_to_a_depth() {
    let nested = |depth: u32| {
        let mut inner = vec![0x0a, 1, b'T'];
        for _ in 1..depth {
            let mut outer = vec![0x0a, 1, b'T'];
            super::wire::Encoded::Bytes(&inner).put(3, &mut outer);
            inner = outer;
        }
        let (mut file, mut set) = (Vec::new(), Vec::new());
        super::wire::Encoded::Bytes(&inner).put(4, &mut file);
        super::wire::Encoded::Bytes(&file).put(1, &mut set);
        Description::read(&set, "T").is_some()
    };
    assert!(nested(1) && nested(32));
    assert!(!nested(64) && !nested(10_000));
}
