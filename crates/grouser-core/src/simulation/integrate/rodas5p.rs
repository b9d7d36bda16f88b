//! Coefficients of the Rosenbrock method Rodas5P: eight stages, order 5, embedded order 4,
//! L-stable, stiffly accurate, and a continuous extension of order 4.
//!
//! Source: Steinebach (2023), "Construction of Rosenbrock-Wanner method Rodas5P and numerical
//! benchmarks within the Julia Differential Equations package", BIT Numerical Mathematics 63, 27;
//! digits as in the tableau of `OrdinaryDiffEq`, that paper's implementation. They are written for
//! the form without products by the Jacobian, Hairer and Wanner (1996), Solving Ordinary
//! Differential Equations II, Eq. (IV.7.25). The tests below hold them to the order conditions.

/// How many stages a step has.
pub(super) const STAGES: usize = 8;

/// Diagonal of all stages, *γ* [-].
pub(super) const GAMMA: f64 = 0.211_937_563_194_290_14;

/// Weights of earlier stages in the point where a stage's rates are taken, *a_ij* [-]. The last
/// row, and 1 for the last stage itself, are the step: the method is stiffly accurate.
pub(super) const A: [[f64; STAGES]; STAGES] = {
    const FIVE: [f64; 5] = [
        -7.502_846_399_306_121,
        2.561_846_144_803_919,
        -11.627_539_656_261_098,
        -0.182_687_676_599_422_56,
        0.030_198_172_008_377_946,
    ];
    const fn last(six: f64, seven: f64) -> [f64; STAGES] {
        [FIVE[0], FIVE[1], FIVE[2], FIVE[3], FIVE[4], six, seven, 0.0]
    }
    [
        [0.0; STAGES],
        [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [2.849_394_379_747_939, 0.458_422_422_044_639_23, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [
            -6.954_028_509_809_101,
            2.489_845_061_869_568,
            -10.358_996_098_473_584,
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
        ],
        [
            2.802_998_627_562_896_4,
            0.507_246_473_622_820_6,
            -0.398_831_254_177_052_4,
            -0.047_211_872_304_046_41,
            0.0,
            0.0,
            0.0,
            0.0,
        ],
        last(0.0, 0.0),
        last(1.0, 0.0),
        last(1.0, 1.0),
    ]
};

/// Weights of earlier stages in a stage itself, *c_ij* [-].
pub(super) const C: [[f64; STAGES]; STAGES] = [
    [0.0; STAGES],
    [-14.155_112_264_123_755, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-17.972_960_358_859_52, -2.859_693_295_451_294, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [147.121_502_757_117_16, -1.412_214_027_182_13, 71.689_402_513_023_58, 0.0, 0.0, 0.0, 0.0, 0.0],
    [
        165.435_170_248_716_76,
        -0.459_282_345_649_112_6,
        42.909_383_369_586_03,
        -5.961_986_721_573_306,
        0.0,
        0.0,
        0.0,
        0.0,
    ],
    [
        24.854_864_614_690_072,
        -3.000_922_700_283_218_6,
        47.493_111_002_076_8,
        5.581_419_782_155_812_5,
        -0.661_069_182_524_947_1,
        0.0,
        0.0,
        0.0,
    ],
    [
        30.912_732_140_285_99,
        -3.120_824_334_993_797_4,
        77.799_546_460_708_92,
        34.286_460_282_947_83,
        -19.097_331_116_725_623,
        -28.087_943_162_872_662,
        0.0,
        0.0,
    ],
    [
        37.802_771_233_905_63,
        -3.257_196_902_907_227_6,
        112.269_188_494_963_27,
        66.934_723_124_404_7,
        -40.066_189_370_910_02,
        -54.667_802_628_779_68,
        -9.488_616_523_096_27,
        0.0,
    ],
];

/// Weights of the stages in the continuous extension, *h_ij* [-]: at a share θ of the step
/// y = (1 − θ) y₀ + θ (y₁ + (1 − θ) (k₁ + θ (k₂ + θ k₃))), k_i = Σ_j h_ij U_j.
pub(super) const H: [[f64; STAGES]; 3] = [
    [
        25.948_786_856_663_858,
        -2.557_972_484_584_623_5,
        10.433_815_404_888_879,
        -2.367_925_102_268_520_4,
        0.524_948_541_321_073,
        1.124_108_831_045_040_4,
        0.427_287_619_443_187_4,
        -0.172_022_210_701_554_93,
    ],
    [
        -9.915_688_506_951_71,
        -0.968_994_459_411_515_4,
        3.043_803_724_297_845_3,
        -24.495_224_566_215_796,
        20.176_138_334_709_044,
        15.980_663_614_246_51,
        -6.789_040_303_419_874,
        -6.710_236_069_923_372,
    ],
    [
        11.419_903_575_922_262,
        2.887_964_514_613_699_4,
        72.921_379_959_960_29,
        80.125_118_346_226_43,
        -52.072_871_366_152_654,
        -59.789_936_252_667_29,
        -0.155_826_842_827_519_13,
        4.883_087_185_713_722,
    ],
];

#[cfg(test)]
mod tests {
    use nalgebra::{SMatrix, SVector};

    use super::*;
    use crate::simulation::integrate::order_conditions::Method;

    type Matrix = SMatrix<f64, STAGES, STAGES>;
    type Weights = SVector<f64, STAGES>;

    fn matrix(rows: &[[f64; STAGES]; STAGES]) -> Matrix {
        Matrix::from_fn(|row, column| rows[row][column])
    }

    /// Γ = (1/γ − C)⁻¹ leads back from the form without products by the Jacobian.
    fn gammas() -> Matrix {
        (Matrix::identity() / GAMMA - matrix(&C)).try_inverse().expect("a triangle")
    }

    fn method() -> Method<STAGES> {
        let points = matrix(&A) * gammas();
        Method { points, lines: points + gammas() }
    }

    fn in_rates(weights: &Weights) -> Weights {
        gammas().transpose() * weights
    }

    fn embedded() -> Weights {
        Weights::from_column_slice(&A[STAGES - 1])
    }

    fn step() -> Weights {
        let mut weights = embedded();
        weights[STAGES - 1] = 1.0;
        weights
    }

    #[test]
    fn a_step_is_of_order_five() {
        method().check(&in_rates(&step()), 5, 1.0);
    }

    /// The step without its last stage is the embedded one, so that the last stage is the error.
    #[test]
    fn the_embedded_step_is_of_order_four() {
        method().check(&in_rates(&embedded()), 4, 1.0);
    }

    #[test]
    fn the_continuous_extension_is_of_order_four() {
        let [one, two, three] = H.map(|row| Weights::from_column_slice(&row));
        for share in [0.1, 0.3, 0.5, 0.9] {
            let bend = one + (two + three * share) * share;
            let weights = (step() + bend * (1.0 - share)) * share;
            method().check(&in_rates(&weights), 4, share);
        }
    }

    /// R(∞) = 1 − bᵀ β⁻¹ 1 is zero for the step and for its embedded one: what is much faster than
    /// a step has died out after it.
    #[test]
    fn infinitely_stiff_motions_die_out_in_one_step() {
        let inverse = method().lines.try_inverse().expect("a triangle");
        for weights in [step(), embedded()] {
            let left = 1.0 - in_rates(&weights).dot(&(inverse * Weights::repeat(1.0)));
            assert!(left.abs() < 1e-10, "{left:e}");
        }
    }
}
