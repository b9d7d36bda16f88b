//! `telemetry-mapping/1`: which topics and fields of a log of messages are which columns of
//! telemetry.

use std::ops::RangeInclusive;

use super::super::field::{
    Allowed, Each, Field, OF_KEY, ONE, RAD, S, Shape, Table, Text, Texts, field, flag, list, note,
    number, text, word, words,
};
use super::super::measurements::telemetry::Odometry;
use super::super::telemetry_mapping::given::{
    Axes, Given, GivenReading, PoseColumn, column_pattern, units,
};
use super::about::schema;

/// The longest window and interval [s].
const LONGEST: f64 = 3600.0;
/// Messages may be so much out of order, where the document does not say [s]. Source: ours, many
/// times the delay of a recorder's buffers.
const USUAL_WINDOW: f64 = 1.0;
/// The largest factor and offset. Source: ours, beyond any two units of one quantity.
const LARGEST: f64 = 1e15;

/// Ticks of a turn, and how far angles and ticks go before they begin again. Source: ours, from a
/// fraction of a turn to beyond what counters of 48 bits hold.
const WRAPS: RangeInclusive<f64> = 1e-3..=LARGEST;

/// One of which, or both, says whose messages are read.
const MESSAGES: &[&str] = &["topic", "message"];
/// One of which says what is read of them.
const WHAT: &[&str] = &["field", "attitude", "pose", "transform"];

/// A text that goes into the field of its key's name.
macro_rules! stated {
    ($type:ident.$field:ident, $doc:literal) => {
        text(stringify!($field), 1, $doc, |it: &mut $type, text| text.clone_into(&mut it.$field))
    };
}

pub(crate) static TELEMETRY_MAPPING: Table<Given> = Table {
    doc: "Which topics and fields of a log of messages are which columns of telemetry.",
    fields: &[
        schema("telemetry-mapping/1"),
        text("name", 0, "What messages call it.", |it: &mut Given, name| {
            name.clone_into(&mut it.name);
        }),
        note("source", "Where it is from.").optional(),
        number(
            "window_s",
            S,
            0.0..=LONGEST,
            "How much later than others of its time a message may come []; what comes later still \
             is left out",
            |it: &mut Given| Some(&mut it.window),
        )
        .or(USUAL_WINDOW),
        number(
            "row_interval_s",
            S,
            0.0..=LONGEST,
            "All readings within such an interval are one row []; without it those of one time. \
             Excludes `row_topic`",
            |it: &mut Given| Some(&mut it.row_interval),
        )
        .optional(),
        stated!(
            Given.row_topic,
            "A row ends at each message of this topic, with the newest readings since the last. \
             Excludes `row_interval_s`."
        )
        .optional(),
        stated!(
            Given.time,
            "The field with the time of a message; without it the time at which it was recorded \
             counts."
        )
        .optional(),
        ODOMETRY,
        list(
            "reading",
            "What is read of the messages of a topic.",
            &Each {
                inner: &READING,
                list: |it: &mut Given| &mut it.readings,
                blank: GivenReading::default,
            },
            1,
        ),
    ],
};

const ODOMETRY: Field<Given> = words(
    "odometry",
    "What measured the ways and rotations that the document reads; without it whoever reads a log \
     has to say it.",
    &[
        word(Odometry::ALL[0].0, Odometry::ALL[0].2, |it: &mut Given| {
            it.odometry = Some(Odometry::Visual);
        }),
        word(Odometry::ALL[1].0, Odometry::ALL[1].2, |it: &mut Given| {
            it.odometry = Some(Odometry::Wheels);
        }),
        word(Odometry::ALL[2].0, Odometry::ALL[2].2, |it: &mut Given| {
            it.odometry = Some(Odometry::Fused);
        }),
        word(Odometry::ALL[3].0, Odometry::ALL[3].2, |it: &mut Given| {
            it.odometry = Some(Odometry::MotionCapture);
        }),
    ],
)
.optional();

