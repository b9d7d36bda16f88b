//! Cross-validation: the errors of a fit at slip angles that it has not seen, each left out in
//! turn, and how often bands of its posterior hold what was measured there.

use std::ops::ControlFlow;

use grouser_io::statistics::normal::normal_share;
use grouser_io::statistics::{interval_score, quantile};

use super::diagnostics::Samples;
use super::solution::DISCARDED;
use super::wheel_test::{Setup, WheelTestExperiment};
use super::{
    Advanced, Calibration, CalibrationError, Experiment as _, Fit, FitSettings, ParameterSpace,
    SamplerSettings, handed_on,
};
use crate::contact::{SettleError, Settled};
use crate::root;
use crate::studies::ensemble::outputs;
use crate::studies::measurement::{PerQuantity, Quantity, WheelTests};

/// A fit without the cells of one slip angle, and its predictions of them.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The slip angle that was left out [rad].
    pub slip_angle: f64,
    /// The fit to all others.
    pub fit: Fit,
    /// The trials left out, by their places, each predicted at its own load and motion.
    pub predictions: Vec<(usize, Result<Settled, SettleError>)>,
    /// The bands of the cells left out; none without sampling, and none of a side force straight
    /// ahead.
    pub bands: Vec<LeftOutBand>,
}

/// The predicted band of the mean that the stand reads in a cell that was left out, in SI units: of
/// the samples' predictions with their discrepancies, and with the scatter of the cell's trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeftOutBand {
    /// The cell, by its place.
    pub cell: usize,
    /// The quantity.
    pub quantity: Quantity,
    /// Its mean over the trials.
    pub measured: f64,
    /// The values that 2.5, 25, 75 and 97.5 % lie below.
    pub quantiles: [f64; 4],
}

/// Shares of the samples below the ends of the bands [-].
const SHARES: [f64; 4] = [0.025, 0.25, 0.75, 0.975];

/// Samples that make a band.
const BAND_SAMPLES: usize = 400;

/// How well bands hold what was measured, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Share of the cells within their 50 % bands [-].
    pub share_within_50: f64,
    /// Share of the cells within their 95 % bands [-].
    pub share_within_95: f64,
    /// Mean interval score of the 95 % bands, in the unit of the quantity: smaller is better.
    pub interval_score: f64,
    /// Number of cells that have a band.
    pub cells: usize,
}

impl Coverage {
    /// The coverage of some bands, if there are any.
    #[must_use]
    pub fn of(bands: &[LeftOutBand]) -> Option<Self> {
        let count = bands.len() as f64;
        let share = |holds: &dyn Fn(&LeftOutBand) -> bool| {
            bands.iter().filter(|band| holds(band)).count() as f64 / count
        };
        let within = |band: &LeftOutBand, low: usize, high: usize| {
            (band.quantiles[low]..=band.quantiles[high]).contains(&band.measured)
        };
        (!bands.is_empty()).then(|| Self {
            share_within_50: share(&|band| within(band, 1, 2)),
            share_within_95: share(&|band| within(band, 0, 3)),
            interval_score: bands.iter().map(LeftOutBand::interval_score).sum::<f64>() / count,
            cells: bands.len(),
        })
    }
}

impl LeftOutBand {
    /// The [`interval_score`] of the 95 % band.
    #[must_use]
    pub fn interval_score(&self) -> f64 {
        let [low, _, _, high] = self.quantiles;
        interval_score([low, high], self.measured)
    }
}

/// Slip angles of a test series, in the order of its cells.
#[must_use]
pub fn slip_angles(tests: &WheelTests) -> Vec<f64> {
    let mut angles: Vec<f64> = Vec::new();
    for cell in &tests.cells {
        if !angles.contains(&cell.slip_angle) {
            angles.push(cell.slip_angle);
        }
    }
    angles
}

/// The tests without the cells of a slip angle. Trials keep their places.
#[must_use]
pub fn without(tests: &WheelTests, slip_angle: f64) -> WheelTests {
    let cells = tests.cells.iter().filter(|cell| cell.slip_angle != slip_angle).cloned();
    WheelTests { trials: tests.trials.clone(), cells: cells.collect() }
}

/// Fits without each slip angle in turn.
///
/// * `sampler`: of the posterior without the angle, for the bands; without it there are none
/// * `observer`: called whenever a search of a fit or a block of a posterior has ended; it can stop
///   the work
///
/// # Errors
/// The same as [`Calibration::new`] and [`Calibration::fit`], for the first fit that fails.
pub fn leave_one_angle_out(
    tests: &WheelTests,
    setup: Setup,
    space: &ParameterSpace,
    settings: &FitSettings,
    sampler: Option<&SamplerSettings>,
    observer: &(dyn Fn() -> ControlFlow<()> + Sync),
) -> Result<Vec<LeftOut>, CalibrationError> {
    let one_angle = |slip_angle: f64| {
        let experiment = WheelTestExperiment::new(&without(tests, slip_angle), setup)?;
        let fit = Calibration::new(&experiment, space.clone())?.fit(settings, observer)?;
        let soil = experiment.soil(&fit.values)?;
        let cells = tests.cells.iter().filter(|cell| cell.slip_angle == slip_angle);
        let predict = |&trial: &usize| {
            let settled = tests.trials[trial].predict(
                setup.model.as_ref(),
                &setup.wheel,
                &soil,
                setup.gravity,
            );
            (trial, settled)
        };
        let predictions = cells.flat_map(|cell| &cell.trials).map(predict).collect();
        let is_left_out = |cell: usize| tests.cells[cell].slip_angle == slip_angle;
        let bands = match sampler {
            Some(sampler) => {
                let experiment = experiment.with_scatter_about(&fit.values)?;
                let all =
                    WheelTestExperiment::new(tests, setup)?.with_scatter_about(&fit.values)?;
                bands(&experiment, space, &fit, sampler, (&all, &is_left_out), observer)?
            }
            None => Vec::new(),
        };
        Ok(LeftOut { slip_angle, fit, predictions, bands })
    };
    slip_angles(tests).into_iter().map(one_angle).collect()
}

