//! The standard normal distribution, with the same bits on every machine.

use grouser_core::elementary::exp;
use grouser_core::elementary::wide::ln;

/// The share of standard normal numbers below one, Φ(z), to 1e-15 of itself.
///
/// ```text
/// Φ(−z) = e^(−z²/2) t g(t)      t = 3/(3 + z)      z ≥ 0
/// ```
///
/// with a Chebyshev series for g, computed with 50 digits.
#[must_use]
pub fn normal_share(score: f64) -> f64 {
    let beyond = share_beyond(score.abs());
    if score < 0.0 { beyond } else { 1.0 - beyond }
}

/// Φ(−z) for z ≥ 0.
fn share_beyond(z: f64) -> f64 {
    #[rustfmt::skip]
    const SERIES: [f64; 26] = [
        0.280_145_132_095_810_43,
        0.180_308_023_856_764_1,
        0.036_724_151_860_193_656,
        0.003_311_385_782_276_504_4,
        -0.000_385_664_873_348_684_96,
        -0.000_113_559_289_450_221_69,
        7.066_641_184_040_323e-06,
        3.910_623_515_168_102e-06,
        -3.272_157_761_237_449e-07,
        -1.459_072_351_807_736_6e-07,
        2.307_984_262_007_058_3e-08,
        4.949_050_381_173_485e-09,
        -1.613_514_515_130_722_3e-09,
        -7.344_108_538_979_121e-11,
        9.663_960_983_667_234e-11,
        -9.578_345_136_312_656e-12,
        -4.171_946_158_721_665_6e-12,
        1.279_043_212_042_411_6e-12,
        3.232_799_156_291_914_7e-14,
        -8.872_914_749_375_41e-14,
        1.564_545_993_903_764e-14,
        2.760_287_321_234_127_7e-15,
        -1.701_911_074_631_755_3e-15,
        1.921_488_802_068_384_2e-16,
        7.901_630_884_870_591e-17,
        -3.383_550_411_837_623e-17,
    ];
    /// A number's upper half: its square is exact.
    const UPPER: u64 = !0xFFFF_FFFF;
    if z > MOST_SCORE {
        return 0.0;
    }
    let t = 3.0 / (3.0 + z);
    let x = 2.0 * t - 1.0;
    // Clenshaw's sum.
    let (mut one, mut two) = (0.0, 0.0);
    for coefficient in SERIES[1..].iter().rev() {
        (one, two) = (2.0 * x * one - two + coefficient, one);
    }
    let g = x * one - two + SERIES[0];
    // e^(−z²/2) from two squares, so that z² costs no digits.
    let upper = f64::from_bits(z.to_bits() & UPPER);
    let rest = (z - upper) * (z + upper);
    exp(-0.5 * upper * upper) * exp(-0.5 * rest) * (t * g)
}

/// No double is as small as the share beyond this score.
const MOST_SCORE: f64 = 39.0;

/// The standard normal number below which a share of all lies, to 1e-15 of itself: −∞ for 0 and ∞
/// for 1.
///
/// Source: Wichura (1988), algorithm AS 241, PPND16.
#[must_use]
pub fn normal_score(share: f64) -> f64 {
    /// Half the width of the middle part [-].
    const MIDDLE: f64 = 0.425;
    /// The root of −ln share from which on the tail is another fit's.
    const FAR: f64 = 5.0;
    let from_middle = share - 0.5;
    if from_middle.abs() <= MIDDLE {
        let r = 0.180_625 - from_middle * from_middle;
        return from_middle * ratio(&CENTRE, r);
    }
    let tail = if from_middle < 0.0 { share } else { 1.0 - share };
    let r = (-ln(tail)).sqrt();
    let score = if r <= FAR {
        ratio(&NEAR_TAIL, r - 1.6)
    } else if r < f64::INFINITY {
        ratio(&FAR_TAIL, r - FAR)
    } else {
        f64::INFINITY
    };
    score.copysign(from_middle)
}

/// Coefficients of a ratio of polynomials, from the constant up: above the line and below.
type Ratio = [[f64; 8]; 2];

fn ratio([above, below]: &Ratio, r: f64) -> f64 {
    let sum = |of: &[f64; 8]| of.iter().rev().fold(0.0, |sum, coefficient| coefficient + r * sum);
    sum(above) / sum(below)
}

