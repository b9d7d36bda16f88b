//! `soil/1`: a soil with the units of soil laboratories.

mod exit;
mod pressure_sinkage;
mod shear;
mod small_wheel;

use super::super::field::{
    At, Beside, DEG, Fill, KG_M3, KPA, ONE, Table, number, table, word, words,
};
use super::about::{assumed, date, model, name, notes, schema, source};
use super::uncertainty::UNCERTAINTY;
use exit::EXIT;
use grouser_core::soil::{Bulldozing, Exit, Rft, Shear, SmallWheel, Soil, StressPeak};
use pressure_sinkage::{PRESSURE_SINKAGE, REECE};
use shear::{LINEAR, SHEAR};
use small_wheel::SMALL_WHEEL;

pub(crate) use exit::LARGEST_EXIT_RATIO;
pub(crate) use pressure_sinkage::{LARGEST_EXPONENT, SMALLEST_EXPONENT};

/// A soil before its numbers are put in: the terms of single models have their general values.
pub(crate) const BLANK: Soil = Soil {
    cohesion: 0.0,
    friction_angle: 0.0,
    density: 0.0,
    pressure_sinkage: REECE,
    stress_peak: StressPeak { a0: 0.0, a1: 0.0 },
    shear: Shear::Isotropic { modulus: LINEAR },
    exit: Exit::Ratio(0.0),
    bulldozing: Bulldozing::None,
    small_wheel: SmallWheel::GENERAL,
    rft: Rft::PUBLISHED,
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
        model("The wheel–soil model that the values were made for; without it, `ishigami`."),
        number("cohesion_kpa", KPA, 0.0..=100.0, "Cohesion, c", |soil| Some(&mut soil.cohesion)),
        number("friction_angle_deg", DEG, 5.0..=60.0, "Angle of internal friction, φ", |soil| {
            Some(&mut soil.friction_angle)
        }),
        number("density_kg_m3", KG_M3, 200.0..=4000.0, "Bulk density, ρ", |soil| {
            Some(&mut soil.density)
        }),
        table(
            "pressure_sinkage",
            "How pressure grows with sinkage.",
            &At { inner: &PRESSURE_SINKAGE, at: |soil: &mut Soil| &mut soil.pressure_sinkage },
        ),
        table(
            "stress_peak",
            "Where along the arc the normal stress peaks.",
            &At { inner: &STRESS_PEAK, at: |soil: &mut Soil| &mut soil.stress_peak },
        ),
        table(
            "shear",
            "How shear stress is mobilised.",
            &At { inner: &SHEAR, at: |soil: &mut Soil| &mut soil.shear },
        ),
        table(
            "exit",
            "Where the wheel leaves the soil; without it, ratio = 1.0.",
            &At { inner: &EXIT, at: |soil: &mut Soil| &mut soil.exit },
        )
        .otherwise(Fill::Keys(&[("ratio", Fill::Number(1.0))])),
        table(
            "bulldozing",
            "How soil pushed aside loads the side wall; without it, law = \"sine\".",
            &At { inner: &BULLDOZING, at: |soil: &mut Soil| &mut soil.bulldozing },
        )
        .otherwise(Fill::Keys(&[("law", Fill::Keyword("sine"))])),
        table(
            "small_wheel",
            "Terms of the model `small-wheel`, for one wheel on this soil; general values without it.",
            &At { inner: &SMALL_WHEEL, at: |soil: &mut Soil| &mut soil.small_wheel },
        )
        .optional()
        .formerly("extended"),
        table(
            "rft",
            "Constants of the model `rft`, resistive force theory; as published without it.",
            &At { inner: &RFT, at: |soil: &mut Soil| &mut soil.rft },
        )
        .optional(),
        table(
            "uncertainty",
            "How well the numbers above are known; exactly, as far as anyone says, without it.",
            &Beside(&UNCERTAINTY),
        )
        .optional(),
    ],
};

static STRESS_PEAK: Table<StressPeak> = Table {
    doc: "θ_m = (a0 + a1 |s|) θ_f.",
    fields: &[
        number("a0", ONE, 0.0..=1.0, "Share of the entry angle at zero slip, a₀", |peak| {
            Some(&mut peak.a0)
        }),
        number("a1", ONE, 0.0..=1.0, "Its growth with the slip ratio, a₁", |peak| {
            Some(&mut peak.a1)
        }),
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
                "In proportion to sin² β, with its part along the wheel and the surcharge of piled soil.",
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
