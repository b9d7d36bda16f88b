//! Integration with steps of its own: explicit ones where slip settles, implicit ones of any length
//! once it has.
//!
//! Slip settles within milliseconds, and there the error asks for steps that an explicit method
//! takes as well, with half the work. Then the motion is smooth for minutes, and where a hub comes
//! to rest its fastest rate is millions a second: an explicit step would be as short. Both methods
//! are of order 5, take one step at a time and know nothing of the one before, so that a motion
//! begins anew at once where wheels change their speeds.
//!
//! `setting_off` has the exponential steps with which it begins, `way` what one step knows of the
//! next.

#[cfg(test)]
mod problems;
mod setting_off;
mod way;

use std::ops::Range;

use self::way::{Outlook, STIFF, Way};
use super::dormand_prince::{ExplicitStep, explicit_step};
use super::rosenbrock::{Linear, implicit_step};
use super::step::{COUPLED, COUPLED_BY_PLACE, Numbers, Step};
use super::{OnSample, Point, SIZE, Stalled, WITH_MOTORS, rates_at};
use crate::elementary::{pow, wide};
use crate::simulation::equations::Equations;
use crate::stored::stored;

/// Smallest error that a step may leave, besides the relative tolerance times the value, over that
/// tolerance: lengths [m], angles [rad] and speeds [m/s] far below what a rover notices, and
/// energies [J] to match, as the voltage [V] that a controller's integral adds.
///
/// * `coupled`: the components that the rates depend on; energies come after them
const fn small(index: usize, coupled: &Range<usize>) -> f64 {
    if index < coupled.end { 1e-3 } else { 1e-2 }
}

/// What an unfinished motion knows: the step it is in, which may reach beyond the last time that
/// was asked for. While the wheels keep their speeds it goes on there, as if it had never paused.
#[derive(Clone, Default)]
pub(in crate::simulation) struct History {
    known: Known,
    /// How long the first step was after the wheels last changed their speeds [s]: what they
    /// disturb the next time is often as much.
    first_span: Option<f64>,
}

stored!(struct History { known, first_span });

/// What is known of a motion, by how many numbers move.
#[derive(Clone, Default)]
enum Known {
    #[default]
    Nothing,
    Ideal(Box<Way<SIZE>>),
    WithMotors(Box<Way<WITH_MOTORS>>),
}

stored!(enum Known { 0 => Nothing, 1 => Ideal(way), 2 => WithMotors(way) });

impl History {
    /// Forgets it but for the length of its first step: what comes is another motion.
    pub(in crate::simulation) fn clear(&mut self) {
        self.known = Known::Nothing;
    }
}

/// Integration with steps of its own, from `start` through all `times`.
///
/// * `history`: of the motion so far, and afterwards of this one
///
/// # Errors
/// [`Stalled`] where no step is small enough.
pub(in crate::simulation) fn adaptive(
    equations: &Equations<'_>,
    start: &Point,
    start_time: f64,
    times: &[f64],
    tolerance: f64,
    history: &mut History,
    on_sample: &mut OnSample<'_>,
) -> Result<(), Stalled> {
    let known = std::mem::take(&mut history.known);
    let first_span = &mut history.first_span;
    history.known = if start.turning.is_none() {
        let known = if let Known::Ideal(way) = known { Some(*way) } else { None };
        let from = (start_time, start.to_array::<SIZE>());
        let led = led(equations, from, (known, first_span), times, tolerance, on_sample)?;
        led.map_or(Known::Nothing, |way| Known::Ideal(Box::new(way)))
    } else {
        let known = if let Known::WithMotors(way) = known { Some(*way) } else { None };
        let from = (start_time, start.to_array::<WITH_MOTORS>());
        let led = led(equations, from, (known, first_span), times, tolerance, on_sample)?;
        led.map_or(Known::Nothing, |way| Known::WithMotors(Box::new(way)))
    };
    Ok(())
}

