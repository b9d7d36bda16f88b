//! Integration with steps of its own: explicit ones where slip settles, implicit ones of any length
//! once it has.
//!
//! Slip settles within milliseconds, and there the error asks for steps that an explicit method
//! takes as well, with half the work. Then the motion is smooth for minutes, and where a hub comes
//! to rest its fastest rate is millions a second: an explicit step would be as short. Both methods
//! are of order 5, take one step at a time and know nothing of the one before, so that a motion
//! begins anew at once where wheels change their speeds.

use std::ops::Range;

use super::dormand_prince::{ExplicitStep, explicit_step};
use super::exponential::exponential_step;
use super::rosenbrock::{Linear, implicit_step};
use super::step::{COUPLED, COUPLED_BY_PLACE, Numbers, Step};
use super::{OnSample, Point, SIZE, Stalled, WITH_MOTORS, rates_at};
use crate::elementary::pow;
use crate::simulation::equations::Equations;

/// Smallest error that a step may leave, besides the relative tolerance times the value, over that
/// tolerance: lengths [m], angles [rad] and speeds [m/s] far below what a rover notices, and
/// energies [J] to match, as the voltage [V] that a controller's integral adds.
///
/// * `coupled`: the components that the rates depend on; energies come after them
const fn small(index: usize, coupled: &Range<usize>) -> f64 {
    if index < coupled.end { 1e-3 } else { 1e-2 }
}

/// What an unfinished motion knows: the step it is in, which may reach beyond the last time that was
/// asked for. While the wheels keep their speeds it goes on there, as if it had never paused.
#[derive(Clone, Default)]
pub(in crate::simulation) struct History {
    known: Known,
    /// How long the first step was after the wheels last changed their speeds [s]: what they disturb the next time is
    /// often as much.
    first_span: Option<f64>,
}

/// What is known of a motion, by how many numbers move.
#[derive(Clone, Default)]
enum Known {
    #[default]
    Nothing,
    Ideal(Box<Way<SIZE>>),
    WithMotors(Box<Way<WITH_MOTORS>>),
}

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
    let coupled = if equations.is_uneven() { COUPLED_BY_PLACE } else { COUPLED };
    let coupled = coupled.start..coupled.end + more;
    let deciding = SIZE - 1 + more;
    let rates_at = |y: &Numbers<N>| rates_at(equations, y);
    let motion = Motion { rates_at, coupled, deciding, tolerance };
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

/// A motion on its way.
#[derive(Clone, Copy)]
struct Way<const N: usize> {
    /// The last step: when it began [s], how long it is [s], where it led, and how.
    start: f64,
    span: f64,
    step: Step<N>,
    implicit: bool,
    next: Outlook<N>,
    /// When and where the motion was last looked at.
    seen: (f64, Numbers<N>),
}

/// What is known of the next step.
#[derive(Clone, Copy)]
struct Outlook<const N: usize> {
    /// The rates at its start, if they were needed already.
    rates: Option<Numbers<N>>,
    /// How long it should be [s], and whether implicit.
    span: f64,
    implicit: bool,
    /// Steps of the same method since they last became markedly longer, and how long they were then
    /// [s].
    stagnant: (u32, f64),
}

impl<const N: usize> Outlook<N> {
    fn first(span: f64, implicit: bool) -> Self {
        Self { rates: None, span, implicit, stagnant: (0, span) }
    }

    /// What an explicit or an implicit step knows of the next one.
    ///
    /// * `span`: how long that may be for its error [s]
    /// * `fastest`: the fastest rate of the motion [1/s], from an explicit step at least its order
    fn after(self, implicit: bool, span: f64, fastest: f64) -> Self {
        let (count, length) = self.stagnant;
        let same = implicit == self.implicit && span <= LONGER * length;
        let (count, length) = if same { (count + 1, length) } else { (0, span) };
        let stuck = count >= STAGNANT;
        let stiff = span * fastest > if implicit { MILD } else { STIFF };
        if stiff && implicit && stuck {
            return Self::first(SETTLING / fastest, true);
        }
        let next = stiff || stuck && !implicit;
        Self { rates: None, span, implicit: next, stagnant: (count, length) }
    }
}

