//! How pressure grows with sinkage.

use super::super::super::field::{Field, Law, Laws, ONE, Table, Unit, number};
use grouser_core::soil::{PressureSinkage, SinkageExponent};

/// The smallest and the largest sinkage exponent that a soil may reach at any slip [-].
pub(crate) const SMALLEST_EXPONENT: f64 = 0.3;
pub(crate) const LARGEST_EXPONENT: f64 = 3.0;

const NO_EXPONENT: SinkageExponent = SinkageExponent { at_zero: 0.0, per_slip: 0.0, per_skid: 0.0 };
pub(super) const REECE: PressureSinkage =
    PressureSinkage::Reece { k_c: 0.0, k_phi: 0.0, exponent: NO_EXPONENT };
const BEKKER: PressureSinkage =
    PressureSinkage::Bekker { k_c: 0.0, k_phi: 0.0, exponent: NO_EXPONENT };

pub(super) static PRESSURE_SINKAGE: Laws<PressureSinkage> = Laws {
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
                    number(
                        "k_c",
                        ONE,
                        -1e4..=1e4,
                        "Cohesive modulus, k'_c []; a negative one needs `domain.width_m`",
                        |law| match law {
                            PressureSinkage::Reece { k_c, .. } => Some(k_c),
                            PressureSinkage::Bekker { .. } => None,
                        },
                    ),
                    number(
                        "k_phi",
                        ONE,
                        -1e5..=1e5,
                        "Frictional modulus, k'_φ []; a negative one needs `domain.width_m`",
                        |law| match law {
                            PressureSinkage::Reece { k_phi, .. } => Some(k_phi),
                            PressureSinkage::Bekker { .. } => None,
                        },
                    ),
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
                        -1e9..=1e9,
                        "Cohesive modulus, k_c []; a negative one needs `domain.width_m`",
                        |law| match law {
                            PressureSinkage::Bekker { k_c, .. } => Some(k_c),
                            PressureSinkage::Reece { .. } => None,
                        },
                    )
                    .or_in_thousands("k_c_kn"),
                    number(
                        "k_phi",
                        Unit::si("N/m^(n+2)"),
                        -1e12..=1e12,
                        "Frictional modulus, k_φ []; a negative one needs `domain.width_m`",
                        |law| match law {
                            PressureSinkage::Bekker { k_phi, .. } => Some(k_phi),
                            PressureSinkage::Reece { .. } => None,
                        },
                    )
                    .or_in_thousands("k_phi_kn"),
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
