//! Constrained minima by sequential least-squares programming (Kraft 1988): the one file that knows
//! the library that has it.

use std::cell::RefCell;
use std::convert::Infallible;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintJacobian, ConstraintSet, ConstraintSolveError,
    Constraints, CostFunction, DenseMatrix, Executor, Gradient, NoLinearConstraints,
    NoNonlinearBlock, NonlinearBlock, NonlinearBlocks, NonlinearInequalityValues,
    SelectedFirstOrderState, Slsqp, State, TerminationCode,
};

/// A smooth problem over the unit cube.
pub(super) trait Smooth {
    /// How many numbers are free.
    fn free(&self) -> usize;
    /// How many constraints there are.
    fn constraints(&self) -> usize;
    /// What is to be least at a point, then what must not be above 0; none where there are none.
    fn results(&self, point: &[f64]) -> Option<Vec<f64>>;
    /// The derivatives of each of these results by all free numbers.
    fn gradients(&self, point: &[f64], results: &[f64]) -> Option<Vec<Vec<f64>>>;
}

/// How long a search goes on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// What objective and constraints are to be exact to.
    pub(super) accuracy: f64,
    /// Iterations after which a search is given up.
    pub(super) most_steps: u64,
}

impl Effort {
    /// For values that are smooth but for a few kinks.
    pub(super) const SMOOTH: Self = Self { accuracy: 1e-9, most_steps: 200 };
    /// For means over samples, each with kinks of its own.
    pub(super) const SAMPLED: Self = Self { accuracy: 1e-5, most_steps: 40 };
}

/// A constrained minimum.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Minimum {
    /// Where it is, in the unit cube.
    pub(super) point: Vec<f64>,
    /// The objective there.
    pub(super) objective: f64,
    /// By how much the objective would fall if a constraint were loosened by one.
    pub(super) multipliers: Vec<f64>,
}

/// The minimum to which a search from a start leads; nothing where it gives up.
pub(super) fn minimum(problem: &dyn Smooth, start: &[f64], effort: Effort) -> Option<Minimum> {
    let Effort { accuracy, most_steps } = effort;
    // A constraint that is missed by less is kept.
    let kept = 100.0 * accuracy;
    let count = problem.free();
    let (low, high) = (vec![0.0; count], vec![1.0; count]);
    let adapted = Adapted { problem, low, high, last: RefCell::default() };
    let solver = Slsqp::new().with_absolute_accuracy_tolerance(accuracy);
    let state = SelectedFirstOrderState::new(start.to_vec());
    let found =
        Executor::new(adapted, solver, state).max_iter(most_steps).run_with_solver().ok()?;
    let point = found.state.param().clone();
    // Near a minimum, steps end where values are no longer exact: whether it is one is looked at
    // by the designs around it.
    let keeps = || problem.results(&point).is_some_and(|it| it[1..].iter().all(|it| *it < kept));
    if found.report.code() != TerminationCode::SolverConverged && !keeps() {
        return None;
    }
    Some(Minimum {
        point,
        objective: found.state.cost(),
        multipliers: found.solver.inequality_multipliers().map(<[f64]>::to_vec).unwrap_or_default(),
    })
}

/// The problem as the library wants it. It asks for the values at one point one after the other, and
/// for derivatives only at points that it goes on from.
struct Adapted<'a> {
    problem: &'a dyn Smooth,
    low: Vec<f64>,
    high: Vec<f64>,
    last: RefCell<Option<Known>>,
}

/// What is known at a point.
struct Known {
    point: Vec<f64>,
    values: Vec<f64>,
    gradients: Option<Vec<Vec<f64>>>,
}

