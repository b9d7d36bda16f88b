//! One step of an explicit method of order 5 with an embedded one of order 4 and a continuous
//! extension of order 4: half the work of an implicit step, where a step need not be longer than
//! the motion's fastest rate allows.
//!
//! Source: Dormand and Prince (1980), J. Comput. Appl. Math. 6, 19-26; the continuous extension is
//! Shampine's, as in Hairer, Norsett and Wanner (1993), Solving Ordinary Differential Equations I,
//! section II.6. The tests below hold the coefficients to the order conditions.

use std::ops::Range;

use super::step::{Numbers, Step, length, sum};

const STAGES: usize = 7;

/// Weights of earlier stages in a stage's point, *a_ij* [-]; the last row is the step.
const A: [[f64; STAGES]; STAGES] = [
    [0.0; STAGES],
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
];

/// Weights of the stages in the difference to the embedded step [-].
const E: [f64; STAGES] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Weights of the stages in the last bend of the continuous extension [-].
const D: [f64; STAGES] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// A step, and what was seen at its end.
pub(super) struct ExplicitStep<const N: usize> {
    pub(super) step: Step<N>,
    /// The rates there.
    pub(super) rates: Numbers<N>,
    /// The fastest rate at which the motion near it grows or dies out [1/s]: from two points of the
    /// same time. Source: Hairer and Wanner (1996), section IV.2.
    pub(super) fastest: f64,
}

/// A step of a span [s] from a point with its rates; None where a stage has no rates.
///
/// * `coupled`: the components whose fastest rate counts
pub(super) fn explicit_step<const N: usize>(
    from: &Numbers<N>,
    rates: Numbers<N>,
    span: f64,
    coupled: Range<usize>,
    rates_at: &impl Fn(&Numbers<N>) -> Option<Numbers<N>>,
) -> Option<ExplicitStep<N>> {
    // Each is a change over the whole span.
    let mut stages = [rates.map(|rate| span * rate); STAGES];
    let (mut to, mut before) = (*from, *from);
    for stage in 1..STAGES {
        before = to;
        to = sum(from, &A[stage], &stages[..stage]);
        stages[stage] = rates_at(&to)?.map(|rate| span * rate);
    }
    let error = sum(&[0.0; N], &E, &stages);
    let last = sum(&[0.0; N], &D, &stages);
    let [first, .., next_to_last, end] = stages;
    let one: Numbers<N> = std::array::from_fn(|i| first[i] - (to[i] - from[i]));
    let two = std::array::from_fn(|i| to[i] - from[i] - end[i] - one[i] + last[i]);
    let bends = [one, two, last.map(|part| -part)];
    // Places count for little within the time in which slip settles.
    let apart = |one: &Numbers<N>, other: &Numbers<N>| {
        let difference: Numbers<N> = std::array::from_fn(|i| one[i] - other[i]);
        length(&difference[coupled.clone()])
    };
    let turned = apart(&end, &next_to_last) / span;
    let apart = apart(&to, &before);
    let fastest = if apart > 0.0 { turned / apart } else { 0.0 };
    let rates = end.map(|change| change / span);
    to.iter().all(|part| part.is_finite()).then_some(ExplicitStep {
        step: Step { from: *from, to, bends, error },
        rates,
        fastest,
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::{SMatrix, SVector};

    use super::*;
    use crate::simulation::integrate::order_conditions::Method;

    type Weights = SVector<f64, STAGES>;

    fn method() -> Method<STAGES> {
        let points = SMatrix::from_fn(|row, column| A[row][column]);
        Method { points, lines: points }
    }

    fn step() -> Weights {
        Weights::from_column_slice(&A[STAGES - 1])
    }

    #[test]
    fn a_step_is_of_order_five_and_its_embedded_one_of_order_four() {
        method().check(&step(), 5, 1.0);
        method().check(&(step() - Weights::from_column_slice(&E)), 4, 1.0);
    }

    /// Its bends as weights of the stages: as in [`explicit_step`].
    #[test]
    fn the_continuous_extension_is_of_order_four() {
        let (first, end) = (Weights::ith(0, 1.0), Weights::ith(STAGES - 1, 1.0));
        let last = Weights::from_column_slice(&D);
        let one = first - step();
        let [two, three] = [step() - end - one + last, -last];
        for share in [0.1, 0.3, 0.5, 0.9] {
            let bend = one + (two + three * share) * share;
            let weights = (step() + bend * (1.0 - share)) * share;
            method().check(&weights, 4, share);
        }
    }
}
