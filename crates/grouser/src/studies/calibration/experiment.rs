//! Measurements, and a model that predicts them from parameters.

use rayon::prelude::*;

use super::parameter::{Parameter, Scale};
use crate::error::ParameterError;
use crate::studies::measurement::Quantity;

/// A kind of observation; all of a kind share one model discrepancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// A quantity of a wheel on a test stand.
    Wheel {
        /// The quantity.
        quantity: Quantity,
        /// The motion.
        regime: Regime,
    },
    /// Pressure under a plate [Pa].
    PlatePressure,
    /// Shear stress of a sheared patch [Pa].
    ShearStress,
    /// Any other kind.
    Other,
}

/// Motions that share one model discrepancy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Every motion.
    Any,
    /// A wheel that drives.
    Driven,
    /// A wheel that skids.
    Skid,
}

/// A measured number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Its value in SI units: the mean over repeated trials.
    pub value: f64,
    /// Standard deviation of that mean from trial to trial; 0 where it is not known.
    pub scatter: f64,
    /// Its kind, by the place in [`Experiment::channels`].
    pub channel: usize,
}

/// A place among slips and slip angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Slip by the total speed, *S* [-].
    pub slip: f64,
    /// Size of the slip angle, |*β*| [rad].
    pub slip_angle: f64,
}

/// Where an observation lies among those whose model discrepancies are correlated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The observations that are correlated with each other, by number: one for each quantity.
    pub family: usize,
    /// Its motion.
    pub site: Site,
    /// What its discrepancy is proportional to, in the channel's unit: the load of a wheel for its
    /// forces. It has the sign that the quantity changes in a mirror, and is 0 where by symmetry
    /// there is none: what is read there beyond the model is the stand's.
    pub weight: f64,
    /// How its discrepancy is counted.
    pub measure: Measure,
}

/// How the discrepancy of an observation is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// A difference.
    Linear,
    /// The logarithm of a ratio, times the observation's weight: for quantities that are positive,
    /// and may be several times what a model predicts.
    Logarithmic,
}

/// Measurements, and the model that predicts them.
pub trait Experiment: Sync {
    /// The kinds of observations.
    fn channels(&self) -> &[Channel];

    /// The observations.
    fn observations(&self) -> &[Observation];

    /// Where each observation lies; empty where their discrepancies are independent.
    fn places(&self) -> &[Place] {
        &[]
    }

    /// Predicts each observation from parameters: finite for all values within the bounds.
    ///
    /// * `values`: of the parameters, in their order
    /// * `predictions`: to be filled, one for each observation
    ///
    /// # Errors
    /// [`ParameterError`] if the values are no valid soil: the search turns away from them.
    fn predict(&self, values: &[f64], predictions: &mut [f64]) -> Result<(), ParameterError>;

    /// Predicts all observations, and returns what [`predict_beside`](Self::predict_beside) starts
    /// from there, if from anything.
    ///
    /// # Errors
    /// [`ParameterError`] if the values are no valid soil.
    fn predict_and_keep(
        &self,
        values: &[f64],
        predictions: &mut [f64],
    ) -> Result<Vec<f64>, ParameterError> {
        self.predict(values, predictions)?;
        Ok(Vec::new())
    }

    /// Predictions beside a point, whose differences are derivatives: to first order in the distance
    /// from it; none where the values are no valid soil. Each point is predicted as a whole, unless
    /// an experiment has a shorter way.
    ///
    /// * `values`: the point
    /// * `kept`: what a prediction there has [kept](Self::predict_and_keep); nothing to seek it
    /// * `beside`: points next to it; itself too, whose prediction the others are to be compared
    ///   with
    fn predict_beside(
        &self,
        values: &[f64],
        kept: &[f64],
        beside: &[Vec<f64>],
    ) -> Vec<Option<Vec<f64>>> {
        let _ = (values, kept);
        let whole = |one: &Vec<f64>| {
            let mut predictions = vec![0.0; self.observations().len()];
            self.predict(one, &mut predictions).ok()?;
            Some(predictions)
        };
        beside.par_iter().map(whole).collect()
    }
}

/// A discrepancy below this share of the trials' scatter is not distinguishable from zero [-].
const LEAST_OF_SCATTER: f64 = 0.1;

/// The least discrepancy, as a share of the measurements' range [-]: it keeps the weights finite
/// where no scatter is known.
const LEAST_OF_SPREAD: f64 = 1e-4;

/// The model discrepancy of each channel, δ, as a parameter: its standard deviation.
///
/// The prior is uniform by the logarithm, from a tenth of the trials' scatter (below which it is
/// not distinguishable from zero) to the size of the measured values, their root mean square (above
/// which the model predicts nothing).
#[must_use]
pub fn discrepancies(experiment: &dyn Experiment) -> Vec<Parameter> {
    let channels = 0..experiment.channels().len();
    channels.map(|channel| discrepancy(experiment.observations(), channel)).collect()
}

fn discrepancy(observations: &[Observation], channel: usize) -> Parameter {
    let own = || observations.iter().filter(|observation| observation.channel == channel);
    let count = (own().count() as f64).max(1.0);
    let rms = |squares: f64| (squares / count).sqrt();
    let mean = own().map(|observation| observation.value).sum::<f64>() / count;
    let scatter = rms(own().map(|observation| observation.scatter.powi(2)).sum());
    let spread = rms(own().map(|observation| (observation.value - mean).powi(2)).sum());
    let size = rms(own().map(|observation| observation.value.powi(2)).sum());
    // Values that are all alike have no spread; their size is the next best measure, or one unit.
    let spread = [spread, scatter, size, 1.0].into_iter().find(|&one| one > 0.0).unwrap_or(1.0);
    let spread = spread.max(scatter);
    let lower = (LEAST_OF_SCATTER * scatter).max(LEAST_OF_SPREAD * spread);
    let start = (LEAST_OF_SCATTER * spread).max(lower);
    let upper = spread.max(size);
    let name = format!("discrepancy of channel {channel}");
    Parameter { name, lower, upper, scale: Scale::Logarithmic, start }
}