impl Adapted<'_> {
    fn values<T>(&self, point: &[f64], of: impl FnOnce(&[f64]) -> T) -> T {
        let mut last = self.last.borrow_mut();
        of(&self.known(&mut last, point).values)
    }

    fn gradients<T>(&self, point: &[f64], of: impl FnOnce(&[Vec<f64>]) -> T) -> T {
        let mut last = self.last.borrow_mut();
        let known = self.known(&mut last, point);
        let found = || self.problem.gradients(point, &known.values);
        // What stands for none: no step is taken to where they are not finite.
        let none = || vec![vec![f64::NAN; self.problem.free()]; self.problem.constraints() + 1];
        let gradients = known.gradients.take().or_else(found).unwrap_or_else(none);
        of(known.gradients.insert(gradients))
    }

    fn known<'k>(&self, last: &'k mut Option<Known>, point: &[f64]) -> &'k mut Known {
        if last.as_ref().is_none_or(|it| it.point != point) {
            let none = || vec![f64::NAN; self.problem.constraints() + 1];
            let values = self.problem.results(point).unwrap_or_else(none);
            *last = Some(Known { point: point.to_vec(), values, gradients: None });
        }
        last.as_mut().expect("it was set")
    }
}

type Set = ConstraintSet<
    BoxBounds<Vec<f64>>,
    NoLinearConstraints,
    NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>,
>;

impl Constraints for Adapted<'_> {
    type Set = Set;

    fn constraints(&self) -> <Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new()
            .with_bounds(BoxBounds::new(Some(&self.low), Some(&self.high)))
            .with_nonlinear_inequalities(self.problem.constraints())
    }
}

impl CostFunction for Adapted<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(self.values(point, |it| it[0]))
    }
}

impl Gradient for Adapted<'_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, point: &Vec<f64>) -> Result<Vec<f64>, Infallible> {
        Ok(self.gradients(point, |it| it[0].clone()))
    }
}

impl NonlinearInequalityValues for Adapted<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;

    fn nonlinear_inequalities(
        &self,
        point: &Vec<f64>,
    ) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        Ok(self.values(point, |it| it[1..].to_vec()))
    }
}

