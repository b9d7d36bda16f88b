//! The classical Runge-Kutta method with a fixed step: the check on the implicit one.

use super::{OnSample, Point, SIZE, Stalled, WITH_MOTORS, rates_at};
use crate::simulation::equations::Equations;

/// The classical Runge-Kutta method with a fixed step, shortened to meet each of the `times`.
///
/// # Errors
/// [`Stalled`] where a step leads to a state without rates.
pub(in crate::simulation) fn rk4(
    equations: &Equations<'_>,
    start: &Point,
    start_time: f64,
    times: &[f64],
    step: f64,
    on_sample: &mut OnSample<'_>,
) -> Result<(), Stalled> {
    if start.turning.is_none() {
        led(equations, start.to_array::<SIZE>(), start_time, times, step, on_sample)
    } else {
        led(equations, start.to_array::<WITH_MOTORS>(), start_time, times, step, on_sample)
    }
}

fn led<const N: usize>(
    equations: &Equations<'_>,
    start: [f64; N],
    start_time: f64,
    times: &[f64],
    step: f64,
    on_sample: &mut OnSample<'_>,
) -> Result<(), Stalled> {
    let mut y = start;
    let mut now = start_time;
    for &time in times {
        let mut left = ((time - now) / step).ceil().max(1.0);
        let h = (time - now) / left;
        while left > 0.0 {
            left -= 1.0;
            equations.count(|work| work.steps += 1);
            y = stepped(equations, &y, h)
                .ok_or_else(|| Stalled { time: now, reason: "the step led nowhere".into() })?;
        }
        now = time;
        if on_sample(time, &Point::from_array(&y, equations.moving_motors())).is_break() {
            break;
        }
    }
    Ok(())
}

/// The point after a step *h* [s]; none where a stage has no rates.
fn stepped<const N: usize>(equations: &Equations<'_>, y: &[f64; N], h: f64) -> Option<[f64; N]> {
    let k_1 = rates_at(equations, y)?;
    let k_2 = rates_at(equations, &moved(y, &k_1, 0.5 * h))?;
    let k_3 = rates_at(equations, &moved(y, &k_2, 0.5 * h))?;
    let k_4 = rates_at(equations, &moved(y, &k_3, h))?;
    let there: [f64; N] =
        std::array::from_fn(|i| y[i] + h / 6.0 * (k_1[i] + 2.0 * k_2[i] + 2.0 * k_3[i] + k_4[i]));
    there.iter().all(|part| part.is_finite()).then_some(there)
}

fn moved<const N: usize>(y: &[f64; N], rates: &[f64; N], span: f64) -> [f64; N] {
    std::array::from_fn(|i| y[i] + span * rates[i])
}
