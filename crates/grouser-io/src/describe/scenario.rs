//! `scenario/1`: a run. Every key has a default, and together the defaults are the source paper's
//! experiment on a slope of 10° without compensation.

use std::ops::RangeInclusive;

use super::super::field::{
    At, DEG, Field, Fill, Form, Law, Laws, M, M_S, ONE, S, Table, number, numbers, pairs, positive,
    table,
};
use super::about::{assumed, notes, purpose, schema, source};
use super::differences::room;
use super::rover;
use super::run::Run;
use super::soil;
use grouser_core::contact::Model;
use grouser_core::simulation::scenario::LONGEST_DURATION;
use grouser_core::simulation::{Motion, Numerics, PrescribedYaw, Scatter, Scenario, Start};
use grouser_core::soil::SlopeStability;
use grouser_core::terrain::Ground;
use grouser_core::vehicle::drive::{SlipLimit, SlipTarget};
use grouser_core::vehicle::{ByWheel, DriveLaw, LoadSharing, OwnMoments, PerWheel, Rover, Ruts};

/// The fastest rim [m/s]. The models are quasi-static: this is far beyond their validity.
pub(crate) const FASTEST: f64 = 10.0;

/// Allowed speeds of a rim, ω r_s [m/s].
pub const RIM_SPEED_M_S: RangeInclusive<f64> = -FASTEST..=FASTEST;

/// Source: [FourWheel], section 5.2: "each wheel speed is set at 6 cm/s" [m/s].
const PAPERS_SPEED: f64 = 0.06;
/// Source: [FourWheel], section 3: s_ref is chosen at 0.2 [-].
pub(super) const PAPERS_SLIP: f64 = 0.2;
/// About the length of the source's runs, which is not printed [s].
const PAPERS_DURATION: f64 = 20.0;

/// The most that a drive lets a wheel slip [-]. Source: ours; at this slip Opportunity's drives
/// were commanded to stop.
pub(super) const USUAL_LIMIT: f64 = 0.4;

const NO_TARGET: SlipTarget = SlipTarget { speed: 0.0, slip_ratio: 0.0 };

/// A scenario before its numbers are put in.
pub(crate) fn blank() -> Scenario {
    Scenario {
        rover: Rover::draft(rover::BLANK),
        ground: Ground::plane(soil::BLANK, 0.0),
        gravity: 0.0,
        model: Model::default(),
        sharing: LoadSharing::Complete,
        own_moments: OwnMoments::Included,
        drive: DriveLaw::Constant(0.0),
        yaw: None,
        by_wheel: ByWheel::ALIKE,
        scatter: Scatter::NONE,
        ruts: Ruts::Fresh,
        stability: SlopeStability::USUAL,
        start: Start { yaw: 0.0, motion: Motion::Rolling },
        duration: 0.0,
        numerics: Numerics::default(),
    }
}

pub(crate) static SCENARIO: Table<Scenario> = Table {
    doc: "One run of one rover over a plane of soil, or over ground with heights.",
    fields: &[
        schema("scenario/1"),
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
        positive(
            "duration_s",
            S,
            LONGEST_DURATION,
            "How long the run lasts",
            |run: &mut Scenario| Some(&mut run.duration),
        )
        .or(PAPERS_DURATION),
        Run::SAMPLE_INTERVAL,
        Run::LOAD_TRANSFER,
        Run::WHEEL_MOMENTS,
        Run::SIMULATION,
        table("drive", "What turns the wheels.", &DRIVE).otherwise(Fill::Keys(&[])),
        Run::BY_WHEEL,
        Run::SCATTER,
        Run::RUTS,
        table(
            "slope_stability",
            "What is asked of the ground's own strength (infinite slope) by headings, maps and \
             cards; a run is not changed by it.",
            &At { inner: &SLOPE_STABILITY, at: |run: &mut Scenario| &mut run.stability },
        )
        .otherwise(Fill::Keys(&[])),
        Run::START,
    ],
};

