//! The probability density that samples give to a number.

use crate::elementary::pow;
use crate::elementary::wide::hypot;

/// Degrees of freedom of the kernel [-]: a number that no sample is near still has a chance, so
/// that one miss does not decide a weight alone. Source: ours.
const FREEDOM: f64 = 4.0;
/// Γ(5/2)/(√(4π) Γ(2)): the density of Student's t with [`FREEDOM`] at its middle.
const AT_MIDDLE: f64 = 0.375;

/// The mean over the samples of a kernel about each of them.
///
/// The kernel's width is Silverman's for the samples' spread together with the noise of the number.
/// Samples without a bound have no density anywhere.
///
/// * `noise`: standard deviation with which the number was read, in its unit
pub(super) fn density(samples: &[f64], noise: f64, at: f64) -> f64 {
    let silverman = 0.9 * spread(samples) * pow(samples.len().max(1) as f64, -0.2);
    let width = hypot(silverman, noise);
    let kernel = |sample: &f64| {
        let t = (at - sample) / width;
        AT_MIDDLE / width * pow(1.0 + t * t / FREEDOM, -0.5 * (FREEDOM + 1.0))
    };
    samples.iter().map(kernel).sum::<f64>() / samples.len().max(1) as f64
}

/// The smaller of the standard deviation and of the middle half's width over that of a normal
/// distribution.
fn spread(samples: &[f64]) -> f64 {
    /// Width of a normal distribution's middle half, in standard deviations.
    const MIDDLE_HALF: f64 = 1.349;
    let mut sorted: Vec<f64> = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len().max(1) as f64;
    let mean = sorted.iter().sum::<f64>() / count;
    let squares = sorted.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    let quarter = |share| grouser_io::statistics::quantile(&sorted, share).unwrap_or(0.0);
    (squares / count).sqrt().min((quarter(0.75) - quarter(0.25)) / MIDDLE_HALF)
}
