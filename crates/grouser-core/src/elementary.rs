//! Elementary functions of the kernel: the same bits on every machine and in every lane.
//!
//! Each is a few additions, multiplications and selections without a branch, a table or a call, so
//! that a loop over nodes becomes vector instructions; and nothing is contracted to a fused
//! multiply-add, so that the bits do not depend on which. (The functions of the standard library
//! are the platform's: their last bits differ between systems and processors.) The polynomials are
//! fits at Chebyshev points with 60 digits, rounded.
//!
//! [`wide`] has the functions of any argument that the rest of the library computes with. Nothing
//! of ours calls the platform's; a test reads the sources (`tests/it/layers.rs`). The one library
//! that does is the sampler of posteriors (hammer-and-sample), for the logarithm with which it
//! decides whether a walker takes a step: a last digit that differs there would decide otherwise
//! once in 10¹⁵ steps.

#![expect(clippy::inline_always, reason = "a call in the lanes' loop would end its vectors")]

pub mod wide;

use std::f64::consts::{FRAC_PI_2, LOG2_E};

/// ln 2, its leading 33 bits: a whole number below 2²⁰ times it is exact.
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
/// The rest of ln 2.
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// eˣ for every x but NaN, to 1 ulp: 0 below −708, where doubles begin to lose digits, and infinite
/// above 709.
#[inline(always)]
#[must_use]
pub fn exp(x: f64) -> f64 {
    /// Added and taken away it rounds to whole numbers, and leaves them in the lowest bits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    const BIAS: u64 = 1023;
    const MANTISSA_BITS: u32 = 52;
    let shifted = x * LOG2_E + ROUND;
    let twos = shifted - ROUND;
    let r = (x - twos * LN_2_HIGH) - twos * LN_2_LOW;
    let (r2, r4) = (r * r, (r * r) * (r * r));
    let low = (0.5 + 0.166_666_666_666_666_7 * r)
        + r2 * (0.041_666_666_666_624_13 + 0.008_333_333_333_330_062 * r);
    let high = (0.001_388_888_891_721_371_7 + 0.000_198_412_698_630_536_18 * r)
        + r2 * (2.480_152_129_595_437_6e-5 + 2.755_726_845_999_706_4e-6 * r);
    let highest = 2.762_008_844_540_974_6e-7 + 2.510_038_549_551_032e-8 * r;
    let q = low + r4 * (high + r4 * highest);
    let power = 1.0 + (r + r2 * q);
    let scale = f64::from_bits(shifted.to_bits().wrapping_add(BIAS) << MANTISSA_BITS);
    let small = if x < -708.0 { 0.0 } else { power * scale };
    if x > 709.0 { f64::INFINITY } else { small }
}

/// ln x for normal x > 0, to 1 ulp.
#[inline(always)]
#[must_use]
pub fn ln(x: f64) -> f64 {
    /// √½ as bits: mantissas are taken from there to √2.
    const ROOT_HALF: u64 = 0x3FE6_A09E_667F_3BCD;
    const ONE: u64 = 0x3FF0_0000_0000_0000;
    const MANTISSA: u64 = 0x000F_FFFF_FFFF_FFFF;
    /// 2⁵² as bits: a whole number put into its lowest bits is added to it.
    const WHOLE: u64 = 0x4330_0000_0000_0000;
    const WHOLE_AND_BIAS: f64 = 4_503_599_627_371_519.0;
    let shifted = x.to_bits().wrapping_add(ONE - ROOT_HALF);
    let twos = f64::from_bits((shifted >> 52) | WHOLE) - WHOLE_AND_BIAS;
    let f = f64::from_bits((shifted & MANTISSA).wrapping_add(ROOT_HALF)) - 1.0;
    // ln(1 + f) = 2 artanh s, and 2s = f − f²/2 + s f²/2.
    let s = f / (2.0 + f);
    let z = s * s;
    let z2 = z * z;
    let even = (0.666_666_666_666_667 + 0.399_999_999_998_994_44 * z)
        + z2 * (0.285_714_286_260_032_7 + 0.222_222_111_302_598_78 * z);
    let odd =
        (0.181_828_894_556_749_47 + 0.153_317_106_182_107_73 * z) + z2 * 0.146_165_854_248_886_23;
    let r = z * (even + z2 * z2 * odd);
    let half_square = 0.5 * f * f;
    twos * LN_2_HIGH + (f - (half_square - (s * (half_square + r) + twos * LN_2_LOW)))
}

/// xʸ for normal x > 0, and 0 for x ≤ 0; the error grows with the power, to 2 + |y ln x| ulp.
#[inline(always)]
#[must_use]
pub fn pow(x: f64, y: f64) -> f64 {
    pow_of_log(x, ln(x), y)
}

/// The same where ln x is known.
#[inline(always)]
#[must_use]
pub(crate) fn pow_of_log(x: f64, log: f64, y: f64) -> f64 {
    let power = exp(y * log);
    if x > 0.0 { power } else { 0.0 }
}