impl<const N: usize> Way<N> {
    fn end(&self) -> f64 {
        self.start + self.span
    }

    /// The point at a time [s] within the last step.
    fn look(&mut self, time: f64) -> Numbers<N> {
        let share = if time == self.end() { 1.0 } else { (time - self.start) / self.span };
        let point = self.step.at(share);
        self.seen = (time, point);
        point
    }
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
/// Error of the embedded step, which is of order 4, over that of the step itself, of order 5 [-]: at
/// least so much. Source: measured, see the tests below.
const EMBEDDED_EXCESS: f64 = 2.5;
/// The same of an exponential step, whose embedded one is of order 3 [-]. Source: measured, see the tests below.
const OVERESTIMATE: f64 = 25.0;
/// Steps that are longer than this, times the motion's fastest rate, are implicit: explicit ones
/// are stable up to 3.3. Source: Hairer and Wanner (1996), section IV.2.
const STIFF: f64 = 3.0;
/// Steps that are shorter than this, times the same, are explicit. Source: ours, half of it, so that
/// there is no swinging between both.
const MILD: f64 = 1.5;

/// Steps that after so many are not this many times as long as the first of them are stuck. Explicit
/// ones are then followed by an implicit one: their own estimate of the fastest rate may miss it,
/// and where slip settles steps become longer faster. Source: ours.
const STAGNANT: u32 = 8;
const LONGER: f64 = 1.5;
/// Implicit steps that are stuck are followed by one of this length, times the motion's fastest rate.
/// They are linear in the rates; where those have a kink, as where a hub all but rests, long steps
/// keep an error that no shorter one of them loses, and one that follows the fastest motion does.
const SETTLING: f64 = 0.5;

/// The span [s] that leads from one time to another, rounding included: it must not leave a rest of the way.
fn whole_span(now: f64, time: f64) -> f64 {
    let span = time - now;
    if now + span < time { span.next_up() } else { span }
}

/// A motion by its rates, to a tolerance.
struct Motion<F, const N: usize> {
    rates_at: F,
    /// The components that the rates depend on.
    coupled: Range<usize>,
    /// How many decide how long a step is: all but the electrical energy, which goes with the motors' work, and comes last.
    deciding: usize,
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
    /// As many steps as it takes to reach a time [s], at least one in all.
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

