//! The highest point of a function between two others.

/// The highest value of `f` between two ends and where it is, to within `narrow`, from a point
/// between them that is known to be high.
///
/// A parabola through the three highest points leads to the next where it can, the golden section
/// of the larger side where it cannot (Brent 1973). A function with several peaks has one of them
/// found.
pub(crate) fn highest(
    mut f: impl FnMut(f64) -> f64,
    (mut low, mut high): (f64, f64),
    known: (f64, f64),
    narrow: f64,
) -> (f64, f64) {
    /// Far more than any peak of a smooth function takes.
    const MOST_STEPS: usize = 100;
    /// The smaller part of a golden section.
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    // The highest point, the second highest, and the one that was that before.
    let (mut best, mut second, mut third) = (known, known, known);
    let (mut step, mut step_before) = (0.0_f64, 0.0_f64);
    for _ in 0..MOST_STEPS {
        let middle = 0.5 * (low + high);
        if (best.0 - middle).abs() <= 2.0 * narrow - 0.5 * (high - low) {
            break;
        }
        let larger = if best.0 >= middle { low - best.0 } else { high - best.0 };
        let vertex = vertex(best, second, third).filter(|way| {
            let next = best.0 + way;
            way.abs() < 0.5 * step_before.abs() && low < next && next < high
        });
        step_before = if vertex.is_some() { step } else { larger };
        step = vertex.unwrap_or(GOLDEN * larger);
        // Neither too near to the best point nor to the ends.
        let towards_middle = if middle >= best.0 { narrow } else { -narrow };
        let next = best.0 + step;
        if next - low < 2.0 * narrow || high - next < 2.0 * narrow {
            step = towards_middle;
        }
        if step.abs() < narrow {
            step = narrow.copysign(step);
        }
        let point = (best.0 + step, f(best.0 + step));
        if point.1 >= best.1 {
            (low, high) = if point.0 >= best.0 { (best.0, high) } else { (low, best.0) };
            (third, second, best) = (second, best, point);
        } else {
            (low, high) = if point.0 < best.0 { (point.0, high) } else { (low, point.0) };
            if point.1 >= second.1 || second.0 == best.0 {
                (third, second) = (second, point);
            } else if point.1 >= third.1 || third.0 == best.0 || third.0 == second.0 {
                third = point;
            }
        }
    }
    best
}

/// The way from the first point to the vertex of the parabola through all three; none where they
/// lie on a straight line or are not three.
fn vertex(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> Option<f64> {
    let r = (a.0 - b.0) * (a.1 - c.1);
    let q = (a.0 - c.0) * (a.1 - b.1);
    let numerator = (a.0 - c.0) * q - (a.0 - b.0) * r;
    let way = -numerator / (2.0 * (q - r));
    way.is_finite().then_some(way)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_peak(f: impl Fn(f64) -> f64, ends: (f64, f64), start: f64, expected: f64) {
        let mut evaluations = 0;
        let counted = |x: f64| {
            evaluations += 1;
            f(x)
        };
        let (at, height) = highest(counted, ends, (start, f(start)), 1e-6);
        assert!((at - expected).abs() < 1e-5, "{at}, not {expected}");
        assert_eq!(height, f(at));
        assert!(evaluations < 40, "{evaluations} evaluations");
    }

    #[test]
    fn smooth_peaks_kinks_and_ends_are_found() {
        check_peak(|x| -(x - 0.3) * (x - 0.3), (0.0, 1.0), 0.5, 0.3);
        check_peak(f64::sin, (0.0, 3.0), 1.0, std::f64::consts::FRAC_PI_2);
        check_peak(|x| -(x - 0.7).abs(), (0.0, 1.0), 0.5, 0.7);
        check_peak(|x| x, (0.0, 1.0), 0.5, 1.0);
        check_peak(|x| -x.powi(4), (-1.0, 0.5), 0.2, 0.0);
    }

    #[test]
    fn a_smooth_peak_takes_few_evaluations() {
        let mut evaluations = 0;
        let peak = highest(
            |x| {
                evaluations += 1;
                1.0 - (x - 0.31).powi(2) - 0.2 * (x - 0.31).powi(3)
            },
            (0.2, 0.4),
            (0.3, 1.0 - 1e-4 + 2e-7),
            1e-6,
        );
        assert!((peak.1 - 1.0).abs() < 1e-12 && evaluations <= 10, "{peak:?}, {evaluations}");
    }
}