static DRIVE: Laws<Scenario> = Laws {
    doc: "What turns the wheels.",
    key: "law",
    may_be_left_out: true,
    is_written_last: false,
    all: &[
        Law {
            name: "constant",
            word: Some("Constant wheel speeds."),
            choose: |run| run.drive = DriveLaw::Constant(0.0),
            table: Table {
                doc: "Constant wheel speeds, as in the source's experiments.",
                fields: &[RIM_SPEED, YAW],
            },
        },
        Law {
            name: "eq18-as-printed",
            word: Some("As printed."),
            choose: |run| run.drive = DriveLaw::Eq18AsPrinted(NO_TARGET),
            table: Table {
                doc: "Eq. 18 of the source as printed.",
                fields: &[DESIRED_SPEED, REFERENCE_SLIP, YAW],
            },
        },
        Law {
            name: "eq18",
            word: Some("Corrected."),
            choose: |run| run.drive = DriveLaw::Eq18(NO_TARGET),
            table: Table {
                doc: "Eq. 18 of the source, corrected.",
                fields: &[DESIRED_SPEED, REFERENCE_SLIP, YAW],
            },
        },
        Law {
            name: "slip-limiting",
            word: Some("Constant, but slower for a wheel that slips more than it may."),
            choose: |run| {
                run.drive = DriveLaw::SlipLimiting(SlipLimit {
                    speed: PerWheel::All(0.0),
                    slip_ratio: 0.0,
                });
            },
            table: Table {
                doc: "Constant rim speeds; a wheel that slips more than it may turns slower.",
                fields: &[
                    RIM_SPEED,
                    number(
                        "largest_slip_ratio",
                        ONE,
                        0.0..=0.95,
                        "The most that a wheel may slip, s_max",
                        |run: &mut Scenario| match &mut run.drive {
                            DriveLaw::SlipLimiting(limit) => Some(&mut limit.slip_ratio),
                            _ => None,
                        },
                    )
                    .or(USUAL_LIMIT),
                    YAW,
                ],
            },
        },
    ],
};

const RIM_SPEED: Field<Scenario> = numbers(
    "rim_speed_m_s",
    M_S,
    -FASTEST..=FASTEST,
    Form::OneOrEach(
        "Rim speed of every wheel",
        "Rim speed of each mount's wheel, in the mounts' order",
    ),
    "Speed of the rim, (r + h_g) ω []; a list gives one for each mount, in their order",
    |run: &mut Scenario, count| match &mut run.drive {
        DriveLaw::SlipLimiting(limit) => limit.speed = room(count),
        drive => {
            *drive = count
                .map_or(DriveLaw::Constant(0.0), |count| DriveLaw::ConstantEach(vec![0.0; count]));
        }
    },
    |run: &mut Scenario, place| match &mut run.drive {
        DriveLaw::Constant(speed) if place == 0 => Some(speed),
        DriveLaw::ConstantEach(speeds) => speeds.get_mut(place),
        DriveLaw::SlipLimiting(limit) => limit.speed.number_mut(place),
        _ => None,
    },
)
.or(PAPERS_SPEED);
const DESIRED_SPEED: Field<Scenario> = positive(
    "ground_speed_m_s",
    M_S,
    FASTEST,
    "Desired speed along the contour, v_des",
    |run: &mut Scenario| Some(&mut target(run)?.speed),
)
.or(PAPERS_SPEED);
const REFERENCE_SLIP: Field<Scenario> = number(
    "reference_slip_ratio",
    ONE,
    0.0..=0.95,
    "Reference slip ratio, s_ref",
    |run: &mut Scenario| Some(&mut target(run)?.slip_ratio),
)
.or(PAPERS_SLIP);

/// The yaw over time.
const YAW: Field<Scenario> = pairs(
    "yaw_deg",
    [S, DEG],
    &[0.0..=LONGEST_DURATION, -LARGEST_YAW..=LARGEST_YAW],
    "Yaw over time, γ [°], as pairs of time [s] and yaw: straight between them, constant before \
     and after; without it the wheels' moments turn the rover",
    |run: &mut Scenario, count| {
        run.yaw = Some(PrescribedYaw { points: vec![(0.0, 0.0); count] });
    },
    |run: &mut Scenario, place| {
        let (time, yaw) = run.yaw.as_mut()?.points.get_mut(place)?;
        Some([time, yaw])
    },
)
.optional();

/// The largest yaw of a course over time [°]: ten turns.
const LARGEST_YAW: f64 = 3600.0;

fn target(run: &mut Scenario) -> Option<&mut SlipTarget> {
    match &mut run.drive {
        DriveLaw::Eq18AsPrinted(target) | DriveLaw::Eq18(target) => Some(target),
        DriveLaw::Constant(_) | DriveLaw::ConstantEach(_) | DriveLaw::SlipLimiting(_) => None,
    }
}

static SLOPE_STABILITY: Table<SlopeStability> = Table {
    doc: "The least factor of safety of the ground against sliding by its own weight.",
    fields: &[
        number(
            "factor_of_safety",
            ONE,
            0.1..=10.0,
            "Least factor of safety, FS",
            |asked: &mut SlopeStability| Some(&mut asked.factor_of_safety),
        )
        .or(SlopeStability::USUAL.factor_of_safety),
        positive(
            "depth_m",
            M,
            1000.0,
            "Depth of the layer that would slide, z, straight down; it counts where there is \
             cohesion",
            |asked: &mut SlopeStability| Some(&mut asked.depth),
        )
        .or(SlopeStability::USUAL.depth),
    ],
};
