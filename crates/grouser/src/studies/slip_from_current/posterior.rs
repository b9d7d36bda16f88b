//! How probable slip ratios are, given a torque.

use super::Band;
use grouser_io::statistics::normal::normal_share;

/// What a torque says of the slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Posterior {
    /// The middle 95 % and the median.
    Band(Band),
    /// The torque is above all curves.
    Above,
    /// The torque is below them.
    Below,
    /// No curve has a torque.
    Nowhere,
}

/// A torque this many standard deviations off every curve belongs to none of them [-].
const OFF: f64 = 3.0;

/// Where no deviation is left of a torque of zero, this one is [N·m].
const LEAST_DEVIATION: f64 = 1e-9;

/// The slip ratios that go with a torque, over curves that are equally probable.
///
/// Between two slips of a curve its torque is a straight line of which the density is integrated,
/// so that noise may be finer than the curve's steps.
///
/// * `curves`: torques at slips of equal steps [N·m], not a number where there is none
/// * `deviation`: the standard deviation of a torque [N·m]
/// * `slips`: the first and the last [-]
pub(super) fn posterior(
    curves: &[Vec<f64>],
    torque: f64,
    deviation: impl Fn(f64) -> f64,
    [first, last]: [f64; 2],
) -> Posterior {
    let scores = curves.iter().flatten().filter(|it| !it.is_nan());
    let scores = scores.map(|it| (torque - it) / deviation(*it).max(LEAST_DEVIATION));
    let (low, high) = scores.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), score| {
        (low.min(score), high.max(score))
    });
    if low > high {
        return Posterior::Nowhere;
    } else if low > OFF {
        return Posterior::Above;
    } else if high < -OFF {
        return Posterior::Below;
    }
    let steps = curves.first().map_or(0, Vec::len) - 1;
    let mut masses = vec![0.0; steps];
    for curve in curves {
        for (mass, ends) in masses.iter_mut().zip(curve.windows(2)) {
            *mass += density(torque, [ends[0], ends[1]], &deviation);
        }
    }
    let sum: f64 = masses.iter().sum();
    if sum <= 0.0 {
        return Posterior::Nowhere;
    }
    let quantile = |share: f64| {
        let mut below = 0.0;
        let wanted = share * sum;
        let found = masses.iter().enumerate().find_map(|(step, mass)| {
            below += mass;
            (below >= wanted && *mass > 0.0).then(|| step as f64 + 1.0 - (below - wanted) / mass)
        });
        first + (last - first) * found.unwrap_or(steps as f64) / steps as f64
    };
    Posterior::Band(Band { low: quantile(0.025), median: quantile(0.5), high: quantile(0.975) })
}

/// Mean density of a torque over a step of a curve [1/(N·m)].
fn density(torque: f64, [start, end]: [f64; 2], deviation: impl Fn(f64) -> f64) -> f64 {
    /// Ends closer than this are one point [standard deviations].
    const CLOSE: f64 = 0.02;
    /// 1/√(2π).
    const HEIGHT: f64 = 0.398_942_280_401_432_7;
    if start.is_nan() || end.is_nan() {
        return 0.0;
    }
    let middle = 0.5 * (start + end);
    let deviation = deviation(middle).max(LEAST_DEVIATION);
    let score = |at: f64| (torque - at) / deviation;
    let (from, to) = (score(start), score(end));
    if (from - to).abs() < CLOSE {
        let score = score(middle);
        return HEIGHT * crate::elementary::exp(-0.5 * score * score) / deviation;
    }
    // On the side of small shares, where they keep their digits.
    let share = if from + to > 0.0 {
        normal_share(-to) - normal_share(-from)
    } else {
        normal_share(from) - normal_share(to)
    };
    share.abs() / (from - to).abs() / deviation
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(steps: u32) -> Vec<f64> {
        (0..=steps).map(|step| f64::from(step) / f64::from(steps)).collect()
    }

    fn band(curves: &[Vec<f64>], torque: f64, deviation: f64) -> Band {
        match posterior(curves, torque, |_| deviation, [0.0, 1.0]) {
            Posterior::Band(band) => band,
            other => panic!("{torque}: {other:?}"),
        }
    }

    /// Closed form: on a straight line the slip is normal about the torque, with the same
    /// deviation.
    #[test]
    fn a_straight_line_has_the_normal_interval() {
        for steps in [10, 240] {
            let band = band(&[line(steps)], 0.5, 0.1);
            // Steps of a tenth hold their mass as if it were even.
            let within = if steps == 10 { 4e-3 } else { 1e-5 };
            assert!((band.median - 0.5).abs() < 1e-12, "{band:?}");
            assert!((band.high - 0.5 - 0.1 * 1.959_964).abs() < within, "{band:?}");
            assert!((0.5 - band.low - 0.1 * 1.959_964).abs() < within, "{band:?}");
        }
    }

    /// Noise finer than a step leaves the step.
    #[test]
    fn noise_may_be_finer_than_a_step() {
        let band = band(&[line(20)], 0.512, 1e-9);
        assert!(band.low >= 0.5 && band.high <= 0.55, "{band:?}");
    }

    /// A level curve says nothing: the prior's middle 95 %. Of a curve with a peak both sides
    /// count.
    #[test]
    fn level_and_folded_curves_are_wide() {
        let level = band(&[vec![0.3; 101]], 0.3, 0.01);
        assert!((level.low - 0.025).abs() < 1e-12 && (level.high - 0.975).abs() < 1e-12);
        let peak: Vec<f64> = line(200).iter().map(|s| s * (1.0 - s)).collect();
        let folded = band(&[peak], 0.16, 1e-3);
        assert!((folded.low - 0.2).abs() < 0.01 && (folded.high - 0.8).abs() < 0.01, "{folded:?}");
    }

    #[test]
    fn a_torque_off_the_curve_has_no_slip() {
        let ask = |torque| posterior(&[line(50)], torque, |_| 0.05, [0.0, 1.0]);
        assert_eq!((ask(1.2), ask(-0.2)), (Posterior::Above, Posterior::Below));
        let nowhere = posterior(&[vec![f64::NAN; 9]], 0.1, |_| 0.05, [0.0, 1.0]);
        assert_eq!(nowhere, Posterior::Nowhere);
        let mut partly = line(50);
        partly[30..].fill(f64::NAN);
        assert!(band(&[partly], 0.55, 0.05).high <= 0.58);
    }
}