#[rustfmt::skip]
static CENTRE: Ratio = [
        [
            3.387_132_872_796_366_5,
            133.141_667_891_784_38,
            1_971.590_950_306_551_3,
            13_731.693_765_509_46,
            45_921.953_931_549_87,
            67_265.770_927_008_7,
            33_430.575_583_588_13,
            2_509.080_928_730_122_7,
        ],
        [
            1.0,
            42.313_330_701_600_91,
            687.187_007_492_057_9,
            5_394.196_021_424_751,
            21_213.794_301_586_597,
            39_307.895_800_092_71,
            28_729.085_735_721_943,
            5_226.495_278_852_854,
        ],
];

#[rustfmt::skip]
static NEAR_TAIL: Ratio = [
        [
            1.423_437_110_749_683_5,
            4.630_337_846_156_546,
            5.769_497_221_460_691,
            3.647_848_324_763_204_5,
            1.270_458_252_452_368_4,
            0.241_780_725_177_450_6,
            0.022_723_844_989_269_184,
            0.000_774_545_014_278_341_4,
        ],
        [
            1.0,
            2.053_191_626_637_759,
            1.676_384_830_183_803_8,
            0.689_767_334_985_1,
            0.148_103_976_427_480_08,
            0.015_198_666_563_616_457,
            0.000_547_593_808_499_534_5,
            1.050_750_071_644_416_9e-09,
        ],
];

#[rustfmt::skip]
static FAR_TAIL: Ratio = [
        [
            6.657_904_643_501_103,
            5.463_784_911_164_114,
            1.784_826_539_917_291_3,
            0.296_560_571_828_504_87,
            0.026_532_189_526_576_124,
            0.001_242_660_947_388_078_4,
            2.711_555_568_743_487_6e-05,
            2.010_334_399_292_288_1e-07,
        ],
        [
            1.0,
            0.599_832_206_555_888,
            0.136_929_880_922_735_8,
            0.014_875_361_290_850_615,
            0.000_786_869_131_145_613_3,
            1.846_318_317_510_054_8e-05,
            1.421_511_758_316_446e-07,
            2.044_263_103_389_939_7e-15,
        ],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Source: mpmath with 60 digits.
    #[test]
    #[rustfmt::skip]
    #[expect(clippy::unreadable_literal, reason = "as printed there")]
    fn known_shares_and_scores_are_met() {
        for (score, share) in [(0.0, 0.5), (0.3, 0.6179114221889527), (-0.5, 0.3085375387259869), (1.0, 0.8413447460685429), (-1.96, 0.024997895148220435), (2.5758293035489004, 0.995), (-5.0, 2.866515718791939e-07), (-8.0, 6.220960574271784e-16), (-20.0, 2.7536241186062337e-89), (-37.0, 5.725571222524577e-300), (6.0, 0.9999999990134123)] {
            let ours = normal_share(score);
            assert!((ours / share - 1.0).abs() < 1e-15, "{score}: {ours:e}, not {share:e}");
        }
        for (share, score) in [(0.425, -0.18911842627279252), (0.075, -1.439531470938456), (0.0749, -1.4402382675279637), (0.3, -0.5244005127080408), (0.025, -1.9599639845400543), (0.975, 1.9599639845400538), (1e-05, -4.264890793922825), (1e-10, -6.361340902404057), (1.2e-11, -6.679352656501522), (1.1102230246251565e-16, -8.209536151601387), (1e-300, -37.0470962993612)] {
            let ours = normal_score(share);
            assert!((ours / score - 1.0_f64).abs() < 1e-15, "{share}: {ours:e}, not {score:e}");
        }
        assert_eq!(normal_score(0.5), 0.0);
        assert_eq!((normal_score(0.0), normal_score(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!((normal_share(f64::NEG_INFINITY), normal_share(f64::INFINITY)), (0.0, 1.0));
    }

    #[test]
    fn share_and_score_are_inverses() {
        for k in 1..4000 {
            let score = -8.0 + 0.002 * f64::from(k);
            let error = (normal_score(normal_share(score)) - score).abs();
            // The share's rounding, over its slope.
            assert!(error < 4e-15, "{error:e} at {score}");
        }
    }

    /// Between any two scores there are shares: it never turns back.
    #[test]
    fn scores_grow_with_their_shares() {
        let shares = || (1..100_000).map(|k| f64::from(k) / 100_000.0);
        for (less, more) in shares().zip(shares().skip(1)) {
            assert!(normal_score(less) < normal_score(more), "{less}");
        }
    }
}
