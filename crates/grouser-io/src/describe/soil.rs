//! `soil/1`: a soil with the units of soil laboratories.

mod discrepancy;
mod domain;
mod exit;
mod pressure_sinkage;
mod shear;
mod small_wheel;

use super::super::field::{
    At, Beside, DEG, KG_M3, KPA, Keyword, ONE, Table, nothing, number, part, table, texts, word,
    words,
};
use super::super::kind::Kind;
use super::about::{assumed, date, model, name, notes, schema, source};
use super::prior::PRIORS;
use super::uncertainty::UNCERTAINTY;
use discrepancy::DISCREPANCY;
use domain::DOMAIN;
use exit::EXIT;
use grouser_core::soil::{
    Bulldozing, Discrepancy, Domain, Exit, Rft, Shear, ShearBound, SmallWheel, Soil, StressPeak,
};
use pressure_sinkage::{PRESSURE_SINKAGE, REECE};
use shear::{LINEAR, SHEAR};
use small_wheel::SMALL_WHEEL;

pub(crate) use exit::LARGEST_EXIT_RATIO;
pub(crate) use pressure_sinkage::{LARGEST_EXPONENT, SMALLEST_EXPONENT};

/// A soil before its numbers are put in: the terms of single models have their general values.
pub(crate) const BLANK: Soil = Soil {
    cohesion: 0.0,
    friction_angle: 0.0,
    constant_volume_share: 0.0,
    density: 0.0,
    pressure_sinkage: REECE,
    stress_peak: StressPeak { a0: 0.0, a1: 0.0 },
    shear: Shear::Isotropic { modulus: LINEAR },
    shear_bound: ShearBound::None,
    exit: Exit::Ratio(0.0),
    bulldozing: Bulldozing::None,
    small_wheel: SmallWheel::GENERAL,
    rft: Rft::PUBLISHED,
    domain: Domain::UNSTATED,
    discrepancy: None,
};

pub(crate) static SOIL: Table<Soil> = Table {
    doc: "A homogeneous soil: how it carries, how it shears, how it is pushed aside.",
    fields: &[
        schema("soil/1"),
        name(),
        source(),
        date(),
        notes(),
        assumed(),
        texts(
            "contradictions",
            "What contradicts itself in how a soil was learnt, a sentence each: no operator's card is \
             made of such a soil unless that is accepted.",
        ),
        model("The wheel–soil model that the values were made for; without it, `ishigami`."),
        words(
            "consistency",
            "Whether the soil is loose or firm, for priors; without it, loose.",
            &[
                word("loose", "Sand, regolith, simulant as a wheel sinks into it.", nothing),
                word("firm", "Clay, loam, tamped ground.", nothing),
            ],
        )
        .optional(),
        table(
            "known_from",
            "Where the constants are from, for priors: how widely bands draw about them.",
            &KNOWN_FROM,
        )
        .optional(),
        number("cohesion_kpa", KPA, 0.0..=100.0, "Cohesion, c", |soil: &mut Soil| {
            Some(&mut soil.cohesion)
        })
        .or_prior(),
        number("friction_angle_deg", DEG, 5.0..=60.0, "Angle of internal friction, φ", |soil| {
            Some(&mut soil.friction_angle)
        }),
        words(
            "friction_test",
            "The kind of test that the friction angle is from, which tells what of it a wheel \
             mobilises; without it, not printed.",
            &[
                word("triaxial", "The peak of triaxial tests.", at_constant_volume),
                word("plane-strain", "The peak of tests in plane strain.", at_constant_volume),
                word(
                    "direct-shear",
                    "A shear box, or an annular shear test of a \
                                      bevameter.",
                    at_peak,
                ),
                word("repose", "The angle of repose.", at_peak),
            ],
        )
        .optional(),
        number(
            "constant_volume_share",
            ONE,
            0.0..=1.0,
            "How far friction under a wheel has gone from tan φ, 0, to sin φ of soil that shears \
             on at constant volume, 1; without it, as the kind of test says, or else the priors",
            |soil: &mut Soil| Some(&mut soil.constant_volume_share),
        )
        .optional(),
        number("density_kg_m3", KG_M3, 200.0..=4000.0, "Bulk density, ρ", |soil: &mut Soil| {
            Some(&mut soil.density)
        })
        .or_prior(),
        table(
            "pressure_sinkage",
            "How pressure grows with sinkage.",
            &At { inner: &PRESSURE_SINKAGE, at: |soil: &mut Soil| &mut soil.pressure_sinkage },
        ),
        table(
            "stress_peak",
            "Where along the arc the normal stress peaks.",
            &At { inner: &STRESS_PEAK, at: |soil: &mut Soil| &mut soil.stress_peak },
        )
        .or_prior(),
        table("shear", "How shear stress is mobilised.", &SHEAR),
        table(
            "exit",
            "Where the wheel leaves the soil.",
            &At { inner: &EXIT, at: |soil: &mut Soil| &mut soil.exit },
        )
        .or_prior(),
        table(
            "bulldozing",
            "How soil pushed aside loads the side wall.",
            &At { inner: &BULLDOZING, at: |soil: &mut Soil| &mut soil.bulldozing },
        )
        .or_prior(),
        table(
            "small_wheel",
            "Terms of the model `small-wheel`, for one wheel on this soil; general values without \
             it.",
            &At { inner: &SMALL_WHEEL, at: |soil: &mut Soil| &mut soil.small_wheel },
        )
        .optional(),
        table(
            "rft",
            "Constants of the model `rft`, resistive force theory; as published without it.",
            &At { inner: &RFT, at: |soil: &mut Soil| &mut soil.rft },
        )
        .optional(),
        table(
            "domain",
            "The ranges within which the constants were measured or fitted; not stated without it.",
            &At { inner: &DOMAIN, at: |soil: &mut Soil| &mut soil.domain },
        )
        .optional(),
        table(
            "discrepancy",
            "What the model gets wrong under one wheel, from a calibration; nothing without it.",
            &At {
                inner: &DISCREPANCY,
                at: |soil: &mut Soil| soil.discrepancy.get_or_insert(Discrepancy::NONE),
            },
        )
        .optional(),
        table(
            "uncertainty",
            "How well the numbers above are known; without it, as well as the priors say.",
            &Beside(&UNCERTAINTY),
        )
        .optional(),
        part(
            "priors",
            Kind::Prior,
            "What is believed of the numbers that are not stated above; without it, `general`. In \
             a resolved document, the rows that hold for this soil: a number that they call \
             missing is the prior's, not the source's.",
            &Beside(&PRIORS),
        )
        .optional(),
    ],
};

