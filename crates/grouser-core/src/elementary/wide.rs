//! Elementary functions of any argument, for what is computed once for a wheel, a rover or a study.
//!
//! They are made of the functions above and of additions, multiplications, divisions and square
//! roots, so that they too have the same bits on every machine. They branch, and the kernel's lanes
//! do without them.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, PI, TAU};

/// sin x and cos x, to 2 ulp.
///
/// An angle beyond a million radians is first reduced by the nearest double to 2π: an error no
/// larger than that of its own last digit.
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    /// Number of quarter turns by which the leading parts of π/2 can be multiplied without
    /// rounding.
    const FAR: f64 = 1e6;
    let x = if x.abs() > FAR { x % TAU } else { x };
    /// A sum of this and a number below 2⁵¹ ends in the bits of the nearest whole number, the even
    /// one of two as near.
    const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;
    let shifted = x * FRAC_2_PI + WHOLE;
    let (r, rest) = less_quarters(x, shifted - WHOLE);
    let (sin, cos) = super::sin_cos(r);
    let (sin, cos) = (sin + rest * cos, cos - rest * sin);
    // The last two bits tell the quadrant.
    match shifted.to_bits() & 3 {
        1 => (cos, -sin),
        2 => (-sin, -cos),
        3 => (-cos, sin),
        _ => (sin, cos),
    }
}

/// x − n π/2 in two parts, of which the second is the first's rounding error.
fn less_quarters(x: f64, n: f64) -> (f64, f64) {
    /// π/2: 33 bits, the next 33 bits, and the rest.
    const PARTS: [f64; 3] =
        [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
    let (a, b) = (x - n * PARTS[0], n * PARTS[1]);
    let difference = a - b;
    // What the difference lost (Knuth), exactly.
    let taken = a - difference;
    let lost = (a - (difference + taken)) + (taken - b);
    let low = lost - n * PARTS[2];
    let r = difference + low;
    (r, (difference - r) + low)
}

/// sin x, to 2 ulp.
#[must_use]
pub fn sin(x: f64) -> f64 {
    sin_cos(x).0
}

/// cos x, to 2 ulp.
#[must_use]
pub fn cos(x: f64) -> f64 {
    sin_cos(x).1
}

/// tan x, to 4 ulp.
#[must_use]
pub fn tan(x: f64) -> f64 {
    let (sin, cos) = sin_cos(x);
    sin / cos
}

/// asin x, to 2 ulp; NaN beyond −1 and 1.
#[must_use]
pub fn asin(x: f64) -> f64 {
    super::asin(x.abs()).copysign(x)
}

/// acos x, to 2 ulp; NaN beyond −1 and 1.
#[must_use]
pub fn acos(x: f64) -> f64 {
    if x > 0.5 {
        2.0 * super::asin((0.5 * (1.0 - x)).sqrt())
    } else if x < -0.5 {
        PI - 2.0 * super::asin((0.5 * (1.0 + x)).sqrt())
    } else {
        FRAC_PI_2 - asin(x)
    }
}

/// The angle of a point (x, y) from the x axis, −π to π, to 3 ulp. That of the origin is 0 or ±π by
/// the signs of its zeros, as in the standard library.
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (height, length) = (y.abs(), x.abs());
    let angle = if height == 0.0 && length == 0.0 {
        0.0
    } else if height <= length {
        first_octant(height / length)
    } else {
        FRAC_PI_2 - first_octant(length / height)
    };
    let angle = if x.is_sign_negative() { PI - angle } else { angle };
    angle.copysign(y)
}

/// atan t for t from 0 to 1.
fn first_octant(t: f64) -> f64 {
    /// tan π/8.
    const HALF_WAY: f64 = 0.414_213_562_373_095_03;
    if t <= HALF_WAY { narrow(t) } else { FRAC_PI_4 + narrow((t - 1.0) / (t + 1.0)) }
}

/// atan t for |t| up to tan π/8.
fn narrow(t: f64) -> f64 {
    const SERIES: [f64; 11] = [
        -0.333_333_333_333_333_3,
        0.199_999_999_999_955_16,
        -0.142_857_142_846_656_82,
        0.111_111_110_151_870_18,
        -0.090_909_045_753_064_9,
        0.076_921_831_253_768_92,
        -0.066_645_105_255_089_36,
        0.058_581_409_048_663_28,
        -0.050_854_078_345_894_844,
        0.039_230_447_784_793_09,
        -0.019_175_404_711_104_935,
    ];
    let z = t * t;
    t + t * z * SERIES.iter().rev().fold(0.0, |sum, coefficient| coefficient + z * sum)
}