static READING: Table<GivenReading> = Table {
    doc: "What is read of the messages of a topic.",
    fields: &[
        stated!(
            GivenReading.topic,
            "The topic: `*` stands for any letters, `{wheel}` for the name of each wheel."
        )
        .any_of(MESSAGES),
        stated!(
            GivenReading.message,
            "The type of its messages, such as `sensor_msgs/Imu`, alone or with a topic."
        )
        .any_of(MESSAGES),
        stated!(
            GivenReading.time,
            "The field with the time of a message, for this reading; without it that of the \
             document."
        )
        .optional(),
        stated!(
            GivenReading.field,
            "The field with a number: names with dots between, `[2]` or `[name=front*]` for an \
             element of a list."
        )
        .one_of(WHAT)
        .only_with("column"),
        stated!(
            GivenReading.attitude,
            "The field with a quaternion (`x`, `y`, `z`, `w`), for `roll_deg` and `pitch_deg` or \
             those of `columns`."
        )
        .one_of(WHAT),
        stated!(
            GivenReading.pose,
            "The field with position and orientation, for `vo_dx_m`, `vo_dy_m` and `vo_dyaw_deg` \
             or those of `columns`."
        )
        .one_of(WHAT),
        stated!(
            GivenReading.orientation,
            "The field with the quaternion of a `pose` that is a position alone."
        )
        .optional()
        .only_with("pose"),
        TRANSFORM,
        COLUMN,
        COLUMNS,
        UNIT,
        number(
            "scale",
            ONE,
            -LARGEST..=LARGEST,
            "A factor of a `field`, before its unit",
            |it: &mut GivenReading| Some(&mut it.scale),
        )
        .or(1.0)
        .only_with("field"),
        number(
            "sign",
            ONE,
            -1.0..=1.0,
            "1, or −1 where a `field` has the other sign",
            |it: &mut GivenReading| Some(&mut it.sign),
        )
        .or(1.0)
        .only_with("field"),
        number(
            "offset",
            OF_KEY,
            -LARGEST..=LARGEST,
            "What is added to a `field` at last, in its column's unit",
            |it: &mut GivenReading| Some(&mut it.offset),
        )
        .or(0.0)
        .only_with("field"),
        flag(
            "position",
            "Whether a `field` is the angle of a wheel, in radians or its `unit`: the speed of the \
             `column` is how far it turned over time.",
            |it: &mut GivenReading, yes| it.is_position = yes,
        )
        .only_with("field"),
        number(
            "wrap_rad",
            RAD,
            WRAPS,
            "After how much a `position` begins again [], such as 6.2832",
            |it: &mut GivenReading| Some(&mut it.wrap),
        )
        .optional()
        .only_with("position"),
        number(
            "ticks_per_turn",
            ONE,
            WRAPS,
            "Ticks of an encoder over one turn of the wheel, where a `position` counts them",
            |it: &mut GivenReading| Some(&mut it.ticks_per_turn),
        )
        .optional()
        .only_with("position"),
        number(
            "wrap_ticks",
            ONE,
            WRAPS,
            "After how many ticks they begin again, such as 65536",
            |it: &mut GivenReading| Some(&mut it.wrap_ticks),
        )
        .optional()
        .only_with("ticks_per_turn"),
        AXES,
        flag(
            "optional",
            "Whether messages may lack the field, which no note then counts.",
            |it: &mut GivenReading, yes| it.is_optional = yes,
        ),
    ],
};

const TRANSFORM: Field<GivenReading> = field(
    "transform",
    "A frame in another, `[\"odom\", \"base_link\"]`, for `roll_deg` and `pitch_deg` or those of \
     `columns`.",
    Shape::Texts(Texts {
        least: 2,
        most: Some(2),
        allowed: Allowed::All,
        put: |it: &mut GivenReading, place, frame| {
            if let Some(place) = it.transform.get_mut(place) {
                frame.clone_into(place);
            }
        },
    }),
)
.one_of(WHAT);

const COLUMN: Field<GivenReading> = field(
    "column",
    "The column that a `field` is; of a wheel with `_{wheel}` or a wheel's name behind it.",
    Shape::Text(Text {
        least: 1,
        allowed: Allowed::Pattern(column_pattern),
        put: |it: &mut GivenReading, column| column.clone_into(&mut it.column),
    }),
)
.optional()
.only_with("field");

const COLUMNS: Field<GivenReading> = field(
    "columns",
    "The columns that an `attitude`, a `pose` or a `transform` is for.",
    Shape::Texts(Texts {
        least: 1,
        most: None,
        allowed: Allowed::Words(|| PoseColumn::ALL.map(|(name, _)| name).to_vec()),
        put: |it: &mut GivenReading, _, column| it.columns.push(column.to_owned()),
    }),
)
.optional();

const UNIT: Field<GivenReading> = field(
    "unit",
    "The unit of a `field`, if it is not its column's.",
    Shape::Text(Text {
        least: 0,
        allowed: Allowed::Words(units),
        put: |it: &mut GivenReading, unit| unit.clone_into(&mut it.unit),
    }),
)
.optional()
.only_with("field");

const AXES: Field<GivenReading> = words(
    "axes",
    "Axes of the body and the world; without it `grouser` for a `field`, `ros` for all others.",
    &[
        word(
            "ros",
            "x forward, y left, z up, in a frame whose z is up.",
            |it: &mut GivenReading| {
                it.axes = Some(Axes::Ros);
            },
        ),
        word(
            "ned",
            "x forward, y right, z down, in a frame whose z is down.",
            |it: &mut GivenReading| {
                it.axes = Some(Axes::Ned);
            },
        ),
        word("grouser", "As `ros`, with pitch positive nose up.", |it: &mut GivenReading| {
            it.axes = Some(Axes::Grouser);
        }),
    ],
)
.optional();
