//! The JSON Schema of a mapping, for editors: each key of the document and of a reading, with what it takes.
//!
//! The reader takes its keys from the two types `Document` and `ReadingDocument`; a test compares them with these.

use grouser_io::measurements::Dimension;
use grouser_io::measurements::telemetry::COLUMNS;
use serde_json::{Map, Value as Json, json};

use super::{LONGEST_S, Mapping, PoseColumn, SCHEMA, USUAL_WINDOW_S};
use crate::pose::Axes;

/// A key: its name, what it takes, what it is.
type Key = (&'static str, Json, &'static str);

impl Mapping {
    /// What the kind of document is called, in commands and in the name of its schema's file.
    pub const KIND: &str = "telemetry-mapping";

    /// The JSON Schema (draft 2020-12) of a mapping, as text.
    #[must_use]
    pub fn schema() -> String {
        let mut root = table(document(), &["schema", "name", "reading"]);
        root["title"] = SCHEMA.into();
        root["description"] =
            "Which topics and fields of a log of messages are which columns of telemetry.".into();
        root["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
        format!("{root:#}\n")
    }
}

fn document() -> Vec<Key> {
    let schema = json!({"oneOf": [
        {"type": "string", "const": SCHEMA, "description": "This version."}
    ]});
    let seconds = json!({"type": "number", "minimum": 0.0, "maximum": LONGEST_S});
    let mut window = seconds.clone();
    window["default"] = USUAL_WINDOW_S.into();
    let readings = json!({"type": "array", "minItems": 1, "items": reading()});
    vec![
        ("schema", schema, "Kind and version of this document."),
        ("name", text(), "What messages call it."),
        ("source", text(), "Where it is from."),
        (
            "window_s",
            window,
            "How much later than others of its time a message may come [s]; what comes later still is left out.",
        ),
        (
            "row_interval_s",
            seconds,
            "All readings within such an interval are one row [s]; without it those of one time. Excludes `row_topic`.",
        ),
        (
            "row_topic",
            text(),
            "A row ends at each message of this topic, with the newest readings since the last. Excludes `row_interval_s`.",
        ),
        (
            "time",
            text(),
            "The field with the time of a message; without it the time at which it was recorded counts.",
        ),
        ("reading", readings, "What is read of the messages of a topic."),
    ]
}

/// A reading: of a topic or a type of messages, and one of a number, an attitude, a pose and a transform.
fn reading() -> Json {
    let needs = |keys: &[&str]| json!({"required": keys});
    let mut reading = table(reading_keys(), &[]);
    reading["description"] = "What is read of the messages of a topic.".into();
    let sources = [needs(&["topic"]), needs(&["message"])];
    let kinds = [
        needs(&["field", "column"]),
        needs(&["attitude"]),
        needs(&["pose"]),
        needs(&["transform"]),
    ];
    reading["allOf"] = json!([{"anyOf": sources}, {"oneOf": kinds}]);
    reading
}

fn reading_keys() -> Vec<Key> {
    let frames = json!({"type": "array", "items": text(), "minItems": 2, "maxItems": 2});
    let pose_columns = one_of(PoseColumn::ALL.map(|(name, _)| name));
    let columns = json!({"type": "array", "items": pose_columns, "minItems": 1});
    let column = json!({"type": "string", "pattern": column_pattern()});
    let sign =
        json!({"type": "number", "enum": [1, -1], "minimum": -1, "maximum": 1, "default": 1});
    let flag = json!({"type": "boolean", "default": false});
    vec![
        (
            "topic",
            text(),
            "The topic: `*` stands for any letters, `{wheel}` for the name of each wheel.",
        ),
        (
            "message",
            text(),
            "The type of its messages, such as `sensor_msgs/Imu`, alone or with a topic.",
        ),
        (
            "time",
            text(),
            "The field with the time of a message, for this reading; without it that of the document.",
        ),
        (
            "field",
            text(),
            "The field with a number: names with dots between, `[2]` or `[name=front*]` for an element of a list.",
        ),
        (
            "attitude",
            text(),
            "The field with a quaternion (`x`, `y`, `z`, `w`), for `roll_deg` and `pitch_deg` or those of `columns`.",
        ),
        (
            "pose",
            text(),
            "The field with position and orientation, for `vo_dx_m`, `vo_dy_m` and `vo_dyaw_deg` or those of `columns`.",
        ),
        (
            "transform",
            frames,
            "A frame in another, `[\"odom\", \"base_link\"]`, for `roll_deg` and `pitch_deg` or those of `columns`.",
        ),
        (
            "column",
            column,
            "The column that a `field` is; of a wheel with `_{wheel}` or a wheel's name behind it.",
        ),
        ("columns", columns, "The columns that an `attitude`, a `pose` or a `transform` is for."),
        ("unit", one_of(units()), "The unit of a `field`, if it is not its column's."),
        (
            "scale",
            json!({"type": "number", "default": 1.0}),
            "A factor of a `field`, before its unit.",
        ),
        ("sign", sign, "1, or −1 where a `field` has the other sign."),
        (
            "offset",
            json!({"type": "number", "default": 0.0}),
            "What is added to a `field` at last, in its column's unit.",
        ),
        (
            "axes",
            one_of(Axes::ALL.map(|(name, _)| name)),
            "Axes of the body and the world; without it `grouser` for a `field`, `ros` for all others.",
        ),
        ("optional", flag, "Whether messages may lack the field, which no note then counts."),
    ]
}

fn text() -> Json {
    json!({"type": "string"})
}

fn one_of(words: impl IntoIterator<Item = &'static str>) -> Json {
    let words = words.into_iter().map(|word| json!({"type": "string", "const": word}));
    json!({"oneOf": words.collect::<Vec<_>>()})
}

fn table(keys: Vec<Key>, required: &[&str]) -> Json {
    let described = keys.into_iter().map(|(name, mut takes, what)| {
        takes["description"] = what.into();
        (name.to_owned(), takes)
    });
    let properties: Map<String, Json> = described.collect();
    let mut table =
        json!({"type": "object", "additionalProperties": false, "properties": properties});
    if !required.is_empty() {
        table["required"] = json!(required);
    }
    table
}

/// All columns of telemetry but the time, those of wheels with a name behind them.
fn column_pattern() -> String {
    let columns = COLUMNS.iter().skip(1);
    let (of_wheels, others): (Vec<_>, Vec<_>) = columns.partition(|column| column.is_of_wheel);
    let [of_wheels, others] =
        [of_wheels, others].map(|all| all.iter().map(|it| it.name).collect::<Vec<_>>().join("|"));
    format!("^({others}|({of_wheels})_.+)$")
}

/// Units of what columns of telemetry hold.
fn units() -> Vec<&'static str> {
    let dimensions = [
        Dimension::Length,
        Dimension::Angle,
        Dimension::AngularSpeed,
        Dimension::Moment,
        Dimension::Current,
    ];
    // No unit has no name: the answer is what there is.
    dimensions.iter().flat_map(|it| it.size_of("").err().unwrap_or_default()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schema() -> Json {
        serde_json::from_str(&Mapping::schema()).unwrap()
    }

    /// The keys that the reader knows, by its message about one that it does not.
    fn known(text: &str) -> Vec<String> {
        let message = Mapping::parse("m.toml", text).unwrap_err().to_string();
        let (_, list) = message.split_once("expected one of ").expect("a list");
        list.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    }

    fn keys(table: &Json) -> Vec<String> {
        table["properties"].as_object().unwrap().keys().cloned().collect()
    }

    #[test]
    fn the_keys_of_the_schema_are_those_of_the_reader() {
        let schema = schema();
        assert_eq!(keys(&schema), known("colour = 1"));
        assert_eq!(
            keys(&schema["properties"]["reading"]["items"]),
            known("[[reading]]\ncolour = 1")
        );
    }

    /// What is wrong with a value, by the words of the schema that are used here; patterns are left out.
    fn wrong(schema: &Json, value: &Json) -> Option<String> {
        let says = |part: &str| Some(format!("{part} of {schema}: {value}"));
        let is_type = match schema["type"].as_str() {
            Some("object") => value.is_object(),
            Some("array") => value.is_array(),
            Some("number") => value.is_number(),
            Some("boolean") => value.is_boolean(),
            Some("string") => value.is_string(),
            _ => true,
        };
        let has = |key: &Json| value.get(key.as_str().unwrap()).is_some();
        let fits = |one: &&Json| wrong(one, value).is_none();
        let list = |key: &str| schema[key].as_array();
        let count = |key: &str| list(key).map(|all| all.iter().filter(fits).count());
        let number = value.as_f64().unwrap_or(0.0);
        if !is_type {
            return says("type");
        }
        if schema.get("const").is_some_and(|it| it != value)
            || list("enum").is_some_and(|all| all.iter().all(|it| it.as_f64() != value.as_f64()))
        {
            return says("const");
        }
        if schema["minimum"].as_f64().is_some_and(|it| number < it)
            || schema["maximum"].as_f64().is_some_and(|it| number > it)
        {
            return says("range");
        }
        if !list("required").is_none_or(|all| all.iter().all(has)) {
            return says("required");
        }
        if count("oneOf").is_some_and(|it| it != 1)
            || count("anyOf").is_some_and(|it| it == 0)
            || count("allOf").is_some_and(|it| it != list("allOf").unwrap().len())
        {
            return says("choice");
        }
        if let (Some(keys), Some(table)) = (schema["properties"].as_object(), value.as_object()) {
            let of = |(key, value): (&String, &Json)| match keys.get(key) {
                Some(schema) => wrong(schema, value),
                None => says(key),
            };
            return table.iter().find_map(of);
        }
        let entries = value.as_array()?;
        let least = schema["minItems"].as_u64().unwrap_or(0);
        if (entries.len() as u64) < least
            || schema["maxItems"].as_u64().is_some_and(|most| entries.len() as u64 > most)
        {
            return says("length");
        }
        entries.iter().find_map(|entry| wrong(&schema["items"], entry))
    }

    fn json(text: &str) -> Json {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn mappings_that_are_built_in_and_those_of_the_guide_are_valid() {
        let guide = include_str!("../../../../docs/guide/telemetry.md");
        let examples: Vec<&str> = guide
            .split("```toml\n")
            .skip(1)
            .filter_map(|rest| rest.split_once("```").map(|(text, _)| text))
            .filter(|text| text.contains(SCHEMA))
            .collect();
        assert!(!examples.is_empty());
        let built_in = super::super::BUILT_IN.map(|(_, text)| text);
        for text in examples.into_iter().chain(built_in) {
            Mapping::parse("m.toml", text).unwrap();
            assert_eq!(wrong(&schema(), &json(text)), None);
        }
    }

    #[test]
    fn what_the_reader_refuses_is_not_valid() {
        for rest in [
            "reading = []",
            "window_s = -1.0\n[[reading]]\ntopic = \"a\"\npose = \"p\"",
            "[[reading]]\npose = \"p\"",
            "[[reading]]\ntopic = \"a\"\nfield = \"x\"",
            "[[reading]]\ntopic = \"a\"\npose = \"p\"\nattitude = \"q\"",
            "[[reading]]\ntopic = \"a\"\npose = \"p\"\naxes = \"enu\"",
            "[[reading]]\ntopic = \"a\"\npose = \"p\"\ncolumns = [\"sinkage_mm\"]",
            "[[reading]]\ntopic = \"a\"\ntransform = [\"odom\"]",
            "[[reading]]\ntopic = \"a\"\nfield = \"x\"\ncolumn = \"roll_deg\"\nsign = 2",
            "[[reading]]\ntopic = \"a\"\nfield = \"x\"\ncolumn = \"roll_deg\"\nunit = \"ell\"",
        ] {
            let text = format!("schema = \"{SCHEMA}\"\nname = \"test\"\n{rest}");
            assert!(Mapping::parse("m.toml", &text).is_err(), "{text}");
            assert!(wrong(&schema(), &json(&text)).is_some(), "{text}");
        }
    }
}
