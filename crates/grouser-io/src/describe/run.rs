//! Rows of whatever drives a rover over the ground, scenario or mission: rover, ground, model, and
//! how it is computed.

use std::marker::PhantomData;

use super::super::field::{
    At, DEG, Field, Fill, S, Table, direction, number, part, table, word, words,
};
use super::super::kind::{DEFAULT_ROVER, DEFAULT_SOIL, Kind};
use super::about::{gravity, model};
use super::differences;
use super::rover;
use super::soil;
use super::terrain;
use grouser_core::simulation::{Approach, Motion, Numerics, Scatter, Scenario, Start};
use grouser_core::soil::Soil;
use grouser_core::terrain::{Ground, Shape};
use grouser_core::vehicle::{ByWheel, LoadSharing, OwnMoments, Rover, RoverParts, Ruts};

/// The slope on which the source's Table 4 is best met [°].
const PAPERS_SLOPE: f64 = 10.0;

/// The key of ground with heights.
pub(crate) const TERRAIN: &str = "terrain";
/// The key of the plane's inclination.
pub(crate) const SLOPE: &str = "slope_deg";

/// A rover by its parts.
pub(crate) static ROVER_OF_PARTS: At<Rover, RoverParts> =
    At { inner: &rover::ROVER, at: Rover::parts_mut };

/// What a run is of.
pub(crate) trait OfScenario: 'static {
    fn scenario(&mut self) -> &mut Scenario;
}

impl OfScenario for Scenario {
    fn scenario(&mut self) -> &mut Scenario {
        self
    }
}

/// The rows, for a value that has a scenario.
pub(super) struct Run<T>(PhantomData<T>);

impl<T: OfScenario> Run<T> {
    const OF_ROVER: &At<T, Rover> =
        &At { inner: &ROVER_OF_PARTS, at: |all| &mut all.scenario().rover };
    const OF_SOIL: &At<T, Soil> =
        &At { inner: &soil::SOIL, at: |all| &mut all.scenario().ground.soil };
    const OF_BY_WHEEL: &At<T, ByWheel> =
        &At { inner: &differences::BY_WHEEL, at: |all| &mut all.scenario().by_wheel };
    const OF_SCATTER: &At<T, Scatter> =
        &At { inner: &differences::SCATTER, at: |all| &mut all.scenario().scatter };
    const OF_TERRAIN: &At<T, Ground> =
        &At { inner: &terrain::TERRAIN, at: |all| &mut all.scenario().ground };
    const OF_START: &At<T, Start> = &At { inner: &START, at: |all| &mut all.scenario().start };

