//! `mission/1`: legs that a rover drives one after the other, and limits at which it stops.

use super::super::field::{
    At, DEG, Each, Field, Fill, Form, Law, Laws, M, M_S, ONE, S, Shape, Table, direction, field,
    flag, list, note, number, numbers, positive, table, text, whole, word, words,
};
use super::super::mission::{
    Alternative, Arc, Held, LEGS_FROM, LegKeys, LegLaw, Plan, STOP_FROM, Waypoint, limited_quantity,
};
use super::about::{assumed, notes, purpose, schema, source};
use super::differences::{LARGEST_SEED, room};
use super::run::{OfScenario, Run};
use super::scenario::{self, FASTEST, PAPERS_SLIP, USUAL_LIMIT};
use super::terrain::FARTHEST;
use grouser_core::mission::{Limited, Measure, Sensors, Steering, Stop, Then};
use grouser_core::simulation::Scenario;
use grouser_core::simulation::scenario::LONGEST_DURATION;

/// The most that a sinkage may be limited to [mm]. Source: ours; no wheel is as high.
const DEEPEST_MM: f64 = 2000.0;
/// The longest way [m]. Source: ours; no rover has driven further in its life.
const LONGEST_WAY: f64 = 1e5;
/// The most that a turn may be [°]: ten turns.
const LARGEST_TURN: f64 = 3600.0;

impl OfScenario for Plan {
    fn scenario(&mut self) -> &mut Scenario {
        &mut self.scenario
    }
}

/// A mission before its numbers are put in.
pub(crate) fn blank() -> Plan {
    // How long it lasts is for the legs to say.
    let scenario = Scenario { duration: 1.0, ..scenario::blank() };
    Plan { scenario, legs: Vec::new(), alternatives: Vec::new(), stops: Vec::new(), sensors: None }
}

pub(crate) static MISSION: Table<Plan> = Table {
    doc: "Legs that a rover drives one after the other over a plane of soil, or over ground with \
          heights, and limits at which it stops.",
    fields: &[
        schema("mission/1"),
        purpose(),
        source().optional(),
        notes(),
        assumed(),
        Run::ROVER,
        Run::SOIL,
        Run::MODEL,
        Run::GRAVITY,
        Run::SLOPE,
        Run::TERRAIN,
        Run::SAMPLE_INTERVAL,
        Run::LOAD_TRANSFER,
        Run::WHEEL_MOMENTS,
        Run::SIMULATION,
        Run::BY_WHEEL,
        Run::SCATTER,
        Run::RUTS,
        Run::START,
        table(
            "stop",
            "Limits at which the rover stops in every leg that has none of its own for the same \
             number.",
            &At { inner: &STOPS, at: |plan: &mut Plan| &mut plan.stops },
        )
        .otherwise(Fill::Keys(&[])),
        note(
            STOP_FROM,
            "A file with a table [stop], whose limits hold in every leg: those of the document \
             stand in place of the file's for the same numbers.",
        )
        .optional(),
        table(
            "sensors",
            "What the rover knows of where it is; without the table it knows all.",
            &At { inner: &SENSORS, at: |plan: &mut Plan| plan.sensors.get_or_insert(EXACT) },
        )
        .optional(),
        note(
            LEGS_FROM,
            "A file with legs, which come before those of the document: CSV with keys of a leg in \
             its first line, or GeoJSON with places in metres.",
        )
        .optional(),
        list(
            "leg",
            "What the rover does, leg after leg.",
            &Each { inner: &LEG, list: |plan: &mut Plan| &mut plan.legs, blank: LegKeys::default },
            0,
        )
        .optional(),
        list(
            "alternative",
            "In place of legs: several ways from the same start, to be compared.",
            &Each {
                inner: &ALTERNATIVE,
                list: |plan: &mut Plan| &mut plan.alternatives,
                blank: Alternative::default,
            },
            0,
        )
        .optional(),
    ],
};

/// Sensors before their numbers are put in.
const EXACT: Sensors = Sensors {
    heading_deviation: 0.0,
    heading_interval: 0.0,
    heading_delay: 0.0,
    odometry_deviation: 0.0,
    odometry_interval: 0.0,
    seed: 0,
};