/// The same by how many numbers move; the way on which it may go on, unless it was ended.
fn led<const N: usize>(
    equations: &Equations<'_>,
    from: (f64, Numbers<N>),
    (known, first_span): (Option<Way<N>>, &mut Option<f64>),
    times: &[f64],
    tolerance: f64,
    on_sample: &mut OnSample<'_>,
) -> Result<Option<Way<N>>, Stalled> {
    let more = equations.moving_motors();
    let coupled = if equations.has_uneven_soil() || equations.has_relief() {
        COUPLED_BY_PLACE
    } else {
        COUPLED
    };
    let coupled = coupled.start..coupled.end + more;
    let deciding = SIZE - 1 + more;
    let rates_at = |y: &Numbers<N>| rates_at(equations, y);
    let is_level = equations.has_relief();
    let motion = Motion { rates_at, coupled, deciding, is_level, tolerance };
    let mut way = known.filter(|way| way.seen == from);
    let count = |step: &Way<N>| {
        equations.count(|work| {
            work.steps += 1;
            work.jacobians += u64::from(step.implicit);
        });
    };
    if let (None, Some(&time)) = (way, times.first()) {
        way = motion.set_off(&from, time, first_span, &count);
    }
    for &time in times {
        let mut here = motion.reach(&from, way, time, &count)?;
        let point = here.look(time);
        way = Some(here);
        if on_sample(time, &Point::from_array(&point, more)).is_break() {
            return Ok(None);
        }
    }
    Ok(way)
}

/// More steps than this between two samples mean that the motion chatters.
const MOST_STEPS: u32 = 100_000;
/// The shortest step [s]: a speed of a metre a second changes by less than its rounding.
const SHORTEST: f64 = 1e-13;
/// The longest first step [s], of a motion that has settled already.
const LONGEST_FIRST: f64 = 1.0;
/// The next step is aimed at this share of the length at which its error would be all that is
/// allowed. Source: Hairer and Wanner (1996), section IV.8, as is the order of the bounds.
const CAUTION: f64 = 0.9;
/// The next step is at least this much of the one before it, and at most this many times as long.
const GROWTH: (f64, f64) = (0.2, 8.0);
/// A step without rates at one of its stages is tried again with this share of its length.
const RETREAT: f64 = 0.25;
/// Error of the embedded step, which is of order 4, over that of the step itself, of order 5 [-]:
/// at least so much. Source: measured, see the tests below.
const EMBEDDED_EXCESS: f64 = 2.5;
/// A motion by its rates, to a tolerance.
struct Motion<F, const N: usize> {
    rates_at: F,
    /// The components that the rates depend on.
    coupled: Range<usize>,
    /// How many decide how long a step is: all but the electrical energy, which goes with the
    /// motors' work, and comes last.
    deciding: usize,
    /// Whether places are in level coordinates, whose axes mean nothing.
    is_level: bool,
    tolerance: f64,
}

/// A step that was tried.
struct Attempt<const N: usize> {
    step: Step<N>,
    /// The rates at its end, if they were needed.
    rates: Option<Numbers<N>>,
    /// The fastest rate of the motion near it [1/s].
    fastest: f64,
}

impl<F: Fn(&Numbers<N>) -> Option<Numbers<N>>, const N: usize> Motion<F, N> {
    /// Takes as many steps as are needed to reach a time [s], at least one in all.
    ///
    /// * `start`: when [s] and where the motion begins
    /// * `way`: how far it has come
    /// * `on_step`: called for each new step
    fn reach(
        &self,
        start: &(f64, Numbers<N>),
        mut way: Option<Way<N>>,
        time: f64,
        on_step: &dyn Fn(&Way<N>),
    ) -> Result<Way<N>, Stalled> {
        let mut steps = 0;
        loop {
            if let Some(way) = way.filter(|way| way.end() >= time) {
                return Ok(way);
            }
            if steps == MOST_STEPS {
                let time = way.map_or(start.0, |way| way.end());
                let reason = format!("{MOST_STEPS} steps did not reach the next sample");
                return Err(Stalled { time, reason });
            }
            let next = self.step(start, way.as_ref())?;
            on_step(&next);
            steps += 1;
            way = Some(next);
        }
    }