/// ln x, to 1 ulp: −∞ at 0, NaN below.
#[must_use]
pub fn ln(x: f64) -> f64 {
    const TWO_54: f64 = 18_014_398_509_481_984.0;
    if x >= f64::MIN_POSITIVE {
        if x == f64::INFINITY { x } else { super::ln(x) }
    } else if x > 0.0 {
        super::ln(x * TWO_54) - 54.0 * LN_2
    } else if x == 0.0 {
        f64::NEG_INFINITY
    } else {
        f64::NAN
    }
}

/// ln(1 + x), to 4 ulp also where x is small (Kahan: the rounding of 1 + x cancels in the ratio).
#[must_use]
pub fn ln_1p(x: f64) -> f64 {
    let sum = 1.0 + x;
    if sum == 1.0 || sum == f64::INFINITY { x } else { ln(sum) * (x / (sum - 1.0)) }
}

/// eˣ − 1, to 4 ulp also where x is small (Kahan).
#[must_use]
pub fn exp_m1(x: f64) -> f64 {
    let power = super::exp(x);
    let less_one = power - 1.0;
    if power == 1.0 {
        x
    } else if less_one == -1.0 || power == f64::INFINITY {
        less_one
    } else {
        less_one * (x / super::ln(power))
    }
}

/// asinh x for x ≥ 0 whose square is a number, to 5 ulp.
#[must_use]
pub fn asinh(x: f64) -> f64 {
    let square = x * x;
    ln_1p(x + square / (1.0 + (1.0 + square).sqrt()))
}

/// √(x² + y²), to 2 ulp, without overflow.
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    /// Squares of numbers between these lose no digits that count.
    const SMALL: f64 = 1e-140;
    const LARGE: f64 = 1e150;
    let (more, less) = if x.abs() > y.abs() { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    if more > SMALL && more < LARGE {
        (more * more + less * less).sqrt()
    } else if more == 0.0 || more == f64::INFINITY {
        more
    } else {
        let ratio = less / more;
        more * (1.0 + ratio * ratio).sqrt()
    }
}

