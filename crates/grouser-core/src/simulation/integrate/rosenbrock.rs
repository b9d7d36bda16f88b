//! One step of a linearly implicit method: the Jacobian at its start, a linear solve for each
//! stage, an estimate of its error, and all points between its ends.
//!
//! Source: Hairer and Wanner (1996), Solving Ordinary Differential Equations II, section IV.7. No
//! step depends on the one before it, so that a motion may begin anew at any time.

use std::ops::Range;

use nalgebra::{DMatrix, DVector, Dyn, LU, Matrix4, Matrix6, U4, U6, Vector4, Vector6};

use super::rodas5p::{A, C, GAMMA, H, STAGES};
use super::step::{COUPLED, COUPLED_BY_PLACE, Numbers, Step, length, sum};

/// Step of the differences in a Jacobian [m, rad, m/s, rad/s]: forces are exact to 1e-12, and
/// change within the creep speed of 1e-6 m/s where a hub comes to rest.
const DIFFERENCE: f64 = 1e-9;

/// Motions with a faster rate than this [1/s] have a hub near rest: there differences to one side
/// are not exact enough for steps that are a thousand times as long, and both sides are taken.
const NEAR_REST: f64 = 1e4;

/// The motion near a point: its rates, and how they change with each coupled component.
pub(super) struct Linear<const N: usize> {
    pub(super) rates: Numbers<N>,
    coupled: Range<usize>,
    /// One for each coupled component, then nothing.
    columns: [Numbers<N>; N],
}

impl<const N: usize> Linear<N> {
    /// At a point with these rates, by differences towards where the motion goes: a wheel's forces
    /// have a kink where it does not slip sideways, and motions begin there. Backward ones serve
    /// where there are no rates ahead.
    ///
    /// None where there are no rates on both sides.
    ///
    /// * `coupled`: the components that the rates depend on
    pub(super) fn at(
        point: &Numbers<N>,
        rates: Numbers<N>,
        coupled: Range<usize>,
        rates_at: &impl Fn(&Numbers<N>) -> Option<Numbers<N>>,
    ) -> Option<Self> {
        let beside = |index: usize, step: f64| {
            let mut beside = *point;
            beside[index] += step;
            // What was added, after rounding.
            let step = beside[index] - point[index];
            rates_at(&beside).map(|there| (there, step))
        };
        let columns = [[0.0; N]; N];
        let mut linear = Self { rates, coupled: coupled.clone(), columns };
        let mut ahead = [(rates, 0.0); N];
        for (number, index) in coupled.clone().enumerate() {
            let forward = (DIFFERENCE * point[index].abs().max(1.0)).copysign(rates[index]);
            let (there, step) = beside(index, forward).or_else(|| beside(index, -forward))?;
            ahead[number] = (there, step);
            linear.columns[number] = std::array::from_fn(|i| (there[i] - rates[i]) / step);
        }
        let of_hubs = coupled.start..coupled.end.min(COUPLED.end);
        if linear.fastest_of(of_hubs) > NEAR_REST {
            for (number, index) in coupled.enumerate() {
                let (one, step) = ahead[number];
                if let Some((other, back)) = beside(index, -step) {
                    linear.columns[number] =
                        std::array::from_fn(|i| (one[i] - other[i]) / (step - back));
                }
            }
        }
        Some(linear)
    }

    /// The components that the rates depend on.
    pub(super) fn coupled(&self) -> Range<usize> {
        self.coupled.clone()
    }

    /// How the rates change with each of them.
    pub(super) fn columns(&self) -> &[Numbers<N>] {
        &self.columns[..self.coupled.len()]
    }

    /// The change of the rates along a direction, J v.
    pub(super) fn along(&self, direction: &Numbers<N>) -> Numbers<N> {
        let mut product = [0.0; N];
        for (column, index) in self.columns.iter().zip(self.coupled.clone()) {
            for (product, part) in product.iter_mut().zip(column) {
                *product += part * direction[index];
            }
        }
        product
    }

    /// The fastest rate at which the motion near the point grows or dies out [1/s], by the power
    /// method from the direction of the motion: in a mirror it is the same.
    pub(super) fn fastest(&self) -> f64 {
        self.fastest_of(self.coupled.clone())
    }

