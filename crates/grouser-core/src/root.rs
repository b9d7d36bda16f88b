//! The bracketed root of a continuous function.

/// A root of `f` between `low` and `high`, where its signs differ, to within `tolerance`.
///
/// Chandrupatla's method (1997): inverse quadratic interpolation where the last three points
/// allow it, bisection where they do not, so that it converges for any continuous function. The
/// best point seen is returned. Where the signs do not differ that is the better of the two ends.
pub fn between(mut f: impl FnMut(f64) -> f64, low: f64, high: f64, tolerance: f64) -> f64 {
    let (f_low, f_high) = (f(low), f(high));
    bracketed(f, (low, f_low), (high, f_high), tolerance, 0.0).0
}

/// Twice as many halvings as a double has digits.
const MOST_STEPS: usize = 106;

/// Finds a root as [`between`] does, from two points whose values are known; returns the root and
/// its value. Ends early at a point whose |value| is at most `close`.
pub fn bracketed(
    mut f: impl FnMut(f64) -> f64,
    one_end: (f64, f64),
    other_end: (f64, f64),
    tolerance: f64,
    close: f64,
) -> (f64, f64) {
    // `a` is the newest point, `b` the end across the root, `c` the point before.
    let (mut b, mut f_b) = one_end;
    let (mut a, mut f_a) = other_end;
    let (mut c, mut f_c) = (b, f_b);
    for _ in 0..MOST_STEPS {
        let (best, f_best) = if f_a.abs() < f_b.abs() { (a, f_a) } else { (b, f_b) };
        let width = (b - a).abs();
        let resolution = tolerance.max(2.0 * f64::EPSILON * best.abs());
        if f_best.abs() <= close || width <= resolution || f_a * f_b > 0.0 {
            return (best, f_best);
        }
        // No step shorter than the resolution, or the bracket would not close.
        let least = 0.5 * resolution / width;
        let share = interpolated((a, f_a), (b, f_b), (c, f_c)).clamp(least, 1.0 - least);
        let x = a + share * (b - a);
        let f_x = f(x);
        (c, f_c) = if (f_x > 0.0) == (f_a > 0.0) {
            (a, f_a)
        } else {
            let old = (b, f_b);
            (b, f_b) = (a, f_a);
            old
        };
        (a, f_a) = (x, f_x);
    }
    if f_a.abs() < f_b.abs() { (a, f_a) } else { (b, f_b) }
}

/// Where between `a` (0) and `b` (1) the root is expected.
fn interpolated((a, f_a): (f64, f64), (b, f_b): (f64, f64), (c, f_c): (f64, f64)) -> f64 {
    let xi = (a - b) / (c - b);
    let phi = (f_a - f_b) / (f_c - f_b);
    let interpolates = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    if !interpolates {
        // On the first step c is b: the secant is the best there is.
        return if c == b { f_a / (f_a - f_b) } else { 0.5 };
    }
    let alpha = (c - a) / (b - a);
    f_a / (f_b - f_a) * f_c / (f_b - f_c) + alpha * f_a / (f_c - f_a) * f_b / (f_c - f_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_root(f: impl Fn(f64) -> f64, low: f64, high: f64, expected: f64) {
        let mut evaluations = 0;
        let root = between(
            |x| {
                evaluations += 1;
                f(x)
            },
            low,
            high,
            1e-12,
        );
        assert!((root - expected).abs() < 1e-11, "{root}, not {expected}");
        assert!(evaluations < 60, "{evaluations} evaluations");
    }

    #[test]
    fn smooth_flat_steep_and_kinked_functions_have_their_roots_found() {
        check_root(|x| x * x - 2.0, 0.0, 2.0, 2.0_f64.sqrt());
        check_root(|x| x.cos() - x, 0.0, 1.0, 0.739_085_133_215_160_6);
        check_root(|x| (x - 0.3).powi(9), -1.0, 1.0, 0.3);
        check_root(|x| (x - 0.3).signum() * (x - 0.3).abs().powf(0.1), -1.0, 1.0, 0.3);
        check_root(|x| if x < 0.7 { -1e-9 } else { 1e9 * (x - 0.7) + 1e-9 }, 0.0, 1.0, 0.7);
        check_root(|x| 1.0 - x, 5.0, -5.0, 1.0);
    }

    #[test]
    fn without_a_change_of_sign_the_better_end_is_returned() {
        assert_eq!(between(|x| x + 1.0, 0.0, 1.0, 1e-9), 0.0);
    }
}
