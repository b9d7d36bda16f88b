//! The first steps after wheels have changed their speeds: exponential ones.
//!
//! What new speeds disturb dies out along an exponential. Where it is little, one or two such steps
//! lead to the next steady slip; where they do not, the motion goes on as [`adaptive`](super) has
//! it.

use super::super::exponential::exponential_step;
use super::super::rosenbrock::Linear;
use super::super::step::Numbers;
use super::way::{Outlook, Way};
use super::{CAUTION, GROWTH, Motion, RETREAT, SHORTEST};
use crate::elementary::pow;

/// Error of the embedded step, which is of order 3, over that of the step itself, of order 4 [-]:
/// at least so much. Source: measured, see the tests below.
const OVERESTIMATE: f64 = 25.0;

impl<F: Fn(&Numbers<N>) -> Option<Numbers<N>>, const N: usize> Motion<F, N> {
    /// The first steps of a motion. They lead to a time [s], or as far as a few of them do; none
    /// where the first fails.
    ///
    /// * `first_span`: how long the first step is to be [s], if that is known, and was afterwards
    /// * `on_step`: called for each step
    pub(super) fn set_off(
        &self,
        start: &(f64, Numbers<N>),
        time: f64,
        first_span: &mut Option<f64>,
        on_step: &dyn Fn(&Way<N>),
    ) -> Option<Way<N>> {
        /// Where more steps are needed, motion is no exponential.
        const MOST_STEPS: u32 = 6;
        let (mut now, mut from) = *start;
        let mut way: Option<Way<N>> = None;
        let mut longest = first_span.unwrap_or(f64::INFINITY);
        let mut rates = (self.rates_at)(&from)?;
        for _ in 0..MOST_STEPS {
            if now >= time {
                break;
            }
            let next = self.exponential_way(&(now, from), rates, time, &mut longest);
            let Some((next, there)) = next else { break };
            on_step(&next);
            if way.is_none() {
                *first_span = Some(next.next.span.min(next.span / CAUTION));
            }
            (now, from, rates) = (next.end(), next.step.to, there);
            way = Some(next);
        }
        if let Some(way) = way.as_mut().filter(|_| now < time) {
            way.next = Outlook { rates: Some(rates), ..self.first_outlook(&from, &rates) };
        }
        way
    }

    /// An exponential step up to a time [s] at most, and the rates at its end; none where there is
    /// no such step that is exact enough.
    ///
    /// * `rates`: where it begins
    /// * `longest`: how long it may be [s], and the next one afterwards
    fn exponential_way(
        &self,
        &(now, from): &(f64, Numbers<N>),
        rates: Numbers<N>,
        time: f64,
        longest: &mut f64,
    ) -> Option<(Way<N>, Numbers<N>)> {
        /// Where a step is shortened more often, motion is no exponential.
        const MOST_SHORTENED: u32 = 2;
        let linear = Linear::at(&from, rates, self.coupled.clone(), &self.rates_at)?;
        for _ in 0..=MOST_SHORTENED {
            let span = whole_span(now, time).min(*longest);
            if span < SHORTEST {
                break;
            }
            let step = exponential_step(&from, &linear, span, &self.rates_at);
            let miss = step.as_ref().map_or(f64::NAN, |step| self.miss(step, OVERESTIMATE));
            let factor = if miss.is_finite() {
                (CAUTION * pow(miss.max(f64::EPSILON), -0.25)).clamp(GROWTH.0, GROWTH.1)
            } else {
                RETREAT
            };
            *longest = factor * span;
            // No stage is where the step ends: there must be rates, too.
            if let Some(step) = step.filter(|_| miss <= 1.0)
                && let Some(there) = (self.rates_at)(&step.to)
            {
                let next = Outlook { rates: Some(there), ..Outlook::first(*longest, true) };
                let way = Way { start: now, span, step, implicit: true, next, seen: (now, from) };
                return Some((way, there));
            }
            *longest = longest.min(span);
        }
        None
    }
}

/// The span [s] that leads from one time to another, rounding included: it must not leave a rest of
/// the way.
fn whole_span(now: f64, time: f64) -> f64 {
    let span = time - now;
    if now + span < time { span.next_up() } else { span }
}

#[cfg(test)]
mod tests {
    use super::super::super::dormand_prince::explicit_step;
    use super::super::super::step::COUPLED;
    use super::super::problems::{Problem, kaps, of};
    use super::*;

    /// What [`OVERESTIMATE`] promises, for motions that settle as slip does: steps that are taken
    /// are as exact as the tolerance.
    #[test]
    fn exponential_steps_that_are_taken_are_as_exact_as_the_tolerance() {
        let mut taken = 0;
        for epsilon in [1e-2, 1e-3, 1e-4] {
            for shift in [1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3] {
                let problem = Problem { start: (1.0, 1.0 + shift), ..kaps(epsilon) };
                let (_, from) = problem.start();
                let rates_at = problem.rates();
                let rates = rates_at(&from).expect("it has rates");
                let linear = Linear::at(&from, rates, COUPLED, &rates_at).expect("it has rates");
                for lengths in [0.5, 2.0, 10.0, 50.0] {
                    let span = lengths * epsilon;
                    let step = exponential_step(&from, &linear, span, &rates_at).expect("rates");
                    let mut exact = from;
                    for _ in 0..1000 {
                        let rates = rates_at(&exact).expect("it has rates");
                        let part = span / 1000.0;
                        let small = explicit_step(&exact, rates, part, COUPLED, &rates_at);
                        exact = small.expect("it has rates").step.to;
                    }
                    let apart = |i: usize| (step.to[i] - exact[i]).abs();
                    let error = apart(COUPLED.start).max(apart(COUPLED.start + 1));
                    let (one, other) = of(&step.error);
                    let estimate = one.abs().max(other.abs());
                    for tolerance in [1e-6, 1e-7] {
                        let is_taken = estimate < OVERESTIMATE * tolerance;
                        taken += i32::from(is_taken);
                        assert!(
                            !is_taken || error < tolerance,
                            "{epsilon:e}, {shift:e}, {lengths}: {error:e} of {estimate:e}"
                        );
                    }
                }
            }
        }
        assert!(taken > 50, "{taken}");
    }
}