static SENSORS: Table<Sensors> = Table {
    doc: "A measured heading, and visual odometry between whose fixes the rover reckons on from \
          the turns of its rims.",
    fields: &[
        number(
            "heading_std_deg",
            DEG,
            0.0..=45.0,
            "Standard deviation of a measured heading",
            |it: &mut Sensors| Some(&mut it.heading_deviation),
        )
        .or(1.0),
        positive(
            "heading_interval_s",
            S,
            3600.0,
            "Time between two headings",
            |it: &mut Sensors| Some(&mut it.heading_interval),
        )
        .or(1.0),
        number(
            "heading_delay_s",
            S,
            0.0..=60.0,
            "How old a heading is when it is known",
            |it: &mut Sensors| Some(&mut it.heading_delay),
        )
        .or(0.0),
        number(
            "odometry_std",
            ONE,
            0.0..=1.0,
            "Standard deviation of a fix of visual odometry along the way since the last one and \
             across it, over that way",
            |it: &mut Sensors| Some(&mut it.odometry_deviation),
        )
        .or(0.02),
        positive(
            "odometry_interval_m",
            M,
            100.0,
            "Way of the rims between two fixes",
            |it: &mut Sensors| Some(&mut it.odometry_interval),
        )
        .or(0.5),
        whole(
            "seed",
            0..=LARGEST_SEED,
            "uint64",
            "Which realisation of the errors.",
            |it: &mut Sensors, seed| {
                it.seed = seed;
            },
        )
        .otherwise(Fill::Whole(0)),
    ],
};

static ALTERNATIVE: Table<Alternative> = Table {
    doc: "One of several ways to drive a mission.",
    fields: &[
        text("name", 1, "What the way is called; no two alike.", |way: &mut Alternative, name| {
            name.clone_into(&mut way.name);
        }),
        list(
            "leg",
            "What the rover does on this way, leg after leg.",
            &Each {
                inner: &LEG,
                list: |way: &mut Alternative| &mut way.legs,
                blank: LegKeys::default,
            },
            1,
        ),
    ],
};

