//! Stiff problems with known ends, that integrators are tested on.

use super::super::SIZE;
use super::super::dormand_prince::explicit_step;
use super::super::rosenbrock::{Linear, implicit_step};
use super::super::step::{COUPLED, Numbers};
use super::Motion;
use super::way::Way;
use crate::elementary::{exp, sin, sin_cos};

/// How many numbers decide how long a step is ([`Motion::deciding`]).
pub(super) const DECIDING: usize = SIZE - 1;

/// Numbers<SIZE> that couple: the first two components that may.
pub(super) fn pair(one: f64, other: f64) -> Numbers<SIZE> {
    let mut numbers = [0.0; SIZE];
    (numbers[COUPLED.start], numbers[COUPLED.start + 1]) = (one, other);
    numbers
}

pub(super) fn of(numbers: &Numbers<SIZE>) -> (f64, f64) {
    (numbers[COUPLED.start], numbers[COUPLED.start + 1])
}

/// A problem of two numbers, as stiff as 1/ε, and where it is after a while.
pub(super) struct Problem {
    pub(super) name: &'static str,
    pub(super) rates: Box<dyn Fn(f64, f64) -> (f64, f64)>,
    pub(super) start: (f64, f64),
    pub(super) until: f64,
    pub(super) end: (f64, f64),
}

/// Kaps' problem. Source: Dekker and Verwer (1984), Stability of Runge-Kutta methods for stiff
/// nonlinear differential equations; its solution is (e⁻²ᵗ, e⁻ᵗ) for every ε.
pub(super) fn kaps(epsilon: f64) -> Problem {
    Problem {
        name: "Kaps",
        rates: Box::new(move |a, b| (-(1.0 / epsilon + 2.0) * a + b * b / epsilon, a - b - b * b)),
        start: (1.0, 1.0),
        until: 1.0,
        end: (exp(-2.0), exp(-1.0)),
    }
}

/// y' = −(y − sin t)/ε + cos t, with time as the other number: y = sin t. Source: Prothero and
/// Robinson (1974), Math. Comp. 28, 145-162.
pub(super) fn prothero_robinson(epsilon: f64) -> Problem {
    Problem {
        name: "Prothero-Robinson",
        rates: Box::new(move |t, y| {
            let (sin, cos) = sin_cos(t);
            (1.0, -(y - sin) / epsilon + cos)
        }),
        start: (0.0, 0.0),
        until: 2.0,
        end: (2.0, sin(2.0)),
    }
}

/// With ε = 1e-6. Source of the end: Mazzia and Magherini (2008), Test set for initial value
/// problem solvers, release 2.4, part II, problem VDPOL.
pub(super) fn van_der_pol() -> Problem {
    Problem {
        name: "van der Pol",
        rates: Box::new(|x, v| (v, ((1.0 - x * x) * v - x) / 1e-6)),
        start: (2.0, 0.0),
        until: 2.0,
        end: (1.706_167_732_170_483, -0.892_809_701_024_797_5),
    }
}

impl Problem {
    pub(super) fn rates(&self) -> impl Fn(&Numbers<SIZE>) -> Option<Numbers<SIZE>> + '_ {
        |numbers| {
            let (one, other) = of(numbers);
            let (one, other) = (self.rates)(one, other);
            Some(pair(one, other))
        }
    }

    pub(super) fn start(&self) -> (f64, Numbers<SIZE>) {
        (0.0, pair(self.start.0, self.start.1))
    }

    pub(super) fn miss(&self, numbers: &Numbers<SIZE>) -> f64 {
        let (one, other) = of(numbers);
        (one - self.end.0).abs().max((other - self.end.1).abs())
    }

    /// Where it is led, in how many explicit and implicit steps.
    pub(super) fn led(&self, tolerance: f64) -> (Numbers<SIZE>, [u32; 2]) {
        let motion = Motion {
            rates_at: self.rates(),
            coupled: COUPLED,
            deciding: DECIDING,
            is_level: false,
            tolerance,
        };
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
    pub(super) fn miss_with(&self, steps: u32, implicit: bool) -> f64 {
        let (_, mut now) = self.start();
        let span = self.until / f64::from(steps);
        for _ in 0..steps {
            let rates = self.rates()(&now).expect("it has rates");
            let step = if implicit {
                let linear = Linear::at(&now, rates, COUPLED, &self.rates()).expect("it has rates");
                implicit_step(&now, &linear, span, &self.rates())
            } else {
                explicit_step(&now, rates, span, COUPLED, &self.rates()).map(|it| it.step)
            };
            now = step.expect("it has rates").to;
        }
        self.miss(&now)
    }
}
