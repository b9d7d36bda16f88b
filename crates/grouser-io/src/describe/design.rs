//! `design/1`: numbers of a rover that are free, what is to be least, and what is limited.

use super::super::design::{Ends, Measure, Settings};
use super::super::field::{
    At, DEG, Field, Fill, J_PER_M, KG, NM, ONE, Shape, Table, Unit, field, number, table, word,
    words,
};
use super::about::{assumed, notes, purpose, schema, source};
use super::run::{OfScenario, Run};
use grouser_core::simulation::Scenario;

impl OfScenario for Settings {
    fn scenario(&mut self) -> &mut Scenario {
        &mut self.scenario
    }
}

pub(crate) static DESIGN: Table<Settings> = Table {
    doc: "Numbers of a rover that are free between bounds, what is to be least, and what is limited.",
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
        Run::LOAD_TRANSFER,
        Run::WHEEL_MOMENTS,
        words(
            "minimise",
            "What is to be least.",
            &[
                word("wheel_mass_kg", "Mass of all wheels.", |all: &mut Settings| {
                    all.minimise = Measure::WheelMass;
                }),
                word("energy_j_per_m", "Work of the wheels per metre of way.", |all| {
                    all.minimise = Measure::EnergyPerMetre;
                }),
                word("slip_ratio", "Slip ratio of the wheels.", |all| {
                    all.minimise = Measure::SlipRatio;
                }),
                word("sinkage_ratio", "The deepest wheel's sinkage over its radius.", |all| {
                    all.minimise = Measure::SinkageRatio;
                }),
                word("yaw_deg", "The yaw that holds the contour.", |all| {
                    all.minimise = Measure::Yaw;
                }),
                word("torque_nm", "The largest torque of a wheel.", |all| {
                    all.minimise = Measure::Torque;
                }),
            ],
        ),
        field(
            "free",
            "The numbers that are free: keys such as `rover.wheel_unit.wheel.radius_m`, each with \
             the least and the most that it may be.",
            Shape::Bounds(|all: &mut Settings, key, ends| all.free.push((key.to_owned(), ends))),
        ),
        table("subject_to", "What is limited: `at_least`, `at_most` or both.", &LIMITS)
            .otherwise(Fill::Keys(&[])),
    ],
};

static LIMITS: Table<Settings> = Table {
    doc: "What is limited: `at_least`, `at_most` or both.",
    fields: &[
        table(
            "limit_slope_deg",
            "The steepest slope on which a heading holds the contour.",
            &LIMIT_SLOPE,
        )
        .optional(),
        table(
            "sinkage_ratio",
            "The deepest wheel's sinkage over its shearing radius.",
            &SINKAGE_RATIO,
        )
        .optional(),
        table("slip_ratio", "Slip ratio of the wheels.", &SLIP_RATIO).optional(),
        table("energy_j_per_m", "Work of the wheels per metre of way.", &ENERGY).optional(),
        table("yaw_deg", "The yaw that holds the contour.", &YAW).optional(),
        table("torque_nm", "The largest torque of a wheel.", &TORQUE).optional(),
        table("wheel_mass_kg", "Mass of all wheels.", &WHEEL_MASS).optional(),
    ],
};

static LIMIT_SLOPE: At<Settings, Ends> = At { inner: &ANGLE, at: |all| &mut all.limits[0] };
static SINKAGE_RATIO: At<Settings, Ends> = At { inner: &RATIO, at: |all| &mut all.limits[1] };
static SLIP_RATIO: At<Settings, Ends> = At { inner: &RATIO, at: |all| &mut all.limits[2] };
static ENERGY: At<Settings, Ends> = At { inner: &WORK, at: |all| &mut all.limits[3] };
static YAW: At<Settings, Ends> = At { inner: &ANGLE, at: |all| &mut all.limits[4] };
static TORQUE: At<Settings, Ends> = At { inner: &MOMENT, at: |all| &mut all.limits[5] };
static WHEEL_MASS: At<Settings, Ends> = At { inner: &MASS, at: |all| &mut all.limits[6] };

static ANGLE: Table<Ends> = Table { doc: ENDS, fields: &[at_least(DEG), at_most(DEG)] };
static RATIO: Table<Ends> = Table { doc: ENDS, fields: &[at_least(ONE), at_most(ONE)] };
static WORK: Table<Ends> = Table { doc: ENDS, fields: &[at_least(J_PER_M), at_most(J_PER_M)] };
static MOMENT: Table<Ends> = Table { doc: ENDS, fields: &[at_least(NM), at_most(NM)] };
static MASS: Table<Ends> = Table { doc: ENDS, fields: &[at_least(KG), at_most(KG)] };

const ENDS: &str = "The least or the most that it may be.";
/// Keys of which a limit has one.
const SIDES: &[&str] = &["at_least", "at_most"];
/// No limit is farther from zero. Source: ours.
const FARTHEST: f64 = 1e6;

const fn at_least(unit: Unit) -> Field<Ends> {
    let range = -FARTHEST..=FARTHEST;
    number("at_least", unit, range, "The least that it may be", |ends: &mut Ends| {
        Some(&mut ends.least)
    })
    .any_of(SIDES)
}

const fn at_most(unit: Unit) -> Field<Ends> {
    let range = -FARTHEST..=FARTHEST;
    number("at_most", unit, range, "The most that it may be", |ends: &mut Ends| {
        Some(&mut ends.most)
    })
    .any_of(SIDES)
}