/// The bands of cells that an experiment has not seen.
///
/// * `fit`: near which its posterior is sampled
/// * `unseen`: all cells, and which of them are asked for
fn bands(
    experiment: &WheelTestExperiment,
    space: &ParameterSpace,
    fit: &Fit,
    sampler: &SamplerSettings,
    (all, is_asked_for): (&WheelTestExperiment, &dyn Fn(usize) -> bool),
    observer: &dyn Fn() -> ControlFlow<()>,
) -> Result<Vec<LeftOutBand>, CalibrationError> {
    let calibration = Calibration::new(experiment, space.clone())?;
    let mut state = calibration.start_posterior(fit, sampler);
    if calibration.advance(&mut state, sampler, &mut |_| observer())? == Advanced::Stopped {
        return Err(CalibrationError::Interrupted);
    }
    let samples = Samples::of(&calibration, &state, DISCARDED);
    let rows = samples.thinned(BAND_SAMPLES);
    let wrong = handed_on::discrepancies(&calibration, experiment, &rows, sampler.seed);
    let soils = handed_on::soils(experiment, &rows, &wrong);
    let observed = all.sources().iter().zip(all.observations());
    let asked: Vec<_> = observed.filter(|((_, cell), _)| is_asked_for(*cell)).collect();
    let mut cells: Vec<usize> = asked.iter().map(|((_, cell), _)| *cell).collect();
    cells.sort_unstable();
    cells.dedup();
    let predicted: Vec<Vec<PerQuantity<f64>>> =
        outputs(&soils, |soil| all.cell_readings(soil, &cells));
    let band = |(&(quantity, cell), observation): (&(Quantity, usize), &super::Observation)| {
        let place = cells.binary_search(&cell).ok()?;
        let values: Vec<f64> = predicted.iter().map(|one| one[place][quantity]).collect();
        let measured = observation.value;
        let quantiles = quantiles_with_scatter(values, observation.scatter)?;
        Some(LeftOutBand { cell, quantity, measured, quantiles })
    };
    Ok(asked.into_iter().filter_map(band).collect())
}

/// The quantiles of what would be read where samples predict some values: each of them normally
/// scattered. None where all samples predict the same: straight ahead no soil has a side force, by
/// symmetry, and what a stand reads there is its own.
fn quantiles_with_scatter(mut values: Vec<f64>, scatter: f64) -> Option<[f64; 4]> {
    /// The normal distribution has ended so many deviations beyond the values [-].
    const ENDS: f64 = 9.0;
    values.sort_by(f64::total_cmp);
    let (low, high) = (*values.first()?, *values.last()?);
    if low == high {
        return None;
    }
    if scatter == 0.0 {
        return Some(SHARES.map(|share| quantile(&values, share).unwrap_or(f64::NAN)));
    }
    let below = |x: f64| {
        let shares = values.iter().map(|value| normal_share((x - value) / scatter));
        shares.sum::<f64>() / values.len() as f64
    };
    let ends = (low - ENDS * scatter, high + ENDS * scatter);
    let tolerance = 1e-6 * scatter;
    Some(SHARES.map(|share| root::between(|x| below(x) - share, ends.0, ends.1, tolerance)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed form: values that agree have the normal band of their scatter.
    #[test]
    fn a_band_of_scatter_alone_is_the_normal_one() {
        let values: Vec<f64> = (0..400).map(|place| 5.0 + 1e-6 * f64::from(place)).collect();
        let found = quantiles_with_scatter(values, 2.0).expect("a band");
        for (found, expected) in
            found.into_iter().zip([-1.959_964, -0.674_490, 0.674_490, 1.959_964])
        {
            assert!((found - 5.0 - 2.0 * expected).abs() < 1e-3, "{found}");
        }
    }

    /// Without scatter they are the quantiles of the values.
    #[test]
    fn a_band_without_scatter_is_that_of_the_values() {
        let values: Vec<f64> = (0..=1000).map(f64::from).collect();
        let found = quantiles_with_scatter(values.clone(), 0.0).expect("a band");
        assert_eq!(found, [25.0, 250.0, 750.0, 975.0]);
        let scattered = quantiles_with_scatter(values, 1e-3).expect("a band");
        for (one, other) in found.into_iter().zip(scattered) {
            assert!((one - other).abs() < 1.0);
        }
    }
}