/// sin x and cos x for |x| up to π/2, to 1 ulp and to 2⁻⁵³.
#[inline(always)]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    let z = x * x;
    let (z2, z4) = (z * z, (z * z) * (z * z));
    let cos = ((0.041_666_666_666_666_66 - 0.001_388_888_888_888_476_5 * z)
        + z2 * (2.480_158_729_891_222e-5 - 2.755_731_857_310_729_6e-7 * z))
        + z4 * ((2.087_668_153_639_063e-9 - 1.146_625_136_921_544_4e-11 * z)
            + z2 * 4.646_422_837_808_079_4e-14);
    (sin(x), (1.0 - 0.5 * z) + z2 * cos)
}

/// sin x for |x| up to π/2, to 1 ulp.
#[inline(always)]
#[must_use]
pub fn sin(x: f64) -> f64 {
    let z = x * x;
    let (z2, z4) = (z * z, (z * z) * (z * z));
    let low = (-0.166_666_666_666_666_66 + 0.008_333_333_333_333_316 * z)
        + z2 * (-0.000_198_412_698_412_549_66 + 2.755_731_921_916_083_3e-6 * z);
    let high = (-2.505_210_761_669_045e-8 + 1.605_897_729_264_274_3e-10 * z)
        + z2 * (-7.643_969_663_988_074e-13 + 2.731_436_876_937_989_3e-15 * z);
    x + x * z * (low + z4 * high)
}

/// sinh x and cosh x for x from 0 to 700, to 2 ulp.
#[inline(always)]
#[must_use]
pub fn sinh_cosh(x: f64) -> (f64, f64) {
    let z = x * x;
    let (z2, z4) = (z * z, (z * z) * (z * z));
    // Taylor's series up to x¹⁹/19!.
    let low = (0.166_666_666_666_666_66 + 0.008_333_333_333_333_333 * z)
        + z2 * (0.000_198_412_698_412_698_4 + 2.755_731_922_398_589e-6 * z);
    let high = (2.505_210_838_544_172e-8 + 1.605_904_383_682_161_3e-10 * z)
        + z2 * (7.647_163_731_819_816e-13 + 2.811_457_254_345_520_6e-15 * z);
    let series = x + x * z * (low + z4 * (high + z4 * 8.220_635_246_624_33e-18));
    let grown = exp(x);
    let fallen = 1.0 / grown;
    (if x < 1.0 { series } else { 0.5 * (grown - fallen) }, 0.5 * (grown + fallen))
}

