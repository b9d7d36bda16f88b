//! Where the wheel leaves the soil.

use super::super::super::field::{Law, Laws, ONE, Table, number};
use grouser_core::soil::Exit;

/// The largest wheel sinkage ratio that a soil may reach at any slip [-].
pub(crate) const LARGEST_EXIT_RATIO: f64 = 1.5;
pub(super) static EXIT: Laws<Exit> = Laws {
    doc: "Wheel sinkage ratio λ: the share of the sinkage that the soil recovers behind the wheel.",
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
                    "Wheel sinkage ratio, λ",
                    |law: &mut Exit| match law {
                        Exit::Ratio(ratio) => Some(ratio),
                        Exit::QuadraticInSlip { .. } => None,
                    },
                )
                .or_prior()],
            },
        },
        Law {
            name: "quadratic-in-slip",
            word: Some("Quadratic in the slip ratio."),
            choose: |law| {
                *law = Exit::QuadraticInSlip { at_zero: 0.0, per_slip: 0.0, per_slip_squared: 0.0 };
            },
            table: Table {
                doc: "λ = at_zero + per_slip s + per_slip2 s², skid counting as s = 0, λ never \
                      below 0.",
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
