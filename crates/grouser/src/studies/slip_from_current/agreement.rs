//! How well estimates agree with slip that was measured by other means.

use super::{MotorLog, SlipEstimate, SlipStatus};
use crate::studies::ensemble::Probability;

/// Estimates in a few numbers, beside the slip that was measured where it was.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// How many readings there are.
    pub readings: usize,
    /// How many have an interval.
    pub estimated: usize,
    /// How many of these are ill-posed.
    pub ill_posed: usize,
    /// Mean of the medians [-].
    pub slip_ratio: Option<f64>,
    /// In how many of the intervals the measured slip lies, of those beside which it was measured.
    pub held: Option<Probability>,
    /// Mean error of the medians, estimated less measured [-].
    pub bias: Option<f64>,
    /// Root of the mean squared error of the medians [-].
    pub rmse: Option<f64>,
}

impl Agreement {
    /// Over the readings of one wheel, or of all.
    ///
    /// * `wheel`: its place among the rover's mounts; all without it
    #[must_use]
    pub fn over(
        log: &MotorLog,
        estimates: &[Vec<Option<SlipEstimate>>],
        wheel: Option<usize>,
    ) -> Self {
        let rows = log.records.iter().zip(estimates).flat_map(|(record, estimates)| {
            let pairs = record.wheels.iter().zip(estimates).enumerate();
            let pairs = pairs.filter(move |(place, _)| wheel.is_none_or(|wheel| wheel == *place));
            pairs.filter_map(|(_, (reading, estimate))| Some(((*reading)?, (*estimate)?)))
        });
        let mut all = Self::default();
        let (mut medians, mut errors, mut held) = (Vec::new(), Vec::new(), 0);
        for (reading, estimate) in rows {
            all.readings += 1;
            all.ill_posed += usize::from(estimate.status == SlipStatus::IllPosed);
            let Some(band) = estimate.slip_ratio else { continue };
            medians.push(band.median);
            let Some(measured) = reading.slip_ratio else { continue };
            errors.push(band.median - measured);
            held += usize::from(estimate.holds(measured) == Some(true));
        }
        let mean = |numbers: &[f64]| {
            (!numbers.is_empty()).then(|| numbers.iter().sum::<f64>() / numbers.len() as f64)
        };
        let squares: Vec<f64> = errors.iter().map(|error| error * error).collect();
        all.estimated = medians.len();
        all.slip_ratio = mean(&medians);
        all.bias = mean(&errors);
        all.rmse = mean(&squares).map(f64::sqrt);
        all.held =
            (!errors.is_empty()).then_some(Probability { successes: held, trials: errors.len() });
        all
    }
}
