//! `campaign/1`: many runs of one study, over numbers that are not known exactly.

use super::super::campaign::{Sampling, Settings, Stand, Study};
use super::super::field::{
    At, DEG, Fill, N, ONE, Shape, Table, field, flag, list, note, number, part, table, whole, word,
    words,
};
use super::super::kind::Kind;
use super::super::mission::Plan;
use super::super::stated::Stated;
use super::about::{assumed, gravity, model, notes, purpose, schema};
use super::differences::LARGEST_SEED;
use super::mission::{self, MISSION};
use super::scenario::{self, SCENARIO};
use super::soil::{self, SOIL};
use super::uncertainty::{
    CORRELATIONS, CORRELATIONS_DOC, FILE_DOC, INLINE, PARAMETERS, PARAMETERS_DOC, SAMPLES_DOC,
    put_file,
};
use super::wheel::{self, WHEEL};
use grouser_core::contact::Model;
use grouser_core::simulation::Scenario;
use grouser_core::soil::Soil;
use grouser_core::wheel::Wheel;

/// The most runs, or points. Source: ours; a thousand times what a machine computes in a day.
const MOST_RUNS: u64 = 1_000_000_000_000;
/// Seconds of work for a traverse, a fraction of one for a heading offset; some hundred kilobytes.
const SHARD_RUNS: u64 = 1024;

pub(crate) static CAMPAIGN: Table<Settings> = Table {
    doc: "Many runs of one study, over numbers that are not known exactly.",
    fields: &[
        schema("campaign/1"),
        purpose(),
        note("source", "Where the distributions come from.").optional(),
        notes(),
        assumed(),
        words(
            "study",
            "What every run computes.",
            &[
                word(Study::Traverse.name(), "A run of the scenario, and where it ends.", |all| {
                    all.study = Study::Traverse;
                }),
                word(
                    Study::Heading.name(),
                    "The heading offset that holds the contour of the scenario's slope.",
                    |all: &mut Settings| all.study = Study::Heading,
                ),
                word(
                    Study::Mission.name(),
                    "A mission, and what became of each of its legs.",
                    |all| {
                        all.study = Study::Mission;
                    },
                ),
                word(Study::WheelTest.name(), "A wheel on a test stand.", |all| {
                    all.study = Study::WheelTest;
                }),
            ],
        ),
        whole(
            "runs",
            1..=MOST_RUNS,
            "uint64",
            "How many runs; with `sensitivity`, how many points, each with two runs more than \
             there are inputs.",
            |all, runs| all.runs = runs,
        ),
        whole(
            "seed",
            0..=LARGEST_SEED,
            "uint64",
            "Seed of the random numbers: the same seed, the same samples.",
            |all: &mut Settings, seed| {
                all.seed = seed;
            },
        )
        .otherwise(Fill::Whole(1)),
        whole(
            "shard_runs",
            1..=1_000_000,
            "uint64",
            "Runs that are computed and written together.",
            |all: &mut Settings, runs| all.shard_runs = runs,
        )
        .otherwise(Fill::Whole(SHARD_RUNS)),
        words(
            "sampling",
            "How the samples are spread.",
            &[
                word("monte-carlo", "Independent samples.", |all: &mut Settings| {
                    all.sampling = Sampling::MonteCarlo;
                }),
                word(
                    "latin-hypercube",
                    "One sample in each of as many equal parts of every input's distribution as \
                     there are runs.",
                    |all: &mut Settings| all.sampling = Sampling::LatinHypercube,
                ),
                word("sobol", "The Sobol sequence, scrambled.", |all: &mut Settings| {
                    all.sampling = Sampling::Sobol;
                }),
            ],
        )
        .otherwise(Fill::Keyword("monte-carlo")),
        flag("sensitivity", "Whether the runs are a design for Sobol indices.", |all, yes| {
            all.sensitivity = yes;
        }),
        flag(
            "soil_uncertainty",
            "Whether the soil's own `uncertainty` is sampled, too.",
            |all, yes| all.soil_uncertainty = yes,
        ),
        // Not filled in: a study's hash is of its resolved document.
        field(
            "model_uncertainty",
            "Whether the wheel-soil model of each run is drawn, too, by the weights of the models; \
             not where the base names its model.",
            Shape::Flag(|all: &mut Settings, yes| all.model_uncertainty = yes),
        )
        .optional(),
        part(
            "scenario",
            Kind::Scenario,
            "The run that is varied, for `traverse` and `heading`: a preset's name, a path from \
             this document's folder, or a scenario's keys.",
            &At {
                inner: &SCENARIO,
                at: |all: &mut Settings| -> &mut Scenario {
                    all.scenario.get_or_insert_with(|| Box::new(scenario::blank()))
                },
            },
        )
        .optional(),
        part(
            "mission",
            Kind::Mission,
            "The mission that is varied, for `mission`, without alternatives: a preset's name, a \
             path from this document's folder, or a mission's keys.",
            &At {
                inner: &MISSION,
                at: |all: &mut Settings| -> &mut Plan {
                    all.mission.get_or_insert_with(|| Box::new(mission::blank()))
                },
            },
        )
        .optional(),
        table(
            "wheel_test",
            "The stand that is varied, for `wheel-test`.",
            &At {
                inner: &STAND,
                at: |all: &mut Settings| -> &mut Stand { all.stand.get_or_insert(BLANK_STAND) },
            },
        )
        .optional(),
        field(
            "samples",
            SAMPLES_DOC,
            Shape::TextOr(
                FILE_DOC,
                |all, name| put_file(&mut all.uncertain, name),
                &At { inner: &INLINE, at: uncertain },
            ),
        )
        .optional(),
        list("parameter", PARAMETERS_DOC, &At { inner: &PARAMETERS, at: uncertain }, 0).optional(),
        list("correlation", CORRELATIONS_DOC, &At { inner: &CORRELATIONS, at: uncertain }, 0)
            .optional(),
    ],
};

/// A stand before its numbers are put in.
pub(crate) const BLANK_STAND: Stand = Stand {
    soil: soil::BLANK,
    wheel: wheel::BLANK,
    model: Model::Ishigami,
    gravity: 0.0,
    load: 0.0,
    slip_ratio: 0.0,
    slip_angle: 0.0,
};

pub(crate) static STAND: Table<Stand> = Table {
    doc: "A wheel on a test stand.",
    fields: &[
        part(
            "soil",
            Kind::Soil,
            "The soil: a preset's name, a path from this document's folder, or a soil's keys.",
            &At { inner: &SOIL, at: |stand: &mut Stand| -> &mut Soil { &mut stand.soil } },
        ),
        part(
            "wheel",
            Kind::Wheel,
            "The wheel: a preset's name, a path from this document's folder, or a wheel's keys.",
            &At { inner: &WHEEL, at: |stand: &mut Stand| -> &mut Wheel { &mut stand.wheel } },
        ),
        model("The wheel–soil model; without it the soil's own, or else `ishigami`."),
        gravity("Gravity, g", |stand| Some(&mut stand.gravity)),
        number("load_n", N, 0.0..=1e5, "Load on the wheel, W", |stand| Some(&mut stand.load)),
        number("slip_ratio", ONE, -2.0..=2.0, "Slip ratio, s", |stand| Some(&mut stand.slip_ratio)),
        number(
            "slip_angle_deg",
            DEG,
            -90.0..=90.0,
            "Slip angle, β; above 0 where the hub moves to the left",
            |stand: &mut Stand| Some(&mut stand.slip_angle),
        )
        .or(0.0),
    ],
};

fn uncertain(all: &mut Settings) -> &mut Stated {
    &mut all.uncertain
}