/// xⁿ, by squaring: always the same multiplications. (What those of the standard library are is
/// left open.)
#[must_use]
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut square, mut left, mut power) = (x, n.unsigned_abs(), 1.0);
    while left > 0 {
        if left % 2 == 1 {
            power *= square;
        }
        square *= square;
        left /= 2;
    }
    if n < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{evenly, largest_error, ulps};
    use super::*;
    use proptest::prelude::*;

    /// Source: mpmath with 60 digits, rounded to the nearest double.
    #[test]
    #[rustfmt::skip]
    #[expect(clippy::unreadable_literal, clippy::type_complexity, clippy::approx_constant, reason = "as \
        printed there")]
    fn known_values_are_met() {
        let known: [(&str, fn(f64) -> f64, f64, &[(f64, f64)]); 8] = [
            ("sin", sin, 2.0, &[(3.0, 0.1411200080598672), (1e-09, 1e-09), (22.0, -0.008851309290403876), (355.0, -3.014435335948845e-05), (-7.5, -0.9379999767747389), (100000.0, 0.03574879797201651), (123456.789, -0.9986640823432246)]),
            ("cos", cos, 2.0, &[(3.0, -0.9899924966004454), (11.0, 0.004425697988050785), (-7.5, 0.3466353178350258), (100000.0, -0.9993608074382124), (1.5707963267948966, 6.123233995736766e-17), (123456.789, 0.05167253271870138)]),
            ("tan", tan, 4.0, &[(0.5, 0.5463024898437905), (1.5707963267948966, 1.633123935319537e+16), (-1.2, -2.5721516221263188), (3.0, -0.1425465430742778), (355.0, 3.0144353373184265e-05), (0.5061454830783556, 0.554309051452769)]),
            ("atan", |x| atan2(x, 1.0), 2.0, &[(1e-09, 1e-09), (0.3, 0.2914567944778671), (0.41421356, 0.3926990796731608), (0.4142136, 0.39269911381529604), (1.0, 0.7853981633974483), (2.5, 1.1902899496825317), (1e+20, 1.5707963267948966), (-0.7, -0.6107259643892086)]),
            ("acos", acos, 2.0, &[(1.0, 0.0), (0.999999999, 4.4721358921319356e-05), (0.5, 1.0471975511965979), (0.3, 1.2661036727794992), (0.0, 1.5707963267948966), (-0.2, 1.7721542475852274), (-0.75, 2.4188584057763776), (-1.0, 3.141592653589793)]),
            ("asin", asin, 2.0, &[(-1.0, -1.5707963267948966), (-0.3, -0.3046926540153975), (0.6, 0.6435011087932844)]),
            ("ln_1p", ln_1p, 2.0, &[(1e-20, 1e-20), (1e-09, 9.999999995e-10), (0.01, 0.009950330853168083), (-0.5, -0.6931471805599453), (3.0, 1.3862943611198906)]),
            ("exp_m1", exp_m1, 2.0, &[(1e-20, 1e-20), (-1e-09, -9.999999995e-10), (-0.01, -0.009950166250831947), (0.3, 0.3498588075760031), (-5.0, -0.9932620530009145), (-40.0, -1.0)]),
        ];
        for (name, function, most, values) in known {
            for &(x, expected) in values {
                let value = function(x);
                assert!(ulps(value, expected) <= most, "{name} {x:e} is {value:e}, not \
                                                        {expected:e}");
            }
        }
    }

    /// One ulp more than is promised, for the standard library's own.
    #[test]
    fn they_agree_with_the_standard_librarys() {
        for (low, high) in [(-1.0, 1.0), (-7.0, 7.0), (-1e5, 1e5), (9e5, 1e6)] {
            assert!(largest_error(sin, f64::sin, evenly(low, high)) <= 3.0);
            assert!(largest_error(cos, f64::cos, evenly(low, high)) <= 3.0);
            assert!(largest_error(tan, f64::tan, evenly(low, high)) <= 5.0);
        }
        assert!(largest_error(asin, f64::asin, evenly(-1.0, 1.0)) <= 3.0);
        assert!(largest_error(acos, f64::acos, evenly(-1.0, 1.0)) <= 3.0);
        assert!(largest_error(ln, f64::ln, evenly(-740.0, 709.0).map(f64::exp)) <= 2.0);
        let many = || evenly(-40.0, 5.0).map(f64::exp);
        assert!(largest_error(ln_1p, f64::ln_1p, many()) <= 5.0);
        assert!(largest_error(exp_m1, f64::exp_m1, many().chain(many().map(|x| -x))) <= 5.0);
        assert!(largest_error(asinh, f64::asinh, many()) <= 6.0);
        assert!(largest_error(|t| atan2(t, 1.0), f64::atan, many()) <= 4.0);
    }

    #[test]
    fn ends_of_the_ranges() {
        assert_eq!((ln(0.0), ln(f64::INFINITY)), (f64::NEG_INFINITY, f64::INFINITY));
        assert!(ln(-1.0).is_nan() && acos(1.1).is_nan() && asin(-1.1).is_nan());
        assert_eq!((exp_m1(800.0), exp_m1(-800.0)), (f64::INFINITY, -1.0));
        assert_eq!((hypot(0.0, -0.0), hypot(3.0, -4.0), hypot(0.0, -2.5)), (0.0, 5.0, 2.5));
        assert!(
            ulps(hypot(3e200, 4e200), 5e200) <= 1.0 && ulps(hypot(3e-300, 4e-300), 5e-300) <= 1.0
        );
        assert_eq!((powi(2.0, 10), powi(2.0, -2), powi(0.0, 0)), (1024.0, 0.25, 1.0));
        for (y, x) in [(0.0, 1.0), (-0.0, 1.0), (0.0, -1.0), (-0.0, -1.0), (0.0, 0.0), (-0.0, -0.0)]
        {
            assert_eq!(atan2(y, x).to_bits(), f64::atan2(y, x).to_bits(), "{y} {x}");
        }
    }

    fn any_size() -> impl Strategy<Value = f64> {
        (-300.0..300.0, any::<bool>())
            .prop_map(|(power, left)| f64::powf(10.0, power) * if left { -1.0 } else { 1.0 })
    }

    proptest! {
        #[test]
        fn angles_of_points_anywhere(y in any_size(), x in any_size()) {
            // Where the quotient itself is next to nothing, so is the angle.
            prop_assume!((y / x).abs() > 1e-290);
            prop_assert!(ulps(atan2(y, x), f64::atan2(y, x)) <= 4.0);
        }

        #[test]
        fn lengths_of_any_size(y in any_size(), x in any_size()) {
            prop_assert!(ulps(hypot(x, y), f64::hypot(x, y)) <= 3.0);
            prop_assert_eq!(hypot(x, y).to_bits(), hypot(-y, x).to_bits());
        }

        #[test]
        fn far_angles_have_a_sine_and_a_cosine(x in any_size()) {
            let (sin, cos) = sin_cos(x);
            prop_assert!((sin * sin + cos * cos - 1.0).abs() < 1e-15);
            prop_assert!((sin - x.sin()).abs() <= (x.abs() * f64::EPSILON).max(1e-15));
        }
    }
}