impl ConstraintJacobian for Adapted<'_> {
    type Param = Vec<f64>;
    type Jacobian = DenseMatrix;
    type Error = Infallible;

    fn constraint_jacobian(
        &self,
        point: &Vec<f64>,
    ) -> Result<DenseMatrix, ConstraintSolveError<Infallible>> {
        let rows = self.gradients(point, |it| it[1..].concat());
        Ok(DenseMatrix::from_row_slice(self.problem.constraints(), self.problem.free(), &rows))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn minimum(problem: &dyn Smooth, start: &[f64]) -> Option<Minimum> {
        super::minimum(problem, start, Effort::SMOOTH)
    }

    /// A rectangle of least boundary with an area of at least 1/4, no wider than it may be: x + y
    /// with 1/4 − x y ≤ 0 and x − most ≤ 0.
    struct Rectangle {
        most: f64,
    }

    impl Smooth for Rectangle {
        fn free(&self) -> usize {
            2
        }

        fn constraints(&self) -> usize {
            2
        }

        fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
            let [x, y] = [point[0], point[1]];
            Some(vec![x + y, 0.25 - x * y, x - self.most])
        }

        fn gradients(&self, point: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
            Some(vec![vec![1.0, 1.0], vec![-point[1], -point[0]], vec![1.0, 0.0]])
        }
    }

    #[test]
    fn a_square_has_the_least_boundary_from_any_start() {
        for start in [[0.9, 0.9], [0.1, 0.9], [0.5, 0.2], [0.1, 0.1]] {
            let found = minimum(&Rectangle { most: 2.0 }, &start).expect("a minimum");
            assert!(found.point.iter().all(|it| (it - 0.5).abs() < 1e-5), "{start:?}: {found:?}");
            // d(2 √A)/dA at A = 1/4.
            assert!((found.multipliers[0] - 2.0).abs() < 1e-5, "{found:?}");
            assert!(found.multipliers[1].abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn what_holds_it_back_has_a_price() {
        let found = minimum(&Rectangle { most: 0.4 }, &[0.3, 0.9]).expect("a minimum");
        assert!((found.point[0] - 0.4).abs() < 1e-7 && (found.point[1] - 0.625).abs() < 1e-7);
        // x + A/x: the price of its width is 1 − A/x², that of its area 1/x.
        assert!((found.multipliers[0] - 2.5).abs() < 1e-5, "{found:?}");
        assert!((found.multipliers[1] - 0.5625).abs() < 1e-5, "{found:?}");
    }

    /// A towed wheel on Bekker's soil with n = 1: the least of its sheet's mass and of the work that it
    /// takes, c r b + R with R = b k z²/2, while it sinks by z = (3 W/(2 k b √(2 r)))^(2/3), no deeper
    /// than it may. A point says where its radius and its width lie between a hundredth of a metre
    /// and a metre.
    struct TowedWheel {
        deepest: f64,
    }

    impl TowedWheel {
        const LOAD: f64 = 50.0;
        const STIFFNESS: f64 = 2e6;
        /// What a square metre of r b counts.
        const MASS: f64 = 400.0;

        fn outcome(&self, [radius, width]: [f64; 2]) -> [f64; 2] {
            let sinkage =
                3.0 * Self::LOAD / (2.0 * Self::STIFFNESS * width * (2.0 * radius).sqrt());
            let sinkage = sinkage.powf(2.0 / 3.0);
            let resistance = width * Self::STIFFNESS * sinkage * sinkage / 2.0;
            let aim = Self::MASS * radius * width + resistance;
            [aim, sinkage / self.deepest - 1.0]
        }

        /// Where b √r = p keeps the sinkage, the aim is A b + c p²/b with A = k z²/2: its least is at
        /// b = p √(c/A).
        fn closed_form(&self) -> ([f64; 2], f64) {
            let z = self.deepest;
            let p = 3.0 * Self::LOAD / (2.0 * Self::STIFFNESS * 2.0_f64.sqrt()) * z.powf(-1.5);
            let a = Self::STIFFNESS * z * z / 2.0;
            let width = p * (Self::MASS / a).sqrt();
            ([(p / width).powi(2), width], 2.0 * p * (Self::MASS * a).sqrt())
        }
    }

    impl Smooth for TowedWheel {
        fn free(&self) -> usize {
            2
        }

        fn constraints(&self) -> usize {
            1
        }

        fn results(&self, point: &[f64]) -> Option<Vec<f64>> {
            let size = |share: f64| 0.01 + 0.99 * share;
            Some(self.outcome([size(point[0]), size(point[1])]).into())
        }

        fn gradients(&self, point: &[f64], _: &[f64]) -> Option<Vec<Vec<f64>>> {
            const STEP: f64 = 1e-6;
            let at = |r: f64, b: f64| self.results(&[point[0] + r, point[1] + b]);
            let by = |r: f64, b: f64| {
                let (up, down) = (at(r, b)?, at(-r, -b)?);
                Some([0, 1].map(|it| (up[it] - down[it]) / (2.0 * STEP)))
            };
            let (by_radius, by_width) = (by(STEP, 0.0)?, by(0.0, STEP)?);
            Some(vec![vec![by_radius[0], by_width[0]], vec![by_radius[1], by_width[1]]])
        }
    }

    #[test]
    fn a_towed_wheel_is_that_of_the_closed_form() {
        for deepest in [0.004, 0.006, 0.01] {
            let wheel = TowedWheel { deepest };
            let (size, aim) = wheel.closed_form();
            for start in [[0.3, 0.3], [0.05, 0.2], [0.8, 0.1]] {
                let found = minimum(&wheel, &start).expect("a wheel");
                let error =
                    |place: usize| ((0.01 + 0.99 * found.point[place]) / size[place] - 1.0).abs();
                assert!(error(0) < 1e-3 && error(1) < 1e-3, "{deepest}: {found:?}, {size:?}");
                assert!((found.objective / aim - 1.0).abs() < 1e-6, "{deepest}: {found:?}, {aim}");
                // The aim goes with z^(-1/2), and the limit is on z over the deepest.
                let price = found.multipliers[0] / (aim / 2.0);
                assert!((price - 1.0).abs() < 1e-3, "{deepest}: {price}");
            }
        }
    }

    #[test]
    fn a_problem_without_an_answer_has_none() {
        assert_eq!(minimum(&Rectangle { most: 0.2 }, &[0.1, 0.9]), None);
    }
}
