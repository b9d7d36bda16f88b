//! Nonlinear least squares after Levenberg and Marquardt, as MINPACK does it.
//!
//! The one place that knows the solver's library, which brings a linear algebra of its own:
//! slices in, vectors out.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra_034::{DMatrix, DVector, Dyn, storage::Owned};

/// Residuals as a function of coordinates, with their Jacobian.
pub(super) trait Residuals {
    /// The residuals at a point; `None` where there are none.
    fn at(&self, coordinates: &[f64]) -> Option<Vec<f64>>;

    /// Their derivatives, column by column: one column for each coordinate.
    fn jacobian_at(&self, coordinates: &[f64]) -> Option<Vec<Vec<f64>>>;
}

/// Where the search ended.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Minimum {
    pub(super) coordinates: Vec<f64>,
    /// Half the sum of the residuals' squares; infinite if there are no residuals at the start.
    pub(super) cost: f64,
    /// Whether the search ended because nothing more was to be gained.
    pub(super) converged: bool,
}

/// A search ends where a step promises to lower the cost, or to move, by less than this share.
const TOLERANCE: f64 = 1e-9;

/// Searches downhill from a point.
///
/// * `patience`: at most this many evaluations for each coordinate
pub(super) fn minimise(residuals: &dyn Residuals, start: &[f64], patience: usize) -> Minimum {
    let problem = Problem { residuals, at: DVector::from_column_slice(start) };
    let solver = LevenbergMarquardt::new().with_tol(TOLERANCE).with_patience(patience);
    let (problem, report) = solver.minimize(problem);
    let cost = report.objective_function;
    Minimum {
        coordinates: problem.at.as_slice().to_vec(),
        cost: if cost.is_finite() { cost } else { f64::INFINITY },
        converged: report.termination.was_successful(),
    }
}

struct Problem<'a> {
    residuals: &'a dyn Residuals,
    at: DVector<f64>,
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, coordinates: &DVector<f64>) {
        self.at.copy_from(coordinates);
    }

    fn params(&self) -> DVector<f64> {
        self.at.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        self.residuals.at(self.at.as_slice()).map(DVector::from_vec)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let columns = self.residuals.jacobian_at(self.at.as_slice())?;
        let rows = columns.first()?.len();
        Some(DMatrix::from_iterator(rows, columns.len(), columns.into_iter().flatten()))
    }
}