static KNOWN_FROM: Table<Soil> = Table {
    doc: "Where a soil's constants are from.",
    fields: &[
        words("strength", "Cohesion and friction angle; without it, this soil.", &ORIGINS)
            .optional(),
        words("pressure_sinkage", "Moduli and exponent of sinkage; likewise.", &ORIGINS).optional(),
        words("shear", "Shear moduli; likewise.", &ORIGINS).optional(),
    ],
};

static ORIGINS: [Keyword<Soil>; 3] = [
    word("this-bed", "Measured on the bed that is driven on, as it was prepared.", nothing),
    word("this-soil", "Measured on this soil, elsewhere or prepared otherwise.", nothing),
    word("copied", "Taken from a table for a soil of this name, or of its kind.", nothing),
];

/// A peak of φ in the soil's mass: a surface of slip under a wheel has sin φ.
fn at_constant_volume(soil: &mut Soil) {
    soil.constant_volume_share = 1.0;
}

/// Measured on a surface of slip: under a wheel too it is tan φ.
fn at_peak(soil: &mut Soil) {
    soil.constant_volume_share = 0.0;
}

static STRESS_PEAK: Table<StressPeak> = Table {
    doc: "θ_m = (a0 + a1 |s|) θ_f.",
    fields: &[
        number(
            "a0",
            ONE,
            0.0..=1.0,
            "Share of the entry angle at zero slip, a₀",
            |peak: &mut StressPeak| Some(&mut peak.a0),
        )
        .or_prior(),
        number(
            "a1",
            ONE,
            0.0..=1.0,
            "Its growth with the slip ratio, a₁",
            |peak: &mut StressPeak| Some(&mut peak.a1),
        )
        .or_prior(),
    ],
};

static BULLDOZING: Table<Bulldozing> = Table {
    doc: "How soil pushed aside loads the side wall.",
    fields: &[words(
        "law",
        "How that force depends on the slip angle.",
        &[
            word("none", "No such force.", |law| *law = Bulldozing::None),
            word("sign", "Full force whatever the size of β; it jumps at β = 0.", |law| {
                *law = Bulldozing::Sign;
            }),
            word("sine", "In proportion to sin β.", |law| *law = Bulldozing::Sine),
            word(
                "sine-squared",
                "In proportion to sin² β, with its part along the wheel and the surcharge of piled \
                 soil.",
                |law| *law = Bulldozing::SineSquared,
            ),
        ],
    )],
};

static RFT: Table<Rft> = Table {
    doc: "Parameters of resistive force theory beside density and friction angle.",
    fields: &[
        number(
            "scale",
            ONE,
            0.01..=100.0,
            "Factor on the stiffness that follows from density and friction angle",
            |rft: &mut Rft| Some(&mut rft.scale),
        )
        .or(Rft::PUBLISHED.scale),
        number(
            "surface_friction_angle_deg",
            DEG,
            1.0..=60.0,
            "Friction angle between the wheel and the soil, δ []; without it the soil's own",
            |rft: &mut Rft| Some(rft.surface_friction_angle.get_or_insert(0.0)),
        )
        .optional(),
    ],
};
