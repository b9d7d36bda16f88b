//! Errors of predictions against measured means: root mean square, bias, shares of the largest
//! measured value, and whether they are within the aim.

use super::super::measurement::Quantity;

/// Means of one quantity over the trials of a cell, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Measured.
    pub measured: f64,
    /// Predicted, over the same trials.
    pub predicted: f64,
    /// Number of trials that they are over.
    pub trials: usize,
    /// Standard deviation between the measured trials; `None` for a single one.
    pub repeatability: Option<f64>,
    /// Standard deviation within a trial, root mean square over those that recorded it.
    pub scatter: Option<f64>,
}

/// Errors of one quantity over cells of equal weight, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Root mean square of prediction − measurement.
    pub rmse: f64,
    /// Mean of prediction − measurement.
    pub bias: f64,
    /// The largest measured value, without its sign: what errors are shares of.
    pub largest: f64,
    /// Coefficient of determination, R² [-]: 1 − Σ error²/Σ (measured − mean)². `None` where the
    /// measured values do not differ.
    pub r2: Option<f64>,
    /// Standard deviation between repeated trials, pooled over the cells. A model whose errors
    /// are as small agrees with the experiment as well as the experiment repeats.
    pub repeatability: Option<f64>,
    /// Number of cells that have the quantity.
    pub cells: usize,
    /// The aim for this quantity, and whether it is met; `None` where there is no aim.
    pub aim: Option<Aim>,
}

/// What a prediction from published soil constants should reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aim {
    /// The largest error that is within the aim, in SI units.
    pub limit: f64,
    /// Whether the error is within it, and nothing is without a prediction.
    pub is_met: bool,
}

impl Errors {
    /// The errors of some cells; `None` if there are none. They have no aim yet.
    #[must_use]
    pub fn of(comparisons: &[Comparison]) -> Option<Self> {
        let errors: Vec<f64> = comparisons.iter().map(|it| it.predicted - it.measured).collect();
        let rmse = root_mean_square(&errors)?;
        let count = errors.len() as f64;
        let mean = comparisons.iter().map(|it| it.measured).sum::<f64>() / count;
        let spread: f64 = comparisons.iter().map(|it| (it.measured - mean).powi(2)).sum();
        Some(Self {
            rmse,
            bias: errors.iter().sum::<f64>() / count,
            largest: comparisons.iter().map(|it| it.measured.abs()).fold(0.0, f64::max),
            r2: (spread > 0.0).then(|| 1.0 - count * rmse * rmse / spread),
            repeatability: pooled(comparisons),
            cells: errors.len(),
            aim: None,
        })
    }

    /// The same with the aim for a wheel's quantity: of the largest measured value 25 % for drawbar
    /// pull, or 5 % of the load if that is more, 40 % for sinkage, 25 % for torque. Side force has
    /// none.
    ///
    /// Source: ours, set before any of the published tests was predicted with these models'
    /// defaults.
    ///
    /// * `load`: of the wheel [N]
    /// * `is_complete`: whether every trial has a prediction
    #[must_use]
    pub fn with_aim_for(self, quantity: Quantity, load: f64, is_complete: bool) -> Self {
        let limit = match quantity {
            Quantity::DrawbarPull => (0.25 * self.largest).max(0.05 * load),
            Quantity::Sinkage => 0.40 * self.largest,
            Quantity::Torque => 0.25 * self.largest,
            Quantity::SideForce => return self,
        };
        Self { aim: Some(Aim { limit, is_met: is_complete && self.rmse <= limit }), ..self }
    }

    /// The root mean square error over the largest measured value [-]; `None` if that is zero.
    #[must_use]
    pub fn rmse_share(&self) -> Option<f64> {
        (self.largest > 0.0).then(|| self.rmse / self.largest)
    }

    /// The mean error over the largest measured value [-]; `None` if that is zero.
    #[must_use]
    pub fn bias_share(&self) -> Option<f64> {
        (self.largest > 0.0).then(|| self.bias / self.largest)
    }

    /// The root mean square error over the standard deviation of what was measured, √(1 − R²) [-]:
    /// 0 is perfect, 1 no better than the mean.
    #[must_use]
    pub fn score(&self) -> Option<f64> {
        self.r2.map(|r2| (1.0 - r2).max(0.0).sqrt())
    }
}

/// The mean of some scores; `None` if there are none.
#[must_use]
pub fn mean_score(scores: impl Iterator<Item = f64>) -> Option<f64> {
    let scores: Vec<f64> = scores.collect();
    (!scores.is_empty()).then(|| scores.iter().sum::<f64>() / scores.len() as f64)
}

/// The standard deviation between trials, over cells weighted by their degrees of freedom.
fn pooled(comparisons: &[Comparison]) -> Option<f64> {
    let repeated = comparisons.iter().filter_map(|it| {
        it.repeatability.map(|deviation| (deviation * deviation, (it.trials - 1) as f64))
    });
    let (squares, freedom) = repeated
        .fold((0.0, 0.0), |(squares, all), (variance, own)| (squares + variance * own, all + own));
    (freedom > 0.0).then(|| (squares / freedom).sqrt())
}

pub(super) fn root_mean_square(values: &[f64]) -> Option<f64> {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (!values.is_empty()).then(|| (squares / values.len() as f64).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(pairs: &[[f64; 2]]) -> Errors {
        let of = |[measured, predicted]: &[f64; 2]| Comparison {
            measured: *measured,
            predicted: *predicted,
            trials: 1,
            repeatability: None,
            scatter: None,
        };
        Errors::of(&pairs.iter().map(of).collect::<Vec<_>>()).expect("some")
    }

    /// Errors of 3 and −4 beside a largest value of −20: √12.5, −0.5, and those over 20.
    #[test]
    fn shares_are_of_the_largest_measured_value_without_its_sign() {
        let found = errors(&[[-20.0, -17.0], [10.0, 6.0]]);
        assert_eq!((found.rmse, found.bias, found.largest), (12.5_f64.sqrt(), -0.5, 20.0));
        assert_eq!(found.rmse_share(), Some(12.5_f64.sqrt() / 20.0));
        assert_eq!(found.bias_share(), Some(-0.025));
        assert_eq!(errors(&[[0.0, 1.0]]).rmse_share(), None);
    }

    /// The load counts where hardly any pull was measured, and what has no prediction meets no aim.
    #[test]
    fn the_aims_are_those_that_were_set() {
        let found = errors(&[[20.0, 25.0], [10.0, 15.0]]);
        let aim = |quantity, load, is_complete| {
            found.with_aim_for(quantity, load, is_complete).aim.map(|aim| (aim.limit, aim.is_met))
        };
        assert_eq!(aim(Quantity::DrawbarPull, 80.0, true), Some((5.0, true)));
        assert_eq!(aim(Quantity::DrawbarPull, 200.0, true), Some((10.0, true)));
        assert_eq!(aim(Quantity::DrawbarPull, 80.0, false), Some((5.0, false)));
        assert_eq!(aim(Quantity::Sinkage, 80.0, true), Some((8.0, true)));
        assert_eq!(aim(Quantity::Torque, 800.0, true), Some((5.0, true)));
        assert_eq!(aim(Quantity::SideForce, 80.0, true), None);
        let worse =
            errors(&[[20.0, 25.1], [10.0, 15.0]]).with_aim_for(Quantity::Torque, 80.0, true);
        assert_eq!(worse.aim, Some(Aim { limit: 5.0, is_met: false }));
    }
}
