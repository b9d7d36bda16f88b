//! `design/1`: numbers of a rover that are free, what is to be least, and what is limited.

use super::super::design::{DesignAim, DesignSettings, LimitEnds, Measure};
use super::super::field::{
    A, At, DEG, Field, Fill, J_PER_M, KG, Keyed, Keyword, M, NM, ONE, Shape, Table, Unit, field,
    list, note, number, table, word, words,
};
use super::about::{assumed, gravity, model, notes, purpose, schema, source};
use super::run::{OfScenario, Run, SLOPE};
use grouser_core::simulation::Scenario;

impl OfScenario for DesignSettings {
    fn scenario(&mut self) -> &mut Scenario {
        &mut self.scenario
    }
}

pub(crate) static DESIGN: Table<DesignSettings> = Table {
    doc: "Numbers of a rover that are free between bounds, what is to be least, and what is \
          limited.",
    fields: &[
        schema("design/1"),
        purpose(),
        source().optional(),
        notes(),
        assumed(),
        Run::ROVER,
        Run::SOIL,
        Run::MODEL,
        Run::GRAVITY,
        Run::SLOPE,
        course(|all: &mut DesignSettings| Some(&mut all.course)).or(0.0),
        Run::LOAD_TRANSFER,
        Run::WHEEL_MOMENTS,
        words("minimise", "What is to be least.", MINIMISE),
        table("weights", "What each measure counts in a weighted sum, in its unit.", &WEIGHTS)
            .optional(),
        field(
            "free",
            "The numbers that are free: keys such as `rover.wheel_unit.wheel.radius_m`, each with \
             the least and the most that it may be.",
            Shape::Keyed(Keyed::Bounds),
        ),
        field(
            "tied",
            "Numbers that go with free ones: keys, each with the key of a free number that it is as \
             large as, or of the other sign with a minus before it.",
            Shape::Keyed(Keyed::Tie),
        )
        .optional(),
        field(
            "choose",
            "Keys of the rover with the numbers or names that they may have, `rover` itself among \
             them; every combination is tried.",
            Shape::Keyed(Keyed::Choices),
        )
        .optional(),
        table("subject_to", "What is limited: `at_least`, `at_most` or both.", &LIMITS)
            .otherwise(Fill::Keys(&[])),
        number(
            "probability",
            ONE,
            0.5..=0.99,
            "With which probability each limit is to be kept, where the soil is uncertain",
            |all: &mut DesignSettings| Some(&mut all.probability),
        )
        .or(0.95),
        list("also", "Where all limits hold as well.", &ALSO, 1).optional(),
    ],
};

const MINIMISE: &[Keyword<DesignSettings>] = &[
    least(Measure::WheelMass, |all| all.aim = DesignAim::One(Measure::WheelMass)),
    least(Measure::EnergyPerMetre, |all| all.aim = DesignAim::One(Measure::EnergyPerMetre)),
    least(Measure::SlipRatio, |all| all.aim = DesignAim::One(Measure::SlipRatio)),
    least(Measure::SinkageRatio, |all| all.aim = DesignAim::One(Measure::SinkageRatio)),
    least(Measure::Crab, |all| all.aim = DesignAim::One(Measure::Crab)),
    least(Measure::Torque, |all| all.aim = DesignAim::One(Measure::Torque)),
    least(Measure::Current, |all| all.aim = DesignAim::One(Measure::Current)),
    word("weighted_sum", "The sum of measures with their `weights`.", |all| {
        all.aim = DesignAim::WeightedSum;
    }),
];

const fn least(measure: Measure, put: fn(&mut DesignSettings)) -> Keyword<DesignSettings> {
    word(measure.name(), measure.sentence(), put)
}

/// A place where limits hold as well: what is not said is as the document has it.
static ALSO: Table<DesignSettings> = Table {
    doc: "A second ground, on which all limits hold as well.",
    fields: &[
        note("soil", "The soil: a preset's name, or a path from this document's folder.")
            .optional(),
        gravity("Gravity, g", |_: &mut DesignSettings| None).optional(),
        number(SLOPE, DEG, 0.0..=60.0, "Inclination of the plane, α", |_| None).optional(),
        course(|_| None).optional(),
        model("The wheel-soil model."),
    ],
};

const fn course(reach: fn(&mut DesignSettings) -> Option<&mut f64>) -> Field<DesignSettings> {
    let doc = "Course, χ: direction of travel from the contour; 90 straight uphill";
    number("course_deg", DEG, -90.0..=90.0, doc, reach)
}

static WEIGHTS: Table<DesignSettings> = Table {
    doc: "What each measure counts in a weighted sum, in its unit.",
    fields: &[
        weight(Measure::SinkageRatio, |all| Some(&mut all.weights[Measure::SinkageRatio.place()])),
        weight(Measure::SlipRatio, |all| Some(&mut all.weights[Measure::SlipRatio.place()])),
        weight(Measure::EnergyPerMetre, |all| {
            Some(&mut all.weights[Measure::EnergyPerMetre.place()])
        }),
        weight(Measure::Crab, |all| Some(&mut all.weights[Measure::Crab.place()])),
        weight(Measure::Torque, |all| Some(&mut all.weights[Measure::Torque.place()])),
        weight(Measure::Current, |all| Some(&mut all.weights[Measure::Current.place()])),
        weight(Measure::WheelMass, |all| Some(&mut all.weights[Measure::WheelMass.place()])),
    ],
};