static LEG: Table<LegKeys> = Table {
    doc: "One leg: exactly one of `drive_m`, `turn_deg`, `arc`, `goto` and `wait_s`, and how it is \
          driven.",
    fields: &[
        number(
            "drive_m",
            M,
            -LONGEST_WAY..=LONGEST_WAY,
            "It drives so far; below 0 backward",
            |leg: &mut LegKeys| Some(leg.drive.get_or_insert(0.0)),
        )
        .optional(),
        words(
            "by",
            "What measures `drive_m`; without it `ground`.",
            &[
                word(
                    "ground",
                    "The way of the centre of mass over the ground.",
                    |leg: &mut LegKeys| {
                        leg.by = Some(Measure::Ground);
                    },
                ),
                word(
                    "odometry",
                    "The way of the rims, mean of all wheels: where they slip, less ground is \
                     gone.",
                    |leg: &mut LegKeys| leg.by = Some(Measure::Odometry),
                ),
            ],
        )
        .optional(),
        number(
            "turn_deg",
            DEG,
            -LARGEST_TURN..=LARGEST_TURN,
            "It turns on the spot by this much, above 0 to its left, and keeps its place",
            |leg: &mut LegKeys| Some(leg.turn.get_or_insert(0.0)),
        )
        .optional(),
        table(
            "arc",
            "It drives along a circle.",
            &At { inner: &ARC, at: |leg: &mut LegKeys| leg.arc.get_or_insert_default() },
        )
        .optional(),
        table(
            "goto",
            "It drives along a straight line to a place, towards which it turns on the spot first \
             where that is not ahead.",
            &At { inner: &WAYPOINT, at: |leg: &mut LegKeys| leg.goto.get_or_insert_default() },
        )
        .optional(),
        number("wait_s", S, 0.0..=LONGEST_DURATION, "It stands so long", |leg: &mut LegKeys| {
            Some(leg.wait.get_or_insert(0.0))
        })
        .optional(),
        words(
            "steering",
            "What leads the rover round an `arc`; without it `sides`.",
            &[
                word(
                    "sides",
                    "The speeds of its sides: wheels slip sideways.",
                    |leg: &mut LegKeys| {
                        leg.steering = Some(Steering::Sides);
                    },
                ),
                word(
                    "ackermann",
                    "The wheels that are steered: each axle points to the centre of the circle, \
                     and rims are as fast as their distances from there.",
                    |leg: &mut LegKeys| leg.steering = Some(Steering::Ackermann),
                ),
            ],
        )
        .optional(),
        flag(
            "reverse",
            "Whether an arc, or the way to a place, is driven backward.",
            |leg: &mut LegKeys, yes| {
                leg.reverse = yes;
            },
        )
        .optional(),
        numbers(
            "speed_m_s",
            M_S,
            -FASTEST..=FASTEST,
            Form::OneOrEach(
                "Speed of every wheel's rim, above 0",
                "Speed of the rim of each mount's wheel as for a drive forward, in the mounts' \
                 order; below 0 it turns against the others",
            ),
            "Speed of the rims, (r + h_g) ω []; a list gives one for each mount; without it that \
             of the leg before, of a first leg 0.06",
            |leg: &mut LegKeys, count| leg.speed = Some(room(count)),
            |leg: &mut LegKeys, place| leg.speed.get_or_insert(room(None)).number_mut(place),
        )
        .optional(),
        table(
            "drive",
            "What turns the wheels of a `drive_m`, an `arc` or a `goto`; without it they keep \
             their speeds.",
            &DRIVE,
        )
        .optional(),
        direction(
            "yaw_deg",
            "Yaw before the leg, γ: of a first leg that of the start, of another turned to on the \
             spot; held only where `heading` says so; whole turns do not count",
            |leg: &mut LegKeys| Some(leg.yaw.get_or_insert(0.0)),
        )
        .optional(),
        words(
            "heading",
            "What `drive_m` holds on its way; without it nothing: the wheels keep one speed. \
             `goto` knows `crab` alone.",
            &[
                word("hold", "The yaw with which the leg begins.", |leg: &mut LegKeys| {
                    leg.held = Some(Held::Hold);
                }),
                word(
                    "contour",
                    "The height on the slope: the nose is turned uphill as far as that needs.",
                    |leg: &mut LegKeys| leg.held = Some(Held::Contour),
                ),
                word(
                    "toward",
                    "The nose, backward the tail, towards the place under `toward`.",
                    |leg: &mut LegKeys| leg.held = Some(Held::Toward),
                ),
                word(
                    "crab",
                    "The yaw and the line with which the leg begins: the sides hold the yaw, and \
                     the wheels that are steered turn together as far as the line needs; with \
                     `goto`, towards its place.",
                    |leg: &mut LegKeys| leg.held = Some(Held::Crab),
                ),
            ],
        )
        .optional(),
        number(
            "crab_deg",
            DEG,
            -90.0..=90.0,
            "Crab angle with which a leg of heading `crab` begins, above 0 to the left, of a \
             `goto` beyond the direction of its place; without it 0, and the rover learns it on \
             the way",
            |leg: &mut LegKeys| Some(leg.crab.get_or_insert(0.0)),
        )
        .optional(),
        table(
            "toward",
            "The place towards which the nose is held.",
            &At { inner: &PLACE, at: |leg: &mut LegKeys| leg.toward.get_or_insert_default() },
        )
        .optional(),
        positive(
            "look_ahead_m",
            M,
            1000.0,
            "How far ahead the way is simulated before it is driven: where a limit would be \
             passed, the rover stops before",
            |leg: &mut LegKeys| Some(leg.look_ahead.get_or_insert(0.0)),
        )
        .optional(),
        table(
            "stop",
            "Limits of this leg, in place of the mission's for the same numbers.",
            &At { inner: &STOPS, at: |leg: &mut LegKeys| &mut leg.stops },
        )
        .optional(),
    ],
};

static DRIVE: Laws<LegKeys> = Laws {
    doc: "What turns the wheels of a leg: speeds that follow the slip of each wheel.",
    key: "law",
    may_be_left_out: false,
    is_written_last: false,
    all: &[
        Law {
            name: "eq18",
            word: Some("Eq. 18 of the source, corrected: `speed_m_s` is the speed along the way."),
            choose: |leg| leg.law = Some(LegLaw::Eq18(0.0)),
            table: Table { doc: "Eq. 18 of the source, corrected.", fields: &[REFERENCE_SLIP] },
        },
        Law {
            name: "eq18-as-printed",
            word: Some("The same as printed."),
            choose: |leg| leg.law = Some(LegLaw::Eq18AsPrinted(0.0)),
            table: Table { doc: "Eq. 18 of the source as printed.", fields: &[REFERENCE_SLIP] },
        },
        Law {
            name: "slip-limiting",
            word: Some("`speed_m_s`, but slower for a wheel that slips more than it may."),
            choose: |leg| leg.law = Some(LegLaw::SlipLimiting(0.0)),
            table: Table {
                doc: "Constant rim speeds; a wheel that slips more than it may turns slower.",
                fields: &[slip("largest_slip_ratio", "The most that a wheel may slip, s_max")
                    .or(USUAL_LIMIT)],
            },
        },
    ],
};

