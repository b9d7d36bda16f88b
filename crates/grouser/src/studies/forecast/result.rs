//! What a forecast finds.

use super::choices::RoverMass;
use super::factor::{Factor, FactorKind};
use super::support::Support;
use crate::contact::validity::Finding;
use crate::soil::GravityScaling;
use crate::studies::ensemble::Band;
use crate::studies::ensemble::factorial::VarianceBudget;
use crate::studies::ensemble::statistics::Estimate;

/// A forecast.
#[derive(Clone, Debug, PartialEq)]
pub struct Forecast {
    /// Each ground in its order, by the scalings that something supports; then each by those that
    /// no measurement supports.
    pub grounds: Vec<GroundForecast>,
    /// What tests where the soil was measured would show.
    pub tests: Vec<TestForecast>,
}

/// A forecast on one ground.
#[derive(Clone, Debug, PartialEq)]
pub struct GroundForecast {
    /// The ground's name.
    pub ground: String,
    /// How moduli scale in its cases.
    pub scalings: Vec<GravityScaling>,
    /// What it rests on.
    pub support: Support,
    /// The factors with their levels, those of one level too.
    pub factors: Vec<Factor>,
    /// On each slope that was asked for, in that order.
    pub slopes: Vec<SlopeForecast>,
    /// Steepest slope on which a heading holds the contour [rad]; 0 where the rover cannot drive on
    /// level ground.
    pub limit: Option<Band>,
    /// The same in parts.
    pub limit_budget: VarianceBudget,
    /// The mean of the same at each level of each factor.
    pub limit_means: Vec<Vec<f64>>,
    /// How many cases there are.
    pub cases: usize,
}

/// A forecast on one slope of a ground.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeForecast {
    /// Slope, *α* [rad].
    pub slope: f64,
    /// Probability that a rover on a contour traverse slips more than the limit, or that no heading
    /// holds the contour [-].
    pub slip_above_limit: Estimate,
    /// Probability that no heading holds the contour [-].
    pub no_heading: Estimate,
    /// Yaw, *γ* [rad], positive uphill; above every number where no heading holds the contour.
    pub yaw: Option<Band>,
    /// Slip ratio of every wheel on a contour traverse, *s* [-]; 1 where no heading holds the
    /// contour.
    pub slip_ratio: Option<Band>,
    /// Mean sinkage of the wheels [m]; down to the axles where no heading holds the contour.
    pub sinkage: Option<Band>,
    /// Drift per metre with the nose on the contour [-]; 1 where the rover slides.
    pub drift: Option<Band>,
    /// Mechanical power of the motors [W]; above every number where no heading holds the contour.
    pub power: Option<Band>,
    /// Work of the wheels per metre along the contour [J/m], likewise.
    pub energy_per_metre: Option<Band>,
    /// The slip ratio in parts.
    pub slip_budget: VarianceBudget,
    /// The drift in parts.
    pub drift_budget: VarianceBudget,
    /// The mean slip ratio at each level of each factor.
    pub slip_means: Vec<Vec<f64>>,
    /// The mean drift at each level of each factor.
    pub drift_means: Vec<Vec<f64>>,
    /// The share with a heading at each level of each factor.
    pub level_means: Vec<Vec<f64>>,
    /// The flags of the ground as written, with the first level of every choice.
    pub findings: Vec<Finding>,
}

/// What a test of a rover would show on the soil, and under the gravity, that was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TestForecast {
    /// The rover's mass there, over that of its document.
    pub mass: RoverMass,
    /// On each slope: its slip ratio, and the share of the cases in which a heading holds the
    /// contour.
    pub slopes: Vec<(Option<Band>, f64)>,
}

impl Forecast {
    /// Whether a ground is among those that are answered first: with the scalings that something
    /// supports, if there are any.
    #[must_use]
    pub fn is_first(&self, ground: &GroundForecast) -> bool {
        self.grounds.first().is_some_and(|it| it.scalings == ground.scalings)
    }
}

impl GroundForecast {
    /// The place of a factor.
    #[must_use]
    pub fn place(&self, kind: FactorKind) -> Option<usize> {
        self.factors.iter().position(|factor| factor.kind == kind)
    }
}
