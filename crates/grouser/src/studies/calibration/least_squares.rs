//! Nonlinear least squares after Levenberg and Marquardt, as MINPACK does it.
//!
//! The one place that knows the solver's library: slices in, vectors out.

use rmpfit::{MPConfig, MPError, MPFitter, MPMaxFev, MPPar, MPResult, MPSide, MPSuccess};

#[cfg(test)]
mod certified;

/// Residuals as a function of coordinates, with their Jacobian.
pub(super) trait Residuals {
    /// The residuals at a point, and what their derivatives there start from; `None` where there
    /// are none.
    fn at(&self, coordinates: &[f64]) -> Option<Evaluated>;

    /// Their derivatives, column by column: one column for each coordinate.
    ///
    /// * `kept`: of the residuals there
    fn jacobian_at(&self, coordinates: &[f64], kept: &[f64]) -> Option<Vec<Vec<f64>>>;
}

/// Residuals at a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Evaluated {
    pub(super) residuals: Vec<f64>,
    /// What was found on the way, and need not be sought again.
    pub(super) kept: Vec<f64>,
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

/// What stands for each residual at a point without residuals. The search takes such a step back,
/// and the next one is shorter. Its square is a finite number.
const NO_RESIDUAL: f64 = 1e100;

/// Searches downhill from a point.
///
/// * `patience`: at most this many evaluations for each coordinate, and once more
pub(super) fn minimise(residuals: &dyn Residuals, start: &[f64], patience: usize) -> Minimum {
    let nowhere = Minimum { coordinates: start.to_vec(), cost: f64::INFINITY, converged: false };
    let Some(first) = residuals.at(start) else { return nowhere };
    let mut search = Search {
        residuals,
        rows: first.residuals.len(),
        kept: Vec::new(),
        first: Some(first),
        left: patience * (start.len() + 1),
        config: MPConfig {
            ftol: TOLERANCE,
            xtol: TOLERANCE,
            // The angle between residuals and Jacobian is no reason to end, unless it is a right
            // one.
            gtol: f64::MIN_POSITIVE,
            // Evaluations are counted here, without those of the Jacobian.
            max_fev: MPMaxFev::NoLimit,
            max_iter: usize::MAX,
            ..MPConfig::new()
        },
        columns: start.iter().map(|_| MPPar { side: MPSide::User, ..MPPar::new() }).collect(),
        evaluated: f64::INFINITY,
        accepted: nowhere,
    };
    let mut end = start.to_vec();
    match search.mpfit(&mut end) {
        Ok(status) => Minimum {
            coordinates: end,
            cost: half_square(&status.resid),
            converged: matches!(
                status.success,
                MPSuccess::Chi | MPSuccess::Par | MPSuccess::Both | MPSuccess::Dir
            ),
        },
        // No evaluations are left, or there is no Jacobian.
        Err(_) => search.accepted,
    }
}

fn half_square(residuals: &[f64]) -> f64 {
    0.5 * residuals.iter().map(|r| r * r).sum::<f64>()
}

/// A search under way, as the library asks for it.
struct Search<'a> {
    residuals: &'a dyn Residuals,
    rows: usize,
    /// The residuals at the start, until the library asks for them.
    first: Option<Evaluated>,
    /// What the residuals of the point that was evaluated last have kept; the Jacobian is asked for
    /// only there.
    kept: Vec<f64>,
    /// Evaluations that are left.
    left: usize,
    config: MPConfig,
    columns: Vec<MPPar>,
    /// Cost of the point that was evaluated last.
    evaluated: f64,
    /// The last point that a step led to. The library asks for the Jacobian there, and nowhere
    /// else.
    accepted: Minimum,
}

impl MPFitter for Search<'_> {
    fn number_of_points(&self) -> usize {
        self.rows
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.columns
    }

    fn eval(&mut self, coordinates: &[f64], residuals: &mut [f64]) -> MPResult<()> {
        self.left = self.left.checked_sub(1).ok_or(MPError::Eval)?;
        match self.first.take().or_else(|| self.residuals.at(coordinates)) {
            Some(found) => {
                residuals.copy_from_slice(&found.residuals);
                self.kept = found.kept;
            }
            None => residuals.fill(NO_RESIDUAL),
        }
        self.evaluated = half_square(residuals);
        Ok(())
    }

    fn jacobian(
        &mut self,
        coordinates: &[f64],
        _residuals: &mut [f64],
        columns: &mut [Option<Vec<f64>>],
    ) -> MPResult<()> {
        self.accepted.coordinates.copy_from_slice(coordinates);
        self.accepted.cost = self.evaluated;
        // The step from here would be one too many.
        if self.left == 0 {
            return Err(MPError::Eval);
        }
        let found = self.residuals.jacobian_at(coordinates, &self.kept).ok_or(MPError::Eval)?;
        for (column, found) in columns.iter_mut().zip(found) {
            *column = Some(found);
        }
        Ok(())
    }
}