    /// The next step.
    ///
    /// * `start`: when [s] and where the motion begins
    /// * `way`: how far it has come
    fn step(&self, start: &(f64, Numbers<N>), way: Option<&Way<N>>) -> Result<Way<N>, Stalled> {
        let (now, from) = way.map_or(*start, |way| (way.end(), way.step.to));
        let stalled = |reason: &str| Stalled { time: now, reason: reason.to_owned() };
        let nowhere = || stalled("the rates of the motion have no value there");
        let known = way.and_then(|way| way.next.rates);
        let rates = known.or_else(|| (self.rates_at)(&from)).ok_or_else(nowhere)?;
        let outlook = way.map_or_else(|| self.first_outlook(&from, &rates), |way| way.next);
        let Outlook { mut span, implicit, .. } = outlook;
        let linear = if implicit {
            Some(
                Linear::at(&from, rates, self.coupled.clone(), &self.rates_at)
                    .ok_or_else(nowhere)?,
            )
        } else {
            None
        };
        let mut most = GROWTH.1;
        loop {
            if !(span >= SHORTEST && now + span > now) {
                return Err(stalled("a step of 1e-13 s is still too long"));
            }
            let attempt = self.attempt(&from, rates, linear.as_ref(), span);
            let miss = attempt.as_ref().map_or(f64::NAN, |it| self.miss(&it.step, EMBEDDED_EXCESS));
            let factor = if miss.is_finite() {
                // No error at all would be one to an infinite power.
                (CAUTION * pow(miss.max(f64::EPSILON), -0.2)).clamp(GROWTH.0, most)
            } else {
                RETREAT
            };
            match attempt {
                Some(Attempt { step, rates, fastest }) if miss <= 1.0 => {
                    let next = Outlook { rates, ..outlook.after(factor * span, fastest) };
                    return Ok(Way { start: now, span, step, implicit, next, seen: (now, from) });
                }
                _ => {
                    span *= factor;
                    most = 1.0;
                }
            }
        }
    }

    /// A step by the one or the other method; none where a stage has no rates.
    fn attempt(
        &self,
        from: &Numbers<N>,
        rates: Numbers<N>,
        linear: Option<&Linear<N>>,
        span: f64,
    ) -> Option<Attempt<N>> {
        if let Some(linear) = linear {
            let step = implicit_step(from, linear, span, &self.rates_at)?;
            return Some(Attempt { step, rates: None, fastest: linear.fastest() });
        }
        let ExplicitStep { step, rates, fastest } =
            explicit_step(from, rates, span, COUPLED.start..self.coupled.end, &self.rates_at)?;
        Some(Attempt { step, rates: Some(rates), fastest })
    }

    /// Size of a component. On level coordinates no result may depend on which way x points: places
    /// count by their distance from the start, and yaw as a radian.
    fn size(&self, numbers: &Numbers<N>, i: usize) -> f64 {
        match i {
            0 | 1 if self.is_level => wide::hypot(numbers[0], numbers[1]),
            2 if self.is_level => 1.0,
            _ => numbers[i].abs(),
        }
    }

    /// A step's error over what is allowed, as a root mean square over the components that decide.
    ///
    /// * `excess`: of the estimate over the error [-], at least
    fn miss(&self, step: &Step<N>, excess: f64) -> f64 {
        let part = |i: usize| {
            let size = self.size(&step.from, i).max(self.size(&step.to, i));
            let size = size + small(i, &self.coupled);
            let miss = step.error[i] / (excess * self.tolerance * size);
            miss * miss
        };
        ((0..self.deciding).map(part).sum::<f64>() / self.deciding as f64).sqrt()
    }

