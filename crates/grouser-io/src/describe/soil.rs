//! `soil/1`: a soil with the units of soil laboratories.

use super::super::field::{
    At, Beside, DEG, Field, Fill, KG_M3, KPA, Law, Laws, M, M_PER_RAD, M_PER_RAD2, ONE, Table,
    Unit, number, table, word, words,
};
use super::uncertainty::UNCERTAINTY;
use super::{assumed, date, model, name, notes, schema, source};
use grouser_core::soil::small_wheel::{ExitShift, Mounds, SideWall, SinkageGrowth};
use grouser_core::soil::{
    Bulldozing, Exit, PressureSinkage, Rft, Shear, ShearModulus, SinkageExponent, SmallWheel, Soil,
    StressPeak,
};

/// The largest exit-angle ratio that a soil may reach at any slip [-].
pub const LARGEST_EXIT_RATIO: f64 = 1.5;
/// The smallest and the largest sinkage exponent that a soil may reach at any slip [-].
pub const SMALLEST_EXPONENT: f64 = 0.3;
pub const LARGEST_EXPONENT: f64 = 3.0;
/// The smallest and the largest shear deformation modulus at zero slip angle [m].
const SMALLEST_MODULUS: f64 = 1e-4;
const LARGEST_MODULUS: f64 = 1.0;

const NO_EXPONENT: SinkageExponent = SinkageExponent { at_zero: 0.0, per_slip: 0.0, per_skid: 0.0 };
const REECE: PressureSinkage =
    PressureSinkage::Reece { k_c: 0.0, k_phi: 0.0, exponent: NO_EXPONENT };
const BEKKER: PressureSinkage =
    PressureSinkage::Bekker { k_c: 0.0, k_phi: 0.0, exponent: NO_EXPONENT };
const LINEAR: ShearModulus = ShearModulus::Linear { at_zero: 0.0, per_radian: 0.0 };
const QUADRATIC: ShearModulus = ShearModulus::Quadratic {
    at_zero: 0.0,
    per_radian: 0.0,
    per_radian_squared: 0.0,
    angle_limit: 0.0,
};

/// A soil before its numbers are put in: without the terms of the theories that have some of their own.
pub const BLANK: Soil = Soil {
    cohesion: 0.0,
    friction_angle: 0.0,
    density: 0.0,
    pressure_sinkage: REECE,
    stress_peak: StressPeak { a0: 0.0, a1: 0.0 },
    shear: Shear::Isotropic { modulus: LINEAR },
    exit: Exit::Ratio(0.0),
    bulldozing: Bulldozing::None,
    small_wheel: SmallWheel::OFF,
    rft: Rft::PUBLISHED,
};

