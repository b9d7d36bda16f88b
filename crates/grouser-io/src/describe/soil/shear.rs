//! How shear stress is mobilised.

use super::super::super::field::{
    DEG, Field, Fill, Law, Laws, M, M_PER_RAD, M_PER_RAD2, Table, number, word, words,
};
use grouser_core::soil::{Shear, ShearBound, ShearModulus, Soil};

/// The smallest and the largest shear deformation modulus at zero slip angle [m].
const SMALLEST_MODULUS: f64 = 1e-4;
const LARGEST_MODULUS: f64 = 1.0;

pub(super) const LINEAR: ShearModulus = ShearModulus::Linear { at_zero: 0.0, per_radian: 0.0 };
const QUADRATIC: ShearModulus = ShearModulus::Quadratic {
    at_zero: 0.0,
    per_radian: 0.0,
    per_radian_squared: 0.0,
    angle_limit: 0.0,
};

pub(super) static SHEAR: Laws<Soil> = Laws {
    doc: "Shear stress over shear displacement (Janosi and Hanamoto 1961).",
    key: "law",
    may_be_left_out: false,
    is_written_last: false,
    all: &[
        Law {
            name: "anisotropic",
            word: None,
            choose: |soil| {
                soil.shear = Shear::Anisotropic { longitudinal: LINEAR, lateral: LINEAR }
            },
            table: Table {
                doc: "Each axis on its own, with moduli linear in the slip angle (Ishigami et al. \
                      2007).",
                fields: &[LONGITUDINAL, LONGITUDINAL_GROWTH, LATERAL, LATERAL_GROWTH, BOUND],
            },
        },
        Law {
            name: "anisotropic-quadratic",
            word: None,
            choose: |soil| {
                soil.shear = Shear::Anisotropic { longitudinal: QUADRATIC, lateral: QUADRATIC }
            },
            table: Table {
                doc: "Each axis on its own, with moduli quadratic in the slip angle (the \
                      laboratory's, 2007).",
                fields: &[
                    LONGITUDINAL,
                    LONGITUDINAL_GROWTH,
                    number(
                        "longitudinal_per_rad2_m",
                        M_PER_RAD2,
                        -1.0..=1.0,
                        SQUARE,
                        |soil: &mut Soil| per_radian_squared(longitudinal(soil)),
                    )
                    .or(0.0),
                    LATERAL,
                    LATERAL_GROWTH,
                    number(
                        "lateral_per_rad2_m",
                        M_PER_RAD2,
                        -1.0..=1.0,
                        SQUARE,
                        |soil: &mut Soil| per_radian_squared(lateral(soil)?),
                    )
                    .or(0.0),
                    // Of both axes: `soil::settled` takes it over for the lateral one.
                    number(
                        "slip_angle_limit_deg",
                        DEG,
                        0.0..=90.0,
                        "The largest slip angle that the fits know; beyond it they stay",
                        |soil: &mut Soil| match longitudinal(soil) {
                            ShearModulus::Quadratic { angle_limit, .. } => Some(angle_limit),
                            ShearModulus::Linear { .. } => None,
                        },
                    )
                    .or(90.0),
                    BOUND,
                ],
            },
        },
        Law {
            name: "isotropic",
            word: None,
            choose: |soil| soil.shear = Shear::Isotropic { modulus: LINEAR },
            table: Table {
                doc: "One stress, against the slip velocity; never above c + σ tan φ.",
                fields: &[
                    Field { doc: "Modulus at zero slip angle, K", ..LONGITUDINAL },
                    LONGITUDINAL_GROWTH,
                    BOUND,
                ],
            },
        },
    ],
};

const BOUND: Field<Soil> = words(
    "bound",
    "Whether the soil's resistance is kept within its friction and cohesion.",
    &[
        word("none", "As far as the law itself does so.", |soil: &mut Soil| {
            soil.shear_bound = ShearBound::None;
        }),
        word(
            "coulomb",
            "The resultant shear stress stays within c + σ tan φ, and a wheel's horizontal force \
             within friction, cohesion and the wedge of soil ahead of it.",
            |soil: &mut Soil| soil.shear_bound = ShearBound::Coulomb,
        ),
    ],
)
.otherwise(Fill::Keyword("none"));

const LONGITUDINAL: Field<Soil> = number(
    "longitudinal_m",
    M,
    SMALLEST_MODULUS..=LARGEST_MODULUS,
    "Modulus along the wheel at zero slip angle, K_x",
    |soil| Some(at_zero(longitudinal(soil))),
);
const LONGITUDINAL_GROWTH: Field<Soil> =
    number("longitudinal_per_rad_m", M_PER_RAD, -1.0..=1.0, GROWTH, |soil: &mut Soil| {
        Some(per_radian(longitudinal(soil)))
    })
    .or_prior_or(0.0);
const LATERAL: Field<Soil> = number(
    "lateral_m",
    M,
    SMALLEST_MODULUS..=LARGEST_MODULUS,
    "Modulus across the wheel at zero slip angle, K_y",
    |soil: &mut Soil| Some(at_zero(lateral(soil)?)),
)
.or_prior();
const LATERAL_GROWTH: Field<Soil> =
    number("lateral_per_rad_m", M_PER_RAD, -1.0..=1.0, GROWTH, |soil: &mut Soil| {
        Some(per_radian(lateral(soil)?))
    })
    .or_prior_or(0.0);
const GROWTH: &str = "Its growth with the slip angle";
const SQUARE: &str = "Its growth with the square of the slip angle";

fn longitudinal(soil: &mut Soil) -> &mut ShearModulus {
    let (Shear::Anisotropic { longitudinal: modulus, .. } | Shear::Isotropic { modulus }) =
        &mut soil.shear;
    modulus
}

fn lateral(soil: &mut Soil) -> Option<&mut ShearModulus> {
    match &mut soil.shear {
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