const REFERENCE_SLIP: Field<LegKeys> =
    slip("reference_slip_ratio", "Reference slip ratio, s_ref").or(PAPERS_SLIP);

const fn slip(key: &'static str, doc: &'static str) -> Field<LegKeys> {
    number(key, ONE, 0.0..=0.95, doc, |leg: &mut LegKeys| match leg.law.as_mut()? {
        LegLaw::Eq18AsPrinted(slip) | LegLaw::Eq18(slip) | LegLaw::SlipLimiting(slip) => Some(slip),
    })
}

static ARC: Table<Arc> = Table {
    doc: "A way along a circle.",
    fields: &[
        positive(
            "radius_m",
            M,
            LONGEST_WAY,
            "Radius of the circle of the centre of mass",
            |arc: &mut Arc| Some(&mut arc.radius),
        ),
        number(
            "angle_deg",
            DEG,
            -LARGEST_TURN..=LARGEST_TURN,
            "How far the rover turns on it, above 0 to its left: it drives on until its yaw has \
             turned so far, for at most twice the circle's way",
            |arc: &mut Arc| Some(&mut arc.angle),
        ),
    ],
};

/// How near to a waypoint is near enough [m]. Source: ours; a third of a small rover's length.
const NEAR: f64 = 0.1;

static WAYPOINT: Table<Waypoint> = Table {
    doc: "A place to drive to, in the slope frame: x along the contour, y uphill, from where the \
          mission starts; on ground with heights, on its map.",
    fields: &[
        X,
        Y,
        positive("within_m", M, 100.0, "How near is near enough", |to: &mut Waypoint| {
            Some(&mut to.within)
        })
        .or(NEAR),
    ],
};

static PLACE: Table<Waypoint> = Table {
    doc: "A place in the slope frame: x along the contour, y uphill, from where the mission \
          starts; on ground with heights, on its map.",
    fields: &[X, Y],
};

const X: Field<Waypoint> =
    place("x_m", "Along the contour, or on the map", |to| Some(&mut to.place.x));
const Y: Field<Waypoint> =
    place("y_m", "Uphill, measured along the slope, or on the map", |to| Some(&mut to.place.y));

const fn place(
    key: &'static str,
    doc: &'static str,
    reach: fn(&mut Waypoint) -> Option<&mut f64>,
) -> Field<Waypoint> {
    number(key, M, -FARTHEST..=FARTHEST, doc, reach)
}

/// The limits, one under the name of each number.
static STOPS: Table<Vec<Stop>> = Table {
    doc: "Limits, each under the name of its number: `slip_ratio = { above = 0.4, over_m = 1.0 }`, \
          or `slip_ratio = 0.4` for what it is above alone.",
    fields: &[
        limit(Limited::SlipRatio, &SLIP_RATIO),
        limit(Limited::Drift, &DRIFT),
        limit(Limited::DriftPerMetre, &DRIFT_PER_METRE),
        limit(Limited::Sinkage, &SINKAGE),
        limit(Limited::SinkageDepth, &SINKAGE_DEPTH),
        limit(Limited::Roll, &ROLL),
        limit(Limited::Pitch, &PITCH),
        limit(Limited::Torque, &TORQUE),
        limit(Limited::Time, &TIME),
        limit(Limited::Energy, &ENERGY),
        limit(Limited::OffPath, &OFF_PATH),
        limit(Limited::Current, &CURRENT),
        limit(Limited::Temperature, &TEMPERATURE),
        limit(Limited::Discharge, &DISCHARGE),
        limit(Limited::Shortfall, &SHORTFALL),
    ],
};

/// A limit, in the list of all: a new one where the list has no limit of this quantity yet.
const fn limit(limited: Limited, inner: &'static At<Vec<Stop>, Stop>) -> Field<Vec<Stop>> {
    let (name, meaning) = (limited_quantity(limited).name, limited.row().meaning);
    field(name, meaning, Shape::NumberOr("above", inner)).optional()
}

