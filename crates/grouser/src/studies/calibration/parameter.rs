//! Parameters to estimate: bounded values outside, unbounded coordinates inside.
//!
//! A parameter has a *value* θ between its bounds, a *position* p between 0 and 1, its place
//! from the lower to the upper bound (by logarithms, if its scale is logarithmic), and
//! an unbounded *coordinate* u, in which least squares and the sampler move:
//!
//! ```text
//! θ = θ_lower + p (θ_upper − θ_lower)      or      ln θ = ln θ_lower + p ln(θ_upper/θ_lower)
//! p = 1/(1 + e^(−u))
//! ```
//!
//! The prior is uniform in p, so its density in u is dp/du = p (1 − p): the logistic one.

use std::f64::consts::PI;

use crate::elementary::exp;
use crate::elementary::wide::{ln, ln_1p};
use crate::error::{ParameterError, finite, positive};

/// How a parameter's prior is spread between its bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Evenly: as likely between 1 and 2 as between 2 and 3.
    Linear,
    /// Evenly by its logarithm: as likely between 1 and 2 as between 2 and 4.
    Logarithmic,
}

/// A parameter to estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name, as reports call it.
    pub name: String,
    /// The smallest value that it may have.
    pub lower: f64,
    /// The largest.
    pub upper: f64,
    /// How the prior is spread between them.
    pub scale: Scale,
    /// Where the search starts, first of several places.
    pub start: f64,
}

/// Standard deviation of a position before any data: of a uniform one, 1/√12 [-].
pub const PRIOR_DEVIATION: f64 = 0.288_675_134_594_812_9;

/// Variance of the logistic distribution, the prior of a coordinate, π²/3 [-].
pub(super) const COORDINATE_VARIANCE: f64 = PI * PI / 3.0;

/// A search does not start nearer to a bound than this [-], in positions: at a bound no
/// coordinate has a slope to go by.
const START_MARGIN: f64 = 1e-3;

impl Parameter {
    /// Checks bounds and start.
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid one.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Self { name, lower, upper, scale, start } = self;
        finite(&format!("lower bound of {name}"), *lower)?;
        finite(&format!("upper bound of {name}"), *upper)?;
        if lower >= upper {
            let name = format!("lower bound of {name}");
            return Err(ParameterError::new(name, *lower, "below the upper bound"));
        }
        if *scale == Scale::Logarithmic {
            positive(&format!("lower bound of {name}, on a logarithmic scale,"), *lower)?;
        }
        if !(lower..=upper).contains(&start) {
            return Err(ParameterError::new(
                format!("start of {name}"),
                *start,
                "within the bounds",
            ));
        }
        Ok(())
    }

    /// The value at a position from 0 to 1.
    #[must_use]
    pub fn value_at(&self, position: f64) -> f64 {
        let Self { lower, upper, .. } = *self;
        let value = match self.scale {
            Scale::Linear => lower + position * (upper - lower),
            Scale::Logarithmic => lower * exp(position * ln(upper / lower)),
        };
        // Rounding may step over a bound.
        value.clamp(lower, upper)
    }

    /// The position of a value, 0 to 1.
    #[must_use]
    pub fn position_of(&self, value: f64) -> f64 {
        let Self { lower, upper, .. } = *self;
        let position = match self.scale {
            Scale::Linear => (value - lower) / (upper - lower),
            Scale::Logarithmic => ln(value / lower) / ln(upper / lower),
        };
        position.clamp(0.0, 1.0)
    }

    /// Whether a value is at a bound: nearer than any search starts. The coordinate has no slope
    /// there, so that no standard deviation of first order exists.
    #[must_use]
    pub fn is_at_bound(&self, value: f64) -> bool {
        !(START_MARGIN..=1.0 - START_MARGIN).contains(&self.position_of(value))
    }

    /// The coordinate from which a search starts.
    #[must_use]
    pub fn start_coordinate(&self) -> f64 {
        coordinate_of(self.position_of(self.start).clamp(START_MARGIN, 1.0 - START_MARGIN))
    }
}

/// The parameters of a calibration, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterSpace {
    parameters: Vec<Parameter>,
}

impl ParameterSpace {
    /// A space of checked parameters.
    ///
    /// # Errors
    /// [`ParameterError`] for the first invalid one.
    pub fn new(parameters: Vec<Parameter>) -> Result<Self, ParameterError> {
        for parameter in &parameters {
            parameter.check()?;
        }
        Ok(Self { parameters })
    }