    /// The same of some coupled components, while the others stay.
    fn fastest_of(&self, components: Range<usize>) -> f64 {
        /// They serve a choice, not a result.
        const TIMES: usize = 16;
        let mut direction = self.rates;
        let mut fastest = 0.0;
        for _ in 0..TIMES {
            let length = length(&direction[components.clone()]);
            if length == 0.0 {
                break;
            }
            let mut along = [0.0; N];
            for index in components.clone() {
                along[index] = direction[index] / length;
            }
            direction = self.along(&along);
            fastest = super::step::length(&direction[components.clone()]);
        }
        fastest
    }
}

/// A step of a span [s] from a point; None where a stage has no rates.
///
/// Its error is the greater of two. At its end it is the last stage, which the embedded step of
/// order 4 does without. Halfway, the continuous extension does not move as the rates there demand:
/// what moves fast is pinned at the end of a step however long that is, and not on the way.
pub(super) fn implicit_step<const N: usize>(
    from: &Numbers<N>,
    linear: &Linear<N>,
    span: f64,
    rates_at: &impl Fn(&Numbers<N>) -> Option<Numbers<N>>,
) -> Option<Step<N>> {
    let system = System::new(linear, span);
    let mut stages = [[0.0; N]; STAGES];
    for stage in 0..STAGES {
        let mut side = match stage {
            0 => linear.rates,
            _ => rates_at(&sum(from, &A[stage], &stages))?,
        };
        let earlier = sum(&[0.0; N], &C[stage], &stages);
        for (side, earlier) in side.iter_mut().zip(earlier) {
            *side += earlier / span;
        }
        stages[stage] = system.solve(&side)?;
    }
    let error = stages[STAGES - 1];
    let embedded = sum(from, &A[STAGES - 1], &stages);
    let to: Numbers<N> = std::array::from_fn(|i| embedded[i] + error[i]);
    let bends = H.map(|weights| sum(&[0.0; N], &weights, &stages));
    let step = Step { from: *from, to, bends, error };
    let (halfway, moves) = (step.at(0.5), step.slope_halfway());
    let rates = rates_at(&halfway)?;
    let astray = system.solve(&std::array::from_fn(|i| rates[i] - moves[i] / span))?;
    let error = std::array::from_fn(|i| error[i].abs().max(astray[i].abs()));
    to.iter().all(|part| part.is_finite()).then_some(Step { error, ..step })
}

/// The linear equations of all stages of a step, 1/(h γ) − J.
struct System<'a, const N: usize> {
    linear: &'a Linear<N>,
    span: f64,
    coupled: Coupled,
}

/// Those of the coupled components.
enum Coupled {
    Everywhere(LU<f64, U4, U4>),
    ByPlace(LU<f64, U6, U6>),
    WithMotors(LU<f64, Dyn, Dyn>),
}

impl<'a, const N: usize> System<'a, N> {
    fn new(linear: &'a Linear<N>, span: f64) -> Self {
        let block = |row: usize, column: usize| {
            let diagonal = if row == column { 1.0 / (span * GAMMA) } else { 0.0 };
            diagonal - linear.columns[column][linear.coupled.start + row]
        };
        let coupled = match &linear.coupled {
            range if *range == COUPLED => Coupled::Everywhere(Matrix4::from_fn(block).lu()),
            range if *range == COUPLED_BY_PLACE => Coupled::ByPlace(Matrix6::from_fn(block).lu()),
            range => {
                let size = range.len();
                Coupled::WithMotors(DMatrix::from_fn(size, size, block).lu())
            }
        };
        Self { linear, span, coupled }
    }

    fn solve(&self, side: &Numbers<N>) -> Option<Numbers<N>> {
        let coupled = self.linear.coupled.clone();
        let mut solved = [0.0; N];
        let (part, side_part) = (&mut solved[coupled.clone()], &side[coupled.clone()]);
        match &self.coupled {
            Coupled::Everywhere(factors) => {
                let found = factors.solve(&Vector4::from_column_slice(side_part))?;
                part.copy_from_slice(found.as_slice());
            }
            Coupled::ByPlace(factors) => {
                let found = factors.solve(&Vector6::from_column_slice(side_part))?;
                part.copy_from_slice(found.as_slice());
            }
            Coupled::WithMotors(factors) => {
                let found = factors.solve(&DVector::from_column_slice(side_part))?;
                part.copy_from_slice(found.as_slice());
            }
        }
        // All others only gather what the coupled ones do.
        let gathered = self.linear.along(&solved);
        for index in (0..N).filter(|index| !coupled.contains(index)) {
            solved[index] = self.span * GAMMA * (side[index] + gathered[index]);
        }
        Some(solved)
    }
}