    /// How long the first step of a motion should be. What the wheels' new speeds disturb dies out
    /// at a rate λ, the second derivative over the first, from a size |f| / λ, and a step of order
    /// 4 misses a share c (λ h)⁵ of that.
    fn first_outlook(&self, from: &Numbers<N>, rates: &Numbers<N>) -> Outlook<N> {
        /// *c* [-]: the explicit method's greatest breach of a condition of order 5, in its
        /// embedded step.
        const SHARE: f64 = 1e-3;
        /// Length of the trial that finds the second derivative, over the size of the motion [-].
        const TRIAL: f64 = 1e-3;
        let size = |rates: &Numbers<N>| {
            let part = |i: usize| rates[i].abs() / (self.size(from, i) + small(i, &self.coupled));
            self.coupled.clone().map(part).fold(0.0, f64::max)
        };
        let first = size(rates);
        if first == 0.0 {
            return Outlook::first(LONGEST_FIRST, true);
        }
        let trial = TRIAL / first;
        let there = (self.rates_at)(&std::array::from_fn(|i| from[i] + trial * rates[i]));
        let Some(there) = there else {
            return Outlook::first(trial, false);
        };
        let second = size(&std::array::from_fn(|i| (there[i] - rates[i]) / trial));
        let dying = first / second;
        let excess = SHARE * first * dying / self.tolerance;
        let span = dying * pow(excess.max(f64::EPSILON), -0.2);
        // Neither is a number where both derivatives are out of bounds.
        let span = if span < LONGEST_FIRST { span } else { LONGEST_FIRST };
        let mild = span <= STIFF * dying;
        Outlook::first(span, !mild)
    }
}

#[cfg(test)]
mod tests {
    use super::problems::{DECIDING, Problem, kaps, of, pair, prothero_robinson, van_der_pol};
    use super::*;

    /// The order that is seen where steps are halved.
    fn order(problem: &Problem, steps: u32, implicit: bool) -> f64 {
        let miss = |steps| problem.miss_with(steps, implicit);
        (miss(steps) / miss(2 * steps)).log2()
    }

    #[test]
    fn both_methods_are_of_order_five_where_nothing_is_stiff() {
        for problem in [kaps(0.5), prothero_robinson(0.5)] {
            for implicit in [false, true] {
                let order = order(&problem, 8, implicit);
                assert!((4.6..6.5).contains(&order), "{} {implicit}: {order}", problem.name);
            }
        }
    }

    /// The order falls to 2 there, as of every method of this kind, but with ε before it: what is
    /// missed is less the stiffer the problem is. Source: Hairer and Wanner (1996), section VI.3.
    #[test]
    fn stiff_problems_are_missed_by_little() {
        for epsilon in [1e-3, 1e-4, 1e-5, 1e-6] {
            for problem in [kaps(epsilon), prothero_robinson(epsilon)] {
                for steps in [4, 8, 16, 32] {
                    let miss = problem.miss_with(steps, true);
                    let span = problem.until / f64::from(steps);
                    let bound = epsilon * span * span;
                    assert!(miss < bound, "{} {epsilon} {steps}: {miss:e}", problem.name);
                }
            }
        }
    }

    /// Tolerances are of a step; over all steps it is a few of them.
    #[test]
    fn stiff_problems_end_where_they_should() {
        for problem in [kaps(1e-6), prothero_robinson(1e-6), van_der_pol(), kaps(0.5)] {
            for tolerance in [1e-6, 1e-7, 1e-8, 1e-9] {
                let (end, steps) = problem.led(tolerance);
                let miss = problem.miss(&end);
                assert!(miss < 10.0 * tolerance, "{}: {miss:e}, {tolerance:e}", problem.name);
                assert!(steps[0] + steps[1] < 4000, "{}: {steps:?}", problem.name);
            }
        }
    }

    #[test]
    fn stiff_motions_take_implicit_steps_and_others_explicit_ones() {
        let [explicit, implicit] = kaps(0.5).led(1e-6).1;
        assert!(implicit <= 1, "{implicit} implicit steps, {explicit} explicit ones");
        let [explicit, implicit] = kaps(1e-6).led(1e-6).1;
        assert!(implicit > explicit, "{implicit} implicit steps, {explicit} explicit ones");
    }

