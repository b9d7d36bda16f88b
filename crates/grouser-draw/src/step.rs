//! Round steps: how far apart lines are, how fast an animation is.

use grouser_core::elementary::wide;

/// The smallest of 0.001, 0.002, 0.005, 0.01 and so on that is not below a number.
///
/// ```
/// use grouser_draw::round_step;
///
/// assert_eq!([0.011, 0.5, 30.0].map(round_step), [0.02, 0.5, 50.0]);
/// ```
#[must_use]
pub fn round_step(least: f64) -> f64 {
    let mut steps = (-3..=9).flat_map(|power| {
        let power = wide::powi(10.0, power);
        [1.0, 2.0, 5.0].map(|step| step * power)
    });
    steps.find(|step| *step >= least).unwrap_or(least)
}
