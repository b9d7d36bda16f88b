//! The classical Runge-Kutta method with a fixed step: the check on the implicit one.

use super::{OnSample, Point, SIZE, Stalled, rates_at};
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
    let mut y = start.to_array();
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
        if on_sample(time, &Point::from_array(&y)).is_break() {
            break;
        }
    }
    Ok(())
}

/// The point after a step *h* [s]; none where a stage has no rates.
fn stepped(equations: &Equations<'_>, y: &[f64; SIZE], h: f64) -> Option<[f64; SIZE]> {
    let k_1 = rates_at(equations, y)?;
    let k_2 = rates_at(equations, &moved(y, &k_1, 0.5 * h))?;
    let k_3 = rates_at(equations, &moved(y, &k_2, 0.5 * h))?;
    let k_4 = rates_at(equations, &moved(y, &k_3, h))?;
    let there: [f64; SIZE] =
        std::array::from_fn(|i| y[i] + h / 6.0 * (k_1[i] + 2.0 * k_2[i] + 2.0 * k_3[i] + k_4[i]));
    there.iter().all(|part| part.is_finite()).then_some(there)
}

fn moved(y: &[f64; SIZE], rates: &[f64; SIZE], span: f64) -> [f64; SIZE] {
    std::array::from_fn(|i| y[i] + span * rates[i])
}