    /// What [`EMBEDDED_EXCESS`] promises, for steps that a tolerance of 1e-6 takes.
    #[test]
    fn the_estimated_error_is_several_times_the_error() {
        for (problem, implicit) in [(kaps(0.5), false), (kaps(0.5), true), (kaps(1e-6), true)] {
            let (_, from) = problem.start();
            let rates = problem.rates()(&from).expect("it has rates");
            for span in [0.02, 0.05, 0.1] {
                let step = if implicit {
                    let linear =
                        Linear::at(&from, rates, COUPLED, &problem.rates()).expect("it has rates");
                    implicit_step(&from, &linear, span, &problem.rates())
                } else {
                    explicit_step(&from, rates, span, COUPLED, &problem.rates()).map(|it| it.step)
                };
                let step = step.expect("it has rates");
                let (one, other) = of(&step.to);
                let (one, other) = (one - (-2.0 * span).exp(), other - (-span).exp());
                let (estimate_one, estimate_other) = of(&step.error);
                let (error, estimate) = (one.hypot(other), estimate_one.hypot(estimate_other));
                assert!(
                    error * EMBEDDED_EXCESS < estimate.max(1e-12),
                    "{implicit}, {span} s: {error:e} of {estimate:e}"
                );
            }
        }
    }

    /// Points within steps are as near, however long those are.
    #[test]
    fn points_on_the_way_are_as_near() {
        let problem = kaps(1e-4);
        let motion = Motion {
            rates_at: problem.rates(),
            coupled: COUPLED,
            deciding: DECIDING,
            is_level: false,
            tolerance: 1e-6,
        };
        let mut way = None;
        for time in (1..=100).map(|count| 0.01 * f64::from(count)) {
            let mut here = motion.reach(&problem.start(), way, time, &|_| {}).expect("it is led");
            let (one, other) = of(&here.look(time));
            assert!((one - (-2.0 * time).exp()).abs() < 5e-6, "{one} at {time}");
            assert!((other - (-time).exp()).abs() < 5e-6, "{other} at {time}");
            way = Some(here);
        }
    }

    /// Rates that end, are nowhere, or are no numbers, stop the motion with its reason.
    #[test]
    fn motions_that_end_say_when_and_why() {
        let ends = |x: f64| (x < 1.0).then(|| pair(1.0, 0.0));
        let rates_at = |numbers: &Numbers<SIZE>| ends(of(numbers).0);
        let motion = Motion {
            rates_at,
            coupled: COUPLED,
            deciding: DECIDING,
            is_level: false,
            tolerance: 1e-6,
        };
        let stalled = motion.reach(&(0.0, [0.0; SIZE]), None, 2.0, &|_| {}).err().expect("it ends");
        assert!((stalled.time - 1.0).abs() < 1e-6, "{stalled:?}");
        let from_nowhere = motion.reach(&(0.5, pair(3.0, 0.0)), None, 2.0, &|_| {});
        assert_eq!(from_nowhere.err().map(|stalled| stalled.time), Some(0.5));
        for wild in [f64::NAN, f64::INFINITY, f64::MAX] {
            let rates_at = |numbers: &Numbers<SIZE>| Some(pair(wild * (1.0 + of(numbers).0), wild));
            let motion = Motion {
                rates_at,
                coupled: COUPLED,
                deciding: DECIDING,
                is_level: false,
                tolerance: 1e-6,
            };
            assert!(motion.reach(&(0.0, [0.0; SIZE]), None, 1.0, &|_| {}).is_err(), "{wild}");
        }
        for tolerance in [f64::MIN_POSITIVE, 1e300] {
            let problem = kaps(1e-3);
            let motion = Motion {
                rates_at: problem.rates(),
                coupled: COUPLED,
                deciding: DECIDING,
                is_level: false,
                tolerance,
            };
            let led = motion.reach(&problem.start(), None, 1.0, &|_| {});
            assert_eq!(led.is_ok(), tolerance > 1.0, "a tolerance of {tolerance:e}");
        }
    }
}