    /// The first steps of a motion, exponential ones: what new speeds of the wheels disturb dies out along an
    /// exponential. They lead to a time [s], or as far as a few of them do; none where the first fails.
    ///
    /// * `first_span`: how long the first step is to be [s], if that is known, and was afterwards
    fn set_off(
        &self,
        start: &(f64, Numbers<N>),
        time: f64,
        first_span: &mut Option<f64>,
        on_step: &dyn Fn(&Way<N>),
    ) -> Option<Way<N>> {
        /// Where more steps are needed, or one is shortened more often, motion is no exponential.
        const MOST_STEPS: u32 = 6;
        const MOST_SHORTENED: u32 = 2;
        let (mut now, mut from) = *start;
        let mut way: Option<Way<N>> = None;
        let mut longest = first_span.unwrap_or(f64::INFINITY);
        let mut rates = (self.rates_at)(&from)?;
        for _ in 0..MOST_STEPS {
            if now >= time {
                break;
            }
            let linear = Linear::at(&from, rates, self.coupled.clone(), &self.rates_at);
            let Some(linear) = linear else { break };
            let mut next = None;
            for _ in 0..=MOST_SHORTENED {
                let span = whole_span(now, time).min(longest);
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
                longest = factor * span;
                // No stage is where the step ends: there must be rates, too.
                if let Some(step) = step.filter(|_| miss <= 1.0)
                    && let Some(there) = (self.rates_at)(&step.to)
                {
                    rates = there;
                    let outlook = Outlook { rates: Some(there), ..Outlook::first(longest, true) };
                    let (start, seen) = (now, (now, from));
                    next = Some(Way { start, span, step, implicit: true, next: outlook, seen });
                    break;
                }
                longest = longest.min(span);
            }
            let Some(next) = next else { break };
            on_step(&next);
            if way.is_none() {
                *first_span = Some(next.next.span.min(next.span / CAUTION));
            }
            (now, from) = (next.end(), next.step.to);
            way = Some(next);
        }
        if let Some(way) = way.as_mut().filter(|_| now < time) {
            way.next = Outlook { rates: Some(rates), ..self.first_outlook(&from, &rates) };
        }
        way
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
                    let next = Outlook { rates, ..outlook.after(implicit, factor * span, fastest) };
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

    /// A step's error over what is allowed, as a root mean square over the components that decide.
    ///
    /// * `excess`: of the estimate over the error [-], at least
    fn miss(&self, step: &Step<N>, excess: f64) -> f64 {
        let part = |i: usize| {
            let size = step.from[i].abs().max(step.to[i].abs()) + small(i, &self.coupled);
            let miss = step.error[i] / (excess * self.tolerance * size);
            miss * miss
        };
        ((0..self.deciding).map(part).sum::<f64>() / self.deciding as f64).sqrt()
    }

    /// How long the first step of a motion should be. What the wheels' new speeds disturb dies out
    /// at a rate λ, the second derivative over the first, from a size |f| / λ, and a step of order
    /// 4 misses a share c (λ h)⁵ of that.
    fn first_outlook(&self, from: &Numbers<N>, rates: &Numbers<N>) -> Outlook<N> {
        /// *c* [-]: the explicit method's greatest breach of a condition of order 5, in its embedded
        /// step.
        const SHARE: f64 = 1e-3;
        /// Length of the trial that finds the second derivative, over the size of the motion [-].
        const TRIAL: f64 = 1e-3;
        let size = |rates: &Numbers<N>| {
            let part = |i: usize| rates[i].abs() / (from[i].abs() + small(i, &self.coupled));
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
    use super::*;

    const DECIDING: usize = SIZE - 1;

    /// Numbers<SIZE> that couple: the first two components that may.
    fn pair(one: f64, other: f64) -> Numbers<SIZE> {
        let mut numbers = [0.0; SIZE];
        (numbers[COUPLED.start], numbers[COUPLED.start + 1]) = (one, other);
        numbers
    }

    fn of(numbers: &Numbers<SIZE>) -> (f64, f64) {
        (numbers[COUPLED.start], numbers[COUPLED.start + 1])
    }

    /// A problem of two numbers, as stiff as 1/ε, and where it is after a while.
    struct Problem {
        name: &'static str,
        rates: Box<dyn Fn(f64, f64) -> (f64, f64)>,
        start: (f64, f64),
        until: f64,
        end: (f64, f64),
    }

    /// Kaps' problem. Source: Dekker and Verwer (1984), Stability of Runge-Kutta methods for stiff
    /// nonlinear differential equations; its solution is (e⁻²ᵗ, e⁻ᵗ) for every ε.
    fn kaps(epsilon: f64) -> Problem {
        Problem {
            name: "Kaps",
            rates: Box::new(move |a, b| {
                (-(1.0 / epsilon + 2.0) * a + b * b / epsilon, a - b - b * b)
            }),
            start: (1.0, 1.0),
            until: 1.0,
            end: ((-2.0_f64).exp(), (-1.0_f64).exp()),
        }
    }

    /// y' = −(y − sin t)/ε + cos t, with time as the other number: y = sin t. Source: Prothero and
    /// Robinson (1974), Math. Comp. 28, 145-162.
    fn prothero_robinson(epsilon: f64) -> Problem {
        Problem {
            name: "Prothero-Robinson",
            rates: Box::new(move |t, y| (1.0, -(y - t.sin()) / epsilon + t.cos())),
            start: (0.0, 0.0),
            until: 2.0,
            end: (2.0, 2.0_f64.sin()),
        }
    }

    /// With ε = 1e-6. Source of the end: Mazzia and Magherini (2008), Test set for initial value
    /// problem solvers, release 2.4, part II, problem VDPOL.
    fn van_der_pol() -> Problem {
        Problem {
            name: "van der Pol",
            rates: Box::new(|x, v| (v, ((1.0 - x * x) * v - x) / 1e-6)),
            start: (2.0, 0.0),
            until: 2.0,
            end: (1.706_167_732_170_483, -0.892_809_701_024_797_5),
        }
    }

    impl Problem {
        fn rates(&self) -> impl Fn(&Numbers<SIZE>) -> Option<Numbers<SIZE>> + '_ {
            |numbers| {
                let (one, other) = of(numbers);
                let (one, other) = (self.rates)(one, other);
                Some(pair(one, other))
            }
        }

        fn start(&self) -> (f64, Numbers<SIZE>) {
            (0.0, pair(self.start.0, self.start.1))
        }

        fn miss(&self, numbers: &Numbers<SIZE>) -> f64 {
            let (one, other) = of(numbers);
            (one - self.end.0).abs().max((other - self.end.1).abs())
        }

        /// Where it is led, in how many explicit and implicit steps.
        fn led(&self, tolerance: f64) -> (Numbers<SIZE>, [u32; 2]) {
            let motion =
                Motion { rates_at: self.rates(), coupled: COUPLED, deciding: DECIDING, tolerance };
            let counts = std::cell::Cell::new([0, 0]);
            let count = |way: &Way<SIZE>| {
                let mut now = counts.get();
                now[usize::from(way.implicit)] += 1;
                counts.set(now);
            };
            let way = motion.reach(&self.start(), None, self.until, &count);
            (way.expect("it can be led").look(self.until), counts.get())
        }

        /// How much it is missed by so many equal steps of one method.
        fn miss_with(&self, steps: u32, implicit: bool) -> f64 {
            let (_, mut now) = self.start();
            let span = self.until / f64::from(steps);
            for _ in 0..steps {
                let rates = self.rates()(&now).expect("it has rates");
                let step = if implicit {
                    let linear =
                        Linear::at(&now, rates, COUPLED, &self.rates()).expect("it has rates");
                    implicit_step(&now, &linear, span, &self.rates())
                } else {
                    explicit_step(&now, rates, span, COUPLED, &self.rates()).map(|it| it.step)
                };
                now = step.expect("it has rates").to;
            }
            self.miss(&now)
        }
    }

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

    /// What [`OVERESTIMATE`] promises, for motions that settle as slip does: steps that are taken are as exact as the
    /// tolerance.
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

    /// Points within steps are as near, however long those are.
    #[test]
    fn points_on_the_way_are_as_near() {
        let problem = kaps(1e-4);
        let motion = Motion {
            rates_at: problem.rates(),
            coupled: COUPLED,
            deciding: DECIDING,
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
        let motion = Motion { rates_at, coupled: COUPLED, deciding: DECIDING, tolerance: 1e-6 };
        let stalled = motion.reach(&(0.0, [0.0; SIZE]), None, 2.0, &|_| {}).err().expect("it ends");
        assert!((stalled.time - 1.0).abs() < 1e-6, "{stalled:?}");
        let from_nowhere = motion.reach(&(0.5, pair(3.0, 0.0)), None, 2.0, &|_| {});
        assert_eq!(from_nowhere.err().map(|stalled| stalled.time), Some(0.5));
        for wild in [f64::NAN, f64::INFINITY, f64::MAX] {
            let rates_at = |numbers: &Numbers<SIZE>| Some(pair(wild * (1.0 + of(numbers).0), wild));
            let motion = Motion { rates_at, coupled: COUPLED, deciding: DECIDING, tolerance: 1e-6 };
            assert!(motion.reach(&(0.0, [0.0; SIZE]), None, 1.0, &|_| {}).is_err(), "{wild}");
        }
        for tolerance in [f64::MIN_POSITIVE, 1e300] {
            let problem = kaps(1e-3);
            let motion = Motion {
                rates_at: problem.rates(),
                coupled: COUPLED,
                deciding: DECIDING,
                tolerance,
            };
            let led = motion.reach(&problem.start(), None, 1.0, &|_| {});
            assert_eq!(led.is_ok(), tolerance > 1.0, "a tolerance of {tolerance:e}");
        }
    }
}