    /// The parameters.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parameters.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.parameters.is_empty()
    }

    /// The values at a point, given by coordinates.
    #[must_use]
    pub fn values(&self, coordinates: &[f64]) -> Vec<f64> {
        let each = self.parameters.iter().zip(coordinates);
        each.map(|(parameter, &u)| parameter.value_at(position_of(u))).collect()
    }

    /// The positions of values, each 0 to 1.
    #[must_use]
    pub fn positions(&self, values: &[f64]) -> Vec<f64> {
        let each = self.parameters.iter().zip(values);
        each.map(|(parameter, &value)| parameter.position_of(value)).collect()
    }

    /// The coordinates of the parameters' starts.
    #[must_use]
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(Parameter::start_coordinate).collect()
    }

    /// How fast each value changes with its coordinate, dθ/du.
    #[must_use]
    pub fn slopes(&self, coordinates: &[f64]) -> Vec<f64> {
        let slope = |(parameter, &u): (&Parameter, &f64)| {
            let position = position_of(u);
            let Parameter { lower, upper, .. } = *parameter;
            let per_position = match parameter.scale {
                Scale::Linear => upper - lower,
                Scale::Logarithmic => parameter.value_at(position) * ln(upper / lower),
            };
            per_position * position * (1.0 - position)
        };
        self.parameters.iter().zip(coordinates).map(slope).collect()
    }

    /// Logarithm of the prior's density at a point, given by coordinates.
    #[must_use]
    pub fn log_prior(coordinates: &[f64]) -> f64 {
        coordinates.iter().map(|&u| log_logistic(u)).sum()
    }
}

/// The position p of a coordinate u.
#[must_use]
pub fn position_of(coordinate: f64) -> f64 {
    1.0 / (1.0 + exp(-coordinate))
}

/// The coordinate u of a position p, above 0 and below 1.
#[must_use]
pub fn coordinate_of(position: f64) -> f64 {
    ln(position / (1.0 - position))
}

/// ln[p (1 − p)] at a coordinate, without overflow.
fn log_logistic(coordinate: f64) -> f64 {
    let size = coordinate.abs();
    -size - 2.0 * ln_1p(exp(-size))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameter(scale: Scale) -> Parameter {
        Parameter { name: "K".into(), lower: 0.001, upper: 0.1, scale, start: 0.01 }
    }

    #[test]
    fn a_value_returns_from_its_position_and_coordinate() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            let parameter = parameter(scale);
            for value in [0.0011, 0.01, 0.09] {
                let position = parameter.position_of(value);
                let back = parameter.value_at(position_of(coordinate_of(position)));
                // A handful of roundings.
                assert!((back / value - 1.0).abs() < 1e-13, "{value}: {back}");
            }
        }
    }

    /// The geometric mean is the middle of a logarithmic scale.
    #[test]
    fn a_logarithmic_scale_is_even_by_logarithms() {
        assert!((parameter(Scale::Logarithmic).position_of(0.01) - 0.5).abs() < 1e-14);
    }

    #[test]
    fn no_coordinate_leaves_the_bounds() {
        for scale in [Scale::Linear, Scale::Logarithmic] {
            let parameter = parameter(scale);
            for coordinate in [-1e300, -800.0, -40.0, 0.0, 40.0, 800.0, 1e300] {
                let value = parameter.value_at(position_of(coordinate));
                assert!((0.001..=0.1).contains(&value), "{coordinate}: {value}");
            }
        }
    }

    /// The density in coordinates has an integral of one, and is the slope of the position.
    #[test]
    fn the_prior_in_coordinates_is_the_slope_of_the_position() {
        const STEP: f64 = 1e-5;
        for coordinate in [-5.0, -0.3, 0.0, 2.0, 7.0] {
            let (above, below) = (position_of(coordinate + STEP), position_of(coordinate - STEP));
            let slope = (above - below) / (2.0 * STEP);
            // The difference quotient errs by the step's square.
            assert!((log_logistic(coordinate).exp() / slope - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn bounds_that_make_no_sense_are_refused() {
        let sound = parameter(Scale::Logarithmic);
        let negative = Parameter { lower: -1.0, ..sound.clone() };
        let turned = Parameter { upper: 0.0001, ..sound.clone() };
        let outside = Parameter { start: 0.2, ..sound.clone() };
        let unknown = Parameter { upper: f64::NAN, ..sound.clone() };
        for parameter in [negative, turned, outside, unknown] {
            assert!(ParameterSpace::new(vec![parameter]).is_err());
        }
        assert!(ParameterSpace::new(vec![sound]).is_ok());
    }
}