fn of(stops: &mut Vec<Stop>, limited: Limited) -> &mut Stop {
    let place = stops.iter().position(|stop| stop.limited == limited).unwrap_or_else(|| {
        stops.push(Stop::above(limited, 0.0));
        stops.len() - 1
    });
    &mut stops[place]
}

static SLIP_RATIO: At<Vec<Stop>, Stop> = At {
    inner: &Table {
        doc: LIMIT_OVER,
        fields: &[above(Limited::SlipRatio, 1.0), OVER, THEN, BACK_OUT],
    },
    at: |stops| of(stops, Limited::SlipRatio),
};
static DRIFT: At<Vec<Stop>, Stop> = At {
    inner: &Table {
        doc: LIMIT_OVER,
        fields: &[above(Limited::Drift, 100.0), OVER, THEN, BACK_OUT],
    },
    at: |stops| of(stops, Limited::Drift),
};
static DRIFT_PER_METRE: At<Vec<Stop>, Stop> = At {
    inner: &Table {
        doc: LIMIT_OVER,
        fields: &[above(Limited::DriftPerMetre, 1.0), OVER, THEN, BACK_OUT],
    },
    at: |stops| of(stops, Limited::DriftPerMetre),
};
static SINKAGE: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Sinkage, 2.0), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Sinkage),
};
static SINKAGE_DEPTH: At<Vec<Stop>, Stop> = At {
    inner: &Table {
        doc: LIMIT,
        fields: &[above(Limited::SinkageDepth, DEEPEST_MM), THEN, BACK_OUT],
    },
    at: |stops| of(stops, Limited::SinkageDepth),
};
static ROLL: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Roll, 90.0), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Roll),
};
static PITCH: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Pitch, 90.0), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Pitch),
};
static TORQUE: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Torque, 1e5), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Torque),
};
static TIME: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Time, LONGEST_DURATION), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Time),
};
static ENERGY: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Energy, 1e9), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Energy),
};
static OFF_PATH: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::OffPath, LONGEST_WAY), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::OffPath),
};
static CURRENT: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Current, 1e5), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Current),
};
static TEMPERATURE: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Temperature, 1e3), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Temperature),
};
static DISCHARGE: At<Vec<Stop>, Stop> = At {
    inner: &Table { doc: LIMIT, fields: &[above(Limited::Discharge, 1.0), THEN, BACK_OUT] },
    at: |stops| of(stops, Limited::Discharge),
};

static SHORTFALL: At<Vec<Stop>, Stop> = At {
    inner: &Table {
        doc: LIMIT,
        fields: &[above(Limited::Shortfall, LARGEST_TURN), THEN, BACK_OUT],
    },
    at: |stops| of(stops, Limited::Shortfall),
};

const LIMIT: &str = "A limit: above which number, and what the rover does then.";
const LIMIT_OVER: &str =
    "A limit: above which number, over which way of the rims, and what the rover does then.";

const fn above(limited: Limited, most: f64) -> Field<Stop> {
    let unit = limited_quantity(limited).unit;
    number("above", unit, 0.0..=most, "The rover stops above this", |stop: &mut Stop| {
        Some(&mut stop.above)
    })
}

const OVER: Field<Stop> = positive(
    "over_m",
    M,
    1000.0,
    "Way of the rims over which it is taken; before they have gone so far, nothing is limited",
    |stop: &mut Stop| Some(&mut stop.over),
)
.or(1.0);

const THEN: Field<Stop> = words(
    "then",
    "What the rover does once it has stopped.",
    &[
        word("end", "The mission ends.", |stop: &mut Stop| stop.then = Then::End),
        word("next-leg", "The next leg begins.", |stop: &mut Stop| stop.then = Then::NextLeg),
        word(
            "back-out",
            "It drives `back_out_m` against the way of the leg, and the mission ends.",
            |stop: &mut Stop| stop.then = Then::BackOut(0.0),
        ),
    ],
)
.otherwise(Fill::Keyword("end"));

const BACK_OUT: Field<Stop> = positive(
    "back_out_m",
    M,
    LONGEST_WAY,
    "How far it backs out, where `then` says so",
    |stop: &mut Stop| match &mut stop.then {
        Then::BackOut(way) => Some(way),
        Then::End | Then::NextLeg => None,
    },
)
.optional();