/// asin x for x from 0 to 1, to 2 ulp.
#[inline(always)]
#[must_use]
pub fn asin(x: f64) -> f64 {
    // From one half up by the complement: asin x = π/2 − 2 asin √((1 − x)/2).
    let near = x <= 0.5;
    let z = if near { x * x } else { 0.5 * (1.0 - x) };
    let root = z.sqrt();
    let s = if near { x } else { root };
    let (z2, z4) = (z * z, (z * z) * (z * z));
    let low = (0.166_666_666_666_666_69 + 0.074_999_999_999_984_25 * z)
        + z2 * (0.044_642_857_146_373_38 + 0.030_381_944_137_085_216 * z);
    let middle = (0.022_372_173_002_005_596 + 0.017_352_391_265_909_227 * z)
        + z2 * (0.013_971_235_301_124_539 + 0.011_478_952_690_257_387 * z);
    let high = (0.010_324_318_288_744_113 + 0.005_450_878_187_720_55 * z)
        + z2 * (0.017_419_357_964_884_856 - 0.014_881_409_392_818_066 * z);
    let series = low + z4 * (middle + z4 * (high + z4 * 0.028_778_442_612_593_04));
    let small = s + s * z * series;
    if near { small } else { FRAC_PI_2 - 2.0 * small }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// |a − b| in units of the last place of b.
    pub(super) fn ulps(a: f64, b: f64) -> f64 {
        if a == b { 0.0 } else { (a - b).abs() / (b.abs().next_up() - b.abs()) }
    }

    /// Many numbers between two, evenly.
    pub(super) fn evenly(low: f64, high: f64) -> impl Iterator<Item = f64> {
        const COUNT: u32 = 200_000;
        (0..=COUNT).map(move |k| low + (high - low) * (f64::from(k) / f64::from(COUNT)))
    }

    /// Largest error against a function of the standard library, which has 1 ulp itself at most.
    pub(super) fn largest_error(
        ours: impl Fn(f64) -> f64,
        theirs: impl Fn(f64) -> f64,
        at: impl Iterator<Item = f64>,
    ) -> f64 {
        at.map(|x| ulps(ours(x), theirs(x))).fold(0.0, f64::max)
    }

    /// Source: mpmath with 50 digits, rounded to the nearest double.
    #[test]
    #[rustfmt::skip]
    #[expect(clippy::unreadable_literal, clippy::type_complexity, clippy::approx_constant, reason = "as \
        printed there")]
    fn known_values_are_met_to_one_unit_in_the_last_place() {
        let known: [(&str, fn(f64) -> f64, &[(f64, f64)]); 5] = [
        (
            "exp",
            exp,
            &[
                (-700.5, 5.980196118639791e-305),
                (-37.123456789, 7.542018048499793e-17),
                (-1e-09, 0.999999999),
                (0.34657359, 1.4142135619771539),
                (0.3465736, 1.4142135761192896),
                (1e-300, 1.0),
                (100.1, 2.9708288895158073e+43),
                (708.3, 4.081140365977677e+307),
            ],
        ),
        (
            "ln",
            ln,
            &[
                (1e-300, -690.7755278982137),
                (0.7071067811865475, -0.34657359027997275),
                (0.7071067811865476, -0.3465735902799726),
                (1.4142135623730951, 0.3465735902799727),
                (0.9999999999999999, -1.1102230246251565e-16),
                (1.0000000000000002, 2.2204460492503128e-16),
                (3700000000000.0, 28.939353935578726),
                (1.7e+308, 709.7268368932282),
            ],
        ),
        (
            "sin",
            sin,
            &[
                (1e-12, 1e-12),
                (0.5, 0.479425538604203),
                (0.7853981633974483, 0.7071067811865475),
                (1.5707963267948966, 1.0),
                (-1.25, -0.9489846193555862),
            ],
        ),
        (
            "cos",
            |x| sin_cos(x).1,
            &[
                (1e-12, 1.0),
                (0.5, 0.8775825618903728),
                (0.7853981633974483, 0.7071067811865476),
                (1.5, 0.0707372016677029),
                (-1.25, 0.3153223623952687),
            ],
        ),
        (
            "asin",
            asin,
            &[
                (1e-12, 1e-12),
                (0.5, 0.5235987755982989),
                (0.5000000000000001, 0.523598775598299),
                (0.7071067811865476, 0.7853981633974484),
                (0.999999999999, 1.5707949125969767),
                (1.0, 1.5707963267948966),
            ],
        ),
        ];
        for (name, function, values) in known {
            for &(x, expected) in values {
                let value = function(x);
                // The cosine's bound is an absolute one.
                let good = ulps(value, expected) <= 1.0 || (name == "cos" && (value - expected).abs() <= 2.3e-16);
                assert!(good, "{name} {x:e} is {value:e}, not {expected:e}");
            }
        }
    }

    /// One ulp more than is promised, for the standard library's own.
    #[test]
    fn they_agree_with_the_standard_librarys() {
        assert!(largest_error(exp, f64::exp, evenly(-708.0, 709.0)) <= 2.0);
        assert!(largest_error(exp, f64::exp, evenly(-1.0, 1.0)) <= 2.0);
        assert!(largest_error(ln, f64::ln, evenly(-700.0, 700.0).map(f64::exp)) <= 2.0);
        assert!(largest_error(ln, f64::ln, evenly(0.5, 2.0)) <= 2.0);
        assert!(largest_error(sin, f64::sin, evenly(-FRAC_PI_2, FRAC_PI_2)) <= 2.0);
        assert!(largest_error(asin, f64::asin, evenly(0.0, 1.0)) <= 3.0);
        let cos = |x| sin_cos(x).1;
        assert!(largest_error(|x| sinh_cosh(x).0, f64::sinh, evenly(0.0, 20.0)) <= 3.0);
        assert!(largest_error(|x| sinh_cosh(x).1, f64::cosh, evenly(0.0, 20.0)) <= 3.0);
        let most = evenly(-FRAC_PI_2, FRAC_PI_2).map(|x| (cos(x) - x.cos()).abs());
        assert!(most.fold(0.0, f64::max) <= 2.3e-16);
    }

    #[test]
    fn powers_lose_what_their_exponent_takes() {
        for y in [0.1, 0.5, 1.0, 1.703, 2.0, 3.0] {
            for x in evenly(-200.0, 200.0).map(f64::exp) {
                let allowed = 3.0 + (y * x.ln()).abs();
                assert!(ulps(pow(x, y), x.powf(y)) <= allowed, "{x}^{y}");
            }
        }
    }

    #[test]
    fn ends_of_the_ranges() {
        assert_eq!((exp(0.0), exp(-709.0), exp(f64::NEG_INFINITY)), (1.0, 0.0, 0.0));
        assert_eq!((exp(710.0), exp(f64::INFINITY)), (f64::INFINITY, f64::INFINITY));
        assert_eq!((ln(1.0), pow(0.0, 0.5), pow(-1.0, 2.0), pow(5.0, 0.0)), (0.0, 0.0, 0.0, 1.0));
        assert_eq!((sin_cos(0.0), asin(0.0)), ((0.0, 1.0), 0.0));
    }
}