pub static SOIL: Table<Soil> = Table {
    doc: "A homogeneous soil: how it carries, how it shears, how it is pushed aside.",
    fields: &[
        schema("soil/1"),
        name(),
        source(),
        date(),
        notes(),
        assumed(),
        model("The theory that the values were made for; without it, `ishigami`."),
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
        .otherwise(Fill::Keys(&[("law", Fill::Word("sine"))])),
        table(
            "small_wheel",
            "Terms of the model `small-wheel`, for one wheel on this soil; all off without it.",
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

// ---- How pressure grows with sinkage ----

static PRESSURE_SINKAGE: Laws<PressureSinkage> = Laws {
    doc: "Pressure over sinkage, σ = K_σ zⁿ.",
    key: "law",
    may_be_left_out: false,
    is_written_last: false,
    all: &[
        Law {
            name: "reece",
            word: None,
            choose: |law| *law = REECE,
            table: Table {
                doc: "K_σ = (c k_c + γ b k_phi) / bⁿ (Reece 1965).",
                fields: &[
                    number("k_c", ONE, 0.0..=1e4, "Cohesive modulus, k'_c", |law| match law {
                        PressureSinkage::Reece { k_c, .. } => Some(k_c),
                        PressureSinkage::Bekker { .. } => None,
                    }),
                    number("k_phi", ONE, 0.0..=1e5, "Frictional modulus, k'_φ", |law| match law {
                        PressureSinkage::Reece { k_phi, .. } => Some(k_phi),
                        PressureSinkage::Bekker { .. } => None,
                    }),
                    EXPONENT,
                    EXPONENT_PER_SLIP,
                    EXPONENT_PER_SKID,
                ],
            },
        },
        Law {
            name: "bekker",
            word: None,
            choose: |law| *law = BEKKER,
            table: Table {
                doc: "K_σ = k_c/b + k_phi (Bekker 1960).",
                fields: &[
                    number(
                        "k_c",
                        Unit::si("N/m^(n+1)"),
                        0.0..=1e9,
                        "Cohesive modulus, k_c",
                        |law| match law {
                            PressureSinkage::Bekker { k_c, .. } => Some(k_c),
                            PressureSinkage::Reece { .. } => None,
                        },
                    ),
                    number(
                        "k_phi",
                        Unit::si("N/m^(n+2)"),
                        0.0..=1e12,
                        "Frictional modulus, k_φ",
                        |law| match law {
                            PressureSinkage::Bekker { k_phi, .. } => Some(k_phi),
                            PressureSinkage::Reece { .. } => None,
                        },
                    ),
                    EXPONENT,
                    EXPONENT_PER_SLIP,
                    EXPONENT_PER_SKID,
                ],
            },
        },
    ],
};

const EXPONENT: Field<PressureSinkage> = number(
    "n",
    ONE,
    SMALLEST_EXPONENT..=LARGEST_EXPONENT,
    "Sinkage exponent at zero slip, n",
    |law| Some(&mut exponent(law).at_zero),
);
const EXPONENT_PER_SLIP: Field<PressureSinkage> = number(
    "n_per_slip",
    ONE,
    -3.0..=3.0,
    "Growth of n with the slip ratio while driving",
    |law: &mut PressureSinkage| Some(&mut exponent(law).per_slip),
)
.or(0.0);
const EXPONENT_PER_SKID: Field<PressureSinkage> = number(
    "n_per_skid",
    ONE,
    -3.0..=3.0,
    "Growth of n with the size of the slip ratio while skidding",
    |law: &mut PressureSinkage| Some(&mut exponent(law).per_skid),
)
.or(0.0);

fn exponent(law: &mut PressureSinkage) -> &mut SinkageExponent {
    let (PressureSinkage::Reece { exponent, .. } | PressureSinkage::Bekker { exponent, .. }) = law;
    exponent
}

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

// ---- How shear stress is mobilised ----

static SHEAR: Laws<Shear> = Laws {
    doc: "Shear stress over shear displacement (Janosi and Hanamoto 1961).",
    key: "law",
    may_be_left_out: false,
    is_written_last: false,
    all: &[
        Law {
            name: "anisotropic",
            word: None,
            choose: |law| *law = Shear::Anisotropic { longitudinal: LINEAR, lateral: LINEAR },
            table: Table {
                doc: "Each axis on its own, with moduli linear in the slip angle (Ishigami et al. 2007).",
                fields: &[LONGITUDINAL, LONGITUDINAL_GROWTH, LATERAL, LATERAL_GROWTH],
            },
        },
        Law {
            name: "anisotropic-quadratic",
            word: None,
            choose: |law| *law = Shear::Anisotropic { longitudinal: QUADRATIC, lateral: QUADRATIC },
            table: Table {
                doc: "Each axis on its own, with moduli quadratic in the slip angle (the laboratory's, 2007).",
                fields: &[
                    LONGITUDINAL,
                    LONGITUDINAL_GROWTH,
                    number(
                        "longitudinal_per_rad2_m",
                        M_PER_RAD2,
                        -1.0..=1.0,
                        SQUARE,
                        |law: &mut Shear| per_radian_squared(longitudinal(law)),
                    )
                    .or(0.0),
                    LATERAL,
                    LATERAL_GROWTH,
                    number(
                        "lateral_per_rad2_m",
                        M_PER_RAD2,
                        -1.0..=1.0,
                        SQUARE,
                        |law: &mut Shear| per_radian_squared(lateral(law)?),
                    )
                    .or(0.0),
                    // Of both axes: `soil::settled` takes it over for the lateral one.
                    number(
                        "slip_angle_limit_deg",
                        DEG,
                        0.0..=90.0,
                        "The largest slip angle that the fits know; beyond it they stay",
                        |law: &mut Shear| match longitudinal(law) {
                            ShearModulus::Quadratic { angle_limit, .. } => Some(angle_limit),
                            ShearModulus::Linear { .. } => None,
                        },
                    )
                    .or(90.0),
                ],
            },
        },
        Law {
            name: "isotropic",
            word: None,
            choose: |law| *law = Shear::Isotropic { modulus: LINEAR },
            table: Table {
                doc: "One stress, against the slip velocity; never above c + σ tan φ.",
                fields: &[
                    Field { doc: "Modulus at zero slip angle, K", ..LONGITUDINAL },
                    LONGITUDINAL_GROWTH,
                ],
            },
        },
    ],
};

const LONGITUDINAL: Field<Shear> = number(
    "longitudinal_m",
    M,
    SMALLEST_MODULUS..=LARGEST_MODULUS,
    "Modulus along the wheel at zero slip angle, K_x",
    |law| Some(at_zero(longitudinal(law))),
);
const LONGITUDINAL_GROWTH: Field<Shear> =
    number("longitudinal_per_rad_m", M_PER_RAD, -1.0..=1.0, GROWTH, |law: &mut Shear| {
        Some(per_radian(longitudinal(law)))
    })
    .or(0.0);
const LATERAL: Field<Shear> = number(
    "lateral_m",
    M,
    SMALLEST_MODULUS..=LARGEST_MODULUS,
    "Modulus across the wheel at zero slip angle, K_y",
    |law| Some(at_zero(lateral(law)?)),
);
const LATERAL_GROWTH: Field<Shear> =
    number("lateral_per_rad_m", M_PER_RAD, -1.0..=1.0, GROWTH, |law: &mut Shear| {
        Some(per_radian(lateral(law)?))
    })
    .or(0.0);
const GROWTH: &str = "Its growth with the slip angle";
const SQUARE: &str = "Its growth with the square of the slip angle";

fn longitudinal(law: &mut Shear) -> &mut ShearModulus {
    let (Shear::Anisotropic { longitudinal: modulus, .. } | Shear::Isotropic { modulus }) = law;
    modulus
}

fn lateral(law: &mut Shear) -> Option<&mut ShearModulus> {
    match law {
        Shear::Anisotropic { lateral, .. } => Some(lateral),
        Shear::Isotropic { .. } => None,
    }
}

fn at_zero(modulus: &mut ShearModulus) -> &mut f64 {
    let (ShearModulus::Linear { at_zero, .. } | ShearModulus::Quadratic { at_zero, .. }) = modulus;
    at_zero
}

fn per_radian(modulus: &mut ShearModulus) -> &mut f64 {
    let (ShearModulus::Linear { per_radian, .. } | ShearModulus::Quadratic { per_radian, .. }) =
        modulus;
    per_radian
}

fn per_radian_squared(modulus: &mut ShearModulus) -> Option<&mut f64> {
    match modulus {
        ShearModulus::Quadratic { per_radian_squared, .. } => Some(per_radian_squared),
        ShearModulus::Linear { .. } => None,
    }
}

// ---- Where the wheel leaves the soil, and what it pushes aside ----

static EXIT: Laws<Exit> = Laws {
    doc: "Exit-angle ratio λ: the share of the sinkage that the soil recovers behind the wheel.",
    key: "law",
    may_be_left_out: true,
    is_written_last: false,
    all: &[
        Law {
            name: "ratio",
            word: Some("The same for every slip."),
            choose: |law| *law = Exit::Ratio(0.0),
            table: Table {
                doc: "The same for every slip.",
                fields: &[number(
                    "ratio",
                    ONE,
                    0.0..=LARGEST_EXIT_RATIO,
                    "Exit-angle ratio, λ",
                    |law| match law {
                        Exit::Ratio(ratio) => Some(ratio),
                        Exit::QuadraticInSlip { .. } => None,
                    },
                )],
            },
        },
        Law {
            name: "quadratic-in-slip",
            word: Some("Quadratic in the slip ratio."),
            choose: |law| {
                *law = Exit::QuadraticInSlip { at_zero: 0.0, per_slip: 0.0, per_slip_squared: 0.0 };
            },
            table: Table {
                doc: "λ = at_zero + per_slip s + per_slip2 s², skid counting as s = 0, λ never below 0.",
                fields: &[
                    number("at_zero", ONE, 0.0..=LARGEST_EXIT_RATIO, "λ at zero slip", |law| {
                        match law {
                            Exit::QuadraticInSlip { at_zero, .. } => Some(at_zero),
                            Exit::Ratio(_) => None,
                        }
                    }),
                    number(
                        "per_slip",
                        ONE,
                        -10.0..=10.0,
                        "Its growth with the slip ratio",
                        |law| match law {
                            Exit::QuadraticInSlip { per_slip, .. } => Some(per_slip),
                            Exit::Ratio(_) => None,
                        },
                    ),
                    number(
                        "per_slip2",
                        ONE,
                        -10.0..=10.0,
                        "Its growth with the square of the slip ratio",
                        |law| match law {
                            Exit::QuadraticInSlip { per_slip_squared, .. } => {
                                Some(per_slip_squared)
                            }
                            Exit::Ratio(_) => None,
                        },
                    ),
                ],
            },
        },
    ],
};

static BULLDOZING: Table<Bulldozing> = Table {
    doc: "How soil pushed aside loads the flank.",
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

// ---- What single theories ask for ----

const DEFAULTS: Fill = Fill::Keys(&[]);
const OFF: SmallWheel = SmallWheel::OFF;

static SMALL_WHEEL: Table<SmallWheel> = Table {
    doc: "What a small wheel's soil does beyond the classical law. Each key is off by default.",
    fields: &[
        table(
            "sinkage",
            "How a moving wheel sinks deeper than a plate.",
            &At { inner: &SINKAGE_GROWTH, at: |terms: &mut SmallWheel| &mut terms.sinkage },
        )
        .otherwise(DEFAULTS),
        table(
            "exit",
            "How the exit moves with the motion.",
            &At { inner: &EXIT_SHIFT, at: |terms: &mut SmallWheel| &mut terms.exit },
        )
        .otherwise(DEFAULTS),
        table("interface", "Friction between wheel and soil.", &INTERFACE)
            .otherwise(DEFAULTS)
            .formerly("rim"),
        table(
            "side_wall",
            "The soil's load on the side wall of the wheel.",
            &At { inner: &SIDE_WALL, at: |terms: &mut SmallWheel| &mut terms.side_wall },
        )
        .otherwise(DEFAULTS)
        .formerly("flank"),
        table(
            "mounds",
            "Soil pushed by the width of the rim.",
            &At { inner: &MOUNDS, at: |terms: &mut SmallWheel| &mut terms.mounds },
        )
        .otherwise(DEFAULTS)
        .formerly("heap"),
    ],
};

static SINKAGE_GROWTH: Table<SinkageGrowth> = Table {
    doc: "Sinkage growth ζ: the moving wheel meets at depth z what a plate meets at z/ζ.",
    fields: &[
        number(
            "with_slip_angle",
            ONE,
            0.0..=10.0,
            "Growth per sin β/(cos β + 0.3)",
            |growth: &mut SinkageGrowth| Some(&mut growth.with_slip_angle),
        )
        .or(OFF.sinkage.with_slip_angle),
        number(
            "with_slip",
            ONE,
            0.0..=20.0,
            "Growth with the slip by total speed, S/(1 − bend S)",
            |growth: &mut SinkageGrowth| Some(&mut growth.with_slip),
        )
        .or(OFF.sinkage.with_slip),
        number(
            "bend",
            ONE,
            -10.0..=0.95,
            "How that growth bends: above 0 it speeds up with slip, below 0 it slows down",
            |growth: &mut SinkageGrowth| Some(&mut growth.bend),
        )
        .or(OFF.sinkage.bend),
        number(
            "locked",
            ONE,
            0.0..=20.0,
            "Growth of a locked wheel",
            |growth: &mut SinkageGrowth| Some(&mut growth.locked),
        )
        .or(OFF.sinkage.locked),
        number(
            "sharpness",
            ONE,
            1.0..=20.0,
            "How much the larger of two growths hides the smaller; at 1 they add up",
            |growth: &mut SinkageGrowth| Some(&mut growth.sharpness),
        )
        .or(OFF.sinkage.sharpness),
    ],
};

static EXIT_SHIFT: Table<ExitShift> = Table {
    doc: "What is added to the exit-angle ratio λ; it stays within 0 and 1.",
    fields: &[
        number(
            "with_slip",
            ONE,
            -2.0..=2.0,
            "Growth with the slip by total speed, while driving",
            |shift: &mut ExitShift| Some(&mut shift.with_slip),
        )
        .or(OFF.exit.with_slip),
        number(
            "with_slip_angle",
            ONE,
            -2.0..=2.0,
            "Growth with |sin β|",
            |shift: &mut ExitShift| Some(&mut shift.with_slip_angle),
        )
        .or(OFF.exit.with_slip_angle),
    ],
};

static INTERFACE: Table<SmallWheel> = Table {
    doc: "Friction between wheel and soil.",
    fields: &[number(
        "friction_angle_deg",
        DEG,
        1.0..=60.0,
        "Friction angle of the wheel-soil interface, δ, where below the soil's own",
        |terms: &mut SmallWheel| Some(terms.interface_friction_angle.get_or_insert(0.0)),
    )
    .optional()],
};

static SIDE_WALL: Table<SideWall> = Table {
    doc: "The soil's load on the side wall of the wheel.",
    fields: &[
        number(
            "pressure_factor",
            ONE,
            0.0..=20.0,
            "Factor on the passive pressure, for the bow wave at the wall and for its ends",
            |wall: &mut SideWall| Some(&mut wall.pressure_factor),
        )
        .or(OFF.side_wall.pressure_factor),
        number(
            "fading",
            ONE,
            0.0..=10.0,
            "How fast the load fades with slip or skid: e^(−fading |S|)",
            |wall: &mut SideWall| Some(&mut wall.fading),
        )
        .or(OFF.side_wall.fading),
        number(
            "friction",
            ONE,
            0.0..=1.0,
            "Coefficient of friction of the side face, μ_f",
            |wall: &mut SideWall| Some(&mut wall.friction),
        )
        .or(OFF.side_wall.friction),
    ],
};

static MOUNDS: Table<Mounds> = Table {
    doc: "Soil pushed by the width of the rim, as factors on b R_b(h).",
    fields: &[
        number(
            "bow_wave",
            ONE,
            0.0..=20.0,
            "In front of a wheel that skids",
            |mounds: &mut Mounds| Some(&mut mounds.bow_wave),
        )
        .or(OFF.mounds.bow_wave)
        .formerly("front"),
        number(
            "rear_mound",
            ONE,
            0.0..=20.0,
            "Behind a wheel that spins",
            |mounds: &mut Mounds| Some(&mut mounds.rear_mound),
        )
        .or(OFF.mounds.rear_mound)
        .formerly("behind"),
    ],
};

static RFT: Table<Rft> = Table {
    doc: "What resistive force theory asks of a soil beside its density and friction angle.",
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