/// What a measure counts: a number over one in the measure's unit.
const fn weight(
    measure: Measure,
    reach: fn(&mut DesignSettings) -> Option<&mut f64>,
) -> Field<DesignSettings> {
    number(measure.name(), ONE, 0.0..=FARTHEST, "What one in its unit counts", reach).optional()
}

static LIMITS: Table<DesignSettings> = Table {
    doc: "What is limited: `at_least`, `at_most` or both.",
    fields: &[
        limit(Measure::LimitSlope, &LIMIT_SLOPE),
        limit(Measure::SinkageRatio, &SINKAGE_RATIO),
        limit(Measure::SlipRatio, &SLIP_RATIO),
        limit(Measure::EnergyPerMetre, &ENERGY),
        limit(Measure::Crab, &CRAB),
        limit(Measure::Torque, &TORQUE),
        limit(Measure::BrakingTorque, &BRAKING_TORQUE),
        limit(Measure::Current, &CURRENT),
        limit(Measure::TippingSlope, &TIPPING_SLOPE),
        limit(Measure::Width, &WIDTH),
        limit(Measure::WheelMass, &WHEEL_MASS),
    ],
};

const fn limit(
    measure: Measure,
    ends: &'static At<DesignSettings, LimitEnds>,
) -> Field<DesignSettings> {
    table(measure.name(), measure.sentence(), ends).optional()
}

static LIMIT_SLOPE: At<DesignSettings, LimitEnds> =
    At { inner: &ANGLE, at: |all| &mut all.limits[Measure::LimitSlope.place()] };
static SINKAGE_RATIO: At<DesignSettings, LimitEnds> =
    At { inner: &RATIO, at: |all| &mut all.limits[Measure::SinkageRatio.place()] };
static SLIP_RATIO: At<DesignSettings, LimitEnds> =
    At { inner: &RATIO, at: |all| &mut all.limits[Measure::SlipRatio.place()] };
static ENERGY: At<DesignSettings, LimitEnds> =
    At { inner: &WORK, at: |all| &mut all.limits[Measure::EnergyPerMetre.place()] };
static CRAB: At<DesignSettings, LimitEnds> =
    At { inner: &ANGLE, at: |all| &mut all.limits[Measure::Crab.place()] };
static TORQUE: At<DesignSettings, LimitEnds> =
    At { inner: &MOMENT, at: |all| &mut all.limits[Measure::Torque.place()] };
static BRAKING_TORQUE: At<DesignSettings, LimitEnds> =
    At { inner: &MOMENT, at: |all| &mut all.limits[Measure::BrakingTorque.place()] };
static CURRENT: At<DesignSettings, LimitEnds> =
    At { inner: &AMPERES, at: |all| &mut all.limits[Measure::Current.place()] };
static TIPPING_SLOPE: At<DesignSettings, LimitEnds> =
    At { inner: &ANGLE, at: |all| &mut all.limits[Measure::TippingSlope.place()] };
static WIDTH: At<DesignSettings, LimitEnds> =
    At { inner: &LENGTH, at: |all| &mut all.limits[Measure::Width.place()] };
static WHEEL_MASS: At<DesignSettings, LimitEnds> =
    At { inner: &MASS, at: |all| &mut all.limits[Measure::WheelMass.place()] };

static ANGLE: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(DEG), at_most(DEG)] };
static RATIO: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(ONE), at_most(ONE)] };
static WORK: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(J_PER_M), at_most(J_PER_M)] };
static MOMENT: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(NM), at_most(NM)] };
static AMPERES: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(A), at_most(A)] };
static LENGTH: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(M), at_most(M)] };
static MASS: Table<LimitEnds> = Table { doc: ENDS, fields: &[at_least(KG), at_most(KG)] };

const ENDS: &str = "The least or the most that it may be.";
/// Keys of which a limit has one.
const SIDES: &[&str] = &["at_least", "at_most"];
/// No limit is farther from zero, and no weight is larger. Source: ours.
const FARTHEST: f64 = 1e6;

const fn at_least(unit: Unit) -> Field<LimitEnds> {
    let doc = "The least that it may be";
    number("at_least", unit, -FARTHEST..=FARTHEST, doc, |ends: &mut LimitEnds| {
        Some(&mut ends.least)
    })
    .any_of(SIDES)
}

const fn at_most(unit: Unit) -> Field<LimitEnds> {
    let doc = "The most that it may be";
    number("at_most", unit, -FARTHEST..=FARTHEST, doc, |ends: &mut LimitEnds| Some(&mut ends.most))
        .any_of(SIDES)
}