    pub(super) const ROVER: Field<T> = part(
        "rover",
        Kind::Rover,
        "The rover: a preset's name, a path from this document's folder, or a rover's keys.",
        Self::OF_ROVER,
    )
    .otherwise(Fill::Keyword(DEFAULT_ROVER));
    pub(super) const SOIL: Field<T> = part(
        "soil",
        Kind::Soil,
        "The soil: a preset's name, a path from this document's folder, or a soil's keys.",
        Self::OF_SOIL,
    )
    .otherwise(Fill::Keyword(DEFAULT_SOIL));
    pub(super) const MODEL: Field<T> =
        model("The wheel-soil model; without it the soil's own, or else `ishigami`.");
    pub(super) const GRAVITY: Field<T> =
        gravity("Gravity, g", |all: &mut T| Some(&mut all.scenario().gravity));
    pub(super) const SLOPE: Field<T> =
        number(SLOPE, DEG, 0.0..=60.0, "Inclination of the plane, α", |all: &mut T| {
            slope_of(&mut all.scenario().ground)
        })
        .or(PAPERS_SLOPE);
    pub(super) const TERRAIN: Field<T> = table(
        TERRAIN,
        "Ground with heights, in place of the plane; `slope_deg` is then left out, or 0.",
        Self::OF_TERRAIN,
    )
    .optional();
    pub(super) const SAMPLE_INTERVAL: Field<T> = number(
        "sample_interval_s",
        S,
        1e-3..=3600.0,
        "Time between two recorded samples",
        |all: &mut T| Some(&mut all.scenario().numerics.sample_interval),
    )
    .or(Numerics::DEFAULT.sample_interval);
    pub(super) const LOAD_TRANSFER: Field<T> = words(
        "load_transfer",
        "Load transfer: how the weight is shared among the wheels.",
        &[
            word(
                "complete",
                "The wheels' torque in pitch, their overturning moments in roll, and their \
                     aligning moments in yaw.",
                |all: &mut T| all.scenario().sharing = LoadSharing::Complete,
            ),
            word(
                "quasi-static",
                "The weight's pull along the slope, in pitch and roll: the source paper's.",
                |all: &mut T| all.scenario().sharing = LoadSharing::QuasiStatic,
            ),
            word(
                "quasi-static-torque",
                "The same, with the wheels' torque in pitch.",
                |all: &mut T| all.scenario().sharing = LoadSharing::QuasiStaticTorque,
            ),
            word("uniform", "Equal loads.", |all: &mut T| {
                all.scenario().sharing = LoadSharing::Uniform;
            }),
        ],
    )
    .otherwise(Fill::Keyword("complete"));
    pub(super) const WHEEL_MOMENTS: Field<T> = words(
        "wheel_moments",
        "Whether the wheels' own overturning and aligning moments act on the rover; without it \
             they do where the load transfer is complete.",
        &[
            word("neglected", "They are reported only.", |all: &mut T| {
                all.scenario().own_moments = OwnMoments::Neglected;
            }),
            word("included", "They act on the rover.", |all: &mut T| {
                all.scenario().own_moments = OwnMoments::Included;
            }),
        ],
    )
    .following(
        "load_transfer",
        &[
            ("complete", "included"),
            ("quasi-static", "neglected"),
            ("quasi-static-torque", "neglected"),
            ("uniform", "neglected"),
        ],
    );
    pub(super) const SIMULATION: Field<T> = words(
        "simulation",
        "Whether velocities are integrated, or those of a steady state at every instant; without \
             it `quasi-steady` over a `terrain`, and `dynamic` on a plane.",
        &[
            word("dynamic", "They are integrated with the pose.", |all: &mut T| {
                all.scenario().numerics.approach = Approach::Dynamic;
            }),
            word(
                "quasi-steady",
                "They are those at which nothing accelerates: fast; where that is not valid, \
                     dynamic.",
                |all: &mut T| all.scenario().numerics.approach = Approach::QuasiSteady,
            ),
        ],
    )
    .with_key(TERRAIN, ["quasi-steady", "dynamic"]);
    pub(super) const BY_WHEEL: Field<T> = table(
        "by_wheel",
        "How the soil below each wheel, and its speed, differ from what is said of all.",
        Self::OF_BY_WHEEL,
    )
    .otherwise(Fill::Keys(&[]));
    pub(super) const SCATTER: Field<T> = table(
        "scatter",
        "How the soil scatters from place to place, and the speed from wheel to wheel.",
        Self::OF_SCATTER,
    )
    .otherwise(Fill::Keys(&[]));
    pub(super) const RUTS: Field<T> = words(
        "ruts",
        "What wheels leave behind for those that roll in their ruts.",
        &[
            word("none", "Nothing: every wheel rolls on fresh soil.", |all: &mut T| {
                all.scenario().ruts = Ruts::Fresh;
            }),
            word(
                "compacted",
                "Denser soil that shears sooner, by the passes before (Holm 1969), as far as ruts \
                 overlap on a straight way.",
                |all: &mut T| all.scenario().ruts = Ruts::Compacted,
            ),
        ],
    )
    .otherwise(Fill::Keyword("none"));
    pub(super) const START: Field<T> =
        table("start", "How the run starts.", Self::OF_START).otherwise(Fill::Keys(&[]));
}

/// The inclination of ground that is a plane.
fn slope_of(ground: &mut Ground) -> Option<&mut f64> {
    match &mut ground.shape {
        Shape::Plane(plane) => Some(&mut plane.slope),
        Shape::Map(_) | Shape::Formula(_) | Shape::Own(_) => None,
    }
}

static START: Table<Start> = Table {
    doc: "How the run starts.",
    fields: &[
        direction(
            "yaw_deg",
            "Yaw, γ; above 0 with the nose uphill; whole turns do not count",
            |start: &mut Start| Some(&mut start.yaw),
        )
        .or(0.0),
        words(
            "motion",
            "Whether the rover already moves.",
            &[
                word(
                    "rolling",
                    "The hubs move at 0.95 of the rim speed along the body's x axis.",
                    |start: &mut Start| start.motion = Motion::Rolling,
                ),
                word("rest", "Nothing moves but the wheels.", |start: &mut Start| {
                    start.motion = Motion::Rest;
                }),
            ],
        )
        .otherwise(Fill::Keyword("rolling")),
    ],
};
